#![allow(
    clippy::disallowed_methods,
    reason = "what is expected is worked out with the platform's own mathematics"
)]

mod legality;
mod pictures;
mod shading;

use nostray::glam::{DVec3, Vec3};
use nostray::{Background, Depth, Light, Node, Pixel, Projection, Render, Rgb, Scalar, Shape};

use super::{NffError, NffScene, load};

/// One of each entity, in the layout of the published examples.
const ALL: &str = "\
# a comment
b 0.1 0.2 0.3
v
from 0 -5 1
at 0 0 1
up 0 0 1
angle 45
hither 0.5
resolution 40 30
l 3 -4 5
l 1 2 3 0.5 0.25 1
f 1 0.5 0.25 0.8 0.2 10 0 0
s 0 0 1 0.5
c 0 0 0 1 0 0 2 1
c 0 0 0 1 0 0 2 0.25
f 0.5 0.5 0.5 0.1 0.1 100 0.8 1.5
p 3
0 0 0
1 0 0
0 1 0
p 5
0 0 0
2 0 0
1 1 0
2 2 0
0 2 0
pp 4
0 0 0 0 0 1
1 0 0 0 0 1
1 1 0 0 0 1
0 1 0 0 0 1
";

/// A view from (0, −5, 0) along y with z up, for the objects that follow.
const VIEW: &str = "v from 0 -5 0 at 0 0 0 up 0 0 1 angle 45 f 1 1 1 1 0 1 0 1\n";

fn read(text: &str) -> NffScene<f64> {
    load(text).unwrap_or_else(|error| panic!("{error} in\n{text}"))
}

fn refused(text: &str) -> NffError {
    match load::<f64>(text) {
        Err(error) => error,
        Ok(_) => panic!("not refused:\n{text}"),
    }
}

/// The picture of a scene, without mirrored or refracted light beyond eight generations.
fn draw<S: Scalar>(scene: &NffScene<S>, width: u32, height: u32) -> Vec<Pixel<S>> {
    let scene = scene.builder.scene().expect("a scene that was read is legal");
    let render: Render<S> = Render::new(&scene, width, height, Depth::fixed(8)).expect("a picture");
    render.collect()
}

#[test]
fn every_entity_is_read() {
    let read = read(ALL);
    let scene = read.builder.scene().expect("legal");
    let parts = scene.parts();
    assert_eq!(read.size, Some((40, 30)));
    assert_eq!((read.skipped, read.flattened), (0, 0));
    assert_eq!(parts.camera.eye, DVec3::new(0.0, -5.0, 1.0));
    assert_eq!(parts.camera.look_at, DVec3::new(0.0, 0.0, 1.0));
    assert_eq!(parts.camera.up, DVec3::new(0.0, 0.0, 1.0));
    assert_eq!(parts.camera.projection, Projection::Pinhole { fov: 45.0 });
    assert_eq!(parts.background, Background::Constant(Rgb::new(0.1, 0.2, 0.3)));
    assert!(parts.ambient.is_black());
    let names: Vec<_> = parts.nodes.iter().map(kind).collect();
    let expected =
        ["sphere", "cylinder", "cone", "triangle", "polygon of 5", "triangle", "triangle"];
    assert_eq!(names, expected);
    let [opaque, glass] = parts.materials else { panic!("two materials") };
    assert_eq!((opaque.diffuse, opaque.specular, opaque.reflect), (0.8, 0.2, 0.2));
    assert_eq!((opaque.shininess, opaque.transmit, opaque.ior), (10.0, 0.0, 1.0));
    assert_eq!((glass.transmit, glass.ior), (0.8, 1.5));
}

