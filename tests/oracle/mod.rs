//! An oracle for intersections: the same solids in 300-bit arithmetic, from their definitions.
//!
//! It shares nothing with the tracer but the numbers that go in; every `f32` and `f64` is
//! taken as the exact number that it is.
#![allow(dead_code, unreachable_pub, reason = "each test program uses a part of the oracle")]
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

pub mod exact;
pub mod field;
pub mod patches;
pub mod revolve;
pub mod ring;
pub mod scan;
pub mod starts;
pub mod steps;
pub mod subject;
pub mod table;
pub mod tori;

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::sync::LazyLock;

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use nostray::{Affine, Ray, Scalar, Vector};

const PRECISION: usize = 300;

/// A format whose companions are all the number itself.
pub trait Float:
    Scalar<
        Unit = Self,
        Wide = Self,
        Vec3 = <Self as Float>::V,
        Dir = <Self as Float>::V,
        WideVec = <Self as Float>::V,
    >
{
    type V: Vector<Scalar = Self>;
}

impl Float for f32 {
    type V = nostray::glam::Vec3;
}

impl Float for f64 {
    type V = nostray::glam::DVec3;
}

/// 2 to the power 4096.
static FAR: LazyLock<Real> = LazyLock::new(|| {
    let mut far = Real::from(2.0);
    for _ in 0..12 {
        far = &far * &far;
    }
    far
});

/// A number of 300 bits.
#[derive(Clone, Debug, PartialEq, PartialOrd)]
pub struct Real(FBig<HalfEven, 2>);

impl Real {
    /// The exact value of a machine number.
    pub fn of<S: Float>(x: S) -> Self {
        Self::from(x.to_f64())
    }

    /// Farther than any boundary.
    pub fn far() -> Self {
        FAR.clone()
    }

    pub fn sqrt(&self) -> Self {
        if self.sign() > 0 { Self(self.0.sqrt()) } else { Self::from(0.0) }
    }

    pub fn abs(&self) -> Self {
        if self.sign() < 0 { -self } else { self.clone() }
    }

    pub fn to_f64(&self) -> f64 {
        self.0.to_f64().value()
    }

    pub fn sign(&self) -> i32 {
        match self.0.partial_cmp(&FBig::<HalfEven, 2>::ZERO) {
            Some(Ordering::Less) => -1,
            Some(Ordering::Greater) => 1,
            _ => 0,
        }
    }
}

impl From<f64> for Real {
    fn from(x: f64) -> Self {
        let exact = FBig::try_from(x).expect("a finite number");
        Self(exact.with_precision(PRECISION).value())
    }
}

impl Neg for &Real {
    type Output = Real;
    fn neg(self) -> Real {
        Real(-self.0.clone())
    }
}

macro_rules! operator {
    ($($name:ident $method:ident)*) => { $(
        impl $name<&Real> for &Real {
            type Output = Real;
            fn $method(self, other: &Real) -> Real {
                Real((&self.0).$method(&other.0))
            }
        }
        impl $name<Real> for &Real {
            type Output = Real;
            fn $method(self, other: Real) -> Real {
                self.$method(&other)
            }
        }
        impl $name<&Real> for Real {
            type Output = Real;
            fn $method(self, other: &Real) -> Real {
                (&self).$method(other)
            }
        }
        impl $name<Real> for Real {
            type Output = Real;
            fn $method(self, other: Real) -> Real {
                (&self).$method(&other)
            }
        }
    )* };
}

operator!(Add add Sub sub Mul mul Div div);

/// Three exact numbers.
pub type Point = [Real; 3];

pub fn point<S: Float>(v: S::Vec3) -> Point {
    v.to_array().map(Real::of)
}

pub fn sub(a: &Point, b: &Point) -> Point {
    [0, 1, 2].map(|i| &a[i] - &b[i])
}

pub fn dot(a: &Point, b: &Point) -> Real {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

pub fn scaled(a: &Point, factor: &Real) -> Point {
    [0, 1, 2].map(|i| &a[i] * factor)
}

pub fn cross(a: &Point, b: &Point) -> Point {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &a[i] * &b[j] - &a[j] * &b[i])
}

/// A solid by its exact parameters.
#[derive(Clone, Debug)]
pub enum Solid {
    Ball {
        center: Point,
        radius: Real,
    },
    /// Between two end points, each with its radius: cylinder, cone and frustum.
    Tube {
        ends: [Point; 2],
        radii: [Real; 2],
    },
    Cuboid {
        min: Point,
        max: Point,
    },
    /// `normal · p ≤ offset`.
    Half {
        normal: Point,
        offset: Real,
    },
    /// `inside` seen through `local = rows · (world − offset)`.
    Placed {
        rows: [Point; 3],
        offset: Point,
        inside: Box<Self>,
    },
}

