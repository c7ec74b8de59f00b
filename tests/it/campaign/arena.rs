//! The arena: searchers against each other, its results, and what goes wrong in it.

use crate::common::{Ended, command, rheotaxis_in, root, says, with_little_room};
use rheotaxis::control::{Controller, Question, Response, read_answer};
use rheotaxis::prelude::*;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use studies::arena::{Contest, Family, campaign, families, searchers};
use studies::campaign::{CampaignError, Outside, RunName, RunOptions, RunRow, read_rows, run};
use world::registry::Registry;
use world::seeds::Key;

/// A family whose runs take hundredths of a second, and two searchers for it, one of them told the source.
const POND: &str = r#"(
    version: 2,
    title: "pond",
    base: "uniform_channel",
    machine: Robot,
    set: [("time.spin_up_s", "20"), ("time.limit_s", "15")],
    draw: [("sources[0].east_m", Uniform(-170, -110)), ("robots[0].start.east_m", Uniform(110, 170))],
    given: [("speed", "1.5"), ("step", "24")],
    quick: 2,
)"#;
const TWO: &str = r#"(version: 2, searchers: [
    (name: "told", source: "ours", machine: Robot, privileged: true, set: [
        ("robots[0].strategy", "Route(points: [({sources[0].east_m}, 0)], speed_m_s: {speed}, vertical: Some(Altitude(2)))"),
    ]),
    (name: "slow", source: "ours", machine: Robot, set: [("robots[0].strategy", "Amp(speed_m_s: {0.5 speed})")]),
    (name: "fast", source: "ours", machine: Robot, set: [("robots[0].strategy", "Amp(speed_m_s: {speed})")]),
])"#;
const OUTSIDE: &str = r#"(version: 2, searchers: [
    (name: "mine", source: "ours", machine: Robot, set: [("robots[0].strategy", "External(period_s: 1, on_late: Abort)")]),
])"#;

fn pond() -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    for (file, text) in [("pond.ron", POND), ("two.ron", TWO), ("mine.ron", OUTSIDE)] {
        fs::write(dir.path().join(file), text).unwrap();
    }
    dir
}

fn arena(dir: &Path, args: &str) -> Ended {
    let mut all = vec!["arena"];
    all.extend(args.split_whitespace());
    rheotaxis_in(dir, &all)
}

const BOTH: &str = "--family pond.ron --searcher two.ron";

#[test]
fn its_results_stand_in_one_folder_and_the_same_command_continues() {
    let pond = pond();
    let dir = pond.path();
    let first = arena(dir, &format!("{BOTH} --seeds 4 --out out")).with(0);
    says(&first.out, &["pond: pond", "told the source", "slow", "fast", "4 of 4 seeds are whole"]);
    for file in ["report.html", "RANKING.md", "arena.csv", "ranking.svg", "declared_by.svg", "pond.parquet"] {
        assert!(dir.join("out").join(file).is_file(), "{file}");
    }
    let rows = read_rows(&dir.join("out/pond")).unwrap();
    assert_eq!(rows.len(), 12);
    // A run once more is the run of the row, with what its seed draws.
    let again = rheotaxis_in(dir, &["campaign", "rerun", "out/pond", "--run", "5", "--quiet"]).with(0);
    says(&again.out, &["the same digest as its row"]);
    fs::remove_file(dir.join("out/arena.csv")).unwrap();
    let second = arena(dir, &format!("{BOTH} --seeds 4 --out out")).with(0);
    says(&second.err, &["12 runs, 12 done before"]);
    assert_eq!(second.out, first.out);
    // Other seeds are another contest.
    let other = arena(dir, &format!("{BOTH} --seeds 5 --out out")).with(1);
    says(&other.err, &["out/pond holds runs of another campaign", "give another --out"]);
    // Nor does a page show its rows, if the time is over before it comes to them.
    fs::write(dir.join("lake.ron"), POND).unwrap();
    let late = format!("--family lake.ron {BOTH} --seeds 100000 --out out --max-wall 1s");
    let late = arena(dir, &late).with(75);
    says(&late.err, &["out/pond is left out: it holds another contest (campaign"]);
    assert!(late.out.contains("lake: pond") && !late.out.contains("pond: pond\n"), "{}", late.out);
    let sealed = arena(dir, &format!("{BOTH} --quick --key secret-of-this-contest --out sealed")).with(0);
    says(&sealed.out, &["2 of 2 seeds are whole"]);
    says(&fs::read_to_string(dir.join("sealed/RANKING.md")).unwrap(), &["Sealed seeds, under the key with the mark"]);
    let sealed = read_rows(&dir.join("sealed/pond")).unwrap();
    assert!(sealed.iter().all(|row| rows.iter().all(|open| open.digest != row.digest)));
}

