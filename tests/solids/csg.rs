//! Set operations on solids along rays, against membership point by point.
#![allow(clippy::indexing_slicing, clippy::unwrap_used, reason = "tests may panic")]
#![allow(clippy::disallowed_methods, reason = "what makes cases need not be the same to the bit")]

use nostray::*;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// Room for the trees of these tests.
type Builder<S> = SceneBuilder<S, Fixed<40, 160, 2, 16>>;

/// A solid in numbers that every scalar can take.
#[derive(Clone, Copy, Debug)]
struct Body {
    kind: u8,
    center: [f64; 3],
    size: [f64; 3],
    turn: [f64; 3],
}

#[derive(Clone, Debug)]
enum Tree {
    Body(Body),
    Op(Operator, Vec<Tree>),
}

fn vector<S: Scalar>(v: [f64; 3]) -> S::Vec3 {
    Vector::from_array(v.map(S::from_f64))
}

impl Body {
    fn to_world<S: Scalar>(self) -> Affine<S> {
        let mut affine = Affine::identity();
        for (axis, degrees) in Axis::ALL.into_iter().zip(self.turn) {
            affine = affine.then(&Affine::rotate(axis, S::from_f64(degrees)));
        }
        if self.kind == 5 {
            affine = Affine::scale(vector::<S>([1.0, 0.5, 1.5])).then(&affine);
        }
        affine.then(&Affine::translate(vector::<S>(self.center)))
    }

    fn form<S: Scalar>(&self) -> Form<'static, S> {
        let [a, b, c] = self.size;
        let number = S::from_f64;
        let (low, high) = (vector::<S>([0.0, -b, 0.0]), vector::<S>([0.0, b, 0.0]));
        match self.kind {
            0 | 5 => Form::Sphere { center: S::Vec3::ZERO, radius: number(a) },
            1 => Form::Box { min: vector::<S>([-a, -b, -c]), max: vector::<S>(self.size) },
            2 => Form::Cylinder { base: low, top: high, radius: number(a) },
            3 => {
                let (base_radius, top_radius) = (number(a), number(c * 0.5));
                Form::Cone { base: low, base_radius, top: high, top_radius }
            }
            _ => Form::Plane { normal: vector::<S>([a, b - 0.8, c - 0.8]), offset: number(b) },
        }
    }

    /// How far a point is inside (negative) or outside, in local units: its sign is exact
    /// and its size a measure of how sure it is.
    fn distance(&self, p: [f64; 3]) -> f64 {
        let place = Placement::new(&self.to_world::<f64>()).unwrap();
        let from = vector::<f64>(p) - place.anchor;
        let [x, y, z] = place.to_local.map(|row| Vector::dot(row, from));
        let [a, b, c] = self.size;
        let across = x.hypot(z);
        match self.kind {
            0 | 5 => x.hypot(y).hypot(z) - a,
            1 => (x.abs() - a).max(y.abs() - b).max(z.abs() - c),
            2 => (across - a).max(y.abs() - b),
            3 => {
                let radius = a + (c * 0.5 - a) * (y + b) / (2.0 * b);
                (across - radius).max(y.abs() - b)
            }
            _ => a * x + (b - 0.8) * y + (c - 0.8) * z - b,
        }
    }
}

impl Tree {
    fn add<S: Scalar>(&self, scene: &mut Builder<S>) -> Result<(), SceneError> {
        match self {
            Self::Body(body) => scene.leaf(body.form(), &body.to_world(), 0),
            Self::Op(operator, operands) => {
                scene.open(*operator)?;
                operands.iter().try_for_each(|operand| operand.add(scene))?;
                scene.close(0)
            }
        }
    }

    /// The leaves in order, with the indices of their nodes.
    fn bodies(&self, next: &mut u32, found: &mut Vec<(u32, Body)>) {
        let own = *next;
        *next += 1;
        match self {
            Self::Body(body) => found.push((own, *body)),
            Self::Op(_, operands) => operands.iter().for_each(|o| o.bodies(next, found)),
        }
    }

    /// Membership from that of the leaves in order.
    fn contains(&self, leaves: &mut impl Iterator<Item = bool>) -> bool {
        let Self::Op(operator, operands) = self else {
            return leaves.next().unwrap();
        };
        let states: Vec<bool> = operands.iter().map(|o| o.contains(leaves)).collect();
        match operator {
            Operator::Union => states.contains(&true),
            Operator::Intersection => !states.contains(&false),
            Operator::Difference => states[0] && !states[1..].contains(&true),
            Operator::Xor => states.iter().filter(|&&s| s).count() % 2 == 1,
            Operator::Complement => !states[0],
        }
    }
}

