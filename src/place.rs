//! Placement: where a solid stands, and the way between its own coordinates and the scene's.

use crate::ray::Line;
use crate::scalar::{Axis, Number, Real, Scalar, Vector};

/// Three rows of a matrix.
pub type Rows<S> = [<S as Scalar>::WideVec; 3];

/// `rows · v`.
#[inline]
pub(crate) fn apply<S: Scalar>(rows: &Rows<S>, v: S::WideVec) -> S::WideVec {
    let [a, b, c] = *rows;
    S::WideVec::new(a.dot(v), b.dot(v), c.dot(v))
}

/// `rowsᵀ · v`.
#[inline]
pub(crate) fn apply_transposed<S: Scalar>(rows: &Rows<S>, v: S::WideVec) -> S::WideVec {
    let [a, b, c] = *rows;
    a * v.x() + b * v.y() + c * v.z()
}

fn transpose<S: Scalar>(rows: &Rows<S>) -> Rows<S> {
    Axis::ALL.map(|axis| {
        let [a, b, c] = rows.map(|row| row.get(axis));
        S::WideVec::new(a, b, c)
    })
}

fn identity<S: Scalar>() -> Rows<S> {
    Axis::ALL.map(|axis| S::WideVec::ZERO.with(axis, S::Wide::ONE))
}

/// Two unit vectors at right angles to each other and to a unit vector.
///
/// Source: T. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6 (2017).
pub(crate) fn aside<V: Vector<Scalar: Real>>(axis: V) -> [V; 2] {
    let [x, y, z] = axis.to_array();
    let (zero, one) = (V::Scalar::ZERO, V::Scalar::ONE);
    let sign = if z < zero { -one } else { one };
    let a = -(one / (sign + z));
    let b = x * y * a;
    [V::new(one + sign * x * x * a, sign * b, -(sign * x)), V::new(b, sign + y * y * a, -y)]
}

/// An affine map: `rows · p + offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine<S: Scalar> {
    /// The linear part.
    pub rows: Rows<S>,
    /// The translation, applied last.
    pub offset: S::WideVec,
}

impl<S: Scalar> Affine<S> {
    /// The map that changes nothing.
    pub fn identity() -> Self {
        Self { rows: identity::<S>(), offset: S::WideVec::ZERO }
    }

    /// A translation.
    pub fn translate(by: S::Vec3) -> Self {
        Self { offset: S::widen_vec(by), ..Self::identity() }
    }

    /// A scale by a factor along each axis.
    pub fn scale(by: S::Vec3) -> Self {
        let mut affine = Self::identity();
        for (row, factor) in affine.rows.iter_mut().zip(S::widen_vec(by).to_array()) {
            *row = *row * factor;
        }
        affine
    }

    /// A right-handed rotation about a coordinate axis, by an angle in degrees. Multiples of
    /// 90 degrees are exact.
    pub fn rotate(axis: Axis, degrees: S) -> Self {
        let (sin, cos) = sin_cos_degrees::<S>(degrees);
        let (u, v) = (axis.next(), axis.next().next());
        let mut affine = Self::identity();
        for (row, of) in affine.rows.iter_mut().zip(Axis::ALL) {
            if of == u {
                *row = S::WideVec::ZERO.with(u, cos).with(v, -sin);
            } else if of == v {
                *row = S::WideVec::ZERO.with(u, sin).with(v, cos);
            }
        }
        affine
    }

