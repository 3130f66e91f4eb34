//! How far a ray's way through a blob can take, and that what is kept changes nothing.

use super::course::{ROOM, Spans};
use crate::ray::{Line, Ray};
use crate::scalar::{Real, Scalar, Vector};
use crate::scene::{Fixed, Form, Metaball, SceneBuilder};
use crate::shape::{Shape, Sight};
use crate::solid::Node;
use crate::span::Span;
use crate::{Affine, Material, Q16, Q32, Rgb};
extern crate std;
use std::vec::Vec;

fn point<S: Scalar>(v: [f64; 3]) -> S::Vec3 {
    S::Vec3::from_array(v.map(S::from_f64))
}

/// The spans of a ray, how many pieces it was cut into, how many parts of components it met, and how many
/// spans there may be; also when no part is kept.
fn way<S: Scalar>(
    components: &[Metaball<S>],
    [origin, dir]: [[f64; 3]; 2],
) -> (Vec<Span<S>>, u32, u32, u32) {
    let mut builder = SceneBuilder::<S, Fixed<1, 1, 1, 64, 64>>::new();
    builder.material(Material::matte(Rgb::WHITE)).unwrap();
    let form = Form::Blob { threshold: S::from_f64(0.25), components };
    builder.leaf(form, &Affine::identity(), 0).unwrap();
    let scene = builder.scene().unwrap();
    let Node::Leaf(leaf) = scene.parts().nodes[0] else { panic!("one leaf") };
    let Shape::Blob(blob) = leaf.shape else { panic!("a blob") };
    let dir = S::steer(S::WideVec::from_array(dir.map(S::Wide::from_f64))).0;
    let line = Line::new(Ray { origin: point::<S>(origin), dir }, None);
    let sight = Sight { line: &line, place: None, start: None, tables: &scene.parts().tables };
    let walk = |keeps: bool| {
        let mut spans = Spans::new(&blob, &sight, [-S::FAR, S::FAR]).unwrap();
        let met = spans.course.met;
        if !keeps {
            spans.course.met = ROOM as u32 + 1;
        }
        let list: Vec<Span<S>> = core::iter::from_fn(|| spans.next()).collect();
        (list, spans.course.pieces, met, blob.spans_max())
    };
    let kept = walk(true);
    assert_eq!(kept, walk(false));
    kept
}

fn row<S: Scalar>(count: i32, reach: f64, strengths: [f64; 2]) -> Vec<Metaball<S>> {
    let balls = (0..count).map(|i| {
        let x = f64::from(i) - f64::from(count) / 2.0;
        let strength = strengths[i as usize % 2];
        Metaball::ball(point::<S>([x, 0.0, 0.0]), S::from_f64(reach), S::from_f64(strength))
    });
    balls.collect()
}

const ALONG: [[f64; 3]; 2] = [[-20.0, 0.0625, 0.0], [1.0, 0.0, 0.0]];

fn worst<S: Scalar>() {
    // Apart: each is a piece with a gap behind it.
    let (spans, pieces, met, most) = way::<S>(&row(12, 0.375, [1.0, 1.0]), ALONG);
    assert_eq!((spans.len(), pieces, met), (12, 23, 12));
    assert!(most >= 12);
    // Overlapping, and of either sign: a breakpoint every so often, and many pieces with several parts.
    let (spans, pieces, met, _) = way::<S>(&row(12, 2.75, [2.0, -1.0]), ALONG);
    assert!(!spans.is_empty());
    assert_eq!((pieces, met), (23, 12));
    // Cylinders that cross the ray, each with its three parts.
    let slanted: Vec<Metaball<S>> = (0..8)
        .map(|i| {
            let x = f64::from(i) - 4.0;
            let [base, top] = [[x, 0.0, 0.0], [x + 0.5, 0.125, 0.0]].map(point::<S>);
            Metaball::cylinder(base, top, S::from_f64(0.5), S::ONE)
        })
        .collect();
    let (spans, pieces, met, most) = way::<S>(&slanted, ALONG);
    assert_eq!(met, 24);
    assert!(pieces <= 6 * 8, "{pieces}");
    assert!(!spans.is_empty() && spans.len() <= most as usize);
}

#[test]
fn pieces_are_as_many_as_breakpoints_at_most() {
    worst::<f32>();
    worst::<f64>();
    worst::<Q16>();
    worst::<Q32>();
}

#[test]
fn one_component_is_one_span() {
    let (spans, pieces, ..) = way::<f64>(&row(1, 1.0, [1.0, 1.0]), ALONG);
    assert_eq!((spans.len(), pieces), (1, 1));
    // The field is a quarter where 1 − r² is a half.
    let half = Real::sqrt(0.5 - 0.0625_f64 * 0.0625);
    assert!((spans[0].enter.t - (19.5 - half)).abs() <= 1e-14);
    assert!((spans[0].exit.t - (19.5 + half)).abs() <= 1e-14);
}
