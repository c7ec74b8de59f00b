//! What cannot be a vehicle is refused with file and element; what is doubtful is told.

use rheotaxis::scenario::FolderFiles;
use robots::vehicles::{ShippedVehicle, Vehicle, VehicleSpec};
use std::path::Path;

/// The LAUV's folder with its texts changed: its error, or what is told of it.
fn changed(ron: &[(&str, &str)], urdf: &[(&str, &str)]) -> Result<Vec<String>, String> {
    let lauv = ShippedVehicle::named("lauv").expect("it is shipped");
    let dir = tempfile::tempdir().expect("a folder");
    let with = |text: &str, changes: &[(&str, &str)]| {
        let mut text = text.to_string();
        for (from, to) in changes {
            assert!(text.contains(from), "{from}");
            text = text.replacen(from, to, 1);
        }
        text
    };
    std::fs::create_dir(dir.path().join("my_auv")).expect("a folder");
    let at = |name: &str| dir.path().join("my_auv").join(name);
    std::fs::write(at("vehicle.ron"), with(lauv.file, ron)).expect("a file");
    std::fs::write(at(lauv.urdf.0), with(lauv.urdf.1, urdf)).expect("a file");
    let said = |text: String| text.replace(&dir.path().display().to_string(), "");
    Vehicle::load(&VehicleSpec::File("my_auv".into()), &FolderFiles(dir.path()))
        .map(|craft| craft.doubts().to_vec())
        .map_err(|e| said(e.to_string()))
}

fn refused(ron: &[(&str, &str)], urdf: &[(&str, &str)]) -> String {
    changed(ron, urdf).expect_err("it cannot be a vehicle")
}

fn says(error: &str, parts: &[&str]) {
    for part in parts {
        assert!(error.contains(part), "{part} is not in: {error}");
    }
}

#[test]
fn the_shipped_vehicle_itself_has_no_doubts() {
    assert_eq!(changed(&[], &[]), Ok(Vec::new()));
}

#[test]
fn mistakes_of_form_are_told_with_line_and_column() {
    let error = refused(&[("volume_m3: 0.0", "volume_m3: -0.0"), ("lag_s: 0.05", "lag: 0.05")], &[]);
    says(&error, &["/my_auv/vehicle.ron: ", ":", "volume_m3", "must be > 0", "lag"]);
}

#[test]
fn a_folder_without_its_files_is_told() {
    let dir = tempfile::tempdir().expect("a folder");
    let load = |name: &str| {
        Vehicle::load(&VehicleSpec::File(name.into()), &FolderFiles(dir.path())).expect_err("nothing there").to_string()
    };
    says(&load("none"), &["none/vehicle.ron: ", "No such file"]);
    std::fs::create_dir(dir.path().join("half")).expect("a folder");
    let lauv = ShippedVehicle::named("lauv").expect("it is shipped");
    std::fs::write(dir.path().join("half/vehicle.ron"), lauv.file).expect("a file");
    says(&load("half"), &["half/lauv.urdf: ", "No such file"]);
    let shipped = Vehicle::load(&VehicleSpec::Shipped("lauf".into()), &FolderFiles(Path::new("")));
    says(&shipped.expect_err("no such vehicle").to_string(), &["no vehicle \"lauf\" comes with the program", "lauv"]);
}

#[test]
fn masses_that_no_body_has_are_refused() {
    let urdf = ShippedVehicle::named("lauv").expect("shipped").urdf.1;
    let mass = urdf.split("<mass value=\"").nth(1).expect("a mass");
    let mass = format!("<mass value=\"{}\"", mass.split('"').next().expect("a number"));
    says(&refused(&[], &[(&mass, "<mass value=\"0\"")]), &["my_auv/lauv.urdf", "no link has a <mass> > 0"]);
    says(&refused(&[], &[(&mass, "<mass value=\"-3\"")]), &["<mass> must be >= 0", "-3"]);
    let ixx = urdf.split("ixx=\"").nth(1).expect("an inertia");
    let ixx = format!("ixx=\"{}\"", ixx.split('"').next().expect("a number"));
    says(&refused(&[], &[(&ixx, "ixx=\"-0.1\"")]), &["my_auv/lauv.urdf", "<inertia> must be positive"]);
    says(&refused(&[], &[(&ixx, "ixx=\"50\"")]), &["no body has moments of inertia"]);
}

