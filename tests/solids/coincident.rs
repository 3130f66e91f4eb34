//! Faces that lie in one plane: no lid is left, no seam, and no false shadow.
#![allow(clippy::indexing_slicing, clippy::unwrap_used, reason = "tests may panic")]
#![allow(clippy::disallowed_methods, reason = "what makes cases need not be the same to the bit")]

use nostray::*;

type Builder<S> = SceneBuilder<S, Fixed<4, 32, 4, 4>>;

/// Numbers that are the same in every run (G. L. Steele et al., SplitMix, 2014).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1_u64 << 53) as f64)
    }
}

fn vector<S: Scalar>(v: [f64; 3]) -> S::Vec3 {
    Vector::from_array(v.map(S::from_f64))
}

/// How far from the origin a placement is at most, in each coordinate.
fn distance_of(index: u32) -> f64 {
    [0.0, 0.1, 1e3, 1e4, 1e5, 1e6][index as usize % 6]
}

/// Where a solid stands: 0 and the next ones axis-parallel at growing distances, the others
/// turned by many angles, small and large.
fn placement<S: Scalar>(index: u32) -> Affine<S> {
    let mut random = Random(u64::from(index) + 77);
    let far = distance_of(index);
    let offset = [0; 3].map(|_| random.between(-far, far));
    let number = S::from_f64;
    let turned = match index / 6 {
        0 => Affine::identity(),
        1 => Affine::rotate(Axis::Z, number(random.between(-180.0, 180.0))),
        2 => Affine::scale(vector::<S>([1.5, 0.75, 2.0]))
            .then(&Affine::rotate(Axis::X, number(random.between(-3.0, 3.0)))),
        _ => Axis::ALL.iter().fold(Affine::identity(), |affine, &axis| {
            affine.then(&Affine::rotate(axis, number(random.between(-180.0, 180.0))))
        }),
    };
    turned.then(&Affine::translate(vector::<S>(offset)))
}

const PLACEMENTS: u32 = 36;

fn spans<S: Scalar>(scene: &Scene<'_, S>, ray: Ray<S>) -> (bool, Vec<Boundary<S>>) {
    let vacant =
        Boundary { t: S::ZERO, node: 0, face: 0, passage: Passage::Touch, inverted: false };
    let mut buffer = vec![vacant; scene.limits().boundaries as usize];
    let spans = scene.spans(0, ray, &mut buffer).unwrap();
    (spans.inside, spans.boundaries.to_vec())
}

/// A ray through a local point, from a local distance, at a given steepness to the y axis.
fn ray_at<S: Scalar>(
    affine: &Affine<S>,
    [x, y, z]: [f64; 3],
    distance: f64,
    steepness: f64,
    random: &mut Random,
) -> Ray<S> {
    let (sin, cos) = random.between(0.0, std::f64::consts::TAU).sin_cos();
    let flat = (1.0 - steepness * steepness).sqrt();
    let sign = if random.bits() & 1 == 0 { 1.0 } else { -1.0 };
    let dir = [flat * cos, sign * steepness, flat * sin];
    let origin = [x - dir[0] * distance, y - dir[1] * distance, z - dir[2] * distance];
    let target = affine.point(vector::<S>([x, y, z]));
    let origin = affine.point(vector::<S>(origin));
    Ray { origin, dir: S::unit(S::widen_vec(target - origin)) }
}

