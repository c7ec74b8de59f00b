//! The identity of a run, and all data for its figures and report.

use super::{BeliefTrack, Echoes, GantryTrack, PlumeFilm, RobotTrack, ShownPicture, SourceTruth, Summary, Track};
use nalgebra::Vector2;
use rheotaxis::frame::PlumeFrame;
use world::area::Area;
use world::fields::Concentration;
use world::obstacles::Obstacles;
use world::seeds::Seed;
use world::terrain::Terrain;

/// The identity of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct RunInfo {
    /// Name of the scenario.
    pub scenario_name: String,
    /// Its title.
    pub title: String,
    /// Its rule of success, in words.
    pub success: String,
    /// Text of its file.
    pub scenario_text: String,
    /// Seed of the run.
    pub seed: Seed,
    /// Version of the program.
    pub version: String,
}

/// Outline of something solid, as the map shows it.
#[derive(Clone, Debug, PartialEq)]
pub struct ObstacleOutline {
    /// Its id in the scenario.
    pub id: String,
    /// Corners (east, north) in order, m.
    pub corners: Vec<[f64; 2]>,
    /// Heights of its lowest and highest point (z, ENU), m.
    pub z: [f64; 2],
    /// Whether water and dye pass through it.
    pub permeable: bool,
}

/// The input from which [`write_all`](crate::report::write_all) makes files.
#[derive(Clone)]
pub struct RunReport<'a> {
    /// The results of the run.
    pub summary: &'a Summary,
    /// The tracks of the robots.
    pub track: &'a Track,
    /// The tracks of the gantries.
    pub gantries: &'a [GantryTrack],
    /// The robots' maps of where the source may be.
    pub beliefs: &'a BeliefTrack,
    /// Pictures that cameras took; their files already exist.
    pub pictures: &'a [ShownPicture],
    /// The echoes of sidescan sonars.
    pub echoes: &'a Echoes,
    /// Some of the plume's filaments at the end; `None` in a run without a plume.
    pub plume: Option<&'a PlumeFrame>,
    /// Some of its filaments over the run, for the animation.
    pub plume_film: &'a PlumeFilm,
    /// The chemical in the water at the end, for sections through it.
    pub dye: Option<&'a dyn Concentration>,
    /// The operating area.
    pub area: &'a Area,
    /// The bed.
    pub terrain: &'a Terrain,
    /// True sources and the flow there.
    pub sources: &'a [SourceTruth],
    /// Mean heights of the interfaces between layers of water, top first (z, ENU), m.
    pub interfaces: &'a [f64],
    /// Solid things.
    pub obstacles: &'a [ObstacleOutline],
    /// The obstacles themselves, for sections through them; if `None`, outline and heights are used.
    pub solids: Option<&'a Obstacles>,
    /// Text of the scenario's file.
    pub scenario_text: &'a str,
}

impl<'a> RunReport<'a> {
    /// The source that was declared best; the first one if none was.
    pub(crate) fn best_declared(&self) -> Option<&'a SourceTruth> {
        let robots = (self.track.robots.iter()).flat_map(RobotTrack::declared_inside);
        let gantries = self.gantries.iter().filter_map(|g| g.declared);
        let declared: Vec<Vector2<f64>> = robots.chain(gantries).map(Vector2::from).collect();
        let away = |s: &SourceTruth| {
            let all = declared.iter().map(|d| (s.position.xy() - d).norm());
            all.fold(f64::INFINITY, f64::min)
        };
        self.sources.iter().min_by(|a, b| away(a).total_cmp(&away(b)))
    }
}
