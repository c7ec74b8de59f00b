//! `rheotaxis init`: writes a scenario that comes with the program to a file, for the user to change.

use super::args::InitArgs;
use super::exit::Exit;
use super::{list, say};
use rheotaxis::scenario::template;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use world::files::write_new;

/// Writes the template, or lists the templates if none is named.
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
    let written = write_new(&path, found.text.as_bytes());
    match written.and_then(|_| found.write_files(folder)) {
        Ok(()) => {
            say::line(format_args!("wrote {shown}; next: rheotaxis run {shown}"));
            Exit::Success
        }
        Err(e) if e.source.kind() == ErrorKind::AlreadyExists => {
            say::error(
                format!(
                    "{}: is there already and is not overwritten",
                    e.path.display()
                ),
                Some("name another PATH"),
            );
            Exit::Error
        }
        Err(e) => {
            say::error(e, None);
            Exit::Error
        }
    }
}
