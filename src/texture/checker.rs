//! Alternate cells of two paints.

use super::{Paint, Spot};
use crate::place::Placement;
use crate::scalar::{Scalar, Vector};

/// Which coordinates a pattern is drawn in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mapping {
    /// The surface's own two.
    Uv,
    /// The three of the scene, or of the texture's placement.
    Solid,
}

/// Squares on a surface, or cubes through a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checker<S: Scalar> {
    /// The paint of the cell at the origin, and the other.
    pub paints: [Paint<S>; 2],
    /// The edges of a cell; greater than 0. Two are used of a surface's own coordinates.
    pub size: S::Vec3,
    /// Which coordinates it is drawn in.
    pub mapping: Mapping,
    /// The placement whose local coordinates a solid checker is drawn in.
    pub placement: Option<u16>,
}

impl<S: Scalar> Checker<S> {
    pub(super) fn at(&self, spot: &Spot<S>, placements: &[Placement<S>]) -> Paint<S> {
        let position = match self.mapping {
            Mapping::Uv => S::Vec3::new(spot.uv[0], spot.uv[1], S::ZERO),
            Mapping::Solid => {
                match self.placement.and_then(|index| placements.get(usize::from(index))) {
                    Some(place) => S::narrow_vec(place.local(spot.position)),
                    None => spot.position,
                }
            }
        };
        let cell = |v: S, size: S| (v / size).floor_i64();
        let [x, y, z] = [
            cell(position.x(), self.size.x()),
            cell(position.y(), self.size.y()),
            cell(position.z(), self.size.z()),
        ];
        let [even, odd] = self.paints;
        if (x ^ y ^ z) & 1 == 0 { even } else { odd }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::color::Rgb;
    use crate::place::Affine;
    use crate::scalar::Axis;

    fn checker(mapping: Mapping, placement: Option<u16>) -> Checker<f64> {
        let paints = [Paint::Solid(Rgb::WHITE), Paint::Solid(Rgb::BLACK)];
        Checker { paints, size: DVec3::new(0.5, 1.0, 2.0), mapping, placement }
    }

    #[test]
    fn cells_alternate_along_every_axis() {
        let checker = checker(Mapping::Solid, None);
        for x in -6..6_i32 {
            for y in -6..6_i32 {
                for z in -6..6_i32 {
                    // The middles of the cells.
                    let cell = DVec3::new(x.into(), y.into(), z.into()) + 0.5;
                    let position = cell * checker.size;
                    let even = (x + y + z).rem_euclid(2) == 0;
                    let expected = checker.paints[usize::from(!even)];
                    assert_eq!(checker.at(&Spot { position, uv: [0.0; 2] }, &[]), expected);
                }
            }
        }
    }

    #[test]
    fn surface_coordinates_and_placements_are_followed() {
        let spot = Spot { position: DVec3::new(0.7, 0.2, 0.2), uv: [0.2, 0.3] };
        let [even, odd] = checker(Mapping::Uv, None).paints;
        assert_eq!(checker(Mapping::Uv, None).at(&spot, &[]), even);
        assert_eq!(checker(Mapping::Uv, None).at(&Spot { uv: [0.6, 0.3], ..spot }, &[]), odd);
        assert_eq!(checker(Mapping::Solid, None).at(&spot, &[]), odd);
        // Turned by a right angle about z, x becomes y: one cell of 1 holds 0.7.
        let turned = Placement::new(&Affine::rotate(Axis::Z, 90.0)).unwrap();
        let found = checker(Mapping::Solid, Some(0)).at(&spot, &[turned]);
        assert_eq!(found, odd, "x of the texture is y of the scene, y is −x");
    }

    #[test]
    fn any_number_has_a_cell() {
        let checker = checker(Mapping::Solid, None);
        for x in [f64::MAX, -f64::MAX, f64::INFINITY, f64::NAN, -0.0, 1e-300] {
            let found = checker.at(&Spot { position: DVec3::splat(x), uv: [x; 2] }, &[]);
            assert!(checker.paints.contains(&found));
        }
    }
}