fn body() -> impl Strategy<Value = Tree> {
    let coordinate = || -1.5..1.5_f64;
    let length = || 0.3..1.3_f64;
    let degrees = || prop_oneof![Just(0.0), Just(90.0), -180.0..180.0_f64];
    let three = (
        0..6_u8,
        [coordinate(), coordinate(), coordinate()],
        [length(), length(), length()],
        [degrees(), degrees(), degrees()],
    );
    three.prop_map(|(kind, center, size, turn)| Tree::Body(Body { kind, center, size, turn }))
}

fn tree() -> impl Strategy<Value = Tree> {
    body().prop_recursive(6, 24, 4, |inner| {
        let operator = prop_oneof![
            Just(Operator::Union),
            Just(Operator::Intersection),
            Just(Operator::Difference),
            Just(Operator::Xor),
        ];
        prop_oneof![
            5 => (operator, prop::collection::vec(inner.clone(), 1..5))
                .prop_map(|(operator, operands)| Tree::Op(operator, operands)),
            1 => inner.prop_map(|operand| Tree::Op(Operator::Complement, vec![operand])),
        ]
    })
}

fn rays() -> impl Strategy<Value = Vec<([f64; 3], [f64; 3])>> {
    let number = || -1.0..1.0_f64;
    let ray = (0..3_u8, [number(), number(), number()], [number(), number(), number()]).prop_map(
        |(kind, a, b)| {
            // From far to a point among the solids, from among them, or along an axis.
            let (from, to) = match kind {
                0 => (a.map(|v| 8.0 * v + v.signum() * 3.0), b.map(|v| v * 2.0)),
                1 => (a.map(|v| v * 2.0), b.map(|v| v * 2.0)),
                _ => ([a[0], -6.0, a[2]], [a[0], 6.0, a[2]]),
            };
            (from, [to[0] - from[0], to[1] - from[1], to[2] - from[2]])
        },
    );
    prop::collection::vec(ray, 12)
}

/// The boundaries of one object, copied.
fn spans<S: Scalar>(scene: &Scene<'_, S>, object: u32, ray: Ray<S>) -> (bool, Vec<Boundary<S>>) {
    let mut buffer =
        vec![
            Boundary { t: S::ZERO, node: 0, face: 0, passage: Passage::Touch, inverted: false };
            scene.limits().boundaries as usize
        ];
    let spans = scene.spans(object, ray, &mut buffer).unwrap();
    (spans.inside, spans.boundaries.to_vec())
}

fn contains<S: Scalar>((inside, boundaries): &(bool, Vec<Boundary<S>>), t: S) -> bool {
    Spans { inside: *inside, boundaries }.contains(t)
}

/// They ascend, lie in front and go in and out by turns.
fn check_order<S: Scalar>(
    (inside, boundaries): &(bool, Vec<Boundary<S>>),
) -> Result<(), TestCaseError> {
    let (mut state, mut last) = (*inside, S::ZERO);
    for boundary in boundaries {
        prop_assert!(boundary.t > last, "{boundaries:?}");
        last = boundary.t;
        match boundary.passage {
            Passage::Touch => prop_assert!(!state),
            passage => {
                prop_assert!((passage == Passage::Enter) != state, "{boundaries:?}");
                state = !state;
            }
        }
    }
    Ok(())
}

