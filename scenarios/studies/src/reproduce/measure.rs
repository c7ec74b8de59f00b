//! Events and measures of a run, with the names that row files use.

use crate::campaign::report::Unit;
use crate::campaign::{DeclarationRow, RunRow};
use robots::handoff::Verdict;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Something that did or did not happen in a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RunEvent {
    /// It succeeded as the scenario defines it.
    Success,
    /// A source was declared, at any place.
    Declared,
    /// Among runs that declared: the error is larger along the flow than across.
    MostlyAlong,
    /// The belief's best cell became that of the source and stayed so to the end.
    CorrectCell,
    /// Of runs with a map: the cell that it stated to be the best at the declaration, or at the end without one, was
    /// that of a source.
    MapCellTrue,
    /// The same for a source within 5 m of that cell's centre.
    MapNearTrue,
    /// A source was declared in this subregion (counted from 0), or on its up-flow edge.
    RegionDeclared(u32),
    /// The declaration of this subregion is on its up-flow edge.
    RegionAtEdge(u32),
    /// Among runs that declared in this subregion: a position fix moved what the vehicle believed by at least so many
    /// metres in the minute before.
    RegionFixOver(u32, u32),
    /// Among runs that declared in this subregion: no position fix moved it that far in the minute before.
    RegionFixUnder(u32, u32),
    /// Among runs that declared in this subregion: the error is at least so many metres.
    RegionErrorOver(u32, u32),
    /// Among runs that declared in this subregion: the error across the flow is at least so many metres.
    RegionAcrossOver(u32, u32),
    /// Among runs that made a declaration of this number (counted from 0): a look at the place verified a source.
    Verified(u32),
    /// Among the same: the look rejected it.
    Rejected(u32),
    /// Among the same: the look could not tell.
    CannotTell(u32),
}

/// The first declaration of a subregion that the vehicle did not reject.
fn of_region(r: &RunRow, k: u32) -> Option<&DeclarationRow> {
    (r.declarations.iter()).find(|d| d.region == Some(u64::from(k)) && d.stands())
}

/// Whether a look at the place of declaration number `k` said this; `None` if there is no such declaration.
fn said(r: &RunRow, k: u32, verdict: Verdict) -> Option<bool> {
    (r.declarations.iter()).find(|d| d.number == u64::from(k)).map(|d| d.verdict == verdict.name())
}

impl RunEvent {
    /// Whether it happened; `None` if the run cannot tell.
    pub fn happened(self, r: &RunRow) -> Option<bool> {
        match self {
            RunEvent::Success => Some(r.success),
            RunEvent::Declared => Some(r.declared_s.is_some()),
            RunEvent::MostlyAlong => (r.error_along_m.zip(r.error_across_m)).map(|(a, b)| a.abs() > b.abs()),
            RunEvent::CorrectCell => Some(r.correct_cell_s.is_some()),
            RunEvent::MapCellTrue => r.map_cell_true.map(|yes| yes > 0),
            RunEvent::MapNearTrue => r.map_near_true.map(|yes| yes > 0),
            RunEvent::RegionDeclared(k) => Some(of_region(r, k).is_some()),
            RunEvent::RegionAtEdge(k) => Some(of_region(r, k).is_some_and(DeclarationRow::at_edge)),
            RunEvent::RegionFixOver(k, m) => {
                of_region(r, k).map(|d| d.fix_m.is_some_and(|fix_m| fix_m >= f64::from(m)))
            }
            RunEvent::RegionFixUnder(k, m) => RunEvent::RegionFixOver(k, m).happened(r).map(|over| !over),
            RunEvent::RegionErrorOver(k, m) => of_region(r, k)?.error_m.map(|error_m| error_m >= f64::from(m)),
            RunEvent::RegionAcrossOver(k, m) => {
                (of_region(r, k)?.error_across_m).map(|across_m| across_m.abs() >= f64::from(m))
            }
            RunEvent::Verified(k) => said(r, k, Verdict::Verified),
            RunEvent::Rejected(k) => said(r, k, Verdict::Rejected),
            RunEvent::CannotTell(k) => said(r, k, Verdict::CannotTell),
        }
    }
}

