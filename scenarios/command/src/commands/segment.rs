//! `rheotaxis segment`: finds dye and source in a picture, or says in how many pictures it finds them.

use crate::args::vision::SegmentArgs;
use crate::exit::Exit;
use crate::failure::{Failure, refused};
use crate::say;
use eyes::vision::Verifier;
use output::files::begin_folder;
use robots::strategy::VerifierSpec;
use std::path::{Path, PathBuf};
use studies::campaign::stats::wilson;
use studies::segment::{SegmentedPicture, read_picture, table, write};

/// Segments one picture or judges several.
pub(crate) fn segment(args: &SegmentArgs) -> Result<Exit, Failure> {
    let spec = args.colours.spec()?;
    match &args.images[..] {
        [image] => one(image, args.out.as_ref(), spec),
        _ if args.out.is_some() => Err("--out: of several pictures only the verdicts are printed".into()),
        images => Ok(several(images, &spec)),
    }
}

/// Prints the verdict on each picture, and how many show a source.
fn several(images: &[PathBuf], spec: &VerifierSpec) -> Exit {
    let verifier = Verifier::new(spec);
    let (mut read, mut verified) = (0, 0);
    for image in images {
        match read_picture(image) {
            Ok(picture) => {
                let sighting = verifier.judge(&picture);
                read += 1;
                verified += u64::from(sighting.verified);
                say::line(format_args!("{}: {}", image.display(), sighting.label()));
            }
            Err(error) => {
                refused(&error.into());
            }
        }
    }
    let share = wilson(verified, read);
    say::line(format_args!(
        "\na source giving off dye in {verified} of {read} pictures ({:.0}–{:.0} %)",
        100.0 * share.low,
        100.0 * share.high
    ));
    if read < images.len() as u64 {
        return Exit::Error;
    }
    Exit::Success
}

/// Segments a picture, prints the result and writes the folder.
fn one(image: &Path, out: Option<&PathBuf>, spec: VerifierSpec) -> Result<Exit, Failure> {
    let picture = read_picture(image)?;
    let part = |p: Option<&std::ffi::OsStr>| p.map_or("picture".to_string(), |s| s.to_string_lossy().into_owned());
    let segmented = SegmentedPicture::new(part(image.file_name()), picture, spec);
    say::line(table(&segmented));
    let folder =
        out.cloned().unwrap_or_else(|| PathBuf::from("runs").join(format!("{}-segmented", part(image.file_stem()))));
    let out = begin_folder(&folder, "segment")?;
    if let Some(removed) = say::removed(&folder, out.removed()) {
        say::note(removed);
    }
    say::line(format_args!("everything on one sheet: {}", write(&out, &segmented)?.display()));
    Ok(Exit::Success)
}
