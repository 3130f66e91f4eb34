//! Textures in scene files: what is refused and how it is said, images from files, and JSON.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    reason = "a test may fail loudly"
)]

use std::fs;

use crate::command::{BALL, CAMERA, file, output, path, refusal};
use nostray_harness::document::PATTERNS;

/// A name, the texture "t" that is refused, and a part of the message.
const BAD: &[(&str, &str, &str)] = &[
    ("pattern", "Marbel()", ":2:"),
    ("pattern", "Marbel()", "Marbel"),
    ("field", "Wood(wobbel: 1)", ":2:11: textures.t.Wood.wobbel: "),
    ("alien", "Wood(mortar: 1)", ":2:19: textures.t.Wood.mortar: Wood has no such field"),
    ("colourless", "Noise(colors: [])", "textures.t.Noise.colors: needs at least 1 paints"),
    ("one", "Stripes(colors: [(1, 1, 1)])", "textures.t.Stripes.colors: needs at least 2 paints"),
    (
        "joint",
        "Hexagons(stops: [(0, (1, 1, 1)), (1, (0, 0, 0))])",
        "textures.t.Hexagons.stops: needs at least 3",
    ),
    (
        "order",
        "Noise(stops: [(0.5, (1, 1, 1)),\n(0.4, (0, 0, 0))])",
        ":3:2: textures.t.Noise.stops[1][0]: must not be less than the stop before",
    ),
    (
        "level",
        "Noise(stops: [(1.5, (1, 1, 1))])",
        "textures.t.Noise.stops[0][0]: must be between 0 and 1",
    ),
    (
        "stop",
        "Noise(stops: [(1, (1, 1, 1), 2)])",
        "textures.t.Noise.stops[0]: more than a level and a paint",
    ),
    (
        "both",
        "Noise(colors: [(1, 1, 1)], stops: [(0, (1, 1, 1))])",
        "textures.t.Noise.stops: cannot stand beside colors",
    ),
    (
        "unknown",
        "Noise(colors: [\"oak\"])",
        "textures.t.Noise.colors[0]: there is no texture \"oak\"",
    ),
    (
        "unknown-stop",
        "Noise(stops: [(0,\n \"oak\")])",
        ":3:2: textures.t.Noise.stops[0][1]: there is no texture \"oak\"",
    ),
    ("itself", "Noise(colors: [\"t\"])", "textures.t: is made of itself"),
    ("dark", "Noise(colors: [(0, -1, 0)])", "textures.t.Noise.colors: must be at least 0"),
    ("octaves", "Granite(octaves: 11)", "textures.t.Granite.octaves: must be between 1 and 10"),
    ("gain", "Granite(gain: 2)", "textures.t.Granite.gain: must be between 0 and 1"),
    ("size", "Granite(size: (1, 0, 1))", "textures.t.Granite.size: must be greater than 0"),
    ("warp", "Granite(warp: NaN)", "textures.t.Granite.warp: "),
    ("mortar", "Brick(mortar: -1)", "textures.t.Brick.mortar: must be between 0 and 1"),
    ("gap", "Hexagons(gap: 2)", "textures.t.Hexagons.gap: must be between 0 and 1"),
    ("wobble", "Wood(wobble: 1000)", "textures.t.Wood.wobble: must be between -100 and 100"),
    ("radius", "Spots(radius: 0)", "textures.t.Spots.radius: must be between 0.001 and 100"),
    (
        "major",
        "Checker(mapping: Toroidal(major: 0))",
        "textures.t.Checker.major: must be greater than 0",
    ),
    ("mapping", "Checker(mapping: Conical)", "textures.t.Checker.mapping: "),
    (
        "place",
        "Checker(mapping: Uv, place: [RotateX(1)])",
        "textures.t.Checker.place: a surface's own coordinates",
    ),
    (
        "flat",
        "Checker(place: [Scale((1, 0, 1))])",
        "textures.t.Checker.place[0].Scale: a factor must not be 0",
    ),
    ("no-file", "Image()", "textures.t.Image: needs a file"),
    ("gone", "Image(file: \"gone.png\")", "textures.t.Image.file: \"gone.png\": "),
    (
        "stops",
        "Image(file: \"a.png\", colors: [(1, 1, 1)])",
        "textures.t.Image.colors: Image has no such field",
    ),
    ("globe", "Image(made: Globe(width: 3))", "textures.t.Image.made.Globe.width: must be even"),
];

