//! The command `render`: what it refuses, and how it says so.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    reason = "a test may fail loudly"
)]

use std::fs;

use crate::command::{BALL, CAMERA, file, path, refusal, scene_of};

/// A name, a solid that is refused, and a part of the message.
const BAD_SOLIDS: &[(&str, &str, &str)] = &[
    (
        "negative",
        "Sphere(center: (0, 0, 0), radius: -1)",
        ":2:35: objects[0].solid.Sphere.radius: must be greater than 0",
    ),
    (
        "unknown-field",
        "Sphere(center: (0, 0, 0), radious: 1)",
        ":2:27: objects[0].solid.Sphere.radious: ",
    ),
    ("missing-field", "Sphere(center: (0, 0, 0))", "objects[0].solid.Sphere: "),
    ("short", "Sphere(center: (0, 0), radius: 1)", "objects[0].solid.Sphere.center: "),
    (
        "long",
        "Sphere(center: (0, 0, 0, 0), radius: 1)",
        "objects[0].solid.Sphere.center: more than three numbers",
    ),
    ("type", "Sphere(center: (0, 0, 0), radius: \"1\")", "objects[0].solid.Sphere.radius: "),
    (
        "nan",
        "Sphere(center: (0, NaN, 0), radius: 1)",
        "objects[0].solid.Sphere.center: is not a finite number",
    ),
    ("variant", "Teapot()", "Teapot"),
    (
        "cut-cutter",
        "Difference([Sphere(center: (0, 0, 0), radius: 1),\nCylinder(base: (0, 0, 0), top: (0, 0, 0), radius: 1)])",
        ":3:32: objects[0].solid.Difference[1].Cylinder.top: ",
    ),
    (
        "no-surface",
        "Quadric(squares: (1, 1, 1), constant: 1)",
        "objects[0].solid.Quadric.coefficients: ",
    ),
    (
        "no-way-round",
        "Torus(center: (0, 0, 0), axis: (0, 0, 0), major: 1, minor: 0.2)",
        "objects[0].solid.Torus.axis: ",
    ),
    (
        "no-tube",
        "Torus(center: (0, 0, 0), major: 1, minor: 0)",
        "objects[0].solid.Torus.minor: must be greater than 0",
    ),
    (
        "open",
        "Difference([Sphere(center: (0, 0, 0), radius: 1), Polygon([(0, 0, 0), (1, 0, 0), (0, 1, 0)])])",
        "objects[0].solid.Difference[1].Polygon: an open surface",
    ),
    (
        "flat",
        "Triangle(a: (0, 0, 0), b: (1, 1, 1), c: (2, 2, 2))",
        "objects[0].solid.Triangle: the corners lie on one line",
    ),
    (
        "formula",
        "Implicit(min: (-1, -1, -1), max: (1, 1, 1), expr: \"x^2 +\n foo(y)\")",
        "objects[0].solid.Implicit.expr: line 2, column 2 of the formula: there is no function \"foo\"",
    ),
    (
        "formula-spans",
        "Implicit(min: (-1, -1, -1), max: (1, 1, 1), expr: \"sin(x)\")",
        ":2:59: objects[0].solid.Implicit: needs the field `spans`",
    ),
    (
        "formula-box",
        "Implicit(min: (-1, -1, -1), max: (1, -2, 1), expr: \"x\")",
        "objects[0].solid.Implicit.max: lies below",
    ),
    ("empty", "Union([])", "objects[0].solid.Union: has 0 operands"),
    ("inside-out", "Box(min: (0, 0, 0), max: (1, -1, 1))", "objects[0].solid.Box.max: "),
    (
        "scale-zero",
        "With(solid: Sphere(center: (0, 0, 0), radius: 1), place: [RotateX(10), Scale((1, 0, 1))])",
        "objects[0].solid.With.place[1].Scale: a factor must not be 0",
    ),
    (
        "no-axis",
        "With(solid: Sphere(center: (0, 0, 0), radius: 1), place: [Rotate(axis: (0, 0, 0), degrees: 1)])",
        "place[0].Rotate.axis: must not be zero",
    ),
    (
        "far",
        "With(solid: Sphere(center: (0, 0, 0), radius: 1), place: [Translate((1e20, 0, 0))])",
        "objects[0].solid.With.solid.Sphere: is placed beyond the range",
    ),
    ("flat", "Complement(Triangle(a: (0, 0, 0), b: (1, 0, 0), c: (0, 1, 0)))", ".ron:2:"),
    (
        "no-such",
        "With(solid: Sphere(center: (0, 0, 0), radius: 1), material: \"rde\")",
        "objects[0].solid.With.material: there is no material \"rde\"",
    ),
];