    /// This map, and then another.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        let columns = transpose::<S>(&self.rows);
        Self {
            rows: next.rows.map(|row| {
                let [a, b, c] = columns.map(|column| row.dot(column));
                S::WideVec::new(a, b, c)
            }),
            offset: next.wide_point(self.offset),
        }
    }

    /// Where a point goes.
    pub fn point(&self, p: S::Vec3) -> S::Vec3 {
        S::narrow_vec(self.wide_point(S::widen_vec(p)))
    }

    /// Where a point goes that is not rounded yet.
    pub(crate) fn wide_point(&self, p: S::WideVec) -> S::WideVec {
        apply::<S>(&self.rows, p) + self.offset
    }

    /// Every number is finite.
    pub(crate) fn is_finite(&self) -> bool {
        self.rows.iter().chain([&self.offset]).all(|row| row.is_finite())
    }

    /// The determinant of the linear part.
    pub fn determinant(&self) -> S::Wide {
        let [a, b, c] = self.rows;
        a.dot(b.cross(c))
    }

    /// The inverse of the linear part, or `None` where the map flattens space (a determinant
    /// within rounding of 0).
    pub fn inverse_rows(&self) -> Option<Rows<S>> {
        let [a, b, c] = self.rows;
        let det = self.determinant();
        let size = a.length() * b.length() * c.length();
        let least = size * S::Wide::EPSILON * S::Wide::from_i32(4);
        let invertible = size.is_finite() && det.abs() > least;
        if !invertible {
            return None;
        }
        let inverse = S::Wide::ONE / det;
        let columns = [b.cross(c) * inverse, c.cross(a) * inverse, a.cross(b) * inverse];
        let finite = columns.iter().all(|column| column.is_finite());
        finite.then(|| transpose::<S>(&columns))
    }

    /// The factor of a similarity (rotation, reflection and one scale), or `None` where
    /// lengths change by different factors in different directions.
    pub fn similarity(&self) -> Option<S::Wide> {
        let [a, b, c] = transpose::<S>(&self.rows);
        let (aa, bb, cc) = (a.length_squared(), b.length_squared(), c.length_squared());
        let within = aa * S::Wide::EPSILON * S::Wide::from_i32(16);
        let right = |u: S::WideVec, v: S::WideVec| u.dot(v).abs() <= within;
        let equal = |u: S::Wide, v: S::Wide| (u - v).abs() <= within;
        (equal(aa, bb) && equal(aa, cc) && right(a, b) && right(b, c) && right(c, a))
            .then(|| if bb == aa && cc == aa { aa.sqrt() } else { a.length() })
    }
}

/// Sine and cosine of an angle in degrees; exact at multiples of 90.
pub(crate) fn sin_cos_degrees<S: Scalar>(degrees: S) -> (S::Wide, S::Wide) {
    let (zero, one) = (S::Wide::ZERO, S::Wide::ONE);
    let turn = S::from_i32(360);
    let reduced = degrees - (degrees / turn).floor() * turn;
    let quarter = S::from_i32(90);
    if reduced == S::ZERO {
        (zero, one)
    } else if reduced == quarter {
        (one, zero)
    } else if reduced == quarter * S::TWO {
        (zero, -one)
    } else if reduced == quarter * S::from_i32(3) {
        (-one, zero)
    } else {
        (reduced.widen() * S::Wide::PI / S::Wide::from_i32(180)).sin_cos()
    }
}

/// The coordinates of a placed leaf: `local = to_local · (world − anchor)`.
///
/// Rays are recentred on the anchor before they are transformed, so precision does not
/// depend on how far away they start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement<S: Scalar> {
    /// The origin of the local coordinates, in the scene.
    pub anchor: S::Vec3,
    /// From directions in the scene to local ones.
    pub to_local: Rows<S>,
    /// From local directions to the scene's: the inverse of `to_local`.
    pub to_world: Rows<S>,
    /// Lengths are the same on both sides.
    pub rigid: bool,
}

impl<S: Scalar> Placement<S> {
    /// The placement of coordinates whose map to the scene is given; `None` where that map
    /// is singular.
    pub fn new(to_world: &Affine<S>) -> Option<Self> {
        let rigid = to_world.similarity().is_some_and(|factor| {
            (factor - S::Wide::ONE).abs() <= S::Wide::EPSILON * S::Wide::from_i32(8)
        });
        let to_local = to_world.inverse_rows()?;
        let anchor = S::narrow_vec(to_world.offset);
        Some(Self { anchor, to_local, to_world: to_world.rows, rigid })
    }

    /// A point of the scene for a local one.
    #[inline]
    pub fn point(&self, local: S::Vec3) -> S::Vec3 {
        S::narrow_vec(apply::<S>(&self.to_world, S::widen_vec(local)) + S::widen_vec(self.anchor))
    }

