//! Meshes in files: as they are written, and refused with the line where they are not.

use std::fs;
use std::path::PathBuf;

use nostray::Scalar;
use nostray_harness::obj::read_obj;
use nostray_harness::source::Source;

use super::figures::{self, mesh_of};
use crate::oracle::Random;

fn folder() -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("meshes");
    fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

/// A ball in OBJ format, with normals by turns.
fn ball() -> String {
    let figure = figures::ball(1);
    let mut text = String::from("# a ball\no ball\n");
    for [x, y, z] in &figure.points {
        text.push_str(&format!("v {x} {y} {z}\nvn {x} {y} {z}\nvt {x} {y}\n"));
    }
    for (n, triangle) in figure.triangles.iter().enumerate() {
        let [a, b, c] = triangle.map(|index| index + 1);
        let count = figure.points.len() as i64;
        let back = |index: u32| i64::from(index) - count - 1;
        text.push_str(&match n % 3 {
            0 => format!("f {a} {b} {c}\n"),
            1 => format!("s off\nf {a}//{a} {b}//{b} {c}//{c}\n"),
            _ => format!("f {0}/{0}/{0} {1}/{1}/{1} {2}/{2}/{2}\n", back(a), back(b), back(c)),
        });
    }
    text
}

fn scene_text(solid: &str) -> String {
    format!(
        "(camera: (eye: (0, 0, 5), look_at: (0, 0, 0)), materials: {{\"m\": ()}},\n objects: [(solid: {solid}, material: \"m\")])"
    )
}

/// What comes of a scene file beside the test's meshes.
fn load<S: Scalar>(name: &str, solid: &str) -> Result<(u32, bool), String> {
    let path = folder().join(name);
    fs::write(&path, scene_text(solid)).expect("the scene can be written");
    let source = Source::find(path.to_str().expect("a name"))?;
    let loaded = source.load::<S>()?;
    let scene = loaded.scene()?;
    let mesh = mesh_of(&scene);
    Ok((mesh.triangles, mesh.smooth))
}

#[test]
fn files_stand_beside_the_scene() {
    fs::write(folder().join("ball.obj"), ball()).expect("the mesh can be written");
    let closed = r#"Mesh(file: "ball.obj", closed: true)"#;
    assert_eq!(load::<f32>("ball.ron", closed), Ok((32, true)));
    assert_eq!(load::<nostray::Q16>("ball.ron", closed), Ok((32, true)));
    let cut = r#"Difference([Mesh(file: "ball.obj", closed: true), Box(min: (0, 0, 0), max: (2, 2, 2))])"#;
    let path = folder().join("cut.ron");
    fs::write(&path, scene_text(cut)).expect("the scene can be written");
    let source = Source::find(path.to_str().expect("a name")).expect("a scene");
    let loaded = source.load::<f64>().expect("a legal scene");
    assert_eq!(loaded.scene().expect("a legal scene").limits().boundaries, 2 * (32 + 2));
}

#[test]
fn meshes_are_written_in_place() {
    let points = "[(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]";
    let faces = "[(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]";
    let solid = format!("Mesh(points: {points}, triangles: {faces}, closed: true)");
    assert_eq!(load::<f64>("inline.ron", &solid), Ok((4, false)));
    let solid = format!("Mesh(points: {points}, triangles: {faces}, smooth: true)");
    assert_eq!(load::<f64>("inline.ron", &solid), Ok((4, true)));
    let field =
        "HeightField(min: (0, 0), max: (1, 1), columns: 2, heights: [0, 1, 0, 1], base: -1)";
    assert_eq!(load::<f32>("field.ron", field), Ok((2 + 12, false)));
}

