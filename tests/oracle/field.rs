//! Solids given by a field, beside the field itself in double precision.
#![allow(dead_code, unreachable_pub, reason = "each test program uses a part of the oracle")]
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

use nostray::ray::{Line, Start};
use nostray::shape::Sight;
use nostray::{
    Affine, Axis, Fixed, Leaf, Material, Node, Ray, Real as _, Rgb, Scalar, SceneBuilder, Vector,
};

use super::scan::{across, gradient, spans, within_box};
use super::{Random, along, length};

pub type Builder<S> = SceneBuilder<S, Fixed<1, 1, 1, 16, 128>>;

/// A solid where a field is negative, within a box.
pub trait Field {
    /// Less than 0 inside; near the surface it changes about as fast as the place does.
    fn value(&self, p: [f64; 3]) -> f64;
    /// A box that holds the solid, or cuts it.
    fn corners(&self) -> [[f64; 3]; 2];
    /// Adds it to a scene.
    fn plant<S: Scalar>(&self, builder: &mut Builder<S>, map: &Affine<S>);
}

/// How a ray is laid at a solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aim {
    /// At any point of the box, from inside it to a hundred sizes away.
    Random,
    /// Past a point of the surface at right angles to the normal, 10⁻⁷ to 10⁻¹ sizes above or below.
    Grazing,
    /// At any point of the box, from 10² to 10⁷ sizes away; in `f32` to 10⁴, where it still tells the parts of the solid.
    Far,
}

/// A field with the solid that is to be judged.
pub struct Subject<S: Scalar, F> {
    pub field: F,
    pub builder: Builder<S>,
    pub leaf: Leaf<S>,
    /// From the solid's own unit of length to that of the scene.
    pub scale: f64,
}

/// A ray as the field sees it: its parameter counts from `shift`.
pub struct Path {
    pub origin: [f64; 3],
    pub dir: [f64; 3],
    pub shift: f64,
}

impl Path {
    pub fn at(&self, t: f64) -> [f64; 3] {
        along(self.origin, t, self.dir)
    }
}

pub fn array<S: Scalar>(v: S::Vec3) -> [f64; 3] {
    v.to_array().map(S::to_f64)
}

pub fn wide<S: Scalar>(v: [f64; 3]) -> S::WideVec {
    S::WideVec::from_array(v.map(S::Wide::from_f64))
}

pub fn vector<S: Scalar>(v: [f64; 3]) -> S::Vec3 {
    S::Vec3::from_array(v.map(S::from_f64))
}

/// One step of the format, or the relative one of a float.
pub fn step<S: Scalar>() -> f64 {
    S::EPSILON.to_f64()
}

/// The format has an exponent.
pub fn is_float<S: Scalar>() -> bool {
    S::REFINES
}

impl<S: Scalar, F: Field> Subject<S, F> {
    /// The solid `scale` times as large, turned if it is to be, about a place.
    pub fn new(field: F, scale: f64, turns: [f64; 3], place: [f64; 3]) -> Self {
        let mut map = Affine::<S>::scale(S::Vec3::splat(S::from_f64(scale)));
        for (axis, degrees) in Axis::ALL.into_iter().zip(turns) {
            map = map.then(&Affine::rotate(axis, S::from_f64(degrees)));
        }
        let map = map.then(&Affine::translate(vector::<S>(place)));
        let mut builder = Builder::<S>::new();
        builder.material(Material::matte(Rgb::WHITE)).expect("room");
        field.plant(&mut builder, &map);
        let scene = builder.scene().expect("a legal scene");
        let Some(&Node::Leaf(leaf)) = scene.parts().nodes.first() else { panic!("one leaf") };
        Self { field, builder, leaf, scale }
    }

    /// The spans of a ray that may start on the surface.
    pub fn spans(&self, ray: Ray<S>, start: Option<Start<S>>) -> Vec<[S; 2]> {
        let scene = self.builder.scene().expect("a legal scene");
        let parts = scene.parts();
        let line = Line::new(ray, start);
        let (place, start) = (parts.placements.first(), line.start.as_ref());
        let sight = Sight { line: &line, place, start, tables: &parts.tables };
        let mut found = Vec::new();
        self.leaf.shape.spans(&sight, |span| found.push([span.enter.t, span.exit.t]));
        for ends in &found {
            assert!(ends[0] < ends[1], "an empty span: {found:?}");
        }
        for pair in found.windows(2) {
            assert!(pair[0][1] < pair[1][0], "spans that are not apart: {found:?}");
        }
        assert!(found.len() <= self.leaf.shape.spans_max() as usize, "{found:?}");
        if found.last().is_some_and(|[_, exit]| *exit > S::ZERO) {
            let bounds = self.leaf.shape.bounds(place, &parts.tables);
            assert!(bounds.meets(&line, S::FAR), "the bounds lose {ray:?}");
        }
        found
    }

