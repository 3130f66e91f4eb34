//! Any of the solids: what one says, said by whichever it is.

use super::{
    Blob, Cone, Cuboid, Cylinder, Flaw, Implicit, Lathe, Mesh, Patches, Plane, Polygon, Primitive,
    Prism, Quadric, Sight, Sphere, Tables, Torus, Triangle,
};
use crate::bounds::Bounds;
use crate::needs::{self, has};
use crate::place::Placement;
use crate::scalar::{Scalar, Vector};
use crate::span::{End, Passage, Span};

/// Any of the solids.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape<S: Scalar> {
    /// A ball; an ellipsoid when placed with unequal scales.
    Sphere(Sphere<S>),
    /// A half-space.
    Plane(Plane<S>),
    /// A box.
    Box(Cuboid<S>),
    /// A cylinder with its caps.
    Cylinder(Cylinder<S>),
    /// A cone or frustum with its caps.
    Cone(Cone<S>),
    /// A torus.
    Torus(Torus<S>),
    /// A surface of revolution, closed or open.
    Lathe(Lathe<S>),
    /// An extruded polygon.
    Prism(Prism<S>),
    /// The inside of a quadric.
    Quadric(Quadric<S>),
    /// A triangle, an open surface.
    Triangle(Triangle),
    /// A plane polygon, an open surface.
    Polygon(Polygon<S>),
    /// Where a formula is less than 0, within a box.
    Implicit(Implicit<S>),
    /// Metaballs whose fields add up.
    Blob(Blob<S>),
    /// Many triangles, open or closed.
    Mesh(Mesh),
    /// Bicubic Bézier patches, an open surface.
    Patches(Patches<S>),
}

/// What a shape says, if the needs name it; otherwise there is no such shape in the scene.
macro_rules! each {
    ($needs:expr, $shape:expr, $inner:ident => $body:expr, $none:expr) => {
        match $shape {
            Shape::Sphere($inner) if has($needs, needs::SPHERE) => $body,
            Shape::Plane($inner) if has($needs, needs::PLANE) => $body,
            Shape::Box($inner) if has($needs, needs::BOX) => $body,
            Shape::Cylinder($inner) if has($needs, needs::CYLINDER) => $body,
            Shape::Cone($inner) if has($needs, needs::CONE) => $body,
            Shape::Torus($inner) if has($needs, needs::TORUS) => $body,
            Shape::Lathe($inner) if has($needs, needs::LATHE) => $body,
            Shape::Prism($inner) if has($needs, needs::PRISM) => $body,
            Shape::Quadric($inner) if has($needs, needs::QUADRIC) => $body,
            Shape::Triangle($inner) if has($needs, needs::TRIANGLE) => $body,
            Shape::Polygon($inner) if has($needs, needs::POLYGON) => $body,
            Shape::Implicit($inner) if has($needs, needs::IMPLICIT) => $body,
            Shape::Blob($inner) if has($needs, needs::BLOB) => $body,
            Shape::Mesh($inner) if has($needs, needs::MESH) => $body,
            Shape::Patches($inner) if has($needs, needs::PATCHES) => $body,
            _ => $none,
        }
    };
}

impl<S: Scalar> Shape<S> {
    /// A surface without an inside.
    pub const fn is_open(&self) -> bool {
        match self {
            Self::Triangle(_) | Self::Polygon(_) | Self::Patches(_) => true,
            Self::Lathe(lathe) => lathe.is_open(),
            Self::Mesh(mesh) => !mesh.closed,
            _ => false,
        }
    }

    /// The greatest number of spans along any ray.
    ///
    /// Nothing less is certain of a mesh than that a ray meets each triangle once.
    pub const fn spans_max(&self) -> u32 {
        match self {
            Self::Sphere(_) | Self::Plane(_) | Self::Box(_) | Self::Cylinder(_) | Self::Cone(_) => {
                1
            }
            Self::Torus(_) | Self::Quadric(_) => 2,
            Self::Lathe(lathe) => lathe.spans_max() as u32,
            Self::Prism(prism) => prism.spans_max() as u32,
            Self::Triangle(_) | Self::Polygon(_) => 1,
            Self::Implicit(implicit) => implicit.spans as u32,
            Self::Blob(blob) => blob.spans_max(),
            Self::Mesh(mesh) if mesh.closed => mesh.triangles / 2,
            Self::Mesh(mesh) => mesh.triangles,
            Self::Patches(patches) => patches.hits_max() as u32,
        }
    }

    /// The greatest number of boundaries along any ray.
    pub const fn boundaries_max(&self) -> u32 {
        match self {
            Self::Mesh(mesh) => mesh.triangles,
            // An open surface: each is a touch.
            Self::Patches(patches) => patches.hits_max() as u32,
            _ => 2 * self.spans_max(),
        }
    }

    /// Where the local coordinates of an unplaced shape have their origin.
    #[inline]
    pub fn centre(&self) -> S::Vec3 {
        each!(needs::ALL, self, shape => Primitive::<S>::centre(shape), S::Vec3::default())
    }

    /// Whether every parameter is legal.
    ///
    /// # Errors
    /// The first parameter that is not.
    pub fn check(&self, placed: bool, tables: &Tables<'_, S>) -> Result<(), Flaw> {
        self.check_for::<{ needs::ALL }>(placed, tables)
    }