/// The exact inverse of the linear part of a map.
pub fn inverse_rows<S: Float>(map: &Affine<S>) -> [Point; 3] {
    let [a, b, c] = map.rows.map(point::<S>);
    let det = dot(&a, &cross(&b, &c));
    let columns = [cross(&b, &c), cross(&c, &a), cross(&a, &b)].map(|v| v.map(|x| &x / &det));
    [0, 1, 2].map(|i| [0, 1, 2].map(|j: usize| columns[j][i].clone()))
}

/// A ray by its exact parameters.
#[derive(Clone, Debug)]
pub struct Path {
    pub origin: Point,
    pub dir: Point,
}

impl Path {
    pub fn of<S: Float>(ray: &Ray<S>) -> Self {
        Self { origin: point::<S>(ray.origin), dir: point::<S>(ray.dir) }
    }

    pub fn through(&self, rows: &[Point; 3], offset: &Point) -> Self {
        let from = sub(&self.origin, offset);
        let apply = |v: &Point| [0, 1, 2].map(|i: usize| dot(&rows[i], v));
        Self { origin: apply(&from), dir: apply(&self.dir) }
    }
}

/// What an axis-aligned tube is to a ray: positions across and along its axis.
struct Around {
    /// Across the axis, at the origin and per unit of t.
    across: [Point; 2],
    /// The share of the way from end to end, at the origin and per unit of t.
    share: [Real; 2],
    length: Real,
}

impl Around {
    fn new(path: &Path, ends: &[Point; 2]) -> Self {
        let axis = sub(&ends[1], &ends[0]);
        let square = dot(&axis, &axis);
        let from = sub(&path.origin, &ends[0]);
        let share = [&from, &path.dir].map(|v| dot(v, &axis) / &square);
        let across = [(&from, &share[0]), (&path.dir, &share[1])]
            .map(|(v, share)| sub(v, &scaled(&axis, share)));
        Self { across, share, length: square.sqrt() }
    }
}

impl Solid {
    /// The t between which the ray is inside the solid grown by `grow` on all sides; `None`
    /// where it only touches or passes. A ray that lies in a flat face is inside.
    pub fn span(&self, path: &Path, grow: &Real) -> Option<[Real; 2]> {
        match self {
            Self::Ball { center, radius } => {
                let from = sub(&path.origin, center);
                let radius = radius + grow;
                let (a, b) = (dot(&path.dir, &path.dir), dot(&from, &path.dir));
                let c = dot(&from, &from) - &radius * &radius;
                roots(&a, &b, &c)
            }
            Self::Tube { ends, radii } => tube(path, ends, radii, grow),
            Self::Cuboid { min, max } => {
                let mut span = whole();
                for i in 0..3 {
                    let sides = [&min[i] - grow, &max[i] + grow];
                    span = common(span, slab(&path.origin[i], &path.dir[i], sides)?)?;
                }
                Some(span)
            }
            Self::Half { normal, offset } => {
                let length = dot(normal, normal).sqrt();
                let height = offset + grow * &length - dot(normal, &path.origin);
                let speed = dot(normal, &path.dir);
                let [low, high] = whole();
                match speed.sign() {
                    0 => (height.sign() >= 0).then_some([low, high]),
                    1 => Some([low, height / speed]),
                    _ => Some([height / speed, high]),
                }
            }
            Self::Placed { rows, offset, inside } => inside.span(&path.through(rows, offset), grow),
        }
    }

    /// The factor of all radii at which the ray touches the curved side.
    pub fn touching_factor(&self, path: &Path) -> Real {
        match self {
            Self::Ball { center, radius } => {
                let from = sub(&path.origin, center);
                let moment = cross(&from, &path.dir);
                let square = dot(&moment, &moment) / dot(&path.dir, &path.dir);
                square.sqrt() / radius
            }
            Self::Tube { ends, radii } => {
                let Around { across: [w, d], share, .. } = Around::new(path, ends);
                let growth = &radii[1] - &radii[0];
                let [m0, m1] = [&radii[0] + &growth * &share[0], &growth * &share[1]];
                let moment = cross(&w, &d);
                let p = sub(&scaled(&d, &m0), &scaled(&w, &m1));
                (dot(&moment, &moment) / dot(&p, &p)).sqrt()
            }
            Self::Placed { rows, offset, inside } => {
                inside.touching_factor(&path.through(rows, offset))
            }
            Self::Cuboid { .. } | Self::Half { .. } => panic!("no curved side"),
        }
    }
}

