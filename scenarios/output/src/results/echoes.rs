//! Echoes of sidescan sonars, kept as pictures of straight passes for figure and recording.

use eyes::sidescan::{Row, Waterfall};
use rheotaxis::frame::PingFrame;

/// A vehicle that turns faster than this makes no picture, rad/s.
const TURNING_RAD_S: f64 = 0.05;
/// A pass ends if it gets no ping for this long, s.
const APART_S: f64 = 2.0;
/// Passes with fewer lines are omitted.
const FEWEST: usize = 40;
/// Most passes kept for a robot: the newest ones.
const MOST: usize = 32;

/// The passes of one robot.
#[derive(Clone, Debug)]
pub struct RobotEchoes {
    /// Id of the robot.
    pub id: String,
    passes: Vec<Waterfall>,
    last_s: f64,
}

impl RobotEchoes {
    /// Its passes in order of time, without short ones.
    pub fn passes(&self) -> impl Iterator<Item = &Waterfall> {
        self.passes.iter().filter(|p| p.rows().len() >= FEWEST)
    }
}

/// The passes of all robots with a sidescan.
#[derive(Clone, Debug, Default)]
pub struct Echoes {
    /// One entry for each robot.
    pub robots: Vec<RobotEchoes>,
}

impl Echoes {
    /// Adds a ping; returns the line of a picture that it completes, if any.
    pub fn push(&mut self, frame: &PingFrame) -> Option<&Row> {
        if frame.estimate.attitude.rates_rad_s.z.abs() > TURNING_RAD_S {
            return None;
        }
        let k = match self.robots.iter().position(|r| r.id == frame.robot) {
            Some(k) => k,
            None => {
                self.robots.push(RobotEchoes {
                    id: frame.robot.clone(),
                    passes: Vec::new(),
                    last_s: f64::NEG_INFINITY,
                });
                self.robots.len() - 1
            }
        };
        let robot = &mut self.robots[k];
        if frame.t_s - robot.last_s > APART_S {
            robot.passes.retain(|p| p.rows().len() >= FEWEST);
            if robot.passes.len() == MOST {
                robot.passes.remove(0);
            }
            robot.passes.push(Waterfall::default());
        }
        robot.last_s = frame.t_s;
        let pass = robot.passes.last_mut()?;
        let before = pass.rows().len();
        pass.push(&frame.ping, &frame.estimate);
        pass.rows().get(before)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;
    use nalgebra::Vector3;
    use world::units::Heading;

    #[test]
    fn straight_passes_are_kept_and_turns_are_not() {
        let level: std::sync::Arc<[f32]> = vec![20.0; 400].into();
        let mut robot = sample::robot(Vector3::zeros(), Heading::from_deg(0.0));
        robot.estimate.altitude_m = Some(2.0);
        robot.estimate.v_ground_body.x = 2.0;
        let mut echoes = Echoes::default();
        let mut lines = 0;
        for k in 0..1000 {
            let t_s = f64::from(k) * 0.1;
            robot.estimate.t_s = t_s;
            // 30 s straight, 10 s of turning, and the same again.
            robot.estimate.attitude.rates_rad_s.z = if k % 400 < 300 { 0.0 } else { 0.15 };
            let frame = sample::ping(&robot, t_s, level.clone(), level.clone());
            lines += usize::from(echoes.push(&frame).is_some());
        }
        let kept: Vec<usize> = echoes.robots[0].passes().map(|p| p.rows().len()).collect();
        // The first ping of a pass has no predecessor from which to measure the distance.
        assert_eq!(kept, [299, 299, 199]);
        assert_eq!(lines, 299 + 299 + 199);
    }
}
