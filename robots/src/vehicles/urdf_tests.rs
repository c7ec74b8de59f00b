//! Reads URDFs of vehicles, and checks the messages for wrong ones.

use super::files::InMemory;
use super::torpedo::testing::remus100;
use super::{RemusSpec, Vehicle, VehicleSpec};
use crate::error::RobotError;
use crate::handoff::Actuation;
use nalgebra::Vector3;
use world::frames::{Pose, Truth};
use world::physics::Shape;
use world::units::Heading;

const GOOD: &str = include_str!("../../vehicles/remus100/remus100.urdf");

/// A REMUS with a URDF of its own.
fn remus(urdf: &str, files: &InMemory) -> Result<Vehicle, RobotError> {
    Vehicle::load(&VehicleSpec::Remus100(RemusSpec { urdf: Some(urdf.into()), ..RemusSpec::default() }), files)
}

fn parse(text: &str) -> Result<Vehicle, String> {
    let at = "/no/such/place/auv.urdf";
    remus(at, &InMemory::default().with(at, text.as_bytes())).map_err(|e| e.to_string())
}

/// At rest, level, heading north.
fn start(z_m: f64) -> Truth {
    Truth::at_rest(Pose::level(Vector3::new(0.0, 0.0, z_m), Heading::from_deg(0.0)))
}

/// The text of a link, with its shapes.
fn link(name: &str) -> &'static str {
    let start = GOOD.find(&format!("<link name=\"{name}\"")).expect("a link");
    let end = start + GOOD[start..].find("</link>").expect("with shapes") + "</link>".len();
    &GOOD[start..end]
}

#[track_caller]
fn refused(text: &str, wanted: &str) {
    let said = parse(text).expect_err("this is wrong");
    assert!(said.starts_with(&format!("/no/such/place/auv.urdf: {wanted}")), "{said}");
}

#[test]
fn mounts_add_up_along_a_chain_of_joints() {
    let chain = GOOD.replace(
        "</robot>",
        r#"<link name="boom"/><link name="tip"/>
           <joint name="b" type="fixed"><parent link="boom"/><child link="tip"/><origin xyz="0 0 0.5"/></joint>
           <joint name="a" type="fixed"><parent link="base_link"/><child link="boom"/>
             <origin xyz="1 0 0" rpy="0 1.5707963267948966 0"/></joint></robot>"#,
    );
    let hull = parse(&chain).expect("a chain");
    assert_eq!(hull.mount("fluorometer").expect("mounted").p_WB, Vector3::new(0.72, 0.0, -0.06));
    assert_eq!(hull.mount("sonar"), None);
    assert!((hull.mount("tip").expect("a link").p_WB - Vector3::new(1.5, 0.0, 0.0)).norm() < 1e-12);
}

#[test]
fn what_is_no_tree_of_links_is_told() {
    let end = |more: &str| GOOD.replace("</robot>", &format!("{more}</robot>"));
    let joint = |name: &str, parent: &str, child: &str| {
        format!("<joint name=\"{name}\" type=\"fixed\"><parent link=\"{parent}\"/><child link=\"{child}\"/></joint>")
    };
    let ring = format!("<link name=\"a\"/><link name=\"b\"/>{}{}", joint("there", "a", "b"), joint("back", "b", "a"));
    let half = &GOOD[..GOOD.len() / 2];
    let ends = format!("not a URDF file: it ends at line {}, before </robot>", half.lines().count());
    for (text, wanted) in [
        ("hello".to_string(), "not a URDF file: there is no <robot> in it"),
        (half.to_string(), ends.as_str()),
        (GOOD.replace(link("propeller"), ""), "joint \"propeller_joint\": no link \"propeller\""),
        (
            GOOD.replace("child link=\"rudder\"", "child link=\"lbl\""),
            "link \"lbl\" is the child of two joints, \"rudder_joint\" and \"lbl_joint\"",
        ),
        (GOOD.replace("\"rudder\"", "\"helm\""), "link \"rudder\" is missing"),
        (end("<link name=\"rudder\"/>"), "link \"rudder\" occurs twice"),
        (end(&joint("round", "rudder", "base_link")), "every link is the child of a joint, so there is no body"),
        (end(&ring), "link \"a\" is not joined to \"base_link\""),
        (end("<link name=\"loose\"/>"), "link \"loose\" is not joined to \"base_link\""),
        (
            GOOD.replace("0.72 0 -0.06", "0.72 NaN -0.06"),
            "joint \"fluorometer_joint\": <origin> must be finite, got NaN",
        ),
    ] {
        refused(&text, wanted);
    }
}

#[test]
fn masses_and_shapes_that_are_no_remus_are_told() {
    let hull = "<capsule radius=\"0.095\" length=\"1.41\"/>";
    let body = "link \"base_link\"";
    let for_it = "but the hydrodynamic parameters are for";
    for (from, to, wanted) in [
        ("iyy=\"4.0277693\"", "iyy=\"5\"", format!("{body}: iyy is 5 kg m2, {for_it} 4.02777 kg m2")),
        ("0 0 -0.02", "0 0 0.02", format!("{body}: the centre of gravity is at z = 0.02 m, {for_it} -0.02 m")),
        (
            "0 0 -0.02",
            "0.1 0 -0.02",
            format!("{body}: the centre of gravity is at x = 0.1 m, y = 0 m, but the hydrodynamic parameters have it"),
        ),
        ("ixz=\"0\"", "ixz=\"1\"", format!("{body}: ixz is 1 kg m2, {for_it} a hull with zero")),
        (hull, "<sphere radius=\"-1\"/>", format!("{body}, collision 1: sphere radius must be > 0, got -1")),
        (
            hull,
            "<sphere radius=\"1e3\"/>",
            format!("{body}, collision 1: reaches 1000.0 m from the body's origin; at most 10 m"),
        ),
    ] {
        assert!(GOOD.contains(from), "{from}");
        refused(&GOOD.replace(from, to), &wanted);
    }
}

