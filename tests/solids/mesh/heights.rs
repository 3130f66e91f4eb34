//! Height fields: the surface goes through the heights, and a solid is closed below it.

use nostray::{Affine, Axis, Form, Heights, Passage, Q16, Q32, Ray, Real as _, Scalar, Vector};

use super::figures::{builder, mesh_of, spans, vector};
use crate::oracle::Random;

fn field<S: Scalar>(base: Option<f64>, place: &Affine<S>) {
    let mut random = Random::new(4);
    let (columns, rows) = (7, 5);
    let heights: Vec<f64> = (0..columns * rows).map(|_| random.within(0.5, 2.0)).collect();
    let scaled: Vec<S> = heights.iter().map(|&height| S::from_f64(height)).collect();
    let mut builder = builder::<S>();
    let form = Heights {
        min: [-3.0, 1.0].map(S::from_f64),
        max: [3.0, 5.0].map(S::from_f64),
        columns: columns as u32,
        heights: &scaled,
        base: base.map(S::from_f64),
        smooth: true,
    };
    builder.leaf(Form::HeightField(form), place, 0).expect("a legal field");
    let scene = builder.scene().expect("a legal scene");
    let cells = (columns - 1) * (rows - 1);
    let edge = 2 * (columns - 1) + 2 * (rows - 1);
    let count = 2 * cells + if base.is_some() { 3 * edge } else { 0 };
    assert_eq!(mesh_of(&scene).triangles as usize, count);
    let down = S::steer(S::widen_vec(place.point(vector::<S>([0.0, -1.0, 0.0])))).0;
    for (column, row) in (0..columns).flat_map(|column| (0..rows).map(move |row| (column, row))) {
        // A little inside, so that the whole ring of points is met.
        let inward = |index: usize, count: usize| {
            let share = index as f64 / (count - 1) as f64;
            0.5 + (share - 0.5) * (1.0 - 1e-3)
        };
        let (x, z) = (-3.0 + 6.0 * inward(column, columns), 1.0 + 4.0 * inward(row, rows));
        let ray = Ray { origin: place.point(vector::<S>([x, 10.0, z])), dir: down };
        let (inside, list) = spans(&scene, 0, ray);
        assert!(!inside);
        let expected = if base.is_some() { 2 } else { 1 };
        assert_eq!(list.len(), expected, "{list:?}");
        let height = 10.0 - list[0].t.to_f64();
        assert!((height - heights[row * columns + column]).abs() < 0.01, "{height}");
        let passage = if base.is_some() { Passage::Enter } else { Passage::Touch };
        assert_eq!(list[0].passage, passage);
        if let Some(base) = base {
            assert!((10.0 - base - list[1].t.to_f64()).abs() < 0.001);
        }
    }
}

#[test]
fn a_surface_goes_through_its_heights() {
    for base in [None, Some(-0.5)] {
        field::<f32>(base, &Affine::identity());
        field::<f64>(base, &Affine::rotate(Axis::X, 90.0));
        field::<f64>(base, &Affine::scale(vector::<f64>([-1.0, 1.0, 1.0])));
        field::<Q16>(base, &Affine::identity());
        field::<Q32>(base, &Affine::rotate(Axis::Z, Q32::from_i32(180)));
    }
}

/// Along the ground a closed field is one body: rays through it at any height below the least are
/// inside from wall to wall.
#[test]
fn a_closed_field_is_one_body() {
    let heights = [1.0, 2.0, 1.5, 1.25, 1.0, 2.0, 1.0, 3.0, 1.0];
    let mut builder = builder::<f64>();
    let (min, max) = ([0.0; 2], [2.0, 4.0]);
    let form = Heights { min, max, columns: 3, heights: &heights, base: Some(-1.0), smooth: false };
    builder.leaf(Form::HeightField(form), &Affine::identity(), 0).expect("a legal field");
    let scene = builder.scene().expect("a legal scene");
    let mut random = Random::new(8);
    for _ in 0..200 {
        let (y, angle) = (random.within(-0.9, 0.9), random.within(0.0, 6.3));
        let dir = [angle.cos(), 0.0, angle.sin()];
        let middle = [random.within(0.1, 1.9), y, random.within(0.1, 3.9)];
        let origin = [0, 1, 2].map(|i: usize| middle[i] - 10.0 * dir[i]);
        let ray = Ray { origin: vector::<f64>(origin), dir: vector::<f64>(dir) };
        let (inside, list) = spans(&scene, 0, ray);
        assert!(!inside && list.len() == 2, "{list:?}");
        for boundary in list {
            let p = ray.at(boundary.t).to_array();
            let off = |v: f64, high: f64| v.abs().min((v - high).abs());
            assert!(off(p[0], 2.0).min(off(p[2], 4.0)) < 1e-9, "{p:?}");
        }
    }
}
