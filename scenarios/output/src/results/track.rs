//! `track.csv`: where each robot was, and what it believed, read and did. The same data are kept for the figures.

use super::table_file::TableFile;
use super::thinning::Thinning;
use super::track_columns::{DECIMALS, columns, numbers};
use crate::columns::header;
use crate::files::ReportError;
use rheotaxis::frame::{Frame, RobotFrame};
use robots::handoff::{Behaviour, Declaration, Layer, Region, Vertical, region_name};
use std::collections::BTreeSet;
use std::path::Path;

/// What tables and figures need to know about a robot beforehand.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RobotInfo {
    /// Its id in the scenario.
    pub id: String,
    /// Concentration at full scale of its chemical sensor, µg/L; `None` without a sensor.
    pub full_scale_ug_l: Option<f64>,
    /// Detection threshold as a share of full scale.
    pub threshold: Option<f64>,
    /// Whether its mission has subregions.
    pub regions: bool,
    /// Whether its planner has layers.
    pub layered: bool,
    /// Names of the numbers that its instruments of other crates give.
    pub numbers: Vec<&'static str>,
}

/// One moment of one robot, as the figures need it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackRow {
    /// Time, s.
    pub t_s: f64,
    /// True position (ENU), m.
    pub p: [f64; 3],
    /// Believed position (east, north), m.
    pub believed: [f64; 2],
    /// True altitude, m.
    pub altitude_m: f64,
    /// Commanded altitude, m.
    pub altitude_asked_m: Option<f64>,
    /// Commanded depth, m.
    pub depth_asked_m: Option<f64>,
    /// Chemical reading as a share of full scale.
    pub reading: Option<f64>,
    /// Behaviour.
    pub behaviour: Behaviour,
}

/// A point where a robot lost the plume, while it stood in its list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LostPoint {
    /// Where, as it believed (east, north), m.
    pub p: [f64; 2],
    /// Since when, s.
    pub from_s: f64,
    /// When it left the list or was moved, s; `None` if it stands at the end.
    pub until_s: Option<f64>,
}

/// A robot's whole track.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RobotTrack {
    /// Data of the robot.
    pub info: RobotInfo,
    /// Its moments; evenly thinned if the run is long.
    pub rows: Vec<TrackRow>,
    /// True positions (east, north, m) of detections; all of them, up to a limit.
    pub detections: Vec<[f64; 2]>,
    /// Points where it lost the plume, in its final belief, in a subregion or the run (east, north), m.
    pub lost_points: Vec<[f64; 2]>,
    /// All such points over time, up to a limit.
    pub lost_over_time: Vec<LostPoint>,
    lost_now: Vec<[f64; 2]>,
    /// Its declarations so far.
    pub declarations: Vec<Declaration>,
    /// The present state of the subregions of its mission.
    pub regions: Vec<Region>,
    region: Option<u32>,
    lost_before: usize,
    /// States of its planner's layers, each from a time (s) until the next, up to a limit.
    pub layers: Vec<(f64, Vec<Layer>)>,
    thinning: Thinning,
}

/// The tracks of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Track {
    /// One for each robot, in the scenario's order.
    pub robots: Vec<RobotTrack>,
}

/// Most moments kept for a robot: three hours at 10 Hz are thinned to every fourth, which is all that a figure can
/// show.
const KEPT: usize = 40_000;

/// Most lost points kept over time.
const LOST: usize = 400;

impl RobotTrack {
    fn new(info: RobotInfo) -> Self {
        Self { info, ..Self::default() }
    }

    /// Where it declared sources (east, north), m.
    pub fn declared(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.declarations.iter().map(|d| [d.position.x, d.position.y])
    }

    /// The declared sources, without the plumes traced to an edge.
    pub fn declared_inside(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let inside = self.declarations.iter().filter(|d| !d.at_edge());
        inside.map(|d| [d.position.x, d.position.y])
    }

    /// How high a declared source is drawn (up from the still surface), m: where its rule puts it, or else where the
    /// vehicle was when it declared. `None` before the first moment.
    pub fn declared_z(&self, declared: &Declaration) -> Option<f64> {
        let apart = |r: &&TrackRow| (r.t_s - declared.t_s).abs();
        let nearest = || (self.rows.iter()).min_by(|a, b| apart(a).total_cmp(&apart(b)));
        declared.z_m.or_else(|| nearest().map(|r| r.p[2]))
    }

    /// Notes which lost points are new, and which have gone.
    fn lost(&mut self, t_s: f64, r: &RobotFrame) {
        let new = r.shown.lost_points.iter().map(|q| [q.x, q.y]);
        if self.lost_now.iter().copied().eq(new.clone()) {
            return;
        }
        let new: Vec<[f64; 2]> = new.collect();
        for old in &mut self.lost_over_time {
            if old.until_s.is_none() && !new.contains(&old.p) {
                old.until_s = Some(t_s);
            }
        }
        for &p in new.iter().filter(|p| !self.lost_now.contains(p)) {
            if self.lost_over_time.len() < LOST {
                self.lost_over_time.push(LostPoint { p, from_s: t_s, until_s: None });
            }
        }
        self.lost_now = new;
    }

