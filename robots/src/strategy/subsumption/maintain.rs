//! Maintain-Plume: Track-In from a detection on, Track-Out after a time without detection.
//!
//! *Source*: Tian et al. 2013, section 3, Fig. 4a; Pang 2009, sections 5.3, 5.4 and 5.6.
//!
//! *Parameters*: those of its behaviours.
//!
//! *Deviations*: the papers mean different things by Track-Out. In Pang 2009 it is a manoeuvre of its own that begins
//! after λ s without a detection; in Tian et al. 2013 it is the time without detection itself, and Reacquire begins
//! after λ s. Both are here: with a Track-Out behaviour the first; without one the second, where the vehicle keeps
//! the course of the last detection.

use super::spec::MaintainSpec;
use crate::behave::{Behave, Stride};
use crate::error::RobotError;
use crate::handoff::{Behaviour, Observation};
use crate::memory::PlumeMemory;
use world::seeds::Stream;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    Off,
    In,
    Out,
}

/// State of the contact with the plume after a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Contact {
    /// Track-Out has ended, with or without a detection: the declaration rule must be tested.
    pub(super) out_ended: bool,
    /// The contact has been lost.
    pub(super) lost: bool,
}

/// State of the layer.
#[derive(Debug)]
pub(super) struct Maintain {
    track_in: Box<dyn Behave>,
    track_out: Option<Box<dyn Behave>>,
    phase: Phase,
    /// The newest chemical reading was a detection.
    smells: bool,
}

impl Maintain {
    pub(super) fn new(spec: &MaintainSpec) -> Result<Self, RobotError> {
        Ok(Self {
            track_in: spec.track_in.build()?,
            track_out: spec.track_out.as_ref().map(|t| t.build()).transpose()?,
            phase: Phase::Off,
            smells: false,
        })
    }

    /// Ends the contact until the next detection.
    pub(super) fn leave(&mut self) {
        self.phase = Phase::Off;
    }

    /// Whether it asks for the vehicle.
    pub(super) fn active(&self) -> bool {
        self.phase != Phase::Off
    }

    /// What it does, in the terms of the field.
    pub(super) fn behaviour(&self) -> Behaviour {
        let silent = self.track_out.is_none() && !self.smells;
        match self.phase {
            Phase::Out => Behaviour::TrackOut,
            Phase::In if silent => Behaviour::TrackOut,
            Phase::In | Phase::Off => Behaviour::TrackIn,
        }
    }

    /// One tick. `arrived` says whether its last goal has been reached. The stride is that of the behaviour that
    /// acted last.
    pub(super) fn step(
        &mut self,
        seen: &Observation,
        detected: bool,
        arrived: bool,
        memory: &mut PlumeMemory,
        rng: &mut Stream,
    ) -> (Stride, Contact) {
        let mut contact = Contact::default();
        if seen.chemical.is_some() {
            self.smells = detected;
        }
        if detected && self.phase != Phase::In {
            contact.out_ended = self.phase == Phase::Out;
            self.phase = Phase::In;
            self.track_in.enter(seen, memory);
        }
        let mut arrived = arrived && !contact.out_ended;
        if self.phase == Phase::In {
            let stride = self.track_in.step(seen, arrived, memory, rng);
            if stride != Stride::Over {
                return (stride, contact);
            }
            let Some(track_out) = &mut self.track_out else {
                return (Stride::Over, self.lose());
            };
            self.phase = Phase::Out;
            track_out.enter(seen, memory);
            arrived = false;
        }
        match (self.phase, &mut self.track_out) {
            (Phase::Out, Some(track_out)) => match track_out.step(seen, arrived, memory, rng) {
                Stride::Over => (Stride::Over, self.lose()),
                stride => (stride, contact),
            },
            _ => (Stride::Keep, contact),
        }
    }

    fn lose(&mut self) -> Contact {
        self.phase = Phase::Off;
        Contact { out_ended: true, lost: true }
    }
}
