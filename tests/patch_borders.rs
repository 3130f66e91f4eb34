//! Where patches meet and where rays start on them: no gap along shared borders and none counted twice; no ray meets
//! the place it starts from again, and none loses what lies ahead.
//!
//! `cargo test --test patch_borders -- --nocapture` prints the figures; `NOSTRAY_RAYS=100000` sets how many rays.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

mod oracle;

use nostray::ray::Start;
use nostray::{Patches, Q16, Q32, Ray, Real, Scalar, Vector};
use oracle::patch::{Crossing, Net, cross, surface};
use oracle::patches::{KINDS, Kind, Plan, Subject, array, exact, vector};
use oracle::{Random, along, length};

fn rays(default: u32) -> u32 {
    let asked = std::env::var("NOSTRAY_RAYS").ok();
    asked.map_or(default, |text| text.parse().expect("NOSTRAY_RAYS is a number"))
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

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

/// Pairs of sides with the same control points, other than a point alone.
fn shared(nets: &[Net]) -> Vec<[(usize, usize); 2]> {
    let sides = || (0..nets.len()).flat_map(|patch| (0..4).map(move |side| (patch, side)));
    let mut pairs = Vec::new();
    for a in sides() {
        let mut there = control(&nets[a.0], a.1);
        there.reverse();
        if there.iter().all(|p| *p == there[0]) {
            continue;
        }
        for b in sides().filter(|b| *b > a) {
            if control(&nets[b.0], b.1) == there {
                pairs.push([a, b]);
            }
        }
    }
    pairs
}

/// Rays at points of shared sides.
fn leaks<S: Scalar>(count: u32) {
    let mut random = Random::new(17);
    let [mut leaked, mut twice, mut edge_on, mut shot] = [0; 4];
    while shot < count {
        let size = random.decades(-0.5, 1.5);
        let offset = random.cube().map(|x| x * size * 2.0);
        let subject = Subject::<S>::new(&Plan::teapot(), size, offset);
        let pairs = shared(&subject.nets);
        assert!(pairs.len() > 40, "{} shared sides", pairs.len());
        for _ in 0..500 {
            let [(patch, side), (other, other_side)] = pairs[random.below(pairs.len())];
            let s = random.within(0.0, 1.0);
            let [point, du, dv] = subject.surface(patch, on_side(side, s));
            let [_, other_du, other_dv] = subject.surface(other, on_side(other_side, 1.0 - s));
            let (dir, far) = (random.direction(), random.decades(0.0, 2.0));
            let ray = subject.ray(&mut random, point, dir, far);
            let (origin, dir) = exact(&ray);
            let cosine = |du: [f64; 3], dv: [f64; 3]| {
                let normal = cross(du, dv);
                dot(normal, dir) / (length(normal) * length(dir))
            };
            let sight = cosine(du, dv);
            let flat = sight.abs().min(cosine(other_du, other_dv).abs()) < 0.01;
            shot += 1;
            if flat || sight * cosine(other_du, other_dv) < 0.0 {
                edge_on += 1;
                continue;
            }
            let t = dot(along(point, -1.0, origin), dir) / dot(dir, dir);
            let reach = subject.size * 64.0 * rounding::<S>() / (length(dir) * sight.abs());
            let hits = subject.hits(ray, None);
            match hits.iter().filter(|hit| (hit.0.to_f64() - t).abs() <= reach).count() {
                0 => leaked += 1,
                1 => {}
                _ => {
                    twice += 1;
                    if std::env::var_os("NOSTRAY_WRONG").is_some() {
                        println!(
                            "twice ({patch},{side},{other},{other_side}) s {s} sight {sight} reach {reach} t {t} {:?}",
                            hits.iter()
                                .map(|h| (h.0, h.1 >> 10, (h.1 >> 5) & 31, h.1 & 31))
                                .collect::<Vec<_>>()
                        );
                        for (p, seen) in subject.seen(origin, dir) {
                            for c in seen.crossings().0 {
                                println!("   {p} {c:?}");
                            }
                        }
                    }
                }
            }
        }
    }
    println!(
        "\n{}: {shot} rays at shared sides, {leaked} leaks, {twice} hits counted twice, {edge_on} edge on",
        S::NAME
    );
    assert!(leaked == 0 && twice == 0 && edge_on < shot / 10);
}

#[test]
fn shared_sides_have_no_gap() {
    leaks::<f32>(rays(20_000));
    leaks::<f64>(rays(5_000));
    leaks::<Q16>(rays(1_000));
    leaks::<Q32>(rays(1_000));
}

#[derive(Default)]
struct Outcome {
    rays: u32,
    /// Hits where the exact ray has none.
    invented: u32,
    lost: u32,
    open: u32,
    hits: usize,
}

/// A ray from a point of the surface, and what it truly meets ahead.
struct Departure<S: Scalar> {
    ray: Ray<S>,
    start: Start<S>,
    truth: Vec<(Crossing, bool)>,
    at: [f64; 2],
    open: bool,
}

fn departure<S: Scalar>(
    subject: &Subject<S>,
    random: &mut Random,
    grazing: bool,
) -> Option<Departure<S>> {
    let scene = subject.builder.scene().expect("a legal scene");
    let (leaf, tables) = (subject.leaf(), &scene.parts().tables);
    let patch = random.below(subject.nets.len());
    let near_side = |random: &mut Random| {
        let x = random.within(0.0, 1.0);
        let out = if random.bits() & 3 == 0 { random.decades(-9.0, -1.0) } else { x };
        if random.bits() & 1 == 0 { out } else { 1.0 - out }
    };
    let at = [0; 2].map(|_| near_side(random));
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
    let patch = usize::from(Patches::<S>::patch(face));
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
    let inward = dot(exact_dir, normal) < 0.0;
    let start = Start { node: 0, face, inward, local };
    let ray = Ray { origin: local + leaf.shape.centre(), dir };
    let local = along(center, 1.0, array::<S>(local));
    let at = leaf.shape.uv(start.local, face, tables).map(S::to_f64);
    let told = at;
    let at = nearest(&subject.nets[patch], at, local);
    if std::env::var_os("NOSTRAY_WRONG").is_some() && (0..2).any(|i| (told[i] - at[i]).abs() > 1e-3)
    {
        println!("located {told:?} for {at:?} patch {patch} face {face}");
    }
    let truth = ahead(subject, patch, at, exact_dir).unwrap_or_else(|| vec![]);
    let open = ahead(subject, patch, at, exact_dir).is_none();
    Some(Departure { ray, start, truth, at, open })
}

/// The parameters of the point of a patch nearest to a point close to it, by Gauss and Newton.
fn nearest(net: &Net, mut at: [f64; 2], to: [f64; 3]) -> [f64; 2] {
    for _ in 0..20 {
        let [point, du, dv] = surface(net, at);
        let off = along(to, -1.0, point);
        let (uu, uv, vv) = (dot(du, du), dot(du, dv), dot(dv, dv));
        let (u, v, det) = (dot(du, off), dot(dv, off), uu * vv - uv * uv);
        let step = [(u * vv - v * uv) / det, (v * uu - u * uv) / det];
        if step.iter().any(|x| !x.is_finite()) {
            break;
        }
        let next = [0, 1].map(|i| (at[i] + step[i]).clamp(0.0, 1.0));
        if length(along(to, -1.0, surface(net, next)[0])) >= length(off) {
            break;
        }
        at = next;
    }
    at
}

/// What a ray from a point of a patch truly meets, and whether that is beyond rounding of the start.
fn ahead<S: Scalar>(
    subject: &Subject<S>,
    patch: usize,
    at: [f64; 2],
    dir: [f64; 3],
) -> Option<Vec<(Crossing, bool)>> {
    let [point, ..] = subject.surface(patch, at);
    let mut truth = Vec::new();
    let mut open = false;
    for (other, seen) in subject.seen(point, dir) {
        let (mut crossings, _, certain) = seen.crossings();
        open |= !certain;
        let distance = |c: &Crossing| (c.at[0] - at[0]).abs() + (c.at[1] - at[1]).abs();
        let own = (0..crossings.len()).filter(|_| other == patch);
        let own = own.min_by(|&i, &j| crossings[i].t.abs().total_cmp(&crossings[j].t.abs()));
        let here = |c: &Crossing| (c.t * length(dir)).abs() < 1e-13 * subject.size;
        let own = own.filter(|&own| distance(&crossings[own]) < 1e-6 || here(&crossings[own]));
        if let Some(own) = own {
            crossings.remove(own);
        }
        truth.extend(crossings.into_iter().map(|c| {
            // How high the ray rises over the surface in between.
            let height = c.t * length(dir) * c.cosine / 4.0;
            (c, height > 16.0 * rounding::<S>() * subject.size)
        }));
    }
    (!open).then_some(truth)
}

fn secondary<S: Scalar>(count: u32, grazing: bool) {
    let mut random = Random::new(23);
    for kind in KINDS {
        let mut outcome = Outcome::default();
        while outcome.rays < count {
            let size = random.decades(-0.5, 1.5);
            let offset = random.cube().map(|x| x * size);
            let subject = Subject::<S>::new(&Plan::random(kind, &mut random), size, offset);
            for _ in 0..20 {
                let Some(departure) = departure(&subject, &mut random, grazing) else {
                    continue;
                };
                outcome.rays += 1;
                if departure.open {
                    outcome.open += 1;
                    continue;
                }
                let dir = exact(&departure.ray).1;
                let found = subject.hits(departure.ray, Some(departure.start));
                let mut truth: Vec<&(Crossing, bool)> =
                    departure.truth.iter().filter(|t| t.0.t > 0.0).collect();
                outcome.hits += truth.iter().filter(|t| t.1).count();
                for (t, face) in &found {
                    let gap = |c: &Crossing| (c.t - t.to_f64()).abs() * length(dir) / subject.size;
                    let best = (0..truth.len())
                        .min_by(|&i, &j| gap(&truth[i].0).total_cmp(&gap(&truth[j].0)));
                    let fits = |c: &Crossing| gap(c) * c.cosine <= 32.0 * rounding::<S>();
                    if let Some(best) = best.filter(|&best| fits(&truth[best].0)) {
                        truth.remove(best);
                    } else {
                        outcome.invented += 1;
                        if std::env::var_os("NOSTRAY_WRONG").is_some() {
                            let center = array::<S>(subject.leaf().shape.centre());
                            let _ = center;
                            let from = exact(&departure.ray).0;
                            let at = along(from, t.to_f64(), dir);
                            let net = &subject.nets
                                [usize::from(*face) >> if kind == Kind::Teapot { 10 } else { 10 }];
                            let bits = 32.0;
                            let cell = [f64::from((*face >> 5) & 31), f64::from(*face & 31)]
                                .map(|x| (x + 0.5) / bits);
                            let uv = nearest(net, cell, at);
                            let off = length(along(surface(net, uv)[0], -1.0, at)) / subject.size;
                            println!(
                                "invented {:?} {face} uv {uv:?} off {off:e} start {:?} inward {} of {:?}",
                                t.to_f64() * length(dir) / subject.size,
                                departure.at,
                                departure.start.inward,
                                departure.truth
                            );
                        }
                    }
                }
                truth.retain(|t| t.1);
                outcome.lost += truth.len() as u32;
                if std::env::var_os("NOSTRAY_WRONG").is_some() && !truth.is_empty() {
                    println!(
                        "lost {truth:?} found {found:?} start {:?} of {:?} again {:?}",
                        departure.at,
                        departure.truth,
                        subject.hits(departure.ray, None)
                    );
                }
            }
        }
        let Outcome { rays, invented, lost, hits, open } = outcome;
        let name = format!("{kind:?}");
        println!(
            "{} {name:8} grazing {grazing}: {rays} rays, {hits} hits, {invented} invented, {lost} lost, {open} open",
            S::NAME
        );
    }
}

#[test]
fn starts() {
    for grazing in [false, true] {
        secondary::<f64>(rays(400), grazing);
        secondary::<f32>(rays(400), grazing);
        secondary::<Q16>(rays(100), grazing);
        secondary::<Q32>(rays(100), grazing);
    }
    let _ = (surface, vector::<f32>, Kind::Fan);
}
