//! Reports about broken texts, with a small schema that has every kind of value.

use super::*;
use schemars::JsonSchema;
use serde::Deserialize;
use world::ranges::{Finite, Fraction, HeadingDeg, NonNegative, Positive};

#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Pond {
    title: String,
    area: Area,
    bed: Bed,
    #[serde(default)]
    fish: Vec<Fish>,
    #[serde(default)]
    depth: Option<Depth>,
    size: (Positive, Positive),
    #[serde(default)]
    look: Look,
}

#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Area {
    length_m: Positive,
    width_m: Positive,
    #[serde(default = "north")]
    heading_deg: HeadingDeg,
}

fn north() -> HeadingDeg {
    HeadingDeg::new(0.0)
}

#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
enum Bed {
    Level(Level),
    Slope(Level),
}

#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Level {
    depth_m: Positive,
    #[serde(default)]
    rough: Option<Fraction>,
}

#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Fish {
    id: String,
    n: u32,
    weight_kg: NonNegative,
    #[serde(default)]
    tame: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Deserialize, JsonSchema)]
enum Depth {
    Altitude(Positive),
    Below(Finite),
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize, JsonSchema)]
enum Look {
    #[default]
    Up,
    Down,
}

const POND: &str = r#"(
    title: "Pond",
    area: (length_m: 10, width_m: 5),
    bed: Level(depth_m: 2),
    fish: [
        (id: "carp", n: 3, weight_kg: 1.5),
        (id: "eel", n: 1, weight_kg: 0.5, tame: true),
    ],
    depth: Altitude(2),
    size: (1, 2),
    look: Down,
)
"#;

/// The pond with some things changed.
fn pond(changes: &[(&str, &str)]) -> String {
    changes.iter().fold(POND.to_string(), |text, (from, to)| {
        assert_eq!(text.matches(from).count(), 1, "{from}");
        text.replace(from, to)
    })
}

fn too_shallow(pond: &Pond) -> Vec<UnplacedFault> {
    let (Bed::Level(level) | Bed::Slope(level)) = &pond.bed;
    let mut found = Vec::new();
    if let Some(Depth::Altitude(m)) = pond.depth
        && m > level.depth_m
    {
        found.push(UnplacedFault::error("depth", "is above the surface"));
    }
    if pond.title.len() > 10 {
        found.push(UnplacedFault::error("title", "is too long"));
    }
    found
}

/// The mistakes of a text with their hints, one line each.
fn said(text: &str) -> Vec<String> {
    match read::<Pond>(&Registry::default(), "p", text, too_shallow) {
        Ok(_) => Vec::new(),
        Err(ScenarioError::Text(fault)) => vec![one(&fault)],
        Err(ScenarioError::Many { faults, .. }) => faults.iter().map(one).collect(),
        Err(other) => panic!("{other}"),
    }
}

fn one(fault: &Fault) -> String {
    match &fault.help {
        Some(help) => format!("{} | {help}", fault.line()),
        None => fault.line(),
    }
}

#[test]
fn the_pond_itself_is_read() {
    assert_eq!(said(POND), [""; 0]);
    let attributes = format!("#![enable(implicit_some)]\n{POND}");
    assert_eq!(said(&attributes), [""; 0]);
    let told = said(&attributes.replace("depth_m: 2", "depth_m: 0"));
    assert_eq!(told, ["p:5:25: bed.depth_m: must be > 0, got 0"]);
}

/// Holds changes of the pond (`from => to`), one or several together, against the lines after them.
#[track_caller]
fn tells(cases: &str) {
    let mut lines = cases.lines().map(str::trim).peekable();
    while lines.peek().is_some() {
        let changes: Vec<_> = std::iter::from_fn(|| lines.next_if(|line| !line.starts_with("p:"))).collect();
        let wanted: Vec<_> = std::iter::from_fn(|| lines.next_if(|line| line.starts_with("p:"))).collect();
        let split = changes.iter().map(|change| change.split_once(" =>").expect("a change"));
        let split: Vec<_> = split.map(|(from, to)| (from, to.trim_start())).collect();
        assert!(!wanted.is_empty(), "{changes:?}");
        assert_eq!(said(&pond(&split)), wanted, "{changes:?}");
    }
}

