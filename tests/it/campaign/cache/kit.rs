//! What the tests of the cache need.

use crate::common;
use rheotaxis::cache::SpinUps;
use rheotaxis::scenario::Loaded;
use rheotaxis::trial::{Trial, Unwatched};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;
use world::digest::Digest;
use world::ranges::Positive;
use world::seeds::Seed;

/// A scenario that comes with the program, cut short.
pub(super) fn short(name: &str, spin_up_s: f64, limit_s: f64) -> Loaded {
    common::short(name, spin_up_s, limit_s).edit(|scenario| {
        if let Some(blockage) = &mut scenario.water.blockage {
            // Coarse cells are solved fast; a short time between two solutions gives several of them.
            blockage.cell_m = Positive::new(2.0 * blockage.cell_m.get());
            blockage.period_s = Positive::new(10.0);
        }
    })
}

/// A cache that keeps whatever is made, however quickly.
pub(super) fn all(dir: &Path) -> SpinUps {
    SpinUps::new(dir.to_owned(), 1 << 30).from(Duration::ZERO)
}

/// A trial after a spin-up with a cache, and whether it had been kept.
pub(super) fn developed(loaded: &Loaded, seed: impl Into<Seed>, kept: &SpinUps) -> (Trial, bool) {
    let mut trial = Trial::assemble(loaded, seed).unwrap();
    let developed = trial.spin_up_with(kept, &mut Unwatched);
    (trial, developed.expect("nobody stopped it").kept)
}

/// Digest of the present plume.
pub(super) fn plume(trial: &Trial) -> String {
    let mut digest = Digest::default();
    trial.simulation.ocean().plume().digest_into(&mut digest);
    digest.hex()
}

/// The files of a folder.
pub(super) fn files(dir: &Path) -> Vec<PathBuf> {
    fs::read_dir(dir).into_iter().flatten().map(|e| e.unwrap().path()).collect()
}
