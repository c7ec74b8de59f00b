//! The whole report of invented rows.

use super::sample::row;
use super::*;
use crate::campaign::RunRow;
use std::fs;
use std::path::Path;

fn arm(name: &str, seeds: u64, error: impl Fn(u64) -> Option<(f64, f64)>) -> Vec<RunRow> {
    let one = |k| RunRow { arm: name.to_string(), ..row(k, error(k)) };
    (0..seeds).map(one).collect()
}

fn about(planned: u64) -> About<'static> {
    About {
        name: "c<1>",
        title: "",
        sets: &[],
        seeds: "seeds 1 to 40",
        success: &[],
        against: None,
        columns: None,
        limit_s: Some(1500.0),
        scenario: "duck_st",
        hash: "00",
        version: "0",
        arms: &[],
        planned,
        shown: &[],
    }
}

/// No file of the folder contains NaN or infinity as a number.
fn sound(dir: &Path) {
    for file in fs::read_dir(dir).unwrap() {
        let path = file.unwrap().path();
        if path.extension().is_some_and(|e| e == "png") {
            assert!(fs::read(&path).unwrap().starts_with(b"\x89PNG"));
            continue;
        }
        let text = fs::read_to_string(&path).unwrap();
        assert!(!text.contains("NaN") && !text.contains("inf,"), "{}", path.display());
        if path.extension().is_some_and(|e| e == "csv") {
            let mut commas = text.lines().map(|l| l.matches(',').count());
            let first = commas.next().unwrap();
            assert!(commas.all(|n| n == first), "{}: {text}", path.display());
        }
    }
}

#[test]
fn says_which_arm_is_better_and_by_how_much() {
    let near = arm("near", 40, |k| Some((5.0 + (k % 7) as f64, 1.0)));
    let far = arm("far", 40, |k| (k % 2 == 0).then_some((25.0 + (k % 5) as f64, 1.0)));
    let mut rows = [near, far].concat();
    let dir = tempfile::tempdir().unwrap();
    let written = write(dir.path(), &about(80), &rows).unwrap();
    sound(dir.path());
    assert_eq!(written.files.len(), 4 + 8 + 1);
    let pairs = fs::read_to_string(dir.path().join("differences.csv")).unwrap();
    let of = |by: &str| -> Vec<String> {
        let line = pairs.lines().find(|l| l.starts_with(&format!("near,far,{by},")));
        line.unwrap().split(',').map(str::to_string).collect()
    };
    let success = of("success");
    assert_eq!((success[3].as_str(), success[4].as_str()), ("40", "0.5"));
    assert_eq!(success[7], "better");
    assert_eq!((of("error")[3].as_str(), of("error")[7].as_str()), ("20", "better"));
    assert_eq!(of("path")[7], "not separable at this n");
    assert!(
        written.text.contains("success, %")
            && written.text.contains("100.0 ")
            && written.text.contains("80 runs, seeds 1 to 40;"),
        "{}",
        written.text
    );
    let html = fs::read_to_string(dir.path().join("report.html")).unwrap();
    assert!(html.contains("<h1>c&lt;1&gt;</h1>") && html.matches("<svg").count() == 4);
    // Restricted time: `far` succeeds in half of its runs; the others count as the limit.
    let restricted = of("restricted time");
    assert_eq!((restricted[3].as_str(), restricted[7].as_str()), ("40", "better"));
    assert!(written.text.contains("20 of 40 pairs: both declared"), "{}", written.text);
    assert!(written.text.contains("40 of 40 pairs; no success counts as 1500 s"), "{}", written.text);

    // Blocks come in any order: the numbers do not change, and the arms are in the order asked for.
    rows.reverse();
    let other = tempfile::tempdir().unwrap();
    let names = ["near".to_string(), "far".to_string()];
    let asked = About { arms: &names, ..about(80) };
    assert_eq!(write(other.path(), &asked, &rows).unwrap().text, written.text);
    for file in ["arms.csv", "differences.csv", "errors.csv", "not_yet_declared.csv"] {
        let text = |d: &Path| fs::read_to_string(d.join(file)).unwrap();
        assert_eq!(text(dir.path()), text(other.path()), "{file}");
    }
}