fn whole() -> [Real; 2] {
    [-&Real::far(), Real::far()]
}

fn common([a, b]: [Real; 2], [c, d]: [Real; 2]) -> Option<[Real; 2]> {
    let enter = if a < c { c } else { a };
    let exit = if b < d { b } else { d };
    (enter < exit).then_some([enter, exit])
}

fn slab(origin: &Real, dir: &Real, [min, max]: [Real; 2]) -> Option<[Real; 2]> {
    match dir.sign() {
        0 => (min <= *origin && *origin <= max).then(whole),
        1 => Some([(min - origin) / dir, (max - origin) / dir]),
        _ => Some([(max - origin) / dir, (min - origin) / dir]),
    }
}

/// Where a·t² + 2·b·t + c < 0, for a > 0.
fn roots(a: &Real, b: &Real, c: &Real) -> Option<[Real; 2]> {
    let discriminant = b * b - a * c;
    (discriminant.sign() > 0).then(|| {
        let root = discriminant.sqrt();
        [-&(b + &root) / a, (root - b) / a]
    })
}

fn tube(path: &Path, ends: &[Point; 2], radii: &[Real; 2], grow: &Real) -> Option<[Real; 2]> {
    let Around { across: [w, d], share, length } = Around::new(path, ends);
    let beyond = grow / length;
    let caps = slab(&share[0], &share[1], [-&beyond, Real::from(1.0) + &beyond])?;
    let growth = &radii[1] - &radii[0];
    let m0 = &radii[0] + &growth * &share[0] + grow;
    let m1 = &growth * &share[1];
    let a = dot(&d, &d) - &m1 * &m1;
    let b = dot(&w, &d) - &m0 * &m1;
    let c = dot(&w, &w) - &m0 * &m0;
    let [low, high] = whole();
    let side = match a.sign() {
        1 => {
            let [enter, exit] = roots(&a, &b, &c)?;
            let middle = (&enter + &exit) / Real::from(2.0);
            (m0 + m1 * middle).sign().gt(&0).then_some([enter, exit])?
        }
        -1 => {
            // One root on each nappe.
            let root = (&b * &b - &a * &c).sqrt();
            let pair = [-&(&b + &root) / &a, (root - &b) / &a];
            let [near, far] =
                if pair[0] < pair[1] { pair } else { [pair[1].clone(), pair[0].clone()] };
            if m1.sign() > 0 { [far, high] } else { [low, near] }
        }
        _ => match b.sign() {
            0 => (c.sign() < 0).then_some([low, high])?,
            1 => [low, -&c / (&b + &b)],
            _ => [-&c / (&b + &b), high],
        },
    };
    common(side, caps)
}

/// Steele, Lea and Flood's SplitMix64 (2014).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// In low..high, evenly.
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        let unit = (self.bits() >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * unit
    }

    /// Between 10^low and 10^high, evenly in the exponent.
    pub fn decades(&mut self, low: f64, high: f64) -> f64 {
        10_f64.powf(self.within(low, high))
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    pub fn sign(&mut self) -> f64 {
        if self.bits() & 1 == 0 { 1.0 } else { -1.0 }
    }

    /// A point of the cube −1..1.
    pub fn cube(&mut self) -> [f64; 3] {
        [0; 3].map(|_| self.within(-1.0, 1.0))
    }

    /// A point of the unit ball, evenly.
    pub fn ball(&mut self) -> [f64; 3] {
        loop {
            let v = self.cube();
            if length(v) <= 1.0 {
                return v;
            }
        }
    }

    /// A unit vector, evenly.
    pub fn direction(&mut self) -> [f64; 3] {
        loop {
            let v = self.ball();
            let size = length(v);
            if size > 0.1 {
                return v.map(|x| x / size);
            }
        }
    }
}

/// Plain double arithmetic to place test rays with; no result depends on its accuracy.
pub fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// `a + k·b`.
pub fn along(a: [f64; 3], k: f64, b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| a[i] + k * b[i])
}

pub fn vector<S: Float>(v: [f64; 3]) -> S::Vec3 {
    S::Vec3::from_array(v.map(S::from_f64))
}

pub fn array<S: Float>(v: S::Vec3) -> [f64; 3] {
    v.to_array().map(S::to_f64)
}

/// The distance between neighbours of the format around `x`.
pub fn ulp<S: Float>(x: f64) -> f64 {
    let exponent = x.abs().max(f64::MIN_POSITIVE).log2().floor();
    S::EPSILON.to_f64() * exponent.exp2()
}