/// A hole right through a box, whose ends lie in the box's faces.
fn holed<S: Scalar>(form: u8, lift: f64, affine: &Affine<S>) -> Builder<S> {
    let mut scene: Builder<S> = SceneBuilder::new();
    let (wall, hole) = (Material::matte(Rgb::WHITE), Material::matte(Rgb::BLACK));
    let (wall, hole) = (scene.material(wall).unwrap(), scene.material(hole).unwrap());
    let at = |x: f64, y: f64, z: f64| vector::<S>([x, y + lift, z]);
    let number = S::from_f64;
    scene.open(Operator::Difference).unwrap();
    let body = Form::Box { min: at(-1.0, -0.7, -1.0), max: at(1.0, 0.7, 1.0) };
    scene.leaf(body, affine, wall).unwrap();
    let (base, top, radius) = (at(0.0, -0.7, 0.0), at(0.0, 0.7, 0.0), number(0.5));
    let cutter = match form {
        0 => Form::Cylinder { base, top, radius },
        1 => Form::Cone { base, base_radius: radius, top, top_radius: number(0.8) },
        _ => Form::Box { min: at(-0.5, -0.7, -0.5), max: at(0.5, 0.7, 0.5) },
    };
    scene.leaf(cutter, affine, hole).unwrap();
    scene.close(wall).unwrap();
    scene
}

/// How many rays through the ends of the hole see a face there.
fn lids<S: Scalar>(rays: u32) -> (u32, u32) {
    let (mut count, mut seen) = (0, 0);
    for index in 0..PLACEMENTS {
        let affine = placement::<S>(index);
        // The parameters are rounded, so far out the hole ends a little below the face. A ray
        // that is flatter than this stays in that layer from rim to rim and rightly sees it.
        let grazing = (40.0 * S::EPSILON.to_f64() * distance_of(index)).min(0.9);
        for form in 0..3 {
            // A lift that no binary format holds exactly: corners and middles round apart.
            let lift = [0.0, 0.1, 1.3][(index as usize + usize::from(form)) % 3];
            let builder = holed(form, lift, &affine);
            let scene = builder.scene().unwrap();
            let mut random = Random(u64::from(index * 3 + u32::from(form)));
            for _ in 0..rays {
                let side = if random.bits() & 1 == 0 { 0.7 } else { -0.7 };
                // Far enough from the rim that rounding cannot put the ray beside the hole:
                // at the far placements the grid of f32 is as wide as the box.
                let through = |r: &mut Random| r.between(-0.3, 0.3);
                let point = [through(&mut random), side + lift, through(&mut random)];
                let steepness = 10_f64.powf(random.between(-3.0, 0.0)).max(grazing);
                let distance = random.between(0.5, 20.0);
                let ray = ray_at(&affine, point, distance, steepness, &mut random);
                let (_, boundaries) = spans(&scene, ray);
                count += 1;
                seen += u32::from(boundaries.iter().any(|b| is_lid(&affine, b, &ray, lift)));
            }
        }
    }
    (count, seen)
}

/// The boundary is a part of the box's face that the hole should have taken.
fn is_lid<S: Scalar>(affine: &Affine<S>, b: &Boundary<S>, ray: &Ray<S>, lift: f64) -> bool {
    let place = Placement::new(affine).unwrap();
    let from = ray.at(b.t) - place.anchor;
    let [x, y, z] = place.to_local.map(|row| row.dot(S::widen_vec(from)).to_f64());
    let in_hole = x.hypot(z) < 0.45;
    in_hole && ((y - lift).abs() - 0.7).abs() < 0.1
}

#[test]
fn flush_holes_have_no_lids_in_f32() {
    let (count, seen) = lids::<f32>(1200);
    assert!(count > 100_000);
    assert_eq!(seen, 0, "of {count}");
}

#[test]
fn flush_holes_have_no_lids_in_f64() {
    let (count, seen) = lids::<f64>(1200);
    assert!(count > 100_000);
    assert_eq!(seen, 0, "of {count}");
}

