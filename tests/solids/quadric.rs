//! General quadrics against exact arithmetic, in every number format.
//!
//! `cargo test --test solids quadric -- --nocapture` prints the table. "wrong" counts rays with other spans
//! than the exact solid has; "margin" is by how much its constant must change until it has the same, in
//! ε times the sum of the terms' magnitudes; "places" is the greatest error of an end in last
//! places (or steps), "geo" the greatest |error|·|dir| over the size of the solid and the way from the middle.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

use crate::oracle::exact::Exact;
use crate::oracle::{Point, Random, Real, along, dot, length};
use nostray::ray::{Line, Start};
use nostray::shape::Sight;
use nostray::{
    Affine, Boundary, Fixed, Form, Item, Leaf, Material, Node, Passage, Q16, Q32, Ray, Real as _,
    Rgb, SceneBuilder, SceneError, Vector,
};

/// The signs of the three squares, of the linear part and of the constant, and what they make.
const KINDS: [(&str, [f64; 3], f64, f64); 9] = [
    ("ellipsoid", [1.0, 1.0, 1.0], 0.0, -1.0),
    ("one sheet", [1.0, -1.0, 1.0], 0.0, -1.0),
    ("two sheets", [1.0, -1.0, 1.0], 0.0, 1.0),
    ("cone", [1.0, -1.0, 1.0], 0.0, 0.0),
    ("paraboloid", [1.0, 0.0, 1.0], -1.0, 0.0),
    ("saddle", [1.0, 0.0, -1.0], -1.0, 0.0),
    ("cylinder", [1.0, 0.0, 1.0], 0.0, -1.0),
    ("channel", [1.0, 0.0, 0.0], -1.0, 0.0),
    ("two walls", [1.0, 0.0, 0.0], 0.0, -1.0),
];

type Builder<S> = SceneBuilder<S, Fixed<1, 1, 1, 0, 10>>;

/// The solid of some coefficients, if they are legal.
fn built<S: Exact>(center: [f64; 3], coefficients: [f64; 10]) -> Result<Builder<S>, SceneError> {
    let three = |from: usize| S::vector([0, 1, 2].map(|i| coefficients[from + i]));
    let form = Form::Quadric {
        center: S::vector(center),
        squares: three(0),
        products: three(3),
        linear: three(6),
        constant: S::from_f64(coefficients[9]),
    };
    let mut builder = Builder::new();
    let material = builder.material(Material::matte(Rgb::WHITE))?;
    builder.leaf(form, &Affine::identity(), material)?;
    Ok(builder)
}

/// A quadric beside its exact twin.
struct Subject<S: Exact> {
    builder: Builder<S>,
    center: Point,
    coefficients: Vec<Real>,
    middle: [f64; 3],
    size: f64,
}

impl<S: Exact> Subject<S> {
    /// A quadric of a kind and about a size, upright or turned.
    fn new(kind: usize, turned: bool, random: &mut Random) -> Self {
        let (_, squares, slope, constant) = KINDS[kind];
        let size = random.decades(-0.5, 1.0);
        let middle = random.cube().map(|x| x * size);
        let mut axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        if turned {
            let [z, aside] = [0; 2].map(|_| random.direction());
            let x = unit(cross(aside, z));
            axes = [x, cross(z, x), z];
        }
        let squares = squares.map(|sign| sign * random.decades(-0.5, 0.5));
        let mut c = [0.0; 10];
        for (axis, square) in axes.iter().zip(squares) {
            for i in 0..3 {
                c[i] += square * axis[i] * axis[i];
                c[3 + i] += 2.0 * square * axis[i] * axis[(i + 1) % 3];
            }
        }
        for i in 0..3 {
            c[6 + i] = slope * size * axes[1][i];
        }
        c[9] = constant * size * size;
        let builder = built::<S>(middle, c).expect("a legal quadric");
        let scene = builder.scene().expect("a legal scene");
        let coefficients = scene.parts().tables.numbers.iter().map(|&x| x.real()).collect();
        let center = S::point(S::vector(middle));
        Self { builder, center, coefficients, middle, size }
    }

