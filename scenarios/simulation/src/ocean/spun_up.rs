//! Water and plume after the spin-up, kept so that several runs can share them.
//!
//! The spin-up does not depend on any robot. It depends on the blocks of the scenario for water and plume, on the
//! files that these name, and on the seed (see [`Origin`]). Runs that agree in these, such as the arms of one seed of
//! a campaign, start from the same state bit for bit, whether they spin up themselves or take the state over.
//! [`cache`](crate::cache) keeps states on the disk.
//!
//! ```no_run
//! # use rheotaxis::{scenario, trial::{Trial, Unwatched}};
//! # let (one, other) = (scenario::load("a.ron".as_ref())?, scenario::load("b.ron".as_ref())?);
//! let mut first = Trial::assemble(&one, 7)?;
//! if let Some(spun_up) = first.spin_up(&mut Unwatched) {
//!     let ended = first.run(&mut Unwatched);
//!     let mut second = Trial::assemble(&other, 7)?;
//!     second.take_over(&spun_up)?; // after a mismatch it can still spin up itself
//!     let ended = second.run(&mut Unwatched);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::{Ocean, Origin};
use plumes::filaments::Plume;
use plumes::flow::Water;
use std::sync::Arc;
use world::bits::{Reader, Unreadable, Writer};
use world::seeds::Seed;

/// The state after a spin-up. Other runs take it over with [`Trial::take_over`](crate::trial::Trial::take_over).
///
/// Clones share the state, also between threads. It needs 40 bytes for each filament (2 MB for 50 000) and 16 bytes
/// for each node of the flow's grid. The last clone frees it.
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
        Self(Arc::new(State { origin, water, plume }))
    }

    /// What [`Self::read`] needs to make it again.
    pub(crate) fn bytes(&self) -> Vec<u8> {
        let mut to = Writer::default();
        self.0.water.keep(&mut to);
        self.0.plume.keep(&mut to);
        to.into_bytes()
    }

    /// Makes it from the bytes of another with this origin, and an ocean of the origin before its spin-up.
    pub(crate) fn read(ocean: &Ocean, origin: &Origin, bytes: &[u8]) -> Result<Self, Unreadable> {
        let (mut water, mut plume) = ocean.state();
        let mut from = Reader::new(bytes);
        water.recall(ocean.spin_up_s(), &mut from)?;
        plume.recall(&water, &mut from)?;
        from.end()?;
        Ok(Self::new(origin.clone(), (water, plume)))
    }

    /// Copies of water and plume for a run with this origin.
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

/// Why a run cannot take over the spin-up of another.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Mismatch {
    /// A part of the scenario that the spin-up depends on: `area`, `terrain`, `water`, `obstacles`, `permeable`,
    /// `sources`, `time.spin_up_s`, `time.spin_up_period_s`, `time.flow_period_s`, or `files`: the content of the
    /// obstacles' files.
    #[error("the state was spun up with another `{0}`: runs may share a spin-up only if this is the same")]
    Block(String),
    /// Another seed or another key, which gives another plume.
    #[error("the state was spun up with seed {}, this run has seed {}", theirs.describe(), ours.describe())]
    Seed {
        /// The seed of the spin-up.
        theirs: Seed,
        /// The seed of the run that should take it over.
        ours: Seed,
    },
}