    /// The ends of spans that are given when only those up to `until` are asked for.
    pub fn spans_until(&self, ray: Ray<S>, until: S) -> Vec<S> {
        let scene = self.builder.scene().expect("a legal scene");
        let parts = scene.parts();
        let line = Line::new(ray, None);
        let place = parts.placements.first();
        let sight = Sight { line: &line, place, start: None, tables: &parts.tables };
        let mut found = Vec::new();
        let emit = |span: nostray::span::Span<S>| found.extend([span.enter.t, span.exit.t]);
        self.leaf.shape.spans_until(&sight, until, emit);
        found
    }

    /// The ray in the coordinates of the field, counted from a point near it.
    pub fn path(&self, ray: &Ray<S>) -> Path {
        let scene = self.builder.scene().expect("a legal scene");
        let place = scene.parts().placements.first();
        let anchor = place.map_or(self.leaf.shape.centre(), |place| place.anchor);
        let rows = match place {
            Some(place) => place.to_local.map(|row| row.to_array().map(S::Wide::to_f64)),
            None => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        };
        let dir = ray.dir.to_array().map(|d| S::widen_unit(d).to_f64());
        let (o, c) = (array::<S>(ray.origin), array::<S>(anchor));
        let from = [0, 1, 2].map(|i: usize| o[i] - c[i]);
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let shift = -dot(from, dir) / dot(dir, dir);
        // Exactly, for what is far.
        let exact = super::Real::from;
        let near = [0, 1, 2]
            .map(|i: usize| (exact(o[i]) - exact(c[i]) + exact(shift) * exact(dir[i])).to_f64());
        Path { origin: rows.map(|row| dot(row, near)), dir: rows.map(|row| dot(row, dir)), shift }
    }

    /// Whether a point of the field's coordinates is where, in the scene.
    pub fn to_scene(&self, p: [f64; 3]) -> [f64; 3] {
        let scene = self.builder.scene().expect("a legal scene");
        let place = scene.parts().placements.first();
        let anchor = array::<S>(place.map_or(self.leaf.shape.centre(), |place| place.anchor));
        let Some(place) = place else { return along(anchor, 1.0, p) };
        let rows = place.to_world.map(|row| row.to_array().map(S::Wide::to_f64));
        let moved = rows.map(|row| row[0] * p[0] + row[1] * p[1] + row[2] * p[2]);
        along(anchor, 1.0, moved)
    }

    /// The size of the box, in the field's own coordinates.
    pub fn size(&self) -> f64 {
        let [min, max] = self.field.corners();
        (0..3).map(|i| max[i] - min[i]).fold(0.0, f64::max) / 2.0
    }

    fn point(&self, random: &mut Random) -> [f64; 3] {
        let [min, max] = self.field.corners();
        [0, 1, 2].map(|i| random.within(min[i], max[i]))
    }

    /// A point of the surface inside the box, if a random line meets it.
    pub fn surface_point(&self, random: &mut Random) -> Option<[f64; 3]> {
        let (from, to) = (self.point(random), self.point(random));
        let dir = along(to, -1.0, from);
        let found = spans(|t| self.field.value(along(from, t, dir)), 0.0, [0.0, 1.0], 100);
        let ends: Vec<f64> = found.into_iter().flatten().filter(|t| *t > 0.0 && *t < 1.0).collect();
        (!ends.is_empty()).then(|| along(from, ends[random.below(ends.len())], dir))
    }

    /// A ray of some kind; `None` where the surface was not met.
    pub fn ray(&self, random: &mut Random, aim: Aim) -> Option<Ray<S>> {
        let size = self.size();
        let (target, dir) = match aim {
            Aim::Random | Aim::Far => (self.point(random), random.direction()),
            Aim::Grazing => {
                let point = self.surface_point(random)?;
                let normal = gradient(|p| self.field.value(p), point, size * 1e-6);
                let height = size * random.decades(-7.0, -1.0) * random.sign() / length(normal);
                (along(point, height, normal), across(random, normal))
            }
        };
        let away = size
            * match aim {
                Aim::Random => random.decades(-1.0, 2.0),
                Aim::Grazing => random.decades(-0.5, 1.0),
                Aim::Far => random.decades(2.0, if step::<S>() < 1e-10 { 7.0 } else { 4.0 }),
            };
        let [origin, target] = [along(target, -away, dir), target].map(|p| self.to_scene(p));
        let (dir, _) = S::steer(wide::<S>(along(target, -1.0, origin)));
        Some(Ray { origin: vector::<S>(origin), dir })
    }

