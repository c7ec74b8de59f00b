//! `rheotaxis listen`: prints what runs publish over zenoh while they go.
#![allow(clippy::disallowed_methods, reason = "it waits for runs of other processes, outside any tick")]

use crate::args::live::ListenArgs;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::{say, stop};
use output::live::{ListenOptions, Listener, LiveError, News, topics};
use output::shown::turns;
use std::collections::BTreeSet;
use std::io::{ErrorKind, Write};
use std::num::NonZeroU64;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::sleep;
use std::time::Duration;
use world::registry::Registry;

/// How often it looks whether Ctrl-C was pressed.
const STEP: Duration = Duration::from_millis(100);

/// After so many steps without a run it says where it looks for one.
const PATIENCE: u32 = 10;

/// Prints messages until all runs have ended, there are enough, or nobody reads them.
pub(crate) fn listen(registry: &Registry, args: &ListenArgs) -> Result<Exit, Failure> {
    let stop = stop::listen();
    let Some(mut listener) = opened(registry, args, stop)? else {
        return Ok(Exit::Interrupted);
    };
    if let Some(notice) = listener.notice() {
        say::note(notice);
    }
    let mut exit = Exit::Success;
    let (mut going, mut met, mut steps) = (BTreeSet::new(), false, 0);
    let mut left = args.count.map(NonZeroU64::get);
    while !stop.load(Ordering::Relaxed) {
        match listener.next(STEP)? {
            None => {
                steps += 1;
                if steps == PATIENCE && !met {
                    let place = listener.place();
                    say::note(format_args!(
                        "no run is there yet: it looks at {place}, until Ctrl-C; `rheotaxis run SCENARIO` in another \
                         terminal is one, and --connect names another place"
                    ));
                }
            }
            Some(News::Message(line)) => {
                if let Err(error) = writeln!(std::io::stdout(), "{}", shown_json(&line.to_string())) {
                    // A reader that closes the pipe early (`| head`) has what it wanted.
                    let enough = error.kind() == ErrorKind::BrokenPipe;
                    return if enough { Ok(exit) } else { Err(error.into()) };
                }
                left = left.map(|left| left - 1);
                if left == Some(0) {
                    return Ok(exit);
                }
            }
            Some(News::Begun(run)) => {
                say::note(format_args!("rheotaxis/{run} is there"));
                met = true;
                going.insert(run);
            }
            Some(News::Ended(run)) => {
                say::note(format_args!("rheotaxis/{run} has ended"));
                going.remove(&run);
            }
            Some(News::Gone(run)) => {
                say::note(format_args!("rheotaxis/{run} is gone and did not say that it ended"));
                going.remove(&run);
                exit = Exit::Error;
            }
        }
        if met && going.is_empty() && !args.follow {
            return Ok(exit);
        }
    }
    Ok(Exit::Interrupted)
}

/// A listener as soon as there is a session, which a client's configuration gives only with a run. `None` at Ctrl-C.
fn opened(registry: &Registry, args: &ListenArgs, stop: &AtomicBool) -> Result<Option<Listener>, LiveError> {
    let options = ListenOptions {
        key: args.key.clone(),
        connect: args.connect.clone(),
        config_file: args.zenoh_config.clone(),
        topics: topics(registry),
    };
    let mut told = false;
    while !stop.load(Ordering::Relaxed) {
        match Listener::open(&options) {
            Err(error @ LiveError::NoSession { .. }) => {
                if !told {
                    say::note(format_args!("{error}; it tries again until Ctrl-C"));
                }
                told = true;
                sleep(STEP);
            }
            opened => return opened.map(Some),
        }
    }
    Ok(None)
}

/// A line of JSON without characters that turn the direction of writing: they stand in it as JSON writes any character.
fn shown_json(line: &str) -> String {
    let one = |c: char| match turns(c) {
        true => format!("\\u{:04x}", u32::from(c)),
        false => c.to_string(),
    };
    line.chars().map(one).collect()
}
