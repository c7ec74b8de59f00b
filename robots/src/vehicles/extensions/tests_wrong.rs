//! Texts that are refused, texts that hold nothing, and texts made to hang a reader.

use super::read;
use super::tests::{UUV, blocks, with};
use super::tests_gz::GZ;

/// The error when something is replaced.
fn fails(text: &str, from: &str, to: &str) -> String {
    read(&with(text, from, to)).expect_err("this is wrong")
}

#[test]
fn a_text_without_extension_has_none() {
    for text in [
        "",
        "hello",
        "<!DOCTYPE robot><robot/>",
        "<robot><gazebo><plugin filename='libother.so'/></gazebo></robot>",
        // Not where simulators look.
        "<robot><plugin filename='libuuv_underwater_object_plugin.so'/></robot>",
        "<robot><!-- uuv_underwater_object --><gazebo/></robot>",
        "<robot xmlns:xacro='http://www.ros.org/wiki/xacro'/>",
    ] {
        assert_eq!(read(text), Ok(None), "{text}");
    }
    for urdf in ["vehicles/remus100/remus100.urdf", "urdf/crab_gantry.urdf"] {
        let path = format!("{}/{urdf}", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).expect("built in");
        assert_eq!(read(&text), Ok(None), "{urdf}");
    }
}

#[test]
fn numbers_are_checked() {
    let six = "-1 -2 -3 -4 -5 -6";
    let long = format!("-1 -2 -3 -4 -5 -6.{}", "0".repeat(70));
    let too_long = format!("\"-6.{}\" is no number of at most 64 characters", "0".repeat(70));
    for (to, why) in [
        ("-1 -2 -3 -4 -5 -6 -7", "needs 6 or 36 numbers, got 7"),
        ("", "needs 6 or 36 numbers, got 0"),
        ("-1 -2 -3 -4 -5 six", "\"six\" is not a number"),
        ("-1,-2,-3,-4,-5,-6", "\"-1,-2,-3,-4,-5,-6\" is not a number"),
        ("-1 -2 -3 -4 -5 nan", "must be from -1e12 to 1e12, got nan"),
        ("-1 -2 -3 -4 -5 -inf", "must be from -1e12 to 1e12, got -inf"),
        ("-1 -2 -3 -4 -5 1e999", "must be from -1e12 to 1e12, got 1e999"),
        (&long, &too_long),
        ("${-1 * a} -2 -3 -4 -5 -6", "\"${-1 * a} -2 -3 -4 -5 -6\" is for xacro: run xacro first"),
        ("$(arg d)", "\"$(arg d)\" is for xacro: run xacro first"),
    ] {
        let error = format!("line 28, <linear_damping>: {why}");
        assert_eq!(fails(UUV, six, to), error);
    }
    for (from, to, error) in [
        ("0.031", "0", "line 11, <volume>: must be > 0, got 0"),
        ("0.031", "1 2", "line 11, <volume>: needs 1 number, got 2"),
        ("1025.0", "-1", "line 6, <fluid_density>: must be > 0, got -1"),
        ("0.01 -0.02 0.03", "0.01", "line 17, <center_of_buoyancy>: needs 3 numbers, got 1"),
        (
            "<neutrally_buoyant>0",
            "<neutrally_buoyant>maybe",
            "line 10, <neutrally_buoyant>: must be true or false, got \"maybe\"",
        ),
    ] {
        assert_eq!(fails(UUV, from, to), error);
    }
    assert_eq!(fails(GZ, "<xU>-1.5", "<xU>"), "line 17, <xU>: needs 1 number, got 0");
    assert_eq!(fails(GZ, ">1025<", ">0<"), "line 8, <water_density>: must be > 0, got 0");
}

