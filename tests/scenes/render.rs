//! The command `render`: what it writes and what it prints.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    reason = "a test may fail loudly"
)]

use std::fs;

use crate::command::{BALL, CAMERA, RED, call, file, output, path, refusal, scene_of};
use nostray_harness::gallery::GALLERY;

/// A scene with something in it for all that the command counts.
fn lit() -> String {
    format!(
        "({CAMERA}, {RED}, ambient: (0.1, 0.1, 0.1), background: (bottom: (1, 1, 1), top: (0, 0, 2)),
          lights: [Point(at: (3, 5, -4), color: (1, 1, 1))],
          objects: [(solid: {BALL}, material: \"red\"),
                    (solid: Plane(normal: (0, 1, 0), offset: -1), material: \"red\")])"
    )
}

#[test]
fn any_threads_and_rows_give_the_same_bits() {
    let scene = file("bits.ron", &lit());
    for scalar in ["f32", "f64"] {
        let common = [&scene, "--size", "41x23", "--scalar", scalar];
        let with = |more: &[&str]| output(&[&common[..], more].concat());
        let whole = with(&["--digest", "--threads", "1"]);
        assert_eq!(whole.len(), 2 * 64 + 2);
        for threads in ["2", "3", "40"] {
            assert_eq!(with(&["--digest", "--threads", threads]), whole);
        }
        let all = path(&format!("whole-{scalar}.pfm"));
        with(&["-o", all.to_str().unwrap()]);
        let all = fs::read(all).unwrap();
        // Rows of a .pfm go upwards, so the last part comes first.
        let mut joined = b"PF\n41 23\n-1.0\n".to_vec();
        for rows in ["17..23", "2..17", "1..2", "0..1"] {
            let part = path(&format!("part-{scalar}-{rows}.pfm"));
            with(&["--rows", rows, "--threads", "2", "-o", part.to_str().unwrap()]);
            let part = fs::read(part).unwrap();
            let header =
                part.iter().enumerate().filter(|(_, byte)| **byte == b'\n').nth(2).unwrap();
            joined.extend_from_slice(&part[header.0 + 1..]);
        }
        assert!(joined == all, "{scalar}: rows differ from those of the whole picture");
    }
}

#[test]
fn formats_hold_the_same_picture() {
    let scene = file("formats.ron", &lit());
    let of = |name: &str, more: &[&str]| {
        let path = path(name);
        let common = [&scene, "--size", "13x7", "-o", path.to_str().unwrap()];
        assert_eq!(output(&[&common[..], more].concat()), "");
        fs::read(path).unwrap()
    };
    let ppm = of("picture.ppm", &[]);
    let bytes = ppm.strip_prefix(b"P6\n13 7\n255\n").expect("the header of a pixmap");
    assert_eq!(bytes.len(), 13 * 7 * 3);
    let png = image::load_from_memory(&of("picture.png", &[])).unwrap().into_rgb8();
    assert_eq!((png.dimensions(), png.as_raw().as_slice()), ((13, 7), bytes));

    let pfm = of("picture.pfm", &[]);
    let light = pfm.strip_prefix(b"PF\n13 7\n-1.0\n").expect("the header of a float map");
    let linear = of("linear.ppm", &["--transfer", "linear"]);
    let linear = linear.strip_prefix(b"P6\n13 7\n255\n").unwrap();
    let (parts, _) = light.as_chunks::<4>();
    assert_eq!(parts.len(), linear.len());
    for (y, row) in parts.chunks(13 * 3).rev().enumerate() {
        for (x, part) in row.iter().enumerate() {
            let light = nostray::Number::clamp(f32::from_le_bytes(*part), 0.0, 1.0);
            let expected = f64::from(light) * 255.0;
            let byte = f64::from(linear[y * 13 * 3 + x]);
            assert!((byte - expected).abs() <= 0.500_001, "{byte} for {expected} at {x}, {y}");
        }
    }
    assert!(linear != bytes, "the curve must make a difference");
}

#[test]
fn digest_is_of_the_bytes_and_of_the_bits() {
    use sha2::{Digest, Sha256};
    let scene = file("digest.ron", &lit());
    let (ppm, pfm) = (path("digest.ppm"), path("digest.pfm"));
    let printed = output(&[&scene, "--size", "9x1", "--digest", "-o", ppm.to_str().unwrap()]);
    output(&[&scene, "--size", "9x1", "-o", pfm.to_str().unwrap()]);
    let hex = |bytes: &[u8]| -> String {
        Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
    };
    // Of a picture of one row the float map has the very bits in order.
    let (ppm, pfm) = (fs::read(ppm).unwrap(), fs::read(pfm).unwrap());
    let shown = ppm.strip_prefix(b"P6\n9 1\n255\n").unwrap();
    let light = pfm.strip_prefix(b"PF\n9 1\n-1.0\n").unwrap();
    assert_eq!(printed, format!("{} {}\n", hex(shown), hex(light)));
}

#[test]
fn stats_are_one_json_object() {
    let scene = file("stats.ron", &lit());
    let stats = |more: &[&str]| -> serde_json::Value {
        let printed =
            output(&[&[&*scene, "--size", "20x10", "--stats", "--digest"], more].concat());
        let (digest, stats) = printed.split_once('\n').unwrap();
        assert_eq!(digest.len(), 2 * 64 + 1);
        serde_json::from_str(stats).unwrap()
    };
    let number = |stats: &serde_json::Value, key: &str| {
        stats[key].as_f64().unwrap_or_else(|| panic!("{key} in {stats}"))
    };
    let all = stats(&[]);
    assert_eq!((number(&all, "pixels"), number(&all, "primary_rays")), (200.0, 200.0));
    assert!(number(&all, "reflected_rays") > 0.0 && number(&all, "shadow_rays") > 0.0, "{all}");
    assert_eq!((number(&all, "budget_cuts"), number(&all, "spent_max")), (0.0, 0.0));
    assert_eq!((all["scalar"].as_str(), all["scene"].as_str()), (Some("f32"), Some(&*scene)));
    // A budget that pays for every mirrored ray at once, and then a weight that none reaches.
    let paid = stats(&["--error-max", "64"]);
    assert_eq!(number(&paid, "reflected_rays"), 0.0);
    assert!(number(&paid, "budget_cuts") > 0.0, "{paid}");
    assert!(number(&paid, "spent_max") > 0.0 && number(&paid, "spent_max") <= 1.0, "{paid}");
    let light = stats(&["--weight-min", "0.5", "--threads", "3"]);
    assert_eq!(number(&light, "weight_cuts"), number(&paid, "budget_cuts"));
    // Local light alone.
    let flat = stats(&["--depth-max", "0", "--scalar", "f64"]);
    assert_eq!((number(&flat, "reflected_rays"), flat["scalar"].as_str()), (0.0, Some("f64")));
    assert!(number(&flat, "depth_cuts") > 0.0, "{flat}");
}

#[test]
fn json_is_the_same_scene() {
    let json = r#"{"camera": {"eye": [0, 1, -5], "look_at": [0, 0, 0]},
        "materials": {"red": {"color": [0.9, 0.1, 0.1], "reflect": 0.3}},
        "background": {"bottom": [0.1, 0.2, 0.3], "top": [0.3, 0.2, 0.1]},
        "lights": [{"Directional": {"toward": [0, -2, 1], "color": [1, 1, 1]}}],
        "objects": [{"material": "red", "place": [{"Scale": [1, 2, 1]}, {"RotateZ": 30}],
            "solid": {"Difference": [{"Sphere": {"center": [0, 0, 0], "radius": 1}},
                {"Box": {"min": [-2, 0, -2], "max": [0, 2, 2]}}]}}]}"#;
    let ron = format!(
        "({CAMERA}, {RED}, background: (bottom: (0.1, 0.2, 0.3), top: (0.3, 0.2, 0.1)),
          lights: [Directional(toward: (0, -2, 1), color: (1, 1, 1))],
          objects: [(material: \"red\", place: [Scale((1, 2, 1)), RotateZ(30)],
            solid: Difference([{BALL}, Box(min: (-2, 0, -2), max: (0, 2, 2))]))])"
    );
    let digest =
        |name: &str, text: &str| output(&[&file(name, text), "--size", "16x12", "--digest"]);
    let (json, ron) = (digest("same.json", json), digest("same.ron", &ron));
    assert_eq!(json, ron);
    assert_ne!(json, digest("other.ron", &scene_of(BALL)));
}

#[test]
fn placements_apply_from_the_inside_out() {
    let digest = |name: &str, solid: &str| {
        output(&[&file(name, &scene_of(solid)), "--size", "24x18", "--digest"])
    };
    let moved = "With(solid: Sphere(center: (0, 0, 0), radius: 0.5),
        place: [Translate((0.25, 0, 0)), Scale(2), Rotate(axis: (0, 3, 0), degrees: 90)])";
    let same = "With(solid: With(solid: Sphere(center: (0, 0, 0), radius: 0.5),
        place: [Translate((0.25, 0, 0))]), place: [Scale(2), RotateY(90)])";
    // (0.25, 0, 0) doubled is (0.5, 0, 0), and a quarter turn about y takes +x to −z.
    let plain = "Sphere(center: (0, 0, -0.5), radius: 1)";
    assert_eq!(digest("moved.ron", moved), digest("plain.ron", plain));
    assert_eq!(digest("same-moves.ron", same), digest("plain.ron", plain));
}

