//! Meshes: watertight and even along edges and vertices, where exact arithmetic has them elsewhere;
//! solids like those of other shapes; refused where they are none.
//!
//! `NOSTRAY_RAYS=1000000 cargo test --test mesh -- --nocapture` tries so many rays.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

mod oracle;

#[path = "mesh/counts.rs"]
mod counts;
#[path = "mesh/figures.rs"]
mod figures;
#[path = "mesh/files.rs"]
mod files;
#[path = "mesh/heights.rs"]
mod heights;
#[path = "mesh/looks.rs"]
mod looks;
#[path = "mesh/refusals.rs"]
mod refusals;
#[path = "mesh/solids.rs"]
mod solids;
#[path = "mesh/starts.rs"]
mod starts;
