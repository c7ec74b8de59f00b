//! A kind of two things, and a third of somebody else.

use super::{Choice, Listed, Registry, Spec};
use crate::catalogue::Entry;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What the kind's things can do.
trait Shape: Spec {
    fn area(&self) -> f64;
}

macro_rules! shape {
    ($name:ident, $side:ident, $factor:expr) => {
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields, default)]
        struct $name {
            $side: f64,
        }
        impl Default for $name {
            fn default() -> Self {
                Self { $side: 1.0 }
            }
        }
        impl Listed for $name {
            const ENTRY: Entry = Entry { name: stringify!($name), what: "a shape", source: "Euclid" };
        }
        impl Shape for $name {
            fn area(&self) -> f64 {
                $factor * self.$side * self.$side
            }
        }
    };
}
shape!(Square, side, 1.0);
shape!(Circle, radius, 3.0);
shape!(Hexagon, edge, 2.6);

crate::kind! {
    /// Shapes.
    ShapeSpec = Shapes of Shape { heading: "Shapes", rows: [Square, Circle], standard: Circle }
}

fn read(text: &str) -> Result<ShapeSpec, String> {
    serde_json::from_str(text).map_err(|e| e.to_string())
}

#[test]
fn a_choice_is_read_and_written_by_its_name() {
    let text = r#"{"Square":{"side":2.0}}"#;
    let square = read(text).expect("legal");
    assert_eq!((square.name(), square.area()), ("Square", 4.0));
    assert_eq!(serde_json::to_string(&square).expect("plain"), text);
    assert_eq!(square, Choice::new(Square { side: 2.0 }));
    assert_ne!(square, square_of(3.0));
    assert_ne!(square, ShapeSpec::default());
    assert_eq!(square.clone().get::<Square>(), Some(&Square { side: 2.0 }));
    assert_eq!(ShapeSpec::default().name(), "Circle");
    assert_eq!(format!("{square:?}"), "Square(Square { side: 2.0 })");
}

fn square_of(side: f64) -> ShapeSpec {
    ShapeSpec::new(Square { side })
}

#[test]
fn unknown_names_and_fields_are_told_with_the_legal_ones() {
    let unknown = read(r#"{"Hexagon":{}}"#).expect_err("not there");
    assert!(unknown.starts_with("unknown variant `Hexagon`, expected `Square` or `Circle`"));
    let field = read(r#"{"Square":{"radius":2.0}}"#).expect_err("no such field");
    assert!(field.starts_with("unknown field `radius`, expected `side`"));
}

#[test]
fn another_crates_row_is_known_within_its_scope_only() {
    let text = r#"{"Hexagon":{"edge":2.0}}"#;
    let registry = (Registry::default().with::<Shapes, Hexagon>()).expect("a new name");
    let hexagon = registry.scope(|| read(text)).expect("known");
    assert_eq!((hexagon.name(), hexagon.area()), ("Hexagon", 10.4));
    assert!(read(text).is_err());
    assert!(registry.scope(|| Registry::default().scope(|| read(text)).is_err()));
    let names = registry.entries::<Shapes>().into_iter().map(|e| e.name);
    assert_eq!(names.collect::<Vec<_>>(), ["Square", "Circle", "Hexagon"]);
    let twice = registry.with::<Shapes, Hexagon>();
    assert!(twice.is_err_and(|e| e.to_string().contains("there is a `Hexagon` already")));
}

#[test]
fn things_of_any_type_are_carried_in_their_order() {
    let registry = Registry::default().carrying(1_u8).carrying("a").carrying(2_u8);
    assert_eq!(registry.carried::<u8>().collect::<Vec<_>>(), [&1, &2]);
    assert_eq!(registry.carried::<&str>().count(), 1);
    assert_eq!(registry, registry.clone());
    assert_ne!(registry, Registry::default());
    assert_ne!(registry, registry.clone().carrying(3_u8));
}
