//! A stretch of eddies that is drawn when it is first asked: a check of a scenario builds its water, but asks it nothing.
//!
//! *Source*: none.
//!
//! *Parameters*: [`KEPT`], how many shared stretches a process keeps.
//!
//! *Deviations*: none.

use super::stretch::{Shape, Stretch};
use std::fmt;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock};
use world::seeds::Seed;

/// Stretches that all runs of this process share, with what they were made from.
static SHARED: Mutex<Vec<(Shape, Arc<Stretch>)>> = Mutex::new(Vec::new());
/// If there are more different channels than this at once, stretches are drawn again.
const KEPT: usize = 8;

/// A stretch, drawn or to be drawn.
pub(super) struct LazyStretch {
    shape: Shape,
    /// What identifies it; `None` for the one that all of this shape share.
    seed: Option<Seed>,
    /// With how many threads.
    threads: AtomicUsize,
    stretch: OnceLock<Arc<Stretch>>,
}

/// What it is drawn from, all of which its velocities follow from; whether it is drawn yet makes no difference.
impl fmt::Debug for LazyStretch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Drawn").field("shape", &self.shape).field("seed", &self.seed).finish_non_exhaustive()
    }
}

impl LazyStretch {
    pub(super) fn new(shape: Shape, seed: Option<Seed>) -> Self {
        Self { shape, seed, threads: AtomicUsize::new(1), stretch: OnceLock::new() }
    }

    /// Draws it with so many threads.
    pub(super) fn use_threads(&self, n: usize) {
        self.threads.store(n, Ordering::Relaxed);
    }

    /// Velocities at its nodes.
    pub(super) fn nodes(&self) -> &[[f32; 4]] {
        let draw = || {
            let threads = self.threads.load(Ordering::Relaxed);
            match self.seed {
                Some(seed) => Arc::new(Stretch::new(&self.shape, seed, threads)),
                None => shared(&self.shape, threads),
            }
        };
        &self.stretch.get_or_init(draw).nodes
    }
}

fn shared(shape: &Shape, threads: usize) -> Arc<Stretch> {
    let mut shared = SHARED.lock().expect("nobody panics while drawing");
    if let Some((_, stretch)) = shared.iter().find(|(s, _)| s == shape) {
        return stretch.clone();
    }
    let stretch = Arc::new(Stretch::new(shape, 0, threads));
    if shared.len() == KEPT {
        shared.remove(0);
    }
    shared.push((*shape, stretch.clone()));
    stretch
}
