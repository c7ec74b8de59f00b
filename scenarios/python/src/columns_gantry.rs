//! What each gantry did, as columns.

use super::arrays::{array, column, texts};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rheotaxis::frame::Frame;
use rheotaxis::gantry::GantryFrame;

/// The columns of one gantry.
#[derive(Debug, Default)]
pub(crate) struct GantryColumns {
    id: String,
    /// How many probes it has.
    probes: usize,
    scanned_s: Option<f64>,
    t_s: Vec<f64>,
    scan_s: Vec<f64>,
    head: Vec<f64>,
    joints: Vec<f64>,
    speeds: Vec<f64>,
    tips: Vec<f64>,
    volts: Vec<f64>,
    thresholds: Vec<f64>,
    spikes: Vec<bool>,
    spike_hz: Vec<f64>,
    blocked: Vec<bool>,
    behaviours: Vec<&'static str>,
}

impl GantryColumns {
    /// Adds the rows of a frame, and the columns of gantries that are new.
    pub(crate) fn push(all: &mut Vec<Self>, frame: &Frame) {
        for gantry in &frame.gantries {
            let known = all.iter().position(|c| c.id == gantry.id);
            let k = known.unwrap_or_else(|| {
                all.push(Self { id: gantry.id.clone(), probes: gantry.tips_W.len(), ..Self::default() });
                all.len() - 1
            });
            all[k].row(frame.t_s, gantry);
        }
    }

    fn row(&mut self, t_s: f64, g: &GantryFrame) {
        let scan_s = g.scan.map(|s| s.t_s);
        // The spikes belong to the newest scan, and are told once.
        let new = scan_s.is_some() && scan_s != self.scanned_s;
        self.scanned_s = scan_s;
        self.t_s.push(t_s);
        self.scan_s.push(scan_s.unwrap_or(f64::NAN));
        self.head.extend(g.head_W.iter());
        self.joints.extend(g.joints.map(|j| j.position_m));
        self.speeds.extend(g.joints.map(|j| j.speed_m_s));
        self.tips.extend(g.tips_W.iter().flat_map(|tip| tip.iter()));
        let working = &g.decision.working;
        for n in 0..self.probes {
            self.volts.push(g.scan.map_or(f64::NAN, |s| s.volts[n]));
            self.thresholds.push(working.threshold_v[n]);
            self.spikes.push(new && working.spike[n]);
        }
        self.spike_hz.push(working.spike_hz);
        self.blocked.push(g.readings.blocked);
        self.behaviours.push(g.decision.behaviour.name());
    }

    /// Id of the gantry.
    pub(crate) fn id(&self) -> &str {
        &self.id
    }

    /// The columns by name, as arrays with one row for each moment.
    pub(crate) fn arrays<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (rows, probes) = (self.t_s.len(), self.probes);
        let dict = PyDict::new(py);
        dict.set_item("t_s", column(py, &self.t_s)?)?;
        dict.set_item("scan_s", column(py, &self.scan_s)?)?;
        dict.set_item("head_m", array(py, &self.head, &[rows, 3])?)?;
        dict.set_item("joint_m", array(py, &self.joints, &[rows, 2])?)?;
        dict.set_item("joint_m_s", array(py, &self.speeds, &[rows, 2])?)?;
        dict.set_item("tip_m", array(py, &self.tips, &[rows, probes, 3])?)?;
        dict.set_item("volts", array(py, &self.volts, &[rows, probes])?)?;
        dict.set_item("threshold_v", array(py, &self.thresholds, &[rows, probes])?)?;
        dict.set_item("spike", array(py, &self.spikes, &[rows, probes])?)?;
        dict.set_item("spike_hz", column(py, &self.spike_hz)?)?;
        dict.set_item("blocked", column(py, &self.blocked)?)?;
        dict.set_item("behaviour", texts(py, &self.behaviours)?)?;
        Ok(dict)
    }
}
