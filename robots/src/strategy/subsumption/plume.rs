//! The layers that deal with the plume: Find, Maintain, Reacquire, and the map that feeds Find.

use super::ask::{Ask, Kind, keep};
use super::maintain::Maintain;
use super::plume_map::PlumeMap;
use crate::behave::{Behave, Stride};
use crate::handoff::{Behaviour, Manoeuvre, Observation};
use crate::memory::PlumeMemory;
use world::seeds::Stream;

/// What they ask for in a tick.
#[derive(Debug, Default)]
pub(super) struct PlumeRequests {
    pub(super) find: Option<Ask>,
    pub(super) maintain: Option<Ask>,
    pub(super) reacquire: Option<Ask>,
    pub(super) plume_map: Option<Ask>,
    /// Track-Out has ended: the declaration rule must be tested.
    pub(super) out_ended: bool,
}

/// The states of the layers.
#[derive(Debug)]
pub(super) struct PlumeLayers {
    find: Box<dyn Behave>,
    maintain: Maintain,
    reacquire: Option<Box<dyn Behave>>,
    plume_map: Option<PlumeMap>,
    /// What each layer asked for last.
    found: Option<Manoeuvre>,
    maintained: Option<Manoeuvre>,
    reacquired: Option<Manoeuvre>,
    /// Whether Reacquire asks; otherwise Find has the search.
    reacquiring: bool,
    searching: bool,
}

impl PlumeLayers {
    pub(super) fn new(
        find: Box<dyn Behave>,
        maintain: Maintain,
        reacquire: Option<Box<dyn Behave>>,
        plume_map: Option<PlumeMap>,
    ) -> Self {
        Self {
            find,
            maintain,
            reacquire,
            plume_map,
            found: None,
            maintained: None,
            reacquired: None,
            reacquiring: false,
            searching: false,
        }
    }

    /// All layers start afresh: what led to the last declaration no longer counts.
    pub(super) fn renew(&mut self) {
        self.maintain.leave();
        self.plume_map.iter_mut().for_each(PlumeMap::drop_target);
        (self.reacquiring, self.searching) = (false, false);
    }

    /// One tick. `arrived` names the layer whose goal has been reached.
    pub(super) fn step(
        &mut self,
        seen: &Observation,
        detected: bool,
        arrived: Option<Kind>,
        memory: &mut PlumeMemory,
        rng: &mut Stream,
    ) -> PlumeRequests {
        let at = |kind| arrived == Some(kind);
        let mut asked = PlumeRequests::default();
        if detected || self.maintain.active() {
            let here = at(Kind::Maintain);
            let (stride, contact) = self.maintain.step(seen, detected, here, memory, rng);
            let anew = keep(&mut self.maintained, stride);
            asked.out_ended = contact.out_ended;
            if self.maintain.active() {
                let does = self.maintain.behaviour();
                asked.maintain = Ask::from_manoeuvre(Kind::Maintain, does, self.maintained, anew);
            }
            if contact.lost
                && let Some(reacquire) = &mut self.reacquire
            {
                reacquire.enter(seen, memory);
                self.reacquiring = true;
            }
        }
        if detected {
            self.reacquiring = false;
            self.plume_map.iter_mut().for_each(PlumeMap::renew);
        }
        if self.reacquiring
            && let Some(reacquire) = &mut self.reacquire
        {
            let stride = reacquire.step(seen, at(Kind::Reacquire), memory, rng);
            let anew = keep(&mut self.reacquired, stride);
            self.reacquiring = stride != Stride::Over;
            if self.reacquiring {
                let (kind, does) = (Kind::Reacquire, Behaviour::Reacquire);
                asked.reacquire = Ask::from_manoeuvre(kind, does, self.reacquired, anew);
            }
        }
        let alone = !self.maintain.active() && !self.reacquiring;
        if let Some(map) = &mut self.plume_map {
            if alone {
                let to = map.step(seen, at(Kind::PlumeMap), memory);
                let ask = |(m, anew)| Ask::from_manoeuvre(Kind::PlumeMap, Behaviour::FollowPath, Some(m), anew);
                asked.plume_map = to.and_then(ask);
            } else {
                map.drop_target();
            }
        }
        asked.find = self.search(alone && asked.plume_map.is_none(), seen, arrived, memory, rng);
        asked
    }

    /// Find always asks, and starts afresh whenever it gets the search back.
    fn search(
        &mut self,
        searching: bool,
        seen: &Observation,
        arrived: Option<Kind>,
        memory: &mut PlumeMemory,
        rng: &mut Stream,
    ) -> Option<Ask> {
        let before = std::mem::replace(&mut self.searching, searching);
        let mut anew = false;
        if searching {
            if !before {
                self.find.enter(seen, memory);
            }
            let arrived = before && arrived == Some(Kind::Find);
            let stride = self.find.step(seen, arrived, memory, rng);
            anew = keep(&mut self.found, stride);
        }
        // As long as nothing was asked for, it continues in the vehicle's direction.
        let ahead = Manoeuvre::Course { course: seen.estimate.attitude.heading };
        let found = self.found.or(Some(ahead));
        Ask::from_manoeuvre(Kind::Find, Behaviour::Find, found, anew)
    }
}
