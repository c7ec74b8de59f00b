//! All that a run has left, when it is over.

use super::gatherer::Gatherer;
use crate::charts::small_png;
use crate::figures as draw;
use crate::files::{ReportError, guarded};
use crate::report::{Figure, figures, film, write_all};
use crate::results::{
    BeliefTrack, Echoes, GantryTrack, MassBalance, ObstacleOutline, Pictures, PlumeFilm, RunReport, SourceTruth,
    Summary, SummaryEnd, Totals, Track,
};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use rheotaxis::frame::PlumeFrame;
use rheotaxis::ocean::Ocean;
use rheotaxis::outcome::RunOutcome;
use rheotaxis::scenario::Loaded;
use rheotaxis::trial::{RunEnd, Trial};
use std::time::Duration;
use world::files::Folder;

/// Pixels of a [still](RunResults::still) along its longer side, at most: a page with nine is still easy to send.
const STILL_PX: u32 = 1000;

/// The results of a run that is over. Figures need its ocean as well, at the end of the run.
pub struct RunResults {
    /// The summary, as in `summary.json`.
    pub summary: Summary,
    /// The true sources.
    pub sources: Vec<SourceTruth>,
    out: Option<Folder>,
    scenario_text: String,
    track: Track,
    gantries: Vec<GantryTrack>,
    beliefs: BeliefTrack,
    pictures: Option<Pictures>,
    echoes: Echoes,
    plume: Option<PlumeFrame>,
    plume_film: PlumeFilm,
    interfaces: Vec<f64>,
    obstacles: Vec<ObstacleOutline>,
    failure: Option<ReportError>,
}

/// Whose results they are.
pub(super) struct ResultsOwner {
    pub(super) loaded: Loaded,
    pub(super) out: Option<Folder>,
    pub(super) spin_up_kept: bool,
}

impl RunResults {
    /// From what was gathered; `walls` are the times that spin-up and mission took.
    pub(super) fn assemble(
        mut gathered: Gatherer,
        whose: ResultsOwner,
        trial: &Trial,
        ended: &RunEnd,
        walls: [Duration; 2],
    ) -> Self {
        let scenario = &whose.loaded.scenario;
        let sources = SourceTruth::from_run(trial, ended);
        let end = SummaryEnd {
            outcome: match gathered.failure {
                Some(_) => RunOutcome::Failed,
                None => ended.outcome,
            },
            error: gathered.failure.as_ref().map(ToString::to_string),
            digest: ended.digest.clone(),
            score: trial.score().clone(),
            totals: Totals {
                spin_up_s: scenario.time.spin_up_s.get(),
                spin_up_kept: whose.spin_up_kept,
                ..totals(trial, ended, walls)
            },
        };
        gathered.builder.added(trial);
        Self {
            summary: gathered.builder.finish(&end, &sources),
            sources,
            interfaces: (scenario.water.currents.iter())
                .flat_map(|c| c.scales().interfaces)
                .map(|i| i.depth_m)
                .map(|depth_m| -depth_m)
                .collect(),
            obstacles: outlines(trial.simulation.ocean(), &scenario.permeable),
            out: whose.out,
            scenario_text: whose.loaded.text().into_owned(),
            track: gathered.track.finish(),
            gantries: gathered.probes.finish(),
            beliefs: gathered.beliefs,
            pictures: gathered.pictures,
            echoes: gathered.echoes,
            plume: (gathered.plume_seen).then(|| plume_at_end(trial, ended.t_s, scenario.record.plume_points)),
            plume_film: gathered.plume_film,
            failure: gathered.failure,
        }
    }

    /// The figures of the run. Nothing is written.
    pub fn figures(&self, ocean: &Ocean) -> Vec<Figure> {
        figures(&self.report(ocean))
    }

    /// The data of the [animation](crate::report::film) of the run; `None` if nothing moved.
    pub fn film(&self, ocean: &Ocean) -> Option<String> {
        film(&self.report(ocean))
    }

    /// A picture of the tracks in plan as a `data:` address of at most 1000 pixels on each side; `None` if
    /// nothing moved.
    ///
    /// # Errors
    /// If it cannot be drawn.
    pub fn still(&self, ocean: &Ocean) -> Option<Result<String, String>> {
        let run = self.report(ocean);
        let svg = if run.track.robots.is_empty() {
            let gantry = run.gantries.first()?;
            guarded(|| draw::flume(&run, gantry)).transpose()?
        } else {
            guarded(|| draw::map(&run))
        };
        let png = svg.and_then(|svg| small_png(&svg, STILL_PX));
        Some(png.map(|png| format!("data:image/png;base64,{}", STANDARD.encode(png))))
    }

    /// Writes summary, plume, figures and page into the folder, if there is one. Then other runs may write there.
    ///
    /// # Errors
    /// If something could not be written, in the run or here; all other files are.
    pub fn write(&mut self, ocean: &Ocean) -> Result<(), ReportError> {
        let report = self.report(ocean);
        let written = (self.out.as_ref()).map_or(Ok(Vec::new()), |out| {
            let written = write_all(out, &report);
            out.leave();
            written
        });
        let failures = self.failure.take().into_iter().chain(written.err());
        ReportError::combine(failures.collect()).map_or(Ok(()), Err)
    }

    /// The folder of the results, if they are written.
    pub fn out(&self) -> Option<&Folder> {
        self.out.as_ref()
    }

    fn report<'a>(&'a self, ocean: &'a Ocean) -> RunReport<'a> {
        RunReport {
            pictures: self.pictures.as_ref().map_or(&[], Pictures::shown),
            echoes: &self.echoes,
            summary: &self.summary,
            track: &self.track,
            gantries: &self.gantries,
            beliefs: &self.beliefs,
            plume: self.plume.as_ref(),
            plume_film: &self.plume_film,
            dye: (!self.sources.is_empty()).then_some(ocean.plume()),
            area: &ocean.area,
            terrain: &ocean.terrain,
            sources: &self.sources,
            interfaces: &self.interfaces,
            obstacles: &self.obstacles,
            solids: Some(&ocean.obstacles),
            scenario_text: &self.scenario_text,
        }
    }
}

fn totals(trial: &Trial, ended: &RunEnd, [spin_up, mission]: [Duration; 2]) -> Totals {
    let plume = trial.simulation.ocean().plume();
    Totals {
        mission_s: ended.t_s,
        mission_wall_s: mission.as_secs_f64(),
        spin_up_wall_s: spin_up.as_secs_f64(),
        steps: ended.steps,
        filaments: plume.len(),
        mass: (!plume.sources().is_empty())
            .then(|| MassBalance::new(plume.mass_released_kg(), plume.mass_in_kg(), plume.mass_left_kg())),
        ..Totals::default()
    }
}

/// The plume at the end of a run. The last one that was recorded may be older by as much as `record.plume_period_s`.
fn plume_at_end(trial: &Trial, t_s: f64, most: u32) -> PlumeFrame {
    let ocean = trial.simulation.ocean();
    let plume = ocean.plume();
    PlumeFrame { t_s, total: plume.len(), points: plume.decimated(most as usize), centre: ocean.area.centre }
}

fn outlines(ocean: &Ocean, permeable: &[String]) -> Vec<ObstacleOutline> {
    let outline = |o: &world::obstacles::Obstacle| {
        let (low, high) = o.bounds();
        ObstacleOutline {
            id: o.id.clone(),
            corners: o.outline(),
            z: [low.z, high.z],
            permeable: permeable.contains(&o.id),
        }
    };
    ocean.obstacles.0.iter().map(outline).collect()
}
