//! What cannot be a vehicle is refused with file and element; what is doubtful is told; forces that no step can follow
//! end in an error, never in numbers that are none.

use super::kit::{changed, folder, load, with};
use crate::common::{self, Ended, says};
use rheotaxis::scenario::FolderFiles;
use robots::vehicles::{ShippedVehicle, Vehicle, VehicleSpec};
use std::path::Path;
use tempfile::TempDir;

/// The LAUV with its texts changed: what is told of it.
#[track_caller]
fn doubts(ron: &[(&str, &str)], urdf: &[(&str, &str)]) -> String {
    load(&changed("lauv", ron, urdf)).expect("legal").doubts().join("; ")
}

const ADDED: &str = "added_mass: Diagonal(1, 16, 16, 0.005, 1.3, 1.3)";
const NOT_SYMMETRIC: &str = "added_mass: Full((1, 0, 0, 0, 0, 0), (0, 16, 0, 0, 0, 9), (0, 0, 16, 0, 0, 0), \
    (0, 0, 0, 0.005, 0, 0), (0, 0, 0, 0, 1.3, 0), (0, 0, 0, 0, 0, 1.3))";

#[test]
fn texts_that_no_vehicle_has_are_refused_with_their_field() {
    for (changes, parts) in [
        (
            &[("volume_m3: 0.0", "volume_m3: -0.0"), ("lag_s: 0.05", "lag: 0.05")][..],
            &["hull/vehicle.ron:", "volume_m3", "must be > 0", "lag"][..],
        ),
        (
            &[(ADDED, "added_mass: Diagonal(-18, 16, 16, 0.005, 1.3, 1.3)")],
            &["hydrodynamics.added_mass", "positive in every direction"],
        ),
        (&[(ADDED, NOT_SYMMETRIC)], &["hydrodynamics.added_mass", "must be symmetric", "row 6 column 2"]),
        (
            &[("(2.4, 0, 0, 0, 0, 0)", "(-2.4, 0, 0, 0, 0, 0)")],
            &["hydrodynamics.linear_damping", "got -2.4", "change the signs"],
        ),
        (&[("link: \"propeller\"", "link: \"prop\"")], &["drives[0].link", "\"prop\"", "propeller"]),
        (
            &[("link: \"propeller\"", "link: \"propelar\"")],
            &["drives[0].link", "\"propelar\"", "did you mean `propeller`?"],
        ),
        (&[("Newtons(-50, 50)", "Newtons(5, 50)")], &["drives[0].curve", "thrust <= 0"]),
    ] {
        says(&load(&changed("lauv", changes, &[])).expect_err("it cannot be a vehicle"), parts);
    }
}

/// The first shape of the LAUV's hull.
fn collision() -> &'static str {
    let urdf = ShippedVehicle::named("lauv").expect("shipped").urdf.1;
    let rest = &urdf[urdf.find("<collision").expect("a shape")..];
    &rest[..rest.find("</collision>").expect("its end") + "</collision>".len()]
}

/// A mesh in its place.
fn mesh(file: &str) -> String {
    format!("<collision><geometry><mesh filename=\"{file}\"/></geometry></collision>")
}

#[test]
fn masses_and_links_that_no_body_has_are_refused_with_their_element() {
    let urdf = ShippedVehicle::named("lauv").expect("shipped").urdf.1;
    let attribute = |begin: &str| {
        let rest = urdf.split(begin).nth(1).expect("it is there");
        format!("{begin}{}\"", rest.split('"').next().expect("a number"))
    };
    let (mass, ixx) = (attribute("<mass value=\""), attribute("ixx=\""));
    let links: String = (0..4000).map(|n| format!("<link name=\"l{n}\"/>")).collect();
    let joint = |n: usize| {
        format!("<joint name=\"j{n}\" type=\"fixed\"><parent link=\"l{n}\"/><child link=\"l{}\"/></joint>", n + 1)
    };
    let chain = format!("{links}{}</robot>", (0..3999).map(joint).collect::<String>());
    let [package, model] = ["package://box/hull.stl", "model://box/hull.stl"].map(mesh);
    for (from, to, part) in [
        (mass.as_str(), "<mass value=\"0\"", "no link has a <mass> > 0"),
        (&mass, "<mass value=\"-3\"", "<mass> must be >= 0"),
        (&ixx, "ixx=\"-0.1\"", "<inertia> must be positive"),
        (&ixx, "ixx=\"50\"", "no body has moments of inertia"),
        ("</robot>", &chain, "at most 1000 links"),
        (collision(), &package, "put the file beside the URDF"),
        (collision(), &model, "put the file beside the URDF"),
    ] {
        let refused = load(&changed("lauv", &[], &[(from, to)])).expect_err("it cannot be a vehicle");
        says(&refused, &["hull/lauv.urdf", part]);
    }
}

