//! What is no mesh is refused, with its place.

use nostray::{
    Affine, Branch, Camera, Corners, Fixed, Form, Heights, Item, Leaf, Material, Mesh, Node,
    Object, Operator, Parts, Q16, Rgb, Scalar, Scene, SceneBuilder, SceneError, Shape, Tables,
    Triangles,
};

use super::figures::{self, Figure, Made, builder, mesh_of, scene_of, vector};

/// Why a mesh is refused.
fn refusal<S: Scalar>(figure: &Figure, closed: bool) -> SceneError {
    let form = Made::<S>::new(figure);
    let refused = builder::<S>().leaf(form.form(closed), &Affine::identity(), 0);
    refused.expect_err("no legal mesh")
}

const AT: Item = Item::Node(0);

fn triangle(error: &SceneError) -> (u32, &'static str) {
    match *error {
        SceneError::Triangle { at: AT, triangle, flaw } => (triangle, flaw),
        _ => panic!("{error}"),
    }
}

#[test]
fn bad_lists_are_refused() {
    let mut figure = figures::cube(2);
    figure.triangles.clear();
    assert_eq!(refusal::<f32>(&figure, true), SceneError::Empty { at: AT, field: "triangles" });
    let mut figure = figures::cube(2);
    figure.triangles[7][2] = figure.points.len() as u32;
    assert_eq!(triangle(&refusal::<f64>(&figure, false)), (7, "names a point that is not there"));
    let mut figure = figures::cube(2);
    figure.points[3][1] = f64::NAN;
    assert_eq!(refusal::<f32>(&figure, true), SceneError::NotFinite { at: AT, field: "points" });
    let figure = figures::cube(2).placed(1.0, [1e6, 0.0, 0.0]);
    // Fixed point saturates at the end of its range, which is not a legal place either.
    assert_eq!(refusal::<Q16>(&figure, true), SceneError::TooLarge { at: AT, field: "points" });
    let mut figure = figures::cube(2);
    figure.triangles[5][1] = figure.triangles[5][0];
    assert_eq!(triangle(&refusal::<f32>(&figure, true)), (5, "has no area"));
    let mut figure = figures::cube(2);
    // Three points of one edge of the cube.
    figure.points.extend([[-1.0, -1.0, -1.0], [0.0, -1.0, -1.0], [1.0, -1.0, -1.0]]);
    let last = figure.points.len() as u32 - 1;
    figure.triangles.push([last - 2, last - 1, last]);
    let count = figure.triangles.len() as u32;
    assert_eq!(triangle(&refusal::<f32>(&figure, false)), (count - 1, "has no area"));
}

#[test]
fn corners_need_their_normals_and_coordinates() {
    let made = Made::<f32>::new(&figures::cube(1));
    let points = Corners { values: &made.points, triangles: &made.triangles };
    let up = [vector::<f32>([0.0, 1.0, 0.0])];
    let few = Corners { values: &up, triangles: &[[0, 0, 0]] };
    let form = |normals, uvs| Form::Mesh(Triangles { points, normals, uvs, closed: true });
    let plant = |form| builder::<f32>().leaf(form, &Affine::identity(), 0).expect_err("refused");
    let missing = "names a normal that is not there";
    assert_eq!(triangle(&plant(form(Some(few), None))), (1, missing));
    let wrong = [[0, 0, 1]; 12];
    let normals = Corners { values: &up, triangles: &wrong };
    assert_eq!(triangle(&plant(form(Some(normals), None))), (0, missing));
    let uvs = Corners { values: &[[0.0; 2]], triangles: &wrong };
    let missing = "names texture coordinates that are not there";
    assert_eq!(triangle(&plant(form(None, Some(uvs)))), (0, missing));
    let all = [[0; 3]; 12];
    let uvs = Corners { values: &[[0.0, f32::INFINITY]], triangles: &all };
    let refused = plant(form(None, Some(uvs)));
    assert_eq!(refused, SceneError::NotFinite { at: AT, field: "uvs" });
    let uvs = Corners { values: &[[0.0; 2]], triangles: &all };
    builder::<f32>().leaf(form(None, Some(uvs)), &Affine::identity(), 0).expect("a legal mesh");
}

#[test]
fn a_closed_mesh_has_no_open_edge() {
    let open = "has an edge without a neighbour that goes along it the other way";
    let shared = "has an edge that it shares with more than one other, or in the same direction";
    for taken in [0, 5, 23] {
        let mut figure = figures::cube(2);
        let hole = figure.triangles.remove(taken);
        let (index, flaw) = triangle(&refusal::<f32>(&figure, true));
        let beside = figure.triangles[index as usize].iter().filter(|i| hole.contains(i)).count();
        assert_eq!((flaw, beside), (open, 2));
        builder::<f32>()
            .leaf(Made::<f32>::new(&figure).form(false), &Affine::identity(), 0)
            .expect("an open surface");
        // One that is turned round is not joined to its neighbours either.
        let [a, b, c] = hole;
        figure.triangles.push([a, c, b]);
        assert_eq!(triangle(&refusal::<f64>(&figure, true)).1, shared);
        // Nor is one that stands twice.
        *figure.triangles.last_mut().expect("a triangle") = hole;
        figure.triangles.push(hole);
        assert_eq!(triangle(&refusal::<f64>(&figure, true)).1, shared);
    }
    // Two cubes with an edge in common.
    let mut figure = figures::cube(1);
    let other = figures::cube(1).map(|[x, y, z]| [x + 2.0, y + 2.0, z]);
    let count = figure.points.len() as u32;
    figure.points.extend(other.points);
    figure.triangles.extend(other.triangles.iter().map(|t| t.map(|index| index + count)));
    assert_eq!(triangle(&refusal::<f32>(&figure, true)).1, shared);
}

