//! A run in an ocean that others share: where it takes its turns, and how far it is in the present tick.

use super::common::{Belongings, Common};
use super::{caught, lend, take_back};
use crate::ocean::Ocean;
use crate::trial::Trial;

/// A run in a place of an ocean.
pub(super) struct Run {
    pub(super) seat: Seat,
    pub(super) at: At,
    /// What it said in a panic.
    pub(super) failed: Option<String>,
}

/// Where a run takes its turns.
pub(super) enum Seat {
    /// In the common world.
    Common(Box<Belongings>),
    /// In a world of its own.
    Own(Box<Trial>),
}

/// Where a run is in the present tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum At {
    /// It has asked.
    Asked,
    /// It has done its part, up to the step of the ocean.
    Acted,
    Over,
}

impl Run {
    /// Does something while it is the turn of this run; `None` if it has failed.
    pub(super) fn with<T>(
        &mut self,
        common: &mut Option<Box<Common>>,
        ocean: &mut Option<Ocean>,
        work: impl FnOnce(&mut Trial) -> T,
    ) -> Option<T> {
        if self.failed.is_some() {
            return None;
        }
        let done = match (&mut self.seat, common) {
            (Seat::Common(own), Some(common)) => common.with(own, ocean, work),
            (Seat::Common(_), None) => Err("there is no world for its turn".to_string()),
            (Seat::Own(trial), _) => {
                lend(ocean, trial);
                let done = caught(|| work(trial));
                take_back(ocean, trial);
                done
            }
        };
        done.map_err(|said| {
            self.failed = Some(said);
            self.at = At::Over;
        })
        .ok()
    }
}
