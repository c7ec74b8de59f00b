//! The whole report of invented rows.

use super::sample::row;
use super::*;
use crate::campaign::RunRow;
use std::fs;

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
        within_m: None,
        scenario: "duck_st",
        hash: "00",
        version: "0",
        arms: &[],
        planned,
        shown: &[],
    }
}

/// A report in a folder of its own.
struct Made {
    dir: tempfile::TempDir,
    text: String,
}

impl Made {
    /// Writes a report of rows, of which no file contains NaN or infinity as a number.
    #[track_caller]
    fn new(about: &About<'_>, rows: &[RunRow]) -> Self {
        let dir = tempfile::tempdir().unwrap();
        let text = write(dir.path(), about, rows).unwrap().text;
        let made = Self { dir, text };
        for name in made.names() {
            if name.ends_with(".png") {
                assert!(fs::read(made.dir.path().join(&name)).unwrap().starts_with(b"\x89PNG"));
                continue;
            }
            let text = made.file(&name);
            assert!(!text.contains("NaN") && !text.contains("inf,"), "{name}");
            if name.ends_with(".csv") {
                let mut commas = text.lines().map(|l| l.matches(',').count());
                let first = commas.next().unwrap();
                assert!(commas.all(|n| n == first), "{name}: {text}");
            }
        }
        made
    }

    fn names(&self) -> Vec<String> {
        let files = fs::read_dir(self.dir.path()).unwrap();
        files.map(|f| f.unwrap().file_name().into_string().unwrap()).collect()
    }

    fn file(&self, name: &str) -> String {
        fs::read_to_string(self.dir.path().join(name)).unwrap()
    }

    fn page(&self) -> String {
        self.file("report.html")
    }

    /// The fields of a comparison of two arms by something, after these three.
    fn compared(&self, arms: &str, by: &str) -> Vec<String> {
        let pairs = self.file("differences.csv");
        let begin = format!("{arms},{by},");
        let line =
            pairs.lines().find_map(|l| l.strip_prefix(&begin)).unwrap_or_else(|| panic!("no {begin} in {pairs}"));
        line.split(',').map(str::to_string).collect()
    }
}

