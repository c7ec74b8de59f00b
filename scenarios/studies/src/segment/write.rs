//! The files of a segmentation: a picture for each step, the clusters, a sheet of all, and the numbers.

use super::clusters::{clusters, fate};
use super::overlay::SegmentedPicture;
use super::sheet::sheet;
use crate::campaign::report::{Table, TableColumn};
use eyes::vision::{Pass, Sighting, Target};
use image::RgbImage;
use output::charts::{mask_png, picture_png};
use output::files::{PendingFiles, ReportError};
use robots::strategy::VerifierSpec;
use serde::Serialize;
use std::fmt::Write as _;
use std::path::PathBuf;
use world::files::Folder;

#[derive(Serialize)]
struct Numbers<'a> {
    picture: &'a str,
    width: u32,
    height: u32,
    parameters: &'a VerifierSpec,
    sighting: &'a Sighting,
}

/// Writes everything into a folder; returns the sheet's path.
///
/// # Errors
/// If files cannot be written; names each such file. All others are written.
pub fn write(out: &Folder, s: &SegmentedPicture) -> Result<PathBuf, ReportError> {
    let mut kept = PendingFiles::new(out);
    for pass in &s.parts.passes {
        let name = format!("pass-{}.png", pass.number);
        kept.draw(&name, colours(&s.parts.taken_by(pass.number)));
    }
    for (target, name) in [(Target::Plume, "plume"), (Target::Source, "source")] {
        let union = |kept| colours(&s.parts.union(target, kept));
        kept.draw(&format!("{name}.png"), union(false));
        kept.draw(&format!("{name}-kept.png"), union(true));
        let mask = mask_png(&s.parts.mask(target, true));
        kept.draw(&format!("{name}-mask.png"), mask.map_err(|e| e.to_string()));
    }
    kept.draw("left.png", colours(&s.parts.left()));
    kept.draw("overlay.png", colours(&s.overlay()));
    let svg = clusters(&s.sighting.passes, &s.spec.colours).svg("clusters");
    kept.figure("clusters", &svg);
    let numbers = Numbers {
        picture: &s.name,
        width: s.picture.width(),
        height: s.picture.height(),
        parameters: &s.spec,
        sighting: &s.sighting,
    };
    let json = serde_json::to_string_pretty(&numbers).expect("plain numbers");
    kept.write("segmentation.json", format!("{json}\n").as_bytes());
    kept.draw("sheet.png", sheet(s).and_then(|sheet| colours(&sheet)));
    kept.done()?;
    Ok(out.dir().join("sheet.png"))
}

fn colours(picture: &RgbImage) -> Result<Vec<u8>, String> {
    picture_png(picture).map_err(|e| e.to_string())
}

/// The passes and the verdict as text.
pub fn table(s: &SegmentedPicture) -> String {
    let (w, h) = s.picture.dimensions();
    let all = f64::from(w) * f64::from(h);
    let columns: [TableColumn<'_, &Pass>; 6] = [
        ("pass", &|p| p.number.to_string()),
        ("towards", &|p| p.target.reference().name().to_string()),
        ("pattern", &|p| format!("({}, {}, {})", p.pattern.rgb[0], p.pattern.rgb[1], p.pattern.rgb[2])),
        ("distance", &|p| format!("{:.1}", p.pattern.distance)),
        ("share", &|p| format!("{:.2}%", 100.0 * p.pixels as f64 / all)),
        ("in the group", &|p| fate(p.fate, &s.spec.colours).1),
    ];
    let passes = Table::of(&s.sighting.passes, &columns).text(None);
    let mut out = format!("{}, {w} x {h}\n\n{passes}", s.name);
    let v = &s.sighting;
    let _ = writeln!(
        out,
        "\nplume {:.2}% of the picture, source {:.2}%: {}",
        100.0 * v.dye_share,
        100.0 * v.source_share,
        v.label()
    );
    out
}
