//! What the examples and tests of nostray share, on a host with `std`: scenes of any size,
//! scene files, a gallery, pictures as files, and the commands `render` and `probe`.

mod assemble;
mod failure;
mod flaw;
mod forms;
mod globe;
mod heap;
mod lamp;
mod locate;
mod looks;
mod moves;
mod origin;
mod patterns;
mod picture;
mod probe_command;
mod render_command;
mod sampling_options;
mod solids;
mod sphereflake;
mod viewer;

pub mod document;
pub mod gallery;
pub mod nff;
pub mod output;
pub mod raster;
pub mod read;
pub mod source;
pub mod written;

pub use assemble::Assembly;
pub use flaw::Flaw;
pub use heap::{Growable, Heap};
pub use nff::{NffError, NffScene};
pub use probe_command::probe_command;
pub use render_command::render_command;
