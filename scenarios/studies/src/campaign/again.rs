//! Runs of a campaign, made anew to show their tracks.

use super::contained::contained;
use super::plan::Campaign;
use super::report::{Film, Pick, RemadeRun};
use super::rows::row::RunRow;
use super::threads::pool;
use output::follow::Follower;
use rayon::prelude::*;
use rheotaxis::trial::Trial;
use std::sync::atomic::{AtomicBool, Ordering};

impl Campaign {
    /// Makes runs anew whose tracks are to be shown, so many at the same time; 0 means one on each core. Once `stop` is
    /// set, no run begins. `made` is called after each, from any thread.
    pub fn films(&self, picks: Vec<Pick>, jobs: usize, stop: &AtomicBool, made: &(dyn Fn() + Sync)) -> Vec<RemadeRun> {
        let one = |pick: Pick| {
            let film = if stop.load(Ordering::Relaxed) {
                Err("left out, because the report was interrupted".to_string())
            } else {
                self.film(&pick.row)
            };
            made();
            RemadeRun { pick, film }
        };
        match pool(jobs) {
            Ok(pool) => pool.install(|| picks.into_par_iter().map(one).collect()),
            Err(_) => picks.into_iter().map(one).collect(),
        }
    }

    /// The tracks of a run, which is made anew; its digest must be that of its row.
    ///
    /// # Errors
    /// Says why there is none: the scenario is no longer there or no longer the same, the run fails, another digest.
    pub fn film(&self, row: &RunRow) -> Result<Film, String> {
        contained(|| self.film_of(row)).unwrap_or_else(|said| Err(format!("it panicked: {said}")))
    }

    fn film_of(&self, row: &RunRow) -> Result<Film, String> {
        let place = self.place(row.run);
        if self.arm(place.arm).name != row.arm || place.seed.number() != row.seed {
            return Err("its row is of another campaign".to_string());
        }
        let loaded = self.of_run(&place);
        let loaded = loaded.map_err(|e| e.to_string())?;
        let mut trial = Trial::assemble(&loaded, place.seed).map_err(|e| e.to_string())?;
        let mut follower = Follower::new(&loaded, place.seed).map_err(|e| e.to_string())?;
        let ended = trial.run(&mut follower);
        if ended.digest != row.digest {
            let (now, then) = (&ended.digest, &row.digest);
            return Err(format!("its row is out of date: the run has the digest {now} now, and {then} in its row"));
        }
        let gathered = follower.finish(&trial, &ended);
        let ocean = trial.simulation.ocean();
        let data = gathered.film(ocean).ok_or("nothing moved in it")?;
        // A page without the picture is better than none.
        let still = gathered.still(ocean).and_then(Result::ok);
        Ok(Film { data, still })
    }
}
