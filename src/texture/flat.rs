//! Tilings.

use super::noise::hash_cell;
use super::pattern::{Sample, Stroke, split};
use crate::scalar::Scalar;

/// Squares or cubes in turn along every axis.
pub(super) fn checker<S: Scalar>(p: [S; 3]) -> Sample<S> {
    let [x, y, z] = p.map(|v| split(v).0);
    Sample::Part(x.wrapping_add(y).wrapping_add(z))
}

/// Bricks, and the mortar between them.
pub(super) fn brick<S: Scalar>([x, y, z]: [S; 3], mortar: S, stroke: &Stroke<S>) -> Sample<S> {
    let (row, height) = split(y);
    let shift = if row & 1 == 1 { S::HALF } else { S::ZERO };
    let (column, along) = split(x + shift);
    let (layer, across) = if stroke.is_flat { (0, S::ONE) } else { split(z + shift) };
    // Joints are equally wide whatever the edges of a brick.
    let [wide, high, deep] = stroke.size;
    let thin = |part: S, edge: S| mortar > S::ZERO && part * edge < mortar * high;
    if thin(height, high) || thin(along, wide) || (!stroke.is_flat && thin(across, deep)) {
        return Sample::Joint;
    }
    Sample::Part(hash_cell([column, row, layer], stroke.seed) >> 1)
}

/// Hexagons with a flat side to either side, and the gaps between them.
///
/// In axes at 60 degrees the centres have whole coordinates; the nearest is found by rounding three coordinates
/// whose sum is 0, and mending the one that was rounded most.
pub(super) fn hexagons<S: Scalar>(x: S, y: S, gap: S) -> Sample<S> {
    let second = y * (S::TWO / S::from_i32(3).sqrt());
    let first = x - second * S::HALF;
    let third = -first - second;
    let nearest = |v: S| (v + S::HALF).floor();
    let [mut i, mut j, k] = [first, second, third].map(nearest);
    let [off_i, off_j, off_k] =
        [(i, first), (j, second), (k, third)].map(|(near, v)| (near - v).abs());
    if off_i > off_j && off_i > off_k {
        i = -j - k;
    } else if off_j > off_k {
        j = -i - k;
    }
    let (a, b) = (first - i, second - j);
    // How far the place is from the centre, across each of the three pairs of sides.
    let (one, two) = ((a + b * S::HALF).abs(), (b + a * S::HALF).abs());
    let out = one.max(two).max(((b - a) * S::HALF).abs());
    if gap > S::ZERO && out > (S::ONE - gap) * S::HALF {
        return Sample::Joint;
    }
    // i − j in threes: neighbours are of different sorts.
    Sample::Part((i - j).floor_i64().rem_euclid(3) as u32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::noise::Octaves;

    fn part(sample: &Sample<f64>) -> Option<u32> {
        match sample {
            Sample::Part(part) => Some(*part),
            _ => None,
        }
    }

    #[test]
    fn cells_alternate_along_every_axis() {
        for x in -6..6_i32 {
            for y in -6..6_i32 {
                for z in -6..6_i32 {
                    // The middles of the cells.
                    let p = [x, y, z].map(|v| f64::from(v) + 0.5);
                    let odd = part(&checker(p)).map(|part| part & 1);
                    assert_eq!(odd, Some((x + y + z).rem_euclid(2) as u32));
                }
            }
        }
    }

    #[test]
    fn bricks_lie_in_rows() {
        let stroke =
            Stroke { size: [3.0, 1.0, 2.0], is_flat: true, octaves: Octaves::ONE, seed: 1 };
        let at = |x, y| part(&brick([x, y, 0.0], 0.3, &stroke));
        // A joint of 0.3 is a tenth of the length of a brick.
        for (x, y) in [(0.05, 0.5), (0.5, 0.2), (0.55, 1.5), (0.5, -0.9), (-0.95, 0.5)] {
            assert_eq!(at(x, y), None, "{x} {y} is a joint");
        }
        // One brick from joint to joint, another in the next column and in the next row.
        let brick = at(0.15, 0.5);
        assert!(brick.is_some() && brick == at(0.95, 0.95));
        for (x, y) in [(1.5, 0.5), (0.3, 1.5), (0.9, 1.5), (0.3, -0.5)] {
            assert!(at(x, y).is_some() && at(x, y) != brick, "{x} {y} is another brick");
        }
        assert_eq!(at(0.65, 1.5), at(1.45, 1.5));
    }

    #[test]
    fn hexagons_touch_only_others() {
        let height = libm::sqrt(3.0) / 2.0;
        for column in -5..5_i32 {
            for row in -5..5_i32 {
                let centre = |column: i32, row: i32| {
                    let (x, y) = (f64::from(column), f64::from(row));
                    part(&hexagons(x + y / 2.0, y * height, 0.1)).unwrap()
                };
                let own = centre(column, row);
                for (right, up) in [(1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1)] {
                    assert_ne!(own, centre(column + right, row + up));
                }
                // The middle of each side is in the gap, and so are the corners.
                let (x, y) = (f64::from(column) + f64::from(row) / 2.0, f64::from(row) * height);
                for (right, up) in [(0.5, 0.0), (0.25, height / 2.0), (0.0, 1.0 / libm::sqrt(3.0))]
                {
                    assert_eq!(part(&hexagons(x + right, y + up, 0.1)), None);
                    assert!(part(&hexagons(x + right * 0.8, y + up * 0.8, 0.1)).is_some());
                }
            }
        }
    }
}
