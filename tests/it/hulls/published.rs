//! Vehicles as others publish them: axes of joints, frames without mass, files of another kind, marks of the encoding.

use nalgebra::Vector3;
use rheotaxis::scenario::Beside;
use robots::vehicles::{Craft, Described, VehicleSpec};

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
fn load(vehicle: &str, urdf: &str) -> Result<Described, String> {
    let dir = tempfile::tempdir().expect("a folder");
    let at = dir.path().join("box");
    std::fs::create_dir(&at).expect("a folder");
    std::fs::write(at.join("vehicle.ron"), vehicle).expect("a file");
    std::fs::write(at.join("box.urdf"), urdf).expect("a file");
    match Craft::load(&VehicleSpec::File("box".into()), &Beside(dir.path())) {
        Ok(Craft::Described(vehicle)) => Ok(*vehicle),
        Ok(_) => panic!("a vehicle of a folder"),
        Err(e) => Err(e.to_string()),
    }
}

#[test]
fn a_drive_acts_along_the_axis_of_its_joint() {
    let vehicle = load(VEHICLE, URDF).expect("a vehicle");
    let (_, way) = vehicle.acting().nth(2).expect("three drives");
    assert!((way - Vector3::z()).norm() < 1e-12, "{way}");
    assert!(vehicle.capabilities().dives);
    // A fixed joint, and the axis that is along x anyway, leave it along the link's x.
    let ahead = load(VEHICLE, &URDF.replace("0 0 2", "1 0 0")).expect("a vehicle");
    assert!(!ahead.capabilities().dives);
    let wrong = load(VEHICLE, &URDF.replace("0 0 2", "0 0 0")).expect_err("no direction");
    assert!(
        wrong.contains("joint \"v\": <axis> must be a direction"),
        "{wrong}"
    );
}

#[test]
fn a_fin_turns_about_the_axis_of_its_joint() {
    let fins = VEHICLE.replace(
        "Thruster(link: \"vertical\", curve: Newtons(-40, 40), lag_s: 0.1)",
        "Fin(link: \"vertical\", area_m2: 0.01, lift_slope: 3, limit_deg: 20)",
    );
    let lift = |axis: &str| {
        let urdf = URDF
            .replace("0 0 2", axis)
            .replace("continuous", "revolute");
        let urdf = urdf.replace(
            "<axis",
            "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/><axis",
        );
        let vehicle = load(&fins, &urdf).unwrap_or_else(|e| panic!("{axis}: {e}"));
        let all: Vec<_> = vehicle.acting().collect();
        all[2].1
    };
    // As the link's y turned onto the axis turns the lift.
    let level = lift("0 1 0");
    assert!(level.z.abs() > 0.999, "{level}");
    assert_eq!(
        lift("1 0 0"),
        level,
        "URDF's own axis says nothing of a fin"
    );
    let rudder = lift("0 0 1");
    assert!((rudder.y + level.z).abs() < 1e-12, "{rudder} {level}");
    let tilted = lift("0 1 1");
    assert!((tilted.y.abs() - tilted.z.abs()).abs() < 1e-12, "{tilted}");
}

#[test]
fn links_may_be_frames_without_mass() {
    let whole = load(VEHICLE, URDF).expect("a vehicle");
    let frame = "<link name=\"footprint\"/><joint name=\"f\" type=\"fixed\"><parent link=\"footprint\"/>\
                 <child link=\"base_link\"/></joint><link name=\"base_link\">";
    let urdf = URDF.replace("<link name=\"base_link\">", frame);
    assert_eq!(
        load(VEHICLE, &urdf).expect("one body").mass_kg(),
        whole.mass_kg()
    );
    let none = load(
        VEHICLE,
        &URDF.replace("<mass value=\"30\"/>", "<mass value=\"0\"/>"),
    );
    assert!(
        none.as_ref()
            .is_err_and(|e| e.contains("no link has a <mass> > 0")),
        "{none:?}"
    );
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
    says(
        "<?xml version=\"1.0\"?><sdf version=\"1.9\"><model name=\"box\"/></sdf>",
        "it is SDF",
    );
    let xacro = URDF.replace(
        "<robot name",
        "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\" name",
    );
    says(
        &xacro.replace("\"30\"", "\"${m}\""),
        "it is xacro that has not been processed",
    );
    for address in ["package://box/hull.stl", "model://box/hull.stl"] {
        let mesh = format!("<mesh filename=\"{address}\"/>");
        says(
            &URDF.replace("<box size=\"0.6 0.4 0.3\"/>", &mesh),
            "copy the file beside the URDF",
        );
    }
    let deep = format!(
        "<robot name=\"deep\">{}{}</robot>",
        "<a>".repeat(20_000),
        "</a>".repeat(20_000)
    );
    says(&deep, "line 1: elements are nested more than 64 deep");
    // Comments and elements without content open nothing.
    load(
        VEHICLE,
        &URDF.replace(
            "<robot name",
            &format!("{}<robot name", "<!-- <a> -->".repeat(100)),
        ),
    )
    .expect("fine");
    let links: String = (0..4000)
        .map(|n| format!("<link name=\"l{n}\"/>"))
        .collect();
    let joint = |n: usize| {
        format!(
            "<joint name=\"j{n}\" type=\"fixed\"><parent link=\"l{n}\"/><child link=\"l{}\"/></joint>",
            n + 1
        )
    };
    let joints: String = (0..3999).map(joint).collect();
    says(
        &format!("<robot name=\"chain\">{links}{joints}</robot>"),
        "at most 1000 links, got 4000",
    );
}

#[test]
fn damping_that_no_hull_has_is_doubted() {
    let doubts = |by: &str| {
        let vehicle = VEHICLE.replace("Diagonal(30, 60, 70, 1, 1, 1)", by);
        load(&vehicle, URDF).expect("a vehicle")
    };
    assert_eq!(
        doubts("Diagonal(30, 60, 70, 1, 1, 1)").told(),
        Vec::<String>::new()
    );
    let much = doubts("Diagonal(78000, 156000, 182000, 2600, 2600, 2600)");
    assert!(
        much.told()
            .iter()
            .any(|t| t.contains("its motion decays within")),
        "{:?}",
        much.told()
    );
    let more = doubts("Diagonal(1966080, 3932160, 4587520, 65536, 65536, 65536)");
    assert!(!more.follows(0.02), "{}", more.shortest_s());
}
