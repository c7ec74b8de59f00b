//! One run of a campaign. Whatever happens to it, it becomes a row.
#![allow(clippy::disallowed_methods, reason = "wall times are columns of the table; nothing of them enters a run")]

use crate::campaign::contained::contained;
use crate::campaign::rows::row::{DeclarationRow, RunRow};
use output::results::{
    DeclarationSummary, GantrySummary, RunInfo, RunSummary, SourceSummary, SourceTruth, Summary, SummaryBuilder,
    SummaryEnd, Totals,
};
use rheotaxis::control::Response;
use rheotaxis::outcome::RunOutcome;
use rheotaxis::scenario::Loaded;
use rheotaxis::trial::{Event, Observer, Trial};
use std::time::{Duration, Instant};
use world::seeds::Seed;

/// What identifies a run in the table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunName {
    /// Index of the run in the campaign.
    pub run: u64,
    /// Name of the arm.
    pub arm: String,
    /// Name of the condition.
    pub condition: String,
    /// Index of the seed.
    pub seed_index: u64,
    /// The seed itself, with the campaign's key.
    pub seed: Seed,
}

/// Makes a row from `run`, or from its panic.
pub(super) fn guarded(name: &RunName, run: impl FnOnce() -> RunRow) -> RunRow {
    contained(run).unwrap_or_else(|said| failed(name, format!("panicked: {said}")))
}

/// Gathers what a row needs while its run is made.
pub(super) struct Gatherer<'a> {
    /// Index of the run among those in lanes.
    pub(super) run: usize,
    /// Why nobody outside decides any more.
    pub(super) deserted: Option<String>,
    builder: SummaryBuilder,
    /// Wall time of its turns so far, and when the present one began.
    own: (Duration, Instant),
    go_on: &'a dyn Fn() -> bool,
}

impl<'a> Gatherer<'a> {
    /// For a run that goes on as long as `go_on` says so.
    pub(super) fn new(run: usize, name: &RunName, loaded: &Loaded, go_on: &'a dyn Fn() -> bool) -> Self {
        let builder = SummaryBuilder::new(&RunInfo {
            scenario_name: loaded.name.clone(),
            title: loaded.scenario.title.clone(),
            success: loaded.scenario.success.describe(),
            scenario_text: String::new(),
            seed: name.seed,
            version: env!("CARGO_PKG_VERSION").to_string(),
        });
        Self { run, deserted: None, builder, own: (Duration::ZERO, Instant::now()), go_on }
    }

    /// The row of the run at its end, with the wall times of its spin-up and mission.
    pub(super) fn row(
        self,
        name: &RunName,
        loaded: &Loaded,
        trial: &Trial,
        [spin_up, mission]: [Duration; 2],
    ) -> RunRow {
        let ended = trial.ended();
        let end = SummaryEnd {
            outcome: ended.outcome,
            error: None,
            digest: ended.digest.clone(),
            score: trial.score().clone(),
            totals: Totals {
                mission_s: ended.t_s,
                mission_wall_s: mission.as_secs_f64(),
                spin_up_wall_s: spin_up.as_secs_f64(),
                ..Totals::default()
            },
        };
        let summary = self.builder.finish(&end, &SourceTruth::from_run(trial, &ended));
        let own_wall_s = Some(self.own.0.as_secs_f64());
        RunRow { own_wall_s, ..row(name, &summary, loaded.scenario.success.declared_within_m()) }
    }
}

impl Observer for Gatherer<'_> {
    fn see(&mut self, event: &Event) {
        match event {
            Event::Frame(frame) => self.builder.observe(frame),
            Event::Exchange(exchange) if matches!(exchange.response, Response::Absent | Response::Gone) => {
                let (robot, heard) = (&exchange.robot, exchange.response.name());
                self.deserted = Some(format!("{robot} asked at {:.1} s: {heard}", exchange.t_s));
            }
            _ => {}
        }
    }

    fn turn(&mut self, begins: bool) {
        if begins {
            self.own.1 = Instant::now();
        } else {
            self.own.0 += self.own.1.elapsed();
        }
    }

    fn goes_on(&mut self) -> bool {
        self.deserted.is_none() && (self.go_on)()
    }
}

