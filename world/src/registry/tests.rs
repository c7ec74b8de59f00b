//! A kind of two things, and a third of somebody else.

use super::{Choice, Listed, Registry, Set, Spec};
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
    Registry::default().read(text).map_err(|e| e.message)
}

#[test]
fn a_choice_is_read_and_written_by_its_name() {
    let square = read("Square(side: 2)").expect("legal");
    assert_eq!((square.name(), square.area()), ("Square", 4.0));
    assert_eq!(ron::to_string(&square), Ok("Square((side:2.0))".to_string()));
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
    let unknown = read("Hexagon()").expect_err("not there");
    assert_eq!(unknown, "there is no `Hexagon`; there are: Square, Circle");
    let text = "/* é */ Square( // (\n radius: 2)";
    let found = Registry::default().read::<ShapeSpec>(text).expect_err("no such field");
    assert!(found.message.contains("`radius`") && found.message.contains("`side`"), "{found:?}");
    assert!(text[..found.at.end].ends_with("radius"), "{found:?}");
}

#[test]
fn a_choice_may_stand_in_another() {
    #[derive(Debug, PartialEq, Deserialize)]
    enum Holder {
        One(ShapeSpec),
        Two(ShapeSpec, Option<ShapeSpec>),
    }
    let read = |text: &str| Registry::default().read::<Holder>(text).map_err(|e| e.message);
    let plain = ShapeSpec::new(Square { side: 1.0 });
    for text in ["One(Square())", "One(Square(side: 1))", "One( /* a */ Square ( side: 1, ) , )"] {
        assert_eq!(read(text), Ok(Holder::One(plain.clone())), "{text}");
    }
    for text in ["Two(Square(), Square())", "Two(Square(), Some(Square(side: 1)))"] {
        assert_eq!(read(text), Ok(Holder::Two(plain.clone(), Some(plain.clone()))), "{text}");
    }
    assert_eq!(read("Two(Square(), None)"), Ok(Holder::Two(plain, None)));
}

#[test]
fn a_set_is_read_by_the_names_of_its_fields() {
    let read = |text: &str| Registry::default().read::<Set<Shapes>>(text).map_err(|e| e.message);
    let both = Set::default().with(Circle { radius: 2.0 }).with(Square { side: 1.0 });
    let names = both.iter().map(Choice::name).collect::<Vec<_>>();
    assert_eq!(names, ["Square", "Circle"]);
    for text in ["(Circle: (radius: 2), Square: ())", "(Square: Some(side: 1), Circle: /* a */ (radius: 2))"] {
        assert_eq!(read(text), Ok(both.clone()), "{text}");
    }
    assert_eq!(read("(Square: None, Circle: (radius: 2))"), Ok(both.without("Square")));
    assert!(read("(Square: (), Square: ())").is_err_and(|e| e.contains("Square")));
}

#[test]
fn another_crates_row_is_known_to_its_registry_only() {
    let text = "Hexagon(edge: 2)";
    let registry = (Registry::default().with::<Shapes, Hexagon>()).expect("a new name");
    let hexagon = registry.read::<ShapeSpec>(text).expect("known");
    assert_eq!((hexagon.name(), hexagon.area()), ("Hexagon", 10.4));
    assert!(read(text).is_err());
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
