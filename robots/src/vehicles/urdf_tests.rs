//! What a wrong URDF is told.

use super::coefficients::{Coefficients, ParameterSet};
use super::spec::{RemusSpec, VehicleSpec};
use super::urdf::{Hull, read};
use super::vehicle::Vehicle;
use nalgebra::Vector3;
use std::path::Path;
use world::physics::Shape;

const GOOD: &str = include_str!("../../urdf/remus100.urdf");

fn parse(text: &str) -> Result<Hull, String> {
    let c = Coefficients::of(ParameterSet::Remus100);
    read(text, Path::new("/no/such/place/auv.urdf"), &c).map_err(|e| e.to_string())
}

fn fails(from: &str, to: &str) -> String {
    assert!(GOOD.contains(from), "{from}");
    parse(&GOOD.replace(from, to)).expect_err("this is wrong")
}

#[test]
fn the_built_in_hull_has_its_instruments() {
    let vehicle = Vehicle::load(&VehicleSpec::default(), Path::new(".")).expect("built in");
    let nose = vehicle.mount("fluorometer").expect("mounted").p_WB;
    assert_eq!(nose, Vector3::new(0.72, 0.0, -0.06));
    for name in ["dvl", "adcp", "altimeter", "compass", "depth", "lbl"] {
        assert!(vehicle.mount(name).is_some(), "{name}");
    }
    assert_eq!(vehicle.mount("sonar"), None);
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
    assert!((hull.links["tip"].p_WB - Vector3::new(1.5, 0.0, 0.0)).norm() < 1e-12);
}

#[test]
fn a_missing_file_is_named() {
    let spec = VehicleSpec::Remus100(RemusSpec {
        urdf: Some("none.urdf".into()),
        ..RemusSpec::default()
    });
    let error = Vehicle::load(&spec, Path::new("/no/such/place")).expect_err("no file");
    assert_eq!(
        error.to_string(),
        "/no/such/place/none.urdf: No such file or directory (os error 2)"
    );
}

#[test]
fn broken_xml_is_told() {
    let error = parse("<robot name=\"x\"><link").expect_err("broken");
    assert!(
        error.starts_with("/no/such/place/auv.urdf: not a URDF file: "),
        "{error}"
    );
}

#[test]
fn missing_links_are_named() {
    assert_eq!(
        fails("<link name=\"propeller\"/>", ""),
        "/no/such/place/auv.urdf: joint \"propeller_joint\": no link \"propeller\""
    );
    assert_eq!(
        fails("child link=\"rudder\"", "child link=\"lbl\""),
        "/no/such/place/auv.urdf: link \"lbl\" is the child of two joints, \"rudder_joint\" and \"lbl_joint\""
    );
    let other = GOOD.replace("\"rudder\"", "\"helm\"");
    assert_eq!(
        parse(&other).expect_err("no rudder"),
        "/no/such/place/auv.urdf: link \"rudder\" is missing"
    );
}

#[test]
fn what_is_no_tree_is_told() {
    let with = |more: &str| {
        let text = GOOD.replace("</robot>", &format!("{more}</robot>"));
        let error = parse(&text).expect_err("no tree");
        error.replace("/no/such/place/auv.urdf: ", "")
    };
    let joint = |name: &str, parent: &str, child: &str| {
        format!(
            "<joint name=\"{name}\" type=\"fixed\"><parent link=\"{parent}\"/><child link=\"{child}\"/></joint>"
        )
    };
    assert_eq!(
        with("<link name=\"rudder\"/>"),
        "link \"rudder\" is there twice"
    );
    assert_eq!(
        with(&joint("round", "rudder", "base_link")),
        "every link is the child of a joint: there is no body"
    );
    let ring = format!(
        "<link name=\"a\"/><link name=\"b\"/>{}{}",
        joint("there", "a", "b"),
        joint("back", "b", "a")
    );
    assert_eq!(with(&ring), "link \"a\" is not joined to \"base_link\"");
    assert_eq!(
        with("<link name=\"loose\"/>"),
        "link \"loose\" is not joined to \"base_link\""
    );
    for (text, why) in [
        ("hello", "there is no <robot> in it"),
        (
            &GOOD[..GOOD.len() / 2],
            "it ends at line 50, before </robot>",
        ),
    ] {
        assert_eq!(
            parse(text).expect_err("no URDF"),
            format!("/no/such/place/auv.urdf: not a URDF file: {why}")
        );
    }
}

