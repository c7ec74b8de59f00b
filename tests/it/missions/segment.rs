//! `rheotaxis segment` on pictures of all kinds, and on what is none.

use crate::common::{rheotaxis, rheotaxis_in};
use std::path::Path;

/// A binary PGM (grey) or PPM (coloured) file.
fn pnm(path: &Path, kind: &str, w: usize, h: usize, bytes: &[u8]) {
    let head = format!("{kind}\n{w} {h}\n255\n");
    std::fs::write(path, [head.as_bytes(), bytes].concat()).unwrap();
}

/// Light water with dye and a dark body in it.
fn scene() -> Vec<u8> {
    let colour = |x: usize, y: usize| match (x, y) {
        (30..60, 20..30) => [230, 90, 100],
        (15..30, 20..40) => [20, 25, 60],
        _ => [110, 170, 175],
    };
    (0..60).flat_map(|y| (0..80).flat_map(move |x| colour(x, y))).collect()
}

fn numbers(folder: &Path) -> serde_json::Value {
    let text = std::fs::read_to_string(folder.join("segmentation.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

#[test]
fn a_picture_leaves_all_its_parts() {
    let dir = tempfile::tempdir().unwrap();
    pnm(&dir.path().join("scene.ppm"), "P6", 80, 60, &scene());
    let out = rheotaxis_in(dir.path(), &["segment", "scene.ppm", "--dehaze", "--give-back"]);
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    let said = String::from_utf8_lossy(&out.stdout).into_owned();
    assert!(said.contains("a source giving off dye"), "{said}");
    let folder = dir.path().join("runs/scene-segmented");
    for name in [
        "pass-1.png",
        "plume.png",
        "plume-kept.png",
        "plume-mask.png",
        "source.png",
        "source-kept.png",
        "source-mask.png",
        "left.png",
        "overlay.png",
        "clusters.svg",
        "clusters.png",
        "sheet.png",
    ] {
        assert!(folder.join(name).is_file(), "{name}");
    }
    let n = numbers(&folder);
    assert_eq!(n["sighting"]["verified"], true);
    assert_eq!(n["sighting"]["source"]["low_px"], serde_json::json!([15, 20]));
    assert_eq!(n["parameters"]["colours"]["epsilon"], 80.0);
}

/// The paper's passes alone: red takes the body and the water after the dye.
#[test]
fn the_papers_passes_are_the_default() {
    let dir = tempfile::tempdir().unwrap();
    pnm(&dir.path().join("scene.ppm"), "P6", 80, 60, &scene());
    let out = rheotaxis_in(dir.path(), &["segment", "scene.ppm", "--out", "parts"]);
    assert!(out.status.success());
    let n = numbers(&dir.path().join("parts"));
    let passes = n["sighting"]["passes"].as_array().unwrap().clone();
    let patterns: Vec<_> = passes.iter().map(|p| p["pattern"]["rgb"].clone()).collect();
    assert_eq!(patterns, [[230, 90, 100], [20, 25, 60], [110, 170, 175]].map(|c| serde_json::json!(c)));
}

#[test]
fn one_grey_pixel_is_enough() {
    let dir = tempfile::tempdir().unwrap();
    pnm(&dir.path().join("dot.pgm"), "P5", 1, 1, &[77]);
    let out = rheotaxis_in(dir.path(), &["segment", "dot.pgm", "--out", "parts"]);
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    let n = numbers(&dir.path().join("parts"));
    assert_eq!((n["width"].as_u64(), n["height"].as_u64()), (Some(1), Some(1)));
    assert_eq!(n["sighting"]["verified"], false);
    assert_eq!(n["sighting"]["passes"][0]["pattern"]["rgb"], serde_json::json!([77, 77, 77]));
}

/// One pixel of 8-bit grey with alpha: fully transparent, so white, so nothing.
#[test]
fn what_is_transparent_is_not_there() {
    let dir = tempfile::tempdir().unwrap();
    let png: &[u8] = &[
        137, 80, 78, 71, 13, 10, 26, 10, 0, 0, 0, 13, 73, 72, 68, 82, 0, 0, 0, 1, 0, 0, 0, 1, 8, 4, 0, 0, 0, 181, 28,
        12, 2, 0, 0, 0, 11, 73, 68, 65, 84, 120, 218, 99, 96, 96, 0, 0, 0, 3, 0, 1, 43, 9, 77, 132, 0, 0, 0, 0, 73, 69,
        78, 68, 174, 66, 96, 130,
    ];
    std::fs::write(dir.path().join("clear.png"), png).unwrap();
    let out = rheotaxis_in(dir.path(), &["segment", "clear.png", "--out", "parts"]);
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    let n = numbers(&dir.path().join("parts"));
    assert_eq!(n["sighting"]["passes"].as_array().map(Vec::len), Some(0));
}

#[test]
fn what_is_no_whole_picture_is_refused_with_exit_code_1() {
    let dir = tempfile::tempdir().unwrap();
    pnm(&dir.path().join("cut.ppm"), "P6", 80, 60, &scene()[..5000]);
    std::fs::write(dir.path().join("text.png"), "no picture").unwrap();
    std::fs::write(dir.path().join("empty.jpg"), "").unwrap();
    std::fs::write(dir.path().join("huge.ppm"), "P6\n60000 60000\n255\n").unwrap();
    for (file, says) in [
        ("cut.ppm", "broken PNM"),
        ("text.png", "not a picture"),
        ("empty.jpg", "not a picture"),
        ("huge.ppm", "too large: 60000 x 60000"),
        ("nowhere.png", "cannot read"),
    ] {
        let out = rheotaxis_in(dir.path(), &["segment", file]);
        let said = String::from_utf8_lossy(&out.stderr).into_owned();
        assert_eq!(out.status.code(), Some(1), "{file}: {said}");
        assert!(said.contains(says) && said.contains(file), "{file}: {said}");
        assert!(!dir.path().join("runs").exists(), "{file} left something");
    }
}

#[test]
fn wrong_parameters_name_their_flag() {
    for (args, says, code) in [
        (["--alpha1", "nan"], "--alpha1", 2),
        (["--alpha1", "200"], "--alpha1 must be below alpha2 (200)", 1),
        (["--plume-passes", "300"], "--plume-passes", 2),
    ] {
        let out = rheotaxis(&["segment", "any.png", args[0], args[1]]);
        let said = String::from_utf8_lossy(&out.stderr).into_owned();
        assert_eq!(out.status.code(), Some(code), "{said}");
        assert!(said.contains(says), "{said}");
    }
}
