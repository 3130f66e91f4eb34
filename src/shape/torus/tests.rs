use core::cell::Cell;

use glam::{DVec3, Vec3};

use super::*;
use crate::ray::{Line, Ray, Start};
use crate::roots::STEPS_MAX;

fn torus(major: f64, minor: f64) -> Torus<f64> {
    Torus { center: DVec3::ZERO, major, minor }
}

/// The ends of the spans along a ray, which may start on the surface.
fn ends(torus: &Torus<f64>, origin: DVec3, dir: DVec3, start: Option<bool>) -> [f64; 4] {
    let start =
        start.map(|inward| Start { node: 0, face: 0, inward, local: origin - torus.center });
    let line = Line::new(Ray { origin, dir }, start);
    let (tables, start) = (Tables::EMPTY, line.start.as_ref());
    let sight = Sight { line: &line, place: None, start, tables: &tables };
    let (mut found, mut count) = ([f64::NAN; 4], 0);
    torus.spans(&sight, |span| {
        (found[count], found[count + 1]) = (span.enter.t, span.exit.t);
        count += 2;
    });
    found
}

fn near(found: [f64; 4], expected: &[f64]) {
    let count = found.iter().filter(|t| t.is_finite()).count();
    assert_eq!(count, expected.len(), "{found:?}");
    for (t, expected) in found.iter().zip(expected) {
        assert!((t - expected).abs() <= 1e-12, "{found:?} for {expected:?}");
    }
}

#[test]
fn a_ring_is_crossed_twice_in_its_plane_and_left_alone_along_its_axis() {
    let ring = torus(3.0, 1.0);
    near(ends(&ring, DVec3::X * -10.0, DVec3::X, None), &[6.0, 8.0, 12.0, 14.0]);
    near(ends(&ring, DVec3::X * -10.0, DVec3::X * 2.0, None), &[3.0, 4.0, 6.0, 7.0]);
    near(ends(&ring, DVec3::Y * -10.0, DVec3::Y, None), &[]);
    near(ends(&ring, DVec3::new(3.0, -10.0, 0.0), DVec3::Y, None), &[9.0, 11.0]);
    // Tangents from outside: at the equator, to the top circle, within the hole.
    near(ends(&ring, DVec3::new(4.0, 0.0, -5.0), DVec3::Z, None), &[]);
    near(ends(&ring, DVec3::new(-9.0, 1.0, 0.0), DVec3::X, None), &[]);
    near(ends(&ring, DVec3::new(2.0, -5.0, 0.0), DVec3::Y, None), &[]);
    // One that touches the wall of the hole from within the tube stays inside.
    let reach: f64 = Real::sqrt(12.0);
    near(ends(&ring, DVec3::new(2.0, 0.0, 0.0), DVec3::Z, None), &[-reach, reach]);
}

#[test]
fn a_spindle_is_filled() {
    let spindle = torus(3.0, 5.0);
    // Along the axis from tip to tip, 4 above and below the middle.
    near(ends(&spindle, DVec3::Y * -10.0, DVec3::Y, None), &[6.0, 14.0]);
    near(ends(&spindle, DVec3::X * -10.0, DVec3::X, None), &[2.0, 18.0]);
    // Above the tips it is a ring.
    let found = ends(&spindle, DVec3::new(-10.0, 4.5, 0.0), DVec3::X, None);
    let out: f64 = Real::sqrt(25.0 - 4.5 * 4.5);
    near(found, &[7.0 - out, 7.0 + out, 13.0 - out, 13.0 + out]);
    // A horn has one point in the middle, which a ray through it does not enter.
    near(ends(&torus(1.0, 1.0), DVec3::Y * -10.0, DVec3::Y, None), &[]);
}

#[test]
fn a_ray_from_the_surface_meets_only_the_rest() {
    let ring = torus(3.0, 1.0);
    let (left, hole) = (DVec3::X * -4.0, DVec3::X * -2.0);
    near(ends(&ring, left, DVec3::X, Some(true)), &[0.0, 2.0, 6.0, 8.0]);
    near(ends(&ring, left, -DVec3::X, Some(false)), &[]);
    near(ends(&ring, hole, DVec3::X, Some(false)), &[4.0, 6.0]);
    near(ends(&ring, hole, -DVec3::X, Some(true)), &[0.0, 2.0]);
    // Along the surface: into the tube beside the hole, and away from the equator.
    let reach: f64 = Real::sqrt(12.0);
    near(ends(&ring, hole, DVec3::Z, Some(true)), &[0.0, reach]);
    near(ends(&ring, left, DVec3::Z, Some(false)), &[]);
    // From the tip of a spindle.
    near(ends(&torus(3.0, 5.0), DVec3::Y * 4.0, -DVec3::Y, Some(true)), &[0.0, 8.0]);
    near(ends(&torus(3.0, 5.0), DVec3::Y * 4.0, DVec3::Y, Some(false)), &[]);
}

