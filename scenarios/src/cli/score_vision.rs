//! `rheotaxis score-vision`: how well the eyes see.

use super::args_vision::ScoreVisionArgs;
use super::exit::Exit;
use super::say;
use crate::report::make_folder;
use crate::score_vision::{Plan, ScoreError, SizePx, save, score, table, write};
use indicatif::{ProgressBar, ProgressStyle};
use robots::vision::VerifierSpec;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Set by Ctrl-C or a termination signal: the scenes in hand end, no more begin.
static STOP: AtomicBool = AtomicBool::new(false);

/// Renders, scores, says and writes.
pub(super) fn score_vision(args: &ScoreVisionArgs) -> Exit {
    // Fails only if a handler is there already, and that one is ours.
    let _ = ctrlc::set_handler(|| STOP.store(true, Ordering::Relaxed));
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
    // The folder is tried before minutes are spent.
    make_folder(&args.out)?;
    let bar = if args.quiet {
        ProgressBar::hidden()
    } else {
        ProgressBar::new(args.scenes)
    };
    let style =
        ProgressStyle::with_template("{prefix} [{bar:30}] {pos} of {len} scenes, {eta} left");
    bar.set_style(
        style
            .expect("the template is well formed")
            .progress_chars("=> "),
    );
    bar.set_prefix("score-vision");
    bar.enable_steady_tick(Duration::from_millis(500));
    let plan = Plan {
        seed: args.seed,
        scenes: args.scenes,
        size_px: [args.width, (3 * args.width).div_ceil(4)],
        verifier: VerifierSpec::default(),
    };
    let unsaved = Mutex::new(None);
    let [w, h] = plan.size_px;
    let rows = score(
        args.seed,
        args.scenes,
        SizePx(w, h),
        &plan.verifier,
        args.jobs,
        &STOP,
        |scene, shot| {
            bar.inc(1);
            if scene.n < args.pictures
                && let Err(error) = save(&args.out, scene, shot)
            {
                unsaved
                    .lock()
                    .expect("nobody panics with it")
                    .get_or_insert(error);
            }
        },
    );
    bar.finish_and_clear();
    let rows = rows?;
    if let Some(error) = unsaved.into_inner().expect("nobody panics with it") {
        return Err(error.into());
    }
    say::line(table(&rows));
    write(&args.out, &plan, &rows)?;
    say::line(format_args!(
        "results in {}: scores.md, scores.csv, scores.json, scenes.csv, pixels.png, roc.png",
        args.out.display()
    ));
    Ok(())
}