    /// The spans along a ray.
    fn spans(&self, ray: Ray<S>, start: Option<Start<S>>) -> Vec<[S; 2]> {
        let scene = self.builder.scene().expect("a legal scene");
        let Some(&Node::Leaf(Leaf { shape, .. })) = scene.parts().nodes.first() else {
            panic!("one leaf");
        };
        let line = Line::new(ray, start);
        let (tables, start) = (&scene.parts().tables, line.start.as_ref());
        let sight = Sight { line: &line, place: None, start, tables };
        let mut spans = Vec::new();
        shape.spans(&sight, |span| spans.push([span.enter.t, span.exit.t]));
        let ends: Vec<S> = spans.iter().flatten().copied().collect();
        assert!(ends.windows(2).all(|pair| pair[0] < pair[1]), "{ends:?} along {ray:?}");
        spans
    }

    fn value(&self, p: &Point) -> Real {
        let c = &self.coefficients;
        let terms =
            [0, 1, 2].map(|i| (&c[i] * &p[i] + &c[3 + i] * &p[(i + 1) % 3] + &c[6 + i]) * &p[i]);
        let [x, y, z] = terms;
        x + y + z + &c[9]
    }

    /// The exact spans with another constant; far ends are those of the scene.
    fn exact(&self, origin: &Point, dir: &Point, more: &Real) -> Vec<[Real; 2]> {
        let two = Real::from(2.0);
        let c = self.value(origin) + more;
        let moved = |sign: f64| {
            let p = [0, 1, 2].map(|i| &origin[i] + &dir[i] * Real::from(sign));
            self.value(&p) + more
        };
        let (ahead, behind) = (moved(1.0), moved(-1.0));
        let a = (&ahead + &behind) / &two - &c;
        let b = (&ahead - &behind) / (&two * &two);
        let far = Real::far();
        let tiny = a.abs() <= (b.abs() + c.abs()) * Real::from(f64::powi(2.0, -250));
        if tiny {
            return match b.sign() {
                0 if c.sign() < 0 => vec![[-&far, far]],
                0 => vec![],
                1 => vec![[-&far, -&c / (&b * two)]],
                _ => vec![[-&c / (&b * two), far]],
            };
        }
        let square = &b * &b - &a * &c;
        if square.sign() <= 0 {
            return if a.sign() < 0 { vec![[-&far, far]] } else { vec![] };
        }
        let root = square.sqrt();
        let pair = [(-&b - &root) / &a, (root - &b) / &a];
        if a.sign() > 0 {
            return vec![pair];
        }
        let [high, low] = pair;
        vec![[-&far, low], [high, far]]
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i] * b[j] - a[j] * b[i])
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    v.map(|x| x / length(v))
}

#[derive(Default)]
struct Row {
    rays: u32,
    spans: u32,
    wrong: u32,
    margin: f64,
    places: f64,
    geo: f64,
}

impl Row {
    fn take<S: Exact>(&mut self, subject: &Subject<S>, ray: Ray<S>) {
        self.rays += 1;
        let (origin, dir) = {
            let path = S::path(&ray);
            (crate::oracle::sub(&path.origin, &subject.center), path.dir)
        };
        let found = subject.spans(ray, None);
        // Spans farther than a ray of the format goes are none, and ends there are no ends.
        let far = S::FAR.to_f64().min(1e30);
        let exact = |more: f64| {
            let mut spans = subject.exact(&origin, &dir, &Real::from(more));
            spans.retain(|[enter, exit]| enter.to_f64() < far && -far < exit.to_f64());
            spans
        };
        let truth = exact(0.0);
        self.spans += found.len() as u32;
        let known = |t: f64| t.abs() < far;
        let shape = |spans: &[[f64; 2]]| -> Vec<bool> {
            spans.iter().flatten().map(|&t| known(t)).collect()
        };
        let as_floats = |spans: &[[Real; 2]]| -> Vec<[f64; 2]> {
            spans.iter().map(|span| [span[0].to_f64(), span[1].to_f64()]).collect()
        };
        let ours: Vec<[f64; 2]> = found.iter().map(|span| span.map(S::to_f64)).collect();
        let nearest = -&(dot(&origin, &dir) / dot(&dir, &dir));
        let near = [0, 1, 2].map(|i| (&origin[i] + &nearest * &dir[i]).to_f64());
        let reach = subject.size + length(near);
        if shape(&ours) != shape(&as_floats(&truth)) {
            self.wrong += 1;
            let unit = S::EPSILON.to_f64() * reach * reach;
            let agrees = |margin: f64| {
                [1.0, -1.0].into_iter().any(|sign| {
                    let spans = exact(sign * margin * unit);
                    shape(&as_floats(&spans)) == shape(&ours)
                })
            };
            let margin = [0.25, 1.0, 4.0, 16.0, f64::INFINITY]
                .into_iter()
                .find(|&m| m.is_infinite() || agrees(m));
            self.margin = self.margin.max(margin.unwrap_or(f64::INFINITY));
            return;
        }
        let speed = length(ray.dir.to_array().map(|d| S::widen_unit(d).to_f64()));
        for (t, exact) in found.iter().flatten().zip(truth.iter().flatten()) {
            let away = (exact - &nearest).abs().to_f64() * speed;
            // Farther off, an end that is there at all is one of nearly parallel directions.
            if known(exact.to_f64()) && away < subject.size * 100.0 {
                let error = (t.real() - exact).abs().to_f64();
                self.places = self.places.max(error / S::last_place(exact.to_f64()));
                self.geo = self.geo.max(error * speed / (reach + away));
            }
        }
    }
}

