//! From a pixel to the ray that looks through it.

use crate::place::sin_cos_degrees;
use crate::ray::Ray;
use crate::sampler::disc;
use crate::scalar::{Number, Real, Scalar, Vector};

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
    /// Through a thin lens: what is not at the distance of the plane in focus is blurred, where a pixel
    /// has several samples. A single sample goes through the middle of the lens.
    ///
    /// Source: R. L. Cook, T. Porter and L. Carpenter, "Distributed Ray Tracing" (1984).
    ThinLens {
        /// The angle from the lower to the upper edge of the picture, in degrees.
        fov: S,
        /// The diameter of the lens, in units of the scene.
        aperture: S,
        /// How far the plane in focus is from the eye, along the line of sight.
        focus: S,
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
    /// A pinhole at `eye`, with its full vertical angle in degrees.
    pub const fn pinhole(eye: S::Vec3, look_at: S::Vec3, up: S::Vec3, fov: S) -> Self {
        Self { eye, look_at, up, projection: Projection::Pinhole { fov } }
    }

    pub(crate) fn check(&self) -> Result<(), CameraFlaw> {
        for (v, field) in [(self.eye, "eye"), (self.look_at, "look_at"), (self.up, "up")] {
            if !v.is_finite() {
                return Err(CameraFlaw::NotFinite(field));
            }
            if v.max_abs() > S::COORD_MAX {
                return Err(CameraFlaw::Range(field));
            }
        }
        let forward = (S::widen_vec(self.look_at) - S::widen_vec(self.eye)).normalize();
        if forward == S::WideVec::ZERO {
            return Err(CameraFlaw::Empty("look_at"));
        }
        // `up` within rounding of the line of sight leaves the picture free to turn.
        let up = S::widen_vec(self.up).normalize();
        if !(forward.cross(up).length() > S::EPSILON.widen() * S::Wide::from_i32(16)) {
            return Err(CameraFlaw::Empty("up"));
        }
        self.projection.check()
    }
}

impl<S: Scalar> Projection<S> {
    fn check(&self) -> Result<(), CameraFlaw> {
        let length = |value: S, field| {
            if !value.is_finite() {
                Err(CameraFlaw::NotFinite(field))
            } else if !(value >= S::LENGTH_MIN && value <= S::COORD_MAX) {
                Err(CameraFlaw::Range(field))
            } else {
                Ok(())
            }
        };
        let angle = |fov: S| {
            if !fov.is_finite() {
                Err(CameraFlaw::NotFinite("fov"))
            } else if !(fov > S::ZERO && fov < S::from_i32(180)) {
                Err(CameraFlaw::Range("fov"))
            } else {
                Ok(())
            }
        };
        match *self {
            Self::Pinhole { fov } => angle(fov),
            Self::Orthographic { height } => length(height, "height"),
            Self::ThinLens { fov, aperture, focus } => {
                angle(fov)?;
                length(aperture, "aperture")?;
                length(focus, "focus")
            }
        }
    }
}

/// A camera and a picture size, ready to give rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens<S: Scalar> {
    camera: Camera<S>,
    film: Film<S>,
}

impl<S: Scalar> Lens<S> {
    /// The rays of a camera for a picture of so many square pixels.
    pub fn new(camera: &Camera<S>, width: u32, height: u32) -> Self {
        Self { camera: *camera, film: Film::new(camera, width, height) }
    }

    /// The ray through a point of a pixel and the middle of the lens; `offset` counts in pixels from the
    /// pixel's upper left corner, (½, ½) is its middle. The direction has unit length.
    #[inline]
    pub fn ray(&self, x: u32, y: u32, offset: [S; 2]) -> Ray<S> {
        self.film.ray(&self.camera, [x, y], offset, || [S::HALF; 2])
    }
}

/// What a camera and a picture size make together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Film<S: Scalar> {
    forward: S::WideVec,
    /// From the middle of the picture to its right edge, at distance 1 (or on the film).
    right: S::WideVec,
    /// From the middle of the picture to its upper edge.
    up: S::WideVec,
    width: u32,
    height: u32,
}

impl<S: Scalar> Film<S> {
    pub(crate) fn new(camera: &Camera<S>, width: u32, height: u32) -> Self {
        let forward = (S::widen_vec(camera.look_at) - S::widen_vec(camera.eye)).normalize();
        let right = forward.cross(S::widen_vec(camera.up)).normalize();
        let up = right.cross(forward);
        let half = match camera.projection {
            Projection::Pinhole { fov } | Projection::ThinLens { fov, .. } => {
                let (sin, cos) = sin_cos_degrees::<S>(fov * S::HALF);
                sin / cos
            }
            Projection::Orthographic { height } => height.widen() * S::Wide::HALF,
        };
        let aspect = S::Wide::from_ratio(width as i32, height as i32);
        Self { forward, right: right * (half * aspect), up: up * half, width, height }
    }