#[test]
fn points_are_drawn_onto_the_surface_and_normals_point_outward() {
    let (ring, spindle) = (torus(3.0, 1.0), torus(3.0, 5.0));
    let snap = |torus: &Torus<f64>, p: DVec3| torus.snap(p, 0, &Tables::EMPTY);
    let normal = |torus: &Torus<f64>, p: DVec3| torus.normal(p, 0, &Tables::EMPTY);
    assert_eq!(snap(&ring, DVec3::new(4.1, 0.0, 0.0)), DVec3::X * 4.0);
    assert_eq!(snap(&ring, DVec3::new(0.0, 0.5, -3.0)), DVec3::new(0.0, 1.0, -3.0));
    assert_eq!(snap(&ring, DVec3::ZERO), DVec3::X * 2.0);
    assert_eq!(normal(&ring, DVec3::X * 4.0), DVec3::X);
    assert_eq!(normal(&ring, DVec3::X * 2.0), -DVec3::X);
    assert_eq!(snap(&spindle, DVec3::Y * 3.9), DVec3::Y * 4.0);
    assert_eq!(normal(&spindle, DVec3::Y * -4.0), -DVec3::Y);
    let uv = |p: DVec3| ring.uv(p, 0, &Tables::EMPTY);
    assert_eq!(uv(DVec3::X * 4.0), [0.5, 0.5]);
    assert_eq!(uv(DVec3::new(0.0, 1.0, 3.0)), [0.75, 0.75]);
}

/// How often a function is evaluated on the way to all ends along a ray, and how many ends.
fn evaluations(torus: &Torus<f32>, ray: Ray<f32>) -> (u32, u32) {
    let (line, tables) = (Line::new(ray, None), Tables::EMPTY);
    let sight = Sight { line: &line, place: None, start: None, tables: &tables };
    let local = Local::recentred(sight.line, None, torus.center);
    let crossing = torus.crossing(&sight, &local);
    let Some(reach) = crossing.reach() else {
        return (0, 0);
    };
    let pieces = crossing.pieces(reach);
    let (count, mut found) = (Cell::new(0), 0);
    let f = |t: f32| {
        count.set(count.get() + 1);
        crossing.depth(t)
    };
    crossings_between(pieces.as_slice(), reach, f, |_| found += 1);
    (count.get(), found)
}

#[test]
fn steps_are_bounded() {
    let (mut worst, mut sum, mut ends) = (0, 0, 0);
    for n in 0..4000_u16 {
        // Around and around the tube, ever nearer to touching it, on tori ever thinner.
        let minor = [0.9, 0.3, 1e-2, 1e-4][usize::from(n) % 4];
        let torus = Torus { center: Vec3::ZERO, major: 1.0, minor };
        let angle = |step: f32| Real::sin_cos(f32::from(n) * step);
        let ((sin, cos), (up, out), (turned, ahead)) = (angle(0.37), angle(0.11), angle(0.05));
        let lift = minor * (1.0 - [0.3, 1e-2, 1e-4, 1e-6][usize::from(n / 4) % 4]);
        let rho = 1.0 + lift * out;
        let at = Vec3::new(rho * cos, lift * up, rho * sin);
        let (along, across) = (Vec3::new(-sin, 0.0, cos), Vec3::new(-up * cos, out, -up * sin));
        let dir = along * ahead + across * turned;
        let (count, found) = evaluations(&torus, Ray { origin: at - dir * 3.0, dir });
        (worst, sum, ends) = (worst.max(count), sum + count, ends + found);
    }
    // The ends of four pieces, and the way to a root in each.
    assert!(worst <= 5 + 4 * STEPS_MAX, "{worst} evaluations of one ray");
    assert!(ends > 6000, "{ends} ends");
    assert!(sum <= ends * 9, "{sum} evaluations for {ends} ends");
}
