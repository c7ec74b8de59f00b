//! What is wrong with the faults of a robot: things that it has not, times that contradict each other.

use super::drive_spec::DriveFault;
use super::spec::{FaultSpec, FaultSubject, Faulty};
use crate::handoff::{DriveUnit, NamedDrive};
use crate::sense::SensorsSpec;
use world::limits::{LimitedValue, range};
use world::ranges::Finite;
use world::spelling::choose;

/// A mistake in the faults of a robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// Its field, as in `faults[1].until_s`.
    pub field: String,
    /// What is wrong, and what would be legal.
    pub problem: String,
    /// How to correct it.
    pub help: Option<String>,
}

/// All mistakes in the faults of a robot with these instruments. `drives` are those of its vehicle; without them they
/// are not checked.
pub fn mistakes(faults: &[FaultSpec], sensors: &SensorsSpec, drives: Option<&[NamedDrive]>) -> Vec<Mistake> {
    let mut found = Vec::new();
    for (i, fault) in faults.iter().enumerate() {
        let mut say = |field: &str, problem: String, help: Option<String>| {
            found.push(Mistake { field: format!("faults[{i}].{field}"), problem, help });
        };
        let at_s = fault.at_s.get();
        if let Some(until_s) = fault.until_s
            && until_s.get() <= at_s
        {
            let problem = format!("must be later than at_s, {at_s} s, got {}", until_s.get());
            let help = "leave it out for a fault that lasts";
            say("until_s", problem, Some(help.to_string()));
        }
        match fault.what.subject() {
            FaultSubject::Instrument(field, _) if !sensors.has(field) => {
                let help = format!(
                    "fit one, as in `sensors: ({field}: ())`, or leave the fault out; on board: {}",
                    on_board(sensors)
                );
                say("what", lacks(field), Some(help));
            }
            FaultSubject::Instrument(..) => {}
            FaultSubject::Drive(name, how) => {
                if let Some((at, problem, help)) = drives.and_then(|all| misfit(all, name, &how)) {
                    let field = match (&fault.what, at) {
                        (Faulty::Drive(_), Some(at)) => format!("what.{at}"),
                        _ => "what".to_string(),
                    };
                    say(&field, problem, Some(help));
                }
            }
        }
        let twin = (faults[..i].iter()).position(|other| of_one_thing(fault, other) && fault.overlaps(other));
        if let Some(j) = twin {
            let problem = format!("holds at the same time as faults[{j}], which is of the same thing");
            let help = "a thing has one fault at a time: end the first with until_s, or begin the second later";
            say("what", problem, Some(help.to_string()));
        }
    }
    found
}

fn lacks(field: &str) -> String {
    match field {
        "lbl" => "there are no position fixes: the robot carries no lbl, which makes them".to_string(),
        other => format!("the robot carries no {other}"),
    }
}

fn on_board(sensors: &SensorsSpec) -> String {
    let names: Vec<&str> = sensors.iter().map(|s| s.name()).collect();
    if names.is_empty() { "nothing".to_string() } else { names.join(", ") }
}

/// Why a drive of this name cannot fail like this: the field below `what`, the problem and the cure.
fn misfit(all: &[NamedDrive], name: &str, how: &DriveFault) -> Option<(Option<&'static str>, String, String)> {
    let Some(drive) = all.iter().find(|d| d.name == name) else {
        if all.is_empty() {
            let problem = format!(
                "a kinematic vehicle has no {} that could fail: it moves as its helm asks",
                name.replace('_', " ")
            );
            let help = "take a vehicle with drives, such as `vehicle: Remus100()`, or leave the fault out";
            return Some((None, problem, help.to_string()));
        }
        let names: Vec<&str> = all.iter().map(|d| d.name.as_str()).collect();
        let problem = format!("the vehicle has no drive \"{name}\"");
        return Some((Some("link"), problem, choose(name, &names, "drives")));
    };
    let DriveFault::StuckAt(at) = how else {
        return None;
    };
    let legal = match drive.unit {
        DriveUnit::Fin => &range::fin_deg,
        DriveUnit::Rpm => &range::rpm,
        // A thruster's curve, a pump and a moving mass have limits of their own, at which the drive stops.
        DriveUnit::Own => return None,
    };
    let problem = Finite::limited(at.get(), legal).err()?;
    let help = format!("the set-points of {name} are in {}", legal.2);
    Some((Some("how"), problem, help))
}

fn of_one_thing(a: &FaultSpec, b: &FaultSpec) -> bool {
    match (a.what.subject(), b.what.subject()) {
        (FaultSubject::Instrument(a, _), FaultSubject::Instrument(b, _)) => a == b,
        (FaultSubject::Drive(a, _), FaultSubject::Drive(b, _)) => a == b,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::super::FinFault;
    use super::super::testing::fault;
    use super::*;

    #[test]
    fn a_kinematic_vehicle_has_no_drive_that_could_fail() {
        let rudder = [fault(0.0, None, Faulty::Rudder(FinFault::Stuck))];
        let found = mistakes(&rudder, &SensorsSpec::default(), Some(&[]));
        let said = found.iter().map(|m| (m.field.as_str(), m.problem.starts_with("a kinematic vehicle has no rudder")));
        assert_eq!(said.collect::<Vec<_>>(), [("faults[0].what", true)]);
        assert_eq!(mistakes(&rudder, &SensorsSpec::default(), Some(&NamedDrive::fins())), []);
    }
}
