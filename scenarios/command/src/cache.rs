//! `rheotaxis cache`: shows and clears the kept spin-ups. What the other commands say of them.
#![allow(clippy::disallowed_methods, reason = "tells how long ago a file was used")]

use super::args_cache::{CacheArgs, CacheCommand, CacheCommandArgs};
use super::exit::Exit;
use super::say;
use rheotaxis::cache::SpinUps;
use world::cost::{duration, memory};
use world::files::{ShelfError, Stock};

/// Shows or clears the cache.
pub(super) fn cache(args: &CacheCommandArgs) -> Exit {
    let kept = match args.place.open() {
        Ok(kept) => kept,
        Err(problem) => {
            say::error(problem, None);
            return Exit::Error;
        }
    };
    let told = match args.what {
        None => show(&kept),
        Some(CacheCommand::Clear) => clear(&kept),
    };
    match told {
        Ok(text) => {
            say::line(text);
            Exit::Success
        }
        Err(error) => {
            say::error(error, None);
            Exit::Error
        }
    }
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
    match stock.files {
        1 => format!("1 spin-up, {size}"),
        n => format!("{n} spin-ups, {size}"),
    }
}

/// The cache of a command, unless it does without.
pub(super) fn opened(args: &CacheArgs) -> Option<SpinUps> {
    if args.no_cache {
        return None;
    }
    let opened = args.place.open();
    opened.inspect_err(|problem| warn(problem)).ok()
}

/// Tells of the first fault of the cache, at the end of a command.
pub(super) fn tell_fault(kept: Option<&SpinUps>) {
    if let Some(fault) = kept.and_then(SpinUps::fault) {
        warn(&fault);
    }
}

fn warn(problem: &dyn std::fmt::Display) {
    say::note(problem);
}
