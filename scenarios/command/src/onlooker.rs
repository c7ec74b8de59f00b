//! Everything that follows a run: its results, live state, progress, pace.
#![allow(
    clippy::disallowed_methods,
    reason = "pace and wall time are for people; neither enters the run"
)]

use super::args::{RunArgs, Speed};
use super::company::Company;
use super::progress::Progress;
use output::files::{ReportError, begin_folder};
use output::follow::Follower;
use output::live::{Live, LiveMeta, LiveOptions, run_id};
use output::results::RunInfo;
use rheotaxis::frame::{Frame, PictureFrame, PingFrame, PlumeFrame};
use rheotaxis::outcome::RunOutcome;
use rheotaxis::scenario::Loaded;
use rheotaxis::trial::{Ended, Trial, Watch};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use super::run::RunError;
use super::say;

/// Longest wait before Ctrl-C is looked for again, while a run waits for its pace.
const NAP: Duration = Duration::from_millis(50);

/// All that follows one run.
pub(super) struct Onlooker<'a> {
    results: Follower,
    live: Option<Live>,
    progress: Progress,
    speed: Speed,
    stop: &'a AtomicBool,
}

impl<'a> Onlooker<'a> {
    /// Opens folder, files and port, so that an error in them comes before the run starts.
    pub(super) fn new(
        loaded: &Loaded,
        args: &RunArgs,
        out: &Path,
        company: &mut Company,
        stop: &'a AtomicBool,
    ) -> Result<Self, RunError> {
        let mut results = Follower::new(loaded, args.key.seed(args.seed))?;
        let progress = Progress::new(loaded, args, &company.bars);
        let live = live(args, results.run(), &progress, company)?;
        // The folder comes last: a run that cannot start must not remove the files of an earlier run.
        let out = begin_folder(out, "run")?;
        if let Some(removed) = say::removed(out.dir(), out.removed()) {
            progress.say(&removed);
        }
        results.write_into(&out, !args.no_record)?;
        Ok(Self {
            results,
            live,
            progress,
            speed: args.speed,
            stop,
        })
    }

    fn going(&self) -> bool {
        self.results.well() && !self.stop.load(Ordering::Relaxed)
    }

    /// Writes the results of the run and prints where they are. Its live state stays with those of the other lanes.
    pub(super) fn finish(
        mut self,
        trial: &Trial,
        ended: &Ended,
        company: &mut Company,
    ) -> Result<RunOutcome, ReportError> {
        if let Some(live) = &self.live {
            live.end(&ended.digest);
        }
        let mut gathered = self.results.finish(trial, ended);
        let written = gathered.write(trial.simulation.ocean());
        if let Some(out) = gathered.out() {
            self.progress.finish(&gathered.summary, out.dir());
        }
        if let Some(live) = self.live.take() {
            company.keep(live);
        }
        written.map(|()| gathered.summary.outcome)
    }
}

/// Starts publishing over zenoh.
fn live(
    args: &RunArgs,
    run: &RunInfo,
    progress: &Progress,
    company: &mut Company,
) -> Result<Option<Live>, RunError> {
    if args.no_zenoh {
        return Ok(None);
    }
    let mut options = LiveOptions::new(run_id(&run.scenario_name, args.seed));
    options.listen = args.zenoh_listen.clone();
    options.config_file = args.zenoh_config.clone();
    let meta = LiveMeta {
        scenario_text: run.scenario_text.clone(),
        scenario_name: run.scenario_name.clone(),
        seed: run.seed.number(),
        version: run.version.clone(),
    };
    let live = company.live(&options, meta)?;
    progress.say(&format!(
        "live on {} under rheotaxis/{}",
        live.endpoint(),
        options.run_id
    ));
    if let Some(notice) = live.notice() {
        progress.say(notice);
    }
    Ok(Some(live))
}

impl Watch for Onlooker<'_> {
    fn spun_up(&mut self, share: f64) -> bool {
        self.progress.spun_up(share);
        self.results.spun_up(share);
        self.going()
    }

    fn developed(&mut self, kept: bool) {
        self.results.developed(kept);
        if kept {
            self.progress.say("spin-up taken from the cache");
        }
    }

    fn frame(&mut self, frame: &Frame) {
        self.results.frame(frame);
        if let Some(live) = &self.live {
            live.publish(frame);
        }
        self.progress.frame(frame);
    }

    fn plume(&mut self, plume: &PlumeFrame) {
        self.results.plume(plume);
        if let Some(live) = &self.live {
            live.plume(plume);
        }
    }

    fn picture(&mut self, picture: &PictureFrame) {
        if let Some(live) = &self.live {
            live.picture(picture);
        }
        self.results.picture(picture);
    }

    fn ping(&mut self, ping: &PingFrame) {
        if let Some(live) = &self.live {
            live.ping(ping);
        }
        self.results.ping(ping);
    }

    fn go_on(&mut self, t_s: f64) -> bool {
        if let Speed::Times(speed) = self.speed {
            // Ctrl-C must end a wait of any length.
            let due = Duration::try_from_secs_f64(t_s / speed).unwrap_or(Duration::MAX);
            while self.going()
                && let Some(early) = due.checked_sub(self.results.mission_begun().elapsed())
            {
                std::thread::sleep(early.min(NAP));
            }
        }
        self.going()
    }
}