/// A scene with a texture "t" in the second line, on a ball.
fn scene(texture: &str) -> String {
    format!(
        "({CAMERA}, ambient: (1, 1, 1), textures: {{\n\"t\": {texture}}},
          materials: {{\"m\": (color: \"t\")}}, objects: [(material: \"m\", solid: {BALL})])"
    )
}

#[test]
fn bad_textures_are_told_by_line_and_field() {
    let mut wrong = Vec::new();
    for (name, texture, part) in BAD {
        let message = refusal(&[&file(&format!("texture-{name}.ron"), &scene(texture))], 1);
        if !(message.contains(part) && message.contains(".ron:")) {
            wrong.push(format!("{name}: {part} is not in {message}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// What a material says, and a part of the message.
const BAD_MATERIALS: &[(&str, &str)] = &[
    ("diffuse: \"oak\"", "materials.m.diffuse.texture: there is no texture \"oak\""),
    ("diffuse: (texture: \"t\", form: 1)", ":3:25: materials.m.diffuse.form: "),
    ("specular: (texture: \"t\", from: -1)", "materials.m.specular.from: must be at least 0"),
    ("reflect: (texture: \"t\", to: inf)", "materials.m.reflect.to: is not a finite number"),
    ("relief: (texture: \"t\")", "depth"),
    ("relief: (texture: \"oak\", depth: 1)", "materials.m.relief.texture: there is no texture"),
    ("relief: (texture: \"t\", depth: NaN)", "materials.m.relief.depth: must be between"),
    ("relief: [(texture: \"t\", depth: 1, step: 0)]", "materials.m.relief[0].step: must be finite"),
    ("color: \"oak\"", "materials.m.color: there is no texture"),
];

#[test]
fn bad_channels_are_told_by_line_and_field() {
    let mut wrong = Vec::new();
    for (n, (material, part)) in BAD_MATERIALS.iter().enumerate() {
        let text = format!(
            "({CAMERA}, textures: {{\"t\": Noise()}},\nmaterials: {{\"m\": (\n{material})}},
              objects: [(material: \"m\", solid: {BALL})])"
        );
        let message = refusal(&[&file(&format!("channel-{n}.ron"), &text)], 1);
        if !(message.contains(part) && message.contains(".ron:")) {
            wrong.push(format!("{part} is not in {message}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_pattern_has_defaults_that_make_a_picture() {
    let mut seen = std::collections::BTreeSet::new();
    for pattern in PATTERNS {
        let field = if *pattern == "Image" { "made: Globe(width: 64)" } else { "" };
        let name = format!("default-{pattern}.ron");
        let text = scene(&format!("{pattern}({field})"));
        let digest = output(&[&file(&name, &text), "--size", "24x18", "--digest"]);
        assert!(seen.insert(digest), "{pattern} looks like another");
    }
    // Fbm is noise of more octaves.
    let digest =
        |texture: &str| output(&[&file("fbm.ron", &scene(texture)), "--size", "24x18", "--digest"]);
    assert_eq!(digest("Fbm()"), digest("Noise(octaves: 6)"));
}

#[test]
fn json_says_the_same() {
    let ron = "(camera: (eye: (0, 0, 5), look_at: (0, 0, 0)), ambient: (1, 1, 1), textures: {
        \"a\": Spots(stops: [(0, (1, 0, 0)), (0.5, \"b\")], size: 0.3, blend: Smooth, space: Shape),
        \"b\": Brick(mapping: Toroidal(major: 0.5), wrap: Mirror, place: [RotateX(20)])},
        materials: {\"m\": (color: \"a\", ambient: (texture: \"b\", from: 0.2, to: 0.9), diffuse: \"b\",
            relief: (texture: \"a\", depth: 0.1))},
        objects: [(material: \"m\", solid: Sphere(center: (0, 0, 0), radius: 1))])";
    let json = r#"{"camera": {"eye": [0, 0, 5], "look_at": [0, 0, 0]}, "ambient": [1, 1, 1], "textures": {
        "a": {"Spots": {"stops": [[0, [1, 0, 0]], [0.5, "b"]], "size": 0.3, "blend": "Smooth", "space": "Shape"}},
        "b": {"Brick": {"mapping": {"Toroidal": {"major": 0.5}}, "wrap": "Mirror", "place": [{"RotateX": 20}]}}},
        "materials": {"m": {"color": "a", "ambient": {"texture": "b", "from": 0.2, "to": 0.9}, "diffuse": "b",
            "relief": {"texture": "a", "depth": 0.1}}},
        "objects": [{"material": "m", "solid": {"Sphere": {"center": [0, 0, 0], "radius": 1}}}]}"#;
    let digest = |file: &str| output(&[file, "--size", "40x30", "--digest"]);
    assert_eq!(digest(&file("same.ron", ron)), digest(&file("same.json", json)));
    let wrong = json.replace("\"Smooth\"", "\"Soft\"");
    let message = refusal(&[&file("wrong.json", &wrong)], 1);
    assert!(
        message.contains("wrong.json:2:") && message.contains("textures.a.Spots.blend"),
        "{message}"
    );
    let wrong = json.replace("\"Brick\"", "\"Bricks\"");
    let message = refusal(&[&file("wrong.json", &wrong)], 1);
    assert!(message.contains("wrong.json:3:") && message.contains("Bricks"), "{message}");
}

/// Writes a small image beside the scene files.
fn picture(name: &str, format: image::ImageFormat) {
    let mut picture = image::RgbImage::new(5, 3);
    for (x, y, pixel) in picture.enumerate_pixels_mut() {
        *pixel = image::Rgb([x as u8 * 60, y as u8 * 100, 200]);
    }
    picture.save_with_format(path(name), format).unwrap();
}

#[test]
fn images_are_read_from_the_folder_of_the_scene() {
    picture("small.png", image::ImageFormat::Png);
    let digest = |name: &str, fields: &str| {
        let text = scene(&format!("Image(file: \"small.png\", mapping: Uv{fields})"));
        output(&[&file(name, &text), "--size", "24x18", "--digest"])
    };
    let plain = digest("image.ron", "");
    picture("small.jpg", image::ImageFormat::Jpeg);
    let text = scene("Image(file: \"small.jpg\", mapping: Uv)");
    assert_ne!(output(&[&file("jpeg.ron", &text), "--size", "24x18", "--digest"]), plain);
    for (n, fields) in [
        ", filter: Nearest",
        ", format: Grey8",
        ", format: Rgb565",
        ", format: Mono1",
        ", transfer: Linear",
        ", size: 0.5",
    ]
    .iter()
    .enumerate()
    {
        assert_ne!(digest(&format!("image-{n}.ron"), fields), plain, "{fields}");
    }
    fs::write(path("broken.png"), fs::read(path("small.png")).unwrap().get(..40).unwrap()).unwrap();
    fs::write(path("text.png"), "not an image").unwrap();
    for name in ["broken.png", "text.png"] {
        let text = scene(&format!("Image(file: \"{name}\")"));
        let message = refusal(&[&file("image-bad.ron", &text)], 1);
        let part = format!(":2:18: textures.t.Image.file: \"{name}\": ");
        assert!(message.contains(&part), "{message}");
    }
    // Wider than the core can address, though it has few pixels.
    image::GrayImage::new(65_536, 1).save(path("wide.png")).unwrap();
    let message = refusal(&[&file("wide.ron", &scene("Image(file: \"wide.png\")"))], 1);
    assert!(message.contains("65536 by 1 pixels is too large"), "{message}");
}
