//! Reads URDFs of gantries, and checks the messages for wrong ones.

use super::super::files::InMemory;
use super::super::urdf_parts::as_file;
use super::frame::{Frame, read};
use super::machine::Gantry;
use super::spec::{CrabGantrySpec, GantrySpec};
use nalgebra::{Vector2, Vector3};
use world::frames::Pose;
use world::physics::JointState;
use world::ranges::Positive;
use world::units::Heading;

const GOOD: &str = include_str!("../../../urdf/crab_gantry.urdf");
const FIRST: &str = r#"<limit lower="0" upper="2" velocity="0.15" effort="200"/>"#;

/// A different gantry: the slide across is on the base, mounts are turned, a joint counts the other way, two probes.
pub(super) const OTHER: &str = r#"<robot name="other">
  <link name="frame"><collision><origin xyz="0 0 1"/><geometry><sphere radius="0.1"/></geometry></collision></link>
  <link name="bridge"><inertial><mass value="8"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="motor"><inertial><mass value="1.5"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="cart"><inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <collision><geometry><box size="0.05 0.05 0.05"/></geometry></collision></link>
  <link name="stalk"/><link name="probe_a"/><link name="probe_b"/>
  <joint name="cart_slide" type="prismatic"><parent link="motor"/><child link="cart"/>
    <origin xyz="0 0 -0.1" rpy="0 0 0"/><axis xyz="0 2 0"/>
    <limit lower="-1" upper="3" velocity="0.3" effort="30"/></joint>
  <joint name="motor_mount" type="fixed"><parent link="bridge"/><child link="motor"/><origin xyz="0 0 0.1"/></joint>
  <joint name="bridge_slide" type="prismatic"><parent link="frame"/><child link="bridge"/>
    <origin xyz="0.2 0 0.4" rpy="0 0 1.5708"/><axis xyz="-1 0 0"/>
    <limit lower="-0.2" upper="0.6" velocity="0.2" effort="40"/></joint>
  <joint name="stalk_mount" type="fixed"><parent link="cart"/><child link="stalk"/><origin xyz="0 0 -0.3"/></joint>
  <joint name="a" type="fixed"><parent link="stalk"/><child link="probe_a"/><origin xyz="0.04 0 0"/></joint>
  <joint name="b" type="fixed"><parent link="stalk"/><child link="probe_b"/><origin xyz="-0.04 0 0"/></joint>
</robot>"#;

fn parse(text: &str) -> Result<Frame, String> {
    let files = InMemory::default();
    read(&as_file(text, "/no/such/place/g.urdf", &files)).map_err(|e| e.to_string())
}

/// What is said of the built-in gantry with a part replaced, without the path.
fn said(from: &str, to: &str) -> String {
    assert!(GOOD.contains(from), "{from}");
    let error = parse(&GOOD.replacen(from, to, 1)).expect_err("this is wrong");
    error.strip_prefix("/no/such/place/g.urdf: ").expect("it names the file").to_string()
}

fn at(a: f64, b: f64) -> [JointState; 2] {
    [a, b].map(|position_m| JointState { position_m, ..JointState::default() })
}

#[test]
fn the_built_in_gantry_is_the_paper_s() {
    let gantry = Gantry::load(&GantrySpec::default(), &InMemory::default()).expect("built in");
    let layout = gantry.layout(20.0, [-5.0, 5.0]);
    assert_eq!(layout.travel_m, [[0.0, 2.0], [-0.5, 0.5]]);
    assert_eq!(layout.max_speed_m_s, [0.15, 0.15]);
    assert_eq!(gantry.joint_names(), ["along_stream", "across_stream"]);
    let names: Vec<&str> = layout.probes.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["probe_left", "probe_right", "probe_centre"]);
    // A base on the bed at (3, 4) whose x, up-stream, points west: the flume's stream goes east.
    let base = Pose::level(Vector3::new(3.0, 4.0, -0.2), Heading::from_deg(270.0));
    let tips: Vec<Vector3<f64>> = gantry.tips_W(&base, &at(1.5, 0.25)).collect();
    let want = [(-0.0625, 0.075), (0.0625, 0.075), (0.0, 0.125)];
    for (tip, (north, up)) in tips.iter().zip(want) {
        let want = Vector3::new(1.5, 3.75 + north, -0.2 + up);
        assert!((tip - want).norm() < 1e-12, "{tip} instead of {want}");
    }
    assert!((gantry.head_W(&base, &at(1.5, 0.25)) - tips[2]).norm() < 1e-12);
}

