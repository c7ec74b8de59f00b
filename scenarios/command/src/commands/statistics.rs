//! `rheotaxis statistics`: compares a plume's statistics with published ones.

use crate::args::StatisticsArgs;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::progress::{PARTS, bar};
use crate::{say, stop};
use output::files::make_folder;
use output::shown::printable;
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use studies::statistics::{self, table, write};
use world::registry::Registry;

/// Measures the plume, prints the table and writes it as CSV.
pub(crate) fn statistics(registry: &Registry, args: &StatisticsArgs) -> Result<Exit, Failure> {
    let loaded = say::checked(registry, &args.file)?;
    // First, so that an error does not come after minutes of work.
    let folder = args
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from("runs").join(format!("{}-{}-statistics", loaded.name, args.seed)));
    make_folder(&folder)?;
    let stop = stop::listen();
    let bar = bar(args.quiet, PARTS, "{prefix} [{bar:30}] {percent:>3} %, {eta} left");
    bar.set_prefix(printable(&loaded.name).into_owned());
    let measured = statistics::statistics(&loaded, args.key.seed(args.seed), args.seconds, |share| {
        bar.set_position((share * PARTS as f64) as u64);
        !stop.load(Ordering::Relaxed)
    });
    bar.finish_and_clear();
    let measured = measured?;
    say::line(table(&measured));
    say::line(format_args!("the table is in {}", write(&folder, &measured)?.display()));
    Ok(Exit::Success)
}
