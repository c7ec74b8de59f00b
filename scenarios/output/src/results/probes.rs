//! `probes-<gantry>.csv`: readings of each gantry's probes, what its searcher derived from them, and the position of
//! its head. The same data are kept for the figures.

use super::table_file::TableFile;
use super::thinning::Thinning;
use crate::columns::{ColumnInfo, columns, header};
use crate::files::ReportError;
use rheotaxis::frame::Frame;
use rheotaxis::gantry::GantryFrame;
use robots::handoff::{Behaviour, MAX_PROBES};
use world::files::Folder;

/// What tables and figures need to know about a gantry beforehand.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GantryInfo {
    /// Its id in the scenario.
    pub id: String,
    /// Names of its probes, in the order of a scan.
    pub probes: Vec<String>,
    /// Output in clean water and at full scale, V.
    pub range_v: [f64; 2],
    /// Concentration at full scale, kg/m³.
    pub full_scale_kg_m3: f64,
    /// Concentration of the fluid that leaves the source; `None` if the source has no nozzle, kg/m³.
    pub effluent_kg_m3: Option<f64>,
}

/// One moment of one gantry, as the figures need it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GantryRow {
    /// Time, s.
    pub t_s: f64,
    /// True place of the head (east, north), m.
    pub head: [f64; 2],
    /// True speed of the head, m/s.
    pub speed_m_s: f64,
    /// Output of each probe, V; `None` before the first scan.
    pub volts: Option<[f64; MAX_PROBES]>,
    /// Threshold of each probe, V.
    pub threshold_v: [f64; MAX_PROBES],
    /// Whether the scan before this one was a spike.
    pub spike: [bool; MAX_PROBES],
    /// Recent rate of spikes, Hz.
    pub spike_hz: f64,
    /// What the searcher was doing.
    pub behaviour: Behaviour,
    /// Number of its motion command.
    pub command: u32,
}

/// A gantry's whole run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GantryTrack {
    /// Data of the gantry.
    pub info: GantryInfo,
    /// Its moments; evenly thinned if the run is long.
    pub rows: Vec<GantryRow>,
    /// Its forward direction in the world (east, north): up-stream.
    pub forward: [f64; 2],
    /// Latest true places of its probes' tips (ENU), m.
    pub tips: Vec<[f64; 3]>,
    /// Declared source (east, north), m.
    pub declared: Option<[f64; 2]>,
    /// When it stopped, s, and whether it declared a source.
    pub stopped: Option<(f64, bool)>,
    thinning: Thinning,
    scanned_s: Option<f64>,
}

/// Most moments kept for a gantry: half an hour at 20 Hz without thinning.
const KEPT: usize = 40_000;

impl GantryTrack {
    fn new(info: GantryInfo) -> Self {
        Self { info, ..Self::default() }
    }

    /// Adds a frame; returns what it says about the latest scan, if that is new.
    fn push(&mut self, t_s: f64, g: &GantryFrame) -> GantryRow {
        let new_scan = g.scan.filter(|s| self.scanned_s != Some(s.t_s));
        self.scanned_s = g.scan.map(|s| s.t_s);
        let [along, across] = g.joints.map(|j| j.speed_m_s);
        let row = GantryRow {
            t_s,
            head: [g.head_W.x, g.head_W.y],
            speed_m_s: (along * along + across * across).sqrt(),
            volts: g.scan.map(|s| s.volts),
            threshold_v: g.shown.threshold_v,
            spike: new_scan.map_or([false; MAX_PROBES], |_| g.shown.spike),
            spike_hz: g.shown.spike_hz,
            behaviour: g.behaviour,
            command: g.goal.id,
        };
        self.forward = [g.forward.x, g.forward.y];
        self.tips = g.tips_W.iter().map(|p| [p.x, p.y, p.z]).collect();
        self.declared = self.declared.or(g.declarations.first().map(|d| d.position.into()));
        self.stopped = self.stopped.or(g.stopped().map(|found| (t_s, found)));
        self.keep(row);
        row
    }

    fn keep(&mut self, row: GantryRow) {
        if !self.thinning.keeps() {
            if let Some(last) = self.rows.last_mut() {
                join(last, &row);
            }
            return;
        }
        self.rows.push(row);
        if self.rows.len() > KEPT {
            self.rows = (self.rows.chunks(2))
                .map(|pair| {
                    let mut one = pair[0];
                    pair[1..].iter().for_each(|r| join(&mut one, r));
                    one
                })
                .collect();
            self.thinning.halve();
        }
    }
}

/// Keeps a spike even if its moment is dropped.
fn join(kept: &mut GantryRow, left_out: &GantryRow) {
    for (spike, other) in kept.spike.iter_mut().zip(left_out.spike) {
        *spike |= other;
    }
}

/// The tables being written.
#[derive(Debug)]
pub struct ProbeTables {
    files: Vec<TableFile>,
    tracks: Vec<GantryTrack>,
}