#[test]
fn wrong_masses_are_told() {
    assert_eq!(
        fails("value=\"31.029385\"", "value=\"0\""),
        "/no/such/place/auv.urdf: link \"base_link\": <mass> must be > 0 kg, got 0"
    );
    assert_eq!(
        fails("value=\"31.029385\"", "value=\"40\""),
        "/no/such/place/auv.urdf: link \"base_link\": <mass> is 40 kg, but the hydrodynamic parameters are for 31.029 kg"
    );
    assert_eq!(
        fails("iyy=\"4.0277693\"", "iyy=\"5\""),
        "/no/such/place/auv.urdf: link \"base_link\": iyy is 5 kg m2, but the hydrodynamic parameters are for 4.02777 kg m2"
    );
    assert_eq!(
        fails("0 0 -0.02", "0 0 0.02"),
        "/no/such/place/auv.urdf: link \"base_link\": the centre of gravity is at z = 0.02 m, but the hydrodynamic parameters are for -0.02 m"
    );
    assert_eq!(
        fails("0 0 -0.02", "0.1 0 -0.02"),
        "/no/such/place/auv.urdf: link \"base_link\": the centre of gravity is at x = 0.1 m, y = 0 m, but the hydrodynamic parameters have it under the middle"
    );
    assert_eq!(
        fails("ixz=\"0\"", "ixz=\"1\""),
        "/no/such/place/auv.urdf: link \"base_link\": ixz is 1 kg m2, but the hydrodynamic parameters are for a hull without"
    );
}

#[test]
fn wrong_geometry_is_told() {
    let hull = "<capsule radius=\"0.095\" length=\"1.41\"/>";
    assert_eq!(
        fails(hull, "<mesh filename=\"hull.stl\"/>"),
        "/no/such/place/auv.urdf: link \"base_link\", collision 1: mesh \"hull.stl\": No such file or directory (os error 2)"
    );
    assert_eq!(
        fails(hull, "<sphere radius=\"-1\"/>"),
        "/no/such/place/auv.urdf: link \"base_link\", collision 1: sphere radius must be > 0, got -1"
    );
    assert_eq!(
        fails(hull, "<sphere radius=\"1e3\"/>"),
        "/no/such/place/auv.urdf: link \"base_link\", collision 1: reaches 1000.0 m from the body's origin; at most 10 m"
    );
    let nose = "0.72 0 -0.06";
    assert!(fails(nose, "0.72 NaN -0.06").ends_with("<origin> must be finite, got NaN"));
}

#[test]
fn a_mesh_beside_the_urdf_becomes_a_hull() {
    let dir = std::env::temp_dir().join(format!("rheotaxis-urdf-{}", std::process::id()));
    std::fs::create_dir_all(&dir).expect("a directory");
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n";
    std::fs::write(dir.join("hull.obj"), obj).expect("a file");
    let text = GOOD.replace(
        "<capsule radius=\"0.095\" length=\"1.41\"/>",
        "<mesh filename=\"hull.obj\" scale=\"2 2 2\"/>",
    );
    std::fs::write(dir.join("auv.urdf"), text).expect("a file");
    let spec = VehicleSpec::Remus100(RemusSpec {
        urdf: Some("auv.urdf".into()),
        ..RemusSpec::default()
    });
    let vehicle = Vehicle::load(&spec, &dir).expect("a vehicle with a mesh");
    std::fs::remove_dir_all(&dir).expect("cleaned up");
    let start = world::frames::Truth::at_rest(world::frames::Pose::level(
        Vector3::zeros(),
        world::units::Heading::from_deg(0.0),
    ));
    let (_, shape) = vehicle.body_spec("auv", start).shapes.remove(0);
    let Shape::Hull { points_m } = shape else {
        panic!("a hull of points, not {shape:?}");
    };
    assert_eq!(points_m[1], Vector3::new(2.0, 0.0, 0.0));
}
