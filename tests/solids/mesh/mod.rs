//! Meshes: watertight and even along edges and vertices, where exact arithmetic has them elsewhere;
//! solids like those of other shapes; refused where they are none.
//!
//! `NOSTRAY_RAYS=1000000 cargo test --test solids mesh -- --nocapture` tries so many rays.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

mod counts;
mod figures;
mod files;
mod heights;
mod looks;
mod refusals;
mod solids;
mod starts;