#[test]
fn mistakes_of_every_kind_are_told_at_once_in_order() {
    tells(
        "\"Pond\" => Pond
        length_m: 10 => lenght_m: -10
        Level(depth_m => Levle(depth
        n: 3 => n: 3.5
        weight_kg: 0.5, =>
        tame: true => tame: yes
        Altitude(2) => Altitude
        (1, 2) => (1, -2)
        Down => Down()
      p:2:12: title: expected a text in quotes, got Pond
      p:3:12: area: there is no field `lenght_m` | did you mean `length_m`? fields here: length_m, width_m, heading_deg
      p:3:22: area.lenght_m: must be > 0, got -10
      p:4:10: bed: there is no choice `Levle` | did you mean `Level`? choices here: Level, Slope
      p:4:16: bed: there is no field `depth` | did you mean `depth_m`? fields here: depth_m, rough
      p:6:25: fish[0].n: must be a whole number, got 3.5 | a whole number from 0 to 4294967295
      p:7:9: fish[1]: the field `weight_kg` is missing | add `weight_kg: ...`: a number, must be >= 0
      p:7:34: fish[1].tame: expected true or false, got yes
      p:9:12: depth: `Altitude` needs parentheses | write `Altitude(...)`
      p:10:15: size.1: must be > 0, got -2
      p:11:11: look: `Down` has no parentheses | write `Down`",
    );
}

#[test]
fn missing_things_are_told_with_what_to_write() {
    tells(
        "bed: Level(depth_m: 2), =>
            p:1:1: the field `bed` is missing | add `bed: ...`: one of Level, Slope
        area: (length_m: 10, width_m: 5), =>
            p:1:1: the field `area` is missing | add `area: (length_m: ..., width_m: ...)`
        Level(depth_m: 2) => Level
            p:4:10: bed: `Level` needs parentheses | write `Level(depth_m: ...)`
        Level(depth_m: 2) => (depth_m: 2)
            p:4:10: bed: expected the name of a choice, got (depth_m: 2) | choices here: Level, Slope
        Level(depth_m: 2) => Level{depth_m: -2}
            p:4:10: bed: expected `(` after `Level`, got `{`
            p:4:25: bed.depth_m: must be > 0, got -2
        Altitude(2) => Altitude()
            p:9:12: depth: expected a value in the parentheses | must be > 0",
    );
}

#[test]
fn values_that_are_given_twice_or_not_at_all() {
    tells(
        "width_m: 5 => width_m: 5, width_m: 6
            p:3:38: area: the field `width_m` is given twice
        look: Down => look:
            p:11:5: look: expected a value after `look:`
        width_m: 5 => width_m: 5, 7
            p:3:38: area: expected `name: value`, got 7 | fields here: length_m, width_m, heading_deg
        Down => \"Down\"
            p:11:11: look: expected the name of a choice, got \"Down\" | choices here: Up, Down",
    );
}

#[test]
fn tuples_structures_and_lists_in_one_anothers_place() {
    tells(
        "(length_m: 10, width_m: 5) => (10, -5)
            p:3:12: area: the fields here have names | write `(length_m: 10, width_m: -5)`
            p:3:16: area.1: must be > 0, got -5
        (length_m: 10, width_m: 5) => [10, 5]
            p:3:11: area: expected fields in parentheses, got [10, 5] | write `(length_m: ..., width_m: ...)`
        (length_m: 10, width_m: 5) => ((length_m: 10, width_m: 0))
            p:3:12: area: one pair of parentheses too many | write the fields in a single pair
            p:3:36: area.0.width_m: must be > 0, got 0
        (1, 2) => (x: 1, y: 2)
            p:10:12: size.x: the values here have no names, got `x:` | write the values alone
        (1, 2) => [1, 0]
            p:10:11: size: expected 2 values in parentheses, got [1, 0] | write `( )` in place of `[ ]`
            p:10:15: size[1]: must be > 0, got 0
        (1, 2) => (1, 2, 3)
            p:10:11: size: expected 2 values in parentheses, not 3, got (1, 2, 3) | write `(..., ...)`",
    );
    let fish = &POND[POND.find("[\n").expect("a list")..POND.find(",\n    depth:").expect("its end")];
    let single = "(id: \"c\", n: -3, weight_kg: 1)";
    let told = [
        format!("p:5:11: fish: expected a list in square brackets, got {single} | write `[ ]` around it"),
        "p:5:24: fish.n: must be a whole number from 0 to 4294967295, got -3".to_string(),
    ];
    assert_eq!(said(&pond(&[(fish, single)])), told);
}

#[test]
fn syntax_is_read_on_after_a_mistake() {
    tells(
        "width_m: 5 => width_m = 5
        (length_m: 10, => (length_m 10;
        n: 3, => n: 3
        id: \"eel\", => id: \"eel,
        (1, 2) => (1,, 0)
            p:3:12: area.length_m: expected `:` after `length_m`
            p:3:23: area: expected a comma, got `;`
            p:3:25: area.width_m: expected `:` after `width_m`
            p:6:27: fish[0].weight_kg: expected a comma | fields and elements are separated by `,`
            p:7:14: the text in quotes is not closed on its line | end it with `\"`
            p:10:14: size: expected a value before this comma | remove the comma
            p:10:16: size.1: must be > 0, got 0",
    );
}

#[test]
fn brackets_that_do_not_match_are_told_where_they_are() {
    tells(
        "width_m: 5) => width_m: 5
        (1, 2) => (1, 0)
            p:3:11: area: this `(` is not closed | a `)` is missing before line 4
            p:10:15: size.1: must be > 0, got 0
        width_m: 5) => width_m: 5))
        (1, 2) => (1, 0)
            p:3:37: this `)` is one too many | the scenario continues after it: remove it
            p:10:15: size.1: must be > 0, got 0
        weight_kg: 1.5) => weight_kg: 1.5
        (1, 2) => (1, 0)
            p:6:9: fish[0]: this `(` is not closed | a `)` is missing before line 7
            p:10:15: size.1: must be > 0, got 0",
    );
    let closed = said(&pond(&[("Altitude(2)", "Altitude(2]"), ("(1, 2)", "(1, 0)")]));
    assert!(closed[0].starts_with("p:9:2"), "{closed:?}");
    assert_eq!(closed[1..], ["p:10:15: size.1: must be > 0, got 0"]);
}

