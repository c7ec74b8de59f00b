//! gz-sim's form.

use super::read;
use super::tests::{blocks, doubts, with};
use nalgebra::{Matrix6, Vector6};
use std::fmt::Write;

/// Numbers are made up.
pub(super) const GZ: &str = r#"<robot name="fish">
  <link name="base_link"/>
  <gazebo>
    <plugin
        filename="gz-sim-hydrodynamics-system"
        name="gz::sim::systems::Hydrodynamics">
      <link_name>base_link</link_name>
      <water_density>1025</water_density>
      <xDotU>-1</xDotU>
      <yDotV>-30</yDotV>
      <zDotW>-31</zDotW>
      <kDotP>0</kDotP>
      <mDotQ>-4</mDotQ>
      <nDotR>-5</nDotR>
      <yDotR>2</yDotR>
      <nDotV>2</nDotV>
      <xU>-1.5</xU>
      <nV>3</nV>
      <yR>-4</yR>
      <xUabsU>-11</xUabsU>
      <yRabsR>6</yRabsR>
      <yUV>-7</yUV>
      <nRU>-8</nRU>
    </plugin>
  </gazebo>
</robot>
"#;

const PLUGIN: &str = "<plugin\n        filename";

#[test]
fn all_of_a_block_is_read() {
    let b = blocks(GZ);
    assert_eq!(b.source, "gz-sim");
    assert_eq!(b.link, "base_link");
    assert_eq!(b.density_kg_m3, Some(1025.0));
    assert_eq!((b.volume_m3, b.neutral), (None, false));
    assert_eq!(b.centre_of_buoyancy_m, None);
    assert_eq!(b.doubts, Vec::<String>::new());
    let entries = |m: &Matrix6<f64>| m.iter().filter(|v| **v != 0.0).count();
    let mass = Vector6::new(1.0, 30.0, 31.0, 0.0, 4.0, 5.0);
    assert_eq!(b.added_mass.diagonal(), mass);
    // Axes stay.
    assert_eq!((b.added_mass[(1, 5)], b.added_mass[(5, 1)]), (-2.0, -2.0));
    assert_eq!(entries(&b.added_mass), 7);
    assert_eq!(b.linear[(0, 0)], 1.5);
    assert_eq!((b.linear[(5, 1)], b.linear[(1, 5)]), (-3.0, 4.0));
    assert_eq!(entries(&b.linear), 3);
    assert_eq!((b.quadratic[(0, 0)], b.quadratic[(1, 5)]), (11.0, -6.0));
    assert_eq!(entries(&b.quadratic), 2);
    // Either order of the two speeds.
    assert_eq!((b.forward[(1, 1)], b.forward[(5, 5)]), (7.0, 8.0));
    assert_eq!(entries(&b.forward), 2);
}

#[test]
fn older_file_names_are_known() {
    for name in [
        "libignition-gazebo6-hydrodynamics-system.so",
        "ignition-gazebo-hydrodynamics-system",
        "libgz-sim8-hydrodynamics-system.so",
    ] {
        let text = with(GZ, "gz-sim-hydrodynamics-system", name);
        assert_eq!(blocks(&text), blocks(GZ), "{name}");
    }
    // Another plugin with the same class name.
    let other = "ignition-marine1-hydrodynamics-system";
    let text = with(GZ, "gz-sim-hydrodynamics-system", other);
    assert_eq!(read(&text), Ok(None));
}

#[test]
fn positive_added_mass_is_of_former_versions() {
    let mut old = String::new();
    for line in GZ.lines() {
        let line = match line.contains("Dot") {
            true if line.contains(">-") => line.replace(">-", ">"),
            true => line.replace(">2", ">-2"),
            false => line.into(),
        };
        writeln!(old, "{line}").expect("memory");
    }
    let b = blocks(&old);
    assert_eq!(b.added_mass, blocks(GZ).added_mass);
    assert_eq!(
        b.doubts,
        ["line 4, <plugin>: added mass is positive (X_u = 1, Y_v = 30, Z_w = 31, M_q = 4, N_r = 5), as until July \
             2022: read as the mass itself; later versions have it negative"]
    );
}

