//! The reference says what the reader does, and the files in `docs` are up to date.

use super::read::{Reference, Shape};
use super::{explain, json_schema, markdown, path, schema};
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Compares a file of `docs` with what is made now. `RHEOTAXIS_BLESS=1` writes it.
fn is_up_to_date(name: &str, made: &str, how: &str) {
    let file = root().join("docs").join(name);
    if std::env::var_os("RHEOTAXIS_BLESS").is_some() {
        fs::write(&file, made).unwrap();
    }
    let stored = fs::read_to_string(&file).unwrap_or_default();
    let differs = stored.lines().zip(made.lines()).position(|(a, b)| a != b);
    assert!(
        stored == made,
        "docs/{name} is out of date (first different line: {}): write it anew with `{how}`",
        differs.map_or(stored.lines().count().min(made.lines().count()), |i| i + 1)
    );
}

#[test]
fn the_reference_in_docs_is_up_to_date() {
    is_up_to_date(
        "reference.md",
        &markdown(),
        "rheotaxis explain --markdown > docs/reference.md",
    );
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
fn the_schema_in_docs_is_up_to_date() {
    let how = "rheotaxis explain --json-schema > docs/scenario.schema.json";
    is_up_to_date("scenario.schema.json", &json_schema(), how);
}

#[test]
fn a_place_says_unit_range_default_meaning_and_source() {
    let text = explain("robots[0].strategy.Amp.reacquire.Bowtie.lead_m").unwrap();
    for part in [
        "robots[].strategy.Amp.reacquire.Bowtie.lead_m\n",
        "value    m, ",
        "default  10\n",
        "Pang 2009, section 5.5",
    ] {
        assert!(text.contains(part), "no {part:?} in\n{text}");
    }
    let text = explain("water.density_kg_m3").unwrap();
    assert!(
        text.contains("value    kg/m3, 900 to 1400\n  default  1026\n"),
        "{text}"
    );
}

#[test]
fn names_of_variants_and_numbers_of_elements_may_be_left_out() {
    let long = explain("robots[3].strategy.Amp.reacquire").unwrap();
    assert_eq!(explain("robots.strategy.reacquire").unwrap(), long);
    assert!(
        long.contains("default  Bowtie(…)") && long.contains("\n  Cloverleaf(…)\n"),
        "{long}"
    );
    let several = explain("robots.strategy.speed_m_s").unwrap();
    assert!(several.starts_with("6 places"), "{several}");
    // A type within itself has no end, and needs none.
    assert!(explain("robots.strategy.Subregions.search.Subregions.search.Amp.find").is_ok());
}

#[test]
fn the_top_shows_every_block() {
    let text = explain("").unwrap();
    for block in [
        "version",
        "area",
        "water",
        "robots[]",
        "gantries[]",
        "time",
        "record",
    ] {
        assert!(
            text.contains(&format!("\n  {block}: ")),
            "no {block} in\n{text}"
        );
    }
}

#[test]
fn an_unknown_path_says_the_nearest_ones() {
    let near = |path: &str| explain(path).unwrap_err().near;
    assert_eq!(near("watr"), ["water"]);
    assert_eq!(
        near("robots[0].strategy.reaquire")[0],
        "robots[].strategy.Amp.reacquire"
    );
    assert_eq!(
        near("robots.half_width_m")[0],
        "robots[].strategy.Amp.reacquire.Bowtie.half_width_m"
    );
    assert_eq!(near("time.xyzxyz")[0], "time.step_s");
    let said = explain("area.lenght_m").unwrap_err();
    assert_eq!(said.near, ["area.length_m"]);
    assert_eq!(said.within, "area");
}

#[test]
fn every_path_it_names_leads_somewhere() {
    let r = Reference::of(&schema::schema());
    let all = path::all(&r);
    assert!(all.len() > 500, "{}", all.len());
    for (path, _) in all {
        assert!(path::find(&r, &path).is_ok(), "{path}");
    }
}

#[test]
fn everything_is_said_what_it_is() {
    let r = Reference::of(&schema::schema());
    for (of, named) in &r.types {
        assert!(!named.what.is_empty(), "{of}");
        match &named.shape {
            Shape::Fields(fields) => {
                for f in fields {
                    assert!(!f.what.is_empty(), "{of}.{}", f.name);
                    assert!(
                        f.required || f.default.is_some(),
                        "{of}.{} lost its default",
                        f.name
                    );
                }
            }
            Shape::Choice(variants) => {
                assert!(variants.iter().all(|v| !v.what.is_empty()), "{of}");
            }
            _ => {}
        }
        let number = of.chars().last().is_some_and(|c| c.is_ascii_digit());
        assert!(
            !number,
            "two types are called {of}: give one another name with #[schemars(rename)]"
        );
    }
}

#[test]
fn algorithms_have_their_sources() {
    let r = Reference::of(&schema::schema());
    for choice in [
        "strategy",
        "strategy.Amp.reacquire",
        "strategy.Amp.declare",
        "map",
        "estimator",
        "vehicle",
    ] {
        let places = path::find(&r, &format!("robots.{choice}")).unwrap();
        let Some(Shape::Choice(variants)) = places[0].shape().map(|s| r.resolved(s)) else {
            panic!("{choice} is no choice");
        };
        assert!(variants.iter().all(|v| v.source.is_some()), "{choice}");
    }
}

/// Without its twin a limit would be kept by the reader and unknown to the reference.
#[test]
fn every_limit_of_the_reader_stands_in_the_schema() {
    let mut limits = 0;
    for folder in [
        "world/src",
        "plumes/src",
        "robots/src",
        "scenarios/simulation/src",
    ] {
        let mut open = vec![root().join(folder)];
        while let Some(path) = open.pop() {
            if path.is_dir() {
                open.extend(fs::read_dir(&path).unwrap().map(|e| e.unwrap().path()));
            } else if path.extension().is_some_and(|e| e == "rs") {
                limits += twins(&path);
            }
        }
    }
    assert!(limits > 80, "found only {limits}");
}

/// Counts the limits of a file; each has its twin among the attributes of the same field.
fn twins(file: &Path) -> usize {
    let text = fs::read_to_string(file).unwrap();
    let (reads, shows) = ("deserialize_with = \"", "schemars(transform = ");
    let mut limits = 0;
    // From one field's end to the next: attributes and the field itself.
    for field in text.split_inclusive(",\n    ") {
        let code = || field.lines().filter(|l| !l.trim_start().starts_with("//"));
        let named = |mark: &str, path: &str| -> Vec<String> {
            let rest = code().filter_map(|l| l.split_once(mark).map(|(_, rest)| rest));
            let name = |rest: &str| {
                let (_, name) = rest.split_once(path)?;
                Some(
                    name.split(|c: char| !c.is_alphanumeric() && c != '_')
                        .next()?
                        .to_string(),
                )
            };
            rest.filter_map(name).collect()
        };
        let (read, shown) = (named(reads, "limits::"), named(shows, "limits::schema::"));
        if file.ends_with("explain/tests.rs") {
            continue;
        }
        assert_eq!(
            read,
            shown,
            "{}: a limit without its twin:\n{field}",
            file.display()
        );
        limits += read.len();
    }
    limits
}