#[test]
fn meaning_is_told_where_the_form_is_right() {
    tells(
        "Altitude(2) => Altitude(3)
        \"Pond\" => \"Pond of ponds\"
            p:2:5: title: is too long
            p:9:5: depth: is above the surface
        Altitude(2) => Altitude(3)
        n: 3 => n: -3
            p:6:25: fish[0].n: must be a whole number from 0 to 4294967295, got -3",
    );
}

#[test]
fn a_rule_that_only_a_type_knows_is_told_with_its_place() {
    let told = said(&pond(&[("length_m: 10", "length_m: 5e-324")]));
    assert_eq!(told.len(), 1);
    assert!(told[0].starts_with("p:3:") && told[0].contains("area.length_m: must be from 1e-18 to 1e18"), "{told:?}");
}

/// Nonsense of a megabyte, such as a log or a table under the wrong name.
#[test]
fn long_texts_are_refused() {
    let megabyte = |part: &str| part.repeat((1 << 20) / part.len());
    let of_words = megabyte("the quick brown fox; ");
    let texts = [
        of_words.clone(),
        format!("({of_words})"),
        format!("(title: [{of_words}"),
        megabyte("("),
        megabyte(";"),
        megabyte("]"),
        megabyte("(]"),
        megabyte("[(\n"),
        megabyte("\"\n"),
        megabyte("a: 1,\n"),
        format!("({})", megabyte("look: Up,")),
        format!("(fish: [{}])", megabyte("(id: 3),\n")),
        format!("({}: 1)", megabyte("x")),
    ];
    for text in texts {
        assert!(!said(&text).is_empty(), "{}", &text[..20]);
    }
}

/// Whatever stands in a text, it is refused with a place and without a panic.
#[test]
fn any_text_is_an_answer() {
    for odd in ["(", ")", "[", "]", "{", ",", ":", "=", ";", "\"", "x", "-", "/*", "//", "r#\"", "#", "\u{2212}"] {
        for at in 0..=POND.len() {
            for to in [at, (at + 7).min(POND.len())] {
                let text = format!("{}{odd}{}", &POND[..at], &POND[to..]);
                if read::<Pond>(&Registry::default(), "p", &text, too_shallow).is_err() {
                    assert!(!said(&text).is_empty(), "{odd} at {at}");
                }
            }
        }
    }
    let deep = "(".repeat(100_000);
    let said = said(&deep);
    assert!(said[0].starts_with("p:1:1: brackets are nested more than 128 deep"), "{said:?}");
}
