//! Prisms against their definition: between the caps, and inside of the polygon by the even-odd rule.
//!
//! `cargo test --test solids prism -- --nocapture` prints how far from the surface, in ε·size (in fixed point in
//! steps), what was found and the truth differ at most; `NOSTRAY_RAYS=100000` takes so many rays.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

use crate::oracle::steps::Exact;
use crate::oracle::{Random, along, length};
use nostray::ray::{Line, Start};
use nostray::shape::Sight;
use nostray::{
    Affine, Fixed, Form, Material, Node, Q16, Q32, Ray, Real as _, Rgb, SceneBuilder, Vector,
};

type Builder<S> = SceneBuilder<S, Fixed<1, 1, 1, 64>>;

/// A prism, and the numbers it is made of.
struct Subject<S: Exact> {
    builder: Builder<S>,
    polygon: Vec<[f64; 2]>,
    height: f64,
    size: f64,
}

impl<S: Exact> Subject<S> {
    /// A star-shaped or wild polygon, some of whose edges go along an axis.
    fn new(random: &mut Random, size: f64) -> Self {
        let count = 3 + random.below(8);
        let wild = random.below(4) == 0;
        let turn = random.sign();
        let coarse = |x: f64| S::from_f64((x * 8.0).round() / 8.0 * size);
        let mut vertices: Vec<[S; 2]> = Vec::new();
        while vertices.len() < count {
            let angle = turn * (vertices.len() as f64 + random.within(0.0, 0.7)) / count as f64;
            let radius = random.within(0.3, 1.0);
            let (sin, cos) = (angle * std::f64::consts::TAU).sin_cos();
            let [x, z] =
                if wild { [random.within(-1.0, 1.0); 2] } else { [radius * cos, radius * sin] };
            let z = if wild { random.within(-1.0, 1.0) } else { z };
            let vertex = [coarse(x), coarse(z)];
            if vertices.last() != Some(&vertex) && vertices.first() != Some(&vertex) {
                vertices.push(vertex);
            } else if !wild {
                return Self::new(random, size);
            }
        }
        let height =
            S::from_f64(size * random.decades(-2.0, 0.3)) * S::HALF + S::from_f64(size / 64.0);
        let height = height + height;
        let mut builder = Builder::<S>::new();
        let material = builder.material(Material::matte(Rgb::WHITE)).expect("room");
        let form = Form::Prism { vertices: &vertices, height };
        if builder.leaf(form, &Affine::identity(), material).is_err() {
            return Self::new(random, size);
        }
        let polygon = vertices.iter().map(|vertex| vertex.map(S::to_f64)).collect();
        Self { builder, polygon, height: height.to_f64(), size }
    }

    fn contains(&self, [x, y, z]: [f64; 3]) -> bool {
        let mut inside = false;
        for (i, &[a, b]) in self.polygon.iter().enumerate() {
            let [c, d] = self.polygon[(i + 1) % self.polygon.len()];
            if (b < z) != (d < z) && a + (c - a) * ((z - b) / (d - b)) > x {
                inside = !inside;
            }
        }
        inside && y > 0.0 && y < self.height
    }

    /// How far a point is from the caps or from the sides, endless both.
    fn distance(&self, [x, y, z]: [f64; 3]) -> f64 {
        let mut least = y.abs().min((y - self.height).abs());
        for (i, &[a, b]) in self.polygon.iter().enumerate() {
            let [c, d] = self.polygon[(i + 1) % self.polygon.len()];
            let (ex, ez) = (c - a, d - b);
            let share = ((x - a) * ex + (z - b) * ez) / (ex * ex + ez * ez);
            let share = share.clamp(0.0, 1.0);
            least = least.min((x - a - share * ex).hypot(z - b - share * ez));
        }
        least
    }

    fn spans(&self, ray: Ray<S>, start: Option<Start<S>>) -> Vec<f64> {
        let line = Line::new(ray, start);
        let scene = self.builder.scene().expect("a legal scene");
        let parts = scene.parts();
        let Some(Node::Leaf(leaf)) = parts.nodes.first() else { panic!("one leaf") };
        let sight =
            Sight { line: &line, place: None, start: line.start.as_ref(), tables: &parts.tables };
        let mut found = Vec::new();
        leaf.shape
            .spans(&sight, |span| found.extend([span.enter.t.to_f64(), span.exit.t.to_f64()]));
        assert!(found.windows(2).all(|pair| pair[0] < pair[1]), "{found:?}");
        assert!(found.len() <= 2 * leaf.shape.spans_max() as usize);
        found
    }

