//! Draws of a made-up experiment, whose truth is known.

use super::*;
use crate::campaign::report::sample::row;
use crate::campaign::{Campaign, RunRow};
use crate::reproduce::{Figure, Measure, Paper, Quantity, RunEvent, joint};
use rheotaxis::scenario::load;
use std::path::Path;
use world::seeds::Stream;

const TEXT: &str = r#"(version: 2, title: "t", base: "uniform_channel", seeds: Literal(first: 901, count: 12),
    drawn_arms: (n: 400, draw: [
        ("time.limit_s", Uniform(10, 110)),
        ("terrain.depth_m", Choice(["9", "11"])),
        ("time.step_s", Choice(["0.05"])),
    ]))"#;

fn campaign(text: &str) -> Campaign {
    Campaign::new("c.ron", "c", text, load(Path::new("uniform_channel")).unwrap()).unwrap()
}

fn figures() -> Vec<Published> {
    let figure = |name: &str, quantity, among, paper| Figure {
        name: name.into(),
        arm: None,
        among,
        quantity,
        paper: Some(paper),
        note: String::new(),
    };
    Published::of(
        &[
            figure("found", Quantity::Share(RunEvent::Success), None, Paper::Count(24, 40)),
            figure("error", Quantity::Mean(Measure::ErrorM), Some(RunEvent::Success), Paper::MeanOf(6.0, 24)),
            // No figure that says how well it is known.
            figure("path", Quantity::Mean(Measure::TravelledM), None, Paper::Value(1.0)),
        ],
        None,
    )
}

/// A run of an experiment that succeeds in x of 100 cases, at 6 m in shallow water and 9 m in deep.
fn made(name: &str, x: f64, depth: &str, r: &mut Stream) -> RunRow {
    let error_m = if depth == "9" { 6.0 } else { 9.0 } + r.normal();
    let found = r.uniform() < x / 100.0;
    RunRow { arm: name.to_string(), success: found, ..row(0, found.then_some((error_m, 0.0))) }
}

fn runs(campaign: &Campaign, each: usize) -> Vec<RunRow> {
    let mut r = Stream::new(3, "test", "runs");
    let mut rows = Vec::new();
    for arm in &campaign.spec.arms {
        let value = |path: &str| arm.set.iter().find(|(p, _)| p == path).unwrap().1.clone();
        let (x, depth) = (value("time.limit_s").parse().unwrap(), value("terrain.depth_m"));
        rows.extend((0..each).map(|_| made(&arm.name, x, &depth, &mut r)));
    }
    rows
}

#[test]
fn what_the_figures_were_made_with_is_found() {
    let first = campaign(TEXT);
    let rows = runs(&first, 12);
    let found = identify(Draws::gather(vec![(first, rows)]).unwrap(), &figures());
    assert_eq!((found.figures.len(), found.draws.len(), found.marginals.len()), (2, 400, 2));
    assert_eq!((found.accepted, found.draws[0].draw.runs.len()), (4, 12));
    for d in &found.draws[..found.accepted] {
        // 24 of 40: with twelve trials a draw's own share is known to some 14 %.
        let limit_s: f64 = d.draw.value("time.limit_s").unwrap().parse().unwrap();
        assert!((limit_s - 60.0).abs() < 35.0 && d.distance < 1.0, "{limit_s} at {}", d.distance);
    }
    let marginal::After::Choice(depths) = &found.marginals[1].after else { panic!("a choice") };
    assert_eq!(depths[0], ("9".to_string(), 1.0));
    assert!(found.draws.windows(2).all(|d| d[0].distance <= d[1].distance));
}

