//! Patches and splines as they are built: what they become, what is refused, and what a hit tells.

use std::ffi::OsString;

use crate::oracle::patches::{Plan, Subject, vector};
use crate::oracle::{Random, length};
use nostray::glam::DVec3;
use nostray::ray::Line;
use nostray::shape::{Flaw, Sight};
use nostray::{
    Affine, Axis, Boundary, Fixed, Form, Item, Leaf, Material, Node, Operator, Passage, Patches,
    Ray, Rgb, SceneBuilder, SceneError, Tables, Vector,
};
use nostray_harness::probe_command;

type Builder = SceneBuilder<f64, Fixed<4, 8, 2, 512, 1024>>;

fn built(form: Form<'_, f64>, place: &Affine<f64>) -> Result<Builder, SceneError> {
    let mut builder = Builder::new();
    let material = builder.material(Material::matte(Rgb::WHITE)).expect("room");
    builder.leaf(form, place, material)?;
    Ok(builder)
}

fn leaf(builder: &Builder) -> Leaf<f64> {
    let scene = builder.scene().expect("a legal scene");
    match scene.parts().nodes.first() {
        Some(&Node::Leaf(leaf)) => leaf,
        _ => panic!("one leaf"),
    }
}

fn hits_until(builder: &Builder, ray: Ray<f64>, until: f64) -> Vec<f64> {
    let scene = builder.scene().expect("a legal scene");
    let line = Line::new(ray, None);
    let sight = Sight { line: &line, place: None, start: None, tables: &scene.parts().tables };
    let mut hits = Vec::new();
    leaf(builder).shape.spans_until(&sight, until, |span| hits.push(span.enter.t));
    hits
}

fn hits(builder: &Builder, ray: Ray<f64>) -> Vec<f64> {
    hits_until(builder, ray, f64::INFINITY)
}

/// A uniform cubic B-spline from its definition: the polynomial of each interval that the point reaches.
fn basis(s: f64) -> [f64; 4] {
    let r = 1.0 - s;
    let middle = |s: f64| (3.0 * s * s * s - 6.0 * s * s + 4.0) / 6.0;
    [r * r * r / 6.0, middle(s), middle(r), s * s * s / 6.0]
}

/// A point of a spline with so many columns, at a row and a column of its net.
fn on_spline(points: &[DVec3], columns: usize, row: f64, column: f64) -> DVec3 {
    let rows = points.len() / columns;
    let (j, i) = (row.floor() as usize, column.floor() as usize);
    let mut sum = DVec3::ZERO;
    for (dj, wj) in basis(row.fract()).into_iter().enumerate() {
        for (di, wi) in basis(column.fract()).into_iter().enumerate() {
            sum += points[(j + dj) % rows * columns + (i + di) % columns] * (wi * wj);
        }
    }
    sum
}

#[test]
fn a_spline_is_that_of_its_definition() {
    let mut random = Random::new(3);
    let mut met = 0;
    for n in 0..60_u64 {
        let (columns, rows) = (4 + random.below(4), 4 + random.below(3));
        let closed = [n & 1 == 1, n & 2 == 2];
        // A ring of rings where it closes, and anything elsewhere.
        let angle = |k: usize, of: usize| k as f64 / of as f64 * std::f64::consts::TAU;
        let points: Vec<DVec3> = (0..rows * columns)
            .map(|k| {
                let (a, b) = (angle(k % columns, columns), angle(k / columns, rows));
                let reach = 2.0 + a.cos();
                let noise = DVec3::from_array(random.cube()) * 0.3;
                DVec3::new(reach * b.cos(), a.sin(), reach * b.sin()) + noise
            })
            .collect();
        let form = Form::Spline { points: &points, columns: columns as u32, closed };
        let builder = built(form, &Affine::identity()).expect("a legal spline");
        let reach = |count: usize, closed: bool| (count - if closed { 0 } else { 3 }) as f64;
        for _ in 0..20 {
            let column = random.within(0.0, reach(columns, closed[0]));
            let row = random.within(0.0, reach(rows, closed[1]));
            let target = on_spline(&points, columns, row, column);
            let dir = DVec3::from_array(random.direction());
            let found = hits(&builder, Ray { origin: target - dir * 5.0, dir });
            assert!(found.iter().any(|t| (t - 5.0).abs() < 1e-6), "{closed:?}: {found:?}");
            met += 1;
        }
    }
    assert_eq!(met, 1200);
}

