//! `rheotaxis cache`: shows and clears the kept spin-ups. What the other commands say of them.
#![allow(clippy::disallowed_methods, reason = "tells how long ago a file was used")]

use crate::args::cache::{CacheArgs, CacheCommand, CacheCommandArgs};
use crate::exit::Exit;
use crate::failure::Failure;
use crate::say;
use rheotaxis::cache::SpinUps;
use world::cost::{duration, memory};
use world::files::{ShelfError, Stock};

/// Shows or clears the cache.
pub(crate) fn cache(args: &CacheCommandArgs) -> Result<Exit, Failure> {
    let kept = args.place.open()?;
    say::line(match args.what {
        None => show(&kept)?,
        Some(CacheCommand::Clear) => clear(&kept)?,
    });
    Ok(Exit::Success)
}

fn show(kept: &SpinUps) -> Result<String, ShelfError> {
    let shelf = kept.shelf();
    let stock = shelf.stock()?;
    let used = stock.used.and_then(|used| used.elapsed().ok());
    let used = used.map_or_else(String::new, |ago| format!("; the last was used {} ago", duration(ago.as_secs_f64())));
    Ok(format!("{}\n  {} of at most {}{used}", shelf.dir().display(), counted(&stock), memory(shelf.most() as f64)))
}

fn clear(kept: &SpinUps) -> Result<String, ShelfError> {
    let stock = kept.shelf().clear()?;
    let dir = kept.shelf().dir().display();
    Ok(format!("removed {} from {dir}", counted(&stock)))
}

fn counted(stock: &Stock) -> String {
    let size = if stock.bytes == 0 { "0 MB".to_string() } else { memory(stock.bytes as f64) };
    format!("{}, {size}", say::count(stock.files, "spin-up"))
}

/// The cache of a command, unless it does without.
pub(super) fn opened(args: &CacheArgs) -> Option<SpinUps> {
    if args.no_cache {
        return None;
    }
    let opened = args.place.open();
    opened.inspect_err(|problem| say::note(problem)).ok()
}

/// Tells of the first fault of the cache, at the end of a command.
pub(super) fn tell_fault(kept: Option<&SpinUps>) {
    if let Some(fault) = kept.and_then(SpinUps::fault) {
        say::note(fault);
    }
}
