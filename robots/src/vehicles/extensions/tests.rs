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
    assert_eq!(b.added_mass, Matrix6::zeros());
    assert_eq!(b.forward, Matrix6::zeros());
    assert_eq!(
        b.doubts,
        [
            "line 18, <hydrodynamic_model>: has no <added_mass>: taken as zero",
            "line 18, <hydrodynamic_model>: has no <linear_damping>: taken as zero",
            "line 18, <hydrodynamic_model>: has no <quadratic_damping>: taken as zero",
        ]
    );
    let bare = with(UUV, "      <fluid_density>1025.0</fluid_density>\n", "");
    assert_eq!(blocks(&bare).density_kg_m3, None);
}

#[test]
fn a_neutral_body_says_no_volume() {
    let told = "<neutrally_buoyant>0";
    let b = blocks(&with(UUV, told, "<neutrally_buoyant>true"));
    assert!(b.neutral);
    assert_eq!(b.volume_m3, None);
    assert_eq!(b.doubts, ["line 11, <volume>: ignored, because <neutrally_buoyant> is true"]);
}

#[test]
fn odd_signs_are_told_and_read_as_there() {
    let text = with(UUV, "-1 -2 -3 -4 -5 -6", "1 -2 3 -4 -5 -6");
    let b = blocks(&text);
    assert_eq!((b.linear[(0, 0)], b.linear[(1, 1)]), (-1.0, 2.0));
    assert_eq!(
        b.doubts,
        ["line 28, <linear_damping>: is positive in X_u = 1, Z_w = 3: read as uuv_simulator does, so it drives the \
             body on; what resists is negative"]
    );
    let b = blocks(&with(UUV, "0 30 0 0 0 -2", "0 -30 0 0 0 -2"));
    assert_eq!(b.added_mass[(1, 1)], -30.0);
    assert_eq!(b.doubts, ["line 20, <added_mass>: is negative in Y_v = -30: read as it stands, so it takes mass away"]);
}

#[test]
fn odd_matrices_are_told() {
    assert_eq!(
        doubts(UUV, "0 -2 0 0 0 5", "0 -3 0 0 0 5"),
        ["line 20, <added_mass>: is not symmetric in Y_r = -2, N_v = -3: read as it stands"]
    );
    // As rounded in a table.
    assert_eq!(doubts(UUV, "0 -2 0 0 0 5", "0 -2.001 0 0 0 5"), Vec::<String>::new());
    let start = UUV.find("1.0 0 0 0").expect("there");
    let end = UUV.find("</added_mass>").expect("there");
    let b = blocks(&format!("{}1 2 3 4 5 6{}", &UUV[..start], &UUV[end..]));
    assert_eq!(b.added_mass[(5, 5)], 6.0);
    assert_eq!(b.doubts, ["line 20, <added_mass>: 6 numbers are taken as the diagonal; uuv_simulator itself needs 36"]);
    let mut full = [0.0; 36];
    (full[0], full[5]) = (-3.0, 4.0);
    let b = blocks(&with(UUV, "-11 -12 -13 -14 -15 -16", &row(&full)));
    assert_eq!(b.quadratic[(0, 0)], 3.0);
    assert_eq!(b.quadratic[(0, 5)], 0.0);
    assert_eq!(b.doubts, ["line 37, <quadratic_damping>: X_r = 4 off the diagonal: ignored, as in uuv_simulator"]);
}

#[test]
fn what_is_ignored_is_told() {
    let box_end = "        </box>\n";
    for (more, why) in [
        ("<bounding_box>1 1 1</bounding_box>", "<bounding_box>: ignored: uuv_simulator has no such element"),
        (
            "<metacentric_width>0.3</metacentric_width>",
            "<metacentric_width>: ignored: the body is taken as under water; `floats: true` takes it as a craft on the \
             surface",
        ),
        (
            "<offset_volume>0.3</offset_volume>",
            "<offset_volume>: ignored, as in uuv_simulator, where only a service can set it while it runs",
        ),
    ] {
        let told = doubts(UUV, box_end, &format!("{box_end}{more}"));
        assert_eq!(told, [format!("line 17, {why}")]);
    }
    assert_eq!(
        doubts(UUV, "<debug>0</debug>", "<depth>0</depth>"),
        ["line 8, <depth>: ignored: uuv_simulator has no such element"]
    );
    let arm = r#"<debug>0</debug><link name="arm"><volume>1</volume></link>"#;
    assert_eq!(doubts(UUV, "<debug>0</debug>", arm), ["line 8, <link>: ignored: it has no <hydrodynamic_model>"]);
}

/// Numbers for an element.
pub(super) fn row(numbers: &[f64]) -> String {
    let words: Vec<String> = numbers.iter().map(f64::to_string).collect();
    words.join(" ")
}