#[test]
fn an_open_mesh_has_no_inside() {
    let form = Made::<f32>::new(&figures::cube(1));
    let mut builder = builder::<f32>();
    builder.open(Operator::Difference).expect("room");
    builder.leaf(form.form(false), &Affine::identity(), 0).expect("a legal mesh");
    let refused = builder.close(0).expect_err("no solid");
    let operator = Operator::Difference;
    assert_eq!(refused, SceneError::OpenSurface { at: Item::Node(1), operator });
}

#[test]
fn a_solid_of_too_many_boundaries_is_refused_but_a_mesh_alone_is_not() {
    let figure = figures::ball(7);
    let made = Made::<f32>::new(&figure);
    assert_eq!(figure.triangles.len(), 131_072);
    let alone = scene_of::<f32>(&figure, true);
    let scene = alone.scene().expect("a legal scene");
    assert_eq!((scene.limits().boundaries, scene.room(0)), (2, Ok(131_072)));
    let mut builder = builder::<f32>();
    builder.open(Operator::Union).expect("room");
    builder.leaf(made.form(true), &Affine::identity(), 0).expect("a legal mesh");
    let refused = builder.close(0).expect_err("too many");
    let needed = 2 * 131_072;
    assert_eq!(refused, SceneError::SpanOverflow { at: Item::Object(0), needed, limit: 65_535 });
}

#[test]
fn full_tables_are_told() {
    let form = Made::<f32>::new(&figures::cube(1));
    let plant = |form: Form<'_, f32>| {
        let mut builder = SceneBuilder::<f32, Fixed<1, 1, 1, 8, 48, 0, 4>>::new();
        builder.material(Material::matte(Rgb::WHITE)).expect("room");
        builder.leaf(form, &Affine::identity(), 0)
    };
    let refused = plant(form.form(true));
    assert_eq!(refused, Err(SceneError::Full { table: "branches", capacity: 4 }));
}

/// The tables of a scene with one mesh, to be spoilt.
struct Spoilt {
    points: Vec<nostray::glam::Vec3>,
    indices: Vec<u32>,
    branches: Vec<Branch<f32>>,
    mesh: Mesh,
}

impl Spoilt {
    fn new() -> Self {
        let builder = scene_of::<f32>(&figures::cube(2), true);
        let scene = builder.scene().expect("a legal scene");
        let Tables { points, indices, branches, .. } = scene.parts().tables;
        let mesh = mesh_of(&scene);
        Self {
            points: points.to_vec(),
            indices: indices.to_vec(),
            branches: branches.to_vec(),
            mesh,
        }
    }

    fn check(&self) -> Result<(), SceneError> {
        let leaf = Leaf { shape: Shape::Mesh(self.mesh), material: 0, placement: None };
        let at = |x| vector::<f32>([x, 0.0, 5.0]);
        Scene::new(Parts {
            nodes: &[Node::Leaf(leaf)],
            objects: &[Object::new(0, 1, 0)],
            materials: &[Material::matte(Rgb::WHITE)],
            tables: Tables {
                points: &self.points,
                indices: &self.indices,
                branches: &self.branches,
                ..Tables::EMPTY
            },
            ..Parts::seen_by(Camera::pinhole(
                at(1.0),
                at(0.0),
                vector::<f32>([0.0, 1.0, 0.0]),
                40.0,
            ))
        })
        .map(|_| ())
    }

    fn spoil(change: impl FnOnce(&mut Self)) -> SceneError {
        let mut spoilt = Self::new();
        change(&mut spoilt);
        spoilt.check().expect_err("a spoilt scene")
    }
}

