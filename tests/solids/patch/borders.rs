//! Where patches meet and where rays start on them: no gap along shared sides and no hit counted twice; no ray meets
//! the place it starts from again, and none loses what lies ahead.
//!
//! `cargo test --test solids patch::borders -- --nocapture` prints the figures; `NOSTRAY_RAYS=100000` sets how many rays a
//! row has. "open" counts rays whose hits the oracle cannot count in double precision.

use crate::oracle::patches::seen::{Crossing, Net, cross, dot, nearest};
use crate::oracle::patches::{KINDS, Plan, Subject, array, exact, rays};
use crate::oracle::{Random, along, length};
use nostray::ray::Start;
use nostray::{Patches, Q16, Q32, Ray, Real, Scalar, Vector};

/// The rounding of a format, or what it makes of the parameters of a start, over the size.
fn rounding<S: Scalar>() -> f64 {
    let root = S::EPSILON_ROOT.to_f64();
    S::Wide::EPSILON.to_f64().max(root * root / 16.0)
}

/// Parameters on a side of a patch.
fn on_side(side: usize, s: f64) -> [f64; 2] {
    [[s, 0.0], [1.0, s], [1.0 - s, 1.0], [0.0, 1.0 - s]][side]
}

fn control(net: &Net, side: usize) -> [[f64; 3]; 4] {
    [0, 1, 2, 3].map(|k| {
        let (i, j) = [(k, 0), (3, k), (3 - k, 3), (0, 3 - k)][side];
        net[j][i]
    })
}

/// A side of a patch.
type Side = (usize, usize);

/// Pairs of sides with the same control points, other than a point alone.
fn shared(nets: &[Net]) -> Vec<[Side; 2]> {
    let sides = || (0..nets.len()).flat_map(|patch| (0..4).map(move |side| (patch, side)));
    let mut pairs = Vec::new();
    for a in sides() {
        let mut there = control(&nets[a.0], a.1);
        there.reverse();
        if there.iter().all(|p| *p == there[0]) {
            continue;
        }
        let others = sides().filter(|b| *b > a);
        pairs.extend(others.filter(|b| control(&nets[b.0], b.1) == there).map(|b| [a, b]));
    }
    pairs
}

/// What rays at shared sides showed.
#[derive(Default)]
struct Seams {
    shot: u32,
    leaks: u32,
    twice: u32,
    /// Rays that see one of the two patches edge on, or the side as a silhouette: they may miss, or hit twice.
    edge_on: u32,
}

impl Seams {
    fn take<S: Scalar>(&mut self, subject: &Subject<S>, pair: [Side; 2], random: &mut Random) {
        let [(patch, side), (other, other_side)] = pair;
        let s = random.within(0.0, 1.0);
        let [point, du, dv] = subject.surface(patch, on_side(side, s));
        let [_, other_du, other_dv] = subject.surface(other, on_side(other_side, 1.0 - s));
        let (dir, far) = (random.direction(), random.decades(0.0, 2.0));
        let ray = subject.ray(random, point, dir, far);
        let (origin, dir) = exact(&ray);
        let cosine = |du: [f64; 3], dv: [f64; 3]| {
            let normal = cross(du, dv);
            dot(normal, dir) / (length(normal) * length(dir))
        };
        let (sight, other_sight) = (cosine(du, dv), cosine(other_du, other_dv));
        self.shot += 1;
        if sight.abs().min(other_sight.abs()) < 0.01 || sight * other_sight < 0.0 {
            self.edge_on += 1;
            return;
        }
        let t = dot(along(point, -1.0, origin), dir) / dot(dir, dir);
        // What rounding makes of the place, and of t itself.
        let reach = rounding::<S>() * (subject.size / sight.abs() + t.abs() * length(dir));
        let reach = 64.0 * reach / length(dir);
        let hits = subject.hits(ray, None);
        let near = |hit: &&(S, u32)| (hit.0.to_f64() - t).abs() <= reach;
        self.leaks += u32::from(!hits.iter().any(|hit| near(&hit)));
        let of_pair = |hit: &&(S, u32)| {
            let of = usize::from(Patches::<S>::patch(hit.1));
            of == patch || of == other
        };
        let close: Vec<_> = hits.iter().filter(near).filter(of_pair).collect();
        let place = 16.0 * S::Wide::EPSILON.to_f64() * subject.size / (length(dir) * sight.abs());
        let same = |a: &(S, u32), b: &(S, u32)| {
            let step = 4.0 * S::rounding(a.0.abs().widen()).to_f64();
            (b.0.to_f64() - a.0.to_f64()).abs() <= place + step
                && Patches::<S>::patch(a.1) != Patches::<S>::patch(b.1)
        };
        if close.windows(2).any(|pair| same(pair[0], pair[1])) {
            self.twice += 1;
            if std::env::var_os("NOSTRAY_WRONG").is_some() {
                println!("{pair:?} at {s}, cosine {sight}, t {t} ± {reach}: {hits:?}");
            }
        }
    }
}

