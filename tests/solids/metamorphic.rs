//! What must stay the same when a question is asked in another way: of every kind of solid, in
//! every number format.
//!
//! The solids are written as in scene files, so one line makes a new kind part of all of this.
#![allow(clippy::expect_used, clippy::panic, clippy::indexing_slicing, reason = "tests may panic")]
#![allow(
    clippy::disallowed_methods,
    reason = "a measure of errors need not be the same to the bit"
)]

use crate::oracle::{Random, length};
use nostray::{Boundary, Passage, Q16, Q32, Ray, Real, Scalar, Vector};
use nostray_harness::Assembly;
use nostray_harness::read::{Syntax, read};

/// Solids about the origin, none farther from it than 2, as in scene files, with a name.
const SOLIDS: &[(&str, &str)] = &[
    ("sphere", "Sphere(center: (0, 0, 0), radius: 1.5)"),
    (
        "ellipsoid",
        "With(solid: Sphere(center: (0, 0, 0), radius: 1), place: [Scale((1.5, 0.5, 1))])",
    ),
    ("box", "Box(min: (-1, -0.75, -1.25), max: (1, 0.5, 1.25))"),
    ("cylinder", "Cylinder(base: (0, -1, 0), top: (0, 1.25, 0), radius: 0.75)"),
    ("slanted", "Cylinder(base: (-1, -0.5, 0.25), top: (1, 0.75, 0.5), radius: 0.5)"),
    ("cone", "Cone(base: (0, -1, 0), base_radius: 1.25, top: (0, 1.5, 0), top_radius: 0)"),
    ("frustum", "Cone(base: (-1, 0, 0), base_radius: 0.5, top: (1, 0.5, 0.25), top_radius: 1)"),
    (
        "quadric",
        "Quadric(squares: (1, 2, 1), products: (0.5, 0, -0.5), linear: (0, 0.5, 0), constant: -1.5)",
    ),
    (
        "saddle",
        "Intersection([Quadric(squares: (1, 0, -1), linear: (0, -1, 0.25)), \
         Box(min: (-1, -1, -1), max: (1, 1, 1))])",
    ),
    (
        "two sheets",
        "Intersection([Quadric(squares: (1, -1, 1), products: (0.5, 0, 0), constant: 0.0625), \
         Box(min: (-1, -1.25, -1), max: (1, 1.25, 1))])",
    ),
    ("torus", "Torus(center: (0.25, 0, -0.25), major: 1, minor: 0.375)"),
    ("leaning", "Torus(center: (0, 0, 0), axis: (1, 2, -1), major: 1.25, minor: 0.3125)"),
    (
        "blob",
        "Blob(threshold: 0.5, components: [Sphere(center: (-0.5, 0, 0.25), radius: 1.25), \
         Sphere(center: (0.75, 0.5, 0), radius: 1, strength: 1.5), \
         Cylinder(base: (-1, -1, -0.5), top: (1, -0.75, 0.5), radius: 0.5, strength: 2), \
         Sphere(center: (-0.5, 0.25, 1), radius: 0.75, strength: -1)])",
    ),
    ("spindle", "Torus(center: (0, 0.25, 0), axis: (1, 0, 0.5), major: 0.5, minor: 0.875)"),
];

/// Open surfaces of the same extent: no law of sets is about them.
const SURFACES: &[(&str, &str)] = &[
    (
        "patch",
        "Patch([[(-1.5, 0.5, -1.25), (-0.5, -1, -1.25), (0.5, 1.5, -1.5), (1.5, 0, -1)], \
         [(-1.25, 1, -0.5), (-0.5, -0.5, -0.75), (0.75, -1.5, -0.5), (1.25, 1, -0.25)], \
         [(-1.5, -1, 0.5), (-0.25, 1.5, 0.25), (0.5, 0.5, 0.75), (1.5, -0.5, 0.5)], \
         [(-1.25, 0.25, 1.5), (-0.5, -0.75, 1), (0.25, 1, 1.25), (1.25, 0.5, 1.5)]])",
    ),
    (
        "spline",
        "Spline(points: [[(1.25, -1.5, 0), (0, -1.5, 1.25), (-1.25, -1.5, 0), (0, -1.5, -1.25)], \
         [(1.75, -0.5, 0), (0.25, -0.5, 1.5), (-1.5, -0.25, 0), (0, -0.5, -1.75)], \
         [(1, 0.5, 0), (0, 0.25, 1), (-0.75, 0.5, 0.25), (0, 0.5, -1)], \
         [(1.5, 1.75, 0), (0, 1.5, 1.5), (-1.5, 1.75, 0), (0.25, 1.5, -1.5)]], closed: (true, false))",
    ),
];

fn all() -> impl Iterator<Item = &'static (&'static str, &'static str)> {
    SOLIDS.iter().chain(SURFACES)
}

/// The moves of a document that change nothing.
const HERE: &str = "";