#[test]
fn frames_without_mass_and_marks_of_the_encoding_are_read_over() {
    let lauv = ShippedVehicle::named("lauv").expect("shipped");
    let frame = "<link name=\"footprint\"/><joint name=\"f\" type=\"fixed\"><parent link=\"footprint\"/>\
                 <child link=\"base_link\"/></joint></robot>";
    let mass = |dir: &TempDir| load(dir).expect("one body").statics().expect("a hull").mass_kg;
    let whole = mass(&changed("lauv", &[], &[]));
    assert_eq!(mass(&changed("lauv", &[], &[("</robot>", frame)])), whole);
    let [vehicle, urdf] = [lauv.file, lauv.urdf.1].map(|t| format!("\u{feff}{}", t.replace('\n', "\r\n")));
    assert_eq!(mass(&folder(&vehicle, (lauv.urdf.0, &urdf))), whole);
}

#[test]
fn a_folder_without_its_files_is_told() {
    let dir = changed("lauv", &[], &[]);
    let said =
        |spec: VehicleSpec| Vehicle::load(&spec, &FolderFiles(dir.path())).expect_err("nothing there").to_string();
    says(&said(VehicleSpec::File("none".into())), &["none/vehicle.ron: ", "No such file"]);
    std::fs::remove_file(dir.path().join("hull/lauv.urdf")).expect("it was there");
    says(&said(VehicleSpec::File("hull".into())), &["hull/lauv.urdf: ", "No such file"]);
    says(&said(VehicleSpec::Shipped("lauf".into())), &["\"lauf\"", "lauv"]);
}

#[test]
fn a_mesh_of_many_triangles_is_refused_before_it_is_read() {
    let dir = changed("lauv", &[], &[(collision(), &mesh("hull.stl"))]);
    // A binary STL begins with 80 bytes and the number of its triangles.
    let mut stl = vec![0u8; 80];
    stl.extend(100_000_000u32.to_le_bytes());
    let file = dir.path().join("hull/hull.stl");
    std::fs::write(&file, &stl).expect("a file");
    says(&load(&dir).expect_err("not a mesh"), &["hull/lauv.urdf", "mesh \"hull.stl\""]);
    // A file as long as so many triangles need, without the disk for it.
    let file = std::fs::File::create(file).expect("a file");
    file.set_len(84 + 50 * 100_000_000).expect("a long file");
    says(&load(&dir).expect_err("too long"), &["hull/lauv.urdf", "mesh \"hull.stl\"", "longer"]);
}

/// Drag ahead and across.
const DRAG: &str = "(2.4, 0, 0, 0, 0, 0),
            (0, 80, 0, 0, 0, -0.3)";

/// The same, so many times too large.
fn drag(times: f64) -> String {
    let [ahead, across] = [2.4 * times, 80.0 * times];
    DRAG.replace("(2.4,", &format!("({ahead},")).replace("80,", &format!("{across},"))
}