/// Rays at points of the teapot's shared sides.
fn seams<S: Scalar>(count: u32) {
    let mut random = Random::new(17);
    let mut seams = Seams::default();
    while seams.shot < count {
        let size = random.decades(-0.5, 1.5);
        let offset = random.cube().map(|x| x * size * 2.0);
        let subject = Subject::<S>::new(&Plan::teapot(), size, offset);
        let pairs = shared(&subject.nets);
        assert!(pairs.len() > 40, "{} shared sides", pairs.len());
        for _ in 0..500 {
            seams.take(&subject, pairs[random.below(pairs.len())], &mut random);
        }
    }
    let Seams { shot, leaks, twice, edge_on } = seams;
    println!(
        "{}: {shot} rays at shared sides, {leaks} leaks, {twice} twice, {edge_on} edge on",
        S::NAME
    );
    assert_eq!((leaks, twice), (0, 0), "{}", S::NAME);
    assert!(edge_on < shot / 10);
}

#[test]
fn shared_sides_have_no_gap_in_single_precision() {
    seams::<f32>(rays(10_000));
}

#[test]
fn shared_sides_have_no_gap_in_double_precision() {
    seams::<f64>(rays(5_000));
}

#[test]
fn shared_sides_have_no_gap_in_fixed_point() {
    seams::<Q16>(rays(1_000));
    seams::<Q32>(rays(1_000));
}

/// A ray from a point of the surface, and what it truly meets, as far as that is certain.
struct Departure<S: Scalar> {
    ray: Ray<S>,
    start: Start<S>,
    at: [f64; 2],
    truth: Option<Vec<Ahead>>,
}

/// A crossing ahead of a start, and whether the ray rises clearly from the surface before it.
#[derive(Clone, Copy, Debug)]
struct Ahead {
    crossing: Crossing,
    clear: bool,
}

/// A parameter, often close to a side.
fn parameter(random: &mut Random) -> f64 {
    let x =
        if random.bits() & 3 == 0 { random.decades(-9.0, -1.0) } else { random.within(0.0, 1.0) };
    if random.bits() & 1 == 0 { x } else { 1.0 - x }
}

fn departure<S: Scalar>(
    subject: &Subject<S>,
    random: &mut Random,
    grazing: bool,
) -> Option<Departure<S>> {
    let scene = subject.builder.scene().expect("a legal scene");
    let (leaf, tables) = (subject.leaf(), &scene.parts().tables);
    let patch = random.below(subject.nets.len());
    let at = [parameter(random), parameter(random)];
    let [point, ..] = subject.surface(patch, at);
    // The face as a ray from outside gives it.
    let towards = random.direction();
    let sighting = subject.ray(random, point, towards, 3.0);
    let (from, dir) = exact(&sighting);
    let t = dot(along(point, -1.0, from), dir) / dot(dir, dir);
    let gap = |hit: &(S, u32)| (hit.0.to_f64() - t).abs() * length(dir);
    let hits = subject.hits(sighting, None);
    let hit = hits.iter().min_by(|a, b| gap(a).total_cmp(&gap(b)))?;
    let face = Some(hit).filter(|hit| gap(hit) <= subject.size * 1e-3)?.1;
    let center = array::<S>(leaf.shape.centre());
    let wide = |v: [f64; 3]| S::WideVec::from_array(v.map(<S::Wide as Real>::from_f64));
    let local = leaf.shape.snap(wide(along(point, -1.0, center)), face, tables);
    let normal = leaf.shape.normal(local, face, tables).to_array().map(|x| x.to_f64());
    let normal = normal.map(|x| x / length(normal));
    let mut dir = random.direction();
    if grazing {
        dir = along(dir, random.decades(-7.0, -1.0) * random.sign() - dot(dir, normal), normal);
    }
    let dir = S::steer(wide(dir.map(|x| x / length(dir)))).0;
    let exact_dir = dir.to_array().map(|d| S::widen_unit(d).to_f64());
    let start = Start { node: 0, face, inward: dot(exact_dir, normal) < 0.0, local };
    let ray = Ray { origin: local + leaf.shape.centre(), dir };
    let patch = usize::from(Patches::<S>::patch(face));
    let guess = leaf.shape.uv(local, face, tables).map(S::to_f64);
    let at = nearest(&subject.nets[patch], guess, along(center, 1.0, array::<S>(local)));
    let truth = ahead(subject, patch, at, exact_dir);
    Some(Departure { ray, start, at, truth })
}

