//! Bézier patches on rays at random and along the surface, against dense searches in double precision
//! that share no code with the tracer.
//!
//! `cargo test --test solids patch::hits -- --nocapture` prints the tables; `NOSTRAY_RAYS=100000` sets how many rays
//! each row has. "hits" is how many there truly are, "wrong" counts rays with a different number of hits; "finer"
//! counts rays for which the oracle had to take its finest grid, and "open" those that it cannot decide in
//! double precision. "off" is the greatest distance of a hit from the surface, and "geo" the greatest |t error|·|dir| of
//! hits at more than 6 degrees, both over the size of the set.

use crate::oracle::patches::seen::{Crossing, cross};
use crate::oracle::patches::{KINDS, Kind, Plan, Subject, exact, rays};
use crate::oracle::{Random, along, length};
use nostray::{Q16, Q32, Ray, Scalar};

/// How a ray is laid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Aim {
    /// Through any point of the ball around the set.
    Random,
    /// Along the surface, past one of its points at up to a hundredth of the size.
    Silhouette,
    /// The same at 10⁻⁶ to 10⁻¹ sizes.
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
    let gap = match aim {
        Aim::Silhouette => random.within(-0.01, 0.01),
        _ => random.decades(-6.0, -1.0) * random.sign(),
    };
    let turn = random.within(0.0, 7.0);
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

const AIMS: [Aim; 3] = [Aim::Random, Aim::Silhouette, Aim::Grazing];

/// No ray has a wrong number of hits, but for those within rounding of a silhouette; how many that
/// may be of a thousand. Rays come from at most 100 sizes away, where in single precision t itself is rounded by 6e-6 sizes.
fn check(rows: &[(Kind, Aim, Row)], per_mille: u32, limit: f64) {
    for (kind, aim, row) in rows {
        let near =
            if *aim == Aim::Grazing { row.rays * per_mille / 1000 } else { row.rays / 10_000 };
        assert!(row.wrong <= near, "{kind:?}, {aim:?}: {} of {} wrong", row.wrong, row.rays);
        assert!(row.hits > row.rays as usize / 5 && row.open <= row.rays / 25);
        assert!(row.off <= limit && row.geo <= 2.0 * limit, "{kind:?}, {aim:?}: {:e}", row.off);
    }
}

#[test]
fn hits_in_double_precision() {
    check(&table::<f64>(rays(200), [-4.0, 4.0], &AIMS), 0, 1e-13);
}

#[test]
fn hits_in_single_precision() {
    check(&table::<f32>(rays(200), [-4.0, 4.0], &AIMS), 10, 1e-5);
}

/// In fixed point a step is the same length everywhere; the smallest sets are of size 1.
#[test]
fn hits_in_fixed_point() {
    check(&table::<Q16>(rays(60), [0.0, 1.5], &AIMS), 10, 4e-5);
    check(&table::<Q32>(rays(60), [0.0, 3.0], &AIMS), 0, 6e-10);
}
