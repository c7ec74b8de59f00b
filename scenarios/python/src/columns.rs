//! What each machine did, as columns with a row for each moment: of a robot those of `track.csv`, with all digits and
//! without gaps.

use super::arrays::{array, column, texts};
use output::results::{COLUMNS, RobotInfo, numbers};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rheotaxis::frame::{Frame, GantryFrame, RobotFrame};

/// The columns that are no numbers but a yes or no.
const FLAGS: [&str; 3] = ["detected", "spike", "blocked"];

/// The columns of a gantry, each with the shape of its rows; 0 stands for the number of probes.
const OF_GANTRY: [(&str, &[usize]); 10] = [
    ("scan_s", &[]),
    ("head_m", &[3]),
    ("joint_m", &[2]),
    ("joint_m_s", &[2]),
    ("tip_m", &[0, 3]),
    ("volts", &[0]),
    ("threshold_v", &[0]),
    ("spike", &[0]),
    ("spike_hz", &[]),
    ("blocked", &[]),
];

/// The columns of one machine.
#[derive(Debug)]
pub(crate) struct MachineColumns {
    /// Id of the machine.
    pub(crate) id: String,
    t_s: Vec<f64>,
    /// Each column with its name, the shape of a row, and its values.
    all: Vec<(&'static str, Vec<usize>, Vec<f64>)>,
    behaviours: Vec<&'static str>,
    /// Concentration at full scale of a robot's chemical sensor, µg/L.
    full_scale_ug_l: Option<f64>,
    /// The newest scan of a gantry's probes, s.
    scanned_s: Option<f64>,
}

impl MachineColumns {
    fn new(id: &str, all: impl Iterator<Item = (&'static str, Vec<usize>)>) -> Self {
        Self {
            id: id.to_owned(),
            t_s: Vec::new(),
            all: all.map(|(name, shape)| (name, shape, Vec::new())).collect(),
            behaviours: Vec::new(),
            full_scale_ug_l: None,
            scanned_s: None,
        }
    }

    /// Those of a robot, without a row.
    pub(crate) fn of_robot(info: &RobotInfo) -> Self {
        let all = COLUMNS.iter().map(|c| (c.name, Vec::new()));
        Self { full_scale_ug_l: info.full_scale_ug_l, ..Self::new(&info.id, all) }
    }

    fn of_gantry(g: &GantryFrame) -> Self {
        let long = |n: &usize| if *n == 0 { g.tips_W.len() } else { *n };
        Self::new(&g.id, OF_GANTRY.iter().map(|(name, shape)| (*name, shape.iter().map(long).collect())))
    }

    /// Adds the rows of a frame to the columns of its robots.
    pub(crate) fn push_robots(all: &mut [Self], frame: &Frame) {
        for robot in &frame.robots {
            if let Some(columns) = all.iter_mut().find(|c| c.id == robot.id) {
                columns.robot(frame.t_s, robot);
            }
        }
    }

    /// Adds the rows of a frame to the columns of its gantries, and the columns of gantries that are new.
    pub(crate) fn push_gantries(all: &mut Vec<Self>, frame: &Frame) {
        for gantry in &frame.gantries {
            let known = all.iter().position(|c| c.id == gantry.id);
            let k = known.unwrap_or_else(|| {
                all.push(Self::of_gantry(gantry));
                all.len() - 1
            });
            all[k].gantry(frame.t_s, gantry);
        }
    }

    fn robot(&mut self, t_s: f64, robot: &RobotFrame) {
        self.t_s.push(t_s);
        for (column, value) in self.all.iter_mut().zip(numbers(robot, self.full_scale_ug_l)) {
            column.2.push(value.unwrap_or(f64::NAN));
        }
        self.behaviours.push(robot.behaviour.name());
    }

    fn gantry(&mut self, t_s: f64, g: &GantryFrame) {
        let scan_s = g.scan.map(|s| s.t_s);
        // The spikes belong to the newest scan, and are told once.
        let new = scan_s.is_some() && scan_s != self.scanned_s;
        self.scanned_s = scan_s;
        let flag = |yes: bool| f64::from(u8::from(yes));
        let probes = 0..g.tips_W.len();
        let row: [Vec<f64>; OF_GANTRY.len()] = [
            vec![scan_s.unwrap_or(f64::NAN)],
            g.head_W.as_slice().to_vec(),
            g.joints.map(|j| j.position_m).to_vec(),
            g.joints.map(|j| j.speed_m_s).to_vec(),
            g.tips_W.iter().flat_map(|tip| tip.iter().copied()).collect(),
            probes.clone().map(|n| g.scan.map_or(f64::NAN, |s| s.volts[n])).collect(),
            probes.clone().map(|n| g.shown.threshold_v[n]).collect(),
            probes.map(|n| flag(new && g.shown.spike[n])).collect(),
            vec![g.shown.spike_hz],
            vec![flag(g.readings.blocked)],
        ];
        self.t_s.push(t_s);
        for (column, values) in self.all.iter_mut().zip(row) {
            column.2.extend(values);
        }
        self.behaviours.push(g.behaviour.name());
    }

    /// The columns by name, as arrays of one length. Where there is no number stands NaN.
    pub(crate) fn arrays<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        dict.set_item("t_s", column(py, &self.t_s)?)?;
        for (name, shape, values) in &self.all {
            let shape: Vec<usize> = [self.t_s.len()].iter().chain(shape).copied().collect();
            let made = if FLAGS.contains(name) {
                let flags: Vec<bool> = values.iter().map(|v| *v > 0.0).collect();
                array(py, &flags, &shape)?
            } else {
                array(py, values, &shape)?
            };
            dict.set_item(name, made)?;
        }
        dict.set_item("behaviour", texts(py, &self.behaviours)?)?;
        Ok(dict)
    }
}