/// The tree as one object, and each leaf as one of its own, agree along a ray. `near` is how
/// close to a surface, in units of the ray, the comparison stays away.
fn check_ray<S: Scalar>(
    tree: &Tree,
    bodies: &[(u32, Body)],
    scene: &Scene<'_, S>,
    (origin, dir): ([f64; 3], [f64; 3]),
    near: f64,
) -> Result<(), TestCaseError> {
    let ray = Ray { origin: vector::<S>(origin), dir: S::steer(S::widen_vec(vector::<S>(dir))).0 };
    let whole = spans(scene, 0, ray);
    check_order(&whole)?;
    let leaves: Vec<_> = (1..).zip(bodies).map(|(object, _)| spans(scene, object, ray)).collect();
    for leaf in &leaves {
        check_order(leaf)?;
    }

    let mut ends: Vec<f64> =
        leaves.iter().flat_map(|leaf| leaf.1.iter().map(|b| b.t.to_f64())).collect();
    ends.extend([0.0, 4.0]);
    ends.sort_by(f64::total_cmp);
    for pair in ends.windows(2) {
        if pair[1] - pair[0] < 4.0 * near {
            continue;
        }
        for t in [pair[0] + near, (pair[0] + pair[1]) / 2.0, pair[1] - near] {
            let t = S::from_f64(t);
            let expected = tree.contains(&mut leaves.iter().map(|leaf| contains(leaf, t)));
            prop_assert_eq!(contains(&whole, t), expected, "spans at {}: {:?}", t, &whole);
            // The same from the formulas of the solids, away from all surfaces.
            let p = ray.at(t).to_array().map(S::to_f64);
            let distances: Vec<f64> = bodies.iter().map(|(_, body)| body.distance(p)).collect();
            if distances.iter().all(|d| d.abs() > 16.0 * near) {
                let expected = tree.contains(&mut distances.iter().map(|&d| d < 0.0));
                prop_assert_eq!(contains(&whole, t), expected, "point at {}: {:?}", t, &whole);
            }
        }
    }

    // A boundary is one of its leaf, and turned round exactly where the leaf goes the other way.
    for boundary in &whole.1 {
        let index = bodies.iter().position(|&(node, _)| node == boundary.node);
        let own = leaves[index.unwrap()].1.iter().filter(|b| b.face == boundary.face);
        let apart = |b: &Boundary<S>| (b.t - boundary.t).to_f64().abs();
        let own = own.min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap();
        prop_assert!(apart(own) <= near, "{boundary:?} {own:?}");
        prop_assert_eq!(boundary.inverted, own.passage != boundary.passage);
    }
    Ok(())
}

fn check_tree<S: Scalar>(
    tree: &Tree,
    rays: &[([f64; 3], [f64; 3])],
    near: f64,
) -> Result<(), TestCaseError> {
    let mut builder: Builder<S> = SceneBuilder::new();
    builder.material(Material::matte(Rgb::WHITE)).unwrap();
    tree.add(&mut builder).unwrap();
    let mut bodies = Vec::new();
    tree.bodies(&mut 0, &mut bodies);
    for (_, body) in &bodies {
        builder.leaf(body.form(), &body.to_world(), 0).unwrap();
    }
    let scene = builder.scene().unwrap();
    rays.iter().try_for_each(|&ray| check_ray(tree, &bodies, &scene, ray, near))
}

/// A tree and its equivalent have the same boundaries along every ray: the same places,
/// turned the same way.
fn check_equal<S: Scalar>(
    [a, b]: [&Tree; 2],
    rays: &[([f64; 3], [f64; 3])],
) -> Result<(), TestCaseError> {
    let mut builder: Builder<S> = SceneBuilder::new();
    builder.material(Material::matte(Rgb::WHITE)).unwrap();
    a.add(&mut builder).unwrap();
    b.add(&mut builder).unwrap();
    let scene = builder.scene().unwrap();
    for &(origin, dir) in rays {
        let ray =
            Ray { origin: vector::<S>(origin), dir: S::steer(S::widen_vec(vector::<S>(dir))).0 };
        let [one, other] = [0, 1].map(|object| {
            let (inside, boundaries) = spans(&scene, object, ray);
            let places: Vec<_> = boundaries.iter().map(|b| (b.t, b.passage)).collect();
            (inside, places)
        });
        prop_assert_eq!(one, other);
    }
    Ok(())
}

/// The tree down to its second level, so that a few copies of it fit.
fn small(tree: &Tree) -> Tree {
    let Tree::Op(operator, operands) = tree else {
        return tree.clone();
    };
    let mut leaves = Vec::new();
    operands.iter().for_each(|operand| operand.bodies(&mut 0, &mut leaves));
    let keep = if *operator == Operator::Complement { 1 } else { 3 };
    let kept = leaves.into_iter().take(keep).map(|(_, body)| Tree::Body(body));
    Tree::Op(*operator, kept.collect())
}

fn op(operator: Operator, operands: &[&Tree]) -> Tree {
    Tree::Op(operator, operands.iter().map(|&tree| tree.clone()).collect())
}