#[test]
fn what_is_wrong_is_told_with_its_place() {
    let refused = |solid: &str, part: &str| {
        let message = load::<f32>("refused.ron", solid).expect_err("refused");
        assert!(message.contains(part), "{part:?} in {message:?}");
    };
    let points = "points: [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]";
    refused(r#"Mesh(file: "nosuch.obj")"#, "refused.ron:2:");
    refused(r#"Mesh(file: "nosuch.obj")"#, "Mesh.file: ");
    fs::write(folder().join("bad.obj"), "v 0 0 0\nf 1 2 3\n").expect("the mesh can be written");
    refused(r#"Mesh(file: "bad.obj")"#, "bad.obj:2: there is no v 2 in \"2\"");
    fs::write(folder().join("latin.obj"), b"# \xe9").expect("the mesh can be written");
    refused(r#"Mesh(file: "latin.obj")"#, "is not UTF-8 text");
    fs::write(folder().join("empty.obj"), "v 0 0 0\n").expect("the mesh can be written");
    refused(r#"Mesh(file: "empty.obj")"#, "empty.obj: has no triangles");
    refused(&format!(r#"Mesh(file: "ball.obj", {points})"#), "either a file or points");
    refused(&format!("Mesh({points})"), "triangles");
    refused(&format!("Mesh({points}, triangles: [(0, 1, 4)])"), "triangle 0 names a point");
    refused(&format!("Mesh({points}, triangles: [(0, 1, -1)])"), "refused.ron:2:");
    refused(
        &format!("Mesh({points}, triangles: [(0, 1, 2)], closed: true)"),
        "without a neighbour",
    );
    refused(&format!("Mesh({points}, triangles: [(0, 1, 1)])"), "triangle 0 has no area");
    refused(
        &format!("Mesh({points}, triangles: [(0, 1, 2)], normals: [(0, 1, 0)])"),
        "Mesh.normals: ",
    );
    refused(&format!("Mesh({points}, triangles: [(0, 1, 2)], uvs: [(0, 1)])"), "Mesh.uvs: ");
    refused(&format!("Mesh({points}, faces: [(0, 1, 2)])"), "faces");
    let field = "HeightField(min: (0, 0), max: (1, 1), columns: 2, heights: [0, 1, 0";
    refused(&format!("{field}])"), "HeightField.heights: ");
    refused(&format!("{field}, 1], base: 0)"), "HeightField.base: must be below all heights");
}

/// Files with what a slip of the hand or of a disk may do to them: an error or a mesh, and a mesh that is
/// a scene or refused; never a panic.
#[test]
fn damaged_files_are_refused_or_read() {
    let whole = ball();
    let mut random = Random::new(21);
    let (mut read, mut refused, mut scenes) = (0, 0, 0);
    for n in 0..600 {
        let mut bytes = whole.clone().into_bytes();
        if n % 3 == 0 {
            bytes.truncate(random.below(bytes.len()));
        }
        for _ in 0..random.below(6) {
            let at = random.below(bytes.len().max(1));
            let Some(byte) = bytes.get_mut(at) else { break };
            *byte = match random.below(4) {
                0 => b"-0123456789./ \n\\#vfnt"[random.below(21)],
                1 => (random.bits() & 0x7f) as u8,
                2 => b'9',
                _ => b' ',
            };
        }
        let text = String::from_utf8_lossy(&bytes);
        match read_obj(&text) {
            Err(error) => {
                assert!(error.line >= 1 && error.line <= text.lines().count(), "{error}");
                refused += 1;
            }
            Ok(figure) => {
                read += 1;
                let name = folder().join("damaged.obj");
                fs::write(&name, text.as_bytes()).expect("the mesh can be written");
                let closed = n % 2 == 0;
                let solid = format!("Mesh(file: \"damaged.obj\", closed: {closed}, smooth: true)");
                match load::<f32>("damaged.ron", &solid) {
                    Ok((triangles, _)) => {
                        assert_eq!(triangles as usize, figure.corners.len());
                        scenes += 1;
                    }
                    Err(message) => assert!(message.contains("damaged.ron:2:"), "{message}"),
                }
            }
        }
    }
    assert!(read > 60 && refused > 60 && scenes > 30, "{read} {refused} {scenes}");
}
