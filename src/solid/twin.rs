//! The slow, obvious twin of the evaluator: whole lists of all leaves, joined by looking at
//! every t. Both agree to the bit.

use super::{Geometry, Node};
use crate::place::Affine;
use crate::ray::{Line, Ray, Start};
use crate::scalar::{Axis, Number, Scalar, Vector};
use crate::scene::{Fixed, Form, SceneBuilder};
use crate::span::{Boundary, End, Operator, Passage};
use crate::{Material, Rgb, Scene};
extern crate std;
use std::vec;
use std::vec::Vec;

type List<S> = (bool, Vec<Boundary<S>>);

/// Every boundary of the tree at `index`, and the node after it.
fn lists<S: Scalar>(
    geometry: &Geometry<'_, S>,
    line: &Line<S>,
    start: Option<&Start<S>>,
    index: &mut usize,
) -> List<S> {
    let own = *index;
    *index += 1;
    match geometry.nodes[own] {
        Node::Leaf(leaf) => {
            let mut buffer = vec![Boundary::vacant(); 4];
            let sides = (line, start);
            let everywhere = [S::ZERO, S::FAR];
            let leaf = (own as u32, &leaf);
            let (inside, len) = geometry.leaf_boundaries(leaf, sides, everywhere, &mut buffer, 0);
            buffer.truncate(len);
            (inside, buffer)
        }
        Node::Operator { operator, size } => {
            let end = own + size as usize;
            let mut all = match operator {
                Operator::Complement => (true, Vec::new()),
                _ => lists(geometry, line, start, index),
            };
            while *index < end {
                let next = lists(geometry, line, start, index);
                all = joined(geometry, line, operator, &all, &next);
            }
            all
        }
    }
}

/// Inside after all boundaries up to `t`, or up to but without it.
fn state<S: Scalar>(list: &List<S>, t: S, with: bool) -> bool {
    let passed = list.1.iter().filter(|b| b.t < t || (with && b.t == t));
    passed.fold(list.0, |state, b| match b.passage {
        Passage::Enter => true,
        Passage::Leave => false,
        Passage::Touch => state,
    })
}

fn joined<S: Scalar>(
    geometry: &Geometry<'_, S>,
    line: &Line<S>,
    operator: Operator,
    left: &List<S>,
    right: &List<S>,
) -> List<S> {
    let mut times: Vec<S> = left.1.iter().chain(&right.1).map(|b| b.t).collect();
    times.sort_by(|a, b| a.partial_cmp(b).unwrap());
    times.dedup();
    let mut made = Vec::new();
    for t in times {
        let was = operator.combine(state(left, t, false), state(right, t, false));
        let now = operator.combine(state(left, t, true), state(right, t, true));
        let here = |list: &List<S>| list.1.iter().find(|b| b.t == t).copied();
        let both = || here(left).into_iter().chain(here(right));
        if was == now {
            made.extend(both().find(|b| !now && b.passage == Passage::Touch));
            continue;
        }
        let mut source = both().find(|b| b.passage != Passage::Touch).unwrap();
        if here(left).is_none() {
            let near = |b: &&Boundary<S>| {
                b.passage != Passage::Touch && geometry.coincide(line, b, &source)
            };
            let before = left.1.iter().rfind(|b| b.t < t).filter(|b| {
                operator.combine(state(left, b.t, false), state(right, t, false)) == was
            });
            let after =
                left.1.iter().find(|b| b.t > t).filter(|b| {
                    operator.combine(state(left, b.t, true), state(right, t, true)) == now
                });
            if let Some(stand_in) = before.filter(near).or(after.filter(near)) {
                source = Boundary { t, ..*stand_in };
            }
        }
        let passage = if now { Passage::Enter } else { Passage::Leave };
        let inverted = source.inverted != (source.passage != passage);
        made.push(Boundary { passage, inverted, ..source });
    }
    (operator.combine(left.0, right.0), made)
}

/// Takes out slivers, each time from the front, until there are none.
fn without_slivers<S: Scalar>(
    geometry: &Geometry<'_, S>,
    line: &Line<S>,
    mut list: Vec<Boundary<S>>,
) -> Vec<Boundary<S>> {
    let close = |pair: &[Boundary<S>]| {
        pair[0].node != pair[1].node && geometry.coincide(line, &pair[0], &pair[1])
    };
    let mut at = 0;
    while at + 1 < list.len() {
        let thinner_next = at + 2 < list.len()
            && list[at + 2].t - list[at + 1].t < list[at + 1].t - list[at].t
            && close(&list[at + 1..]);
        if !close(&list[at..]) || thinner_next {
            at += 1;
            continue;
        }
        let open = |i: usize| list[i].passage == Passage::Touch;
        match (open(at), open(at + 1)) {
            (false, false) => {
                list.drain(at..at + 2);
                // What was before may now be close to what follows.
                at = at.saturating_sub(1);
            }
            (false, true) => drop(list.remove(at + 1)),
            (true, false) => drop(list.remove(at)),
            (true, true) => drop(list.remove(at + usize::from(list[at].node < list[at + 1].node))),
        }
    }
    list
}

/// The evaluator and its twin give the same; the boundaries, and how full the buffer was.
fn compare<S: Scalar>(scene: &Scene<'_, S>, line: &Line<S>) -> Vec<Boundary<S>> {
    let geometry = scene.geometry();
    let object = scene.parts().objects[0];
    // No boundary of a scene has this node, so what is written can be told.
    let blank = Boundary { node: u32::MAX, ..Boundary::vacant() };
    let mut buffer = vec![blank; scene.limits().boundaries as usize + 8];
    let spans = geometry.evaluate(object.first, object.count, line, &mut buffer, || ());
    let (inside, made) = (spans.inside, spans.boundaries.to_vec());
    let (expected, list) = lists(&geometry, line, line.start.as_ref(), &mut 0);
    assert_eq!(inside, expected);
    assert_eq!(made, without_slivers(&geometry, line, list));
    let peak = buffer.iter().rposition(|b| b.node != u32::MAX).map_or(0, |last| last + 1);
    assert!(peak <= scene.limits().boundaries as usize, "{peak}");
    made
}