/// Two solids that share a face across the y axis at `y`.
fn touching<S: Scalar>(form: u8, y: f64, operator: Operator, affine: &Affine<S>) -> Builder<S> {
    let mut scene: Builder<S> = SceneBuilder::new();
    let (a, b) = (Material::matte(Rgb::WHITE), Material::matte(Rgb::BLACK));
    let (a, b) = (scene.material(a).unwrap(), scene.material(b).unwrap());
    let at = |x: f64, y: f64, z: f64| vector::<S>([x, y, z]);
    let number = S::from_f64;
    let solid = |low: f64, high: f64, radius: f64| match form {
        0 => Form::Box { min: at(-radius, low, -radius), max: at(radius, high, radius) },
        1 => Form::Cylinder {
            base: at(0.0, low, 0.0),
            top: at(0.0, high, 0.0),
            radius: number(radius),
        },
        _ => Form::Cone {
            base: at(0.0, low, 0.0),
            base_radius: number(radius * 0.9),
            top: at(0.0, high, 0.0),
            top_radius: number(radius),
        },
    };
    scene.open(operator).unwrap();
    scene.leaf(solid(y - 0.9, y, 1.0), affine, a).unwrap();
    scene.leaf(solid(y, y + 1.1, 1.2), affine, b).unwrap();
    scene.close(a).unwrap();
    scene
}

/// How many rays through a shared face find a boundary there: seams of the union, and points
/// of the intersection, which is empty.
fn seams<S: Scalar>(rays: u32) -> (u32, u32) {
    let (mut count, mut seen) = (0, 0);
    for index in 0..PLACEMENTS {
        let affine = placement::<S>(index);
        let grazing = (40.0 * S::EPSILON.to_f64() * distance_of(index)).min(0.9);
        for form in 0..3 {
            let y = [0.0, 0.1, -0.3][(index as usize + usize::from(form)) % 3];
            let union = touching(form, y, Operator::Union, &affine);
            let common = touching(form, y, Operator::Intersection, &affine);
            let (union, common) = (union.scene().unwrap(), common.scene().unwrap());
            let mut random = Random(u64::from(index * 3 + u32::from(form)) + 1000);
            for _ in 0..rays {
                let point = [random.between(-0.4, 0.4), y, random.between(-0.4, 0.4)];
                let steepness = 10_f64.powf(random.between(-3.0, 0.0)).max(grazing);
                let distance = random.between(0.5, 20.0);
                let ray = ray_at(&affine, point, distance, steepness, &mut random);
                let (inside, boundaries) = spans(&union, ray);
                // In and out again, or only out.
                let seam = boundaries.len() != 2 - usize::from(inside);
                let (inside, boundaries) = spans(&common, ray);
                count += 1;
                seen += u32::from(seam || inside || !boundaries.is_empty());
            }
        }
    }
    (count, seen)
}

#[test]
fn touching_solids_have_no_seam_in_f32() {
    let (count, seen) = seams::<f32>(1000);
    assert!(count > 100_000);
    assert_eq!(seen, 0, "of {count}");
}

#[test]
fn touching_solids_have_no_seam_in_f64() {
    let (count, seen) = seams::<f64>(1000);
    assert!(count > 100_000);
    assert_eq!(seen, 0, "of {count}");
}

/// A gap or a plate of this thickness between two boxes, met as often as it is there.
fn thin<S: Scalar>(thickness: f64, operator: Operator) {
    for index in (0..PLACEMENTS).filter(|index| distance_of(*index) < 1.0) {
        let affine = placement::<S>(index);
        let mut scene: Builder<S> = SceneBuilder::new();
        let white = scene.material(Material::matte(Rgb::WHITE)).unwrap();
        let at = |x: f64, y: f64, z: f64| vector::<S>([x, y, z]);
        scene.open(operator).unwrap();
        let (low, high) = match operator {
            Operator::Union => (-thickness / 2.0, thickness / 2.0),
            _ => (thickness / 2.0, -thickness / 2.0),
        };
        let lower = Form::Box { min: at(-1.0, -0.9, -1.0), max: at(1.0, low, 1.0) };
        let upper = Form::Box { min: at(-1.0, high, -1.0), max: at(1.0, 1.1, 1.0) };
        scene.leaf(lower, &affine, white).unwrap();
        scene.leaf(upper, &affine, white).unwrap();
        scene.close(white).unwrap();
        let scene = scene.scene().unwrap();
        let mut random = Random(u64::from(index));
        for _ in 0..2000 {
            let point = [random.between(-0.4, 0.4), 0.0, random.between(-0.4, 0.4)];
            let steepness = 10_f64.powf(random.between(-2.0, 0.0));
            let ray = ray_at(&affine, point, random.between(1.5, 4.0), steepness, &mut random);
            let (inside, boundaries) = spans(&scene, ray);
            let expected = if operator == Operator::Union { 4 } else { 2 };
            assert_eq!(boundaries.len() + usize::from(inside), expected, "{boundaries:?} {ray:?}");
        }
    }
}