/// The laws of sets, where both sides consist of the same leaves and so tie exactly.
fn check_laws<S: Scalar>(
    [a, b, c]: [&Tree; 3],
    rays: &[([f64; 3], [f64; 3])],
) -> Result<(), TestCaseError> {
    use Operator::{Complement, Difference, Intersection, Union, Xor};
    let not = |tree: &Tree| op(Complement, &[tree]);
    let nothing = op(Difference, &[a, a]);
    let laws = [
        (nothing.clone(), op(Intersection, &[a, &not(a)])),
        (nothing.clone(), op(Xor, &[a, a])),
        (nothing, op(Difference, &[b, a, b])),
        (a.clone(), op(Union, &[a, a])),
        (a.clone(), op(Intersection, &[a, a])),
        (a.clone(), op(Xor, &[a, b, b])),
        (a.clone(), not(&not(a))),
        (op(Union, &[a, b]), op(Union, &[b, a])),
        (op(Intersection, &[a, b]), op(Intersection, &[b, a])),
        (op(Xor, &[a, b]), op(Xor, &[b, a])),
        (op(Difference, &[a, b]), op(Intersection, &[a, &not(b)])),
        (not(&op(Union, &[a, b])), op(Intersection, &[&not(a), &not(b)])),
        (not(&op(Intersection, &[a, b])), op(Union, &[&not(a), &not(b)])),
        (
            op(Intersection, &[a, &op(Union, &[b, c])]),
            op(Union, &[&op(Intersection, &[a, b]), &op(Intersection, &[a, c])]),
        ),
        (op(Difference, &[a, b, c]), op(Difference, &[a, &op(Union, &[b, c])])),
        (op(Xor, &[a, b, c]), op(Xor, &[a, &op(Xor, &[b, c])])),
    ];
    laws.iter().try_for_each(|(left, right)| check_equal::<S>([left, right], rays))
}

/// Open surfaces in a union with a solid: met exactly where they are outside of it.
fn check_open<S: Scalar>(
    tree: &Tree,
    height: f64,
    rays: &[([f64; 3], [f64; 3])],
    near: f64,
) -> Result<(), TestCaseError> {
    let mut builder: Builder<S> = SceneBuilder::new();
    builder.material(Material::matte(Rgb::WHITE)).unwrap();
    let square = [[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]];
    let vertices = square.map(|[x, z]| vector::<S>([x, height, z]));
    let polygon = Form::Polygon { vertices: &vertices };
    builder.open(Operator::Union).unwrap();
    builder.leaf(polygon, &Affine::identity(), 0).unwrap();
    tree.add(&mut builder).unwrap();
    builder.close(0).unwrap();
    tree.add(&mut builder).unwrap();
    builder.leaf(polygon, &Affine::identity(), 0).unwrap();
    let scene = builder.scene().unwrap();
    for &(origin, dir) in rays {
        let ray =
            Ray { origin: vector::<S>(origin), dir: S::steer(S::widen_vec(vector::<S>(dir))).0 };
        let [whole, solid, surface] = [0, 1, 2].map(|object| spans(&scene, object, ray));
        check_order(&whole)?;
        let closed = whole.1.iter().filter(|b| b.passage != Passage::Touch);
        let places: Vec<_> = solid.1.iter().map(|b| (b.t, b.passage)).collect();
        prop_assert_eq!(closed.map(|b| (b.t, b.passage)).collect::<Vec<_>>(), places);
        let seen: Vec<S> =
            whole.1.iter().filter(|b| b.passage == Passage::Touch).map(|b| b.t).collect();
        for touch in &surface.1 {
            let clear = solid.1.iter().all(|b| (b.t - touch.t).to_f64().abs() > near);
            if clear {
                prop_assert_eq!(seen == [touch.t], !contains(&solid, touch.t));
            }
        }
        prop_assert!(seen.len() <= surface.1.len());
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() })]

    #[test]
    fn trees_agree_with_membership_in_f64(tree in tree(), rays in rays()) {
        check_tree::<f64>(&tree, &rays, 1e-6)?;
    }

    #[test]
    fn trees_agree_with_membership_in_f32(tree in tree(), rays in rays()) {
        check_tree::<f32>(&tree, &rays, 2e-3)?;
    }

    #[test]
    fn the_laws_of_sets_hold_in_f64(a in body(), b in tree(), c in body(), rays in rays()) {
        check_laws::<f64>([&a, &small(&b), &c], &rays)?;
    }

    #[test]
    fn the_laws_of_sets_hold_in_f32(a in body(), b in tree(), c in body(), rays in rays()) {
        check_laws::<f32>([&a, &small(&b), &c], &rays)?;
    }

    #[test]
    fn open_surfaces_are_seen_outside(tree in tree(), height in -1.5..1.5, rays in rays()) {
        check_open::<f64>(&tree, height, &rays, 1e-6)?;
        check_open::<f32>(&tree, height, &rays, 2e-3)?;
    }
}