impl ProbeTables {
    /// Makes a table for each gantry, which grows in `folder`.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn create(folder: &Folder, gantries: Vec<GantryInfo>) -> Result<Self, ReportError> {
        let mut files = Vec::with_capacity(gantries.len());
        for info in &gantries {
            let path = folder.file(&format!("probes-{}.csv", file_name(&info.id)))?;
            files.push(TableFile::create(&path, &names(info))?);
        }
        Ok(Self { files, ..Self::in_memory(gantries) })
    }

    /// Keeps data for the figures only, without files.
    pub fn in_memory(gantries: Vec<GantryInfo>) -> Self {
        Self { files: Vec::new(), tracks: gantries.into_iter().map(GantryTrack::new).collect() }
    }

    /// Adds a row for each gantry.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn push(&mut self, frame: &Frame) -> Result<(), ReportError> {
        for (k, g) in frame.gantries.iter().enumerate() {
            let Some(track) = self.tracks.get_mut(k) else {
                return Ok(());
            };
            let row = track.push(frame.t_s, g);
            if let Some(file) = self.files.get_mut(k) {
                line(file, g, &row);
                file.end_row()?;
            }
        }
        Ok(())
    }

    /// The tracks, for the figures.
    pub fn finish(self) -> Vec<GantryTrack> {
        self.tracks
    }
}

/// An id may contain characters that a file's name must not.
pub(crate) fn file_name(id: &str) -> String {
    id.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect()
}

/// The columns of every gantry.
pub(crate) const COLUMNS: [ColumnInfo; 18] = columns! {
    "t_s", "s", "Time since the start of the mission.";
    "scan_s", "s", "Time of the newest scan of the probes; empty before the first.";
    "behaviour", "", "What the searcher does: the name of its behaviour.";
    "command", "", "Number of its motion command; 0 before the first.";
    "head_east_m", "m", "True place of the head, east.";
    "head_north_m", "m", "True place of the head, north.";
    "head_up_m", "m", "True place of the head, up.";
    "joint_1_m", "m", "True place of the slide on the base, along its joint.";
    "joint_2_m", "m", "True place of the slide with the head, along its joint.";
    "joint_1_m_s", "m/s", "True speed of the slide on the base.";
    "joint_2_m_s", "m/s", "True speed of the slide with the head.";
    "speed_m_s", "m/s", "True speed of the head, along both slides together.";
    "arrived", "", "Whether both encoders are at their targets: 1 or 0.";
    "blocked", "", "Whether the drives gave up because something holds an axis: 1 or 0.";
    "spike_hz", "1/s", "Recent rate of spikes of all probes, as the searcher counts them.";
    "magnitude_v", "V", "Mean magnitude of spikes since the latest step, above the output in clean water.";
    "predicted_v", "V", "Magnitude that the searcher predicted for the present step; empty if it did not.";
    "contrast", "", "Bilateral contrast of the probes, left positive, -1 to 1.";
};

/// The columns of each probe.
pub(crate) const OF_PROBE: [ColumnInfo; 6] = columns! {
    "<probe>_east_m", "m", "True place of the probe's tip, east.";
    "<probe>_north_m", "m", "True place of the probe's tip, north.";
    "<probe>_up_m", "m", "True place of the probe's tip, up.";
    "<probe>_v", "V", "Output of the probe in the newest scan; empty before the first.";
    "<probe>_threshold_v", "V", "Dynamic threshold of this probe, above which its output can be a spike.";
    "<probe>_spike", "", "Whether the searcher found a spike of this probe in a scan that is new in this row: 1 or 0.";
};

fn names(info: &GantryInfo) -> String {
    let mut text = header(&COLUMNS);
    for probe in &info.probes {
        text.push(',');
        text.push_str(&header(&OF_PROBE).replace("<probe>", &file_name(probe)));
    }
    text
}

fn line(table: &mut TableFile, g: &GantryFrame, row: &GantryRow) {
    table.number(row.t_s, 3);
    table.number(g.scan.map(|s| s.t_s), 3);
    table.text(row.behaviour.name());
    table.number(f64::from(row.command), 0);
    g.head_W.iter().for_each(|v| table.number(*v, 4));
    let [a, b] = &g.joints;
    for v in [a.position_m, b.position_m, a.speed_m_s, b.speed_m_s, row.speed_m_s] {
        table.number(v, 5);
    }
    table.flag(g.readings.arrived);
    table.flag(g.readings.blocked);
    table.number(row.spike_hz, 3);
    table.number(g.shown.magnitude_v, 4);
    table.number(g.shown.predicted_v, 4);
    table.number(g.shown.contrast, 4);
    for (n, tip) in g.tips_W.iter().enumerate() {
        tip.iter().for_each(|v| table.number(*v, 4));
        table.number(row.volts.map(|v| v[n]), 4);
        table.number(row.threshold_v[n], 4);
        table.flag(row.spike[n]);
    }
}
