//! The torus against exact arithmetic, in every number format: how many spans, and where they end.
//!
//! `cargo test --test solids torus -- --nocapture` prints the tables. "wrong" counts rays with another
//! number of ends than the exact torus has; "margin" is by how much, in ε·R of a float and steps of
//! fixed point, its tube must be thicker or thinner to have as many; "places" is the greatest error
//! of an end in last places (or steps), "geo" the greatest |error|·|dir|/R.
//! `NOSTRAY_RAYS=100000` sets how many rays there are of each kind.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

use crate::oracle::exact::Exact;
use crate::oracle::tori::{AIMS, Aim, KINDS, Kind, Subject, built, ray, subject};
use crate::oracle::{Random, Real, along, length};
use nostray::ray::Start;
use nostray::{Boundary, Item, Passage, Q16, Q32, Ray, Real as _, SceneError, Vector};

/// What a class of rays showed.
#[derive(Default)]
struct Row {
    rays: u32,
    hits: u32,
    wrong: u32,
    margin: f64,
    places: f64,
    geo: f64,
    /// The greatest error over 10 last places of t and 4·ε·R.
    bound: f64,
}

const MARGINS: [f64; 10] = [0.0, 0.01, 0.1, 0.5, 1.0, 2.0, 4.0, 8.0, 64.0, f64::INFINITY];

impl Row {
    fn take<S: Exact>(&mut self, subject: &Subject<S>, ray: Ray<S>) {
        self.rays += 1;
        let found = subject.ends(ray, None);
        let path = S::path(&ray);
        let truth = subject.twin.ends(&path, &Real::from(0.0));
        self.hits += u32::from(!truth.is_empty());
        let size = subject.frame.size();
        let truth = told_apart::<S>(truth);
        if found.len() != truth.len() {
            self.wrong += 1;
            println!(
                "{ray:?} {:?} {found:?} {:?}",
                subject.frame,
                truth.iter().map(|t| t.to_f64()).collect::<Vec<_>>()
            );
            let unit = S::FRACTION.map_or(S::EPSILON.to_f64() * size, |f| f64::powi(2.0, -f));
            let agrees = |margin: f64| {
                [1.0, -1.0].into_iter().any(|sign| {
                    let grow = Real::from(sign * margin * unit);
                    let ends = subject.twin.ends(&path, &grow);
                    told_apart::<S>(ends).len() == found.len()
                })
            };
            let margin = MARGINS.into_iter().find(|&m| m.is_infinite() || agrees(m));
            self.margin = self.margin.max(margin.unwrap_or(f64::INFINITY));
            return;
        }
        let speed = length(ray.dir.to_array().map(|d| S::widen_unit(d).to_f64()));
        for (t, exact) in found.iter().zip(&truth) {
            let error = (t.real() - exact).abs().to_f64();
            let place = S::last_place(exact.to_f64());
            self.places = self.places.max(error / place);
            self.geo = self.geo.max(error * speed / size);
            let allowed = 10.0 * place + 4.0 * S::EPSILON.to_f64() * size / speed;
            self.bound = self.bound.max(error / allowed);
        }
    }

    fn show<S: Exact>(&self, table: &mut Table, name: &str, limit: Limit) {
        let Self { rays, hits, wrong, margin, places, geo, bound } = self;
        let name = format!("{} {name}", S::NAME);
        table.0 += &format!(
            "{name:34} {rays:7} {hits:7} {wrong:5} {margin:7} {places:10.2e} {geo:10.2e} {bound:9.3}\n"
        );
        assert!(*hits > rays / 6, "{name}: {hits} hits of {rays}");
        assert!(*margin <= limit.margin, "{name}: margin {margin}");
        assert!(*wrong <= rays / 10_000, "{name}: {wrong} of {rays} wrong");
        assert!(*places <= limit.places, "{name}: {places} places");
        assert!(*geo <= limit.geo, "{name}: geo {geo:e}");
        assert!(*bound <= limit.bound, "{name}: {bound} of the bound");
    }
}

/// What a class of rays may show at most.
#[derive(Clone, Copy)]
struct Limit {
    /// In ε·R, or steps.
    margin: f64,
    places: f64,
    geo: f64,
    bound: f64,
}

/// Lines that are printed together when they are complete, or when a limit is exceeded.
struct Table(String);

impl Table {
    fn new() -> Self {
        Self(format!(
            "\n{:34} {:>7} {:>7} {:>5} {:>7} {:>10} {:>10} {:>9}\n",
            "torus", "rays", "hits", "wrong", "margin", "places", "geo", "of bound"
        ))
    }
}