#[test]
fn another_gantry_with_axes_swapped_and_turned_is_understood() {
    let frame = parse(OTHER).expect("another gantry");
    let [bridge, cart] = &frame.slides;
    assert_eq!((bridge.joint.as_str(), bridge.axis, bridge.sign), ("bridge_slide", 1, -1.0));
    assert_eq!((cart.joint.as_str(), cart.axis, cart.sign), ("cart_slide", 0, -1.0));
    assert_eq!((bridge.mass_kg, cart.mass_kg), (9.5, 2.0));
    assert!((frame.head_B - Vector3::new(0.2, 0.0, 0.4)).norm() < 1e-9);
    // Turned by a quarter, x of the stalk points to the left.
    let tip = frame.probes[0].offset_m;
    assert!((tip - Vector3::new(0.0, 0.04, -0.3)).norm() < 1e-6, "{tip}");
    assert_eq!(frame.base_shapes.len(), 1);

    let files = InMemory::default().with("other.urdf", OTHER.as_bytes());
    let spec = GantrySpec::CrabGantry(CrabGantrySpec { urdf: Some("other.urdf".into()), ..CrabGantrySpec::default() });
    let gantry = Gantry::load(&spec, &files).expect("another gantry");
    let layout = gantry.layout(20.0, [-5.0, 5.0]);
    assert_eq!(layout.travel_m, [[-3.0, 1.0], [-0.6, 0.2]]);
    assert_eq!(layout.max_speed_m_s, [0.3, 0.2]);
    let base = Pose::level(Vector3::zeros(), Heading::from_deg(90.0));
    let body = gantry.body_spec("g", &base, Vector2::new(-2.0, 0.1)).expect("inside");
    assert_eq!(body.start_m, [-0.1, 2.0]);
    let head = gantry.head_W(&base, &at(-0.1, 2.0));
    assert!((head - Vector3::new(-1.8, 0.1, 0.4)).norm() < 1e-9, "{head}");
    let error = gantry.body_spec("g", &base, Vector2::new(0.0, 0.3)).expect_err("outside");
    assert_eq!(error.to_string(), "start.left_m: must be from -0.6 to 0.2 m, got 0.3");
}

/// What every reader of a URDF refuses, `urdf_tests` holds; a row of each sort shows that a gantry's does, too.
#[test]
fn what_is_no_gantry_is_told() {
    const ACROSS: &str = "name=\"across_stream\" type=\"prismatic\"";
    const AXIS: &str = "<axis xyz=\"0 1 0\"/>";
    const MASS: &str = "<mass value=\"4\"/>";
    let across = |kind: &str| ACROSS.replace("prismatic", kind);
    let limit = |from: &str, to: &str| FIRST.replace(from, to);
    let inertia = "<inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/>";
    let light = format!("<link name=\"probe_left\"><inertial><mass value=\"-1\"/>{inertia}</inertial>");
    let more = |i| {
        let ends = format!("<parent link=\"head\"/><child link=\"probe_{i}\"/>");
        format!("<link name=\"probe_{i}\"/><joint name=\"j{i}\" type=\"fixed\">{ends}</joint>")
    };
    let more = (0..6).map(more).collect::<String>() + "</robot>";
    let (joints, first) =
        ("two joints must be prismatic, one on the base and one on the first; ", "joint \"along_stream\"");
    for (from, to, wanted) in [
        ("</robot>", "", "not a URDF file: ".to_string()),
        ("<link name=\"base\"/>", "<link name=\"base\"/><link name=\"beam\"/>", "link \"beam\" occurs twice".into()),
        (
            "<box size=\"0.1 1.25 0.1\"/>",
            "<mesh filename=\"beam.stl\"/>",
            "link \"beam\", collision 1: mesh \"beam.stl\": there is no such file".into(),
        ),
        (ACROSS, &across("fixed"), format!("{joints}1 are: \"along_stream\"")),
        (
            "name=\"left_mount\" type=\"fixed\"",
            "name=\"left_mount\" type=\"prismatic\"",
            format!("{joints}3 are: \"along_stream\", \"across_stream\", \"left_mount\""),
        ),
        (ACROSS, &across("revolute"), "joint \"across_stream\" is revolute, but a gantry's joints are".into()),
        (
            "<parent link=\"beam\"/>",
            "<parent link=\"base\"/>",
            format!("joint \"across_stream\" is not carried by {first}: the base must carry one slide"),
        ),
        (AXIS, "<axis xyz=\"1 0 0\"/>", "joints \"along_stream\" and \"across_stream\" are parallel".into()),
        (
            AXIS,
            "<axis xyz=\"0 1 1\"/>",
            "joint \"across_stream\": its axis must lie along x or y of the base, but points to 0.0000 0.7071".into(),
        ),
        (AXIS, "<axis xyz=\"0 0 0\"/>", "joint \"across_stream\": <axis> must have a length > 0, got 0 0 0".into()),
        (FIRST, "", format!("{first} has no <limit>")),
        (
            FIRST,
            &limit("upper=\"2\"", "upper=\"-2\""),
            format!("{first}, limit: lower must be less than upper, got 0 and -2"),
        ),
        (
            FIRST,
            &limit("upper=\"2\"", "upper=\"NaN\""),
            format!("{first}, limit: lower must be less than upper, got 0 and NaN"),
        ),
        (FIRST, &limit("0.15", "0"), format!("{first}, limit: velocity must be > 0 m/s, got 0")),
        (FIRST, &limit("200", "-1"), format!("{first}, limit: effort must be > 0 N, got -1")),
        (MASS, "<mass value=\"0\"/>", "link \"head\": <mass> must be > 0 kg, got 0".into()),
        (MASS, "<mass value=\"NaN\"/>", "link \"head\": <mass> must be > 0 kg, got NaN".into()),
        ("<link name=\"probe_left\">", &light, "link \"probe_left\": <mass> must be >= 0 kg, got -1".into()),
        (
            "<parent link=\"head\"/>\n    <child link=\"probe_left\"/>",
            "<parent link=\"beam\"/>\n    <child link=\"probe_left\"/>",
            "link \"probe_left\" is a probe, but not fixed to the head \"head\"".into(),
        ),
        ("</robot>", &more, "9 probes, but at most 8 are possible".into()),
    ] {
        let said = said(from, to);
        assert!(said.starts_with(&wanted), "{said}, not {wanted}");
    }
    let none = parse(&GOOD.replace("probe_", "sensor_")).expect_err("no probe");
    assert!(
        none.contains("no probe: no link whose name begins with \"probe_\" is fixed to the head \"head\""),
        "{none}"
    );
}

