//! Cells: one point somewhere in each cell of the lattice, and what lies nearest to which.
//!
//! Source: S. Worley, "A Cellular Texture Basis Function" (1996), with exactly one point in each cell.

use super::noise::{Lattice, hash_cell, tenth_bits};
use crate::scalar::Scalar;

/// The points nearest to a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest<S> {
    /// The distance to the nearest; at most √3.
    pub first: S,
    /// The distance to the second nearest.
    pub second: S,
    /// A hash of the cell of the nearest.
    pub cell: u32,
}

/// The squares of the distances to the two nearest points so far.
struct Search<S> {
    first: S,
    second: S,
    cell: u32,
}

impl<S: Scalar> Search<S> {
    /// Looks at the point of the cell that lies so many cells away.
    fn look(&mut self, at: &Lattice<S>, away: [i32; 3], seed: u32) {
        let mut cell = at.cell;
        for (part, away) in cell.iter_mut().zip(away) {
            *part = part.wrapping_add_signed(away);
        }
        let hash = hash_cell(cell, seed);
        let mut square = S::ZERO;
        for ((within, away), shift) in at.within.into_iter().zip(away).zip([0, 10, 20]) {
            square += (S::from_i32(away) - within + tenth_bits(hash, shift)).squared();
        }
        if square < self.first {
            (self.second, self.first, self.cell) = (self.first, square, hash);
        } else if square < self.second {
            self.second = square;
        }
    }
}

/// The square of the distance from a place to a cell so many cells away.
fn gap<S: Scalar>(at: &Lattice<S>, away: [i32; 3]) -> S {
    let mut square = S::ZERO;
    for (within, away) in at.within.into_iter().zip(away) {
        if away > 0 {
            square += (S::from_i32(away) - within).squared();
        } else if away < 0 {
            square += (within - S::from_i32(away + 1)).squared();
        }
    }
    square
}

/// The two points nearest to `p`.
///
/// The 27 cells around are searched, and the ring of 98 around these only where a point of it might be
/// nearer than the second. The nearest is never farther than that.
#[inline(never)]
pub fn nearest<S: Scalar>(p: S::Vec3, seed: u32) -> Nearest<S> {
    let at = Lattice::of(p);
    let far = S::from_i32(64);
    let mut search = Search { first: far, second: far, cell: 0 };
    for ring in [1_i32, 2] {
        for x in -ring..=ring {
            for y in -ring..=ring {
                for z in -ring..=ring {
                    let outermost = x.abs().max(y.abs()).max(z.abs()) == ring || ring == 1;
                    if outermost && gap(&at, [x, y, z]) < search.second {
                        search.look(&at, [x, y, z], seed);
                    }
                }
            }
        }
        // The nearest wall of the ring.
        let [x, y, z] = at.within.map(|v| v.min(S::ONE - v));
        if search.second <= (S::ONE + x.min(y).min(z)).squared() {
            break;
        }
    }
    Nearest { first: search.first.sqrt(), second: search.second.sqrt(), cell: search.cell }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    /// All cells within three, without any short cut.
    fn slowly(p: DVec3, seed: u32) -> [f64; 2] {
        let at = Lattice::<f64>::of(p);
        let mut search = Search { first: 1e9, second: 1e9, cell: 0 };
        for n in 0..343 {
            search.look(&at, [n % 7 - 3, n / 7 % 7 - 3, n / 49 - 3], seed);
        }
        [libm::sqrt(search.first), libm::sqrt(search.second)]
    }

    #[test]
    fn the_search_finds_what_lies_nearest() {
        let mut state = 1;
        let mut far = 0;
        for _ in 0..20_000 {
            let [x, y, z] = [0; 3].map(|_| {
                state = super::super::noise::mix(state + 1);
                f64::from(state) / 1e8 - 20.0
            });
            let p = DVec3::new(x, y, z);
            let found = nearest::<f64>(p, 5);
            let [first, second] = slowly(p, 5);
            assert_eq!((found.first, found.second), (first, second), "{p}");
            assert!(first <= 1.7321);
            far += u32::from(second > 1.0);
        }
        assert!(far > 100, "{far} places had to look beyond the cells around");
    }

    #[test]
    fn a_place_at_a_point_has_no_distance() {
        for seed in 0..50 {
            let hash = hash_cell([3, 4, 5], seed);
            let [x, y, z] = [0, 10, 20].map(|shift| tenth_bits::<f64>(hash, shift));
            let found = nearest::<f64>(DVec3::new(3.0 + x, 4.0 + y, 5.0 + z), seed);
            assert_eq!((found.first, found.cell), (0.0, hash));
            assert!(found.second > 0.0);
        }
    }
}
