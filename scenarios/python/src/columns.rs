//! What each robot did, as columns: those of `track.csv`, with all digits and without gaps.

use super::arrays::{column, texts};
use output::columns::ColumnInfo;
use output::results::{COLUMNS, RobotInfo, numbers};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rheotaxis::frame::{Frame, RobotFrame};

/// The column that is no number but a yes or no.
const DETECTED: &str = "detected";

/// The columns of one robot.
#[derive(Debug)]
pub(crate) struct RobotColumns {
    info: RobotInfo,
    t_s: Vec<f64>,
    numbers: [Vec<f64>; COLUMNS.len()],
    behaviours: Vec<&'static str>,
}

impl RobotColumns {
    /// Without a row.
    pub(crate) fn new(info: &RobotInfo) -> Self {
        Self { info: info.clone(), t_s: Vec::new(), numbers: Default::default(), behaviours: Vec::new() }
    }

    /// Adds the rows of a frame to the columns of its robots.
    pub(crate) fn push(all: &mut [Self], frame: &Frame) {
        for robot in &frame.robots {
            if let Some(columns) = all.iter_mut().find(|c| c.info.id == robot.id) {
                columns.row(frame.t_s, robot);
            }
        }
    }

    fn row(&mut self, t_s: f64, robot: &RobotFrame) {
        self.t_s.push(t_s);
        for (column, value) in self.numbers.iter_mut().zip(numbers(robot, self.info.full_scale_ug_l)) {
            column.push(value.unwrap_or(f64::NAN));
        }
        self.behaviours.push(robot.behaviour.name());
    }

    /// Id of the robot.
    pub(crate) fn id(&self) -> &str {
        &self.info.id
    }

    /// The columns by name, as arrays of one length. Where there is no number stands NaN.
    pub(crate) fn arrays<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        dict.set_item("t_s", column(py, &self.t_s)?)?;
        for (ColumnInfo { name, .. }, values) in COLUMNS.iter().zip(&self.numbers) {
            if *name == DETECTED {
                let detected: Vec<bool> = values.iter().map(|v| *v > 0.0).collect();
                dict.set_item(name, column(py, &detected)?)?;
            } else {
                dict.set_item(name, column(py, values)?)?;
            }
        }
        dict.set_item("behaviour", texts(py, &self.behaviours)?)?;
        Ok(dict)
    }
}