#[test]
fn what_cannot_compete_is_refused_before_anything_runs() {
    let pond = pond();
    let dir = pond.path();
    // What happens to have the name of something that comes with the program is not taken for it.
    for name in ["uniform", "searchers"] {
        fs::create_dir(dir.join(name)).unwrap();
    }
    fs::write(dir.join("odd.ron"), TWO.replace("{0.5 speed}", "{pace}")).unwrap();
    // Who is ranked must not be told the truth, nor change the contest.
    fs::write(dir.join("told.ron"), TWO.replace("privileged: true, ", "")).unwrap();
    fs::write(
        dir.join("eased.ron"),
        TWO.replace(
            "(\"robots[0].strategy\", \"Amp(speed_m_s: {0.5",
            "(\"success\", \"Completed\"), (\"robots[0].strategy\", \"Amp(speed_m_s: {0.5",
        ),
    )
    .unwrap();
    let slow = "(\"robots[0].strategy\", \"Amp(speed_m_s: {0.5";
    let aside = "(\"robots[0].sensors.fluorometers_aside\", \"(span_m: 9)\"), ";
    fs::write(dir.join("aside.ron"), TWO.replace(slow, &format!("{aside}{slow}"))).unwrap();
    let span = "(\"robots[0].sensors.fluorometers_aside.span_m\", \"9\"), ";
    fs::write(dir.join("span.ron"), TWO.replace(slow, &format!("{span}{slow}"))).unwrap();
    let hint = "(\"hint\", \"{sources[0].east_m}\"), (\"step\"";
    fs::write(dir.join("hint.ron"), POND.replace("(\"step\"", hint)).unwrap();
    fs::write(dir.join("gone.ron"), POND.replace("title: \"pond\",", "")).unwrap();
    fs::write(dir.join("wide.ron"), POND.replace("Uniform(-170, -110)", "Uniform(-110, -170)")).unwrap();
    fs::write(dir.join("far.ron"), POND.replace("Uniform(-170, -110)", "Uniform(-9000, -110)")).unwrap();
    for (args, code, parts) in [
        (
            "--family pond.ron --searcher aside.ron",
            1,
            &["slow in pond.ron: `robots[0].sensors.fluorometers_aside`: "][..],
        ),
        (
            "--family pond.ron --searcher span.ron",
            1,
            &["slow in pond.ron: `robots[0].sensors.fluorometers_aside.span_m`: ", "instruments are the family's"],
        ),
        ("--family hint.ron --searcher two.ron", 1, &["given hint: `{sources[0].east_m}` is not given"]),
        ("--searcher nobody", 1, &["there is no searcher `nobody`; there are: oracle; Pang 2009"]),
        ("--family nowhere", 1, &["nowhere", "families that come with the program: uniform"]),
        (&format!("{BOTH} --seeds 0"), 2, &["--seeds", "0 is not in 1.."]),
        ("--family flume --searcher surge-cast", 1, &["flume: none of the searchers asked for moves a gantry"]),
        ("--family pond.ron --searcher odd.ron", 1, &["slow in pond.ron: `{pace}` is not given; there are: speed"]),
        ("--family pond.ron --searcher told.ron", 1, &["told in pond.ron: `{sources[0].east_m}` is not given"]),
        (
            "--family pond.ron --searcher eased.ron",
            1,
            &["slow in pond.ron: `success`: a searcher may set only robots[0]"],
        ),
        ("--family gone.ron --searcher two.ron", 1, &["gone.ron", "title"]),
        ("--family wide.ron --searcher two.ron", 1, &["wide.ron", "draw[0]", "the smaller first"]),
        ("--family far.ron --searcher two.ron", 1, &["sources[0].east_m", "outside the area"]),
        ("--searcher two.ron --searcher two.ron", 1, &["there are two searchers called told"]),
        ("--family pond.ron --family pond.ron", 1, &["there are two families called pond"]),
    ] {
        let ended = arena(dir, &format!("{args} --out out"));
        assert_eq!(ended.code, Some(code), "{args}: {}", ended.err);
        says(&ended.err, parts);
        assert!(!dir.join("out").exists(), "{args}");
    }
}

