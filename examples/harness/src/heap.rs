//! Tables on the heap, for a host that reads scenes of any size.

use nostray::{Storage, Store};

/// A table that grows as long as there is memory.
#[derive(Clone, Debug)]
pub struct Growable<T>(Vec<T>);

impl<T> Default for Growable<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<T: Copy> Store<T> for Growable<T> {
    fn push(&mut self, entry: T) -> bool {
        self.0.push(entry);
        true
    }
    fn entries(&self) -> &[T] {
        &self.0
    }
    fn entries_mut(&mut self) -> &mut [T] {
        &mut self.0
    }
    fn truncate(&mut self, len: usize) {
        self.0.truncate(len);
    }
    fn capacity(&self) -> usize {
        usize::MAX
    }
}

/// The storage of a [`SceneBuilder`](nostray::SceneBuilder) without limits of its own.
#[derive(Clone, Copy, Debug)]
pub struct Heap;

impl Storage for Heap {
    type Objects<T: Copy> = Growable<T>;
    type Nodes<T: Copy> = Growable<T>;
    type Materials<T: Copy> = Growable<T>;
    type Points<T: Copy> = Growable<T>;
    type Data<T: Copy> = Growable<T>;
    type Pixels<T: Copy> = Growable<T>;
    type Branches<T: Copy> = Growable<T>;
}