    /// A ray at the prism: anyhow, along an edge's plane, level, or along the axis.
    fn ray(&self, random: &mut Random) -> Ray<S> {
        let mut at = random.ball().map(|x| x * self.size);
        at[1] = self.height * random.within(0.0, 1.0);
        let mut dir = random.direction();
        let [x, z] = self.polygon[random.below(self.polygon.len())];
        match random.below(8) {
            0 => dir[1] = 0.0,
            1 => (dir[0], at[2]) = (0.0, z),
            2 => (dir[2], at[2], at[0]) = (0.0, z, x),
            3 => dir = [0.0, random.sign(), 0.0],
            4 => dir = [random.decades(-9.0, -1.0), 1.0, random.decades(-9.0, -1.0)],
            5 => (dir[1], at[1]) = (0.0, 0.0),
            _ => {}
        }
        let long = length(dir);
        let from = along(at, -random.within(0.0, 3.0) * self.size / long, dir);
        let dir = S::WideVec::from_array(dir.map(S::Wide::from_f64));
        Ray { origin: S::Vec3::from_array(from.map(S::from_f64)), dir: S::unit(dir) }
    }

    /// How far from the surface what was found and the truth differ at most.
    fn margin(&self, ray: Ray<S>, found: &[f64], from: f64) -> f64 {
        let origin = ray.origin.to_array().map(S::to_f64);
        let dir = ray.dir.to_array().map(|d| S::widen_unit(d).to_f64());
        let reach = 8.0 * self.size;
        let mut at: Vec<f64> =
            (0..400).map(|i| from + (reach - from) * f64::from(i) / 400.0).collect();
        at.extend(found.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])));
        let mut worst = 0.0_f64;
        for t in at {
            let told = found.iter().filter(|end| **end <= t).count() % 2 == 1;
            let place = along(origin, t, dir);
            if told != self.contains(place) {
                worst = worst.max(self.distance(place) / S::rounding_of(self.size));
            }
        }
        worst
    }
}

fn prisms<S: Exact>(few: u32, [low, high]: [f64; 2]) {
    let rays = std::env::var("NOSTRAY_RAYS").map_or(few, |n| n.parse().expect("a number of rays"));
    let mut random = Random::new(5);
    let (mut margin, mut hits, mut starts, mut again) = (0.0_f64, 0, 0, 0);
    let mut this = Subject::<S>::new(&mut random, 1.0);
    for n in 0..rays {
        if n.is_multiple_of(16) {
            let size = random.decades(low, high);
            this = Subject::new(&mut random, size);
        }
        let ray = this.ray(&mut random);
        let found = this.spans(ray, None);
        margin = margin.max(this.margin(ray, &found, -8.0 * this.size));
        hits += u32::from(!found.is_empty());
        let Some(contact) = contact(&this, ray) else { continue };
        starts += 1;
        // A ray from there, to either side.
        let dir = random.direction();
        let dir = S::unit(S::WideVec::from_array(dir.map(S::Wide::from_f64)));
        let cosine: f64 =
            (0..3).map(|i| S::widen_unit(dir.to_array()[i]).to_f64() * contact.1[i]).sum();
        let start = Start { inward: cosine < 0.0, ..contact.0 };
        let ray = Ray { origin: contact.2, dir };
        let found = this.spans(ray, Some(start));
        let begins = found.first() == Some(&0.0);
        assert!(begins || !start.inward, "{}: {found:?} from {start:?}", S::NAME);
        again += u32::from(begins && !start.inward);
    }
    println!(
        "{:4} {rays} rays, {hits} hits, {starts} starts, {again} at an edge: margin {margin:.2}",
        S::NAME
    );
    assert!(again <= starts / 50, "{again} of {starts} meet what they start on");
    assert!(hits > rays / 4 && starts > rays / 8, "{hits} hits, {starts} starts");
    assert!(margin <= 8.0, "{}: {margin}", S::NAME);
}

/// A start on the surface where a ray meets it, the normal there, and the place.
fn contact<S: Exact>(this: &Subject<S>, ray: Ray<S>) -> Option<(Start<S>, [f64; 3], S::Vec3)> {
    let scene = this.builder.scene().expect("a legal scene");
    let vacant = nostray::Boundary {
        t: S::ZERO,
        node: 0,
        face: 0,
        passage: nostray::Passage::Touch,
        inverted: false,
    };
    let mut buffer = vec![vacant; scene.limits().boundaries as usize];
    let hit = scene.nearest(ray, &mut buffer).expect("room")?;
    let contact = scene.contact(ray, &hit).expect("of this scene");
    let start = Start { node: 0, face: hit.boundary.face, inward: false, local: contact.local };
    let normal = contact.normal.to_array().map(|n| S::widen_unit(n).to_f64());
    Some((start, normal, contact.position))
}

#[test]
fn prisms_are_what_they_are_by_definition() {
    prisms::<f32>(4000, [-3.0, 3.0]);
    prisms::<f64>(4000, [-3.0, 3.0]);
    prisms::<Q16>(1000, [0.0, 2.0]);
    prisms::<Q32>(1000, [0.0, 2.0]);
}
