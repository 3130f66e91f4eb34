//! Surfaces of revolution against their definition: membership of points all along a ray, and of the middle
//! of every span and of every gap that was found.
//!
//! `cargo test --test solids lathe -- --nocapture` prints the tables; `NOSTRAY_RAYS=100000` takes so many rays of each
//! class. "wrong" counts rays whose spans differ from a dense scan in number; "margin" is how far from the
//! surface, in ε·size (in fixed point in steps), the spans found and the truth differ at most; "geo" the greatest
//! |t error|·|dir|/size (in steps) of rays that meet the surface at more than 6 degrees.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

mod aim;
mod scans;
mod secondary;
mod subject;

/// How near to the surface rounding may decide, in ε·size or steps.
const MARGIN: f64 = 16.0;

/// How many rays of each class: so many, or as the environment says.
fn rays(few: u32) -> u32 {
    std::env::var("NOSTRAY_RAYS").map_or(few, |many| many.parse().expect("a number of rays"))
}
