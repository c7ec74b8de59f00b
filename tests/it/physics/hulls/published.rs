//! Vehicles as others publish them: frames without mass, files of another kind, marks of the encoding.

use rheotaxis::scenario::FolderFiles;
use robots::vehicles::{Vehicle, VehicleSpec};

const VEHICLE: &str = r#"(
    name: "Box", what: "A box with three thrusters.", source: "own", urdf: "box.urdf",
    hydrodynamics: (
        volume_m3: 0.02927, centre_of_buoyancy_m: (0, 0, 0.05),
        added_mass: Diagonal(10, 20, 25, 0.2, 0.3, 0.3),
        linear_damping: Diagonal(8, 12, 12, 0.5, 0.5, 0.5),
        quadratic_damping: Diagonal(30, 60, 70, 1, 1, 1),
        density_kg_m3: 1025, gravity_m_s2: 9.80665,
    ),
    drives: [
        Thruster(link: "left", curve: Newtons(-40, 40), lag_s: 0.1),
        Thruster(link: "right", curve: Newtons(-40, 40), lag_s: 0.1),
        Thruster(link: "vertical", curve: Newtons(-40, 40), lag_s: 0.1),
    ],
    autopilot: Thrusters(),
)"#;

const URDF: &str = r#"<?xml version="1.0"?>
<robot name="box">
  <link name="base_link">
    <inertial><mass value="30"/><inertia ixx="0.8" ixy="0" ixz="0" iyy="1.4" iyz="0" izz="1.6"/></inertial>
    <collision><geometry><box size="0.6 0.4 0.3"/></geometry></collision>
  </link>
  <link name="left"/><link name="right"/><link name="vertical"/>
  <joint name="l" type="fixed"><parent link="base_link"/><child link="left"/><origin xyz="-0.3 0.2 0"/></joint>
  <joint name="r" type="fixed"><parent link="base_link"/><child link="right"/><origin xyz="-0.3 -0.2 0"/></joint>
  <joint name="v" type="continuous"><parent link="base_link"/><child link="vertical"/><axis xyz="0 0 2"/></joint>
</robot>
"#;

/// A vehicle of a folder with these two texts.
fn load(vehicle: &str, urdf: &str) -> Result<Vehicle, String> {
    let dir = tempfile::tempdir().expect("a folder");
    let at = dir.path().join("box");
    std::fs::create_dir(&at).expect("a folder");
    std::fs::write(at.join("vehicle.ron"), vehicle).expect("a file");
    std::fs::write(at.join("box.urdf"), urdf).expect("a file");
    Vehicle::load(&VehicleSpec::File("box".into()), &FolderFiles(dir.path())).map_err(|e| e.to_string())
}

#[test]
fn links_may_be_frames_without_mass() {
    let whole = load(VEHICLE, URDF).expect("a vehicle");
    let frame = "<link name=\"footprint\"/><joint name=\"f\" type=\"fixed\"><parent link=\"footprint\"/>\
                 <child link=\"base_link\"/></joint><link name=\"base_link\">";
    let urdf = URDF.replace("<link name=\"base_link\">", frame);
    let mass = |vehicle: &Vehicle| vehicle.statics().expect("a hull").mass_kg;
    assert_eq!(mass(&load(VEHICLE, &urdf).expect("one body")), mass(&whole));
    let none = load(VEHICLE, &URDF.replace("<mass value=\"30\"/>", "<mass value=\"0\"/>"));
    assert!(none.as_ref().is_err_and(|e| e.contains("no link has a <mass> > 0")), "{none:?}");
}

#[test]
fn the_mark_of_an_encoding_is_read_over() {
    let [vehicle, urdf] = [VEHICLE, URDF].map(|t| format!("\u{feff}{}", t.replace('\n', "\r\n")));
    load(&vehicle, &urdf).expect("as without it");
}

#[test]
fn what_is_no_urdf_is_called_what_it_is() {
    let says = |urdf: &str, words: &str| {
        let error = load(VEHICLE, urdf).expect_err("no URDF");
        assert!(error.contains(words), "{words} is not in: {error}");
    };
    says("<?xml version=\"1.0\"?><sdf version=\"1.9\"><model name=\"box\"/></sdf>", "it is SDF");
    let xacro = URDF.replace("<robot name", "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\" name");
    says(&xacro.replace("\"30\"", "\"${m}\""), "run `xacro");
    for address in ["package://box/hull.stl", "model://box/hull.stl"] {
        let mesh = format!("<mesh filename=\"{address}\"/>");
        says(&URDF.replace("<box size=\"0.6 0.4 0.3\"/>", &mesh), "put the file beside the URDF");
    }
    let deep = format!("<robot name=\"deep\">{}{}</robot>", "<a>".repeat(20_000), "</a>".repeat(20_000));
    says(&deep, "line 1: more than 100 elements stand one within the other");
    // Comments and elements without content open nothing.
    load(VEHICLE, &URDF.replace("<robot name", &format!("{}<robot name", "<!-- <a> -->".repeat(100)))).expect("fine");
    let links: String = (0..4000).map(|n| format!("<link name=\"l{n}\"/>")).collect();
    let joint = |n: usize| {
        format!("<joint name=\"j{n}\" type=\"fixed\"><parent link=\"l{n}\"/><child link=\"l{}\"/></joint>", n + 1)
    };
    let joints: String = (0..3999).map(joint).collect();
    says(&format!("<robot name=\"chain\">{links}{joints}</robot>"), "at most 1000 links, got 4000");
}