fn ray<S: Exact>(random: &mut Random, middle: [f64; 3], size: f64) -> Ray<S> {
    let target = along(middle, size * 1.5, random.ball());
    let dir = match random.below(4) {
        0 => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]][random.below(3)],
        _ => random.direction(),
    };
    let speed = random.decades(-2.0, 2.0);
    let away = size * random.decades(-1.0, 1.5);
    S::ray(along(target, -away, dir), dir.map(|x| x * speed))
}

fn table<S: Exact>(rays: u32, [margin, places, geo]: [f64; 3]) {
    for (kind, (name, ..)) in KINDS.iter().enumerate() {
        for turned in [false, true] {
            let mut random = Random::new(kind as u64 * 2 + u64::from(turned));
            let mut row = Row::default();
            while row.rays < rays {
                let subject = Subject::<S>::new(kind, turned, &mut random);
                for _ in 0..8 {
                    row.take(&subject, ray(&mut random, subject.middle, subject.size));
                }
            }
            let Row { rays, spans, wrong, .. } = row;
            println!(
                "{} {name:10} turned {turned:5} {rays:6} {spans:6} {wrong:4} {:5} {:9.2e} {:9.2e}",
                S::NAME,
                row.margin,
                row.places,
                row.geo
            );
            assert!(spans > rays / 4, "{name}: {spans} spans of {rays} rays");
            assert!(row.margin <= margin, "{name}: margin {}", row.margin);
            assert!(wrong <= rays / 500, "{name}: {wrong} wrong");
            assert!(row.places <= places, "{name}: {} places", row.places);
            assert!(row.geo <= geo, "{name}: {:e}", row.geo);
        }
    }
}

#[test]
fn ends_in_floats() {
    // Near the silhouette the error is a square root of the rounding.
    let root = |epsilon: f64| epsilon.sqrt() * 4.0;
    table::<f32>(4000, [4.0, f64::INFINITY, root(f32::EPSILON.into())]);
    table::<f64>(2000, [4.0, f64::INFINITY, root(f64::EPSILON)]);
}

#[test]
fn ends_in_fixed_point() {
    table::<Q16>(800, [1.0, 3.0, f64::INFINITY]);
    table::<Q32>(800, [1.0, 3.0, f64::INFINITY]);
}