#[test]
fn plain_squares_are_read_as_drag() {
    let text = with(GZ, "<xUabsU>-11</xUabsU>", "<xUU>-11</xUU>");
    let b = blocks(&text);
    assert_eq!(b.quadratic, blocks(GZ).quadratic);
    assert_eq!(
        b.doubts,
        ["line 20, <xUU>: read as <xUabsU>, as until November 2022; later versions do not reverse it with the speed"]
    );
    // The force Z of u² is a forward term with u twice.
    let b = blocks(&with(GZ, "<yUV>-7</yUV>", "<zUU>-7</zUU>"));
    assert_eq!(b.forward[(2, 0)], 7.0);
    assert_eq!(b.doubts, Vec::<String>::new());
}

/// The others are refused.
#[test]
fn products_that_are_not_supported_may_be_zero() {
    for (from, to) in [("<yRabsR>6</yRabsR>", "<yRabsV>0</yRabsV>"), ("<yUV>-7</yUV>", "<yVR>0</yVR>")] {
        assert_eq!(doubts(GZ, from, to), [""; 0]);
    }
}

#[test]
fn what_is_doubtful_is_told() {
    let line_8 = "<water_density>1025</water_density>";
    let native = "<gazebo><inertial><fluid_added_mass/></inertial></gazebo></robot>";
    for (from, to, told) in [
        (line_8, "<waterDensity>1025</waterDensity>", "8, <waterDensity>: is the former name of <water_density>"),
        (line_8, "<disable_coriolis>true</disable_coriolis>", "8, <disable_coriolis>: ignored"),
        (line_8, "<disable_added_mass>1</disable_added_mass>", "8, <disable_added_mass>: is true: the added mass is"),
        (line_8, "<default_current>0 1 0</default_current>", "8, <default_current>: ignored: the current is part"),
        (line_8, "<xAbsU>1</xAbsU>", "8, <xAbsU>: ignored: the plugin has no such element"),
        (line_8, "<xDotu>1</xDotu>", "8, <xDotu>: ignored: the plugin has no such element"),
        ("<xU>-1.5", "<xU>1.5", "4, <plugin>: linear damping is positive in X_u = 1.5: read as gz-sim does"),
        ("<nDotV>2</nDotV>", "", "4, <plugin>: added mass is not symmetric in Y_r = 2, N_v = 0: read as it stands"),
        ("</robot>", native, "26, <fluid_added_mass>: ignored: only the plugin's added mass is read"),
    ] {
        let doubts = doubts(GZ, from, to).join("\n");
        assert!(doubts.starts_with(&format!("line {told}")) && doubts.lines().count() == 1, "{doubts}");
    }
    let quiet = "<namespace>a</namespace><disable_coriolis>0</disable_coriolis>";
    assert_eq!(doubts(GZ, line_8, quiet), Vec::<String>::new());
    let none = blocks(&with(GZ, line_8, "<disable_added_mass>1</disable_added_mass>"));
    assert_eq!(none.added_mass, Matrix6::zeros());
    let old = blocks(&with(GZ, line_8, "<waterDensity>998</waterDensity>"));
    assert_eq!(old.density_kg_m3, Some(998.0));
}

#[test]
fn one_plugin_of_several_may_have_coefficients() {
    let other = "<plugin filename='gz-sim-hydrodynamics-system'><link_name>a</link_name></plugin>";
    let text = with(GZ, PLUGIN, &format!("{other}{PLUGIN}"));
    let b = blocks(&text);
    assert_eq!(b.link, "base_link");
    assert_eq!(b.doubts, ["line 4, <plugin>: ignored: it has no coefficient"]);
}