#[test]
fn drives_that_cannot_do_it_are_told() {
    let told = |spec: CrabGantrySpec| {
        let spec = GantrySpec::CrabGantry(spec);
        let error = Gantry::load(&spec, &InMemory::default()).expect_err("cannot be");
        error.to_string()
    };
    let base = CrabGantrySpec::default;
    assert_eq!(
        told(CrabGantrySpec { acceleration_m_s2: Positive::new(10.0), ..base() }),
        "acceleration_m_s2: must be at most 8.333333333333334 m/s2, got 10: joint \"along_stream\" has 200 N for 24 kg"
    );
    assert_eq!(
        told(CrabGantrySpec { encoder_m: Positive::new(0.001), ..base() }),
        "settle_m: must be at least encoder_m, 0.001 m, got 0.0002: the encoder cannot resolve less"
    );
    let gantry = Gantry::load(&GantrySpec::default(), &InMemory::default()).expect("built in");
    gantry.check_step(0.02).expect("a usual step");
    let error = gantry.check_step(0.1).expect_err("too long");
    assert_eq!(error.to_string(), "position_gain_per_s: must be at most 5 1/s at a step of 0.1 s, got 10");
}

#[test]
fn probes_are_taken_off_and_moved_apart() {
    let layout = |without: &[&str], span_m: Option<f64>| {
        let without = without.iter().map(ToString::to_string).collect();
        let spec = CrabGantrySpec { without, span_m: span_m.map(Positive::new), ..CrabGantrySpec::default() };
        let gantry = Gantry::load(&GantrySpec::CrabGantry(spec), &InMemory::default());
        gantry.map(|g| g.layout(20.0, [-5.0, 5.0]).probes).map_err(|e| e.to_string())
    };
    let before = layout(&[], None).unwrap();
    let wide = layout(&["probe_centre"], Some(0.2)).unwrap();
    assert_eq!(wide.len(), 2);
    assert!((wide[0].offset_m.y - 0.1).abs() < 1e-12 && (wide[1].offset_m.y + 0.1).abs() < 1e-12);
    assert_eq!(wide[0].offset_m.xz(), before[0].offset_m.xz());
    assert_eq!(layout(&["probe_left", "probe_right"], None).unwrap(), before[2..]);
    for (without, span_m, said) in [
        (vec!["antennule"], None, "without[0]: there is no probe \"antennule\"; there are: probe_left, probe_right"),
        (vec!["probe_left", "probe_right", "probe_centre"], None, "without: takes off every probe"),
        (vec!["probe_left", "probe_right"], Some(0.1), "span_m: needs two probes"),
    ] {
        let error = layout(&without, span_m).expect_err(said);
        assert!(error.starts_with(said), "{error}");
    }
}
