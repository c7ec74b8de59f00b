//! The picture that a pass of a sidescan makes: lines of pings by ground range, each with its believed place.
//!
//! *Source:* slant-range correction on a flat bottom, g = √(r² − h²), and angle-varying gain: Blondel 2009, The
//! Handbook of Sidescan Sonar, section 4.2.
//!
//! *Parameters:* size of a cell along and across the track, [`CELL_M`] 0.25 m: a metre-sized object fills 4 by 4
//! cells, and a cell 10 m away holds five samples of each of its pings.
//!
//! *Deviations:* the height above the bed is the altimeter's, not that of the first return. The gain is Lambert's law
//! for a level bed. What it does not correct (the beam's pattern, a slope) depends on the cell's distance, and
//! [`super::detect`] removes it. A line's place is the believed place at its end.

use nalgebra::Vector2;
use robots::handoff::{Estimate, SidescanPing};
use std::f64::consts::{FRAC_PI_2, LN_10};
use world::math;
use world::units::Heading;

/// Size of a cell, m.
pub const CELL_M: f64 = 0.25;
/// Most lines of a picture; a pass of 500 m at a cell of 0.25 m has 2000.
const MOST: usize = 20_000;
/// Most numbers of a picture: those many lines at a range of 25 m.
const MOST_NUMBERS: usize = 4_000_000;
/// A line is full when the vehicle has moved by this part of a cell: pings some 0.2 m apart make one line each.
const FULL: f64 = 0.75;
/// Half-width of the strip left out below the vehicle, in heights above the bed.
const BLIND: f64 = 0.3;

/// A line of the picture: both sides by ground range, nearest first.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Time, s.
    pub t_s: f64,
    /// Distance along the track, m.
    pub along_m: f64,
    /// Believed place of the sonar (east, north), m.
    pub place: Vector2<f64>,
    /// Believed heading.
    pub heading: Heading,
    /// Height of the sonar above the bed, m.
    pub height_m: f64,
    /// Believed height of the bed below it (negative: below the still surface), m.
    pub bed_z: f64,
    /// Port side, dB; not a number below the vehicle and beyond the range.
    pub port_db: Vec<f32>,
    /// To starboard.
    pub starboard_db: Vec<f32>,
}

impl Row {
    /// Believed place (east, north) of a ground range on a side, m.
    pub fn ground_position(&self, port: bool, ground_m: f64) -> Vector2<f64> {
        let turn = if port { -FRAC_PI_2 } else { FRAC_PI_2 };
        self.place + self.heading.turned(turn).unit() * ground_m
    }

    /// A side.
    pub fn side(&self, port: bool) -> &[f32] {
        if port { &self.port_db } else { &self.starboard_db }
    }
}

/// The picture of a pass.
#[derive(Clone, Debug, Default)]
pub struct Waterfall {
    rows: Vec<Row>,
    /// Distance covered, m, and when it was last added to, s.
    along_m: f64,
    last_s: Option<f64>,
    /// Sums of intensities and their number, by side and cell, since the last line.
    sums: [Vec<(f64, u32)>; 2],
    begun_m: f64,
}

impl Waterfall {
    /// Mean distance between two lines, m.
    pub fn line_m(&self) -> f64 {
        match self.rows.as_slice() {
            [first, .., last] => (last.along_m - first.along_m) / (self.rows.len() - 1) as f64,
            _ => CELL_M,
        }
    }