    /// The spans of the field along a path, where it is less than a level; `None` for a path that passes
    /// the box at an edge.
    pub fn truth(&self, path: &Path, level: f64, samples: u32) -> Option<Vec<[f64; 2]>> {
        let [min, max] = self.field.corners();
        let size = self.size();
        let Some(ends) = within_box(path.origin, path.dir, min, max) else {
            return Some(Vec::new());
        };
        if (ends[1] - ends[0]) * length(path.dir) < size * 1e-2 {
            return None;
        }
        Some(spans(|t| self.field.value(path.at(t)), level, ends, samples))
    }
}

/// What rays of one kind showed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally {
    pub rays: u32,
    pub spans: u32,
    pub most: usize,
    /// Counts that are not those of the scan.
    pub wrong: u32,
    /// How far the level has to be moved until they are, in ε or steps, of the size.
    pub margin: f64,
    /// The greatest distance of a boundary from the surface, over the size; in fixed point in steps.
    pub geo: f64,
    /// The greatest error of t where the ray comes in steeply, the same way.
    pub steep: f64,
}

const MARGINS: [f64; 14] =
    [0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 256.0, 1024.0, 65536.0, 1e9, f64::INFINITY];

impl Tally {
    /// Compares one ray.
    pub fn take<S: Scalar, F: Field>(
        &mut self,
        subject: &Subject<S, F>,
        ray: Ray<S>,
        samples: u32,
    ) {
        let path = subject.path(&ray);
        let Some(mut truth) = subject.truth(&path, 0.0, samples) else { return };
        self.rays += 1;
        let size = subject.size();
        let unit = if is_float::<S>() { step::<S>() * size } else { step::<S>() / subject.scale };
        let found = subject.spans(ray, None);
        if found.len() != truth.len() {
            // What is thin or nearly touches is looked at more closely.
            truth = subject.truth(&path, 0.0, samples * 64).unwrap_or(truth);
        }
        self.spans += truth.len() as u32;
        self.most = self.most.max(truth.len());
        if found.len() != truth.len() {
            self.wrong += 1;
            let agrees = |margin: f64| {
                [-1.0, 1.0].into_iter().any(|sign| {
                    let moved = subject.truth(&path, sign * margin * unit, samples * 16);
                    moved.is_none_or(|moved| moved.len() == found.len())
                })
            };
            let margin = MARGINS.into_iter().find(|&m| m.is_infinite() || agrees(m));
            self.margin = self.margin.max(margin.unwrap_or(f64::INFINITY));
            return;
        }
        for (t, exact) in found.into_iter().flatten().zip(truth.into_iter().flatten()) {
            self.measure(subject, &path, t.to_f64() - path.shift, exact);
        }
    }

    fn measure<S: Scalar, F: Field>(
        &mut self,
        subject: &Subject<S, F>,
        path: &Path,
        t: f64,
        exact: f64,
    ) {
        let size = subject.size();
        let [min, max] = subject.field.corners();
        let p = path.at(exact);
        let edge =
            (0..3).map(|i| (p[i] - min[i]).min(max[i] - p[i]).abs()).fold(f64::MAX, f64::min);
        let unit = if is_float::<S>() { size } else { step::<S>() / subject.scale };
        let speed = length(path.dir);
        // What the format can hold so far away is no error.
        let held = if is_float::<S>() { step::<S>() * (path.shift + t).abs() * speed } else { 0.0 };
        let error = ((t - exact).abs() * speed - held).max(0.0) / unit;
        if edge < size * 1e-9 {
            // A face of the box.
            return;
        }
        let slope = gradient(|p| subject.field.value(p), p, size * 1e-6);
        let cosine = (0..3).map(|i| slope[i] * path.dir[i]).sum::<f64>() / (length(slope) * speed);
        let off = (subject.field.value(path.at(t)) / length(slope)).abs();
        self.geo = self.geo.max((off - held).max(0.0) / unit);
        if cosine.abs() > 0.3 {
            self.steep = self.steep.max(error);
        }
    }

    pub fn heading<S: Scalar>(title: &str) {
        println!(
            "\n{:34} {:>7} {:>7} {:>5} {:>6} {:>8} {:>9} {:>9}",
            format!("{}: {title}", S::NAME),
            "rays",
            "spans",
            "most",
            "wrong",
            "margin",
            "off",
            "steep"
        );
    }

    pub fn show(&self, name: &str) {
        let Self { rays, spans, most, wrong, margin, geo, steep } = self;
        println!(
            "{name:34} {rays:7} {spans:7} {most:5} {wrong:6} {margin:8} {geo:9.2e} {steep:9.2e}"
        );
    }
}
