//! For tests: all that is told of an invented run.

use crate::results::{
    BeliefTrack, Echoes, GantryTrack, MassBalance, ObstacleOutline, PlumeFilm, RunReport, SourceTruth, Summary,
    SummaryBuilder, SummaryEnd, Totals, Track, TrackTable,
};
use crate::sample::{area, info, robots, scored, source, terrain};
use rheotaxis::frame::{Frame, PlumeFrame};
use rheotaxis::outcome::RunOutcome;
use world::area::Area;
use world::fields::Concentration;
use world::terrain::Terrain;

static NO_ECHOES: Echoes = Echoes { robots: Vec::new() };

/// What a report needs.
pub(crate) struct Told {
    pub(crate) summary: Summary,
    pub(crate) track: Track,
    pub(crate) gantries: Vec<GantryTrack>,
    pub(crate) beliefs: BeliefTrack,
    pub(crate) plume: Option<PlumeFrame>,
    pub(crate) plume_film: PlumeFilm,
    pub(crate) dye: Option<&'static dyn Concentration>,
    pub(crate) area: Area,
    pub(crate) terrain: Terrain,
    pub(crate) sources: Vec<SourceTruth>,
    pub(crate) interfaces: Vec<f64>,
    pub(crate) obstacles: Vec<ObstacleOutline>,
}

impl Told {
    /// What is told of these frames in the area of the sample.
    pub(crate) fn new(frames: &[Frame], sources: &[SourceTruth]) -> Self {
        let mut table = TrackTable::in_memory(robots());
        frames.iter().for_each(|f| table.push(f).unwrap());
        Self {
            summary: summary(RunOutcome::Found, frames, sources),
            track: table.finish(),
            gantries: Vec::new(),
            beliefs: BeliefTrack::default(),
            plume: None,
            plume_film: PlumeFilm::default(),
            dye: None,
            area: area(),
            terrain: terrain(),
            sources: sources.to_vec(),
            interfaces: Vec::new(),
            obstacles: Vec::new(),
        }
    }

    pub(crate) fn report(&self) -> RunReport<'_> {
        RunReport {
            pictures: &[],
            echoes: &NO_ECHOES,
            summary: &self.summary,
            track: &self.track,
            gantries: &self.gantries,
            beliefs: &self.beliefs,
            plume: self.plume.as_ref(),
            plume_film: &self.plume_film,
            dye: self.dye,
            area: &self.area,
            terrain: &self.terrain,
            sources: &self.sources,
            interfaces: &self.interfaces,
            obstacles: &self.obstacles,
            solids: None,
            scenario_text: "(version: 1, title: \"a < b\")\n",
        }
    }
}

/// The summary of a run of 100 s with these frames.
pub(crate) fn summary(outcome: RunOutcome, frames: &[Frame], sources: &[SourceTruth]) -> Summary {
    let mut builder = SummaryBuilder::new(&info());
    frames.iter().for_each(|f| builder.observe(f));
    let totals = Totals {
        mission_s: 100.0,
        spin_up_s: 50.0,
        mission_wall_s: 1.0,
        spin_up_wall_s: 1.0,
        spin_up_kept: false,
        steps: 5000,
        filaments: 40_000,
        mass: Some(MassBalance::new(0.3, 0.2, 0.1)),
    };
    let end = SummaryEnd { outcome, error: None, digest: "00ff".into(), score: scored(frames), totals };
    builder.finish(&end, sources)
}

/// Summary and track of the sample's frames.
pub(crate) fn told(frames: &[Frame]) -> (Summary, Track) {
    let told = Told::new(frames, &[source()]);
    (told.summary, told.track)
}