#[test]
fn a_full_disk_keeps_the_rows_that_are_written() {
    let pond = pond();
    let dir = pond.path();
    arena(dir, &format!("{BOTH} --seeds 4 --out out")).with(0);
    let rows = read_rows(&dir.join("out/pond")).unwrap();
    let full = Ended::of(&mut with_little_room(dir, 8, &format!("arena {BOTH} --seeds 4 --out out"))).with(1);
    says(&full.err, &["cannot write out/pond.parquet", "blocks written before are whole"]);
    assert_eq!(read_rows(&dir.join("out/pond")).unwrap(), rows);
}

/// Answers as it should, but in one run goes away in the middle.
struct Leaves;

impl Outside for Leaves {
    fn controller(&self, run: &RunName, _: &str, _: f64) -> Result<Box<dyn Controller>, String> {
        let leaves = run.seed_index == 2;
        Ok(Box::new(move |asked: &Question| {
            if leaves && asked.number == 4 {
                return Response::Gone;
            }
            let ahead = br#"{"steer": {"heading_rad": 4.7, "speed_m_s": 1.5, "altitude_m": 2}}"#;
            read_answer(ahead, asked.number, asked.t_s).map_or_else(Response::Nonsense, Response::Answer)
        }))
    }
}

#[test]
fn an_outside_searcher_that_dies_in_the_middle_stops_it_and_finished_rows_are_kept() {
    let pond = pond();
    let dir = pond.path();
    let family = families(&Registry::default(), &[dir.join("pond.ron")]).unwrap().remove(0);
    let asked = [dir.join("mine.ron"), dir.join("two.ron")].map(|p| p.display().to_string());
    let contest = Contest { seeds: Some(5), first_seed: 1, key: Key::public() };
    let planned = campaign(&family, &searchers(&asked).unwrap(), &contest).unwrap();
    assert!(matches!(planned.check(), Err(CampaignError::Outside { .. })), "a campaign alone has nobody outside");
    let out: PathBuf = dir.join("out");
    let options = RunOptions { jobs: 1, outside: Some(Arc::new(Leaves)), ..RunOptions::default() };
    let stopped = run(&planned, &out, &options, &AtomicBool::new(false), &|_| {}).unwrap_err().to_string();
    says(&stopped, &["run 8 (arm mine) has no row", "auv0 asked at 4.0 s: gone", "the others are kept"]);
    // Two whole seeds, and of the third one the searchers of the program, which had their lanes with it.
    let kept: Vec<u64> = read_rows(&out).unwrap().iter().map(|row| row.run).collect();
    assert_eq!(kept, [0, 1, 2, 3, 4, 5, 6, 7, 9, 10, 11]);
}

#[test]
fn without_anybody_outside_the_arena_says_so_and_keeps_what_it_has() {
    let pond = pond();
    let args = "arena --family pond.ron --searcher mine.ron --searcher two.ron --seeds 1 --out out --control-wait 0.2";
    let args: Vec<&str> = args.split_whitespace().chain(["--zenoh-listen", "tcp/127.0.0.1:0"]).collect();
    let ended = Ended::of(&mut command(pond.path(), &args)).with(1);
    says(&ended.err, &["searchers outside are asked at tcp/127.0.0.1:", "auv0 asked at 0.0 s: absent"]);
    assert_eq!(read_rows(&pond.path().join("out/pond")).unwrap().len(), 3);
    // A share that makes one run to learn how long they are asks, too.
    let share: Vec<&str> = args.iter().map(|arg| if *arg == "out" { "share" } else { arg }).collect();
    let share = Ended::of(&mut command(pond.path(), &[&share[..], &["--shard", "1/2"]].concat())).with(1);
    says(&share.err, &["auv0 asked at 0.0 s: absent"]);
    // Where anybody could answer, it has to be allowed.
    let open: Vec<&str> = args.iter().map(|arg| if arg.starts_with("tcp/") { "tcp/0.0.0.0:0" } else { arg }).collect();
    let refused = Ended::of(&mut command(pond.path(), &open)).with(1);
    says(&refused.err, &["anybody on the network", "--control-from-anywhere"]);
    let open: Vec<&str> = open.into_iter().chain(["--control-from-anywhere"]).collect();
    let warned = Ended::of(&mut command(pond.path(), &open)).with(1);
    says(&warned.err, &["warning", "anybody", "auv0 asked at 0.0 s: absent"]);
}

params! {
    /// Goes straight on, for a while.
    struct Straight as "Straight", "straight on", from "a crate of its own" {
        /// When it declares, s.
        until_s: Positive = Positive::new(10.0),
    }
}