#[test]
fn what_is_missing_double_or_not_supported_is_told() {
    let volume = "<volume>0.031</volume>";
    let base = "<link name=\"fish/base_link\">";
    let fossen = "<type>fossen</type>";
    let plugin = "<plugin\n        filename";
    let other = "<plugin filename='gz-sim-hydrodynamics-system'><link_name>a</link_name><xU>-1</xU></plugin>";
    let second = &format!("{other}\n{plugin}");
    let other_simulator = "<gazebo><plugin filename='gz-sim-hydrodynamics-system'/></gazebo></robot>";
    for (text, from, to, error) in [
        (
            UUV,
            volume,
            "<volume>1</volume>\n<volume>2</volume>",
            "line 12, <volume>: occurs twice; the first is on line 11",
        ),
        (UUV, base, "<link>", "line 9, <link>: attribute \"name\" is missing"),
        (UUV, base, "<link name=' '>", "line 9, <link>: its name is empty"),
        (
            UUV,
            base,
            "<link name=\"${n}/base_link\">",
            "line 9, <link>: \"${n}/base_link\" is for xacro: run xacro first",
        ),
        (
            UUV,
            base,
            "<link name='a'><hydrodynamic_model/></link><link name='b'>",
            "line 9, <link>: has a <hydrodynamic_model>, and so has the link on line 9: a vehicle can have one",
        ),
        (
            UUV,
            fossen,
            "<type>sphere</type>",
            "line 19, <type>: \"sphere\" computes coefficients from a shape, which is",
        ),
        (UUV, fossen, "<type>box</type>", "line 19, <type>: \"box\" computes coefficients from a shape, which is"),
        (UUV, fossen, "<type>cube</type>", "line 19, <type>: \"cube\" is not a type of uuv_simulator: only"),
        (UUV, fossen, "", "line 18, <hydrodynamic_model>: <type> is missing"),
        (UUV, "</robot>", other_simulator, "there is a plugin of uuv_simulator on line 5 and one of gz-sim on line 42"),
        (GZ, "<link_name>base_link</link_name>", "", "line 4, <plugin>: <link_name> is missing"),
        (GZ, ">base_link<", "><", "line 7, <link_name>: is empty"),
        (GZ, "<nV>3</nV>", "<xU>3</xU>", "line 18, <xU>: occurs twice; the first is on line 17"),
        (
            GZ,
            "<mDotQ>-4",
            "<mDotQ>4",
            "line 4, <plugin>: added mass is positive in M_q = 4 but negative in X_u = -1, Y_v = -30, Z_w = -31,",
        ),
        (
            GZ,
            "<yRabsR>6</yRabsR>",
            "<yRabsV>6</yRabsV>",
            "line 21, <yRabsV>: products of one speed and the amount of another",
        ),
        (GZ, "<yUV>-7</yUV>", "<yVR>-7</yVR>", "line 22, <yVR>: products of two speeds are supported only if one is U"),
        (
            GZ,
            plugin,
            second,
            "line 5, <plugin>: has coefficients, and so has the plugin on line 4: a vehicle can have one",
        ),
    ] {
        let said = fails(text, from, to);
        assert!(said.starts_with(error), "{said}");
    }
    for (file, error) in [
        ("libuuv_underwater_object_ros_plugin.so", "line 1, <plugin>: has no <link> with a <hydrodynamic_model>"),
        ("gz-sim-hydrodynamics-system", "line 1, <plugin>: has no coefficient, such as <xDotU> or <xU>"),
    ] {
        let empty = format!("<robot><gazebo><plugin filename='{file}'/></gazebo></robot>");
        assert_eq!(read(&empty), Err(error.into()));
    }
}

#[test]
fn xacro_has_to_be_run() {
    assert_eq!(
        fails(UUV, "<debug>0</debug>", "<xacro:hydro name='a'/>"),
        "line 8, <xacro:hydro>: is for xacro: run xacro first"
    );
    // Also where it hides the whole extension.
    let text = "<robot xmlns:xacro='http://ros.org/wiki/xacro'>\n<xacro:include filename='a.xacro'/></robot>";
    assert_eq!(read(text), Err("line 2, <xacro:include>: is for xacro: run xacro first".into()));
}

#[test]
fn what_is_no_xml_is_told() {
    let error = fails(UUV, "</gazebo>", "</gazelle>");
    assert_eq!(error, "line 41: not XML: expected 'gazebo' tag, not 'gazelle' at 41:3");
    let types = "<!DOCTYPE robot [<!ENTITY a 'b'>]><robot name=\"fish\">";
    assert_eq!(fails(GZ, "<robot name=\"fish\">", types), "a document type (<!DOCTYPE ...>) is not read: remove it");
    for end in 0..UUV.len() {
        let _ = read(&UUV[..end]);
    }
    for end in 0..GZ.len() {
        let _ = read(&GZ[..end]);
    }
}

#[test]
fn made_to_hang_is_refused_soon() {
    let mention = "<!-- uuv_underwater_object -->";
    let deep = format!("{mention}{}{}", "<a>".repeat(200_000), "</a>".repeat(200_000));
    assert_eq!(read(&deep), Ok(None));
    let wide = format!("{mention}<a>{}</a>", "<b/>".repeat(600_000));
    assert_eq!(read(&wide), Err("has more than 500000 elements and texts".into()));
    let mut attributes = String::new();
    for i in 0..300_000 {
        attributes.push_str(&format!(" a{i}=''"));
    }
    assert_eq!(read(&format!("{mention}\n<a{attributes}/>")), Err("line 2: a tag has more than 200 attributes".into()));
    let mut namespaces = String::new();
    for i in 0..60_000 {
        namespaces.push_str(&format!("<a xmlns:b{i}='c{i}'>"));
    }
    assert_eq!(read(&format!("{mention}{namespaces}")), Err("\"xmlns\" occurs more than 100 times".into()));
    // Signs in comments are no attributes.
    let comment = format!("<!--{}-->\n</robot>", "=".repeat(1000));
    assert_eq!(blocks(&with(UUV, "</robot>", &comment)), blocks(UUV));
}

#[test]
fn a_flood_of_doubts_is_cut() {
    let many = "<debug>0</debug>".to_string() + &"<odd/>".repeat(80_000);
    let told = blocks(&with(UUV, "<debug>0</debug>", &many)).doubts;
    assert_eq!(told.len(), 51);
    assert_eq!(told[50], "and 79950 more");
}