    /// The same for one of the solids that are needed; of others there is no code.
    pub(crate) fn check_for<const NEEDS: u64>(
        &self,
        placed: bool,
        tables: &Tables<'_, S>,
    ) -> Result<(), Flaw> {
        each!(NEEDS, self, shape => Primitive::<S>::check(shape, placed, tables), Err(Flaw::NotNeeded))
    }

    /// A box around the shape, infinite for a half-space.
    pub fn bounds(&self, place: Option<&Placement<S>>, tables: &Tables<'_, S>) -> Bounds<S> {
        self.bounds_for::<{ needs::ALL }>(place, tables)
    }

    /// The same for one of the solids that are needed.
    pub(crate) fn bounds_for<const NEEDS: u64>(
        &self,
        place: Option<&Placement<S>>,
        tables: &Tables<'_, S>,
    ) -> Bounds<S> {
        each!(NEEDS, self, shape => Primitive::<S>::bounds(shape, place, tables), Bounds::nothing())
    }

    /// Gives each span of the ray inside the shape, in ascending order, behind the origin too.
    /// Of a ray that starts on the shape's own surface only what lies ahead is given.
    ///
    /// A ray in a flat face is inside; one that only touches a curved side or an edge is not.
    /// A component of the direction whose reciprocal is infinite counts as 0. No span is empty:
    /// one that is shorter than the numbers are apart ends at the next number.
    #[inline]
    pub fn spans(&self, sight: &Sight<'_, S>, emit: impl FnMut(Span<S>)) {
        self.spans_until(sight, S::FAR, emit);
    }

    /// The same, but only the boundaries up to `until` are asked for: others may be missing, or lie
    /// elsewhere beyond it.
    #[inline]
    pub fn spans_until(&self, sight: &Sight<'_, S>, until: S, emit: impl FnMut(Span<S>)) {
        self.spans_within::<{ needs::ALL }>(sight, [-S::FAR, until], emit);
    }

    /// The same of a part of the ray: only the boundaries after its start and up to its end are asked for, and
    /// whether its start is inside.
    #[inline]
    pub(crate) fn spans_within<const NEEDS: u64>(
        &self,
        sight: &Sight<'_, S>,
        window: [S; 2],
        mut emit: impl FnMut(Span<S>),
    ) {
        let open = self.is_open();
        let emit = |span: Span<S>| emit(if open { span } else { span.solid() });
        each!(NEEDS, self, shape => Primitive::<S>::spans_within(shape, sight, window, emit), ());
    }

    /// Whether a place of the ray is inside, and the first boundary after it and before another.
    #[inline]
    pub(crate) fn first<const NEEDS: u64>(
        &self,
        sight: &Sight<'_, S>,
        window: [S; 2],
    ) -> (bool, Option<(End<S>, Passage)>) {
        let open = self.is_open();
        each!(NEEDS, self, shape => Primitive::<S>::first(shape, sight, window, open), (false, None))
    }

    /// The point of a face nearest to a local point close to it.
    #[inline]
    pub fn snap(&self, local: S::WideVec, face: u32, tables: &Tables<'_, S>) -> S::Vec3 {
        self.snap_for::<{ needs::ALL }>(local, face, tables)
    }

    /// The same on one of the solids that are needed.
    #[inline]
    pub(crate) fn snap_for<const NEEDS: u64>(
        &self,
        local: S::WideVec,
        face: u32,
        tables: &Tables<'_, S>,
    ) -> S::Vec3 {
        let none = S::Vec3::default();
        each!(NEEDS, self, shape => Primitive::<S>::snap(shape, local, face, tables), none)
    }

    /// The outward normal at a local point of a face, not of unit length.
    #[inline]
    pub fn normal(&self, local: S::Vec3, face: u32, tables: &Tables<'_, S>) -> S::WideVec {
        self.normal_for::<{ needs::ALL }>(local, face, tables)
    }

    /// The same on one of the solids that are needed.
    #[inline]
    pub(crate) fn normal_for<const NEEDS: u64>(
        &self,
        local: S::Vec3,
        face: u32,
        tables: &Tables<'_, S>,
    ) -> S::WideVec {
        let none = S::WideVec::ZERO;
        each!(NEEDS, self, shape => Primitive::<S>::normal(shape, local, face, tables), none)
    }

    /// The outward normal that light sees at a local point of a face, where it is not the true one;
    /// not of unit length.
    #[inline]
    pub fn shading_normal(
        &self,
        local: S::Vec3,
        face: u32,
        tables: &Tables<'_, S>,
    ) -> Option<S::WideVec> {
        self.shading_normal_for::<{ needs::ALL }>(local, face, tables)
    }

    /// The same on one of the solids that are needed.
    #[inline]
    pub(crate) fn shading_normal_for<const NEEDS: u64>(
        &self,
        local: S::Vec3,
        face: u32,
        tables: &Tables<'_, S>,
    ) -> Option<S::WideVec> {
        each!(NEEDS, self, shape => Primitive::<S>::shading_normal(shape, local, face, tables), None)
    }

    /// The texture coordinates of a local point of a face.
    #[inline]
    pub fn uv(&self, local: S::Vec3, face: u32, tables: &Tables<'_, S>) -> [S; 2] {
        self.uv_for::<{ needs::ALL }>(local, face, tables)
    }

    /// The same on one of the solids that are needed.
    pub(crate) fn uv_for<const NEEDS: u64>(
        &self,
        local: S::Vec3,
        face: u32,
        tables: &Tables<'_, S>,
    ) -> [S; 2] {
        each!(NEEDS, self, shape => Primitive::<S>::uv(shape, local, face, tables), [S::ZERO; 2])
    }
}