fn row(name: &RunName, summary: &Summary, within_m: Option<f64>) -> RunRow {
    let by_robots = summary.robots.iter().flat_map(|r| {
        let of_first = std::iter::once(r.traced_m).chain(std::iter::repeat(None));
        let of_first = r.declarations.iter().zip(of_first);
        of_first.map(|(d, traced_m)| (&r.id, d, traced_m))
    });
    let by_gantries = (summary.gantries.iter()).filter_map(|g| Some((&g.id, g.declaration.as_ref()?, None)));
    let mut all: Vec<(&String, &DeclarationSummary, Option<f64>)> = by_robots.chain(by_gantries).collect();
    all.sort_by(|a, b| a.1.t_s.total_cmp(&b.1.t_s));
    let first = all.first().copied();
    let declared = first.map(|(_, d, _)| d);
    let declarations: Vec<DeclarationRow> = (all.iter()).map(|(robot, d, _)| declaration(name, robot, d)).collect();
    let near = |s: &&SourceSummary| {
        within_m.is_some_and(|within_m| {
            declarations.iter().any(|d| {
                let (e, n) = (d.east_m - s.position.east_m, d.north_m - s.position.north_m);
                d.stands() && (e * e + n * n).sqrt() <= within_m
            })
        })
    };
    let sources_declared = summary.sources.iter().filter(near).count() as u64;
    // Several gantries share a row only if nobody asks for the path of one of them.
    let gantry = summary.gantries.first();
    let paired = |of: fn(&GantrySummary) -> [Option<f64>; 2]| gantry.map_or([None; 2], of);
    let ([far_speed_m_s, near_speed_m_s], [far_offset_m, near_offset_m]) =
        (paired(|g| g.speed_far_near_m_s), paired(|g| g.offset_far_near_m));
    let stated = summary.robots.iter().find_map(|r| r.map_stated.as_ref());
    let error = declared.and_then(|d| d.error.as_ref());
    let evidence = declared.and_then(|d| d.evidence);
    let RunSummary { totals, .. } = summary.run;
    RunRow {
        declarations,
        sources_declared,
        success: matches!(summary.outcome, RunOutcome::Found | RunOutcome::Completed),
        outcome: outcome_name(summary.outcome),
        digest: summary.digest.clone(),
        mission_s: totals.mission_s,
        first_detection_s: (summary.robots.iter().filter_map(|r| r.first_detection_s))
            .chain(summary.gantries.iter().filter_map(|g| g.first_spike_s))
            .min_by(f64::total_cmp),
        declared_s: declared.map(|d| d.t_s),
        declared_east_m: declared.map(|d| d.position.east_m),
        declared_north_m: declared.map(|d| d.position.north_m),
        error_m: error.map(|e| e.total_m),
        error_along_m: error.and_then(|e| e.along_flow_m),
        error_across_m: error.and_then(|e| e.across_flow_m),
        zone_points: evidence.map(|e| f64::from(e.points)),
        zone_since_s: evidence.map(|e| e.since_s),
        traced_m: first.and_then(|(.., traced_m)| traced_m),
        travelled_m: summary.robots.iter().map(|r| r.travelled_m).sum::<f64>()
            + summary.gantries.iter().map(|g| g.travelled_m).sum::<f64>(),
        detections: summary.robots.iter().map(|r| r.detections).sum::<u64>()
            + summary.gantries.iter().map(|g| g.spikes).sum::<u64>(),
        sweep_s: gantry.and_then(|g| g.sweep_s),
        speed_m_s: gantry.and_then(|g| g.speed_m_s),
        ngdr: gantry.and_then(|g| g.ngdr),
        far_speed_m_s,
        near_speed_m_s,
        far_offset_m,
        near_offset_m,
        correct_cell_s: (summary.robots.iter().filter_map(|r| r.correct_cell_s)).min_by(f64::total_cmp),
        map_cell_p: stated.map(|m| m.cell_p),
        map_near_p: stated.map(|m| m.near_p),
        map_cell_true: stated.and_then(|m| m.cell_true).map(u64::from),
        map_near_true: stated.and_then(|m| m.near_true).map(u64::from),
        map_declared: stated.map(|m| m.at_declaration.into()),
        spin_up_wall_s: totals.spin_up_wall_s,
        mission_wall_s: totals.mission_wall_s,
        error: None,
        ..failed(name, String::new())
    }
}

fn declaration(name: &RunName, robot: &str, d: &DeclarationSummary) -> DeclarationRow {
    let error = d.error.as_ref();
    DeclarationRow {
        run: name.run,
        arm: name.arm.clone(),
        condition: name.condition.clone(),
        seed_index: name.seed_index,
        seed: name.seed.number(),
        robot: robot.to_string(),
        number: d.number.into(),
        region: d.region.map(u64::from),
        rule: d.rule.clone(),
        verdict: d.verdict.name().to_string(),
        t_s: d.t_s,
        east_m: d.position.east_m,
        north_m: d.position.north_m,
        error_m: error.map(|e| e.total_m),
        error_along_m: error.and_then(|e| e.along_flow_m),
        error_across_m: error.and_then(|e| e.across_flow_m),
        traced_m: d.traced_m,
        fix_m: d.fix_m,
    }
}

/// The row of a run that failed.
pub(super) fn failed(name: &RunName, error: String) -> RunRow {
    RunRow {
        run: name.run,
        arm: name.arm.clone(),
        condition: name.condition.clone(),
        seed_index: name.seed_index,
        seed: name.seed.number(),
        outcome: outcome_name(RunOutcome::Failed),
        error: Some(error),
        ..RunRow::default()
    }
}

/// The name that `summary.json` uses.
pub(super) fn outcome_name(outcome: RunOutcome) -> String {
    match serde_json::to_value(outcome) {
        Ok(serde_json::Value::String(name)) => name,
        _ => unreachable!("an outcome becomes a word"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panicking_run_is_a_row_with_its_error() {
        let name = RunName { run: 4, arm: "a".to_string(), seed: Seed::from(9), ..RunName::default() };
        let row = guarded(&name, || panic!("the hull is {} m long", -1));
        assert_eq!(row.error.as_deref(), Some("panicked: the hull is -1 m long"));
        assert_eq!((row.run, row.arm.as_str(), row.seed), (4, "a", 9));
        assert_eq!((row.outcome.as_str(), row.success, row.digest.as_str()), ("failed", false, ""));
    }
}
