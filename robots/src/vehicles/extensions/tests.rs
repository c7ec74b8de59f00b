//! uuv_simulator's form.

use super::{FossenBlocks, read, turned};
use nalgebra::{Matrix6, Vector3, Vector6};

/// As xacro leaves it; numbers are made up.
pub(super) const UUV: &str = r#"<?xml version="1.0" ?>
<robot name="fish" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <link name="fish/base_link"/>
  <gazebo>
    <plugin filename="libuuv_underwater_object_ros_plugin.so" name="uuv_plugin">
      <fluid_density>1025.0</fluid_density>
      <flow_velocity_topic>hydrodynamics/current_velocity</flow_velocity_topic>
      <debug>0</debug>
      <link name="fish/base_link">
        <neutrally_buoyant>0</neutrally_buoyant>
        <volume>0.031</volume>
        <box>
          <width>1.6</width>
          <length>0.2</length>
          <height>0.2</height>
        </box>
        <center_of_buoyancy>0.01 -0.02 0.03</center_of_buoyancy>
        <hydrodynamic_model>
          <type>fossen</type>
          <added_mass>
            1.0 0 0 0 0 0
            0 30 0 0 0 -2
            0 0 31 0 1.5 0
            0 0 0 0.1 0 0
            0 0 1.5 0 4 0
            0 -2 0 0 0 5 <!-- N_r -->
          </added_mass>
          <linear_damping>-1 -2 -3 -4 -5 -6</linear_damping>
          <linear_damping_forward_speed>
            -0.5 0 0 0 0 0
            0 -7 0 0 0 8
            0 0 0 0 0 0
            0 0 0 0 0 0
            0 0 0 0 0 0
            0 9 0 0 0 -10
          </linear_damping_forward_speed>
          <quadratic_damping>-11 -12 -13 -14 -15 -16</quadratic_damping>
        </hydrodynamic_model>
      </link>
    </plugin>
  </gazebo>
</robot>
"#;

/// The blocks of a text.
pub(super) fn blocks(text: &str) -> FossenBlocks {
    read(text).expect("right").expect("an extension")
}

/// The text with something replaced that must be in it once.
pub(super) fn with(text: &str, from: &str, to: &str) -> String {
    assert_eq!(text.matches(from).count(), 1, "{from}");
    text.replace(from, to)
}

/// The doubts when something is replaced.
pub(super) fn doubts(text: &str, from: &str, to: &str) -> Vec<String> {
    blocks(&with(text, from, to)).doubts
}

#[test]
fn all_of_a_block_is_read() {
    let b = blocks(UUV);
    assert_eq!(b.source, "uuv_simulator");
    assert_eq!(b.link, "fish/base_link");
    assert_eq!(b.density_kg_m3, Some(1025.0));
    assert_eq!(b.volume_m3, Some(0.031));
    assert!(!b.neutral);
    // Already forward, left, up.
    let middle = Vector3::new(0.01, -0.02, 0.03);
    assert_eq!(b.centre_of_buoyancy_m, Some(middle));
    assert_eq!(b.doubts, Vec::<String>::new());
}

/// The force in uuv_simulator's axes, turned, is the force of the turned blocks.
#[test]
fn turned_blocks_give_the_turned_force() {
    let m = Matrix6::from_fn(|i, j| ((7 * i + 3 * j) % 11) as f64 - 5.0);
    let flip = |v: Vector6<f64>| v.component_mul(&Vector6::new(1.0, -1.0, -1.0, 1.0, -1.0, -1.0));
    let nu = Vector6::new(1.0, -0.3, 0.2, 0.05, -0.1, 0.4);
    let error = flip(m * flip(nu)) - turned(&m) * nu;
    assert!(error.norm() < 1e-12, "{error}");
    assert_eq!(turned(&turned(&m)), m);
}