#[test]
fn hydrodynamics_that_no_hull_has_are_refused() {
    let added = "added_mass: Diagonal(1, 16, 16, 0.005, 1.3, 1.3)";
    says(
        &refused(&[(added, "added_mass: Diagonal(-18, 16, 16, 0.005, 1.3, 1.3)")], &[]),
        &["hydrodynamics.added_mass", "positive in every direction"],
    );
    let rows = "added_mass: Full((1, 0, 0, 0, 0, 0), (0, 16, 0, 0, 0, 9), (0, 0, 16, 0, 0, 0), (0, 0, 0, 0.005, 0, 0), \
                (0, 0, 0, 0, 1.3, 0), (0, 0, 0, 0, 0, 1.3))";
    says(&refused(&[(added, rows)], &[]), &["hydrodynamics.added_mass", "must be symmetric", "row 6 column 2"]);
    says(
        &refused(&[("(2.4, 0, 0, 0, 0, 0)", "(-2.4, 0, 0, 0, 0, 0)")], &[]),
        &["hydrodynamics.linear_damping", "surge must be >= 0, got -2.4", "change the signs"],
    );
}

#[test]
fn drives_on_links_that_are_not_there_are_refused() {
    says(
        &refused(&[("link: \"propeller\"", "link: \"prop\"")], &[]),
        &["drives[0].link", "no link \"prop\" in the URDF", "propeller"],
    );
    says(
        &refused(&[("link: \"propeller\"", "link: \"propelar\"")], &[]),
        &["drives[0].link: no link \"propelar\" in the URDF; did you mean `propeller`? links here: "],
    );
    says(&refused(&[("Newtons(-50, 50)", "Newtons(5, 50)")], &[]), &["drives[0].curve", "thrust <= 0"]);
}

#[test]
fn a_mesh_of_many_triangles_is_refused_before_it_is_read() {
    // A binary STL begins with 80 bytes and the number of its triangles.
    let dir = tempfile::tempdir().expect("a folder");
    let lauv = ShippedVehicle::named("lauv").expect("it is shipped");
    std::fs::create_dir(dir.path().join("my_auv")).expect("a folder");
    let at = |name: &str| dir.path().join("my_auv").join(name);
    let collision = lauv.urdf.1.find("<collision").expect("a shape");
    let geometry = collision + lauv.urdf.1[collision..].find("<geometry>").expect("it");
    let end = geometry + lauv.urdf.1[geometry..].find("</geometry>").expect("its end");
    let mesh = "<geometry><mesh filename=\"hull.stl\"/>";
    let urdf = [&lauv.urdf.1[..geometry], mesh, &lauv.urdf.1[end..]].concat();
    std::fs::write(at("vehicle.ron"), lauv.file).expect("a file");
    std::fs::write(at(lauv.urdf.0), urdf).expect("a file");
    let mut stl = vec![0u8; 80];
    stl.extend(100_000_000u32.to_le_bytes());
    std::fs::write(at("hull.stl"), &stl).expect("a file");
    let error = Vehicle::load(&VehicleSpec::File("my_auv".into()), &FolderFiles(dir.path()))
        .expect_err("not a mesh")
        .to_string();
    says(&error, &["my_auv/lauv.urdf", "mesh \"hull.stl\""]);
    // A file as long as so many triangles need, without the disk for it.
    let file = std::fs::File::create(at("hull.stl")).expect("a file");
    file.set_len(84 + 50 * 100_000_000).expect("a long file");
    let error =
        Vehicle::load(&VehicleSpec::File("my_auv".into()), &FolderFiles(dir.path())).expect_err("too long").to_string();
    says(&error, &["my_auv/lauv.urdf", "mesh \"hull.stl\"", "longer"]);
}

#[test]
fn doubts_are_told() {
    let told = changed(&[("centre_of_buoyancy_m: (0, 0, 0.01)", "centre_of_buoyancy_m: (0, 0, -0.01)")], &[]);
    says(&told.expect("legal").join("; "), &["turns over, or a frame is upside down"]);
    let told = changed(&[("volume_m3: 0.01755", "volume_m3: 0.02755")], &[]);
    says(&told.expect("legal").join("; "), &["it rises"]);
    let model = "<gazebo><plugin filename=\"libuuv_underwater_object_ros_plugin.so\" name=\"u\">\
        <link name=\"base_link\"><volume>0.0175</volume><hydrodynamic_model><type>fossen</type>\
        <added_mass>1 16 16 0.005 1.3 1.3</added_mass><linear_damping>-2.4 -23 -23 -0.3 -9.7 -9.7</linear_damping>\
        <wobble>3</wobble></hydrodynamic_model></link></plugin></gazebo></robot>";
    let told = changed(&[], &[("</robot>", model)]).expect("legal");
    says(&told.join("; "), &["which are not used", "from_urdf: true"]);
    let told = changed(&[("axes: Frd,", "axes: Frd, from_urdf: true,")], &[("</robot>", model)]);
    says(&told.expect("legal").join("; "), &["wobble"]);
}
