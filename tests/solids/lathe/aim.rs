//! Rays of many kinds at a lathe.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]
#![allow(unreachable_pub, reason = "a module of a test program")]

use nostray::{Ray, Real as _, Vector};

use super::subject::Subject;
use crate::oracle::revolve::Profile;
use crate::oracle::steps::Exact;
use crate::oracle::{Random, along, length};

/// The ways in which rays are laid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way {
    Random,
    /// Along the surface, within 10⁻⁷ to 10⁻¹ of the size.
    Grazing,
    Far,
    /// At right angles to the axis, often at the height of a vertex.
    Level,
    /// Nearly so.
    Tilted,
    /// Along the axis, often in it.
    Axial,
    /// Through the axis.
    Through,
}

pub const WAYS: [Way; 7] =
    [Way::Random, Way::Grazing, Way::Far, Way::Level, Way::Tilted, Way::Axial, Way::Through];

/// A point of the surface and two directions along it.
pub fn on_surface(profile: &Profile, random: &mut Random) -> ([f64; 3], [[f64; 3]; 2]) {
    let piece = &profile.pieces[random.below(profile.pieces.len())];
    let u = random.within(0.001, 0.999);
    let ([rho, y], [a, b], [c, d]) = (piece.at(u), piece.at(u - 1e-4), piece.at(u + 1e-4));
    let (sin, cos) = random.within(0.0, std::f64::consts::TAU).sin_cos();
    let slope = length([c - a, d - b, 0.0]).max(1e-300);
    let (dr, dy) = ((c - a) / slope, (d - b) / slope);
    ([rho * cos, y, rho * sin], [[-sin, 0.0, cos], [dr * cos, dy, dr * sin]])
}

pub fn ray<S: Exact>(way: Way, this: &Subject<S>, random: &mut Random) -> Ray<S> {
    let size = this.size;
    let (mut dir, mut at) = (random.direction(), random.ball().map(|x| x * size * 0.9));
    let mut away = random.within(0.0, 3.0);
    match way {
        Way::Random => {}
        Way::Far => away = random.decades(1.0, 2.0),
        Way::Grazing => {
            let (place, [a, b]) = on_surface(&this.profile, random);
            let (sin, cos) = random.within(0.0, std::f64::consts::TAU).sin_cos();
            dir = [0, 1, 2].map(|i| a[i] * cos + b[i] * sin);
            let normal =
                [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
            at = along(place, size * random.decades(-7.0, -1.0) * random.sign(), normal);
        }
        Way::Level => {
            dir[1] = 0.0;
            if random.bits() & 1 == 0 {
                let piece = &this.profile.pieces[random.below(this.profile.pieces.len())];
                at[1] = piece.at(0.0)[1];
            }
        }
        Way::Tilted => {
            dir[1] = random.decades(-12.0, -1.0) * random.sign();
            if random.bits() & 1 == 0 {
                let piece = &this.profile.pieces[random.below(this.profile.pieces.len())];
                at[1] = piece.at(0.0)[1];
            }
        }
        Way::Axial => {
            dir = [0.0, random.sign(), 0.0];
            match random.below(4) {
                0 => (at[0], at[2]) = (0.0, 0.0),
                1 => {
                    dir = [random.decades(-12.0, -1.0), random.sign(), random.decades(-12.0, -1.0)]
                }
                2 => (at[0], at[2]) = (this.profile.pieces[0].at(1.0)[0], 0.0),
                _ => {}
            }
        }
        Way::Through => (at[0], at[2]) = (0.0, 0.0),
    }
    let speed = random.decades(-3.0, 3.0) / length(dir);
    let local = along(at, -away * size / length(dir), dir);
    let center = this.center.to_array();
    let origin = [0, 1, 2].map(|i| S::from_f64(local[i]) + center[i]);
    let dir = S::WideVec::from_array(dir.map(|x| S::Wide::from_f64(x * speed)));
    let dir = if S::STEP.is_some() { S::steer(dir).0 } else { S::narrow_dir(dir) };
    Ray { origin: S::Vec3::from_array(origin), dir }
}
