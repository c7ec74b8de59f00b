//! Runs systems one after the other, and does nothing else.
//!
//! Bevy's executor also asks each time whether a system is to run, and applies what systems have put off. Where no
//! system has a condition and none puts anything off, that is most of what a quiet tick costs beside its systems.

use bevy_ecs::error::{BevyError, ErrorContext};
use bevy_ecs::prelude::{Schedule, System, World};
use bevy_ecs::schedule::{FixedBitSet, SingleThreadedExecutor, SystemExecutor, SystemSchedule};
use bevy_ecs::system::RunSystemError;

/// The executor.
struct InOrder;

impl SystemExecutor for InOrder {
    fn init(&mut self, _: &SystemSchedule) {}

    fn run(
        &mut self,
        schedule: &mut SystemSchedule,
        world: &mut World,
        _: Option<&FixedBitSet>,
        fault: fn(BevyError, ErrorContext),
    ) {
        #[expect(unsafe_code, reason = "bevy gives an executor its systems in no other way")]
        // SAFETY: the systems are only run.
        let systems = unsafe { schedule.systems_mut() };
        for system in systems {
            if let Err(RunSystemError::Failed(error)) = system.run_without_applying_deferred((), world) {
                let (name, last_run) = (system.name(), system.get_last_run());
                fault(error, ErrorContext::System { name, last_run });
            }
        }
    }

    fn set_apply_final_deferred(&mut self, _: bool) {}
}

/// Whether no system and no set of a schedule has a condition. To be asked before the schedule is initialized.
pub(super) fn without_conditions(schedule: &Schedule) -> bool {
    let graph = schedule.graph();
    let mut systems = graph.systems.iter();
    let mut sets = graph.system_sets.iter();
    systems.all(|(_, _, conditions)| conditions.is_empty()) && sets.all(|(_, _, conditions)| conditions.is_empty())
}

/// Whether a system of a schedule puts anything off. To be asked after the schedule is initialized.
pub(super) fn puts_off(schedule: &Schedule) -> bool {
    let systems = schedule.systems();
    systems.map_or(true, |mut all| all.any(|(_, system)| system.has_deferred()))
}

/// Gives a schedule this executor, or bevy's own. It is a new one, for one that was left in the middle of a run by a
/// panic still counts the systems before as done.
pub(super) fn execute(schedule: &mut Schedule, in_order: bool) {
    if in_order {
        schedule.set_executor(InOrder);
    } else {
        schedule.set_executor(SingleThreadedExecutor::new());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bevy_ecs::prelude::{IntoScheduleConfigs, Resource};
    use bevy_ecs::system::Commands;

    #[derive(Resource, Default)]
    struct Noted(Vec<u8>);

    #[derive(Resource, Default)]
    struct PutOff;

    fn first(world: &mut World) {
        world.resource_mut::<Noted>().0.push(1);
    }

    fn second(world: &mut World) {
        world.resource_mut::<Noted>().0.push(2);
    }

    fn later(mut commands: Commands) {
        commands.insert_resource(PutOff);
    }

    fn of(add: impl Fn(&mut Schedule)) -> (Schedule, bool) {
        let mut schedule = Schedule::default();
        add(&mut schedule);
        let free = without_conditions(&schedule);
        schedule.initialize(&mut World::new()).expect("in order");
        let in_order = free && !puts_off(&schedule);
        (schedule, in_order)
    }

    #[test]
    fn only_schedules_without_conditions_and_commands_do_without_bevys_executor() {
        let plain = |s: &mut Schedule| {
            s.add_systems((first, second).chain());
        };
        assert!(of(plain).1);
        let asks = |s: &mut Schedule| {
            s.add_systems(first.run_if(|| true));
        };
        assert!(!of(asks).1);
        let commands = |s: &mut Schedule| {
            s.add_systems((first, later).chain());
        };
        assert!(!of(commands).1);
    }

    #[test]
    fn systems_run_in_their_order_again_and_again() {
        let mut schedule = Schedule::default();
        schedule.add_systems((first, second).chain());
        execute(&mut schedule, true);
        let mut world = World::new();
        world.init_resource::<Noted>();
        schedule.run(&mut world);
        schedule.run(&mut world);
        assert_eq!(world.resource::<Noted>().0, [1, 2, 1, 2]);
    }
}