impl Drop for Table {
    fn drop(&mut self) {
        print!("{}", self.0);
    }
}

/// Without the gaps that hold no number of the format.
fn told_apart<S: Exact>(mut ends: Vec<Real>) -> Vec<Real> {
    let near = |ends: &[Real]| {
        let [exit, enter] = [1, 2].map(|i| S::from_f64(ends[i].to_f64()));
        // An exit as near as that to its entry is the next number.
        let exit = exit.max(S::from_f64(ends[0].to_f64()).next_up());
        exit >= enter
    };
    if ends.len() == 4 && near(&ends) {
        ends.drain(1..3);
    }
    ends
}

/// How many rays of a kind: the usual number, or for the two most telling kinds as many as
/// `NOSTRAY_RAYS` asks for.
fn rays(usual: u32, aim: Aim) -> u32 {
    let asked = std::env::var("NOSTRAY_RAYS").ok().and_then(|n| n.parse().ok());
    asked.filter(|_| matches!(aim, Aim::Random | Aim::Grazing)).unwrap_or(usual)
}

fn measure<S: Exact>(kind: Kind, aim: Aim, turned: bool, rays: u32) -> Row {
    let mut random = Random::new(kind as u64 * 100 + aim as u64 * 10 + u64::from(turned));
    let mut row = Row::default();
    while row.rays < rays {
        let subject = subject::<S>(kind, turned, &mut random);
        for _ in 0..4 {
            row.take(&subject, ray(aim, &mut random, &subject.frame));
        }
    }
    row
}

fn table<S: Exact>(kind: Kind, usual: u32, limit: impl Fn(Aim) -> Limit) {
    let mut table = Table::new();
    for aim in AIMS {
        for turned in [false, true] {
            let row = measure::<S>(kind, aim, turned, rays(usual, aim));
            let posture = if turned { "turned" } else { "upright" };
            row.show::<S>(&mut table, &format!("{kind:?} {posture}, {aim:?}"), limit(aim));
        }
    }
}

const FREE: Limit =
    Limit { margin: 1.0, places: f64::INFINITY, geo: f64::INFINITY, bound: f64::INFINITY };

fn in_f32(kind: Kind) {
    table::<f32>(kind, 150, |aim| match aim {
        Aim::Far => Limit { places: 2.0, ..FREE },
        _ => Limit { geo: 1e-5, ..FREE },
    });
}

fn in_f64(kind: Kind) {
    table::<f64>(kind, 150, |aim| match aim {
        Aim::Far => Limit { margin: 0.0, places: 2.0, ..FREE },
        _ => Limit { margin: 0.0, bound: 1.0, ..FREE },
    });
}

fn in_fixed_point<S: Exact>(kind: Kind) {
    table::<S>(kind, 100, |_| Limit { places: 3.0, ..FREE });
}

macro_rules! tests {
    ($($name:ident $test:ident $kind:ident)*) => { $(
        #[test]
        fn $name() {
            $test(Kind::$kind);
        }
    )* };
}

tests! {
    rings_f32 in_f32 Ring
    thin_f32 in_f32 Thin
    horns_f32 in_f32 Horn
    spindles_f32 in_f32 Spindle
    rings_f64 in_f64 Ring
    thin_f64 in_f64 Thin
    horns_f64 in_f64 Horn
    spindles_f64 in_f64 Spindle
}

#[test]
fn all_in_q16() {
    KINDS.into_iter().for_each(in_fixed_point::<Q16>);
}

#[test]
fn all_in_q32() {
    KINDS.into_iter().for_each(in_fixed_point::<Q32>);
}

/// Where a ray that starts on a torus is inside, checked between its ends.
struct Secondary<'a, S: Exact> {
    subject: &'a Subject<S>,
    ray: Ray<S>,
    /// How far rounding may move the start off the surface.
    slack: Real,
}

impl<S: Exact> Secondary<'_, S> {
    /// A point of the ray is inside the torus with its tube that much thicker.
    fn inside(&self, t: f64, slack: &Real) -> bool {
        let twin = &self.subject.twin;
        let path = S::path(&self.ray).through(&twin.rows, &twin.offset);
        let t = Real::from(t);
        twin.contains(&[0, 1, 2].map(|i| &path.origin[i] + &t * &path.dir[i]), slack)
    }

    /// Spans that are not in the torus, or gaps that are.
    fn wrong(&self, ends: &[S]) -> usize {
        let speed = length(self.ray.dir.to_array().map(|d| S::widen_unit(d).to_f64()));
        let far = self.subject.frame.size() * 10.0 / speed;
        let mut places = vec![0.0];
        places.extend(ends.iter().map(|t| t.to_f64()));
        places.push(far);
        let (starts_inside, less) = (ends.first() == Some(&S::ZERO), -&self.slack);
        let pairs = places.windows(2).skip(usize::from(starts_inside)).enumerate();
        let judged = pairs.map(|(index, pair)| {
            let middle = (pair[0] + pair[1]) / 2.0;
            let inside = (index % 2 == 0) == starts_inside;
            if inside { self.inside(middle, &self.slack) } else { !self.inside(middle, &less) }
        });
        judged.filter(|right| !right).count()
    }
}

