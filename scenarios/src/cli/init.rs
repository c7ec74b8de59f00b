//! `rheotaxis init`: writes a scenario that comes with the program, to be changed.

use super::args::InitArgs;
use super::exit::Exit;
use super::{list, say};
use crate::scenario::template;
use std::fs::File;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Writes the template, or without one lists what there is.
pub(super) fn init(args: &InitArgs) -> Exit {
    let Some(name) = &args.template else {
        say::line(format_args!(
            "Templates for `rheotaxis init TEMPLATE [PATH]`:\n"
        ));
        list::scenarios();
        return Exit::Success;
    };
    let Some(found) = template(name) else {
        say::error(
            format!("there is no template `{name}`"),
            Some("`rheotaxis init` lists them"),
        );
        return Exit::Error;
    };
    let file_name = format!("{name}.ron");
    let path = match &args.path {
        None => PathBuf::from(file_name),
        Some(folder) if folder.is_dir() => folder.join(file_name),
        Some(path) => path.clone(),
    };
    let shown = path.display();
    let folder = path.parent().unwrap_or(Path::new(""));
    match File::create_new(&path)
        .and_then(|mut f| f.write_all(found.text.as_bytes()))
        .and_then(|()| found.write_files(folder))
    {
        Ok(()) => {
            say::line(format_args!("wrote {shown}; next: rheotaxis run {shown}"));
            Exit::Success
        }
        Err(e) if e.kind() == ErrorKind::AlreadyExists => {
            say::error(
                format!("{shown}: is there already and is not overwritten"),
                Some("name another PATH"),
            );
            Exit::Error
        }
        Err(e) => {
            say::error(format!("{shown}: cannot be written: {e}"), None);
            Exit::Error
        }
    }
}
