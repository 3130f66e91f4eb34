//! Each solid in a picture of its own: half glass, half mirror, on a floor, so that rays leave it
//! on both sides and its shadow is seen.

use nostray::{
    Affine, Axis, Blend, Corners, Fixed, Form, Fresnel, Heights, Material, Metaball, Operator,
    Paint, Pattern, Profile, Rgb, Scalar, SceneBuilder, SceneError, Stop, Texture, Triangles,
};

use super::{rgb, shoot, sun, tenths};

/// Room for the floor and one solid.
type Builder<S> = SceneBuilder<S, Fixed<4, 8, 4, 32, 256, 0, 16>>;

const SIZE: [u32; 2] = [12, 9];

pub(super) fn trace<S: Scalar>(
    shrink: u32,
    sink: &mut impl FnMut(Rgb<S>),
) -> Result<(), SceneError> {
    picture(shrink, sink, ellipsoid)?;
    picture(shrink, sink, frustum)?;
    picture(shrink, sink, polygon)?;
    picture(shrink, sink, ring)?;
    picture(shrink, sink, spindle)?;
    picture(shrink, sink, lines)?;
    picture(shrink, sink, curves)?;
    picture(shrink, sink, prism)?;
    // Costs as much as all others together.
    picture(2 * shrink, sink, implicit)?;
    picture(shrink, sink, blob)?;
    picture(shrink, sink, hyperboloid)?;
    picture(shrink, sink, crystal)?;
    picture(shrink, sink, hill)?;
    picture(shrink, sink, patch)?;
    picture(shrink, sink, spline)
}

/// One picture. What a solid adds lies about the ball of radius 1 around the origin and has the
/// given material.
#[inline(never)]
fn picture<S: Scalar>(
    shrink: u32,
    sink: &mut impl FnMut(Rgb<S>),
    solid: impl FnOnce(&mut Builder<S>, u16) -> Result<(), SceneError>,
) -> Result<(), SceneError> {
    let mut builder = Builder::new();
    let mirror = stage(&mut builder)?;
    solid(&mut builder, mirror)?;
    shoot(&builder.scene()?, SIZE, shrink, sink)
}

/// Light, a floor, and the material for the solid.
#[inline(never)]
fn stage<S: Scalar>(scene: &mut Builder<S>) -> Result<u16, SceneError> {
    scene.ambient = rgb(2, 2, 3);
    scene.camera.eye = tenths::<S>(12, 16, 42);
    scene.light(sun())?;
    let tiles = [Stop::color(S::ZERO, rgb(8, 8, 7)), Stop::color(S::ONE, rgb(2, 1, 3))];
    let tiles = Texture::new(Pattern::Checker, scene.ramp(&tiles, Blend::Linear)?);
    let checker = scene.texture(Texture { size: [S::from_ratio(7, 10); 3], ..tiles })?;
    let floor = scene
        .material(Material { color: Paint::Texture(checker), ..Material::matte(rgb(1, 1, 1)) })?;
    let normal = tenths::<S>(0, 10, 0);
    let floor_form = Form::Plane { normal, offset: S::from_ratio(-11, 10) };
    scene.leaf(floor_form, &Affine::identity(), floor)?;
    scene.material(Material {
        specular: S::HALF,
        reflect: S::from_ratio(3, 10),
        transmit: S::HALF,
        ior: S::from_ratio(13, 10),
        fresnel: Fresnel::Schlick,
        absorb: rgb(1, 3, 5),
        ..Material::matte(rgb(3, 5, 8))
    })
}

fn ellipsoid<S: Scalar>(scene: &mut Builder<S>, material: u16) -> Result<(), SceneError> {
    let ball = Form::Sphere { center: S::Vec3::default(), radius: S::ONE };
    let place = Affine::scale(tenths::<S>(13, 6, 9)).then(&turned(Axis::Z, 25));
    scene.leaf(ball, &place, material)
}

fn frustum<S: Scalar>(scene: &mut Builder<S>, material: u16) -> Result<(), SceneError> {
    let (base, top) = (tenths::<S>(-7, -6, 2), tenths::<S>(6, 7, -3));
    let (base_radius, top_radius) = (S::from_ratio(8, 10), S::from_ratio(3, 10));
    let cone = Form::Cone { base, base_radius, top, top_radius };
    scene.leaf(cone, &Affine::identity(), material)
}

/// An arrow, so not convex, that leans back.
fn polygon<S: Scalar>(scene: &mut Builder<S>, material: u16) -> Result<(), SceneError> {
    let flat = [(-10, -8), (0, -3), (10, -8), (0, 10)];
    let vertices = flat.map(|(x, y)| tenths::<S>(x, y, 0));
    let place = turned(Axis::X, -20).then(&turned(Axis::Y, 15));
    scene.leaf(Form::Polygon { vertices: &vertices }, &place, material)
}

