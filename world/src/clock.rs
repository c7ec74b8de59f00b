//! Simulated time: the number of steps times the length of a step. Slow stages run every n steps.

use bevy_ecs::prelude::Resource;

/// Simulated time. Time is always `step · dt`, never an accumulated sum.
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    /// Number of steps done so far.
    pub step: u64,
    /// Length of a step, s.
    pub dt_s: f64,
}

impl Clock {
    /// A clock at zero.
    pub fn new(dt_s: f64) -> Self {
        Self { step: 0, dt_s }
    }

    /// Simulated time, s.
    pub fn t_s(&self) -> f64 {
        self.step as f64 * self.dt_s
    }

    /// Time at the end of the present step, s.
    pub fn t_next_s(&self) -> f64 {
        (self.step + 1) as f64 * self.dt_s
    }

    /// Advances by one step.
    pub fn advance(&mut self) {
        self.step += 1;
    }
}

/// Runs something every `n` steps. Slow stages count steps; they never read the wall clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Every {
    /// Steps between two runs, at least 1.
    pub steps: u64,
}

impl Every {
    /// The number of steps that is nearest to `period_s`, for steps of `dt_s`.
    pub fn period(period_s: f64, dt_s: f64) -> Self {
        let steps = (period_s / dt_s).round().max(1.0) as u64;
        Self { steps }
    }

    /// Whether it runs in this step.
    pub fn due(self, clock: &Clock) -> bool {
        clock.step.is_multiple_of(self.steps)
    }

    /// The period that results, s.
    pub fn period_s(self, dt_s: f64) -> f64 {
        self.steps as f64 * dt_s
    }
}
