//! Plume, water, sidescan and pictures in a recording.

use super::{AREA, Recorder};
use crate::files::ReportError;
use crate::ros::{MessageKind, compressed_image, nanoseconds, plume_cloud, point_cloud, transforms, water_cloud};
use crate::scene::frames::transform;
use eyes::sidescan::{CELL_M, Row};
use rheotaxis::frame::{PictureFrame, PlumeFrame, WaterFrame};
use world::frames::Pose;

impl Recorder {
    /// Records the flow of the water as a cloud: see [`water_cloud`].
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn water(&mut self, water: &WaterFrame) -> Result<(), ReportError> {
        let (t, cloud) = (nanoseconds(water.t_s), water_cloud(water, AREA));
        self.file.write("/water", MessageKind::PointCloud2, t, &cloud)?;
        Ok(())
    }

    /// Records filaments as a cloud: see [`plume_cloud`]; and, as often, the ways of all machines so far.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn plume(&mut self, plume: &PlumeFrame) -> Result<(), ReportError> {
        let (t, cloud) = (nanoseconds(plume.t_s), plume_cloud(plume, AREA));
        self.file.write("/plume", MessageKind::PointCloud2, t, &cloud)?;
        self.ways.whole(&mut self.file, t)?;
        Ok(())
    }

    /// Records a line of a sidescan's picture as a cloud on the believed bed; `level` is in dB, without Lambert's
    /// decrease.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn echo(&mut self, robot: &str, line: &Row) -> Result<(), ReportError> {
        let t = nanoseconds(line.t_s);
        let centre = self.scene.centre();
        let mut rows: Vec<[f32; 4]> = Vec::new();
        for port in [true, false] {
            for (k, level) in line.side(port).iter().enumerate() {
                let p = line.ground_position(port, (k as f64 + 0.5) * CELL_M) - centre;
                if level.is_finite() {
                    rows.push([p.x as f32, p.y as f32, line.bed_z as f32, *level]);
                }
            }
        }
        let cloud = point_cloud(t, AREA, ["x", "y", "z", "level"], &rows);
        let topic = format!("/{robot}/sidescan");
        self.file.write(&topic, MessageKind::PointCloud2, t, &cloud)?;
        Ok(())
    }

    /// Records a picture without loss, and the camera's place on the robot.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn picture(&mut self, taken: &PictureFrame, png: &[u8]) -> Result<(), ReportError> {
        let (t, id, p) = (nanoseconds(taken.t_s), &taken.robot, &taken.picture);
        let optical = format!("{id}/camera_optical");
        let mount = transform(t, id, optical.clone(), &Pose { p_WB: p.p_BC, R_WB: p.R_BC });
        self.file.write("/tf", MessageKind::TfMessage, t, &transforms(&[mount]))?;
        let image = compressed_image(t, &optical, "png", png);
        let topic = format!("/{id}/camera/compressed");
        self.file.write(&topic, MessageKind::CompressedImage, t, &image)?;
        Ok(())
    }
}
