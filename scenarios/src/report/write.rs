//! Everything a run leaves behind, written into one folder.

use super::files::{ReportError, make_folder, write_whole};
use super::probes::file_name;
use super::{
    BeliefTrack, Echoes, GantryTrack, ShownPicture, SourceTruth, Summary, Track, belief_track,
    figures, html, odour,
};
use crate::frame::PlumeFrame;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use world::area::Area;
use world::fields::Concentration;
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
#[derive(Clone)]
pub struct RunReport<'a> {
    /// What the run came to.
    pub summary: &'a Summary,
    /// Where the robots went.
    pub track: &'a Track,
    /// What the gantries did.
    pub gantries: &'a [GantryTrack],
    /// The robots' maps of where the source may be.
    pub beliefs: &'a BeliefTrack,
    /// Pictures that cameras took; their files are there already.
    pub pictures: &'a [ShownPicture],
    /// What sidescan sonars heard.
    pub echoes: &'a Echoes,
    /// Some of the plume's filaments at the end; none in a run without one.
    pub plume: Option<&'a PlumeFrame>,
    /// What is dissolved in the water at the end, for sections through it.
    pub dye: Option<&'a dyn Concentration>,
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

/// Writes `summary.json`, `plume.csv`, figures and `report.html` into a folder, making it if need be; the paths of what
/// was written. Figures, each as `.svg` and `.png`: `map` (left out where gantries are alone), `series-<robot>`, and
/// `flume-<gantry>`, `probes-<gantry>`, `approach-<gantry>`.
/// For robots that keep a map also `belief-<robot>` and `convergence`, and `belief-<robot>.csv`; for those whose map says more
/// of the odour `odour-<robot>`, with a table; for one whose sidescan surveyed a declared place `sidescan-<robot>`.
///
/// # Errors
/// If the folder or a file cannot be written.
pub fn write_all(out_dir: &Path, run: &RunReport<'_>) -> Result<Vec<PathBuf>, ReportError> {
    make_folder(out_dir)?;
    let mut written = vec![run.summary.write_json(&out_dir.join("summary.json"))?];
    if let Some(plume) = run.plume {
        let path = out_dir.join("plume.csv");
        written.push(write_whole(&path, plume_csv(plume, run.area).as_bytes())?);
    }
    for robot in &run.beliefs.robots {
        let path = out_dir.join(format!("belief-{}.csv", file_name(&robot.id)));
        let csv = belief_track::csv(robot, run.sources);
        written.push(write_whole(&path, csv.as_bytes())?);
        if !robot.odour.is_empty() {
            let path = out_dir.join(format!("odour-{}.csv", file_name(&robot.id)));
            written.push(write_whole(&path, odour::csv(&robot.odour).as_bytes())?);
        }
    }
    let mut shown = Vec::new();
    for (name, title, svg) in figures_of(run) {
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
    shown.extend(run.pictures.iter().map(|p| (p.title(), p.html())));
    let page = html::page(run.summary, &shown, run.scenario_text);
    written.push(write_whole(&out_dir.join("report.html"), page.as_bytes())?);
    Ok(written)
}

/// Name, title and SVG of each.
fn figures_of(run: &RunReport<'_>) -> Vec<(String, String, String)> {
    let mut figures = Vec::new();
    // A gantry's own figures show all there is to see of a flume.
    if run.gantries.is_empty() || !run.track.robots.is_empty() {
        figures.push(("map".to_owned(), "Map".to_owned(), figures::map(run)));
    }
    for robot in &run.track.robots {
        let id = &robot.info.id;
        figures.push((
            format!("series-{}", file_name(id)),
            format!("Time series of {id}"),
            figures::series(run, robot),
        ));
    }
    for robot in &run.beliefs.robots {
        figures.push((
            format!("belief-{}", file_name(&robot.id)),
            format!("Where {} believed the source", robot.id),
            figures::belief(run, robot),
        ));
        if !robot.odour.is_empty() {
            figures.push((
                format!("odour-{}", file_name(&robot.id)),
                format!("Where {} believed the odour", robot.id),
                figures::odour(run, robot),
            ));
        }
    }
    for robot in &run.echoes.robots {
        figures.extend(figures::sidescan(run, robot).map(|svg| {
            let name = format!("sidescan-{}", file_name(&robot.id));
            (name, format!("Sidescan of {}", robot.id), svg)
        }));
    }
    if !run.beliefs.robots.is_empty() {
        let title = "Convergence of the maps".to_owned();
        figures.push(("convergence".to_owned(), title, figures::convergence(run)));
    }
    for t in run.gantries {
        let id = &t.info.id;
        let kinds = [
            ("flume", "Track over the plume", figures::flume(run, t)),
            (
                "probes",
                "Probes, thresholds and spikes",
                figures::probe_records(run, t),
            ),
            (
                "approach",
                "Speed and distance from the centreline",
                figures::approach(run, t),
            ),
        ];
        for (name, title, svg) in kinds {
            figures.extend(svg.map(|svg| {
                let name = format!("{name}-{}", file_name(id));
                (name, format!("{title}: {id}"), svg)
            }));
        }
    }
    figures
}

/// The filaments that the map shows, to the hundredth of a metre, or in a flume of a millimetre.
fn plume_csv(plume: &PlumeFrame, area: &Area) -> String {
    let (d, d_z, s) = if area.width_m < 10.0 {
        (5, 5, 6)
    } else {
        (2, 3, 4)
    };
    let mut text = String::from("t_s,east_m,north_m,up_m,size_m,mass_kg\n");
    for [x, y, z, size, mass] in &plume.points {
        writeln!(
            text,
            "{:.1},{x:.d$},{y:.d$},{z:.d_z$},{size:.s$},{mass:.6e}",
            plume.t_s
        )
        .expect("writing to a String succeeds");
    }
    text
}
