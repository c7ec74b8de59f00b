//! `rheotaxis campaign identify`: judges drawn arms by published figures.

use crate::args::campaign::IdentifyArgs;
use crate::commands::reproduce::command;
use crate::exit::Exit;
use crate::failure::{Failure, hinted};
use crate::say;
use std::path::{Path, PathBuf};
use studies::campaign::{Campaign, Manifest, RunRow, read_rows};
use studies::identify::{Draws, IdentificationText, identify, text, write};
use studies::reproduce::{Published, wanted};
use world::registry::Registry;

/// Writes what was identified and prints its tables.
pub(super) fn identify_draws(registry: &Registry, args: &IdentifyArgs) -> Result<Exit, Failure> {
    let round = |dir: &PathBuf| -> Result<(Campaign, Vec<RunRow>), Failure> {
        Ok((Manifest::open(dir)?.campaign(registry)?, read_rows(dir)?))
    };
    let rounds = args.dirs.iter().map(round).collect::<Result<Vec<_>, _>>()?;
    let (first, last) = (&rounds[0].0, rounds[rounds.len() - 1].0.spec.clone());
    let row = args.figures.clone().unwrap_or_else(|| Path::new(&first.name).to_owned());
    let reference = wanted(registry, &[row], &[])?.swap_remove(0);
    let arm = reference.row.arms.first().map(|arm| arm.name.as_str());
    let mut figures = Published::of(&reference.row.figures, arm);
    for name in &args.leave_out {
        let there: Vec<&str> = figures.iter().map(|f| f.name.as_str()).collect();
        let known = format!("the figures: {}", there.join("; "));
        let at = figures.iter().position(|f| f.name == *name);
        figures.remove(at.ok_or_else(|| hinted(format!("--leave-out: there is no figure \"{name}\""), known))?);
    }
    if figures.is_empty() {
        return Err(hinted(
            format!("no figure of `{}` says how well it is known", reference.row.id),
            "a share needs Count(k, n), a mean Measured(value, error), MeanOf(value, n) or AtLeast(value, n)",
        ));
    }
    let draws = Draws::gather(rounds).map_err(|problem| hinted(problem, "see `rheotaxis campaign identify --help`"))?;
    if draws.draws.is_empty() {
        return Err(hinted("the rounds have no runs", "`rheotaxis campaign run` makes them"));
    }
    let found = identify(draws, &figures);
    say::line(text(&found, &last.title, IdentificationText::Plain));
    write(&args.out, &found, &last, &command())?;
    say::line(format_args!("results in {}: IDENTIFICATION.md, draws.csv, pairs.svg, next.ron", args.out.display()));
    Ok(Exit::Success)
}
