//! Calls of the command `render`, and the scene files that tests give it.

#![allow(clippy::expect_used, clippy::unwrap_used, reason = "tests may panic")]

use std::ffi::OsString;
use std::fs;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU32, Ordering};

use nostray_harness::render_command;

/// Exit code, stdout and stderr of a call. A picture that is not asked for goes to a file of its own.
pub(crate) fn call(args: &[&str]) -> (u8, String, String) {
    static CALLS: AtomicU32 = AtomicU32::new(0);
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let picture = path(&format!("{}.ppm", CALLS.fetch_add(1, Ordering::Relaxed)));
    let aside = if args.contains(&"--digest") && !args.contains(&"-o") {
        vec!["-o".into(), picture.clone().into_os_string()]
    } else {
        vec![]
    };
    let args = std::iter::once("render").chain(args.iter().copied()).map(OsString::from);
    let args = args.chain(aside);
    let code = render_command(args, &mut out, &mut err);
    (code, String::from_utf8(out).unwrap(), String::from_utf8(err).unwrap())
}

/// The output of a call that must succeed.
pub(crate) fn output(args: &[&str]) -> String {
    let (code, out, err) = call(args);
    assert_eq!((code, err.as_str()), (0, ""), "{args:?}");
    out
}

/// The message of a call that must fail with this code, in one line, without output.
pub(crate) fn refusal(args: &[&str], code: u8) -> String {
    let (found, out, err) = call(args);
    assert_eq!((found, out.as_str()), (code, ""), "{args:?}: {err}");
    let message = err.strip_prefix("error: ").expect("an error").strip_suffix('\n').unwrap();
    assert!(!message.contains('\n') && !message.is_empty(), "one line: {err:?}");
    message.to_owned()
}

/// A file in a folder of this test.
pub(crate) fn path(name: &str) -> PathBuf {
    let thread = std::thread::current();
    let test = thread.name().unwrap_or("test").replace("::", "-");
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(test);
    fs::create_dir_all(&folder).unwrap();
    folder.join(name)
}

/// The path of a new scene file.
pub(crate) fn file(name: &str, text: &str) -> String {
    let path = path(name);
    fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

pub(crate) const CAMERA: &str = "camera: (eye: (0, 1, -5), look_at: (0, 0, 0))";
pub(crate) const RED: &str = r#"materials: {"red": (color: (0.9, 0.1, 0.1), reflect: 0.3)}"#;

/// A scene of one solid, in which it stands on the second line.
pub(crate) fn scene_of(solid: &str) -> String {
    format!("({CAMERA}, {RED}, objects: [(material: \"red\", solid:\n{solid})])")
}

pub(crate) const BALL: &str = "Sphere(center: (0, 0, 0), radius: 1)";
