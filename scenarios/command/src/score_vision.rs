//! `rheotaxis score-vision`: scores the segmentation on rendered scenes.

use super::args_vision::ScoreVisionArgs;
use super::exit::Exit;
use super::{say, stop};
use indicatif::{ProgressBar, ProgressStyle};
use output::files::{ReportError, begin_folder};
use robots::vision::VerifierSpec;
use std::sync::Mutex;
use std::time::Duration;
use studies::score_vision::{ScenePlan, ScoreError, SizePx, save, score, table, write};

/// Renders and scores the scenes, prints the scores and writes the folder.
pub(super) fn score_vision(args: &ScoreVisionArgs) -> Exit {
    stop::listen();
    match all(args) {
        Ok(()) => Exit::Success,
        Err(error) => {
            let exit = match error {
                ScoreError::Interrupted => Exit::Interrupted,
                _ => Exit::Error,
            };
            say::error(error, None);
            exit
        }
    }
}

fn all(args: &ScoreVisionArgs) -> Result<(), ScoreError> {
    // Opens the folder first, so that an error does not come after minutes of work.
    let out = begin_folder(&args.out, "score-vision")?;
    if let Some(removed) = say::removed(&args.out, out.removed()) {
        say::note(removed);
    }
    let bar = if args.quiet { ProgressBar::hidden() } else { ProgressBar::new(args.scenes) };
    let style = ProgressStyle::with_template("{prefix} [{bar:30}] {pos} of {len} scenes, {eta} left");
    bar.set_style(style.expect("the template is well formed").progress_chars("=> "));
    bar.set_prefix("score-vision");
    bar.enable_steady_tick(Duration::from_millis(500));
    let plan = ScenePlan {
        seed: args.seed,
        scenes: args.scenes,
        size_px: [args.width, (3 * args.width).div_ceil(4)],
        verifier: VerifierSpec::default(),
    };
    let unsaved = Mutex::new(Vec::new());
    let [w, h] = plan.size_px;
    let rows = score(args.seed, args.scenes, SizePx(w, h), &plan.verifier, args.jobs, stop::listen(), |scene, shot| {
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
    Ok(())
}
