//! Rays that start on the surface: none meets it again by rounding, none loses the far side.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]
#![allow(unreachable_pub, reason = "a module of a test program")]

use nostray::ray::Start;
use nostray::{Boundary, Node, Passage, Q16, Q32, Ray, Real as _, Vector};

use super::aim::{Way, ray};
use super::subject::{KINDS, Subject};
use super::{MARGIN, rays};
use crate::oracle::revolve::Aim;
use crate::oracle::steps::Exact;
use crate::oracle::{Path, Random, along, length};

/// A point of a surface.
struct Contact<S: Exact> {
    face: u32,
    local: S::Vec3,
    position: S::Vec3,
    normal: [f64; 3],
}

impl<S: Exact> Contact<S> {
    /// Where a random ray meets the solid.
    fn hit(this: &Subject<S>, random: &mut Random) -> Option<Self> {
        let vacant =
            Boundary { t: S::ZERO, node: 0, face: 0, passage: Passage::Touch, inverted: false };
        let scene = this.builder.scene().expect("a legal scene");
        let ray = ray(Way::Random, this, random);
        let mut buffer = vec![vacant; scene.limits().boundaries as usize];
        let hit = scene.nearest(ray, &mut buffer).expect("room")?;
        let contact = scene.contact(ray, &hit).expect("of this scene");
        let normal = contact.normal.to_array().map(|n| S::widen_unit(n).to_f64());
        let face = hit.boundary.face;
        Some(Self { face, local: contact.local, position: contact.position, normal })
    }

    /// On a random face, often within rounding of an edge.
    fn random(this: &Subject<S>, random: &mut Random) -> Self {
        let scene = this.builder.scene().expect("a legal scene");
        let parts = scene.parts();
        let Some(Node::Leaf(leaf)) = parts.nodes.first() else { panic!("one leaf") };
        let face = random.below(this.profile.pieces.len());
        let near = random.decades(-12.0, -1.0);
        let u = [near, 1.0 - near, random.within(0.0, 1.0)][random.below(3)];
        let [rho, y] = this.profile.pieces[face].at(u);
        let (sin, cos) = random.within(0.0, std::f64::consts::TAU).sin_cos();
        let near = [rho * cos, y, rho * sin].map(S::Wide::from_f64);
        let face = face as u32;
        let local = leaf.shape.snap(S::WideVec::from_array(near), face, &parts.tables);
        let normal = S::unit(leaf.shape.normal(local, face, &parts.tables));
        let normal = normal.to_array().map(|n| S::widen_unit(n).to_f64());
        Self { face, local, position: local + this.center, normal }
    }
}

#[derive(Default)]
struct Row {
    rays: u32,
    meets_itself: u32,
    loses_exit: u32,
    wrong: u32,
    margin: f64,
}

