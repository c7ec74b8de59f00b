//! `rheotaxis run`: reads, checks and prepares; the missions themselves are the integrator's.

use super::args::RunArgs;
use super::exit::Exit;
use super::say;
use crate::scenario::{Loaded, load};
use std::path::PathBuf;

/// Runs every file, going on after a broken one.
pub(super) fn run(args: &RunArgs) -> Exit {
    let mut exit = Exit::Success;
    for file in &args.files {
        let checked = load(file).and_then(|loaded| loaded.check().map(|odd| (loaded, odd)));
        match checked {
            Ok((loaded, odd)) => {
                say::warnings(odd);
                exit = exit.worse(one(args, &loaded));
            }
            Err(error) => {
                say::scenario_error(error);
                exit = exit.worse(Exit::Error);
            }
        }
    }
    exit
}

fn one(args: &RunArgs, loaded: &Loaded) -> Exit {
    let out = out_dir(args, loaded);
    if let Err(e) = writable(&out) {
        say::error(
            format!("{}: results cannot be written there: {e}", out.display()),
            Some("name another folder with --out"),
        );
        return Exit::Error;
    }
    say::error("this build cannot run missions", None);
    Exit::Error
}

/// Where the results of a scenario go.
fn out_dir(args: &RunArgs, loaded: &Loaded) -> PathBuf {
    let own = format!("{}-{}", loaded.name, args.seed);
    match &args.out {
        None => PathBuf::from("runs").join(own),
        Some(out) if args.files.len() > 1 => out.join(own),
        Some(out) => out.clone(),
    }
}

/// Makes the folder and tries a file in it: better now than after the run.
fn writable(out: &std::path::Path) -> std::io::Result<()> {
    std::fs::create_dir_all(out)?;
    let probe = out.join(".writable");
    std::fs::write(&probe, b"")?;
    std::fs::remove_file(probe)
}
