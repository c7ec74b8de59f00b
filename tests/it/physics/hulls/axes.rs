//! The axes of a URDF's joints are those of the drives on them.

use super::kit::{built, folder, load, set, shipped, still};
use crate::common::{rheotaxis_in, says};
use nalgebra::Vector3;
use rheotaxis::scenario::FolderFiles;
use robots::vehicles::{Description, ShippedVehicle, Vehicle, VehicleSpec};
use world::frames::{Pose, Truth};
use world::units::Heading;

/// A box with two thrusters astern and one in its middle, whose joint is given.
fn box_urdf(kind: &str, axis: &str) -> String {
    let fixed = |name: &str, y: f64| {
        format!(
            "<link name=\"{name}\"/><joint name=\"{name}_joint\" type=\"fixed\"><parent link=\"base_link\"/>\
             <child link=\"{name}\"/><origin xyz=\"-0.3 {y} 0\"/></joint>"
        )
    };
    format!(
        "<robot name=\"box\"><link name=\"base_link\"><inertial><mass value=\"30\"/>\
         <inertia ixx=\"0.8\" ixy=\"0\" ixz=\"0\" iyy=\"1.4\" iyz=\"0\" izz=\"1.6\"/></inertial>\
         <collision><geometry><box size=\"0.6 0.4 0.3\"/></geometry></collision></link>{}{}\
         <link name=\"middle\"/><joint name=\"middle_joint\" type=\"{kind}\"><parent link=\"base_link\"/>\
         <child link=\"middle\"/>{axis}<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint></robot>",
        fixed("left", 0.2),
        fixed("right", -0.2)
    )
}

