//! `rheotaxis score-vision`: scores the segmentation on rendered scenes.

use crate::args::vision::ScoreVisionArgs;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::progress::bar;
use crate::{say, stop};
use output::files::{ReportError, begin_folder};
use robots::strategy::VerifierSpec;
use std::sync::Mutex;
use std::time::Duration;
use studies::score_vision::{ScenePlan, save, score, table, write};

/// Renders and scores the scenes, prints the scores and writes the folder.
pub(crate) fn score_vision(args: &ScoreVisionArgs) -> Result<Exit, Failure> {
    stop::listen();
    // Opens the folder first, so that an error does not come after minutes of work.
    let out = begin_folder(&args.out, "score-vision")?;
    if let Some(removed) = say::removed(&args.out, out.removed()) {
        say::note(removed);
    }
    let bar = bar(args.quiet, args.scenes, "{prefix} [{bar:30}] {pos} of {len} scenes, {eta} left");
    bar.set_prefix("score-vision");
    bar.enable_steady_tick(Duration::from_millis(500));
    let plan = ScenePlan {
        seed: args.seed,
        scenes: args.scenes,
        size_px: [args.width, (3 * args.width).div_ceil(4)],
        verifier: VerifierSpec::default(),
    };
    let unsaved = Mutex::new(Vec::new());
    let rows = score(&plan, args.jobs, stop::listen(), |scene, shot| {
        bar.inc(1);
        if scene.n < args.pictures
            && let Err(error) = save(&out, scene, shot)
        {
            let mut unsaved = unsaved.lock().expect("nobody panics with it");
            unsaved.push(error);
        }
    });
    bar.finish_and_clear();
    let rows = rows?;
    say::line(table(&rows));
    let mut failures = unsaved.into_inner().expect("nobody panics with it");
    failures.extend(write(&out, &plan, &rows).err());
    if let Some(error) = ReportError::combine(failures) {
        return Err(error.into());
    }
    say::line(format_args!(
        "results in {}: scores.md, scores.csv, scores.json, scenes.csv, pixels.png, roc.png",
        args.out.display()
    ));
    Ok(Exit::Success)
}