    /// A point of the scene in local coordinates.
    #[inline]
    pub fn local(&self, point: S::Vec3) -> S::WideVec {
        apply::<S>(&self.to_local, S::widen_vec(point) - S::widen_vec(self.anchor))
    }

    /// A direction of the scene at right angles to a surface, for a local one; not of unit length.
    #[inline]
    pub fn normal(&self, local: S::WideVec) -> S::WideVec {
        apply_transposed::<S>(&self.to_local, local)
    }
}

/// A ray in the coordinates of one leaf, moved along itself to the leaf's neighbourhood:
/// the point at `t` is `origin + (t − shift)·dir`.
#[derive(Clone, Copy, Debug)]
pub struct Local<S: Scalar> {
    /// The parameter of `origin` on the ray.
    pub shift: S,
    /// A point of the ray near the leaf's centre.
    pub origin: S::WideVec,
    /// The direction, in local coordinates.
    pub dir: S::WideVec,
    /// `dir · dir`.
    pub dd: S::Wide,
    /// `1 / (dir · dir)`.
    pub inv_dd: S::Wide,
}

impl<S: Scalar> Local<S> {
    /// The ray recentred on a leaf that stands at `centre` without a placement, or whose
    /// placement is given (then `centre` is its anchor).
    #[inline]
    pub fn recentred(line: &Line<S>, place: Option<&Placement<S>>, centre: S::Vec3) -> Self {
        let dir = line.heading();
        let Some(place) = place else {
            let shift = line.approach(centre);
            let origin = line.recentred(centre, shift);
            return Self { shift, origin, dir, dd: line.dd, inv_dd: line.inv_dd };
        };
        let dir = apply::<S>(&place.to_local, dir);
        let (dd, inv_dd, shift) = if place.rigid {
            (line.dd, line.inv_dd, line.approach(place.anchor))
        } else {
            // Nearest to the anchor as the leaf measures it: any shift is exact by definition.
            let dd = dir.length_squared();
            let inv_dd = S::Wide::ONE / dd;
            (dd, inv_dd, S::narrow(-place.local(line.origin).dot(dir) * inv_dd))
        };
        let origin = apply::<S>(&place.to_local, line.recentred(place.anchor, shift));
        Self { shift, origin, dir, dd, inv_dd }
    }

    /// The ray from a known point of the leaf's surface.
    #[inline]
    pub fn from_surface(line: &Line<S>, place: Option<&Placement<S>>, local: S::Vec3) -> Self {
        let mut dir = line.heading();
        let (mut dd, mut inv_dd) = (line.dd, line.inv_dd);
        if let Some(place) = place {
            dir = apply::<S>(&place.to_local, dir);
            if !place.rigid {
                dd = dir.length_squared();
                inv_dd = S::Wide::ONE / dd;
            }
        }
        Self { shift: S::ZERO, origin: S::widen_vec(local), dir, dd, inv_dd }
    }

