//! Bézier patches and splines: all their points on a ray, where patches meet, where rays start on them, and what is refused.
//!
//! `cargo test --test solids patch -- --nocapture` prints the tables; `NOSTRAY_RAYS=100000` sets how many rays each
//! row has.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

mod borders;
mod forms;
mod hits;
