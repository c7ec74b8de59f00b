//! `rheotaxis segment` on pictures, and on what is none.

use crate::common::{rheotaxis, rheotaxis_in, says};
use serde_json::{Value, json};
use std::fs;

/// A binary PPM file of light water with dye and a dark body in it.
fn scene() -> Vec<u8> {
    let colour = |x: usize, y: usize| match (x, y) {
        (30..60, 20..30) => [230, 90, 100],
        (15..30, 20..40) => [20, 25, 60],
        _ => [110, 170, 175],
    };
    let pixels = (0..60).flat_map(|y| (0..80).flat_map(move |x| colour(x, y)));
    b"P6\n80 60\n255\n".iter().copied().chain(pixels).collect()
}

/// What is found in a file of these bytes, by these options, and what is said.
fn segmented(bytes: &[u8], options: &[&str]) -> (tempfile::TempDir, Value, String) {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("scene.ppm"), bytes).unwrap();
    let said = rheotaxis_in(dir.path(), &[&["segment", "scene.ppm"], options].concat()).with(0).out;
    let text = fs::read_to_string(dir.path().join("runs/scene-segmented/segmentation.json")).unwrap();
    (dir, serde_json::from_str(&text).unwrap(), said)
}

#[test]
fn a_picture_leaves_all_its_parts() {
    let (dir, n, said) = segmented(&scene(), &["--dehaze", "--give-back"]);
    says(&said, &["a source giving off dye"]);
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
        assert!(dir.path().join("runs/scene-segmented").join(name).is_file(), "{name}");
    }
    assert_eq!(n["sighting"]["verified"], true);
    assert_eq!(n["sighting"]["source"]["low_px"], json!([15, 20]));
    assert_eq!(n["parameters"]["colours"]["epsilon"], 80.0);
}

/// The paper's passes alone: red takes the body and the water after the dye.
#[test]
fn the_papers_passes_are_the_default() {
    let (_dir, n, _) = segmented(&scene(), &[]);
    let passes = n["sighting"]["passes"].as_array().unwrap();
    let patterns: Vec<_> = passes.iter().map(|p| p["pattern"]["rgb"].clone()).collect();
    assert_eq!(patterns, [[230, 90, 100], [20, 25, 60], [110, 170, 175]].map(|c| json!(c)));
}

#[test]
fn one_grey_pixel_is_enough() {
    let (_dir, n, _) = segmented(b"P5\n1 1\n255\n\x4d", &[]);
    assert_eq!((n["width"].as_u64(), n["height"].as_u64()), (Some(1), Some(1)));
    assert_eq!(n["sighting"]["verified"], false);
    assert_eq!(n["sighting"]["passes"][0]["pattern"]["rgb"], json!([77, 77, 77]));
}

#[test]
fn what_is_no_whole_picture_and_wrong_parameters_are_refused() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("cut.ppm"), &scene()[..5000]).unwrap();
    says(&rheotaxis_in(dir.path(), &["segment", "cut.ppm"]).with(1).err, &["cut.ppm", "broken PNM"]);
    assert!(!dir.path().join("runs").exists(), "it left something");
    for (flag, value, part, code) in [
        ("--alpha1", "nan", "--alpha1", 2),
        ("--alpha1", "200", "(200)", 1),
        ("--plume-passes", "300", "--plume-passes", 2),
    ] {
        says(&rheotaxis(&["segment", "any.png", flag, value]).with(code).err, &[flag, part]);
    }
}
