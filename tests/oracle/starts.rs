//! Rays that start on the surface of a solid given by a field.
#![allow(dead_code, unreachable_pub, reason = "each test program uses a part of the oracle")]
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]

use nostray::ray::Start;
use nostray::{Boundary, Passage, Ray, Real as _, Scalar, Vector};

use super::field::{Aim, Field, Subject, is_float, step, wide};
use super::{Random, length};

/// What the rays of a solid showed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Starts {
    pub rays: u32,
    /// Rays outward that meet the surface at once, or at all where it is convex.
    pub met: u32,
    /// Rays inward that do not come out again.
    pub lost: u32,
    /// Points farther along the rays, and those that are on the wrong side.
    pub points: u32,
    pub wrong: u32,
}

/// A direction from a surface with this normal: half of them along it, most of these within rounding.
fn leaving<S: Scalar>(random: &mut Random, normal: S::Dir) -> (S::Dir, bool) {
    let n = normal.to_array().map(|n| S::widen_unit(n).to_f64());
    let mut dir = random.direction();
    if random.bits() & 1 == 0 {
        let along: f64 = (0..3).map(|i| dir[i] * n[i]).sum();
        let tilt = random.decades(-8.0, -1.0) * random.sign();
        dir = [0, 1, 2].map(|i| dir[i] + n[i] * (tilt - along));
    }
    let size = length(dir);
    let dir = S::unit(wide::<S>(dir.map(|x| x / size)));
    (dir, dir.dot(normal) < <S::Unit as Default>::default())
}

impl Starts {
    /// Rays from a point of the surface that a random ray met, to either side.
    pub fn take<S: Scalar, F: Field>(
        &mut self,
        subject: &Subject<S, F>,
        random: &mut Random,
        convex: bool,
    ) {
        let aim = if random.bits() & 1 == 0 { Aim::Random } else { Aim::Grazing };
        let Some(ray) = subject.ray(random, aim) else { return };
        let vacant =
            Boundary { t: S::ZERO, node: 0, face: 0, passage: Passage::Touch, inverted: false };
        let scene = subject.builder.scene().expect("a legal scene");
        let Some(hit) = scene.nearest(ray, &mut [vacant; 64]).expect("room") else { return };
        let contact = scene.contact(ray, &hit).expect("of this scene");
        let (dir, inward) = leaving::<S>(random, contact.normal);
        let face = hit.boundary.face;
        let start = Start { node: 0, face, inward, local: contact.local };
        let ray = Ray { origin: contact.position, dir };
        let found = subject.spans(ray, Some(start));
        self.rays += 1;
        let begun = found.first().is_some_and(|[enter, _]| *enter == S::ZERO);
        assert!(found.iter().flatten().skip(1).all(|t| *t > S::ZERO), "{found:?}");
        if inward {
            self.lost += u32::from(!begun || (convex && found.len() != 1));
        } else {
            self.met += u32::from(begun || (convex && !found.is_empty()));
        }
        self.follow(subject, &ray, &found);
    }

    /// Compares the sides of points along a ray.
    fn follow<S: Scalar, F: Field>(
        &mut self,
        subject: &Subject<S, F>,
        ray: &Ray<S>,
        found: &[[S; 2]],
    ) {
        let path = subject.path(ray);
        let size = subject.size();
        let [min, max] = subject.field.corners();
        // Rounding moves a start by so much, and along the surface a point by its root.
        let unit = if is_float::<S>() { step::<S>() * size } else { step::<S>() / subject.scale };
        let margin = unit * 64.0;
        let (least, most) = ((unit * size).sqrt() * 16.0, size * 4.0);
        for i in 1..64 {
            let away = (least + (most - least) * f64::from(i) / 64.0) / length(path.dir);
            let p = path.at(away - path.shift);
            let value = subject.field.value(p);
            let edge = (0..3).map(|i| (p[i] - min[i]).min(max[i] - p[i])).fold(f64::MAX, f64::min);
            if value.abs() < margin || edge.abs() < margin {
                continue;
            }
            let inside = found.iter().any(|[a, b]| a.to_f64() <= away && away < b.to_f64());
            self.points += 1;
            self.wrong += u32::from(inside != (value < 0.0 && edge > 0.0));
        }
    }

    pub fn show<S: Scalar>(&self, name: &str) {
        let Self { rays, met, lost, points, wrong } = self;
        println!("{:4} {name:24} {rays:7} {met:5} {lost:5} {points:9} {wrong:6}", S::NAME);
    }
}