/// A number of a run. Errors are those of declarations, relative to the nearest true source.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// Error, m.
    ErrorM,
    /// Size of the error along the flow, m.
    ErrorAlongM,
    /// Size of the error across the flow, m.
    ErrorAcrossM,
    /// Distance from the first detection to the declared source, m.
    TracedM,
    /// Time of the declaration, s.
    DeclaredS,
    /// Time from the oldest last detection point on which a declaration rests to the declaration, s.
    IdentificationS,
    /// That time divided by the number of intervals between those points, s.
    LcdpIntervalS,
    /// Distance travelled, m, in runs that did not fail.
    TravelledM,
    /// Time from the end of a gantry's sweep to its stop, s.
    TrackedS,
    /// A gantry's speed along its path from the end of the sweep to its stop, m/s.
    SpeedMS,
    /// A gantry's net-to-gross displacement ratio from the end of the sweep to its stop.
    Ngdr,
    /// That speed in the nearer half of the way to the source, minus that in the farther half, m/s.
    NearGainMS,
    /// Mean distance from the line along the flow through the source in the farther half, minus that in the nearer
    /// half, m.
    OffsetGainM,
    /// Time at which the belief's best cell finally became that of the source, s.
    CorrectCellS,
    /// Length of the mission, s, in runs that did not fail.
    MissionS,
    /// Probability that the map stated of its best cell at the declaration, or at the end without one.
    MapCellP,
    /// The same of 5 m round its centre.
    MapNearP,
    /// Number of declarations of a run.
    Declarations,
    /// Declarations of a run at least so many metres from every true source and on no subregion's edge.
    FarDeclarations(u32),
    /// True sources declared within the distance that the scenario's success requires.
    SourcesDeclared,
    /// Error of the declaration of this subregion, counted from 0, m.
    RegionErrorM(u32),
    /// Size of its part along the flow, m.
    RegionAlongM(u32),
    /// Size of its part across the flow, m.
    RegionAcrossM(u32),
    /// Distance from the first detection in this subregion to its declaration, m.
    RegionTracedM(u32),
    /// How far a position fix moved what the vehicle believed in the minute before that declaration, m.
    RegionFixM(u32),
}

impl Measure {
    /// Its unit.
    pub fn unit(self) -> Unit {
        match self {
            Measure::DeclaredS
            | Measure::IdentificationS
            | Measure::LcdpIntervalS
            | Measure::TrackedS
            | Measure::CorrectCellS
            | Measure::MissionS => Unit::Seconds,
            Measure::MapCellP | Measure::MapNearP => Unit::Share,
            Measure::SpeedMS | Measure::NearGainMS => Unit::Speed,
            Measure::Ngdr | Measure::Declarations | Measure::FarDeclarations(_) | Measure::SourcesDeclared => {
                Unit::Number
            }
            _ => Unit::Metres,
        }
    }

    /// Whether it can be negative. The others are times, distances, speeds, shares and counts.
    pub fn is_signed(self) -> bool {
        matches!(self, Measure::NearGainMS | Measure::OffsetGainM)
    }