#[test]
fn control_points_take_the_placement() {
    let mut random = Random::new(4);
    let plan = Plan::teapot();
    let points: Vec<DVec3> = plan.points.iter().map(|&p| DVec3::from_array(p)).collect();
    let map = Affine::scale(DVec3::new(1.0, 2.0, 0.5))
        .then(&Affine::rotate(Axis::X, 40.0))
        .then(&Affine::translate(DVec3::new(3.0, 1.0, -2.0)));
    let moved: Vec<DVec3> = points.iter().map(|&p| map.point(p)).collect();
    let form = |points| Form::Patches { points, patches: &plan.patches };
    let placed = built(form(&points), &map).expect("legal");
    let plain = built(form(&moved), &Affine::identity()).expect("legal");
    let mut met = 0;
    for _ in 0..500 {
        let (origin, aim) = (random.direction().map(|x| 20.0 * x), random.ball());
        let origin = DVec3::from_array(origin);
        let ray = Ray { origin, dir: DVec3::new(3.0, 2.0, -1.0) + DVec3::from_array(aim) - origin };
        let found = hits(&placed, ray);
        assert_eq!(found, hits(&plain, ray));
        met += found.len();
    }
    assert!(met > 500, "{met}");
}

#[test]
fn what_is_no_surface_is_refused_by_name() {
    let identity = Affine::identity();
    let node = Item::Node(0);
    let flat = |n: usize| -> Vec<DVec3> {
        (0..n).map(|k| DVec3::new((k % 4) as f64, 0.0, (k / 4) as f64)).collect()
    };
    let whole: [u32; 16] = std::array::from_fn(|n| n as u32);
    let patches = |points: &[DVec3], patches: &[[u32; 16]]| {
        built(Form::Patches { points, patches }, &identity).expect_err("refused")
    };

    let good = flat(16);
    assert!(built(Form::Patches { points: &good, patches: &[whole] }, &identity).is_ok());
    assert_eq!(patches(&good, &[]), SceneError::Empty { at: node, field: "patches" });
    let mut beyond = whole;
    beyond[7] = 16;
    let index = SceneError::IndexOutOfRange { at: node, table: "points", index: 16, len: 16 };
    assert_eq!(patches(&good, &[beyond]), index);
    let many = vec![whole; 1025];
    let limit = SceneError::OutOfRange { at: node, field: "patches", allowed: "at most 1024" };
    assert_eq!(patches(&good, &many), limit);
    let line: Vec<_> = (0..16).map(|k| DVec3::new(f64::from(k), 2.0, 3.0 * f64::from(k))).collect();
    assert_eq!(patches(&line, &[whole]), SceneError::Empty { at: node, field: "points" });
    assert_eq!(
        patches(&vec![DVec3::ONE; 16], &[whole]),
        SceneError::Empty { at: node, field: "points" }
    );
    for (bad, error) in [
        (f64::NAN, SceneError::NotFinite { at: node, field: "points" }),
        (f64::INFINITY, SceneError::NotFinite { at: node, field: "points" }),
        (1e150, SceneError::TooLarge { at: node, field: "points" }),
    ] {
        let mut points = good.clone();
        points[5].y = bad;
        assert_eq!(patches(&points, &[whole]), error, "{bad}");
    }
    let spline = |points: &[DVec3], columns: u32, closed: [bool; 2]| {
        built(Form::Spline { points, columns, closed }, &identity).expect_err("refused")
    };
    for (points, columns, closed) in [
        (flat(12), 4, [false; 2]),
        (flat(15), 4, [false; 2]),
        (flat(16), 0, [false; 2]),
        (flat(16), 2, [true; 2]),
        (flat(12), 3, [false, true]),
    ] {
        let error = spline(&points, columns, closed);
        assert!(matches!(error, SceneError::OutOfRange { field: "points", .. }), "{error:?}");
    }
    let wide = flat(40 * 36);
    assert_eq!(spline(&wide, 40, [false; 2]), limit);
}

#[test]
fn tables_that_do_not_hold_the_patches_are_refused() {
    let plan = Plan::teapot();
    let subject = Subject::<f64>::new(&plan, 1.0, [0.0; 3]);
    let scene = subject.builder.scene().expect("a legal scene");
    let tables = scene.parts().tables;
    let nostray::Shape::Patches(shape) = subject.leaf().shape else { panic!("patches") };
    let check = |shape: Patches<f64>, tables: &Tables<'_, f64>| {
        nostray::Shape::Patches(shape).check(false, tables)
    };
    assert_eq!(check(shape, &tables), Ok(()));
    assert_eq!(nostray::Shape::Patches(shape).check(true, &tables), Err(Flaw::Placed("points")));
    let short = Tables { indices: &tables.indices[..511], ..tables };
    let beyond = |table, index, len| Err(Flaw::Beyond { table, index, len });
    assert_eq!(check(shape, &short), beyond("indices", 511, 511));
    let len = tables.points.len() as u32;
    let short = Tables { points: &tables.points[..len as usize - 1], ..tables };
    assert_eq!(check(shape, &short), beyond("points", len - 1, len - 1));
    let far = Patches { first: u32::MAX, ..shape };
    assert_eq!(check(far, &tables), beyond("indices", u32::MAX, 512));
    let shifted = Patches { boxes: shape.boxes - 2, ..shape };
    assert!(matches!(check(shifted, &tables), Err(Flaw::OutOfRange("boxes", _))));
    assert_eq!(check(Patches { count: 0, ..shape }, &tables), Err(Flaw::Empty("patches")));
}

