//! Rows of a table of errors, each against its limit.
#![allow(dead_code, unreachable_pub, reason = "each test program uses a part of the oracle")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

use nostray::ray::Line;
use nostray::{Ray, Tables};

use super::subject::Subject;
use super::{Float, Path, Real, Solid, array, length, ulp};

/// What a class of rays showed.
#[derive(Default)]
pub struct Row {
    pub rays: u32,
    pub hits: u32,
    pub wrong: u32,
    /// In ε·size.
    pub margin: f64,
    pub ulp: f64,
    pub geo: f64,
}

/// What it may show at most.
#[derive(Clone, Copy)]
pub struct Limit {
    pub margin: f64,
    pub ulp: f64,
    pub geo: f64,
}

const MARGINS: [f64; 12] =
    [0.0, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 64.0, 1024.0, 65536.0, f64::INFINITY];

/// The sizes that errors are told in: of the decision, and of the whole solid.
#[derive(Clone, Copy)]
pub struct Size {
    pub decision: f64,
    pub whole: f64,
}

impl Row {
    pub fn take<S: Float>(&mut self, subject: &Subject<S>, exact: &Solid, size: Size, ray: Ray<S>) {
        self.rays += 1;
        let path = Path::of(&ray);
        let found = subject.span(ray);
        let truth = exact.span(&path, &Real::from(0.0));
        self.hits += u32::from(truth.is_some());
        if found.is_some_and(|[_, exit]| exit > 0.0) {
            let bounds = subject.shape.bounds(subject.place.as_ref(), &Tables::EMPTY);
            assert!(bounds.meets(&Line::new(ray, None), S::FAR), "bounds lose {ray:?}");
        }
        match (found, &truth) {
            (Some(found), Some(truth)) => self.measure(found, truth, size.whole, ray),
            (None, None) => {}
            (found, _) => {
                self.wrong += 1;
                let sign = if found.is_some() { 1.0 } else { -1.0 };
                let unit = sign * S::EPSILON.to_f64() * size.decision;
                let agrees = |margin: f64| {
                    exact.span(&path, &Real::from(margin * unit)).is_some() == found.is_some()
                };
                let margin = MARGINS.into_iter().find(|&m| m.is_infinite() || agrees(m));
                self.margin = self.margin.max(margin.unwrap_or(f64::INFINITY));
            }
        }
    }

    fn measure<S: Float>(&mut self, found: [f64; 2], truth: &[Real; 2], size: f64, ray: Ray<S>) {
        let speed = length(array::<S>(ray.dir));
        // What is thinner than the numbers are apart is made as thick: its exit is no measure.
        let [enter, exit] = found;
        let [low, high] = truth;
        let thin = (high - low).to_f64() < ulp::<S>(low.to_f64());
        let made = thin && exit == S::from_f64(enter).next_up().to_f64();
        for (t, exact) in found.into_iter().zip(truth).take(if made { 1 } else { 2 }) {
            let rounded = exact.to_f64();
            if t.is_infinite() || rounded.abs() > 1e300 {
                assert!(t.is_infinite() && rounded.abs() > 1e300, "{t} for {rounded}");
                continue;
            }
            let error = (Real::from(t) - exact).abs().to_f64();
            self.ulp = self.ulp.max(error / ulp::<S>(rounded));
            self.geo = self.geo.max(error * speed / size);
        }
    }

    pub fn show(&self, table: &mut Table, name: &str, limit: Limit) {
        let Self { rays, hits, wrong, margin, ulp, geo } = self;
        table.0 +=
            &format!("{name:40} {rays:7} {hits:7} {wrong:6} {margin:7} {ulp:11.2e} {geo:11.2e}\n");
        assert!(*hits > rays / 5, "{name}: {hits} hits of {rays}");
        assert!(*margin <= limit.margin, "{name}: margin {margin} > {}", limit.margin);
        assert!(*ulp <= limit.ulp, "{name}: {ulp} ulp > {}", limit.ulp);
        assert!(*geo <= limit.geo, "{name}: geo {geo:e} > {:e}", limit.geo);
    }
}

/// Lines that are printed together when they are complete, or when a limit is exceeded.
pub struct Table(String);

impl Table {
    pub fn new<S: Float>(title: &str) -> Self {
        let title = format!("{}: {title}", S::NAME);
        Self(format!(
            "\n{title:40} {:>7} {:>7} {:>6} {:>7} {:>11} {:>11}\n",
            "rays", "hits", "wrong", "margin", "ulp", "geo"
        ))
    }
}

impl Drop for Table {
    fn drop(&mut self) {
        print!("{}", self.0);
    }
}