    /// The value for a run; `None` if the run has none.
    pub fn value(self, r: &RunRow) -> Option<f64> {
        let sound = |count: usize| r.error.is_none().then_some(count as f64);
        let less = |a: Option<f64>, b: Option<f64>| a.zip(b).map(|(a, b)| a - b);
        match self {
            Measure::ErrorM => r.error_m,
            Measure::ErrorAlongM => r.error_along_m.map(f64::abs),
            Measure::ErrorAcrossM => r.error_across_m.map(f64::abs),
            Measure::TracedM => r.traced_m,
            Measure::DeclaredS => r.declared_s,
            Measure::IdentificationS => less(r.declared_s, r.zone_since_s),
            Measure::LcdpIntervalS => (less(r.declared_s, r.zone_since_s).zip(r.zone_points))
                .and_then(|(s, n)| (n > 1.0).then(|| s / (n - 1.0))),
            Measure::TravelledM => r.error.is_none().then_some(r.travelled_m),
            Measure::TrackedS => less(r.declared_s, r.sweep_s),
            Measure::SpeedMS => r.speed_m_s,
            Measure::Ngdr => r.ngdr,
            Measure::NearGainMS => less(r.near_speed_m_s, r.far_speed_m_s),
            Measure::OffsetGainM => less(r.far_offset_m, r.near_offset_m),
            Measure::CorrectCellS => r.correct_cell_s,
            Measure::MissionS => r.error.is_none().then_some(r.mission_s),
            Measure::MapCellP => r.map_cell_p,
            Measure::MapNearP => r.map_near_p,
            Measure::Declarations => sound(r.declarations.len()),
            Measure::FarDeclarations(m) => sound(
                (r.declarations.iter())
                    .filter(|d| !d.at_edge() && d.error_m.is_some_and(|e| e >= f64::from(m)))
                    .count(),
            ),
            Measure::SourcesDeclared => sound(r.sources_declared as usize),
            Measure::RegionErrorM(k) => of_region(r, k)?.error_m,
            Measure::RegionAlongM(k) => of_region(r, k)?.error_along_m.map(f64::abs),
            Measure::RegionAcrossM(k) => of_region(r, k)?.error_across_m.map(f64::abs),
            Measure::RegionTracedM(k) => of_region(r, k)?.traced_m,
            Measure::RegionFixM(k) => of_region(r, k)?.fix_m,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::campaign::report::sample::row;
    use robots::handoff::UP_FLOW_EDGE;

    #[test]
    fn of_subregions() {
        let at = |region, rule: &str, along, across, fix_m| DeclarationRow {
            region: Some(region),
            rule: rule.to_string(),
            verdict: "unchecked".to_string(),
            error_m: Some(f64::sqrt(along * along + across * across)),
            error_along_m: Some(along),
            error_across_m: Some(across),
            fix_m,
            ..DeclarationRow::default()
        };
        let rejected = DeclarationRow { verdict: "rejected".to_string(), ..at(2, "AlongFlow", 300.0, 0.0, None) };
        let row = RunRow {
            declarations: vec![
                at(0, UP_FLOW_EDGE, 480.0, -4.0, None),
                rejected,
                at(2, "AlongFlow", 3.0, -31.0, Some(12.0)),
            ],
            sources_declared: 1,
            ..RunRow::default()
        };
        let yes = |e: RunEvent| e.happened(&row);
        assert_eq!([0, 1, 2].map(|k| yes(RunEvent::RegionDeclared(k))), [Some(true), Some(false), Some(true)]);
        assert_eq!([0, 1, 2].map(|k| yes(RunEvent::RegionAtEdge(k))), [Some(true), Some(false), Some(false)]);
        assert_eq!(yes(RunEvent::RegionFixOver(2, 12)), Some(true));
        assert_eq!(yes(RunEvent::RegionFixUnder(2, 12)), Some(false));
        assert_eq!(yes(RunEvent::RegionFixOver(0, 1)), Some(false));
        assert_eq!(yes(RunEvent::RegionFixOver(1, 1)), None);
        assert_eq!(yes(RunEvent::RegionAcrossOver(2, 31)), Some(true));
        assert_eq!(yes(RunEvent::RegionAcrossOver(2, 32)), Some(false));
        assert_eq!(yes(RunEvent::RegionErrorOver(1, 1)), None);
        let of = |m: Measure| m.value(&row);
        assert_eq!(of(Measure::Declarations), Some(3.0));
        assert_eq!(of(Measure::FarDeclarations(40)), Some(1.0));
        assert_eq!(of(Measure::SourcesDeclared), Some(1.0));
        assert_eq!((of(Measure::RegionAlongM(2)), of(Measure::RegionAcrossM(2))), (Some(3.0), Some(31.0)));
        assert_eq!(of(Measure::RegionErrorM(1)), None);
        // A failed run says nothing about its declarations.
        let failed = RunRow { error: Some("x".into()), ..row.clone() };
        assert_eq!(Measure::Declarations.value(&failed), None);
    }

    #[test]
    fn of_verdicts() {
        let at = |number, verdict: Verdict| DeclarationRow {
            number,
            verdict: verdict.name().to_string(),
            ..DeclarationRow::default()
        };
        let row =
            RunRow { declarations: vec![at(0, Verdict::Verified), at(1, Verdict::CannotTell)], ..RunRow::default() };
        let of = |k| [RunEvent::Verified(k), RunEvent::Rejected(k), RunEvent::CannotTell(k)].map(|e| e.happened(&row));
        assert_eq!(of(0), [Some(true), Some(false), Some(false)]);
        assert_eq!(of(1), [Some(false), Some(false), Some(true)]);
        // A place that was never reached has no verdict.
        assert_eq!(of(2), [None; 3]);
    }

    #[test]
    fn identification_counts_from_the_zones_oldest_point() {
        let found = RunRow {
            declared_s: Some(900.0),
            zone_points: Some(6.0),
            zone_since_s: Some(400.0),
            ..row(0, Some((1.0, 1.0)))
        };
        assert_eq!(Measure::IdentificationS.value(&found), Some(500.0));
        // Six points, five intervals.
        assert_eq!(Measure::LcdpIntervalS.value(&found), Some(100.0));
        // One point has no interval; a rule on other things has no points; without a declaration nothing is measured.
        let one = RunRow { zone_points: Some(1.0), ..found };
        assert_eq!(Measure::LcdpIntervalS.value(&one), None);
        for other in [row(0, Some((1.0, 1.0))), row(1, None)] {
            assert_eq!(Measure::IdentificationS.value(&other), None);
            assert_eq!(Measure::LcdpIntervalS.value(&other), None);
        }
    }
}
