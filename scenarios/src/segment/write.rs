//! What a segmentation leaves: a picture for each step, the clusters, a sheet of all, and the numbers.

use super::clusters::{clusters, fate};
use super::overlay::overlay;
use super::sheet::sheet;
use crate::report::figures::png;
use crate::report::{ReportError, make_folder, write_whole};
use image::{GrayImage, ImageFormat, RgbImage};
use robots::vision::{Segmentation, Sighting, Target, Verifier, VerifierSpec};
use serde::Serialize;
use std::fmt::Write as _;
use std::io::Cursor;
use std::path::{Path, PathBuf};

/// A picture taken apart and judged.
#[derive(Clone, Debug)]
pub struct Segmented {
    /// The file's name.
    pub name: String,
    /// The picture.
    pub picture: RgbImage,
    /// With which parameters.
    pub spec: VerifierSpec,
    /// Its parts.
    pub parts: Segmentation,
    /// What it shows.
    pub sighting: Sighting,
}

#[derive(Serialize)]
struct Numbers<'a> {
    picture: &'a str,
    width: u32,
    height: u32,
    parameters: &'a VerifierSpec,
    sighting: &'a Sighting,
}

impl Segmented {
    /// Takes a picture apart and judges it.
    #[must_use]
    pub fn new(name: String, picture: RgbImage, spec: VerifierSpec) -> Self {
        let (parts, sighting) = Verifier::new(&spec).look(&picture);
        Self {
            name,
            picture,
            spec,
            parts,
            sighting,
        }
    }

    pub(super) fn overlay(&self) -> RgbImage {
        overlay(&self.picture, &self.parts, self.sighting.source.as_ref())
    }
}

/// Writes everything into a folder; returns the sheet's path.
///
/// # Errors
/// If the folder or a file cannot be written.
pub fn write(folder: &Path, s: &Segmented) -> Result<PathBuf, ReportError> {
    make_folder(folder)?;
    let at = |name: &str| folder.join(name);
    for pass in &s.parts.passes {
        let name = format!("pass-{}.png", pass.number);
        colours(&at(&name), &s.parts.taken_by(pass.number))?;
    }
    for (target, name) in [(Target::Plume, "plume"), (Target::Source, "source")] {
        let union = |kept| s.parts.union(target, kept);
        colours(&at(&format!("{name}.png")), &union(false))?;
        colours(&at(&format!("{name}-kept.png")), &union(true))?;
        mask(
            &at(&format!("{name}-mask.png")),
            &s.parts.mask(target, true),
        )?;
    }
    colours(&at("left.png"), &s.parts.left())?;
    colours(&at("overlay.png"), &s.overlay())?;
    let undrawn = |path: &Path| {
        let path = path.to_owned();
        move |cause| ReportError::Draw { path, cause }
    };
    let svg = clusters(&s.sighting.passes, &s.spec.colours).svg("clusters");
    write_whole(&at("clusters.svg"), svg.as_bytes())?;
    let path = at("clusters.png");
    write_whole(&path, &png(&svg).map_err(undrawn(&path))?)?;
    let numbers = Numbers {
        picture: &s.name,
        width: s.picture.width(),
        height: s.picture.height(),
        parameters: &s.spec,
        sighting: &s.sighting,
    };
    let json = serde_json::to_string_pretty(&numbers).expect("plain numbers");
    write_whole(&at("segmentation.json"), format!("{json}\n").as_bytes())?;
    let path = at("sheet.png");
    colours(&path, &sheet(s).map_err(undrawn(&path))?)
}

fn colours(path: &Path, picture: &RgbImage) -> Result<PathBuf, ReportError> {
    let mut bytes = Cursor::new(Vec::new());
    encoded(path, picture.write_to(&mut bytes, ImageFormat::Png))?;
    write_whole(path, bytes.get_ref())
}

fn mask(path: &Path, picture: &GrayImage) -> Result<PathBuf, ReportError> {
    let mut bytes = Cursor::new(Vec::new());
    encoded(path, picture.write_to(&mut bytes, ImageFormat::Png))?;
    write_whole(path, bytes.get_ref())
}

fn encoded(path: &Path, result: image::ImageResult<()>) -> Result<(), ReportError> {
    result.map_err(|e| ReportError::Draw {
        path: path.to_owned(),
        cause: e.to_string(),
    })
}

/// The passes and the verdict as text.
#[must_use]
pub fn table(s: &Segmented) -> String {
    let (w, h) = s.picture.dimensions();
    let all = f64::from(w) * f64::from(h);
    let mut out = format!("{}, {w} x {h}\n\n", s.name);
    out.push_str("pass  towards    pattern          distance    share  in the group\n");
    for p in &s.sighting.passes {
        let [r, g, b] = p.pattern.rgb;
        let pattern = format!("({r}, {g}, {b})");
        let (_, says) = fate(p.fate, &s.spec.colours);
        let _ = writeln!(
            out,
            "{:>4}  {:<9}  {pattern:<15}  {:>8.1}  {:>6.2}%  {says}",
            p.number,
            p.target.reference().name(),
            p.pattern.distance,
            100.0 * p.pixels as f64 / all,
        );
    }
    let v = &s.sighting;
    let _ = writeln!(
        out,
        "\nplume {:.2}% of the picture, source {:.2}%: {}",
        100.0 * v.dye_share,
        100.0 * v.source_share,
        v.words()
    );
    out
}
