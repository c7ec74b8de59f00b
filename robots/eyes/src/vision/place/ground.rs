//! A picture laid on the ground: the mean contrasts of square cells of the bed, as one picture shows them.
//!
//! *Source*: any text on mapping by a camera over a plane, e.g. Hartley & Zisserman 2003, Multiple View Geometry,
//! section 8.1.1: each line of sight is followed to the bed.
//!
//! *Parameters*: side of a cell, m.
//!
//! *Deviations*: the bed is a level plane at the measured altitude; what stands above it appears farther from the
//! camera's foot than it is, by its height over the camera's height above it.

use super::photometry::{Contrasts, Useless, contrasts, middle};
use nalgebra::{UnitQuaternion, Vector2, Vector3};
use robots::handoff::Picture;
use world::math;

/// Lines of sight flatter than this are left out: cosine of their angle from straight down.
const FLATTEST: f64 = 0.76;
/// Least height of a camera, m.
const LOWEST_M: f64 = 0.05;

/// Where a picture was taken, as the vehicle believes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand {
    /// Horizontal place of the body's origin (east, north), m.
    pub position: Vector2<f64>,
    /// Its height above the bed, m.
    pub altitude_m: f64,
    /// Rotation from body axes (FLU) to world axes (ENU).
    pub R_WB: UnitQuaternion<f64>,
}

/// A cell of the bed as one picture shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct GroundCell {
    /// Column and row of the cell: east and north in units of its side.
    pub(super) at: [i32; 2],
    /// Number of pixels.
    pub(super) pixels: f64,
    /// Their mean contrasts of brightness and redness.
    pub(super) mean: [f64; 2],
    /// Way of the light to the camera, m.
    pub(super) way_m: f64,
}

/// A picture on the ground.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Patch {
    /// Its cells, in order of row and column.
    pub(super) cells: Vec<GroundCell>,
    /// Standard deviation of a pixel's noise in the two contrasts.
    pub(super) noise: [f64; 2],
    /// Height of the camera above the bed, m.
    pub(super) height_m: f64,
    /// Standard deviation of the cells' brightness that noise does not explain: the bed's own unevenness as it
    /// arrives; and the standard deviation of that noise in a cell.
    pub(super) texture: [f64; 2],
}

impl Patch {
    /// Lays a picture on the ground in cells of `cell_m`.
    ///
    /// # Errors
    /// Why the picture says nothing.
    pub(super) fn project(picture: &Picture, stand: &Stand, cell_m: f64) -> Result<Self, Useless> {
        let c = contrasts(&picture.image, picture.view_rad)?;
        let from_B = stand.R_WB * picture.p_BC;
        let height_m = stand.altitude_m + from_B.z;
        let R_WC = stand.R_WB * picture.R_BC;
        if height_m.is_nan() || height_m <= LOWEST_M {
            return Err(Useless::Empty);
        }
        let foot = stand.position + from_B.xy();
        let focal = 0.5 * f64::from(c.width) / math::tan(0.5 * picture.view_rad);
        let mut cells = Cells::default();
        for (k, bright) in c.bright.iter().enumerate() {
            let (column, row) = (k as u32 % c.width, k as u32 / c.width);
            let x = f64::from(column) + 0.5 - 0.5 * f64::from(c.width);
            let y = f64::from(row) + 0.5 - 0.5 * f64::from(c.height);
            let dir_C = Vector3::new(x, y, focal).normalize();
            let dir = R_WC * dir_C;
            if -dir.z < FLATTEST || !bright.is_finite() {
                continue;
            }
            let way_m = height_m / -dir.z;
            let place = foot + dir.xy() * way_m;
            let at = [place.x, place.y].map(|v| (v / cell_m).floor() as i32);
            cells.add(at, way_m, [f64::from(*bright), f64::from(c.red[k])]);
        }
        let cells = cells.done();
        if cells.is_empty() {
            return Err(Useless::Empty);
        }
        Ok(Self { texture: texture(&cells, &c), noise: c.noise, height_m, cells })
    }
}

/// Spread of the cells' brightness, without that of the noise, and the noise of a cell.
fn texture(cells: &[GroundCell], c: &Contrasts) -> [f64; 2] {
    let full = 0.5 * middle(cells.iter().map(|s| s.pixels));
    let whole: Vec<&GroundCell> = cells.iter().filter(|s| s.pixels >= full).collect();
    let level = middle(whole.iter().map(|s| s.mean[0]));
    let spread = 1.4826 * middle(whole.iter().map(|s| (s.mean[0] - level).abs()));
    let pixels = middle(whole.iter().map(|s| s.pixels)).max(1.0);
    let noise = c.noise[0] / pixels.sqrt();
    [(spread * spread - noise * noise).max(0.0).sqrt(), noise]
}

/// Sums by cell.
#[derive(Default)]
struct Cells(std::collections::BTreeMap<[i32; 2], (f64, f64, [f64; 2])>);

impl Cells {
    fn add(&mut self, [east, north]: [i32; 2], way_m: f64, contrast: [f64; 2]) {
        let sums = self.0.entry([north, east]).or_default();
        sums.0 += 1.0;
        sums.1 += way_m;
        for (sum, contrast) in sums.2.iter_mut().zip(contrast) {
            *sum += contrast;
        }
    }

    fn done(self) -> Vec<GroundCell> {
        (self.0.into_iter())
            .map(|([north, east], (n, way, sums))| GroundCell {
                at: [east, north],
                pixels: n,
                mean: sums.map(|s| s / n),
                way_m: way / n,
            })
            .collect()
    }
}