#[test]
fn an_open_surface_cuts_nothing() {
    let mut builder = Builder::new();
    let material = builder.material(Material::matte(Rgb::WHITE)).expect("room");
    builder.open(Operator::Difference).expect("room");
    let ball = Form::Sphere { center: DVec3::ZERO, radius: 1.0 };
    builder.leaf(ball, &Affine::identity(), material).expect("legal");
    let points: Vec<_> =
        (0..16).map(|k| DVec3::new(f64::from(k % 4), 0.0, f64::from(k / 4))).collect();
    let form = Form::Spline { points: &points, columns: 4, closed: [false; 2] };
    builder.leaf(form, &Affine::identity(), material).expect("legal by itself");
    let error = builder.close(material).expect_err("no inside");
    let operator = Operator::Difference;
    assert_eq!(error, SceneError::OpenSurface { at: Item::Node(2), operator });
}

/// Sheets one over another: more hits than one pass has room for.
#[test]
fn all_hits_come_in_order_however_many() {
    let sheets = 40;
    let point =
        |sheet: u32, k: u32| DVec3::new(f64::from(k % 4), f64::from(sheet) * 0.5, f64::from(k / 4));
    let points: Vec<_> = (0..sheets).flat_map(|s| (0..16).map(move |k| point(s, k))).collect();
    // In an order that is not that of the ray.
    let patch = |sheet: u32| std::array::from_fn(|k| sheet * 7 % sheets * 16 + k as u32);
    let patches: Vec<[u32; 16]> = (0..sheets).map(patch).collect();
    let mut builder = SceneBuilder::<f64, Fixed<1, 1, 1, 1024, 1024>>::new();
    let material = builder.material(Material::matte(Rgb::WHITE)).expect("room");
    let form = Form::Patches { points: &points, patches: &patches };
    builder.leaf(form, &Affine::identity(), material).expect("legal");
    let scene = builder.scene().expect("a legal scene");
    let vacant = Boundary { t: 0.0, node: 0, face: 0, passage: Passage::Touch, inverted: false };
    let mut buffer = vec![vacant; scene.room(0).expect("an object") as usize];
    assert_eq!(buffer.len(), 40 * 18);
    assert_eq!(scene.limits().boundaries, 2);
    let ray = Ray { origin: DVec3::new(1.3, -1.0, 1.7), dir: DVec3::new(0.01, 1.0, -0.02) };
    let spans = scene.spans(0, ray, &mut buffer).expect("room");
    let found: Vec<f64> = spans.boundaries.iter().map(|b| b.t).collect();
    assert_eq!(found.len(), 40);
    for (sheet, t) in (0..).zip(found) {
        assert!((t - (1.0 + 0.5 * f64::from(sheet))).abs() < 1e-12);
    }
}

#[test]
fn what_lies_up_to_a_point_is_complete() {
    let mut random = Random::new(8);
    let plan = Plan::teapot();
    let points: Vec<DVec3> = plan.points.iter().map(|&p| DVec3::from_array(p)).collect();
    let form = Form::Patches { points: &points, patches: &plan.patches };
    let builder = built(form, &Affine::identity()).expect("legal");
    let mut met = 0;
    for _ in 0..500 {
        let origin = DVec3::from_array(random.direction()) * 8.0;
        let target = DVec3::from_array(random.ball()) * 2.0 + DVec3::new(0.0, 0.0, 1.5);
        let ray = Ray { origin, dir: target - origin };
        let until = random.within(0.0, 2.0);
        let all: Vec<f64> = hits(&builder, ray).into_iter().filter(|&t| t <= until).collect();
        let some = hits_until(&builder, ray, until);
        let some: Vec<f64> = some.into_iter().filter(|&t| t <= until).collect();
        assert_eq!(some, all);
        met += all.len();
    }
    assert!(met > 200, "{met}");
}

