//! All components of a robot: what it keeps while the robot of another run has its turn in the same world.

use super::{Briefing, Hull, Log, Mapping};
use crate::control::exchanges::ExchangeState;
use crate::incidents::{FaultLog, IncidentMonitor};
use crate::machines::own;
use crate::searchers::{OnboardTime, SearcherId, SearcherParts};
use robots::actuate::Pilot;
use robots::estimate::DeadReckoning;
use robots::faults::{DriveFaults, SensorFaults};
use robots::guide::Guidance;
use robots::handoff::{Actuation, Belief, Command, Decision, Estimate, GuidanceStatus, Readings};
use robots::sense::SensorSuite;
use robots::vehicles::Battery;
use world::frames::Truth;

own! {
    /// All components of a robot.
    RobotOwn as RobotParts with RobotBundle {
        id: SearcherId,
        truth: Truth,
        now: OnboardTime,
        hull: Hull,
        suite: SensorSuite,
        readings: Readings,
        estimator: DeadReckoning,
        estimate: Estimate,
        searching: SearcherParts,
        briefing: Briefing,
        decision: Decision,
        guidance: Guidance,
        command: Command,
        status: GuidanceStatus,
        pilot: Pilot,
        actuation: Actuation,
        lookout: IncidentMonitor,
        sensor_faults: SensorFaults,
        drive_faults: DriveFaults,
    } some {
        fault_log: FaultLog,
        belief: Belief,
        mapping: Mapping,
        battery: Battery,
        consulting: ExchangeState,
    } shown {
        Log,
    }
}
