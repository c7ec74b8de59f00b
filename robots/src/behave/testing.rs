//! Shared by the behaviours' tests: what is remembered of the plume, and what a behaviour starts.

use super::{Behave, Stride};
use crate::handoff::{Lcdp, Manoeuvre, Observation};
use crate::memory::PlumeMemory;
use nalgebra::Vector2;
use world::seeds::Stream;
use world::units::Heading;

pub(super) fn v(east: f64, north: f64) -> Vector2<f64> {
    Vector2::new(east, north)
}

/// The way up-flow, if it is known, and points (east, north) lost a second apart.
pub(super) fn memory(up_deg: Option<f64>, lost: &[(f64, f64)]) -> PlumeMemory {
    let up_flow = up_deg.map(Heading::from_deg);
    let mut memory = PlumeMemory { up_flow, ..PlumeMemory::default() };
    for (k, (east, north)) in lost.iter().enumerate() {
        memory.lose(Lcdp::new_at(k as f64, v(*east, *north)), up_flow.unwrap_or(Heading::from_deg(0.0)));
    }
    memory
}

pub(super) fn step(b: &mut dyn Behave, o: &Observation, arrived: bool, memory: &mut PlumeMemory) -> Stride {
    b.step(o, arrived, memory, &mut Stream::new(1, "t", "t"))
}

/// All that a behaviour starts until it is over, for a vehicle that stays where it is.
pub(super) fn all(b: &mut dyn Behave, o: &Observation, memory: &mut PlumeMemory) -> Vec<Manoeuvre> {
    b.enter(o, memory);
    let mut started = Vec::new();
    loop {
        match step(b, o, !started.is_empty(), memory) {
            Stride::Start(manoeuvre) => started.push(manoeuvre),
            Stride::Over => return started,
            other => panic!("a start or the end, got {other:?}"),
        }
    }
}

/// The course of a stride, degrees; none if it keeps its own.
pub(super) fn course(s: Stride) -> Option<f64> {
    match s {
        Stride::Start(Manoeuvre::Course { course }) | Stride::Adjust(Manoeuvre::Course { course }) => {
            Some(course.deg())
        }
        Stride::Keep => None,
        other => panic!("wanted a course, got {other:?}"),
    }
}

/// The point of a manoeuvre.
pub(super) fn point(m: &Manoeuvre) -> Vector2<f64> {
    match m {
        Manoeuvre::GoToPoint { point, .. } => *point,
        other => panic!("wanted a point, got {other:?}"),
    }
}