/// Numbers that are the same in every run (SplitMix).
struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) % n
    }

    /// A multiple of a quarter in −1.5..=1.5, so that many faces lie in one plane; now and then
    /// a little beside it.
    fn place<S: Scalar>(&mut self) -> S {
        let quarter = S::from_ratio(self.below(13) as i32 - 6, 4);
        let beside = S::from_i32(self.below(5) as i32 - 2) * S::EPSILON;
        if self.below(3) == 0 { quarter + beside } else { quarter }
    }

    fn point<S: Scalar>(&mut self) -> S::Vec3 {
        S::Vec3::new(self.place(), self.place(), self.place())
    }
}

type Builder<S> = SceneBuilder<S, Fixed<2, 160, 2, 256>>;

fn add_leaf<S: Scalar>(random: &mut Random, scene: &mut Builder<S>, open: bool) {
    let center = random.point::<S>();
    let radius = S::from_ratio(1 + random.below(4) as i32, 2);
    let up = S::Vec3::ZERO.with(Axis::Y, radius);
    let (base, top) = (center - up, center + up);
    let (x, z) = (S::Vec3::ZERO.with(Axis::X, S::ONE), S::Vec3::ZERO.with(Axis::Z, S::ONE));
    let form = match random.below(if open { 7 } else { 6 }) {
        0 => Form::Sphere { center, radius },
        1 => Form::Cylinder { base, top, radius },
        2 => Form::Cone { base, base_radius: radius, top, top_radius: S::HALF },
        3 => Form::Plane { normal: S::Vec3::new(S::ZERO, S::ONE, S::ZERO), offset: center.y() },
        6 => Form::Triangle { corners: [top - x - z, top + z * S::TWO, top + x], normals: None },
        _ => {
            Form::Box { min: center - S::Vec3::splat(radius), max: center + S::Vec3::splat(radius) }
        }
    };
    let turn = match random.below(6) {
        0 => Affine::rotate(Axis::Z, S::from_i32(random.below(360) as i32)),
        1 => Affine::rotate(Axis::X, S::from_i32(30)),
        _ => Affine::identity(),
    };
    scene.leaf(form, &turn, 0).unwrap();
}

fn add_tree<S: Scalar>(random: &mut Random, scene: &mut Builder<S>, depth: u64, open: bool) {
    if depth == 0 || random.below(4) == 0 {
        return add_leaf(random, scene, open);
    }
    let operator = match random.below(9) {
        0 => Operator::Complement,
        1 | 2 => Operator::Intersection,
        3 | 4 => Operator::Difference,
        5 => Operator::Xor,
        _ => Operator::Union,
    };
    let operands = if operator == Operator::Complement { 1 } else { 1 + random.below(3) };
    scene.open(operator).unwrap();
    for _ in 0..operands {
        add_tree(random, scene, depth - 1, open && operator == Operator::Union);
    }
    scene.close(0).unwrap();
}

fn line<S: Scalar>(random: &mut Random) -> Line<S> {
    let origin = random.point::<S>() * S::from_i32(random.below(4) as i32);
    let dir = match random.below(3) {
        0 => S::Vec3::ZERO.with(Axis::ALL[random.below(3) as usize], -S::ONE),
        1 => random.point::<S>() * S::from_ratio(1, 3),
        _ => random.point::<S>() - origin,
    };
    let up = S::Vec3::ZERO.with(Axis::Y, S::ONE);
    let dir = S::widen_vec(if dir == S::Vec3::ZERO { up } else { dir });
    Line::new(Ray { origin, dir: S::steer(dir).0 }, None)
}

/// Evaluates random trees full of ties along random rays, and along rays that start on them.
fn compare_trees<S: Scalar>(seeds: core::ops::Range<u64>) {
    let mut met = 0;
    for seed in seeds {
        let mut random = Random(seed);
        let mut builder: Builder<S> = SceneBuilder::new();
        builder.material(Material::matte(Rgb::WHITE)).unwrap();
        add_tree(&mut random, &mut builder, 4, true);
        let scene = builder.scene().unwrap();
        for _ in 0..16 {
            let line = line::<S>(&mut random);
            for boundary in compare(&scene, &line) {
                met += 1;
                let leaf = scene.geometry().leaf(boundary.node).unwrap();
                let Boundary { t, node, face, .. } = boundary;
                let contact = scene.geometry().contact(&line, leaf, End { t, face });
                let aside = S::widen_vec(random.point::<S>());
                let normal = S::widen_dir(contact.normal);
                let dir = S::steer(aside + normal * S::EPSILON_ROOT.widen()).0;
                let inward = dir.dot(contact.normal) < S::Unit::ZERO;
                let start = Start { node, face, inward, local: contact.local };
                let ray = Ray { origin: contact.position, dir };
                compare(&scene, &Line::new(ray, Some(start)));
            }
        }
    }
    assert!(met > 10_000, "{met}");
}

#[test]
fn evaluation_is_its_slow_twin_in_f32() {
    compare_trees::<f32>(0..12_000);
}

#[test]
fn evaluation_is_its_slow_twin_in_f64() {
    compare_trees::<f64>(0..12_000);
}
