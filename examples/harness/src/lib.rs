//! What the examples and tests of nostray share: scenes of any size on the heap, and files.

mod heap;
pub mod nff;

pub use heap::{Growable, Heap};
pub use nff::{NffError, NffScene};
