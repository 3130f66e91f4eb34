//! From a pixel to the ray that looks through it.

use crate::place::sin_cos_degrees;
use crate::ray::Ray;
use crate::scalar::{Scalar, Vector};

/// What is seen from where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera<S: Scalar> {
    /// Where the viewer is.
    pub eye: S::Vec3,
    /// The point in the middle of the picture.
    pub look_at: S::Vec3,
    /// A direction that points up in the picture.
    pub up: S::Vec3,
    /// How the scene is drawn together.
    pub projection: Projection<S>,
}

/// How rays leave the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection<S> {
    /// Through a pinhole; the full vertical angle in degrees, between 0 and 180.
    Pinhole {
        /// The angle from the lower to the upper edge of the picture, in degrees.
        fov: S,
    },
    /// In parallel.
    Orthographic {
        /// The height of the picture in the scene.
        height: S,
    },
}

/// Why a camera cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CameraFlaw {
    NotFinite(&'static str),
    Range(&'static str),
    Empty(&'static str),
}

impl<S: Scalar> Camera<S> {
    pub(crate) fn check(&self) -> Result<(), CameraFlaw> {
        for (v, field) in [(self.eye, "eye"), (self.look_at, "look_at"), (self.up, "up")] {
            if !v.is_finite() {
                return Err(CameraFlaw::NotFinite(field));
            }
            if v.max_abs() > S::COORD_MAX {
                return Err(CameraFlaw::Range(field));
            }
        }
        let forward = (self.look_at - self.eye).normalize();
        if forward == S::Vec3::ZERO {
            return Err(CameraFlaw::Empty("look_at"));
        }
        // `up` within rounding of the line of sight leaves the picture free to turn.
        if forward.cross(self.up.normalize()).length() <= S::EPSILON * S::from_i32(16) {
            return Err(CameraFlaw::Empty("up"));
        }
        match self.projection {
            Projection::Pinhole { fov } if !fov.is_finite() => Err(CameraFlaw::NotFinite("fov")),
            Projection::Pinhole { fov } if !(fov > S::ZERO && fov < S::from_i32(180)) => {
                Err(CameraFlaw::Range("fov"))
            }
            Projection::Orthographic { height } if !height.is_finite() => {
                Err(CameraFlaw::NotFinite("height"))
            }
            Projection::Orthographic { height }
                if !(height >= S::LENGTH_MIN && height <= S::COORD_MAX) =>
            {
                Err(CameraFlaw::Range("height"))
            }
            _ => Ok(()),
        }
    }
}

/// A camera and a picture size, ready to give rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens<S: Scalar> {
    eye: S::Vec3,
    forward: S::Vec3,
    /// From the middle of the picture to its right edge, at distance 1 (or on the film).
    right: S::Vec3,
    /// From the middle of the picture to its upper edge.
    up: S::Vec3,
    parallel: bool,
    width: u32,
    height: u32,
}

impl<S: Scalar> Lens<S> {
    /// The rays of a camera for a picture of so many square pixels.
    pub fn new(camera: &Camera<S>, width: u32, height: u32) -> Self {
        let forward = (camera.look_at - camera.eye).normalize();
        let right = forward.cross(camera.up).normalize();
        let up = right.cross(forward);
        let (half, parallel) = match camera.projection {
            Projection::Pinhole { fov } => {
                let (sin, cos) = sin_cos_degrees(fov * S::HALF);
                (sin / cos, false)
            }
            Projection::Orthographic { height } => (height * S::HALF, true),
        };
        let aspect = S::from_ratio(width as i32, height as i32);
        Self {
            eye: camera.eye,
            forward,
            right: right * (half * aspect),
            up: up * half,
            parallel,
            width,
            height,
        }
    }

    /// The ray through a point of a pixel; `offset` in 0..1 counts from its upper left corner,
    /// (½, ½) is its middle. The direction has unit length.
    #[inline]
    pub fn ray(&self, x: u32, y: u32, offset: [S; 2]) -> Ray<S> {
        // (2·(x + offset) − width) / width: the whole numbers cancel before they are rounded.
        let across = |index: u32, size: u32, offset: S| {
            let doubled = 2 * index as i32 - size as i32;
            (S::from_i32(doubled) + offset * S::TWO) / S::from_i32(size as i32)
        };
        let h = across(x, self.width, offset[0]);
        let v = -across(y, self.height, offset[1]);
        let aside = self.right * h + self.up * v;
        if self.parallel {
            Ray { origin: self.eye + aside, dir: self.forward }
        } else {
            Ray { origin: self.eye, dir: (self.forward + aside).normalize() }
        }
    }
}