/// A name, a scene that is refused, with CAMERA for a camera, and a part of the message.
const BAD_SCENES: &[(&str, &str, &str)] = &[
    (
        "bare",
        "(CAMERA, objects: [(solid: Sphere(center: (0, 0, 0), radius: 1))])",
        "objects[0].solid: has no material",
    ),
    (
        "texture",
        "(CAMERA, materials: {\"m\": (color: \"wood\")})",
        "materials.m.color: there is no texture \"wood\"",
    ),
    ("twice", "(CAMERA, materials: {\"m\": (), \"m\": ()})", "the name \"m\" stands twice"),
    (
        "cell",
        "(CAMERA, textures: {\"t\": Checker(colors: ((0, 0, 0), (1, 1, 1)), size: 0)})",
        "textures.t.Checker.size: must be greater than 0",
    ),
    (
        "weight",
        "(CAMERA,\nmaterials: {\"a.b\": (diffuse:\n -1)})",
        ":3:2: materials.a.b.diffuse: must be at least 0",
    ),
    ("dark", "(CAMERA, ambient: (0, -1, 0))", "ambient: must be at least 0"),
    ("sky", "(CAMERA, background: (0, inf, 0))", "background: is not a finite number"),
    (
        "gradient",
        "(CAMERA, background: (bottom: (0, 0, 0), top: (0, 0, -1)))",
        "background.top: must be at least 0",
    ),
    (
        "lamp",
        "(CAMERA, lights: [Spot(at: (0, 4, 0), toward: (0, -1, 0), inner: 20, outer: 10, color: (1, 1, 1))])",
        "lights[0].Spot.outer: ",
    ),
    (
        "beam",
        "(CAMERA, lights: [Directional(toward: (0, 0, 0), color: (1, 1, 1))])",
        "lights[0].Directional.toward: must not be zero",
    ),
    (
        "blind",
        "(camera: (eye: (1, 2, 3), look_at: (1, 2, 3)))",
        "camera.look_at: must not be where the eye is",
    ),
    (
        "wide",
        "(camera: (eye: (1, 2, 3), look_at: (0, 0, 0), fov: 180))",
        ":1:52: camera.fov: must be between 0 and 180",
    ),
    (
        "both",
        "(camera: (eye: (1, 2, 3), look_at: (0, 0, 0), fov: 40, height: 2))",
        "camera: has either fov or height",
    ),
    ("no-camera", "()", "camera"),
    ("trailing", "(CAMERA) more", ":1:"),
    ("nothing", "", ":1:1: "),
];

#[test]
fn bad_usage_is_refused_by_code_2() {
    for (args, part) in [
        (&["--nonsense"][..], "--nonsense"),
        (&["nosuch"], "nosuch: is neither in the gallery"),
        (&["scene.obj"], "scene.obj: is neither in the gallery"),
        (&["--scalar", "f16"], "--scalar f16"),
        (&["--samples", "4"], "--samples 4"),
        (&["--samples", "0"], "--samples 0"),
        (&["--adaptive", "0.1"], "--adaptive"),
        (&["--size", "640"], "--size"),
        (&["--size", "0x480"], "--size"),
        (&["--size", "16777216x16777216"], "--rows"),
        (&["--depth-max", "65"], "--depth-max 65: must be at most 64"),
        (&["--depth-max", "-1"], "-1"),
        (&["--weight-min", "-0.5"], "--weight-min -0.5"),
        (&["--weight-min", "NaN"], "--weight-min"),
        (&["--error-max", "inf"], "--error-max"),
        (&["--threads", "0"], "--threads"),
        (&["--rows", "5..5"], "--rows"),
        (&["--rows", "7"], "--rows"),
        (&["--rows", "479..481"], "--rows 479..481: the picture has 480 rows"),
        (&["-o", "picture.jpg"], "picture.jpg: must end in .png, .ppm or .pfm"),
        (&["--transfer", "gamma"], "--transfer"),
    ] {
        let message = refusal(args, 2);
        assert!(message.contains(part), "{part:?} in {message:?}");
    }
}

#[test]
fn bad_files_are_told_by_line_and_field() {
    let solids = BAD_SOLIDS.iter().map(|(name, solid, part)| (name, scene_of(solid), part));
    let scenes =
        BAD_SCENES.iter().map(|(name, text, part)| (name, text.replace("CAMERA", CAMERA), part));
    for (name, text, part) in solids.chain(scenes) {
        let name = file(&format!("bad-{name}.ron"), &text);
        let message = refusal(&[&name, "--size", "2x2"], 1);
        assert!(message.starts_with(&name) && message.contains(part), "{part:?} in {message:?}");
    }
    let (name, text) =
        ("bad.json", "{\"camera\": {\"eye\": [0, 0, 1], \"look_at\": [0, 0, 0],\n \"zoom\": 2}}");
    let message = refusal(&[&file(name, text)], 1);
    assert!(message.contains("bad.json:2:7: camera.zoom: unknown field"), "{message}");
    let message = refusal(&[path("nosuch.ron").to_str().unwrap()], 1);
    assert!(message.contains("nosuch.ron: "), "{message}");
    let latin = path("latin.ron");
    fs::write(&latin, b"(\n\n\xe9)").unwrap();
    assert!(refusal(&[latin.to_str().unwrap()], 1).contains(":3: is not UTF-8 text"));
}

#[test]
fn deep_nesting_is_refused_not_overflown() {
    for depth in [17, 60, 10_000] {
        let ron = scene_of(&format!("{}{BALL}{}", "Complement(".repeat(depth), ")".repeat(depth)));
        let message = refusal(&[&file("deep.ron", &ron)], 1);
        assert!(depth < 60 || message.contains("is nested too deeply"), "{message}");
        let ball = r#"{"Sphere": {"center": [0, 0, 0], "radius": 1}}"#;
        let solid =
            format!("{}{ball}{}", "{\"With\": {\"solid\": ".repeat(depth), "}}".repeat(depth));
        let json = format!(
            "{{\"camera\": {{\"eye\": [0, 0, 5], \"look_at\": [0, 0, 0]}}, \"objects\": [{{\"solid\": {solid}}}]}}"
        );
        refusal(&[&file("deep.json", &json)], 1);
    }
}
