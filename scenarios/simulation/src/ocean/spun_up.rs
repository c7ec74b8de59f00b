//! Water and plume after the spin-up, kept so that runs that share them pay for it once.
//!
//! A spin-up knows no robot: what comes out of it follows from the blocks of the scenario that make its water and plume,
//! the files these name and the seed alone (see [`Origin`]). Runs that agree in these, say the arms of one seed of a
//! campaign, start from the same state bit for bit, whether they spin up themselves or take it over.
//!
//! ```no_run
//! # use rheotaxis::{scenario, trial::{Trial, Unwatched}};
//! # let (one, other) = (scenario::load("a.ron".as_ref())?, scenario::load("b.ron".as_ref())?);
//! let mut first = Trial::assemble(&one, 7)?;
//! if let Some(spun_up) = first.spin_up(&mut Unwatched) {
//!     let ended = first.run(&mut Unwatched);
//!     let mut second = Trial::assemble(&other, 7)?;
//!     second.take_over(&spun_up)?; // or, on a mismatch, let it spin up itself
//!     let ended = second.run(&mut Unwatched);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::Origin;
use plumes::filaments::Plume;
use plumes::flow::Water;
use std::sync::Arc;
use world::seeds::Seed;

/// The state after a spin-up, to be taken over by other runs with
/// [`Trial::take_over`](crate::trial::Trial::take_over).
///
/// A clone shares it: give it to as many threads as there are. It holds 28 bytes a filament (1.4 MB for
/// 50 000) and the flow's grid, 16 bytes a node, and is freed with its last clone.
#[derive(Clone, Debug)]
pub struct SpunUp(Arc<State>);

#[derive(Debug)]
struct State {
    origin: Origin,
    water: Water,
    plume: Plume,
}

impl SpunUp {
    pub(crate) fn new(origin: Origin, (water, plume): (Water, Plume)) -> Self {
        Self(Arc::new(State {
            origin,
            water,
            plume,
        }))
    }

    /// Copies of water and plume for a run of that origin.
    pub(crate) fn copy_for(&self, origin: &Origin) -> Result<(Water, Plume), Mismatch> {
        let state = &*self.0;
        if let Some(block) = state.origin.unlike(origin) {
            return Err(Mismatch::Block(block));
        }
        let (theirs, ours) = (state.origin.seed(), origin.seed());
        if theirs != ours {
            return Err(Mismatch::Seed { theirs, ours });
        }
        Ok((state.water.clone(), state.plume.clone()))
    }
}

/// Why a run cannot take over what another has spun up.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Mismatch {
    /// A part of the scenario that the spin-up depends on: `area`, `terrain`, `water`, `obstacles`, `permeable`, `sources`,
    /// `time.spin_up_s`, `time.spin_up_period_s`, `time.flow_period_s`, or `files`, what the obstacles' files hold.
    #[error(
        "the state was spun up with another `{0}`: runs may share a spin-up only if this is the same"
    )]
    Block(String),
    /// Another seed or another key, hence another plume.
    #[error("the state was spun up with seed {}, this run has seed {}", theirs.told(), ours.told())]
    Seed {
        /// The seed it was spun up with.
        theirs: Seed,
        /// The seed of the run that wanted it.
        ours: Seed,
    },
}