#[test]
fn an_arm_that_fails_more_and_looks_faster_is_warned_of() {
    // `hasty` declares only in the easy half, and there 100 s earlier; `sure` always succeeds.
    let sure = arm("sure", 40, |_| Some((5.0, 1.0)));
    let mut hasty = arm("hasty", 40, |k| (k < 20).then_some((5.0, 1.0)));
    for r in &mut hasty {
        r.declared_s = r.declared_s.map(|t| t - 100.0);
    }
    let dir = tempfile::tempdir().unwrap();
    let about = About { limit_s: Some(2000.0), ..about(80) };
    let written = write(dir.path(), &about, &[hasty, sure].concat()).unwrap();
    sound(dir.path());
    let says = "Warning: hasty looks faster than sure by the time to declaration: that rests on the 20 of 40 \
        pairs where both declared; but it fails more (20 against 40 of 40 succeed). Go by the restricted time: by that \
        sure is better.";
    assert!(written.text.contains(says), "{}", written.text);
    let pairs = fs::read_to_string(dir.path().join("differences.csv")).unwrap();
    assert!(pairs.contains("hasty,sure,time to declaration,20,-100,-100,-100,better,"), "{pairs}");
    let html = fs::read_to_string(dir.path().join("report.html")).unwrap();
    assert!(html.contains("Warning: hasty looks faster"));
}

#[test]
fn the_page_has_the_campaigns_title_and_what_each_arm_sets() {
    let rows = [arm("a", 6, |_| Some((1.0, 1.0))), arm("b", 6, |_| None)].concat();
    let (arms, sets) =
        (["a".to_string(), "b".to_string()], ["robots[0].map=Hmm()".to_string(), "as it is".to_string()]);
    let dir = tempfile::tempdir().unwrap();
    let about = About { title: "Two maps & no more", arms: &arms, sets: &sets, ..about(12) };
    let written = write(dir.path(), &about, &rows).unwrap();
    let html = fs::read_to_string(dir.path().join("report.html")).unwrap();
    for says in [
        "<title>Two maps &amp; no more</title>",
        "<h1>Two maps &amp; no more</h1>",
        "<td>a</td><td>robots[0].map=Hmm()</td>",
        "seeds 1 to 40",
    ] {
        assert!(html.contains(says), "{says}: {html}");
    }
    assert!(written.text.starts_with("Two maps & no more\n"), "{}", written.text);
    assert!(written.text.contains("arm a: robots[0].map=Hmm()"), "{}", written.text);
}

#[test]
fn few_values_have_no_interval() {
    let rows = [arm("a", 4, |_| Some((1.0, 1.0))), arm("b", 4, |_| Some((2.0, 1.0)))].concat();
    let dir = tempfile::tempdir().unwrap();
    let written = write(dir.path(), &about(8), &rows).unwrap();
    sound(dir.path());
    assert!(written.text.matches("too few (n = 4)").count() >= 2 * 6 + 2 + 4, "{}", written.text);
    let csv = fs::read_to_string(dir.path().join("arms.csv")).unwrap();
    assert!(csv.contains("a,path median,4,,1801.5,,\n"), "{csv}");
}

#[test]
fn success_is_shown_for_each_condition() {
    let mut rows = arm("a", 10, |_| Some((1.0, 1.0)));
    for r in &mut rows {
        r.condition = format!("water.speed={}", r.seed_index % 2);
    }
    let dir = tempfile::tempdir().unwrap();
    write(dir.path(), &about(10), &rows).unwrap();
    let text = fs::read_to_string(dir.path().join("conditions.csv")).unwrap();
    assert_eq!(text.lines().count(), 3);
    assert!(text.contains("water.speed=1,a,5,5,1,"), "{text}");
}

#[test]
fn nothing_one_run_and_only_failures_make_a_report_too() {
    let failed = |k| RunRow {
        error: Some("no water".into()),
        mission_s: 0.0,
        spin_up_wall_s: 0.0,
        mission_wall_s: 0.0,
        ..row(k, None)
    };
    let cases = [
        vec![],
        vec![row(0, Some((1.0, 1.0)))],
        (0..4).map(failed).collect(),
        [arm("a", 3, |_| None), arm("b", 3, |_| None)].concat(),
        arm("a", 30, |_| Some((2.0, 0.0))),
    ];
    for rows in cases {
        let dir = tempfile::tempdir().unwrap();
        let written = write(dir.path(), &about(100), &rows).unwrap();
        sound(dir.path());
        assert!(written.text.contains("a part of the campaign"));
        let failures = rows.iter().any(|r| r.error.is_some());
        assert_eq!(written.text.contains("First failure: run 0: no water"), failures);
    }
}