#[test]
fn thin_features_stay() {
    thin::<f32>(1e-4, Operator::Union);
    thin::<f32>(1e-4, Operator::Intersection);
    thin::<f64>(1e-12, Operator::Union);
    thin::<f64>(1e-12, Operator::Intersection);
}

/// Two boxes that overlap, with tops in one plane, seen from above at an angle in the light
/// of a lamp: every point of the top is lit, and where both are, it shows the first.
fn tops<S: Scalar>(size: u32) -> (u32, u32) {
    let (mut count, mut wrong) = (0, 0);
    for index in (0..PLACEMENTS).filter(|index| distance_of(*index) < 2e4) {
        let affine = placement::<S>(index);
        let mut scene: Builder<S> = SceneBuilder::new();
        let number = S::from_f64;
        let red = Material::matte(Rgb::new(S::ONE, S::ZERO, S::ZERO));
        let blue = Material::matte(Rgb::new(S::ZERO, S::ZERO, S::ONE));
        let (red, blue) = (scene.material(red).unwrap(), scene.material(blue).unwrap());
        let at = |x: f64, y: f64, z: f64| vector::<S>([x, y, z]);
        scene.open(Operator::Union).unwrap();
        let first = Form::Box { min: at(-1.0, -0.7, -1.0), max: at(1.0, 0.3, 1.0) };
        let turned = Affine::rotate(Axis::Y, number(30.0)).then(&affine);
        let second = Form::Box { min: at(-1.6, -0.5, -1.2), max: at(1.6, 0.3, 1.2) };
        scene.leaf(first, &affine, red).unwrap();
        scene.leaf(second, &turned, blue).unwrap();
        scene.close(red).unwrap();

        let up = affine.point(at(0.0, 1.0, 0.0)) - affine.point(S::Vec3::ZERO);
        let lamp = affine.point(at(1.0, 2.5, 0.4)) - affine.point(at(0.0, 0.3, 0.0));
        scene
            .light(Light::Directional { toward: -S::unit(S::widen_vec(lamp)), color: Rgb::WHITE })
            .unwrap();
        scene.camera = Camera {
            eye: affine.point(at(0.5, 3.0, 4.0)),
            look_at: affine.point(at(0.0, 0.3, 0.0)),
            up: up.normalize(),
            projection: Projection::Pinhole { fov: number(4.0) },
        };
        let scene = scene.scene().unwrap();
        let render: Render<S> = Render::new(&scene, size, size, Depth::fixed(1)).unwrap();
        for pixel in render {
            let [r, g, b] = pixel.color.to_array().map(S::to_f64);
            count += 1;
            wrong += u32::from(!(r > 0.1 && g == 0.0 && b == 0.0));
        }
    }
    (count, wrong)
}

#[test]
fn tops_in_one_plane_are_lit_and_show_the_first() {
    let (count, wrong) = tops::<f32>(72);
    assert!(count > 100_000);
    assert_eq!(wrong, 0, "of {count} in f32");
    let (count, wrong) = tops::<f64>(72);
    assert_eq!(wrong, 0, "of {count} in f64");
}