impl StrategyParams for Straight {
    fn build(&self, _: &Setting) -> Result<Box<dyn Strategy>, RobotError> {
        Ok(Box::new(self.clone()))
    }
}

impl Strategy for Straight {
    fn step(&mut self, seen: &Observation, _: &mut Stream) -> Decision {
        let manoeuvre = Manoeuvre::Course { course: Heading::from_deg(270.0) };
        let goal = Goal { id: 1, manoeuvre, vertical: Vertical::Altitude(2.0), speed_m_s: 1.5 };
        let done = seen.t_s >= self.until_s.get();
        Decision {
            declared: done.then(|| Declaration::first(seen.t_s, seen.estimate.position, "far enough")),
            outcome: done.then_some(Outcome::Completed),
            ..Decision::new(Behaviour::Other("straight"), goal)
        }
    }
}

#[test]
fn a_strategy_of_another_crate_competes_by_its_name() {
    let pond = pond();
    let dir = pond.path();
    let mine = OUTSIDE.replace("External(period_s: 1, on_late: Abort)", "Straight(until_s: {0.25 step})");
    fs::write(dir.join("mine.ron"), mine).unwrap();
    let family = [dir.join("pond.ron")];
    let asked = [dir.join("mine.ron"), dir.join("two.ron")].map(|p| p.display().to_string());
    let contest = Contest { seeds: Some(2), first_seed: 1, key: Key::public() };
    let planned = |registry: &Registry| {
        let family = families(registry, &family).unwrap().remove(0);
        campaign(&family, &searchers(&asked).unwrap(), &contest).unwrap()
    };
    says(&planned(&Registry::default()).check().unwrap_err().to_string(), &["Straight"]);
    let planned = planned(&Registry::default().with::<Strategies, Straight>().unwrap());
    let out = dir.join("out");
    run(&planned, &out, &RunOptions::default(), &AtomicBool::new(false), &|_| {}).unwrap();
    let rows = read_rows(&out).unwrap();
    let declared: Vec<_> = rows.iter().filter(|row| row.arm == "mine").map(|row| row.declared_s).collect();
    assert_eq!(declared.len(), 2);
    assert!(declared.iter().all(|at| at.is_some_and(|s| (s - 6.0).abs() < 0.1)), "{declared:?}");
}

/// All that comes with the program can compete: searchers name what each family gives, and the ends of all draws are
/// legal for one of them.
#[test]
fn every_family_and_every_searcher_that_comes_with_the_program_can_compete() {
    let (all, contest) = (searchers(&[]).unwrap(), Contest { seeds: None, first_seed: 1, key: Key::public() });
    let known = fs::read_dir(root().join("scenarios/catalog/arena")).unwrap().count();
    let families = families(&Registry::default(), &[]).unwrap();
    assert_eq!(known, families.len() + 1);
    for family in &families {
        let mut planned = campaign(family, &all, &contest).unwrap();
        let draws = std::mem::take(&mut planned.spec.draw);
        assert!(draws.len() >= 3, "{}", family.name);
        planned.spec.draw = draws;
        let told = planned.spec.arms.iter().position(|arm| arm.name != "oracle").unwrap();
        planned.spec.arms = vec![planned.spec.arms.swap_remove(told)];
        planned.check().unwrap();
    }
}

/// Lochmatter & Martinoli 2009: in a laminar current surge-cast is ahead of casting, which turns only at the plume's
/// edge.
#[test]
fn in_a_laminar_current_surge_cast_is_ahead_of_casting() {
    let asked = ["surge-cast", "passive zigzag"].map(String::from);
    let family = families(&Registry::default(), &[PathBuf::from("uniform_kinematic")]).unwrap().remove(0);
    let laminar = crate::common::set(family.base, &[("water.currents[1].std_m_s", "0")]);
    let family = Family { base: laminar, ..family };
    let contest = Contest { seeds: Some(5), first_seed: 1, key: Key::public() };
    let planned = campaign(&family, &searchers(&asked).unwrap(), &contest).unwrap();
    let dir = tempfile::tempdir().unwrap();
    run(&planned, dir.path(), &RunOptions::default(), &AtomicBool::new(false), &|_| {}).unwrap();
    let rows = read_rows(dir.path()).unwrap();
    let time_s = |row: &RunRow| if row.success { row.declared_s.unwrap() } else { 1800.0 };
    let ahead: Vec<f64> = rows.chunks(2).map(|of_seed| time_s(&of_seed[1]) - time_s(&of_seed[0])).collect();
    assert!(ahead.len() == 5 && ahead.iter().all(|s| *s > 100.0), "{ahead:?}");
}
