//! Bézier patches on rays at random and along the surface, against dense searches in double precision
//! that share no code with the tracer.
//!
//! `cargo test --test patch -- --nocapture` prints the tables; `NOSTRAY_RAYS=100000` sets how many rays
//! each row has. "hits" is how many there truly are, "wrong" counts rays with a different number of hits; "finer"
//! counts rays for which the oracle had to take its finest grid, and "open" those that it cannot decide in
//! double precision. "off" is the greatest distance of a hit from the surface, and "geo" the greatest |t error|·|dir| of
//! hits at more than 6 degrees, both over the size of the set.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

mod oracle;

use nostray::{Q16, Q32, Ray, Scalar};
use oracle::patch::{Crossing, cross};
use oracle::patches::{KINDS, Kind, Plan, Subject, exact};
use oracle::{Random, along, length};

/// How many rays a row has.
fn rays(default: u32) -> u32 {
    let asked = std::env::var("NOSTRAY_RAYS").ok();
    asked.map_or(default, |text| text.parse().expect("NOSTRAY_RAYS is a number"))
}

/// How a ray is laid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Aim {
    /// Through any point of the ball around the set.
    Random,
    /// Past a point of the surface, along it, at 10⁻⁶ to 10⁻¹ sizes.
    Grazing,
}

#[derive(Default)]
struct Row {
    rays: u32,
    hits: usize,
    most: usize,
    wrong: u32,
    finer: u32,
    open: u32,
    off: f64,
    geo: f64,
}

fn aimed<S: Scalar>(subject: &Subject<S>, aim: Aim, random: &mut Random) -> Ray<S> {
    let far = random.decades(0.3, 2.0);
    if aim == Aim::Random {
        let target = along(subject.center, subject.size, random.ball());
        let dir = random.direction();
        return subject.ray(random, target, dir, far);
    }
    let patch = random.below(subject.nets.len());
    let at = [0; 2].map(|_| random.within(0.0, 1.0));
    let [point, du, dv] = subject.surface(patch, at);
    let normal = cross(du, dv);
    let normal = normal.map(|x| x / length(normal).max(1e-300));
    let (turn, gap) = (random.within(0.0, 7.0), random.decades(-6.0, -1.0) * random.sign());
    let dir = along(du.map(|x| x * turn.cos()), turn.sin(), dv);
    let dir = dir.map(|x| x / length(dir).max(1e-300));
    subject.ray(random, along(point, gap * subject.size, normal), dir, far)
}

impl Row {
    fn take<S: Scalar>(&mut self, subject: &Subject<S>, ray: Ray<S>) {
        let found = subject.hits(ray, None);
        let (origin, dir) = exact(&ray);
        let (mut truth, mut finer, mut certain) = (Vec::<Crossing>::new(), false, true);
        for (_, seen) in subject.seen(origin, dir) {
            let (crossings, fine, sure) = seen.crossings();
            truth.extend(crossings);
            finer |= fine;
            certain &= sure;
        }
        truth.sort_by(|a, b| a.t.total_cmp(&b.t));
        self.rays += 1;
        self.hits += truth.len();
        self.most = self.most.max(truth.len());
        self.finer += u32::from(finer);
        self.open += u32::from(!certain);
        if found.len() != truth.len() {
            self.wrong += 1;
            if std::env::var_os("NOSTRAY_WRONG").is_some() {
                println!("{certain} {found:?}\n   {truth:?}");
            }
            return;
        }
        for ((t, _), truth) in found.iter().zip(&truth) {
            let error = (t.to_f64() - truth.t).abs() * length(dir) / subject.size;
            self.off = self.off.max(error * truth.cosine);
            if truth.cosine > 0.1 {
                self.geo = self.geo.max(error);
            }
        }
    }
}

/// A table over kinds and aims; the rows with their names.
fn table<S: Scalar>(count: u32, sizes: [f64; 2], aims: &[Aim]) -> Vec<(Kind, Aim, Row)> {
    println!(
        "\n{:24} {:>7} {:>7} {:>4} {:>6} {:>6} {:>5} {:>9} {:>9}",
        S::NAME,
        "rays",
        "hits",
        "most",
        "wrong",
        "finer",
        "open",
        "off",
        "geo"
    );
    let mut rows = Vec::new();
    for kind in KINDS {
        for &aim in aims {
            let mut random = Random::new(kind as u64 * 100 + aim as u64);
            let mut row = Row::default();
            while row.rays < count {
                let size = random.decades(sizes[0], sizes[1]);
                let offset = random.cube().map(|x| x * size * 2.0);
                let subject = Subject::<S>::new(&Plan::random(kind, &mut random), size, offset);
                for _ in 0..20 {
                    let ray = aimed(&subject, aim, &mut random);
                    row.take(&subject, ray);
                }
            }
            let Row { rays, hits, most, wrong, finer, open, off, geo } = &row;
            let name = format!("{kind:?}, {aim:?}");
            println!(
                "{name:24} {rays:7} {hits:7} {most:4} {wrong:6} {finer:6} {open:5} {off:9.1e} {geo:9.1e}"
            );
            rows.push((kind, aim, row));
        }
    }
    rows
}

#[test]
fn hits_in_double_precision() {
    for (kind, aim, row) in table::<f64>(rays(400), [-4.0, 4.0], &[Aim::Random, Aim::Grazing]) {
        assert_eq!(row.wrong, 0, "{kind:?}, {aim:?}");
        assert!(row.hits > 100);
    }
}

#[test]
fn hits_in_single_precision() {
    for (kind, aim, row) in table::<f32>(rays(400), [-4.0, 4.0], &[Aim::Random, Aim::Grazing]) {
        println!("{kind:?} {aim:?} {}", row.wrong);
    }
}

#[test]
fn hits_in_fixed_point() {
    for (kind, aim, row) in table::<Q16>(rays(100), [0.0, 1.5], &[Aim::Random, Aim::Grazing]) {
        println!("{kind:?} {aim:?} {}", row.wrong);
    }
    for (kind, aim, row) in table::<Q32>(rays(100), [0.0, 3.0], &[Aim::Random, Aim::Grazing]) {
        println!("{kind:?} {aim:?} {}", row.wrong);
    }
}
