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
fn a_kind_without_rows_says_so() {
    let none = "None comes with the program.";
    assert!(explain("apparatus").unwrap().contains(none));
    assert!(markdown().contains(none));
}

#[test]
fn a_kind_says_what_it_is_for() {
    let text = explain("robots.strategy.Amp.reacquire").unwrap();
    assert!(text.contains("search around the last detections"), "{text}");
}

#[test]
fn a_place_says_unit_range_default_meaning_and_source() {
    let text = explain("robots[0].strategy.Amp.reacquire.Bowtie.lead_m").unwrap();
    for part in
        ["robots[].strategy.Amp.reacquire.Bowtie.lead_m\n", "value    m, ", "default  10\n", "Pang 2009, section 5.5"]
    {
        assert!(text.contains(part), "no {part:?} in\n{text}");
    }
    let text = explain("water.density_kg_m3").unwrap();
    assert!(text.contains("value    kg/m3, 900 to 1400\n  default  1026\n"), "{text}");
}

#[test]
fn names_of_variants_and_numbers_of_elements_may_be_left_out() {
    let long = explain("robots[3].strategy.Amp.reacquire").unwrap();
    assert_eq!(explain("robots.strategy.reacquire").unwrap(), long);
    assert!(long.contains("default  Bowtie(…)") && long.contains("\n  Cloverleaf(…)\n"), "{long}");
    let several = explain("robots.strategy.speed_m_s").unwrap();
    assert!(several.starts_with("6 places"), "{several}");
    // A type within itself has no end, and needs none.
    assert!(explain("robots.strategy.Subregions.search.Subregions.search.Amp.find").is_ok());
}

#[test]
fn the_top_shows_every_block() {
    let text = explain("").unwrap();
    for block in ["version", "area", "water", "robots[]", "gantries[]", "time", "record"] {
        assert!(text.contains(&format!("\n  {block}: ")), "no {block} in\n{text}");
    }
}

#[test]
fn a_vehicle_is_explained_as_a_scenario_is() {
    let text = explain("vehicle").unwrap();
    for part in ["vehicle\n", "\n  urdf: text; must be given", "\n  drives[]: "] {
        assert!(text.contains(part), "no {part:?} in\n{text}");
    }
    assert!(!text.contains("\n  default  "), "a file is no field:\n{text}");
    let text = explain("vehicle.hydrodynamics.density_kg_m3").unwrap();
    assert!(text.contains("value    kg/m3, > 0\n  default  10"), "{text}");
    let text = explain("vehicle.drives[0].Fin.limit_deg").unwrap();
    assert!(text.contains("value    degrees, > 0 to 90\n"), "{text}");
    let said = explain("vehicle.hydrodynamics.volum_m3").unwrap_err();
    assert_eq!(said.near, ["vehicle.hydrodynamics.volume_m3"]);
    // The first word leads to the file, never to a block of a scenario.
    let r = reference();
    let Shape::Fields(blocks) = &r.root else {
        panic!("a scenario has fields");
    };
    assert!(blocks.iter().all(|b| r.files.iter().all(|f| f.name != b.name)));
}

#[test]
fn an_unknown_path_says_the_nearest_ones() {
    let near = |path: &str| explain(path).unwrap_err().near;
    assert_eq!(near("watr"), ["water"]);
    assert_eq!(near("robots[0].strategy.reaquire")[0], "robots[].strategy.Amp.reacquire");
    assert_eq!(near("robots.half_width_m")[0], "robots[].strategy.Amp.reacquire.Bowtie.half_width_m");
    assert_eq!(near("time.xyzxyz")[0], "time.step_s");
    let said = explain("area.lenght_m").unwrap_err();
    assert_eq!(said.near, ["area.length_m"]);
    assert_eq!(said.within, "area");
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
