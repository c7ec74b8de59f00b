//! Threads for work that is done with rayon.

use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

/// Threads could not be started.
#[derive(Debug, thiserror::Error)]
#[error("cannot start {jobs} threads: {problem}")]
pub struct ThreadsError {
    jobs: usize,
    problem: ThreadPoolBuildError,
}

/// So many threads; 0 means one for each core.
pub(crate) fn pool(jobs: usize) -> Result<ThreadPool, ThreadsError> {
    ThreadPoolBuilder::new().num_threads(jobs).build().map_err(|problem| ThreadsError { jobs, problem })
}

/// Does some work with one thread for each core; where the system gives none, with this one. (The pool that rayon makes
/// by itself panics then.)
pub(super) fn with_threads<R: Send>(work: impl FnOnce() -> R + Send) -> R {
    with(ThreadPoolBuilder::new().build(), work)
}

fn with<R: Send>(wanted: Result<ThreadPool, ThreadPoolBuildError>, work: impl FnOnce() -> R + Send) -> R {
    let here = || ThreadPoolBuilder::new().num_threads(1).use_current_thread();
    match wanted.or_else(|_| here().build()) {
        Ok(pool) => pool.install(work),
        // This thread is one of a pool already.
        Err(_) => work(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayon::prelude::*;
    use std::io;

    #[test]
    fn without_threads_the_work_is_done_in_this_one() {
        let refused = || {
            // As a system at its limit of processes.
            let wanted = ThreadPoolBuilder::new().spawn_handler(|_| Err(io::Error::other("no")));
            with(wanted.build(), || (0..100u64).into_par_iter().sum::<u64>())
        };
        assert_eq!([refused(), refused()], [4950; 2]);
        assert_eq!(with_threads(|| 3), 3);
    }
}