#[test]
fn doubts_are_told() {
    const MODEL: &str = "<gazebo><plugin filename=\"libuuv_underwater_object_ros_plugin.so\" name=\"u\">\
        <link name=\"base_link\"><volume>0.0175</volume><hydrodynamic_model><type>fossen</type>\
        <added_mass>1 16 16 0.005 1.3 1.3</added_mass><linear_damping>-2.4 -23 -23 -0.3 -9.7 -9.7</linear_damping>\
        <wobble>3</wobble></hydrodynamic_model></link></plugin></gazebo></robot>";
    assert_eq!(doubts(&[], &[]), "");
    assert_eq!(doubts(&[(DRAG, &drag(10.0))], &[]), "");
    let upside_down = ("centre_of_buoyancy_m: (0, 0, 0.01)", "centre_of_buoyancy_m: (0, 0, -0.01)");
    for (told, parts) in [
        (doubts(&[upside_down], &[]), &["turns over"][..]),
        (doubts(&[("volume_m3: 0.01755", "volume_m3: 0.02755")], &[]), &["it rises"]),
        (doubts(&[], &[("</robot>", MODEL)]), &["which are not used", "from_urdf: true"]),
        (doubts(&[("axes: Frd,", "axes: Frd, from_urdf: true,")], &[("</robot>", MODEL)]), &["wobble"]),
        (doubts(&[(DRAG, &drag(1000.0))], &[]), &["at 1 m/s its motion decays", "units"]),
    ] {
        says(&told, parts);
    }
    // `check` tells them, too.
    let heavy = with(REMUS, &[("31.029385", "31.2")]);
    let dir = tempfile::tempdir().expect("a folder");
    std::fs::write(dir.path().join("auv.urdf"), heavy).expect("a file");
    let dive = common::scenario("remus_dive", &[("robots[0].vehicle.urdf", "\"auv.urdf\"")]);
    common::write(dir.path(), "dive.ron", &dive);
    let told = common::rheotaxis_in(dir.path(), &["check", "dive.ron"]).with(0).err;
    says(&told, &["31.2"]);
}

const REMUS: &str = include_str!("../../../../robots/vehicles/remus100/remus100.urdf");

/// The LAUV with this change as `hull`, a scenario with it, and a table to fly it by.
fn unstable(from: &str, to: &str) -> TempDir {
    let dir = changed("lauv", &[(from, to)], &[]);
    let ahead = common::short("uniform_channel", 1.0, 1.0);
    common::write(dir.path(), "sea.ron", &common::set(ahead, &[("robots[0].vehicle", "File(\"hull\")")]));
    let table = "t_s,propeller,fin_top,fin_bottom,fin_port,fin_starboard\n0,50,0,0,0,0\n";
    std::fs::write(dir.path().join("table.csv"), table).expect("a file");
    dir
}

/// What a command says that fails, on one line.
#[track_caller]
fn fails(dir: &Path, args: &str) -> String {
    let args: Vec<&str> = args.split(' ').collect();
    let Ended { err, .. } = common::rheotaxis_in(dir, &args).with(1);
    assert!(!err.contains("panicked"), "{err}");
    err.split_whitespace().collect::<Vec<_>>().join(" ")
}

const FLY: &str = "vehicle fly hull --table table.csv --lasts-s 1 --velocity 1.5,0,0 --out flown.csv";

/// It is steady at rest, and not at the speed at which it starts.
#[test]
fn damping_that_no_step_follows_is_refused() {
    let dir = unstable(DRAG, &drag(1e6));
    for (args, place) in
        [("check sea.ron", "robots[0].vehicle"), ("run sea.ron --out out", "robots[0].vehicle"), (FLY, "--step-s")]
    {
        says(&fails(dir.path(), args), &["are too long for this hull", place]);
    }
    assert!(!dir.path().join("flown.csv").exists());
}

/// A reaction torque that overflows after some parts of a step.
#[test]
fn a_state_that_is_no_number_is_an_error() {
    let dir = unstable("lag_s: 0.05", "torque_m: 1e18, lag_s: 0.05");
    says(&fails(dir.path(), FLY), &["is not a number"]);
    assert!(!dir.path().join("flown.csv").exists());
    says(&fails(dir.path(), "run sea.ron --quiet --out out"), &["no longer finite"]);
}