fn kind(node: &Node<f64>) -> String {
    let Node::Leaf(leaf) = node else { panic!("no operators") };
    match &leaf.shape {
        Shape::Sphere(_) => "sphere".into(),
        Shape::Cylinder(_) => "cylinder".into(),
        Shape::Cone(_) => "cone".into(),
        Shape::Triangle(_) => "triangle".into(),
        Shape::Polygon(polygon) => format!("polygon of {}", polygon.count),
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_layout_does_not_matter() {
    let plain = format!("{:?}", read(ALL).builder.scene().expect("legal").parts());
    let same = |text: &str| format!("{:?}", read(text).builder.scene().expect("legal").parts());
    let words = || ALL.lines().skip(1).flat_map(str::split_whitespace);
    let in_one_line = words().collect::<Vec<_>>().join(" ");
    assert_eq!(same(&in_one_line), plain, "one line");
    let one_each = words().map(|word| format!("\t{word} # {word} 7\n\n")).collect::<String>();
    assert_eq!(same(&one_each), plain, "a word a line, with comments");
    assert_eq!(same(&ALL.replace('\n', "\r\n")), plain, "CRLF");
    assert_eq!(same(&ALL.to_uppercase()), plain, "upper case");
    assert_eq!(same(&format!("\u{feff}{ALL}")), plain, "byte order mark");
    let exponents = ALL.replace("0.25", "+2.5e-1").replace("0.5", ".5E0").replace(" 45", " 4.5e+1");
    assert_eq!(same(&exponents), plain, "exponents");
    let reordered = ALL.replace("hither 0.5\n", "").replace(
        "from 0 -5 1\nat 0 0 1\nup 0 0 1\nangle 45\n",
        "angle 45 yon 9 up 0 0 1 at 0 0 1 from 0 -5 1\n",
    );
    assert_eq!(same(&reordered), plain, "the order of the view, and yon for hither");
}

#[test]
fn a_bad_word_is_found_in_its_line() {
    let words: Vec<(usize, usize, &str)> = (1..)
        .zip(ALL.lines())
        .skip(1)
        .flat_map(|(line, text)| {
            text.split_whitespace().enumerate().map(move |(i, w)| (line, i, w))
        })
        .collect();
    assert_eq!(words.len(), 130);
    for bad in ["nan", "-inf", "1e999", "1.2.3", "zz"] {
        for &(line, place, word) in &words {
            let spoilt = |(number, text): (usize, &str)| {
                let spoil = |(i, w)| if (number, i) == (line, place) { bad } else { w };
                text.split_whitespace().enumerate().map(spoil).collect::<Vec<_>>().join(" ")
            };
            let text: Vec<_> = (1..).zip(ALL.lines()).map(spoilt).collect();
            let error = refused(&text.join("\n"));
            if ["from", "at", "up", "angle"].contains(&word) {
                let told = format!("has no `{word}` before `{bad}` in line {line}");
                assert!(error.line == 3 && error.message.contains(&told), "{error}");
            } else {
                assert_eq!(error.line, line, "`{bad}` for `{word}` gave: {error}");
                assert!(error.message.contains(bad), "`{bad}` for `{word}` gave: {error}");
            }
        }
    }
}

#[test]
fn a_file_that_is_cut_short_is_refused_or_whole() {
    let mut refusals = 0;
    for end in 0..ALL.len() {
        let cut = &ALL[..end];
        if let Err(error) = load::<f32>(cut) {
            refusals += 1;
            assert!((1..=cut.lines().count().max(1)).contains(&error.line), "{error} in\n{cut}");
        }
    }
    assert!(refusals > ALL.len() / 2);
    let error = refused(&ALL[..ALL.find("2 2 0").expect("a vertex") + 3]);
    assert_eq!(error, NffError::new(25, "p: the file ends within it"));
    assert_eq!(error.to_string(), "line 25: p: the file ends within it");
}

#[test]
fn errors_name_line_and_cause() {
    let cases = [
        ("", 1, "without a view"),
        ("# nothing\nb 1 1 1\n# more\n", 3, "without a view"),
        ("v from 0 0 0 at 0 0 1 up 0 1 0", 1, "has no `angle`"),
        ("\nv\nfrom 0 0 0\nat 0 0 0 up 0 1 0 angle 9", 2, "too close together"),
        ("v angle 0", 1, "between 0 and 180"),
        ("v\nangle 180", 2, "between 0 and 180"),
        ("v up 0 0\n0", 2, "`up` has no length"),
        ("v resolution 0 5", 1, "cannot be 0 pixels"),
        ("v resolution 5 99999999999", 1, "cannot be 99999999999 pixels"),
        ("v resolution 5.5 5", 1, "whole number"),
        ("v resolution 5\nl 1 2 3", 2, "found `l`"),
        ("s 0 0 0 1", 1, "before the first `f`"),
        ("q 1 2 3", 1, "unknown entity `q`"),
        ("b 1 1 1 1", 1, "expected an entity, found the number `1`"),
        ("b 1 1 -1", 1, "not between 0 and 10000"),
        ("l 1 2 3 4", 1, "the file ends within it"),
        ("l 1 2 3 4 5 6\n7", 2, "expected an entity, found the number `7`"),
        ("l 1 2 3 4 5 -6", 1, "not between 0 and 10000"),
        ("f 1 1 1 1 0 -1 0 1", 1, "Shine"),
        ("f 1 1 1 1 0 1 0.5 0", 1, "index of refraction"),
        ("f 1 1 1 -0.5 0 1 0 1", 1, "f: Kd"),
        ("f 1 1 1 1 0 1 0\nl 0 0 0", 2, "found `l`"),
        ("f 1 1 1 1 0 1 0 1\ns 0 0 0 0", 2, "the radius is 0"),
        ("f 1 1 1 1 0 1 0 1\ns 0 0 0 1e-300", 2, "radius must be greater than 0"),
        ("f 1 1 1 1 0 1 0 1\ns 1e300 0 0 1", 2, "beyond the range of f64"),
        ("f 1 1 1 1 0 1 0 1 c 0 0 0 0 0 0 1 0", 1, "both radii are 0"),
        ("f 1 1 1 1 0 1 0 1 c 0 0 0 1 0 0 1 -1", 1, "one radius is negative"),
        ("f 1 1 1 1 0 1 0 1\np 2\n0 0 0\n1 1 1", 2, "2 vertices; 3 are the least"),
        ("f 1 1 1 1 0 1 0 1\npp 0", 2, "0 vertices; 3 are the least"),
        ("f 1 1 1 1 0 1 0 1\np -3\n0 0 0", 2, "whole number from 0 on, found `-3`"),
        ("f 1 1 1 1 0 1 0 1\np 18446744073709551615\n0 0 0", 3, "the file ends within it"),
        ("f 1 1 1 1 0 1 0 1\np 4 0 0 0 1 0 0 1 1 0\nf 1", 3, "found `f`"),
    ];
    for (text, line, cause) in cases {
        let error = refused(text);
        assert_eq!(error.line, line, "{error} for\n{text}");
        assert!(error.message.contains(cause), "{error} for\n{text}");
    }
    let error = refused(&format!("{VIEW}{VIEW}"));
    assert_eq!(error, NffError::new(2, "a second view `v`"));
    // The range is that of the number format.
    let far = "f 1 1 1 1 0 1 0 1\ns 1e30 0 0 1";
    let error = load::<f32>(far).expect_err("beyond single precision");
    assert_eq!(
        error.to_string(),
        format!("line 2: s: 1{} is beyond the range of f32", "0".repeat(30))
    );
    assert!(load::<f64>(&format!("{VIEW}{far}")).is_ok());
}

#[test]
fn what_has_no_extent_is_counted() {
    let cases = [
        ("p 3 0 0 0 1 1 1 2 2 2", 1, 0),
        ("p 3 0 0 0 0 0 0 1 0 0", 1, 0),
        ("p 4 0 0 0 1 0 0 2 0 0 3 0 0", 1, 0),
        ("p 5 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1", 1, 0),
        ("pp 3 0 0 0 0 0 1 1 0 0 0 0 1 2 0 0 0 0 1", 1, 0),
        ("c 1 1 1 0.5 1 1 1 0.5", 1, 0),
        ("c 1 1 1 0.5 1 1 1 0.25", 1, 0),
        // Coincident and collinear vertices of what has an area do no harm.
        ("p 4 0 0 0 1 0 0 1 0 0 0 1 0", 0, 1),
        ("p 5 0 0 0 1 0 0 2 0 0 2 2 0 0 2 0", 0, 1),
        ("c 0 0 0 1 0 0 1 1", 0, 1),
        // A folded quadrilateral with a coincident vertex: one of its triangles has no area.
        ("p 5 0 0 0 1 0 0 1 0 0 1 1 1 0 1 0", 0, 2),
    ];
    for (text, skipped, objects) in cases {
        let read = read(&format!("{VIEW}{text}"));
        assert_eq!(read.skipped, skipped, "{text}");
        let scene = read.builder.scene().expect("legal");
        assert_eq!(scene.parts().objects.len(), objects, "{text}");
    }
    let together: String = cases.iter().map(|(text, ..)| format!("{text}\n")).collect();
    assert_eq!(read(&format!("{VIEW}{together}")).skipped, 7);
}

#[test]
fn lights_without_a_colour_share() {
    let lights = "l 1 0 0\nl 2 0 0 0.5 0.25 0\nl 3 0 0\nl 4 0 0\n";
    let read = read(&format!("{lights}{VIEW}"));
    let scene = read.builder.scene().expect("legal");
    let got = scene.parts().lights.iter().map(|light| match light {
        Light::Point { at, color, .. } => (at.x, color.to_array()),
        other => panic!("{other:?}"),
    });
    let expected = [(1.0, [0.5; 3]), (2.0, [0.5, 0.25, 0.0]), (3.0, [0.5; 3]), (4.0, [0.5; 3])];
    assert_eq!(got.collect::<Vec<_>>(), expected);
    for count in 1..=7 {
        let read = self::read(&format!("{}{VIEW}", "l 1 1 1\n".repeat(count)));
        let scene = read.builder.scene().expect("legal");
        let power = scene.parts().lights.iter().map(|light| match light {
            Light::Point { color, .. } => color.r * color.r,
            other => panic!("{other:?}"),
        });
        let power: f64 = power.sum();
        assert!((power - 1.0).abs() < 1e-15, "{count} lights: {power}");
    }
}

#[test]
fn equal_materials_are_one() {
    let fills = ["f 1 0 0 1 0 1 0 1", "f 0 1 0 1 0 1 0 1.0", "f 1 0 0 1 0 1.0 0 7"];
    let repeated: String = (0..90).map(|i| format!("{}\ns {i} 0 0 1\n", fills[i % 3])).collect();
    let read = read(&format!("v from 0 -5 0 at 0 0 0 up 0 0 1 angle 45\n{repeated}"));
    let scene = read.builder.scene().expect("legal");
    // The third is the first: the index of refraction says nothing without T.
    assert_eq!(scene.parts().materials.len(), 2);
    for (i, object) in scene.parts().objects.iter().enumerate() {
        assert_eq!(object.material, u16::from(i % 3 == 1), "sphere {i}");
    }
}

#[test]
fn an_up_along_the_view_is_replaced() {
    for (from, up, chosen) in [
        ("0 0 9", "0 0 1", DVec3::Y),
        ("0 0 9", "0 0 -3", DVec3::Y),
        ("0 9 0", "0 2 0", DVec3::Z),
        ("9 0 0", "1 0 0", DVec3::Z),
        ("3 3 3", "-1 -1 -1", DVec3::Z),
        ("0 0 9", "2 0 2", DVec3::new(1.0, 0.0, 1.0)),
        ("0 0 9", "1e-310 -1e-310 0", DVec3::new(1.0, -1.0, 0.0)),
        ("0 0 9", "1e300 0 -1e300", DVec3::new(1.0, 0.0, -1.0)),
    ] {
        let text = format!("v from {from} at 0 0 0 up {up} angle 45");
        let read = read(&text);
        assert_eq!(read.builder.camera.up, chosen, "{text}");
        assert!(read.builder.scene().is_ok(), "{text}");
        let single = load::<f32>(&text).expect("read");
        assert_eq!(single.builder.camera.up, chosen.as_vec3(), "{text}");
        assert!(single.builder.scene().is_ok(), "{text}");
        assert_ne!(single.builder.camera.up, Vec3::ZERO);
    }
}
