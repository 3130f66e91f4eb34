//! Placements as people write them: a list of moves, multiplied into one map.

use nostray::glam::DVec3;
use nostray::{Affine, Axis, Real, Scalar, Vector};

use crate::document::Move;
use crate::flaw::{Flaw, Path};
use crate::written::{Factor, Triple};

/// The map of a list of moves, applied in order.
///
/// # Errors
/// The first move that is not legal: a number that is not finite, a factor of 0, an axis
/// without direction.
pub(crate) fn compose(moves: &[Move], path: &Path<'_>) -> Result<Affine<f64>, Flaw> {
    let mut whole = Affine::identity();
    for (index, step) in moves.iter().enumerate() {
        whole = whole.then(&affine(step, &path.entry(index))?);
    }
    Ok(whole)
}

/// The same map in another number format.
pub(crate) fn converted<S: Scalar>(map: &Affine<f64>) -> Affine<S> {
    let vector = |v: DVec3| S::WideVec::from_array(v.to_array().map(S::Wide::from_f64));
    Affine { rows: map.rows.map(vector), offset: vector(map.offset) }
}

/// Sine and cosine of an angle in degrees, the same on every platform.
pub(crate) fn sin_cos_degrees(degrees: f64) -> (f64, f64) {
    let [first, second, _] = Affine::rotate(Axis::Z, degrees).rows;
    (second.x, first.x)
}

fn affine(step: &Move, path: &Path<'_>) -> Result<Affine<f64>, Flaw> {
    match *step {
        Move::Translate(Triple(by)) => {
            let path = path.field("Translate");
            Ok(Affine::translate(DVec3::from_array(finite(by, &path)?)))
        }
        Move::Scale(Factor(by)) => {
            let path = path.field("Scale");
            let by = finite(by, &path)?;
            if by.contains(&0.0) {
                return Err(Flaw::new(path, "a factor must not be 0"));
            }
            Ok(Affine::scale(DVec3::from_array(by)))
        }
        Move::RotateX(degrees) => turn(Axis::X, degrees, &path.field("RotateX")),
        Move::RotateY(degrees) => turn(Axis::Y, degrees, &path.field("RotateY")),
        Move::RotateZ(degrees) => turn(Axis::Z, degrees, &path.field("RotateZ")),
        Move::Rotate { axis: Triple(axis), degrees } => {
            let path = path.field("Rotate");
            let axis = DVec3::from_array(finite(axis, &path.field("axis"))?);
            if axis == DVec3::ZERO {
                return Err(Flaw::new(path.field("axis"), "must not be zero"));
            }
            let [degrees] = finite([degrees], &path.field("degrees"))?;
            Ok(turn_about(Vector::normalize(axis), degrees))
        }
    }
}

fn finite<const N: usize>(numbers: [f64; N], path: &Path<'_>) -> Result<[f64; N], Flaw> {
    if numbers.iter().all(|number| number.is_finite()) {
        Ok(numbers)
    } else {
        Err(Flaw::new(path, "is not a finite number"))
    }
}

fn turn(axis: Axis, degrees: f64, path: &Path<'_>) -> Result<Affine<f64>, Flaw> {
    let [degrees] = finite([degrees], path)?;
    Ok(Affine::rotate(axis, degrees))
}

/// The rotation about a unit vector, by the formula of O. Rodrigues (1840).
fn turn_about(axis: DVec3, degrees: f64) -> Affine<f64> {
    let (sin, cos) = sin_cos_degrees(degrees);
    let turned = |v: DVec3| {
        v * cos + Vector::cross(axis, v) * sin + axis * (Vector::dot(axis, v) * (1.0 - cos))
    };
    let columns = [DVec3::X, DVec3::Y, DVec3::Z].map(turned);
    let row = |axis: Axis| DVec3::from_array(columns.map(|column| Vector::get(column, axis)));
    Affine { rows: Axis::ALL.map(row), offset: DVec3::ZERO }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail loudly")]

    use super::*;

    fn whole(moves: &[Move]) -> Affine<f64> {
        compose(moves, &Path::Root).unwrap()
    }

    #[test]
    fn rotations_about_an_axis_are_those_about_its_coordinate() {
        for (axis, turn) in [
            ([2.0, 0.0, 0.0], Move::RotateX as fn(f64) -> Move),
            ([0.0, 0.5, 0.0], Move::RotateY),
            ([0.0, 0.0, 1.0], Move::RotateZ),
        ] {
            for degrees in [-720.0, -30.0, 0.0, 45.0, 90.0, 180.0, 270.0, 1e3] {
                let any = whole(&[Move::Rotate { axis: Triple(axis), degrees }]);
                let own = whole(&[turn(degrees)]);
                for (a, b) in any.rows.iter().zip(own.rows) {
                    assert!(Vector::length(*a - b) < 1e-15, "{degrees} about {axis:?}");
                }
            }
        }
    }

    #[test]
    fn a_rotation_about_the_diagonal_turns_the_axes_round() {
        let turn = Move::Rotate { axis: Triple([1.0, 1.0, 1.0]), degrees: 120.0 };
        let turned = whole(&[turn]).point(DVec3::X);
        assert!(Vector::length(turned - DVec3::Y) < 1e-15, "{turned}");
    }

    #[test]
    fn moves_are_applied_in_order() {
        let moves = [
            Move::Translate(Triple([1.0, 0.0, 0.0])),
            Move::Scale(Factor([2.0, 3.0, 4.0])),
            Move::RotateZ(90.0),
        ];
        assert_eq!(whole(&moves).point(DVec3::new(0.0, 1.0, 1.0)), DVec3::new(-3.0, 2.0, 4.0));
    }

    #[test]
    fn flaws_are_told_by_their_place() {
        let flaw = |step: Move| compose(&[step], &Path::Root.field("place")).unwrap_err().path;
        assert_eq!(flaw(Move::Scale(Factor([1.0, 0.0, 1.0]))), "place[0].Scale");
        assert_eq!(flaw(Move::Scale(Factor([f64::NAN; 3]))), "place[0].Scale");
        assert_eq!(flaw(Move::RotateX(f64::INFINITY)), "place[0].RotateX");
        let axis = Triple::default();
        assert_eq!(flaw(Move::Rotate { axis, degrees: 1.0 }), "place[0].Rotate.axis");
    }
}
