//! Pictures from the robots' cameras. Each becomes a file at once; a table says where and when it was taken.

use super::probes::file_name;
use crate::charts::picture_png;
use crate::columns::{ColumnInfo, columns, header};
use crate::files::{ReportError, csv_text, write_whole};
use base64::prelude::{BASE64_STANDARD, Engine as _};
use image::ImageError;
use image::codecs::jpeg::JpegEncoder;
use nalgebra::Vector3;
use rheotaxis::frame::PictureFrame;
use world::files::Folder;
use world::math;
use world::units::Heading;

/// JPEG quality of the pictures in the page; the files beside it are lossless.
const PAGE_QUALITY: u8 = 85;

/// Columns of the table.
pub(crate) const COLUMNS: [ColumnInfo; 12] = columns! {
    "file", "", "Name of the picture's file.";
    "robot", "", "Id of the robot that took it.";
    "t_s", "s", "Time since the start of the mission.";
    "camera_east_m", "m", "True place of the camera, east.";
    "camera_north_m", "m", "True place of the camera, north.";
    "camera_up_m", "m", "True place of the camera, up.";
    "look_heading_deg", "degrees", "True heading in which the camera looks.";
    "look_down_deg", "degrees", "Angle below the horizon at which the camera looks.";
    "view_deg", "degrees", "Its full horizontal angle of view in the water.";
    "believed_east_m", "m", "Position of the robot east of the datum, as it believed.";
    "believed_north_m", "m", "Position of the robot north of the datum, as it believed.";
    "believed_depth_m", "m", "Depth of the robot, as it believed.";
};

/// A picture as the report shows it.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownPicture {
    /// Name of its file.
    pub file: String,
    /// Which robot took it.
    pub robot: String,
    /// Time, s.
    pub t_s: f64,
    /// The picture, small enough for a page.
    jpeg: Vec<u8>,
}

impl ShownPicture {
    /// Caption in the page.
    pub(crate) fn title(&self) -> String {
        format!("{} at {:.1} s", self.robot, self.t_s)
    }

    /// The picture as it is embedded in the self-contained page.
    pub(crate) fn html(&self) -> String {
        format!("<img alt=\"{}\" src=\"data:image/jpeg;base64,{}\">", self.file, BASE64_STANDARD.encode(&self.jpeg))
    }
}

/// Keeps the pictures of a run.
#[derive(Debug)]
pub struct Pictures {
    out: Folder,
    most: usize,
    /// The rows of the table so far.
    rows: Vec<[String; COLUMNS.len()]>,
    shown: Vec<ShownPicture>,
}

impl Pictures {
    /// Writes into a folder, at most `most` pictures.
    pub fn new(out: &Folder, most: u32) -> Self {
        Self { out: out.clone(), most: most as usize, rows: Vec::new(), shown: Vec::new() }
    }

    /// Writes `picture-<robot>-<n>.png` and its line in `pictures.csv`, and returns the bytes of the file; `None` once
    /// there are enough.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn push(&mut self, taken: &PictureFrame) -> Result<Option<Vec<u8>>, ReportError> {
        if self.shown.len() >= self.most {
            return Ok(None);
        }
        let number = (self.shown.iter()).filter(|p| p.robot == taken.robot).count();
        let file = format!("picture-{}-{number}.png", file_name(&taken.robot));
        let path = self.out.file(&file)?;
        let drawn = |e: ImageError| ReportError::Draw { path: path.clone(), cause: e.to_string() };
        let image = &*taken.picture.image;
        let png = picture_png(image).map_err(drawn)?;
        let mut jpeg = Vec::new();
        JpegEncoder::new_with_quality(&mut jpeg, PAGE_QUALITY).encode_image(image).map_err(drawn)?;
        write_whole(&path, &png)?;
        self.row(&file, taken);
        let table = csv_text(&header(&COLUMNS), &self.rows);
        write_whole(&self.out.file("pictures.csv")?, table.as_bytes())?;
        self.shown.push(ShownPicture { file, robot: taken.robot.clone(), t_s: taken.t_s, jpeg });
        Ok(Some(png))
    }

    fn row(&mut self, file: &str, taken: &PictureFrame) {
        let (picture, e) = (&taken.picture, &taken.estimate);
        let p = taken.truth.point(picture.p_BC);
        let look = taken.truth.R_WB * picture.R_BC * Vector3::z();
        let metres = |m: f64| format!("{m:.3}");
        let degrees = |deg: f64| format!("{deg:.2}");
        self.rows.push([
            file.to_string(),
            taken.robot.clone(),
            metres(taken.t_s),
            metres(p.x),
            metres(p.y),
            metres(p.z),
            degrees(Heading::from_vector(look.xy()).deg()),
            degrees(math::asin((-look.z).clamp(-1.0, 1.0)).to_degrees()),
            degrees(picture.view_rad.to_degrees()),
            metres(e.position.x),
            metres(e.position.y),
            metres(e.depth_m),
        ]);
    }

    /// The pictures kept, in the order in which they were taken.
    pub fn shown(&self) -> &[ShownPicture] {
        &self.shown
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::{self, folder};
    use image::{Rgb, RgbImage};
    use robots::handoff::Picture;
    use robots::sense::turned;
    use std::fs;
    use std::sync::Arc;

    /// A red picture, 30° down.
    fn taken(robot: &str, t_s: f64) -> PictureFrame {
        let of = sample::robot(Vector3::new(1.0, 2.0, -3.0), Heading::from_deg(90.0));
        let black = sample::picture(&of, t_s);
        let picture = Picture {
            image: Arc::new(RgbImage::from_pixel(8, 6, Rgb([200, 30, 20]))),
            R_BC: turned(0.0, 30f64.to_radians()),
            view_rad: 60f64.to_radians(),
            ..black.picture
        };
        PictureFrame { robot: robot.into(), picture, ..black }
    }

    #[test]
    fn pictures_are_files_with_a_line_each_and_no_more_than_asked_for() {
        let dir = tempfile::tempdir().unwrap();
        let mut kept = Pictures::new(&folder(dir.path()), 3);
        for (robot, t) in [("a", 1.0), ("b", 2.0), ("a", 3.0), ("a", 4.0)] {
            let file = kept.push(&taken(robot, t)).unwrap();
            assert_eq!(file.is_some(), t < 4.0, "three are enough");
        }
        let names: Vec<_> = kept.shown().iter().map(|p| p.file.as_str()).collect();
        assert_eq!(names, ["picture-a-0.png", "picture-b-0.png", "picture-a-1.png"]);
        let back = image::open(dir.path().join(names[2])).unwrap().into_rgb8();
        assert_eq!(back, *taken("a", 3.0).picture.image);
        let csv = fs::read_to_string(dir.path().join("pictures.csv")).unwrap();
        let rows: Vec<Vec<&str>> = csv.lines().map(|l| l.split(',').collect()).collect();
        assert_eq!(rows.len(), 4);
        assert!(rows.iter().all(|r| r.len() == rows[0].len()));
        // The camera sits half a metre ahead and looks east, 30° down.
        assert_eq!(
            rows[1][..9],
            ["picture-a-0.png", "a", "1.000", "1.500", "2.000", "-3.100", "90.00", "30.00", "60.00"]
        );
    }

    #[test]
    fn a_picture_stands_in_the_page() {
        let shown = ShownPicture { file: "a.png".into(), robot: "a".into(), t_s: 0.0, jpeg: vec![255, 216] };
        assert!(shown.html().contains("base64,/9g="));
    }
}