#[test]
fn a_folder_that_cannot_be_made_is_named() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("f");
    fs::write(&file, b"").unwrap();
    let said = write(&file.join("out"), &about(1), &[]).unwrap_err().to_string();
    assert!(said.contains("f/out"), "{said}");
}

/// A row of `arm` with other values.
fn altered(arm_name: &str, alter: impl Fn(&mut RunRow)) -> Vec<RunRow> {
    let mut rows = arm(arm_name, 12, |k| Some((1.0 + 0.1 * k as f64, 0.0)));
    rows.iter_mut().for_each(alter);
    rows
}

#[test]
fn each_arm_is_compared_with_the_one_that_is_asked_for() {
    let rows = [altered("a", |_| {}), altered("b", |r| r.travelled_m += 10.0), altered("c", |r| r.travelled_m += 30.0)]
        .concat();
    let dir = tempfile::tempdir().unwrap();
    let about = About { against: Some("b"), ..about(36) };
    let written = write(dir.path(), &about, &rows).unwrap();
    sound(dir.path());
    let pairs = fs::read_to_string(dir.path().join("differences.csv")).unwrap();
    let compared: Vec<&str> =
        (pairs.lines().skip(1)).filter(|l| l.contains(",path,")).map(|l| l.split_once(",path,").unwrap().0).collect();
    assert_eq!(compared, ["a,b", "c,b"]);
    assert!(pairs.contains("a,b,path,12,-10,-10,-10,better,"), "{pairs}");
    assert!(pairs.contains("c,b,path,12,20,20,20,worse,"), "{pairs}");
    assert!(!written.text.contains("NaN"));
    let html = fs::read_to_string(dir.path().join("report.html")).unwrap();
    assert!(html.contains("Each arm is compared with b."));
}

#[test]
fn the_report_says_what_a_success_is_and_what_is_pooled() {
    let mut rows = altered("a", |_| {});
    let rule = ["a source is declared within 40 m of a true one".to_string()];
    let about = About { success: &rule, ..about(12) };
    let said = |rows: &[RunRow], about: &About<'_>| {
        let dir = tempfile::tempdir().unwrap();
        let text = write(dir.path(), about, rows).unwrap().text;
        let html = fs::read_to_string(dir.path().join("report.html")).unwrap();
        (text, html)
    };
    let (text, html) = said(&rows, &about);
    for page in [&text, &html] {
        assert!(page.contains("Success: a source is declared within 40 m of a true one."), "{page}");
        assert!(!page.contains("Pooled"), "{page}");
    }
    for r in &mut rows {
        r.condition = format!("water.speed={}", r.seed_index % 3);
    }
    let two = [rule[0].clone(), "all sources are declared".to_string()];
    let differs = About { success: &two, ..about };
    let (text, html) = said(&rows, &differs);
    for page in [&text, &html] {
        assert!(page.contains("within 40 m of a true one; or all sources are declared"), "{page}");
        assert!(page.contains("Pooled: each figure of an arm is over all 3 conditions"), "{page}");
    }
}

/// Errors from below a metre to above one: each column has one unit, and it is in the column's head.
#[test]
fn no_cell_mixes_units_and_no_line_is_wider_than_the_terminal() {
    let rows = [
        altered("near", |r| r.error_m = Some(0.1 + 0.02 * r.seed_index as f64)),
        altered("far", |r| r.error_m = Some(0.8 + 0.1 * r.seed_index as f64)),
    ]
    .concat();
    let dir = tempfile::tempdir().unwrap();
    let wide = write(dir.path(), &about(24), &rows).unwrap().text;
    assert!(wide.contains("median, m"), "{wide}");
    let html = fs::read_to_string(dir.path().join("report.html")).unwrap();
    for cell in html.split("<td>").skip(1).map(|c| c.split('<').next().unwrap()) {
        let words: Vec<&str> = cell.split(' ').collect();
        let units = words.iter().filter(|w| ["m", "cm", "s", "%"].contains(w));
        assert!(units.count() == 0 || cell.contains("pairs"), "{cell}");
    }
    for columns in [100, 80, 40] {
        let narrow = About { columns: Some(columns), ..about(24) };
        let text = write(dir.path(), &narrow, &rows).unwrap().text;
        for line in text.lines() {
            assert!(line.chars().count() <= columns, "{columns}: {line}");
        }
        assert!(text.contains("rests on") && text.contains("12 of 12 pairs"), "{text}");
    }
}