const BOX: &str = "(
    name: \"Box\",
    urdf: \"box.urdf\",
    hydrodynamics: (
        volume_m3: 0.0292683,
        centre_of_buoyancy_m: (0, 0, 0.05),
        added_mass: Diagonal(10, 20, 25, 0.2, 0.3, 0.3),
        linear_damping: Diagonal(8, 12, 12, 0.5, 0.5, 0.5),
        quadratic_damping: Diagonal(30, 60, 70, 1, 1, 1),
        density_kg_m3: 1025,
        gravity_m_s2: 9.80665,
    ),
    drives: [
        Thruster(link: \"left\", curve: Newtons(-40, 40)),
        Thruster(link: \"right\", curve: Newtons(-40, 40)),
        Thruster(link: \"middle\", curve: Newtons(-40, 40)),
    ],
    autopilot: Thrusters(),
)";

fn boxed(kind: &str, axis: &str) -> Result<Vehicle, String> {
    load(&folder(BOX, ("box.urdf", &box_urdf(kind, axis))))
}

fn way(vehicle: &Vehicle, drive: usize) -> Vector3<f64> {
    vehicle.drives()[drive].way
}

#[test]
fn a_shaft_lies_along_the_axis_of_its_joint() {
    for (kind, axis, along) in [
        ("continuous", "<axis xyz=\"0 0 1\"/>", Vector3::z()),
        ("revolute", "<axis xyz=\"0 0 -2\"/>", -Vector3::z()),
        ("continuous", "<axis xyz=\"0 -1 0\"/>", -Vector3::y()),
        ("continuous", "", Vector3::x()),
        ("fixed", "", Vector3::x()),
    ] {
        let mut vehicle = boxed(kind, axis).expect("a vehicle");
        assert!((way(&vehicle, 2) - along).norm() < 1e-12, "{kind} {axis}");
        assert_eq!(vehicle.capabilities(0.0).dives, along.z != 0.0);
        assert_eq!(vehicle.doubts(), [""; 0]);
        // And there it pushes the hull.
        let deep = Pose::level(Vector3::new(0.0, 0.0, -20.0), Heading::from_deg(90.0));
        let pushed = vehicle.step_in(&Truth::at_rest(deep), &still(1025.0), &set(&[0.0, 0.0, 20.0]), 0.02);
        assert!(pushed.v_WB_B.normalize().dot(&along) > 0.99, "{pushed:?}");
    }
}

#[test]
fn an_axis_that_does_not_count_or_is_none_is_told() {
    let told = |axis: &str| boxed("fixed", &format!("<axis xyz=\"{axis}\"/>")).expect("a vehicle").doubts().join("; ");
    says(&told("0 0 1"), &["drives[2].link", "\"middle_joint\"", "0 0 1", "does not count"]);
    // Exporters write zeros for joints without an axis.
    assert_eq!(told("0 0 0"), "");
    for none in ["0 0 0", "0 NaN 1"] {
        let said = boxed("continuous", &format!("<axis xyz=\"{none}\"/>")).expect_err("it cannot be a vehicle");
        says(&said, &["drives[2].link", "\"middle_joint\"", "must be a direction"]);
    }
}

#[test]
fn a_fin_turns_about_the_axis_of_its_joint() {
    let (file, urdf) = shipped("lauv");
    let rolled = built(&file, &urdf);
    const ROLL: &str = " rpy=\"1.5707963267948966 0 0\"/>\n    <axis xyz=\"0 1 0\"/>";
    assert_eq!(urdf.matches(ROLL).count(), 2);
    let upright = |axis: &str| urdf.replace(ROLL, &format!("/>{axis}"));
    let by_axis = built(&file, &upright("<axis xyz=\"0 0 1\"/>"));
    for drive in 0..5 {
        let apart = way(&rolled, drive) - way(&by_axis, drive);
        assert!(apart.norm() < 1e-12, "{drive}: {apart}");
    }
    // An X tail on links that are not rolled: a positive angle about (0, 1, 1) pushes starboard-down's other way.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let tail = urdf.replace(ROLL, "/><axis xyz=\"0 1 1\"/>").replace("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 1 -1\"/>");
    let tail = built(&file, &tail);
    assert!((way(&tail, 1) - Vector3::new(0.0, half, -half)).norm() < 1e-12);
    assert!((way(&tail, 3) - Vector3::new(0.0, -half, -half)).norm() < 1e-12);
    assert!(tail.capabilities(0.0).dives);
    // A link whose x axis points outwards, along the hinge: the chord lies along the hull.
    let outwards = built(&file, &urdf.replace(ROLL, " rpy=\"0 -1.5707963267948966 0\"/><axis xyz=\"1 0 0\"/>"));
    assert!((way(&outwards, 1) - way(&rolled, 1)).norm() < 1e-12);
    // Without an axis, URDF takes x, about which nothing is steered.
    let lauv = ShippedVehicle::named("lauv").expect("shipped");
    let said = load(&folder(lauv.file, (lauv.urdf.0, &upright("")))).expect_err("it cannot be a vehicle");
    says(&said, &["drives[1].link", "\"fin_top\"", "cannot steer"]);
}

#[test]
fn pictures_turn_about_the_same_axis_and_check_prints_it() {
    let dir = folder(BOX, ("box.urdf", &box_urdf("continuous", "<axis xyz=\"0 0 1\"/>")));
    let spec = VehicleSpec::File("hull".into());
    let drawn = Description::of_vehicle(&spec, &FolderFiles(dir.path())).expect("a vehicle");
    let joint = |name: &str| drawn.joints.iter().find(|j| j.joint == name);
    assert_eq!(joint("middle_joint").expect("it").axis, Vector3::z());
    assert_eq!(joint("left_joint").expect("it").axis, Vector3::x());
    let said = rheotaxis_in(dir.path(), &["vehicle", "check", "hull"]).with(0).out;
    let left = "at (-0.300, -0.200, 0.000) m, pushes along (1.000, 0.000, 0.000)";
    says(&said, &[left, "at (0.000, 0.000, 0.000) m, pushes along (0.000, 0.000, 1.000)", "dives yes"]);
}