#[test]
fn nff_is_read_with_its_own_size() {
    let text = "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 40\nhither 1\nresolution 12 9\n\
                b 0.1 0.2 0.3\nl 3 4 5\nf 1 0 0 0.7 0.3 20 0 0\ns 0 0 0 1\n";
    let ppm = path("ball.ppm");
    output(&[&file("ball.nff", text), "-o", ppm.to_str().unwrap()]);
    assert!(fs::read(&ppm).unwrap().starts_with(b"P6\n12 9\n"));
    output(&[&file("ball.nff", text), "-o", ppm.to_str().unwrap(), "--size", "5x4"]);
    assert!(fs::read(&ppm).unwrap().starts_with(b"P6\n5 4\n"));

    let degenerate = format!("{text}c 0 0 0 1 0 0 0 1\n");
    let (code, _, err) = call(&[&file("note.nff", &degenerate), "--digest"]);
    assert_eq!((code, err.lines().count()), (0, 1), "{err}");
    assert!(err.starts_with("note: ") && err.contains("note.nff: 1 objects"), "{err}");

    let message = refusal(&[&file("bad.nff", &text.replace("s 0", "s x"))], 1);
    assert!(message.contains("bad.nff:11: "), "{message}");
}

#[test]
fn lists_are_written_with_either_bracket() {
    let scene = |colors: &str| {
        format!(
            "({CAMERA}, ambient: (1, 1, 1), textures: {{\"t\": Checker(colors: {colors})}},
              materials: {{\"m\": (color: \"t\")}}, objects: [(material: \"m\", solid: {BALL})])"
        )
    };
    let digest = |name: &str, colors: &str| {
        output(&[&file(name, &scene(colors)), "--size", "16x12", "--digest"])
    };
    let round = digest("round.ron", "((1, 0, 0), (0, 0, 1))");
    assert_eq!(digest("square.ron", "[[1, 0, 0], [0, 0, 1]]"), round);
    for short in ["((1, 0, 0))", "[]", "[(1, 0), (0, 0, 1)]", "[(1, 0, 0, 0), (0, 0, 1)]"] {
        let message = refusal(&[&file("short.ron", &scene(short))], 1);
        assert!(message.contains("short.ron:1:"), "{message}");
    }
}

#[test]
fn marks_before_the_text_and_capital_endings_are_taken() {
    let plain = scene_of(BALL);
    let digest = |path: &str| output(&[path, "--size", "16x12", "--digest"]);
    let expected = digest(&file("plain-text.ron", &plain));
    assert_eq!(digest(&file("mark.ron", &format!("\u{feff}{plain}"))), expected);
    assert_eq!(digest(&file("CAPITALS.RON", &plain)), expected);
    let picture = path("CAPITALS.PPM");
    output(&[&file("plain-text.ron", &plain), "--size", "4x3", "-o", picture.to_str().unwrap()]);
    assert!(fs::read(&picture).unwrap().starts_with(b"P6\n4 3\n"));
}

#[test]
fn textures_stand_in_any_order() {
    let scene = |textures: &str| {
        format!(
            "({CAMERA}, ambient: (1, 1, 1), textures: {{{textures}}},
              materials: {{\"m\": (color: \"outer\", diffuse: 0)}},
              objects: [(material: \"m\", solid: {BALL})])"
        )
    };
    let inner = "\"inner\": Checker(colors: ((1, 0, 0), (0, 1, 0)), size: 0.1)";
    let outer = "\"outer\": Checker(colors: (\"inner\", (0, 0, 1)), size: (0.5, 9, 9))";
    let digest =
        |name: &str, text: &str| output(&[&file(name, text), "--size", "32x24", "--digest"]);
    let forward = digest("forward.ron", &scene(&format!("{inner}, {outer}")));
    let backward = digest("backward.ron", &scene(&format!("{outer}, {inner}")));
    assert_eq!(forward, backward);

    let ring = inner.replace("(0, 1, 0)", "\"outer\"");
    let message = refusal(&[&file("ring.ron", &scene(&format!("{ring}, {outer}")))], 1);
    assert!(message.contains("is made of itself"), "{message}");
}

#[test]
fn nothing_partial_is_left_behind() {
    let folder = path("left");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(folder.join("taken.png")).unwrap();
    let good = file("left.ron", &scene_of(BALL));
    let bad = file("left-bad.ron", &scene_of("Union([])"));
    let target = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    refusal(&[&bad, "-o", &target("bad.png")], 1);
    refusal(&[&good, "--size", "4x4", "-o", &target("taken.png")], 1);
    refusal(&[&good, "-o", &target("nowhere/picture.png")], 1);
    output(&[&good, "--size", "4x4", "-o", &target("good.png")]);
    let mut names: Vec<_> =
        fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["good.png", "taken.png"]);
}

#[test]
fn gallery_lists_and_renders() {
    let list = output(&["--list"]);
    assert_eq!(list.lines().count(), GALLERY.len());
    assert!(list.starts_with("showcase "), "{list}");
    for (line, entry) in list.lines().zip(GALLERY) {
        assert!(line.starts_with(entry.name) && line.ends_with(entry.description), "{line}");
        let digest = output(&[entry.name, "--size", "8x6", "--digest"]);
        let black = "e".repeat(64);
        assert_ne!(&digest[..64], black);
    }
    assert!(output(&["--help"]).contains("--rows"));
}