/// A mass within 1 % of the parameters' is the vehicle's: it has that weight, and `check` reports it.
#[test]
fn a_mass_within_the_tolerance_is_used_and_told() {
    let heavy = |text: &str| parse(text).expect("within 1 %");
    let built_in = heavy(GOOD);
    let published = remus100(false);
    assert_eq!(built_in.coefficients(), Some(&published), "eight digits are no difference");
    assert_eq!(built_in.doubts(), [""; 0]);

    let hull = heavy(&GOOD.replace("value=\"31.029385\"", "value=\"31.2\""));
    let c = hull.coefficients().expect("a torpedo");
    assert_eq!((c.mass_kg, c.rigid_mass()[(0, 0)]), (31.2, 31.2));
    assert_eq!(
        hull.doubts(),
        ["weighs 31.2 kg by its URDF, the hull of the hydrodynamic parameters 31.029 kg: the URDF's mass is used; \
             1.67 N heavier than water of 1026 kg/m3, it sinks"]
    );
    let hull = heavy(
        &GOOD
            .replace("iyy=\"4.0277693\"", "iyy=\"4.05\"")
            .replace("0 0 -0.02", "0.0001 0 -0.0201")
            .replace("ixy=\"0\"", "ixy=\"0.0005\""),
    );
    let c = hull.coefficients().expect("a torpedo");
    assert_eq!((c.inertia_kg_m2.y, c.z_g_m), (4.05, 0.0201));
    assert_eq!(
        hull.doubts(),
        [
            "iyy is 4.05 kg m2 by its URDF, 4.02777 kg m2 by the hydrodynamic parameters: the URDF's is used",
            "the centre of gravity is 0.0201 m low by its URDF, 0.02 m by the hydrodynamic parameters: the URDF's is \
            used",
            "x of the centre of gravity is 0.0001 m by its URDF: ignored, because the equation of motion has none",
            "ixy is 0.0005 kg m2 by its URDF: ignored, because the equation of motion has none",
        ]
    );
}

/// Fins and instruments with a mass of their own add to the body's.
#[test]
fn masses_of_all_links_add_up() {
    let with = |kg: &str| {
        let fin = format!(
            "<link name=\"rudder\"><inertial><mass value=\"{kg}\"/>\
             <inertia ixx=\"0\" ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" izz=\"0\"/></inertial></link>"
        );
        parse(&GOOD.replace(link("rudder"), &fin))
    };
    let said = with("0.5").expect_err("1.6 % more");
    assert!(said.contains("<mass> is 31.529385 kg, but the hydrodynamic parameters are for 31.029 kg"), "{said}");
    let hull = with("0.005").expect("a small fin");
    assert!((hull.coefficients().expect("a torpedo").mass_kg - 31.034385).abs() < 1e-12);
    // 0.005 kg 0.8 m behind the middle, less the effect of the moved centre of gravity.
    let more = hull.coefficients().expect("a torpedo").inertia_kg_m2.z - 4.0277693;
    assert!((more - 0.005 * 0.64).abs() < 1e-5, "{more}");
}

/// The weight is the URDF's: left alone under water, the heavier vehicle sinks.
#[test]
fn a_heavier_hull_sinks() {
    let start = start(-50.0);
    let still = world::fields::WaterSample {
        velocity: Vector3::zeros(),
        gradient: nalgebra::Matrix3::zeros(),
        rate: Vector3::zeros(),
        density_kg_m3: 1026.0,
    };
    let sinks = |kg: &str| {
        let text = GOOD.replace("value=\"31.029385\"", &format!("value=\"{kg}\""));
        let files = InMemory::default().with("auv.urdf", text.as_bytes());
        let mut vehicle = remus("auv.urdf", &files).expect("a vehicle");
        vehicle.step_in(&start, &still, &Actuation::default(), 0.02).v_world().z / 0.02
    };
    let (neutral, heavy) = (sinks("31.029385"), sinks("31.2"));
    assert!(neutral.abs() < 1e-9, "{neutral}");
    let c = remus100(false);
    let expected = -(31.2 - c.mass_kg) * world::units::GRAVITY_M_S2 / (31.2 + c.added[2]);
    assert!((heavy / expected - 1.0).abs() < 2e-3, "{heavy} m/s2, not {expected}");
}

#[test]
fn a_mesh_beside_the_urdf_becomes_a_hull() {
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n";
    let text =
        GOOD.replace("<capsule radius=\"0.095\" length=\"1.41\"/>", "<mesh filename=\"hull.obj\" scale=\"2 2 2\"/>");
    // The mesh lies beside the URDF, not beside the scenario.
    let files = InMemory::default().with("hulls/auv.urdf", text.as_bytes()).with("hulls/hull.obj", obj.as_bytes());
    let vehicle = remus("hulls/auv.urdf", &files).expect("a vehicle with a mesh");
    let (_, shape) = vehicle.body_spec("auv", start(0.0)).shapes.remove(0);
    let Shape::Hull { points_m } = shape else {
        panic!("a hull of points, not {shape:?}");
    };
    assert_eq!(points_m[1], Vector3::new(2.0, 0.0, 0.0));
}