/// Two balls that meet, a rounded cylinder through them, and a bite.
fn blob<S: Scalar>(scene: &mut Builder<S>, material: u16) -> Result<(), SceneError> {
    let (one, some) = (S::ONE, S::from_ratio(7, 10));
    let components = [
        Metaball::ball(tenths::<S>(-5, 0, 0), S::ONE, one),
        Metaball::ball(tenths::<S>(4, 3, 2), some, one + S::HALF),
        Metaball::cylinder(tenths::<S>(-8, -6, 3), tenths::<S>(8, -4, -2), some, one),
        Metaball::ball(tenths::<S>(-2, 4, 6), some, -one),
    ];
    let form = Form::Blob { threshold: S::from_ratio(4, 10), components: &components };
    scene.leaf(form, &turned(Axis::Y, 20), material)
}

fn ring<S: Scalar>(scene: &mut Builder<S>, material: u16) -> Result<(), SceneError> {
    torus(scene, material, [7, 3])
}

fn spindle<S: Scalar>(scene: &mut Builder<S>, material: u16) -> Result<(), SceneError> {
    torus(scene, material, [3, 6])
}

fn torus<S: Scalar>(
    scene: &mut Builder<S>,
    material: u16,
    radii: [i32; 2],
) -> Result<(), SceneError> {
    let (center, axis) = (S::Vec3::default(), tenths::<S>(3, 10, 5));
    let [major, minor] = radii.map(|radius| S::from_ratio(radius, 10));
    scene.leaf(Form::Torus { center, axis, major, minor }, &Affine::identity(), material)
}

fn pairs<S: Scalar, const N: usize>(tenths: [(i32, i32); N]) -> [[S; 2]; N] {
    tenths.map(|(a, b)| [S::from_ratio(a, 10), S::from_ratio(b, 10)])
}

/// A bowl of lines, upside down and aslant.
fn lines<S: Scalar>(scene: &mut Builder<S>, material: u16) -> Result<(), SceneError> {
    let spots = pairs([(0, -8), (4, -8), (10, 2), (10, 6), (8, 6), (8, 3), (3, -5), (0, -5)]);
    let form = Form::Lathe { center: S::Vec3::default(), profile: Profile::Linear(&spots) };
    scene.leaf(form, &turned(Axis::X, 140).then(&turned(Axis::Z, 20)), material)
}

/// A spinning top of curves.
fn curves<S: Scalar>(scene: &mut Builder<S>, material: u16) -> Result<(), SceneError> {
    let spots = pairs([(0, -10), (3, -6), (9, 0), (5, 3), (2, 6), (2, 9), (0, 10)]);
    let form = Form::Lathe { center: S::Vec3::default(), profile: Profile::CatmullRom(&spots) };
    scene.leaf(form, &turned(Axis::Z, -15), material)
}

/// A star that crosses itself.
fn prism<S: Scalar>(scene: &mut Builder<S>, material: u16) -> Result<(), SceneError> {
    let vertices = pairs([(0, 10), (6, -8), (-9, 3), (9, 3), (-6, -8)]);
    let form = Form::Prism { vertices: &vertices, height: S::HALF };
    scene.leaf(form, &turned(Axis::X, 60), material)
}

/// A fan of one patch, folded over itself.
fn patch<S: Scalar>(scene: &mut Builder<S>, material: u16) -> Result<(), SceneError> {
    let spots = [
        [(0, -9, 0), (0, -9, 0), (0, -9, 0), (0, -9, 0)],
        [(-7, -4, 6), (2, -7, -9), (-3, -2, 9), (6, -5, -6)],
        [(-12, 2, 0), (8, 1, 9), (-9, 3, -8), (12, 2, 3)],
        [(-8, 9, 2), (-1, 12, -5), (3, 7, 6), (9, 10, 0)],
    ];
    let mut points = [S::Vec3::default(); 16];
    let mut indices = [0; 16];
    for (index, (x, y, z)) in spots.into_iter().flatten().enumerate() {
        if let Some(point) = points.get_mut(index) {
            *point = tenths::<S>(x, y, z);
        }
        if let Some(slot) = indices.get_mut(index) {
            *slot = index as u32;
        }
    }
    let form = Form::Patches { points: &points, patches: &[indices] };
    scene.leaf(form, &turned(Axis::Y, 30), material)
}