#[test]
fn a_hierarchy_that_is_none_is_refused() {
    Spoilt::new().check().expect("a legal scene");
    let hierarchy = |error: SceneError| match error {
        SceneError::Hierarchy { at: AT, branch } => branch,
        other => panic!("{other}"),
    };
    let last = Spoilt::new().branches.len() as u32 - 1;
    let spoil = |change: fn(&mut Spoilt)| hierarchy(Spoilt::spoil(change));
    // A box that does not hold what is below it.
    assert_eq!(spoil(|s| s.branches[0].bounds.max.x = 0.9), 0);
    assert_eq!(spoil(|s| s.branches[1].bounds.min.y = 0.5), 1);
    assert_eq!(spoil(|s| s.branches.last_mut().expect("a leaf").bounds.max.z = -1.5), last);
    assert_eq!(spoil(|s| s.branches[0].bounds.max.x = f32::NAN), 0);
    assert_eq!(spoil(|s| s.branches[0].bounds.max.x = f32::INFINITY), 0);
    // A link that leads back, to itself, beyond the end, or past nodes.
    assert_eq!(spoil(|s| s.branches[1].first = 0), 1);
    assert_eq!(spoil(|s| s.branches[1].first = 1), 1);
    assert_eq!(spoil(|s| s.branches[0].first = 99), 0);
    assert_eq!(spoil(|s| s.branches[0].first += 1), 0);
    assert_eq!(spoil(|s| s.branches[0].up = 1), 0);
    assert_eq!(spoil(|s| s.branches[2].up = 0), 1);
    // Leaves that hold too few, too many, or others.
    let leaf = |s: &Spoilt| s.branches.iter().position(|b| b.count > 0).expect("a leaf");
    let first_leaf = leaf(&Spoilt::new()) as u32;
    let change = |change: fn(&mut Branch<f32>)| {
        hierarchy(Spoilt::spoil(|s| {
            let first_leaf = leaf(s);
            change(&mut s.branches[first_leaf]);
        }))
    };
    assert_eq!(change(|b| b.first = 1), first_leaf);
    assert!(change(|b| b.count -= 1) > first_leaf);
    assert!(change(|b| b.count += 1) >= first_leaf);
    assert_eq!(change(|b| b.count = 0), first_leaf);
    // None at all.
    assert_eq!(spoil(|s| s.branches.clear()), 0);
    assert_eq!(spoil(|s| s.mesh.branch = 1), 0);
}

#[test]
fn tables_that_do_not_fit_are_refused() {
    let order = Spoilt::new().mesh.order as usize;
    let twice = Spoilt::spoil(|s| s.indices[order] = s.indices[order + 9]);
    match twice {
        SceneError::Triangle { flaw: "is not in the hierarchy", .. }
        | SceneError::Hierarchy { .. } => {}
        other => panic!("{other}"),
    }
    let beyond = Spoilt::spoil(|s| s.indices[order] = 1000);
    assert_eq!(triangle(&beyond).1, "is not in the hierarchy");
    assert_eq!(triangle(&Spoilt::spoil(|s| s.mesh.first = 10_000)).0, 0);
    assert_eq!(triangle(&Spoilt::spoil(|s| s.mesh.order = u32::MAX)).1, "is not in the hierarchy");
    assert_eq!(
        triangle(&Spoilt::spoil(|s| s.mesh.triangles = 1_000_000)).1,
        "names a point that is not there"
    );
    assert_eq!(
        triangle(&Spoilt::spoil(|s| s.points.truncate(9))).1,
        "names a point that is not there"
    );
    let clockwise = Spoilt::spoil(|s| s.indices[..order].chunks_mut(3).for_each(|t| t.swap(1, 2)));
    let allowed = "counterclockwise as seen from outside";
    assert_eq!(clockwise, SceneError::OutOfRange { at: AT, field: "triangles", allowed });
    assert!(clockwise.to_string().contains("must be counterclockwise"));
}

#[test]
fn height_fields_that_are_none_are_refused() {
    let plant = |change: fn(&mut Heights<'static, f32>)| {
        let heights: &'static [f32] = &[0.0, 0.5, 0.25, 1.0, 0.0, 0.0];
        let (min, max) = ([0.0; 2], [1.0; 2]);
        let mut form = Heights { min, max, columns: 3, heights, base: Some(-1.0), smooth: true };
        change(&mut form);
        builder::<f32>().leaf(Form::HeightField(form), &Affine::identity(), 0)
    };
    plant(|_| ()).expect("a legal field");
    plant(|form| form.base = None).expect("a legal field");
    let range = |error: Result<(), SceneError>| match error {
        Err(SceneError::OutOfRange { at: AT, field, .. }) => field,
        other => panic!("{other:?}"),
    };
    assert_eq!(range(plant(|form| form.columns = 0)), "heights");
    assert_eq!(range(plant(|form| form.columns = 1)), "heights");
    assert_eq!(range(plant(|form| form.columns = 4)), "heights");
    assert_eq!(range(plant(|form| form.columns = 6)), "heights");
    assert_eq!(range(plant(|form| form.heights = &[])), "heights");
    assert_eq!(range(plant(|form| form.base = Some(0.0))), "base");
    assert_eq!(range(plant(|form| form.base = Some(f32::NAN))), "base");
    let at = AT;
    let inverted = SceneError::Inverted { at, field: "max" };
    assert_eq!(plant(|form| form.max[1] = -1.0), Err(inverted));
    assert_eq!(plant(|form| form.max[0] = 0.0), Err(SceneError::Empty { at, field: "max" }));
    let infinite = SceneError::NotFinite { at, field: "max" };
    assert_eq!(plant(|form| form.min[0] = f32::NEG_INFINITY), Err(infinite));
    let told = plant(|form| {
        (form.columns, form.base, form.heights) = (2, None, &[0.0, f32::NAN, 0.25, 1.0]);
    });
    assert_eq!(told, Err(SceneError::NotFinite { at, field: "points" }));
}