    /// The ray's own parameter for one that counts from `origin`.
    #[inline]
    pub fn arrive(&self, t: S::Wide) -> S {
        S::narrow(self.shift.widen() + t)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn close(a: DVec3, b: DVec3) -> bool {
        (a - b).max_abs() <= 1e-14
    }

    #[test]
    fn rotations_are_right_handed_and_quarters_exact() {
        let quarter = |axis| Affine::<f64>::rotate(axis, 90.0);
        assert_eq!(quarter(Axis::X).point(DVec3::Y), DVec3::Z);
        assert_eq!(quarter(Axis::Y).point(DVec3::Z), DVec3::X);
        assert_eq!(quarter(Axis::Z).point(DVec3::X), DVec3::Y);
        assert_eq!(Affine::<f64>::rotate(Axis::Z, -90.0).point(DVec3::Y), DVec3::X);
        assert_eq!(Affine::<f64>::rotate(Axis::Z, 540.0).point(DVec3::X), -DVec3::X);
        let third = Affine::<f64>::rotate(Axis::Y, 120.0);
        assert!(close(
            third.then(&third).then(&third).point(DVec3::new(1.0, 2.0, 3.0)),
            DVec3::new(1.0, 2.0, 3.0)
        ));
    }

    #[test]
    fn maps_follow_one_another_in_order() {
        let p = DVec3::new(1.0, 0.0, 0.0);
        let scale = Affine::scale(DVec3::new(2.0, 3.0, 4.0));
        let turn = Affine::rotate(Axis::Z, 90.0);
        let go = Affine::translate(DVec3::new(10.0, 0.0, 0.0));
        assert_eq!(scale.then(&turn).then(&go).point(p), DVec3::new(10.0, 2.0, 0.0));
        assert_eq!(go.then(&turn).then(&scale).point(p), DVec3::new(0.0, 33.0, 0.0));
    }

    #[test]
    fn vectors_aside_are_at_right_angles() {
        for axis in [
            DVec3::X,
            DVec3::Z,
            DVec3::NEG_Z,
            DVec3::new(0.48, -0.6, 0.64),
            DVec3::new(-0.48, 0.6, -0.64),
            DVec3::new(0.6e-9, 0.8e-9, -1.0),
        ] {
            let [u, v] = aside(axis);
            let products = [u.length_squared() - 1.0, v.length_squared() - 1.0]
                .into_iter()
                .chain([Vector::dot(u, v), Vector::dot(u, axis), Vector::dot(v, axis)]);
            assert!(products.into_iter().all(|product| product.abs() <= 1e-15), "{axis}");
        }
    }

    #[test]
    fn placements_go_there_and_back() {
        let map = Affine::scale(DVec3::new(2.0, 0.5, 3.0))
            .then(&Affine::rotate(Axis::X, 33.0))
            .then(&Affine::rotate(Axis::Y, 71.0))
            .then(&Affine::translate(DVec3::new(5.0, -6.0, 7.0)));
        let place = Placement::new(&map).unwrap();
        assert!(!place.rigid);
        let p = DVec3::new(0.3, -0.4, 0.5);
        assert!(close(apply::<f64>(&place.to_local, map.point(p) - place.anchor), p));
        // A normal stays at right angles to what it was at right angles to.
        let (tangent, normal) = (DVec3::new(1.0, 2.0, 0.0), DVec3::new(2.0, -1.0, 4.0));
        let slope = Vector::dot(apply::<f64>(&map.rows, tangent), place.normal(normal));
        assert!(slope.abs() <= 1e-13);
    }

    #[test]
    fn similarities_are_told_from_other_maps() {
        let turn = Affine::<f64>::rotate(Axis::X, 12.0).then(&Affine::rotate(Axis::Z, 50.0));
        assert!(Placement::new(&turn).unwrap().rigid);
        let factor = turn.then(&Affine::scale(DVec3::splat(3.0))).similarity().unwrap();
        assert!((factor - 3.0).abs() <= 1e-14);
        assert_eq!(Affine::<f64>::scale(DVec3::splat(0.25)).similarity(), Some(0.25));
        assert_eq!(turn.then(&Affine::scale(DVec3::new(3.0, 3.0, 3.001))).similarity(), None);
        let shear =
            Affine::<f64> { rows: [DVec3::X + DVec3::Y, DVec3::Y, DVec3::Z], offset: DVec3::ZERO };
        assert_eq!(shear.similarity(), None);
    }

    #[test]
    fn flat_maps_have_no_inverse() {
        assert_eq!(Affine::<f64>::scale(DVec3::new(1.0, 0.0, 1.0)).inverse_rows(), None);
        assert_eq!(Affine::<f64>::scale(DVec3::new(1.0, f64::NAN, 1.0)).inverse_rows(), None);
        let rows =
            [DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, 5.0, 6.0), DVec3::new(7.0, 8.0, 9.0)];
        assert_eq!(Affine::<f64> { rows, offset: DVec3::ZERO }.inverse_rows(), None);
        // Very unequal scales are not flat.
        assert!(Affine::<f64>::scale(DVec3::new(1e6, 1.0, 1e-6)).inverse_rows().is_some());
    }
}
