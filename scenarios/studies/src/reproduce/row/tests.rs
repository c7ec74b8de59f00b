//! How rows are read, selected and refused.

use super::*;

#[test]
fn holds_every_file_of_the_folder_and_each_says_where_it_comes_from() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/reference/rows");
    let mut files: Vec<String> =
        std::fs::read_dir(folder).unwrap().map(|f| f.unwrap().file_name().into_string().unwrap()).collect();
    files.sort();
    // No name stands for all rows.
    let rows = wanted(&Registry::default(), &[], &[]).unwrap();
    let mut ids: Vec<String> = rows.iter().map(|r| format!("{}.ron", r.row.id)).collect();
    ids.sort();
    assert_eq!(files, ids);
    let mut sound = std::collections::BTreeSet::new();
    for r in &rows {
        assert!(!r.row.source.is_empty() && !r.row.what.is_empty());
        // No paper says how reliable its map is, and some rows stand for no paper.
        let own = r.row.reliability || r.row.source.starts_with("none");
        assert!(own || r.row.figures.iter().any(|f| f.paper.is_some()));
        // Many rows have one scenario.
        assert!(!sound.insert(&r.row.scenario) || r.loaded.check().is_ok());
    }
}

#[test]
fn a_row_is_chosen_by_its_name_alone_and_a_group_by_what_no_row_is_called() {
    let of_name = |name: &str| -> Vec<&str> { named(name).iter().map(|(id, _)| *id).collect() };
    // The name of a row selects that row, whatever other names begin with it.
    for (id, _) in ROWS {
        assert_eq!(of_name(id), [*id]);
    }
    let group = ["wp_laminar", "wp_turbulent", "wp_dead_end"];
    assert_eq!(of_name("wp"), group);
    let ids = |names: &[&str]| -> Vec<String> {
        let names: Vec<PathBuf> = names.iter().map(PathBuf::from).collect();
        let rows = wanted(&Registry::default(), &names, &[]).unwrap();
        rows.into_iter().map(|r| r.row.id).collect()
    };
    // Each once, in the order of the names.
    assert_eq!(ids(&["wp_dead_end", "wp"]), ["wp_dead_end", "wp_laminar", "wp_turbulent"]);
}

#[test]
fn arms_are_chosen_alone_with_their_figures() {
    let of = |arm: &str| wanted(&Registry::default(), &["crab".into()], &[arm.to_string()]);
    let rows = of("adaptive").unwrap();
    assert_eq!(rows.len(), 1);
    let names: Vec<&str> = rows[0].arms.iter().map(|(n, _)| n.as_str()).collect();
    assert_eq!(names, ["adaptive"]);
    assert!(!rows[0].row.figures.is_empty());
    let theirs = |f: &Figure| f.arm.as_deref() == Some("adaptive");
    assert!(rows[0].row.figures.iter().all(theirs));
    let said = of("adaptve").unwrap_err().to_string();
    assert!(said.contains("`adaptve`") && said.contains("`paper`, `text`, `adaptive`"), "{said}");
}

#[test]
fn broken_rows_are_named_with_what_is_wrong() {
    let row = |id: &str, paper: &str| {
        format!(
            "(id: \"{id}\", what: \"w\", source: \"s\", scenario: \"duck_st\", \
             figures: [(name: \"f\", quantity: Share(success), paper: {paper})])"
        )
    };
    assert!(read("r", &row("a_1", "Count(7, 8)")).is_ok());
    for (text, says) in [
        (row("A b", "Count(7, 8)"), "id: must be"),
        (row("a", "Count(9, 8)"), "a count at most its total"),
        (row("a", "Count(0, 0)"), "a total above 0"),
        (row("a", "Value(NaN)"), "must be finite"),
        (row("a", "Median(3)"), "Median"),
        (
            row("a", "Run(3)").replace("figures:", "quick: 0, figures:"),
            "quick: must be a whole number, 1 or greater, got 0",
        ),
        (row("a", "Run(3), arm: \"x\""), "no arm `x`"),
        (row("a", "Run(3)").replace("Share(success)", "Quantile(ngdr, 1.0)"), "below 1"),
        ("(".to_string(), "r:1:1: the file ends at line 1"),
    ] {
        let said = read("r", &text).unwrap_err().lines().join("; ");
        assert!(said.contains(says), "{said}");
    }
    let several = row("A b", "Count(9, 8)").replace("what: \"w\"", "what: w, whit: 3");
    let said = read("r", &several).unwrap_err().lines();
    assert_eq!(said, ["r:1:19: what: expected a text in quotes, got w", "r:1:22: there is no field `whit`"]);
    let said = wanted(&Registry::default(), &["nobody".into()], &[]).unwrap_err().to_string();
    assert!(said.contains("`nobody`") && said.contains("duck_st"), "{said}");
}
