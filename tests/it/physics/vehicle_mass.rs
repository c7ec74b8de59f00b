//! A URDF whose mass is not quite that of the hydrodynamic parameters: `check` says what becomes of it.

use rheotaxis::scenario::{check, parse, template};

#[test]
fn check_tells_that_the_mass_of_a_urdf_is_used() {
    let built_in = include_str!("../../../robots/vehicles/remus100/remus100.urdf");
    let dir = std::env::temp_dir().join(format!("rheotaxis-mass-{}", std::process::id()));
    std::fs::create_dir_all(&dir).unwrap();
    let text = template("remus_dive").expect("in the catalogue").text;
    let text = text.replace("Remus100()", "Remus100(urdf: \"auv.urdf\")");
    let told = |mass: &str| {
        let urdf = built_in.replace("value=\"31.029385\"", &format!("value=\"{mass}\""));
        std::fs::write(dir.join("auv.urdf"), urdf).unwrap();
        let scenario = parse("mass", &text).unwrap_or_else(|e| panic!("{:?}", e.lines()));
        let found = check(&scenario, &dir).into_iter();
        let of_mass: Vec<_> = found.filter(|f| f.path == "robots[0].vehicle.urdf").map(|f| f.message).collect();
        of_mass
    };
    assert_eq!(told("31.029385"), [""; 0]);
    let heavy = told("31.2");
    assert_eq!(heavy.len(), 1, "{heavy:?}");
    assert!(heavy[0].starts_with("weighs 31.2 kg by its URDF, "), "{heavy:?}");
    assert!(heavy[0].ends_with("1.67 N heavier than water of 1026 kg/m3, it sinks"), "{heavy:?}");
    let other = told("40");
    assert!(other[0].contains("<mass> is 40 kg"), "{other:?}");
    std::fs::remove_dir_all(&dir).unwrap();
}
