//! Runs in an ocean that they share: where each takes its turns, and how far it is in the present tick.

use super::common::{Common, LaneParts};
use super::{caught, lend, take_back};
use crate::ocean::Ocean;
use crate::trial::Trial;

/// The runs in the places of an ocean.
pub(super) struct Runs {
    pub(super) all: Vec<Option<Run>>,
    /// The world in which they take turns, while they have one.
    pub(super) common: Option<Box<Common>>,
    /// The place of the run whose values are in that world.
    within: Option<usize>,
    /// What was in it before, of nobody.
    nobody: Option<Box<LaneParts>>,
}

/// A run in a place of an ocean.
pub(super) struct Run {
    pub(super) seat: LaneSlot,
    pub(super) at: At,
    /// What it said in a panic.
    pub(super) failed: Option<String>,
}

/// Where a run takes its turns.
pub(super) enum LaneSlot {
    /// In the common world, where its values are if they are not here.
    Common(Option<Box<LaneParts>>),
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

impl Runs {
    /// So many empty places.
    pub(super) fn new(places: usize) -> Self {
        Self { all: (0..places).map(|_| None).collect(), common: None, within: None, nobody: None }
    }

    /// Empties a place, or puts a run into it.
    pub(super) fn set(&mut self, place: usize, run: Option<Run>) {
        if self.within == Some(place) {
            self.vacate();
        }
        self.all[place] = run;
    }

    /// Does something while it is the turn of the run in a place; `None` if there is none or it has failed.
    pub(super) fn turn<T>(
        &mut self,
        place: usize,
        ocean: &mut Option<Ocean>,
        work: impl FnOnce(&mut Trial) -> T,
    ) -> Option<T> {
        self.enter(place);
        let run = self.all.get_mut(place)?.as_mut()?;
        if run.failed.is_some() {
            return None;
        }
        let done = match (&mut run.seat, &mut self.common) {
            (LaneSlot::Common(_), Some(common)) => common.work(ocean, work),
            (LaneSlot::Common(_), None) => Err("there is no world for its turn".to_string()),
            (LaneSlot::Own(trial), _) => {
                lend(ocean, trial);
                let done = caught(|| work(trial));
                take_back(ocean, trial);
                done
            }
        };
        done.map_err(|said| {
            run.failed = Some(said);
            run.at = At::Over;
        })
        .ok()
    }

    /// Brings the values of a run into the common world. Those of the run before go where these were.
    fn enter(&mut self, place: usize) {
        if self.within == Some(place) {
            return;
        }
        let (Some(common), Some(Some(run))) = (&mut self.common, self.all.get_mut(place)) else {
            return;
        };
        let LaneSlot::Common(own) = &mut run.seat else {
            return;
        };
        let mut own = own.take().expect("only the run whose turn it is has none");
        common.exchange(&mut own);
        let before = self.within.replace(place);
        self.hand_over(before, own);
    }

    /// Takes the values of the run in the common world out of it.
    pub(super) fn vacate(&mut self) {
        if let (Some(common), Some(mut own)) = (&mut self.common, self.nobody.take()) {
            common.exchange(&mut own);
            let before = self.within.take();
            self.hand_over(before, own);
        }
    }

    fn hand_over(&mut self, place: Option<usize>, values: Box<LaneParts>) {
        match place.and_then(|place| self.all[place].as_mut()) {
            Some(run) => run.seat = LaneSlot::Common(Some(values)),
            None => self.nobody = Some(values),
        }
    }
}