    fn push(&mut self, t_s: f64, r: &RobotFrame) {
        let p = r.truth.pose.p_WB;
        if r.detected && self.detections.len() < KEPT {
            self.detections.push([p.x, p.y]);
        }
        // Those of earlier subregions are kept.
        if r.shown.regions.now.is_some() && r.shown.regions.now != self.region {
            self.region = r.shown.regions.now;
            self.lost_before = self.lost_points.len();
        }
        if !r.shown.lost_points.is_empty() {
            self.lost_points.truncate(self.lost_before);
            self.lost_points.extend(r.shown.lost_points.iter().map(|q| [q.x, q.y]));
        }
        self.lost(t_s, r);
        if self.declarations != r.declarations {
            self.declarations.clone_from(&r.declarations);
        }
        self.regions = r.shown.regions.all.clone();
        let new = self.layers.last().is_none_or(|l| l.1 != r.shown.layers);
        if new && !r.shown.layers.is_empty() && self.layers.len() < KEPT {
            self.layers.push((t_s, r.shown.layers.clone()));
        }
        let asked = r.asked_height();
        self.thinning.push(&mut self.rows, KEPT, || TrackRow {
            t_s,
            p: [p.x, p.y, p.z],
            believed: [r.estimate.position.x, r.estimate.position.y],
            altitude_m: r.altitude_m,
            altitude_asked_m: match asked {
                Some(Vertical::Altitude(m)) => Some(m),
                _ => None,
            },
            depth_asked_m: match asked {
                Some(Vertical::Depth(m)) => Some(m),
                _ => None,
            },
            reading: r.chemical.map(|c| c.of_full_scale),
            behaviour: r.behaviour,
        });
    }
}

/// The table being written.
#[derive(Debug)]
pub struct TrackTable {
    file: Option<TableFile>,
    layered: bool,
    track: Track,
    /// Whether the table has the column of subregions.
    regions: bool,
    /// Numbers of instruments of other crates, a column each.
    numbers: Vec<&'static str>,
}

impl TrackTable {
    /// Makes a table that grows in `path`; the folder must exist. Without robots there is nothing to write, and no
    /// file.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn create(path: &Path, robots: Vec<RobotInfo>) -> Result<Self, ReportError> {
        if robots.is_empty() {
            return Ok(Self::in_memory(robots));
        }
        // There is a column for layers or subregions only if a robot has them.
        let mut table = Self::in_memory(robots);
        table.file = Some(TableFile::create(path, &header(&columns(table.regions, table.layered, &table.numbers)))?);
        Ok(table)
    }

    /// Keeps data for the figures only, without a file.
    pub fn in_memory(robots: Vec<RobotInfo>) -> Self {
        let numbers: BTreeSet<&'static str> = robots.iter().flat_map(|r| r.numbers.iter().copied()).collect();
        Self {
            numbers: numbers.into_iter().collect(),
            file: None,
            layered: robots.iter().any(|r| r.layered),
            regions: robots.iter().any(|r| r.regions),
            track: Track { robots: robots.into_iter().map(RobotTrack::new).collect() },
        }
    }

    /// Adds a row for each robot.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn push(&mut self, frame: &Frame) -> Result<(), ReportError> {
        for r in &frame.robots {
            let k = match self.track.robots.iter().position(|k| k.info.id == r.id) {
                Some(k) => k,
                None => {
                    let id = r.id.clone();
                    self.track.robots.push(RobotTrack::new(RobotInfo { id, ..RobotInfo::default() }));
                    self.track.robots.len() - 1
                }
            };
            let robot = &mut self.track.robots[k];
            robot.push(frame.t_s, r);
            if let Some(file) = &mut self.file {
                row(file, frame.t_s, r, &robot.info);
                if self.regions {
                    file.text(&r.shown.regions.now.map_or_else(String::new, region_name));
                }
                if self.layered {
                    file.text(r.holding_layer().unwrap_or(""));
                }
                for name in &self.numbers {
                    file.number(r.readings.other.get(name).map(|reading| reading.value), 6);
                }
                file.end_row()?;
            }
        }
        Ok(())
    }

    /// The tracks, for the figures.
    pub fn finish(self) -> Track {
        self.track
    }
}

/// The fields that every row has.
fn row(table: &mut TableFile, t_s: f64, r: &RobotFrame, info: &RobotInfo) {
    table.number(t_s, 3);
    table.text(&r.id);
    for (number, places) in numbers(r, info.full_scale_ug_l).into_iter().zip(DECIMALS) {
        table.number(number, places);
    }
    table.text(r.behaviour.name());
}
