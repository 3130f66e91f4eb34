//! What the examples and tests of nostray share: scenes of any size on the heap.

mod heap;

pub use heap::{Growable, Heap};