    /// Its lines.
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// Takes in a ping with the vehicle's estimate; ignores it without a height above the bed.
    pub fn push(&mut self, ping: &SidescanPing, estimate: &Estimate) {
        let Some(altitude_m) = estimate.altitude_m.filter(|a| *a > 0.0) else {
            return;
        };
        let a_line = 2 * (ping.max_m / CELL_M).floor() as usize;
        if self.rows.len() >= MOST || (self.rows.len() + 1).saturating_mul(a_line) > MOST_NUMBERS {
            return;
        }
        if let Some(last_s) = self.last_s.replace(estimate.t_s) {
            self.along_m += estimate.v_ground().norm() * (estimate.t_s - last_s);
        }
        let arm = estimate.attitude.R_WB() * ping.p_BS;
        let height_m = (altitude_m + arm.z).max(0.1);
        for (sums, samples) in (self.sums.iter_mut()).zip([&ping.port_db, &ping.starboard_db]) {
            let cells = (ping.max_m / CELL_M).floor() as usize;
            sums.resize(cells, (0.0, 0));
            for (k, sum) in sums.iter_mut().enumerate() {
                let slant = |ground: f64| (ground * ground + height_m * height_m).sqrt();
                let near = k as f64 * CELL_M;
                if near < BLIND * height_m || slant(near + CELL_M) > ping.max_m {
                    continue;
                }
                let per_m = samples.len() as f64 / ping.max_m;
                let from = (slant(near) * per_m).round() as usize;
                let to = (slant(near + CELL_M) * per_m).round() as usize;
                let to = to.max(from + 1).min(samples.len());
                for level in &samples[from.min(to - 1)..to] {
                    sum.0 += math::exp(f64::from(*level) / 10.0 * LN_10);
                    sum.1 += 1;
                }
            }
        }
        if self.along_m - self.begun_m >= FULL * CELL_M {
            self.begun_m = self.along_m;
            let place = estimate.position + arm.xy();
            let mut level = |side: usize| -> Vec<f32> {
                let sums = std::mem::take(&mut self.sums[side]);
                let cell = |(k, (sum, n)): (usize, &(f64, u32))| {
                    if *n == 0 {
                        return f32::NAN;
                    }
                    let db = |x: f64| 10.0 / LN_10 * math::ln(x);
                    let ground = (k as f64 + 0.5) * CELL_M;
                    let slant_2 = ground * ground + height_m * height_m;
                    // sin² γ / cos γ of a level bed.
                    let lambert = height_m * height_m / (slant_2.sqrt() * ground);
                    (db(sum / f64::from(*n)) - db(lambert)) as f32
                };
                sums.iter().enumerate().map(cell).collect()
            };
            let (port_db, starboard_db) = (level(0), level(1));
            self.rows.push(Row {
                t_s: estimate.t_s,
                along_m: self.along_m,
                place,
                heading: estimate.attitude.heading,
                height_m,
                bed_z: arm.z - estimate.depth_m - height_m,
                port_db,
                starboard_db,
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{Bed, fly};
    use super::*;

    #[test]
    fn lines_lie_a_cell_apart_and_the_bed_is_even() {
        let w = fly(&Bed::bare(1), 40.0);
        let rows = w.rows();
        // One ping every 0.2 m makes a line.
        assert!((rows.len() as f64 - 200.0).abs() < 2.0, "{}", rows.len());
        assert!((w.line_m() - 0.2).abs() < 1e-9);
        for pair in rows.windows(2) {
            assert!((pair[1].along_m - pair[0].along_m - 0.2).abs() < 1e-9);
            assert!((pair[1].place - pair[0].place).norm() - 0.2 < 1e-6);
        }
        // After removing Lambert's fall, near and far are alike: mean of 200 lines of five looks each.
        let mean = |k: usize| rows.iter().map(|r| f64::from(r.starboard_db[k])).sum::<f64>() / rows.len() as f64;
        assert!((mean(12) - mean(60)).abs() < 0.8, "{} {}", mean(12), mean(60));
        assert!(rows[0].port_db[0].is_nan() && rows[0].port_db[79].is_nan());
    }

    #[test]
    fn a_place_is_to_the_side_it_was_heard_on() {
        let w = fly(&Bed::bare(1), 5.0);
        let row = &w.rows()[3];
        // Heading north.
        let (port, starboard) =
            (row.ground_position(true, 7.0) - row.place, row.ground_position(false, 7.0) - row.place);
        assert!((port - Vector2::new(-7.0, 0.0)).norm() < 1e-9);
        assert!((starboard - Vector2::new(7.0, 0.0)).norm() < 1e-9);
    }

    #[test]
    fn without_a_height_there_is_no_picture() {
        let mut w = Waterfall::default();
        let mut o = crate::testing::seen(0.0, Vector2::zeros(), 0.0, None);
        o.estimate.altitude_m = None;
        let levels: std::sync::Arc<[f32]> = vec![0.0; 10].into();
        let ping = SidescanPing {
            p_BS: nalgebra::Vector3::zeros(),
            max_m: 20.0,
            port_db: levels.clone(),
            starboard_db: levels,
        };
        for k in 0..100 {
            o.estimate.t_s = f64::from(k);
            w.push(&ping, &o.estimate);
        }
        assert!(w.rows().is_empty());
    }
}
