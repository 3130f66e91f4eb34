//! Placements as people write them: a list of moves, multiplied into one map.

use nostray::glam::DVec3;
use nostray::{Affine, Axis, Scalar, Vector};

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
    let vector = |v: DVec3| S::Vec3::from_array(v.to_array().map(S::from_f64));
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
    let turned = |v: DVec3| v * cos + axis.cross(v) * sin + axis * (axis.dot(v) * (1.0 - cos));
    let columns = [DVec3::X, DVec3::Y, DVec3::Z].map(turned);
    let row = |axis: Axis| DVec3::from_array(columns.map(|column| Vector::get(column, axis)));
    Affine { rows: Axis::ALL.map(row), offset: DVec3::ZERO }
}