/// A leaf of paper that curls: a spline of two patches.
fn spline<S: Scalar>(scene: &mut Builder<S>, material: u16) -> Result<(), SceneError> {
    let heights = [[5, -9, -9, 9], [2, -6, 6, 8], [0, 2, 9, 4], [3, 5, 2, -8], [9, 9, -4, -9]];
    let mut points = [S::Vec3::default(); 20];
    let places = (-2..).zip(heights).flat_map(|(row, heights)| {
        (-2..).zip(heights).map(move |(column, height)| (column * 14 + 7, height, row * 11))
    });
    for (point, (x, y, z)) in points.iter_mut().zip(places) {
        *point = tenths::<S>(x, y, z);
    }
    let form = Form::Spline { points: &points, columns: 4, closed: [false; 2] };
    scene.leaf(form, &turned(Axis::X, 25), material)
}

/// What lies between two sheets, cut off by a ball.
fn hyperboloid<S: Scalar>(scene: &mut Builder<S>, material: u16) -> Result<(), SceneError> {
    let quadric = Form::Quadric {
        center: S::Vec3::default(),
        squares: tenths::<S>(20, -10, 10),
        products: tenths::<S>(3, 0, 2),
        linear: tenths::<S>(0, 1, 0),
        constant: S::from_ratio(1, 10),
    };
    scene.open(Operator::Difference)?;
    let ball = Form::Sphere { center: S::Vec3::default(), radius: S::ONE };
    scene.leaf(ball, &Affine::identity(), material)?;
    scene.leaf(quadric, &turned(Axis::Z, 20), material)?;
    scene.close(material)
}

/// An octahedron as a closed mesh, smooth and with a corner cut off.
fn crystal<S: Scalar>(scene: &mut Builder<S>, material: u16) -> Result<(), SceneError> {
    let points = [(10, 0, 0), (-9, 0, 0), (0, 10, 0), (0, -9, 0), (0, 0, 10), (0, 0, -9)];
    let points = points.map(|(x, y, z)| tenths::<S>(x, y, z));
    let triangles =
        [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    let corners = Corners { values: &points[..], triangles: &triangles[..] };
    let mesh = Triangles { points: corners, normals: Some(corners), uvs: None, closed: true };
    scene.open(Operator::Difference)?;
    scene.leaf(Form::Mesh(mesh), &turned(Axis::Y, 20), material)?;
    let center = tenths::<S>(4, 9, 6);
    scene.leaf(Form::Sphere { center, radius: S::HALF }, &Affine::identity(), material)?;
    scene.close(material)
}

/// A height field as an open mesh.
fn hill<S: Scalar>(scene: &mut Builder<S>, material: u16) -> Result<(), SceneError> {
    let heights = [0, 2, 1, 3, 9, 4, 0, 4, 2].map(|height| S::from_ratio(height, 10));
    let (min, max) = ([-S::ONE; 2], [S::ONE; 2]);
    let field = Heights { min, max, columns: 3, heights: &heights, base: None, smooth: true };
    scene.leaf(Form::HeightField(field), &turned(Axis::X, 15), material)
}

fn turned<S: Scalar>(axis: Axis, degrees: i32) -> Affine<S> {
    Affine::rotate(axis, S::from_i32(degrees))
}

/// A cube joined smoothly with a torus, less a wave.
fn implicit<S: Scalar>(scene: &mut Builder<S>, material: u16) -> Result<(), SceneError> {
    use nostray::shape::program::{
        ABS, ADD, MAX, MUL, NUMBER, POWER, ROOT, SIN, SMOOTH_MIN, SQUARE, SUB, X, Y, Z,
    };
    const CODE: &[u8] = &[
        X, POWER, 4, Y, POWER, 4, ADD, Z, POWER, 4, ADD, NUMBER, 0, SUB, // the cube
        X, SQUARE, Y, SQUARE, ADD, ROOT, NUMBER, 1, SUB, SQUARE, Z, SQUARE, ADD, ROOT, NUMBER, 2,
        SUB, SMOOTH_MIN, 3, //
        X, NUMBER, 4, MUL, SIN, ABS, NUMBER, 5, SUB, MAX,
    ];
    let numbers = [(1, 10), (8, 10), (2, 10), (3, 10), (9, 1), (19, 20)];
    let numbers = numbers.map(|(n, d)| S::from_ratio(n, d));
    let (min, max) = (tenths::<S>(-11, -11, -11), tenths::<S>(11, 11, 4));
    let form = Form::Implicit { min, max, code: CODE, numbers: &numbers, spans: Some(8) };
    scene.leaf(form, &turned(Axis::Y, 30), material)
}