    /// The ray of the camera that it was made for, through a point of a pixel and a point of the lens,
    /// in 0..1 across and along it.
    #[inline]
    pub(crate) fn ray(
        &self,
        camera: &Camera<S>,
        [x, y]: [u32; 2],
        offset: [S; 2],
        lens: impl FnOnce() -> [S; 2],
    ) -> Ray<S> {
        // (2·(x + offset) − width) / width: the whole numbers cancel before they are rounded.
        let across = |index: u32, size: u32, offset: S| {
            let doubled = S::Wide::from_i32(2 * index as i32 - size as i32);
            (doubled + offset.widen() * S::Wide::TWO) / S::Wide::from_i32(size as i32)
        };
        let h = across(x, self.width, offset[0]);
        let v = -across(y, self.height, offset[1]);
        let aside = self.right * h + self.up * v;
        let eye = camera.eye;
        match camera.projection {
            Projection::Pinhole { .. } => Ray { origin: eye, dir: S::unit(self.forward + aside) },
            Projection::Orthographic { .. } => {
                Ray { origin: eye + S::narrow_vec(aside), dir: S::narrow_dir(self.forward) }
            }
            Projection::ThinLens { aperture, focus, .. } => {
                let [across, along] = disc::<S>(lens());
                let radius = aperture.widen() * S::Wide::HALF;
                let point = self.right.normalize() * (across * radius)
                    + self.up.normalize() * (along * radius);
                // Where the lens is met is rounded first, so that all rays meet in the plane in focus.
                let point = S::narrow_vec(point);
                let focused = (self.forward + aside) * focus.widen();
                Ray { origin: eye + point, dir: S::unit(focused - S::widen_vec(point)) }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn camera(projection: Projection<f64>) -> Camera<f64> {
        let (eye, look_at) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(1.0, 2.0, -7.0));
        Camera { eye, look_at, up: DVec3::Y, projection }
    }

    #[test]
    fn pinhole_covers_the_angle_from_edge_to_edge() {
        let lens = Lens::new(&camera(Projection::Pinhole { fov: 90.0 }), 200, 100);
        let along = |x, y, offset| {
            let dir = lens.ray(x, y, offset).dir;
            assert!((dir.length_squared() - 1.0).abs() <= 1e-15);
            dir * (-1.0 / dir.z)
        };
        let near = |a: DVec3, b: DVec3| assert!((a - b).max_abs() <= 1e-15, "{a} is not {b}");
        near(along(0, 0, [0.0, 0.0]), DVec3::new(-2.0, 1.0, -1.0));
        near(along(199, 99, [1.0, 1.0]), DVec3::new(2.0, -1.0, -1.0));
        near(along(100, 50, [0.0, 0.0]), DVec3::new(0.0, 0.0, -1.0));
        near(along(100, 49, [0.5, 0.5]), DVec3::new(0.01, 0.01, -1.0));
    }

    #[test]
    fn orthographic_rays_are_parallel() {
        let lens = Lens::new(&camera(Projection::Orthographic { height: 4.0 }), 30, 20);
        let ray = lens.ray(0, 0, [0.0, 0.0]);
        assert_eq!((ray.origin, ray.dir), (DVec3::new(-2.0, 4.0, 3.0), DVec3::NEG_Z));
        let ray = lens.ray(29, 19, [1.0, 1.0]);
        assert_eq!((ray.origin, ray.dir), (DVec3::new(4.0, 0.0, 3.0), DVec3::NEG_Z));
    }

    #[test]
    fn useless_cameras_are_refused() {
        let good = camera(Projection::Pinhole { fov: 40.0 });
        assert_eq!(good.check(), Ok(()));
        let with = |change: fn(&mut Camera<f64>)| {
            let mut camera = good;
            change(&mut camera);
            camera.check()
        };
        assert_eq!(with(|c| c.eye.x = f64::NAN), Err(CameraFlaw::NotFinite("eye")));
        assert_eq!(with(|c| c.eye.x = 1e300), Err(CameraFlaw::Range("eye")));
        assert_eq!(with(|c| c.look_at = c.eye), Err(CameraFlaw::Empty("look_at")));
        assert_eq!(with(|c| c.up = DVec3::Z * 2.0), Err(CameraFlaw::Empty("up")));
        assert_eq!(with(|c| c.up = DVec3::ZERO), Err(CameraFlaw::Empty("up")));
        // A length whose reciprocal overflows once gave directions that are no numbers.
        assert_eq!(with(|c| c.up = DVec3::Y * 1e-310), Ok(()));
        for fov in [0.0, -4.0, 180.0] {
            let camera = Camera { projection: Projection::Pinhole { fov }, ..good };
            assert_eq!(camera.check(), Err(CameraFlaw::Range("fov")));
        }
    }
}
