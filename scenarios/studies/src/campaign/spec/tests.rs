//! What campaign files mean, and how mistakes in them are reported.

use super::*;

/// The arms of a campaign that varies nothing else.
const ARMS: &str = "arms: [(name: \"a\")]";

/// A campaign with these seeds and these further fields.
fn text(seeds: &str, rest: &str) -> String {
    format!("(version: 2, title: \"t\", base: \"duck_st\", seeds: {seeds},\n {rest})")
}

fn faults(text: &str) -> Vec<String> {
    CampaignSpec::parse("c.ron", text).unwrap_err().lines()
}

#[test]
fn mistakes_are_located() {
    assert_eq!(CampaignSpec::parse("c.ron", &text("3", ARMS)).unwrap().n_conditions(), 1);
    let axes = "(\"x\", [\"1\", \"2\"]), ".repeat(70);
    for (seeds, rest, says) in [
        ("0", ARMS, "c.ron:1:43: seeds: count must be from 1 to 1099511627776, got 0"),
        ("3, until: (half_width: 0.5)", ARMS, "c.ron:1:61: until.half_width: must be above 0 and below 0.5, got 0.5"),
        ("3", "arms: [(name: \"a\"), (name: \"a\")]", "c.ron:2:23: arms[1].name: \"a\" is taken by another arm"),
        (
            "3, drawn_arms: (n: 3, draw: [(\"x\", Uniform(0, 1))])",
            "arms: [(name: \"draw 2\")]",
            "arms[0].name: \"draw 2\" is taken by an arm of `drawn_arms`",
        ),
        ("3, foo: 3", ARMS, "there is no field `foo`"),
        ("Literal(first: 101, count: 20), foo: 3", ARMS, "there is no field `foo`"),
        ("3", &format!("{ARMS}, conditions: Grid([{axes}])"), "more than 1099511627776 runs"),
        (
            "1",
            "arms: [(name: \"a\", set: [(\"x\", \"1\")])], conditions: Random(n: 2, draw: [(\"x\", Uniform(0, 1))])",
            "`x` is set by the conditions too",
        ),
    ] {
        let said = faults(&text(seeds, rest));
        assert!(said.len() == 1 && said[0].contains(says), "{says}: {said:?}");
    }
}

#[test]
fn a_number_of_seeds_is_seeds_1_to_it_and_other_forms_are_on_request() {
    for (form, seeds) in [
        ("20", Seeds::Literal { first: 1, count: 20 }),
        ("Literal(first: 101, count: 20)", Seeds::Literal { first: 101, count: 20 }),
        ("/* old */ Hashed( seed: 7, count: 20, )", Seeds::Hashed { seed: 7, count: 20 }),
    ] {
        assert_eq!(CampaignSpec::parse("c.ron", &text(form, ARMS)).unwrap().seeds, seeds);
    }
    for (odd, says) in [
        ("-3", "got -3"),
        ("2.5", "got 2.5"),
        ("Literal(first: 1)", "`count`"),
        ("Literal(first: -1, count: 2)", "must be a whole number, 0 or greater, got -1"),
        ("Hased(seed: 1, count: 2)", "Hased"),
        ("\"20\"", "expected the name of a choice or a number"),
        ("Literal(first: 18446744073709551615, count: 2)", "first of 2 seeds must be from 0 to"),
    ] {
        let said = &faults(&text(odd, ARMS))[0];
        assert!(said.starts_with("c.ron:1:") && said.contains(": seeds") && said.contains(says), "{odd}: {said}");
    }
}

#[test]
fn another_version_is_told_before_all_else() {
    for (version, hint) in [("1", "`seeds: Hashed(seed: S, count: N)`"), ("3", "rheotaxis init")] {
        let text = text("3", ARMS).replace("version: 2", &format!("version: {version}")).replace("title", "titel");
        let error = CampaignSpec::parse("c.ron", &text).unwrap_err();
        assert_eq!(error.lines(), [format!("c.ron:1:2: version: this program reads version 2, got {version}")]);
        let ScenarioError::Text(fault) = error else { panic!("one mistake") };
        assert!(fault.help.as_ref().is_some_and(|help| help.contains(hint)), "{fault:?}");
    }
}
