//! Rays from free space.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]
#![allow(unreachable_pub, reason = "a module of a test program")]

use nostray::{Q16, Q32, Ray};

use super::aim::{WAYS, Way, ray};
use super::rays;
use super::subject::{KINDS, Subject};
use crate::oracle::revolve::{Aim, Profile};
use crate::oracle::steps::Exact;
use crate::oracle::{Path, Random, length};

/// What a class of rays showed.
#[derive(Default)]
struct Row {
    rays: u32,
    hits: u32,
    wrong: u32,
    margin: f64,
    geo: f64,
}

use super::MARGIN;

/// The true spans: where membership changes among many samples and those that are given.
pub fn scan(profile: &Profile, aim: &Aim, reach: f64, samples: u32, more: &[f64]) -> Vec<f64> {
    let even = (0..=samples).map(|i| reach * (f64::from(2 * i) / f64::from(samples) - 1.0));
    let mut at: Vec<f64> = even.chain(more.iter().copied().filter(|t| t.abs() < reach)).collect();
    at.sort_by(f64::total_cmp);
    let inside = |t: f64| profile.contains(aim.spot(t));
    let mut ends = Vec::new();
    let mut last = (at[0], inside(at[0]));
    for &t in &at[1..] {
        let now = inside(t);
        if now != last.1 {
            let (mut low, mut high) = (last.0, t);
            for _ in 0..100 {
                let middle = 0.5 * (low + high);
                if middle <= low || middle >= high {
                    break;
                }
                if inside(middle) == now { high = middle } else { low = middle }
            }
            ends.push(0.5 * (low + high));
        }
        last = (t, now);
    }
    ends
}

impl Row {
    fn take<S: Exact>(&mut self, this: &Subject<S>, ray: Ray<S>, samples: u32) {
        self.rays += 1;
        let path = Path { origin: S::real_point(ray.origin), dir: S::real_dir(ray.dir) };
        let aim = Aim::new(&path, &S::real_point(this.center));
        let found: Vec<f64> =
            this.spans(ray, None).iter().flatten().map(|t| aim.local(&t.real())).collect();
        let speed = length(aim.dir);
        let reach = this.size * 1.01 / speed;
        let middles: Vec<f64> = found.windows(2).map(|w| 0.5 * (w[0] + w[1])).collect();
        let truth = scan(&this.profile, &aim, reach, samples, &middles);
        self.hits += u32::from(!truth.is_empty());
        let unit = S::rounding_of(this.size);
        // Between an odd number of ends of both kinds the two differ.
        let mut all: Vec<f64> = found.iter().chain(&truth).copied().collect();
        all.sort_by(f64::total_cmp);
        let mut ray_margin = 0.0_f64;
        for pair in all.chunks(2) {
            let middle = 0.5 * (pair[0] + pair[pair.len() - 1]);
            let distance = this.profile.distance(aim.spot(middle)) / unit;
            ray_margin = ray_margin.max(distance);
        }
        if ray_margin > self.margin && std::env::var("SHOW").is_ok() {
            println!(
                "{ray_margin} {:?} {:?} {:?} found {found:?} truth {truth:?} {:?}",
                aim.origin, aim.dir, ray.origin, this.profile
            );
        }
        self.margin = self.margin.max(ray_margin);
        if found.len() == truth.len() {
            for (a, b) in found.iter().zip(&truth) {
                let step = 1e-3 * this.size / speed;
                let [p, q] = [b - step, b + step].map(|t| this.profile.about(aim.spot(t)));
                if p.min(q) > 0.1e-3 * this.size {
                    let error = (a - b).abs() * speed;
                    self.geo = self.geo.max(if S::STEP.is_some() {
                        error / unit
                    } else {
                        error / this.size
                    });
                }
            }
        }
        // Of two that lie on the surface itself neither is wrong.
        self.wrong += u32::from(found.len() != truth.len() && ray_margin > MARGIN);
    }
}

fn table<S: Exact>(few: u32, geo_max: f64, [low, high]: [f64; 2]) {
    println!(
        "{:8} {:8} {:>7} {:>7} {:>6} {:>8} {:>9}",
        S::NAME,
        "",
        "rays",
        "hits",
        "wrong",
        "margin",
        "geo"
    );
    let (mut all, mut met) = (0, 0);
    for kind in KINDS {
        for way in WAYS {
            let mut random = Random::new(kind as u64 * 100 + way as u64);
            let mut row = Row::default();
            let mut this = Subject::<S>::new(kind, &mut random, 1.0, [0.0; 3]);
            while row.rays < rays(few) {
                if row.rays.is_multiple_of(16) {
                    let size = random.decades(low, high);
                    let far = if random.bits() & 1 == 0 { 3.0 * size } else { 0.0 };
                    let center = random.cube().map(|x| x * far);
                    this = Subject::<S>::new(kind, &mut random, size, center);
                }
                row.take(&this, ray(way, &this, &mut random), 400);
            }
            let Row { rays, hits, wrong, margin, geo } = row;
            println!(
                "{:8} {:8} {rays:7} {hits:7} {wrong:6} {margin:8.2} {geo:9.2e}",
                format!("{kind:?}"),
                format!("{way:?}")
            );
            (all, met) = (all + rays, met + hits);
            assert!(wrong == 0 && margin <= MARGIN, "{kind:?} {way:?}: {wrong} wrong, {margin}");
            let geo_max = if way == Way::Grazing { geo_max.sqrt() } else { geo_max };
            assert!(geo <= geo_max, "{kind:?} {way:?}: {geo:e}");
        }
    }
    assert!(met > all / 3, "{met} hits of {all}");
}

#[test]
fn against_scans_f64() {
    table::<f64>(48, 1e-11, [-4.0, 4.0]);
}

#[test]
fn against_scans_f32() {
    table::<f32>(48, 1e-5, [-4.0, 4.0]);
}

#[test]
fn against_scans_q32() {
    table::<Q32>(24, 1.0, [-1.0, 2.0]);
}

#[test]
fn against_scans_q16() {
    table::<Q16>(24, 1.0, [-1.0, 2.0]);
}
