//! The reference says what the reader does. That its page in `docs` is up to date is a test of the command.

use super::{Unknown, path};
use crate::shape::Reference;
use crate::shape::Shape;
use world::registry::Registry;

fn explain(path: &str) -> Result<String, Unknown> {
    super::explain(&Registry::default(), path, &[])
}

fn markdown() -> String {
    super::markdown(&Registry::default(), &[])
}

fn reference() -> Reference {
    super::reference(&Registry::default(), &[])
}

#[test]
fn prose_of_the_reference_fits_on_its_lines() {
    for line in markdown().lines().filter(|l| !l.starts_with('|')) {
        assert!(line.chars().count() <= 120, "{line}");
    }
}

#[test]
fn a_place_says_what_it_is_for_unit_range_default_and_source() {
    let bowtie = "robots[0].strategy.Amp.reacquire.Bowtie.lead_m";
    for (place, parts) in [
        // A kind without rows says so.
        ("apparatus", ["None comes with the program."].as_slice()),
        ("robots.strategy.Amp.reacquire", &["search around the last detections"]),
        (bowtie, &["robots[].strategy.Amp.reacquire.Bowtie.lead_m\n", "value    m, "]),
        (bowtie, &["default  10\n", "Pang 2009, section 5.5"]),
        ("water.density_kg_m3", &["value    kg/m3, 900 to 1400\n  default  1026\n"]),
        // The top shows every block.
        ("", &["\n  version: ", "\n  area: ", "\n  water: ", "\n  robots[]: "]),
        ("", &["\n  gantries[]: ", "\n  time: ", "\n  record: "]),
        // A vehicle is explained as a scenario is.
        ("vehicle", &["vehicle\n", "\n  urdf: text; must be given", "\n  drives[]: "]),
        ("vehicle.hydrodynamics.density_kg_m3", &["value    kg/m3, > 0\n  default  10"]),
        ("vehicle.drives[0].Fin.limit_deg", &["value    degrees, > 0 to 90\n"]),
    ] {
        let text = explain(place).unwrap();
        for part in parts {
            assert!(text.contains(part), "no {part:?} in\n{text}");
        }
    }
    assert!(markdown().contains("None comes with the program."));
    assert!(!explain("vehicle").unwrap().contains("\n  default  "), "a file is no field");
}

#[test]
fn names_of_variants_and_numbers_of_elements_may_be_left_out() {
    let long = explain("robots[3].strategy.Amp.reacquire").unwrap();
    assert_eq!(explain("robots.strategy.reacquire").unwrap(), long);
    assert!(long.contains("default  Bowtie(…)") && long.contains("\n  Cloverleaf(…)\n"), "{long}");
    let several = explain("robots.strategy.speed_m_s").unwrap();
    assert!(several.starts_with("7 places"), "{several}");
    // A type within itself has no end, and needs none.
    assert!(explain("robots.strategy.Subregions.search.Subregions.search.Amp.find").is_ok());
}

#[test]
fn the_first_word_leads_to_a_file_and_never_to_a_block_of_a_scenario() {
    let r = reference();
    let Shape::Fields(blocks) = &r.root else {
        panic!("a scenario has fields");
    };
    assert!(blocks.iter().all(|b| r.files.iter().all(|f| f.name != b.name)));
}

#[test]
fn an_unknown_path_says_the_nearest_ones() {
    for (path, nearest) in [
        ("watr", "water"),
        ("robots[0].strategy.reaquire", "robots[].strategy.Amp.reacquire"),
        ("robots.half_width_m", "robots[].strategy.Amp.reacquire.Bowtie.half_width_m"),
        ("time.xyzxyz", "time.step_s"),
        ("area.lenght_m", "area.length_m"),
        ("vehicle.hydrodynamics.volum_m3", "vehicle.hydrodynamics.volume_m3"),
    ] {
        assert_eq!(explain(path).unwrap_err().near[0], nearest);
    }
    let said = explain("area.lenght_m").unwrap_err();
    assert_eq!((said.near.len(), said.within.as_str()), (1, "area"));
}

#[test]
fn every_path_it_names_leads_somewhere() {
    let r = reference();
    let all = path::all(&r);
    assert!(all.len() > 500, "{}", all.len());
    for (path, _) in all {
        assert!(path::find(&r, &path).is_ok(), "{path}");
    }
}

#[test]
fn everything_is_said_what_it_is() {
    let r = reference();
    for (of, named) in &r.types {
        assert!(!named.what.is_empty(), "{of}");
        match &named.shape {
            Shape::Fields(fields) => {
                for f in fields {
                    assert!(!f.what.is_empty(), "{of}.{}", f.name);
                    assert!(f.required || f.default.is_some(), "{of}.{} lost its default", f.name);
                }
            }
            Shape::Choice(variants) => {
                assert!(variants.iter().all(|v| !v.what.is_empty()), "{of}");
            }
            _ => {}
        }
        let number = of.chars().last().is_some_and(|c| c.is_ascii_digit());
        assert!(!number, "two types are called {of}: give one another name with #[schemars(rename)]");
    }
}

#[test]
fn algorithms_have_their_sources() {
    let r = reference();
    for choice in ["strategy", "strategy.Amp.reacquire", "strategy.Amp.declare", "map", "estimator", "vehicle"] {
        let places = path::find(&r, &format!("robots.{choice}")).unwrap();
        let Some(Shape::Choice(variants)) = places[0].shape().map(|s| r.resolved(s)) else {
            panic!("{choice} is no choice");
        };
        assert!(variants.iter().all(|v| v.source.is_some()), "{choice}");
    }
}