/// Starts on hits of random rays; on both sides, from steep to nearly along the surface.
fn secondary<S: Exact>(kind: Kind, turned: bool, rays: u32) {
    let mut random = Random::new(77 + kind as u64);
    let (mut started, mut again, mut row) = (0, 0, [0; 2]);
    for _ in 0..rays {
        let subject = subject::<S>(kind, turned, &mut random);
        let scene = subject.builder.scene().expect("a legal scene");
        let vacant =
            Boundary { t: S::ZERO, node: 0, face: 0, passage: Passage::Touch, inverted: false };
        let ray = ray::<S>(Aim::Random, &mut random, &subject.frame);
        let Some(hit) = scene.nearest(ray, &mut [vacant; 4]).expect("room") else {
            continue;
        };
        started += 1;
        let contact = scene.contact(ray, &hit).expect("of this scene");
        let normal = contact.normal.to_array().map(|n| S::widen_unit(n).to_f64());
        let from = contact.position.to_array().map(S::to_f64);
        let reach = subject.frame.size() + length(from);
        let unit = S::FRACTION.map_or(S::EPSILON.to_f64() * reach, |f| f64::powi(2.0, -f));
        for inward in [true, false] {
            let lift = if inward { -1.0 } else { 1.0 } * random.decades(-6.0, 0.5);
            let aside = random.direction();
            let up: f64 = (0..3).map(|i| aside[i] * normal[i]).sum();
            let mut ray = S::ray(from, along(aside, lift - up, normal));
            ray.origin = contact.position;
            let start = Start { node: 0, face: 0, inward, local: contact.local };
            let ends = subject.ends(ray, Some(start));
            assert_eq!(ends.first() == Some(&S::ZERO), inward, "{kind:?}: {ends:?}");
            assert!(ends.iter().all(|&t| t >= S::ZERO), "{kind:?}: {ends:?}");
            again += u32::from(ends.len() > usize::from(inward) * 2);
            let slack = Real::from(4.0 * unit);
            let wrong = Secondary { subject: &subject, ray, slack }.wrong(&ends);
            row[usize::from(inward)] += wrong;
        }
    }
    let [outward, inward] = row;
    println!(
        "{} {kind:?}: {started} starts, {again} come back, wrong outward {outward}, inward {inward}",
        S::NAME
    );
    let enough = kind == Kind::Thin || again > started / 20;
    assert!(started > rays / 2 && enough, "{kind:?}: {started} {again}");
    assert_eq!(row, [0, 0], "{} {kind:?}", S::NAME);
}

#[test]
fn radii_are_positive_and_in_proportion() {
    let refused = |major: f64, minor: f64| {
        let builder = built::<f32>([0.0; 3], [0.0, 1.0, 0.0], major, minor);
        builder.expect_err("a torus that is none")
    };
    let at = Item::Node(0);
    assert_eq!(refused(0.0, 1.0), SceneError::NotPositive { at, field: "major" });
    assert_eq!(refused(1.0, f64::NAN), SceneError::NotFinite { at, field: "minor" });
    assert_eq!(refused(1.0, 1e30), SceneError::TooLarge { at, field: "minor" });
    // Thinner than the format tells points of the circle apart.
    assert_eq!(refused(1.0, 1e-6), SceneError::NotPositive { at, field: "minor" });
    assert!(built::<f64>([0.0; 3], [0.0, 1.0, 0.0], 1.0, 1e-6).is_ok());
    let flat = built::<f64>([0.0; 3], [0.0; 3], 1.0, 0.5).expect_err("a torus about nothing");
    assert_eq!(flat, SceneError::Empty { at, field: "axis" });
}

#[test]
fn no_ray_meets_the_surface_it_starts_on_and_none_loses_the_far_side() {
    for kind in KINDS {
        for turned in [false, true] {
            secondary::<f32>(kind, turned, 1500);
            secondary::<f64>(kind, turned, 1500);
            secondary::<Q16>(kind, turned, 500);
            secondary::<Q32>(kind, turned, 500);
        }
    }
}
