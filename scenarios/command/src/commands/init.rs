//! `rheotaxis init`: writes a scenario that comes with the program, or the URDF of its gantry, to a file, for the user
//! to change.

use super::list;
use crate::args::init::InitArgs;
use crate::exit::Exit;
use crate::failure::{Failure, hinted};
use crate::say;
use rheotaxis::scenario::template;
use robots::vehicles::CRAB_GANTRY;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use world::files::{OutputError, make_folder, write_new};

/// Writes the template, or lists the templates if none is named.
pub(crate) fn init(args: &InitArgs) -> Result<Exit, Failure> {
    if let Some(folder) = &args.gantry {
        return gantry(folder);
    }
    let Some(name) = &args.template else {
        say::line(format_args!("Templates for `rheotaxis init TEMPLATE [PATH]`:\n"));
        list::scenarios();
        return Ok(Exit::Success);
    };
    let Some(found) = template(name) else {
        return Err(hinted(format!("there is no template `{name}`"), "`rheotaxis init` lists them"));
    };
    let file_name = format!("{name}.ron");
    let path = match &args.path {
        None => PathBuf::from(file_name),
        Some(folder) if folder.is_dir() => folder.join(file_name),
        Some(path) => path.clone(),
    };
    let shown = path.display();
    let folder = path.parent().unwrap_or(Path::new(""));
    let written = write_new(&path, found.text.as_bytes());
    written.and_then(|_| found.write_files(folder)).map_err(|e| refused(e, "name another PATH"))?;
    say::line(format_args!("wrote {shown}; next: rheotaxis run {shown}"));
    Ok(Exit::Success)
}

/// Writes the URDF of the built-in gantry.
fn gantry(folder: &Path) -> Result<Exit, Failure> {
    let (name, text) = CRAB_GANTRY;
    let path = folder.join(name);
    let made = make_folder(folder).map_err(|e| OutputError::new(folder, e));
    let written = made.and_then(|()| write_new(&path, text.as_bytes()));
    written.map_err(|e| refused(e, "name another FOLDER"))?;
    say::line(format_args!(
        "wrote {}; a scenario beside it takes it with `gantry: CrabGantry(urdf: \"{name}\")`",
        path.display()
    ));
    Ok(Exit::Success)
}

/// Why a file was not written.
fn refused(error: OutputError, other: &str) -> Failure {
    if error.source.kind() == ErrorKind::AlreadyExists {
        let problem = "is there already and is not overwritten";
        return hinted(format!("{}: {problem}", error.path.display()), other);
    }
    error.into()
}