#[test]
fn a_further_round_takes_fresh_runs_of_what_remains() {
    let first = campaign(TEXT);
    let rows = runs(&first, 3);
    let found = identify(Draws::gather(vec![(first.clone(), rows.clone())]).unwrap(), &figures());
    let next = next_round(&found, &first.spec, 20).unwrap();
    let second = campaign(&next);
    assert_eq!(second.spec.seeds.describe(), "seeds 913 to 932");
    assert_eq!(second.spec.arms.len(), 40);
    // Nothing that the first round had not, and each as it was.
    let fresh = runs(&second, 20);
    let draws = Draws::gather(vec![(first.clone(), rows), (second.clone(), fresh)]).unwrap();
    assert_eq!(draws.draws.len(), 400);
    let n = |name: &str| draws.draws.iter().find(|d| d.name == name).unwrap().runs.len();
    assert_eq!(n(&second.spec.arms[0].name), 20);
    let left_out = first.spec.arms.iter().find(|a| second.spec.arms.iter().all(|b| a.name != b.name)).unwrap();
    assert_eq!(n(&left_out.name), 3);
    assert!(identify(draws, &figures()).draws[..4].iter().all(|d| d.draw.round == 1));
    let other = campaign(&next.replace("time.limit_s", "time.spin_up_s"));
    let said = Draws::gather(vec![(first, Vec::new()), (other, Vec::new())]).unwrap_err();
    assert!(said.contains("that the first round has not"), "{said}");
    assert!(Draws::gather(vec![(second, Vec::new())]).unwrap_err().contains("draws no arms"));
}

/// Of papers that were made with the same truth as the runs, 95 % lie in the region; one with a wrong mean does not.
#[test]
fn the_joint_region_holds_as_many_papers_as_it_says() {
    let mut r = Stream::new(8, "test", "joint");
    let mut sample = |n: usize| -> Vec<RunRow> { (0..n).map(|_| made("a", 60.0, "9", &mut r)).collect() };
    let ours = sample(1000);
    let inside = |found: usize, error_m: f64| {
        let mut figures = figures();
        let [a, b] = [Paper::Count(found as u64, 40), Paper::MeanOf(error_m, found as u64)];
        figures[0].figure.paper = Some(a);
        figures[1].figure.paper = Some(b);
        let all: Vec<Figure> = figures.iter().map(|f| f.figure.clone()).collect();
        joint(&Published::of(&all, None), &ours).unwrap().is_inside()
    };
    let mut held = 0;
    for _ in 0..400 {
        let paper = sample(40);
        let errors: Vec<f64> = paper.iter().filter(|r| r.success).filter_map(|r| r.error_m).collect();
        held += usize::from(inside(errors.len(), errors.iter().sum::<f64>() / errors.len() as f64));
    }
    assert!((368..=394).contains(&held), "{held} of 400");
    assert!(!inside(24, 7.0) && !inside(10, 6.0));
    assert_eq!(joint(&figures(), &ours[..3]), None);
}

#[test]
fn a_folder_gets_tables_a_picture_and_the_next_campaign() {
    let first = campaign(TEXT);
    let rows = runs(&first, 4);
    let spec = first.spec.clone();
    let found = identify(Draws::gather(vec![(first, rows)]).unwrap(), &figures());
    let dir = tempfile::tempdir().unwrap();
    let files = write(dir.path(), &found, &spec, "rheotaxis campaign identify a").unwrap();
    let names: Vec<String> = files.iter().map(|f| f.file_name().unwrap().to_string_lossy().into()).collect();
    assert_eq!(names, ["IDENTIFICATION.md", "draws.csv", "pairs.svg", "pairs.png", "next.ron"]);
    let csv = std::fs::read_to_string(&files[1]).unwrap();
    assert_eq!(csv.lines().next(), Some("draw,standard_errors_away,runs,time.limit_s,terrain.depth_m,found,error"));
    assert_eq!(csv.lines().count(), 401);
    let page = std::fs::read_to_string(&files[0]).unwrap();
    assert!(page.contains("| time.limit_s | 10 to 110 |"), "{page}");
    assert!(text(&found, "t", IdentificationText::Plain).contains("the paper"));
}