#[test]
fn what_is_missing_is_zero_and_told() {
    let start = UUV.find("<added_mass>").expect("there");
    let end = UUV.find("</hydrodynamic_model>").expect("there");
    let b = blocks(&format!("{}{}", &UUV[..start], &UUV[end..]));
    assert_eq!((b.added_mass, b.forward), (Matrix6::zeros(), Matrix6::zeros()));
    let missing = ["added_mass", "linear_damping", "quadratic_damping"];
    assert_eq!(b.doubts, missing.map(|m| format!("line 18, <hydrodynamic_model>: has no <{m}>: taken as zero")));
    let bare = with(UUV, "      <fluid_density>1025.0</fluid_density>\n", "");
    assert_eq!(blocks(&bare).density_kg_m3, None);
}

/// Odd numbers are read as they stand; what uuv_simulator does not read is ignored.
#[test]
fn what_is_odd_or_ignored_is_told() {
    let mut full = [0.0; 36];
    (full[0], full[5]) = (-3.0, 4.0);
    let full = row(&full);
    for (from, to, told) in [
        ("-1 -2 -3 -4 -5 -6", "1 -2 3 -4 -5 -6", "28, <linear_damping>: is positive in X_u = 1, Z_w = 3: read as"),
        ("0 30 0 0 0 -2", "0 -30 0 0 0 -2", "20, <added_mass>: is negative in Y_v = -30: read as it stands"),
        ("0 -2 0 0 0 5", "0 -3 0 0 0 5", "20, <added_mass>: is not symmetric in Y_r = -2, N_v = -3: read as it stands"),
        ("-11 -12 -13 -14 -15 -16", &full, "37, <quadratic_damping>: X_r = 4 off the diagonal: ignored"),
        (
            "<neutrally_buoyant>0",
            "<neutrally_buoyant>true",
            "11, <volume>: ignored, because <neutrally_buoyant> is true",
        ),
        ("<debug>0</debug>", "<depth>0</depth>", "8, <depth>: ignored: uuv_simulator has no such element"),
        ("<debug>0</debug>", "<link name=\"arm\"><volume>1</volume></link>", "8, <link>: ignored: it has no"),
        ("<box>", "<bounding_box>1 1 1</bounding_box><box>", "12, <bounding_box>: ignored"),
        ("<box>", "<metacentric_width>0.3</metacentric_width><box>", "12, <metacentric_width>: ignored"),
        ("<box>", "<offset_volume>0.3</offset_volume><box>", "12, <offset_volume>: ignored, as in uuv_simulator"),
    ] {
        let doubts = blocks(&with(UUV, from, to)).doubts.join("\n");
        assert!(doubts.starts_with(&format!("line {told}")) && doubts.lines().count() == 1, "{doubts}");
    }
    // As rounded in a table.
    assert_eq!(doubts(UUV, "0 -2 0 0 0 5", "0 -2.001 0 0 0 5"), [""; 0]);
    let odd = blocks(&with(UUV, "-1 -2 -3 -4 -5 -6", "1 -2 3 -4 -5 -6"));
    assert_eq!((odd.linear[(0, 0)], odd.linear[(1, 1)]), (-1.0, 2.0));
    let light = blocks(&with(UUV, "0 30 0 0 0 -2", "0 -30 0 0 0 -2"));
    assert_eq!(light.added_mass[(1, 1)], -30.0);
    let off = blocks(&with(UUV, "-11 -12 -13 -14 -15 -16", &full));
    assert_eq!((off.quadratic[(0, 0)], off.quadratic[(0, 5)]), (3.0, 0.0));
    let neutral = blocks(&with(UUV, "<neutrally_buoyant>0", "<neutrally_buoyant>true"));
    assert_eq!((neutral.neutral, neutral.volume_m3), (true, None));
}

#[test]
fn six_numbers_are_a_diagonal() {
    let start = UUV.find("1.0 0 0 0").expect("there");
    let end = UUV.find("</added_mass>").expect("there");
    let b = blocks(&format!("{}1 2 3 4 5 6{}", &UUV[..start], &UUV[end..]));
    assert_eq!(b.added_mass, Matrix6::from_diagonal(&Vector6::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0)));
    assert_eq!(b.doubts, ["line 20, <added_mass>: 6 numbers are taken as the diagonal; uuv_simulator itself needs 36"]);
}

/// Numbers for an element.
pub(super) fn row(numbers: &[f64]) -> String {
    let words: Vec<String> = numbers.iter().map(f64::to_string).collect();
    words.join(" ")
}