impl Row {
    fn take<S: Exact>(
        &mut self,
        this: &Subject<S>,
        contact: &Contact<S>,
        dir: [f64; 3],
        inward: bool,
    ) {
        self.rays += 1;
        let wide = S::WideVec::from_array(dir.map(S::Wide::from_f64));
        let ray = Ray { origin: contact.position, dir: S::unit(wide) };
        let start = Start { node: 0, face: contact.face, inward, local: contact.local };
        let spans = this.spans(ray, Some(start));
        let starts = spans.first().is_some_and(|[enter, _]| *enter == S::ZERO);
        assert!(spans.iter().flatten().skip(1).all(|t| *t > S::ZERO), "{spans:?}");
        self.loses_exit += u32::from(inward && !starts);
        self.meets_itself += u32::from(!inward && starts);
        // From the point that the start stands for, on the surface itself.
        let path = Path { origin: S::real_point(contact.local), dir: S::real_dir(ray.dir) };
        let aim = Aim::new(&path, &[0, 0, 0].map(|_| crate::oracle::Real::from(0.0)));
        let begin = aim.local(&crate::oracle::Real::from(0.0));
        let found: Vec<f64> = spans
            .iter()
            .flatten()
            .filter(|t| **t > S::ZERO)
            .map(|t| aim.local(&t.real()))
            .collect();
        let reach = this.size * 1.01 / length(aim.dir);
        let mut places = vec![begin];
        places.extend(&found);
        let middles: Vec<f64> = places.windows(2).map(|w| 0.5 * (w[0] + w[1])).collect();
        let mut all = super::scans::scan(&this.profile, &aim, reach, 200, &middles);
        let before = all.iter().filter(|t| **t <= begin).count();
        all.retain(|t| *t > begin);
        if (before % 2 == 1) != inward {
            all.push(begin);
        }
        all.extend(found);
        all.sort_by(f64::total_cmp);
        let mut margin = 0.0_f64;
        for pair in all.chunks(2) {
            let middle = 0.5 * (pair[0] + pair[pair.len() - 1]);
            let distance = this.profile.distance(aim.spot(middle));
            margin = margin.max(distance / S::rounding_of(this.size));
        }
        if margin > self.margin && std::env::var("SHOW").is_ok() {
            println!(
                "{margin} {:?} {inward} {:?} begin {begin} {spans:?} all {all:?} face {} local {:?} {:?}",
                aim.origin, aim.dir, contact.face, contact.local, this.profile.pieces
            );
        }
        self.margin = self.margin.max(margin);
        self.wrong += u32::from(margin > MARGIN);
    }
}

fn table<S: Exact>(few: u32, [low, high]: [f64; 2]) {
    println!(
        "{:8} {:>7} {:>6} {:>6} {:>6} {:>8}",
        S::NAME,
        "rays",
        "self",
        "lost",
        "wrong",
        "margin"
    );
    for kind in KINDS {
        let mut random = Random::new(kind as u64 + 77);
        let mut row = Row::default();
        let mut this = Subject::<S>::new(kind, &mut random, 1.0, [0.0; 3]);
        while row.rays < rays(few) {
            if row.rays.is_multiple_of(16) {
                let size = random.decades(low, high);
                this = Subject::<S>::new(kind, &mut random, size, [0.0; 3]);
            }
            let hit = if random.bits() & 1 == 0 { Contact::hit(&this, &mut random) } else { None };
            let contact = hit.unwrap_or_else(|| Contact::random(&this, &mut random));
            let (normal, mut dir) = (contact.normal, random.direction());
            if random.bits() & 1 == 0 {
                let tilt: f64 = (0..3).map(|i| dir[i] * normal[i]).sum();
                dir = along(dir, random.decades(-9.0, -1.0) * random.sign() - tilt, normal);
            }
            let dir = dir.map(|x| x / length(dir));
            let cosine: f64 = (0..3).map(|i| dir[i] * normal[i]).sum();
            let open = cosine.abs() < 2.0 * S::rounding_of(1.0);
            let inward = if open { random.bits() & 1 == 0 } else { cosine < 0.0 };
            row.take(&this, &contact, dir, inward);
        }
        let Row { rays, meets_itself, loses_exit, wrong, margin } = row;
        println!(
            "{:8} {rays:7} {meets_itself:6} {loses_exit:6} {wrong:6} {margin:8.2}",
            format!("{kind:?}")
        );
        // Steps of fixed point are so large that of a start near an edge the other side may be meant.
        if S::STEP.is_none() {
            assert_eq!((meets_itself, loses_exit), (0, 0), "{kind:?}");
            assert!(wrong <= rays / 50, "{kind:?}: {wrong} wrong");
        }
        assert_eq!(loses_exit, 0, "{kind:?}");
    }
}

#[test]
fn starts() {
    table::<f32>(500, [-4.0, 4.0]);
    table::<f64>(500, [-4.0, 4.0]);
    table::<Q16>(100, [-1.0, 2.0]);
    table::<Q32>(100, [-1.0, 2.0]);
}