/// Starts on hits of random rays, on both sides: none meets the surface again at once, and none
/// loses the far side.
fn secondary<S: Exact>(rays: u32) {
    let mut random = Random::new(5);
    let (mut started, mut ended) = (0, 0);
    for n in 0..rays {
        let subject = Subject::<S>::new(n as usize % KINDS.len(), n % 2 == 0, &mut random);
        let scene = subject.builder.scene().expect("a legal scene");
        let vacant =
            Boundary { t: S::ZERO, node: 0, face: 0, passage: Passage::Touch, inverted: false };
        let at = ray::<S>(&mut random, subject.middle, subject.size);
        let Some(hit) = scene.nearest(at, &mut [vacant; 4]).expect("room") else {
            continue;
        };
        let contact = scene.contact(at, &hit).expect("of this scene");
        let from = contact.position.to_array().map(S::to_f64);
        if length(along(from, -1.0, subject.middle)) > subject.size * 100.0 {
            continue;
        }
        started += 1;
        let normal = contact.normal.to_array().map(|n| S::widen_unit(n).to_f64());
        for inward in [true, false] {
            let lift = if inward { -1.0 } else { 1.0 } * random.decades(-4.0, 0.5);
            let aside = random.direction();
            let up: f64 = (0..3).map(|i| aside[i] * normal[i]).sum();
            let mut ray = S::ray(from, along(aside, lift - up, normal));
            ray.origin = contact.position;
            let start = Start { node: 0, face: 0, inward, local: contact.local };
            let spans = subject.spans(ray, Some(start));
            assert!(spans.len() <= 1, "{spans:?}");
            let begins = spans.first().map(|&[enter, _]| enter);
            assert_eq!(begins == Some(S::ZERO), inward, "{spans:?}");
            // In the middle of a span and behind it the sign is right, beyond rounding.
            let path = S::path(&ray);
            let origin = crate::oracle::sub(&path.origin, &subject.center);
            let mut judge = |t: f64, inside: bool| {
                let p = [0, 1, 2].map(|i| &origin[i] + &path.dir[i] * Real::from(t));
                let reach = subject.size + length(p.clone().map(|x| x.to_f64()));
                let noise = reach * reach * S::EPSILON.to_f64().max(1e-12) * 64.0;
                let noise = noise.max(S::FRACTION.map_or(0.0, |f| f64::powi(2.0, 4 - f) * reach));
                let value = subject.value(&p).to_f64();
                assert!(if inside { value <= noise } else { value >= -noise }, "{value:e} at {t}");
                ended += 1;
            };
            let end =
                spans.first().map_or(S::FAR, |&[enter, exit]| if inward { exit } else { enter });
            let far = subject.size * 8.0;
            let end = end.to_f64().min(far);
            judge(end * 0.5, inward);
            if end < far * 0.5 {
                judge(end * 1.5, !inward);
            }
        }
    }
    assert!(started > rays / 4 && ended > started * 2, "{started} starts, {ended} ends");
}

#[test]
fn no_ray_meets_the_surface_it_starts_on_and_none_loses_the_far_side() {
    secondary::<f32>(2000);
    secondary::<f64>(2000);
    secondary::<Q16>(500);
    secondary::<Q32>(500);
}

#[test]
fn a_polynomial_without_a_change_of_sign_is_refused() {
    let refused = |coefficients: [f64; 10]| {
        let builder = built::<f32>([0.0; 3], coefficients);
        builder.expect_err("a quadric that is none")
    };
    let (at, field) = (Item::Node(0), "coefficients");
    let squares =
        |x: f64, y: f64, z: f64, constant: f64| [x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, constant];
    for nothing in [
        [0.0; 10],
        squares(0.0, 0.0, 0.0, -1.0),
        // A point, a line, a plane, and less than those; everything, and everything but those.
        squares(1.0, 1.0, 1.0, 0.0),
        squares(1.0, 2.0, 0.0, 0.0),
        squares(0.0, 3.0, 0.0, 0.0),
        squares(1.0, 1.0, 1.0, 1.0),
        squares(0.0, 1.0, 0.0, 2.0),
        squares(-1.0, 0.0, -1.0, -1.0),
        squares(-1.0, -1.0, -1.0, 0.0),
        // (x + y)² and (x − 2)² + y² + 1.
        [1.0, 1.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [1.0, 1.0, 0.0, 0.0, 0.0, 0.0, -4.0, 0.0, 0.0, 5.0],
    ] {
        assert_eq!(refused(nothing), SceneError::Empty { at, field }, "{nothing:?}");
    }
    // A half-space, (x + y)² − z and xy are something.
    let mut something = [0.0; 10];
    something[7] = 1.0;
    assert!(built::<f32>([0.0; 3], something).is_ok());
    let bent = [1.0, 1.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0];
    assert!(built::<f32>([0.0; 3], bent).is_ok());
    assert!(built::<f32>([0.0; 3], [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]).is_ok());
    let unknown = squares(f64::NAN, 1.0, 1.0, -1.0);
    assert_eq!(refused(unknown), SceneError::NotFinite { at, field });
    assert_eq!(refused(squares(1e30, 1.0, 1.0, -1.0)), SceneError::TooLarge { at, field });
}
