//! Everything a run leaves behind, written into one folder.

use super::files::{ReportError, make_folder, write_whole};
use super::{BeliefTrack, SourceTruth, Summary, Track, belief_track, figures, html};
use crate::frame::PlumeFrame;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use world::area::Area;
use world::terrain::Terrain;

/// Outline of something solid, as the map shows it.
#[derive(Clone, Debug, PartialEq)]
pub struct ObstacleOutline {
    /// Its id in the scenario.
    pub id: String,
    /// Corners (east, north) in order, m.
    pub corners: Vec<[f64; 2]>,
}

/// What [`write_all`] makes files of.
#[derive(Clone, Debug)]
pub struct RunReport<'a> {
    /// What the run came to.
    pub summary: &'a Summary,
    /// Where the robots went.
    pub track: &'a Track,
    /// Their maps of where the source may be.
    pub beliefs: &'a BeliefTrack,
    /// The plume at the end; none in a run without one.
    pub plume: Option<&'a PlumeFrame>,
    /// The operating area.
    pub area: &'a Area,
    /// The bed.
    pub terrain: &'a Terrain,
    /// True sources and the flow there.
    pub sources: &'a [SourceTruth],
    /// Solid things.
    pub obstacles: &'a [ObstacleOutline],
    /// Text of the scenario's file.
    pub scenario_text: &'a str,
}

/// Writes `summary.json`, `map.{svg,png}`, `series-<robot>.{svg,png}`, `plume.csv`, of robots that keep a map
/// `belief-<robot>.{svg,png,csv}` and `convergence.{svg,png}`, and `report.html` into a folder, making it if
/// need be; the paths of what was written.
///
/// # Errors
/// If the folder or a file cannot be written.
pub fn write_all(out_dir: &Path, run: &RunReport<'_>) -> Result<Vec<PathBuf>, ReportError> {
    make_folder(out_dir)?;
    let mut written = vec![run.summary.write_json(&out_dir.join("summary.json"))?];
    if let Some(plume) = run.plume {
        let path = out_dir.join("plume.csv");
        written.push(write_whole(&path, plume_csv(plume).as_bytes())?);
    }
    let mut figures = vec![("map".to_owned(), "Map".to_owned(), figures::map(run))];
    for robot in &run.track.robots {
        let id = &robot.info.id;
        let svg = figures::series(run, robot);
        figures.push((
            format!("series-{}", safe(id)),
            format!("Time series of {id}"),
            svg,
        ));
    }
    for robot in &run.beliefs.robots {
        let name = format!("belief-{}", safe(&robot.id));
        let path = out_dir.join(format!("{name}.csv"));
        let csv = belief_track::csv(robot, run.sources);
        written.push(write_whole(&path, csv.as_bytes())?);
        let title = format!("Where {} believed the source", robot.id);
        figures.push((name, title, figures::belief(run, robot)));
    }
    if !run.beliefs.robots.is_empty() {
        let svg = figures::convergence(run);
        figures.push((
            "convergence".to_owned(),
            "Convergence of the maps".to_owned(),
            svg,
        ));
    }
    let mut shown = Vec::new();
    for (name, title, svg) in figures {
        written.push(write_whole(
            &out_dir.join(format!("{name}.svg")),
            svg.as_bytes(),
        )?);
        let path = out_dir.join(format!("{name}.png"));
        let png = figures::png(&svg).map_err(|cause| ReportError::Draw {
            path: path.clone(),
            cause,
        })?;
        written.push(write_whole(&path, &png)?);
        shown.push((title, svg));
    }
    let page = html::page(run.summary, &shown, run.scenario_text);
    written.push(write_whole(&out_dir.join("report.html"), page.as_bytes())?);
    Ok(written)
}

/// An id may hold what a file's name may not.
fn safe(id: &str) -> String {
    id.chars()
        .map(|c| if c.is_ascii_alphanumeric() { c } else { '_' })
        .collect()
}

/// The filaments that the map shows.
fn plume_csv(plume: &PlumeFrame) -> String {
    let mut text = String::from("t_s,east_m,north_m,up_m,size_m,mass_kg\n");
    for [x, y, z, size, mass] in &plume.points {
        writeln!(
            text,
            "{:.1},{x:.2},{y:.2},{z:.3},{size:.4},{mass:.6e}",
            plume.t_s
        )
        .expect("writing to a String succeeds");
    }
    text
}