#[test]
fn says_which_arm_is_better_and_by_how_much() {
    let near = arm("near", 40, |k| Some((5.0 + (k % 7) as f64, 1.0)));
    let far = arm("far", 40, |k| (k % 2 == 0).then_some((25.0 + (k % 5) as f64, 1.0)));
    let mut rows = [near, far].concat();
    let made = Made::new(&about(80), &rows);
    // Tables, figures, the page, and the list of these files.
    assert_eq!(made.names().len(), 4 + 8 + 1 + 1);
    // Restricted time: `far` succeeds in half of its runs; the others count as the limit.
    for (by, n, verdict) in [
        ("success", "40", "better"),
        ("error", "20", "better"),
        ("path", "40", "not separable at this n"),
        ("restricted time", "40", "better"),
    ] {
        let compared = made.compared("near,far", by);
        assert_eq!([&compared[0], &compared[4]], [n, verdict], "{by}");
    }
    assert_eq!(made.compared("near,far", "success")[1], "0.5");
    for says in [
        "success, %",
        "100.0 ",
        "80 runs, seeds 1 to 40;",
        "20 of 40 pairs: both declared",
        "no success counts as 1500 s",
    ] {
        assert!(made.text.contains(says), "{says}: {}", made.text);
    }
    let page = made.page();
    assert!(page.contains("<h1>c&lt;1&gt;</h1>") && page.matches("<svg").count() == 4);

    // Blocks come in any order: the numbers do not change, and the arms are in the order asked for.
    rows.reverse();
    let names = ["near".to_string(), "far".to_string()];
    let other = Made::new(&About { arms: &names, ..about(80) }, &rows);
    assert_eq!(other.text, made.text);
    for file in ["arms.csv", "differences.csv", "errors.csv", "not_yet_declared.csv"] {
        assert_eq!(made.file(file), other.file(file), "{file}");
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
    let made = Made::new(&About { limit_s: Some(2000.0), ..about(80) }, &[hasty, sure].concat());
    for says in ["Warning: hasty looks faster than sure", "(20 against 40 of 40 succeed)", "by that sure is better"] {
        assert!(made.text.contains(says), "{says}: {}", made.text);
    }
    let compared = made.compared("hasty,sure", "time to declaration");
    assert_eq!(compared[..5], ["20", "-100", "-100", "-100", "better"]);
    assert!(made.page().contains("Warning: hasty looks faster"));
}

#[test]
fn few_values_have_no_interval() {
    let rows = [arm("a", 4, |_| Some((1.0, 1.0))), arm("b", 4, |_| Some((2.0, 1.0)))].concat();
    let made = Made::new(&about(8), &rows);
    assert!(made.text.matches("too few (n = 4)").count() >= 2 * 6 + 2 + 4, "{}", made.text);
    let csv = made.file("arms.csv");
    assert!(csv.contains("a,path median,4,,1801.5,,\n"), "{csv}");
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
        let text = Made::new(&about(100), &rows).text;
        assert!(text.contains("a part of the campaign"));
        let failures = rows.iter().any(|r| r.error.is_some());
        assert_eq!(text.contains("First failure: run 0: no water"), failures);
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
    let longer = |name: &str, by_m: f64| altered(name, |r| r.travelled_m += by_m);
    let rows = [longer("a", 0.0), longer("b", 10.0), longer("c", 30.0)].concat();
    let made = Made::new(&About { against: Some("b"), ..about(36) }, &rows);
    assert_eq!(made.file("differences.csv").matches(",path,").count(), 2);
    assert_eq!(made.compared("a,b", "path")[..5], ["12", "-10", "-10", "-10", "better"]);
    assert_eq!(made.compared("c,b", "path")[..5], ["12", "20", "20", "20", "worse"]);
    assert!(made.page().contains("Each arm is compared with b."));
}

#[test]
fn the_report_says_what_arms_set_what_a_success_is_and_what_is_pooled() {
    let mut rows = altered("a", |_| {});
    let rules = ["a source is declared within 40 m of a true one", "all sources are declared"].map(str::to_string);
    let (arms, sets) = (["a".to_string()], ["robots[0].map=Hmm()".to_string()]);
    let about = About { title: "One map & no more", arms: &arms, sets: &sets, success: &rules[..1], ..about(12) };
    let one = Made::new(&about, &rows);
    assert!(
        one.text.starts_with("One map & no more\n") && one.text.contains("arm a: robots[0].map=Hmm()"),
        "{}",
        one.text
    );
    let page = one.page();
    for says in ["<title>One map &amp; no more</title>", "<td>a</td><td>robots[0].map=Hmm()</td>", "seeds 1 to 40"] {
        assert!(page.contains(says), "{says}: {page}");
    }
    for r in &mut rows {
        r.condition = format!("water.speed={}", r.seed_index % 3);
    }
    let three = Made::new(&About { success: &rules, ..about }, &rows);
    let conditions = three.file("conditions.csv");
    assert!(conditions.lines().count() == 4 && conditions.contains("water.speed=1,a,4,4,1,"), "{conditions}");
    for (made, success, pooled) in [
        (&one, "Success: a source is declared within 40 m of a true one.", false),
        (&three, "within 40 m of a true one; or all sources are declared", true),
    ] {
        for said in [&made.text, &made.page()] {
            assert!(said.contains(success), "{said}");
            assert_eq!(said.contains("Pooled: each figure of an arm is over all 3 conditions"), pooled, "{said}");
            assert_eq!(said.contains("Pooled"), pooled, "{said}");
        }
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
    let wide = Made::new(&about(24), &rows);
    assert!(wide.text.contains("median, m"), "{}", wide.text);
    for cell in wide.page().split("<td>").skip(1).map(|c| c.split('<').next().unwrap()) {
        let units = cell.split(' ').filter(|w| ["m", "cm", "s", "%"].contains(w));
        assert!(units.count() == 0 || cell.contains("pairs"), "{cell}");
    }
    for columns in [100, 80, 40] {
        let text = Made::new(&About { columns: Some(columns), ..about(24) }, &rows).text;
        for line in text.lines() {
            assert!(line.chars().count() <= columns, "{columns}: {line}");
        }
        assert!(text.contains("rests on") && text.contains("12 of 12 pairs"), "{text}");
    }
}
