//! `rheotaxis segment`: finds dye and source in a picture.

use super::args_vision::SegmentArgs;
use super::exit::Exit;
use super::say;
use output::files::begin_folder;
use std::path::PathBuf;
use studies::segment::{Segmented, read_picture, table, write};

/// Reads the picture, segments it, prints the result and writes the folder.
pub(super) fn segment(args: &SegmentArgs) -> Exit {
    let spec = match args.colours.spec() {
        Ok(spec) => spec,
        Err(problem) => {
            say::error(problem, None);
            return Exit::Error;
        }
    };
    let picture = match read_picture(&args.image) {
        Ok(picture) => picture,
        Err(error) => {
            say::error(&error, error.help());
            return Exit::Error;
        }
    };
    let part = |p: Option<&std::ffi::OsStr>| {
        p.map_or("picture".to_string(), |s| s.to_string_lossy().into_owned())
    };
    let segmented = Segmented::new(part(args.image.file_name()), picture, spec);
    say::line(table(&segmented));
    let folder = args.out.clone().unwrap_or_else(|| {
        PathBuf::from("runs").join(format!("{}-segmented", part(args.image.file_stem())))
    });
    let written = begin_folder(&folder, "segment").and_then(|out| {
        if let Some(removed) = say::removed(&folder, out.removed()) {
            say::note(removed);
        }
        write(&out, &segmented)
    });
    match written {
        Ok(sheet) => {
            say::line(format_args!("everything on one sheet: {}", sheet.display()));
            Exit::Success
        }
        Err(error) => {
            say::error(error, None);
            Exit::Error
        }
    }
}