/// The boundaries of a solid along a ray, for t > 0.
#[derive(Clone, Debug, PartialEq)]
struct List<S> {
    inside: bool,
    boundaries: Vec<(S, Passage)>,
}

/// A solid that questions are asked of.
struct Subject<S: Scalar>(Assembly<S>);

impl<S: Scalar> Subject<S> {
    fn new(solid: &str, moves: &str) -> Self {
        let text = format!(
            "(camera: (eye: (0, 0, 5), look_at: (0, 0, 0)), materials: {{ \"m\": () }}, \
             objects: [(solid: {solid}, material: \"m\", place: [{moves}])])"
        );
        let document = read(&text, Syntax::Ron).unwrap_or_else(|e| panic!("{solid}: {e:?}"));
        let assembly = Assembly::of_document(&document);
        Self(assembly.unwrap_or_else(|flaw| panic!("{solid} [{moves}]: {flaw}")))
    }

    fn along(&self, ray: Ray<S>) -> List<S> {
        let scene = self.0.scene().expect("a legal scene");
        let vacant =
            Boundary { t: S::ZERO, node: 0, face: 0, passage: Passage::Touch, inverted: false };
        let mut buffer = vec![vacant; scene.room(0).expect("one object") as usize];
        let spans = scene.spans(0, ray, &mut buffer).expect("room for the one object");
        let boundaries = spans.boundaries.iter().map(|b| (b.t, b.passage)).collect();
        List { inside: spans.inside, boundaries }
    }
}

/// A ray that points at something near the origin from a few units away.
fn beam(random: &mut Random) -> [[f64; 3]; 2] {
    let from = random.direction().map(|x| x * random.within(2.5, 6.0));
    let to = random.cube().map(|x| x * 1.4);
    let way = [0, 1, 2].map(|i| to[i] - from[i]);
    let long = length(way);
    [from, way.map(|x| x / long)]
}

fn point<S: Scalar>(v: [f64; 3]) -> S::Vec3 {
    S::Vec3::from_array(v.map(S::from_f64))
}

fn ray<S: Scalar>([origin, dir]: [[f64; 3]; 2]) -> Ray<S> {
    let dir = S::unit(S::WideVec::from_array(dir.map(S::Wide::from_f64)));
    Ray { origin: point::<S>(origin), dir }
}

/// The ray the other way, from twelve units further on.
fn reversed<S: Scalar>(ray: Ray<S>) -> Ray<S> {
    Ray { origin: ray.at(S::from_i32(12)), dir: -ray.dir }
}

/// Half the rounding of a place of the ray, many times over.
fn tolerance<S: Scalar>() -> f64 {
    S::rounding(S::from_i32(16).widen()).to_f64() * 64.0
}

fn powers_of_two<S: Scalar>(rays: u32) -> u32 {
    let mut met = 0;
    for (name, solid) in all() {
        let plain = Subject::<S>::new(solid, HERE);
        let mut random = Random::new(2);
        for factor in [0.125, 16.0, 64.0] {
            let scaled = Subject::<S>::new(solid, &format!("Scale({factor})"));
            for _ in 0..rays {
                let at = ray::<S>(beam(&mut random));
                let far = Ray { origin: at.origin * S::from_f64(factor), dir: at.dir };
                let mut expected = plain.along(at);
                for (t, _) in &mut expected.boundaries {
                    *t *= S::from_f64(factor);
                }
                assert_eq!(scaled.along(far), expected, "{name} by {factor}: {at:?}");
                met += expected.boundaries.len() as u32;
            }
        }
    }
    met
}

/// Scaled by a power of two, everything is: to the bit in the floats.
#[test]
fn a_power_of_two_scales_the_answer_exactly() {
    assert!(powers_of_two::<f32>(400) > 4000);
    assert!(powers_of_two::<f64>(400) > 4000);
}

/// The greatest distance between the boundaries of two lists, if they have as many of the same kind.
fn gap(a: &[(f64, Passage)], b: &[(f64, Passage)]) -> Option<f64> {
    if a.len() != b.len() {
        return None;
    }
    let pairs = a.iter().zip(b);
    pairs.map(|(a, b)| (a.1 == b.1).then(|| (a.0 - b.0).abs())).try_fold(0.0, |most: f64, gap| {
        let gap = gap?;
        Some(most.max(gap))
    })
}

fn numbers<S: Scalar>(list: &List<S>) -> Vec<(f64, Passage)> {
    list.boundaries.iter().map(|&(t, passage)| (t.to_f64(), passage)).collect()
}

/// How the answers to two questions differ that have the same answer but for rounding.
#[derive(Default, Debug)]
struct Tally {
    rays: u32,
    hits: u32,
    other_counts: u32,
    /// Boundaries further apart than rounding explains at a right angle: near the silhouette.
    off: u32,
}

impl Tally {
    fn note<S: Scalar>(&mut self, a: &[(f64, Passage)], b: &[(f64, Passage)]) {
        self.rays += 1;
        self.hits += u32::from(!a.is_empty());
        match gap(a, b) {
            None => self.other_counts += 1,
            Some(gap) => self.off += u32::from(gap > tolerance::<S>()),
        }
    }