/// What a ray from a point of a patch truly meets; `None` where that is not certain.
fn ahead<S: Scalar>(
    subject: &Subject<S>,
    patch: usize,
    at: [f64; 2],
    dir: [f64; 3],
) -> Option<Vec<Ahead>> {
    let [point, ..] = subject.surface(patch, at);
    let mut truth = Vec::new();
    for (other, seen) in subject.seen(point, dir) {
        let (mut crossings, _, certain) = seen.crossings();
        if !certain {
            return None;
        }
        let own = (0..crossings.len()).filter(|_| other == patch);
        let own = own.min_by(|&i, &j| crossings[i].t.abs().total_cmp(&crossings[j].t.abs()));
        if let Some(own) = own {
            let c = crossings.remove(own);
            let apart = (c.at[0] - at[0]).abs() + (c.at[1] - at[1]).abs();
            let far = c.t.abs() * length(dir) / subject.size;
            assert!(apart < 1e-6 || far < 1e-13, "the start of the ray is not on it");
        }
        truth.extend(crossings.into_iter().filter(|c| c.t > 0.0).map(|crossing| {
            let height = crossing.t * length(dir) * crossing.cosine / 4.0;
            Ahead { crossing, clear: height > 16.0 * rounding::<S>() * subject.size }
        }));
    }
    Some(truth)
}

/// What rays from the surface showed.
#[derive(Default)]
struct Outcome {
    rays: u32,
    hits: usize,
    /// Hits where there truly are none.
    invented: u32,
    lost: usize,
    open: u32,
}

impl Outcome {
    fn take<S: Scalar>(&mut self, subject: &Subject<S>, departure: &Departure<S>) {
        self.rays += 1;
        let Some(mut truth) = departure.truth.clone() else {
            self.open += 1;
            return;
        };
        self.hits += truth.iter().filter(|ahead| ahead.clear).count();
        let dir = exact(&departure.ray).1;
        let found = subject.hits(departure.ray, Some(departure.start));
        let mut invented = 0;
        for (t, _) in &found {
            let gap =
                |ahead: &Ahead| (ahead.crossing.t - t.to_f64()).abs() * length(dir) / subject.size;
            let best = (0..truth.len())
                .min_by(|&i, &j| gap(&truth[i]).total_cmp(&gap(&truth[j])))
                .filter(|&i| gap(&truth[i]) * truth[i].crossing.cosine <= 32.0 * rounding::<S>());
            match best {
                Some(best) => drop(truth.remove(best)),
                None => invented += 1,
            }
        }
        truth.retain(|ahead| ahead.clear);
        self.invented += invented;
        self.lost += truth.len();
        let wrong = invented > 0 || !truth.is_empty();
        if wrong && std::env::var_os("NOSTRAY_WRONG").is_some() {
            let Departure { start, at, truth, .. } = departure;
            println!("from {at:?}, {start:?}\n   found {found:?}\n   of {truth:?}");
        }
    }
}

/// Rays from the surface: at random and along it, at an angle of 10⁻⁷ to 10⁻¹.
fn starts<S: Scalar>(count: u32) {
    for (n, kind) in (0..).zip(KINDS) {
        for grazing in [false, true] {
            let mut random = Random::new(23 + n);
            let mut outcome = Outcome::default();
            while outcome.rays < count {
                let size = random.decades(-0.5, 1.5);
                let offset = random.cube().map(|x| x * size);
                let subject = Subject::<S>::new(&Plan::random(kind, &mut random), size, offset);
                for _ in 0..20 {
                    if let Some(departure) = departure(&subject, &mut random, grazing) {
                        outcome.take(&subject, &departure);
                    }
                }
            }
            let Outcome { rays, hits, invented, lost, open } = outcome;
            let name = format!("{} {kind:?}{}", S::NAME, if grazing { ", grazing" } else { "" });
            println!(
                "{name:24} {rays:7} starts, {hits:7} hits: {invented} invented, {lost} lost, {open} open"
            );
            assert_eq!((invented, lost), (0, 0), "{name}");
            assert!(open < rays * 2 / 5, "{name}: {open} open");
        }
    }
}

#[test]
fn starts_in_single_precision() {
    starts::<f32>(rays(160));
}

#[test]
fn starts_in_double_precision() {
    starts::<f64>(rays(160));
}

#[test]
fn starts_in_fixed_point() {
    starts::<Q16>(rays(40));
    starts::<Q32>(rays(40));
}
