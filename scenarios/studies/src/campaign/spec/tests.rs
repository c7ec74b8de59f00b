//! What campaign files mean, and how mistakes in them are reported.

use super::*;

fn faults(text: &str) -> Vec<String> {
    CampaignSpec::parse("c.ron", text).unwrap_err().lines()
}

#[test]
fn mistakes_are_located() {
    let good = "(version: 2, title: \"t\", base: \"duck_st\", seeds: 3,\n arms: [(name: \"a\")])";
    assert_eq!(CampaignSpec::parse("c.ron", good).unwrap().n_conditions(), 1);
    assert_eq!(
        faults(&good.replace("seeds: 3", "seeds: 0")),
        ["c.ron:1:43: seeds: count must be from 1 to 1099511627776, got 0"]
    );
    let wide = good.replace("seeds: 3", "seeds: 3, until: (half_width: 0.5)");
    assert_eq!(faults(&wide), ["c.ron:1:61: until.half_width: must be above 0 and below 0.5, got 0.5"]);
    let twins = good.replace("(name: \"a\")", "(name: \"a\"), (name: \"a\")");
    assert_eq!(faults(&twins), ["c.ron:2:23: arms[1].name: \"a\" is taken by another arm"]);
    let said = faults(&good.replace("seeds", "seed_s"));
    assert!(said[0].contains("there is no field `seed_s`"), "{said:?}");
}

fn seeds(text: &str) -> Seeds {
    CampaignSpec::parse("c.ron", text).unwrap().seeds
}

const GOOD: &str = "(version: 2, title: \"t\", base: \"b\", seeds: 20, arms: [(name: \"a\")])";

#[test]
fn a_number_of_seeds_is_seeds_1_to_it_and_other_forms_are_on_request() {
    assert_eq!(seeds(GOOD), Seeds::Literal { first: 1, count: 20 });
    let form = |form: &str| GOOD.replace("seeds: 20", &format!("seeds: {form}"));
    assert_eq!(seeds(&form("Literal(first: 101, count: 20)")), Seeds::Literal { first: 101, count: 20 });
    assert_eq!(seeds(&form("/* old */ Hashed( seed: 7, count: 20, )")), Seeds::Hashed { seed: 7, count: 20 });
    for (odd, says) in [
        ("-3", "got -3"),
        ("2.5", "got 2.5"),
        ("Literal(first: 1)", "`count`"),
        ("Literal(first: -1, count: 2)", "must be a whole number, 0 or greater, got -1"),
        ("Hased(seed: 1, count: 2)", "Hased"),
        ("\"20\"", "expected the name of a choice or a number"),
        ("Literal(first: 18446744073709551615, count: 2)", "first of 2 seeds must be from 0 to"),
    ] {
        let said = faults(&form(odd));
        assert!(
            said[0].starts_with("c.ron:1:") && said[0].contains(": seeds") && said[0].contains(says),
            "{odd}: {said:?}"
        );
    }
}

#[test]
fn another_version_is_told_before_all_else() {
    for (version, hint) in [("1", "`seeds: Hashed(seed: S, count: N)`"), ("3", "rheotaxis init")] {
        let text = GOOD.replace("version: 2", &format!("version: {version}")).replace("title", "titel");
        let error = CampaignSpec::parse("c.ron", &text).unwrap_err();
        assert_eq!(error.lines(), [format!("c.ron:1:2: version: this program reads version 2, got {version}")]);
        let ScenarioError::Text(fault) = error else { panic!("one mistake") };
        assert!(fault.help.as_ref().is_some_and(|help| help.contains(hint)), "{fault:?}");
    }
}

#[test]
fn seeds_are_read_beside_a_mistake_elsewhere() {
    for seeds in ["20", "Literal(first: 101, count: 20)"] {
        let text = GOOD.replace("20", seeds).replace("version: 2", "version: 2, foo: 3");
        let said = faults(&text);
        assert_eq!(said.len(), 1, "{said:?}");
        assert!(said[0].contains("no field `foo`"), "{said:?}");
    }
}

#[test]
fn more_conditions_than_can_be_counted_are_refused() {
    let axes = "(\"x\", [\"1\", \"2\"]), ".repeat(70);
    let text = GOOD.replace("arms:", &format!("conditions: Grid([{axes}]), arms:"));
    let said = faults(&text);
    assert!(said[0].contains("more than 1099511627776 runs"), "{said:?}");
}

#[test]
fn an_arm_cannot_set_what_the_conditions_vary() {
    let text = "(version: 2, title: \"t\", base: \"b\", seeds: 1, arms: [(name: \"a\", set: [(\"x\", \"1\")])], \
        conditions: Random(n: 2, draw: [(\"x\", Uniform(0, 1))]))";
    let said = faults(text);
    assert!(said[0].contains("`x` is set by the conditions too"), "{said:?}");
}