    /// A hit may be a miss on one ray in some thousands, and a boundary off on one in a hundred.
    fn check(&self, what: &str) {
        println!("{what:24} {self:?}");
        assert!(self.hits * 4 > self.rays, "{what}: too few rays meet it: {self:?}");
        assert!(self.other_counts * 1000 <= self.rays, "{what}: {self:?}");
        assert!(self.off * 50 <= self.rays, "{what}: {self:?}");
    }
}

fn reversals<S: Scalar>(rays: u32) {
    for (name, solid) in all() {
        let (subject, mut random) = (Subject::<S>::new(solid, HERE), Random::new(3));
        let mut tally = Tally::default();
        for _ in 0..rays {
            let at = ray::<S>(beam(&mut random));
            let there = numbers(&subject.along(at));
            let mut back = numbers(&subject.along(reversed(at)));
            back.reverse();
            for (t, passage) in &mut back {
                *t = 12.0 - *t;
                *passage = match passage {
                    Passage::Enter => Passage::Leave,
                    Passage::Leave => Passage::Enter,
                    Passage::Touch => Passage::Touch,
                };
            }
            tally.note::<S>(&there, &back);
        }
        tally.check(&format!("{name} {} reversed", S::NAME));
    }
}

/// The ray the other way meets the same boundaries in the other order.
#[test]
fn a_reversed_ray_has_reversed_spans() {
    reversals::<f32>(1000);
    reversals::<f64>(1000);
    reversals::<Q16>(250);
    reversals::<Q32>(250);
}

fn motions<S: Scalar>(rays: u32) {
    // A third of a turn about the diagonal changes the axes round.
    let turned = |[x, y, z]: [f64; 3]| [z, x, y];
    let moves = "Rotate(axis: (1, 1, 1), degrees: 120), Translate((3, -2, 1))";
    for (name, solid) in all() {
        let (plain, moved) = (Subject::<S>::new(solid, HERE), Subject::<S>::new(solid, moves));
        let (mut tally, mut random) = (Tally::default(), Random::new(4));
        for _ in 0..rays {
            let [origin, dir] = beam(&mut random);
            let [x, y, z] = turned(origin);
            let there = numbers(&plain.along(ray::<S>([origin, dir])));
            let here = [[x + 3.0, y - 2.0, z + 1.0], turned(dir)];
            tally.note::<S>(&there, &numbers(&moved.along(ray::<S>(here))));
        }
        tally.check(&format!("{name} {} moved", S::NAME));
    }
}

/// A rigid motion of the solid and the ray leaves t as it was.
#[test]
fn a_rigid_motion_leaves_the_answer() {
    motions::<f32>(1000);
    motions::<f64>(1000);
    motions::<Q16>(250);
    motions::<Q32>(250);
}

/// The laws of sets, with a solid, a block that cuts it, and the places where rays meet them.
fn laws<S: Scalar>(rays: u32) {
    let block = "Box(min: (-0.3, -0.4, -2.5), max: (2.5, 0.3, 0.6))";
    for (name, a) in SOLIDS {
        let not = |solid: &str| format!("Complement({solid})");
        let both = |operator: &str, a: &str, b: &str| format!("{operator}([{a}, {b}])");
        let (no_a, no_block) = (not(a), not(block));
        let pairs = [
            (both("Union", a, block), both("Union", block, a)),
            (both("Intersection", a, block), both("Intersection", block, a)),
            (both("Xor", a, block), both("Xor", block, a)),
            (both("Difference", a, block), both("Intersection", a, &no_block)),
            (not(&both("Union", a, block)), both("Intersection", &no_a, &no_block)),
            (not(&both("Intersection", a, block)), both("Union", &no_a, &no_block)),
            (both("Xor", a, a), both("Difference", a, a)),
            (both("Union", a, a), (*a).to_owned()),
            (not(&no_a), (*a).to_owned()),
        ];
        for (left, right) in &pairs {
            let (left_hand, right_hand) =
                (Subject::<S>::new(left, HERE), Subject::<S>::new(right, HERE));
            let mut random = Random::new(5);
            let mut met = 0;
            for _ in 0..rays {
                let at = ray::<S>(beam(&mut random));
                let list = left_hand.along(at);
                assert_eq!(list, right_hand.along(at), "{name}: {left} = {right} on {at:?}");
                met += list.boundaries.len();
            }
            let nothing = left.starts_with("Xor") && right.starts_with("Difference");
            assert!(nothing == (met == 0), "{left}: {met} boundaries");
        }
    }
}

/// Both sides of a law of sets have the same boundaries to the bit, and A xor A is empty.
#[test]
fn the_laws_of_sets_hold_for_every_solid() {
    laws::<f32>(200);
    laws::<f64>(200);
    laws::<Q16>(40);
    laws::<Q32>(40);
}
