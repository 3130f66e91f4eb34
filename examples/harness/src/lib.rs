//! What the examples and tests of nostray share, on a host with `std`: scenes of any size,
//! scene files, a gallery, pictures as files, and the commands `render` and `probe`.

mod assemble;
mod expression;
mod failure;
mod flaw;
mod forms;
mod globe;
mod heap;
mod knot;
mod locate;
mod looks;
mod moves;
mod origin;
mod patterns;
mod picture;
mod probe_command;
mod render_command;
mod solids;
mod sphereflake;
mod triangulate;

pub mod document;
pub mod figure;
pub mod gallery;
pub mod nff;
pub mod obj;
pub mod output;
pub mod raster;
pub mod read;
pub mod sheet;
pub mod source;
pub mod written;

pub use assemble::Assembly;
pub use flaw::Flaw;
pub use heap::{Growable, Heap};
pub use nff::{NffError, NffScene};
pub use probe_command::probe_command;
pub use render_command::render_command;
