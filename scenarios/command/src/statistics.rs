//! `rheotaxis statistics`: compares a plume's statistics with published ones.

use super::args::StatisticsArgs;
use super::exit::Exit;
use super::{say, stop};
use indicatif::{ProgressBar, ProgressStyle};
use output::files::make_folder;
use output::shown::printable;
use rheotaxis::scenario::load_with;
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use studies::statistics::{self, StatisticsError, table, write};
use world::registry::Registry;

/// Steps of the progress bar.
const PARTS: u64 = 1000;

/// Measures the plume, prints the table and writes it as CSV.
pub(super) fn statistics(registry: &Registry, args: &StatisticsArgs) -> Exit {
    let checked = load_with(registry, &args.file).and_then(|loaded| loaded.check().map(|odd| (loaded, odd)));
    let loaded = match checked {
        Ok((loaded, odd)) => {
            say::warnings(&odd);
            loaded
        }
        Err(error) => {
            say::scenario_error(&error);
            return Exit::Error;
        }
    };
    // First, so that an error does not come after minutes of work.
    let folder = args
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from("runs").join(format!("{}-{}-statistics", loaded.name, args.seed)));
    if let Err(error) = make_folder(&folder) {
        say::error(error, None);
        return Exit::Error;
    }
    let stop = stop::listen();
    let bar = if args.quiet { ProgressBar::hidden() } else { ProgressBar::new(PARTS) };
    let style = ProgressStyle::with_template("{prefix} [{bar:30}] {percent:>3} %, {eta} left");
    bar.set_style(style.expect("the template is well formed"));
    bar.set_prefix(printable(&loaded.name).into_owned());
    let measured = statistics::statistics(&loaded, args.key.seed(args.seed), args.seconds, |share| {
        bar.set_position((share * PARTS as f64) as u64);
        !stop.load(Ordering::Relaxed)
    });
    bar.finish_and_clear();
    let measured = match measured {
        Ok(measured) => measured,
        Err(error) => {
            let exit = match error {
                StatisticsError::Interrupted => Exit::Interrupted,
                _ => Exit::Error,
            };
            say::error(error, None);
            return exit;
        }
    };
    say::line(table(&measured));
    match write(&folder, &measured) {
        Ok(path) => {
            say::line(format_args!("the table is in {}", path.display()));
            Exit::Success
        }
        Err(error) => {
            say::error(error, None);
            Exit::Error
        }
    }
}