/// The first hit is searched for in another way than all of them.
#[test]
fn the_nearest_hit_is_the_first_of_all() {
    let mut random = Random::new(12);
    let subject = Subject::<f32>::new(&Plan::teapot(), 1.0, [0.0; 3]);
    let scene = subject.builder.scene().expect("a legal scene");
    let mut met = 0;
    for _ in 0..3000 {
        // Also from inside.
        let origin = random.direction().map(|x| x * random.within(0.0, 6.0));
        let [x, y, z] = random.direction();
        let ray = Ray { origin: vector::<f32>(origin), dir: vector::<f32>([x, y, z]) };
        let vacant =
            Boundary { t: 0.0, node: 0, face: 0, passage: Passage::Touch, inverted: false };
        let nearest = scene.nearest(ray, &mut [vacant; 2]).expect("room");
        let nearest = nearest.map(|hit| (hit.boundary.t, hit.boundary.face));
        let first = subject.hits(ray, None).into_iter().find(|&(t, _)| t > 0.0);
        assert_eq!(nearest, first, "{ray:?}");
        met += u32::from(first.is_some());
    }
    assert!(met > 500, "{met}");
}

/// Where the sides of patches shrink to a point: at the knob of the lid and in the middle of the bottom.
#[test]
fn a_normal_is_finite_where_a_side_is_a_point() {
    let subject = Subject::<f64>::new(&Plan::teapot(), 1.0, [0.0; 3]);
    let scene = subject.builder.scene().expect("a legal scene");
    for (top, upward) in [(3.15, 1.0), (0.0, -1.0)] {
        for (x, z) in [(0.0, 0.0), (1e-12, 0.0), (-1e-6, 1e-7), (0.001, -0.002)] {
            let ray = Ray { origin: DVec3::new(x, z, 10.0 * upward), dir: DVec3::Z * -upward };
            let hits = subject.hits(ray, None);
            let (t, face) = hits[0];
            assert!((10.0 - t - top * upward).abs() < 1e-4, "{hits:?}");
            let shape = subject.leaf().shape;
            let tables = &scene.parts().tables;
            let at = ray.at(t) - shape.centre();
            let local = shape.snap(at, face, tables);
            let normal = shape.normal(local, face, tables).to_array();
            let size = length(normal);
            assert!(size > 0.0 && normal.iter().all(|x| x.is_finite()));
            assert!(normal[2] * upward / size > 0.99, "{normal:?}");
            assert!(shape.uv(local, face, tables).iter().all(|x| (0.0..=1.0).contains(x)));
        }
    }
}

#[test]
fn scene_files_and_probe_know_patches() {
    let sheet = |tilt: &str| {
        let row = |z: i32| {
            let points = (0..4).map(|x| format!("[{x}, {tilt}, {z}]"));
            format!("[{}]", points.collect::<Vec<_>>().join(", "))
        };
        format!("[{}]", (0..4).map(row).collect::<Vec<_>>().join(", "))
    };
    let rows = sheet("2");
    let ask = |solid: &str| {
        let ray = r#"{"origin": [1.25, 0, 1.5], "dir": [0, 1, 0]}"#;
        let line = format!("{{\"solid\": {solid}, \"ray\": {ray}}}\n");
        let (mut out, mut err) = (Vec::new(), Vec::new());
        let args = ["probe", "--scalar", "f64"].map(OsString::from);
        assert_eq!(probe_command(args, &mut line.as_bytes(), &mut out, &mut err), 0);
        String::from_utf8(out).expect("text").trim().to_owned()
    };
    let hit = r#"{"spans":[[2.0,2.0]]}"#;
    assert_eq!(ask(&format!(r#"{{"Patch": {rows}}}"#)).replace(' ', ""), hit);
    assert_eq!(ask(&format!(r#"{{"Spline": {{"points": {rows}}}}}"#)).replace(' ', ""), hit);
    let list = rows.replace("[[[", "[[").replace("]]]", "]]").replace("]], [[", "], [");
    let whole: Vec<String> = (0..16).map(|k| k.to_string()).collect();
    let patches =
        format!(r#"{{"Patches": {{"points": {list}, "patches": [[{}]]}}}}"#, whole.join(", "));
    assert_eq!(ask(&patches).replace(' ', ""), hit);
    for (solid, part) in [
        (r#"{"Patch": [[[0, 0, 0]]]}"#.to_owned(), "a list of 4"),
        (format!(r#"{{"Spline": {{"points": {rows}, "wrapped": true}}}}"#), "wrapped"),
        (r#"{"Spline": {"points": [[[0, 0, 0]], []]}}"#.to_owned(), "different lengths"),
        (patches.replace("15]", "16]"), "index 16 is beyond the 16 entries of points"),
    ] {
        let answer = ask(&solid);
        assert!(answer.contains("error") && answer.contains(part), "{answer}");
    }
}
