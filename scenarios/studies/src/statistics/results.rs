//! Turns the collected samples into figures.
//!
//! *Source*: given with each figure.
//!
//! *Parameters*: none.
//!
//! *Deviations*: "almost all" gaps is read as 95 %. Our gaps are longer than published ones for two reasons that follow
//! from the model: structure below the filaments' size (8 mm in the flume, 0.2 s as it passes) is smoothed, and with it
//! the short gaps that sheets and holes of that size make; what remains are gaps of the meander, when the whole plume
//! is elsewhere.

use super::expected::ChannelFigures;
use super::figure::PlumeFigure;
use super::gamma;
use super::measure::{PROFILE, Watch};
use plumes::filaments::Plume;
use plumes::flow::channel::Channel;

/// Gaps shorter than this count as short, s.
const SHORT_S: f64 = 0.5;

fn figure(name: String, unit: &'static str, ours: f64, expected: Option<f64>, source: &'static str) -> PlumeFigure {
    PlumeFigure { name, unit, ours, expected, source }
}

impl Watch {
    pub(super) fn widths(&self, expected: Option<&ChannelFigures>, to: &mut Vec<PlumeFigure>) {
        let mut variances = Vec::new();
        for (sums, x) in self.slices.iter().zip(&self.distances) {
            let mean = sums[1] / sums[0];
            let variance = (sums[2] / sums[0] - mean * mean).max(0.0);
            variances.push(variance);
            to.push(figure(
                format!("width sigma_y at {x:.2} m"),
                "m",
                variance.sqrt(),
                expected.map(|e| e.sigma_y(*x)),
                if expected.is_some() {
                    "sqrt(2 K_y x / U), K_y = 0.15 H u*: Fischer et al. 1979, section 5.1"
                } else {
                    "of the mass in a slice across the stream, all heights"
                },
            ));
        }
        let n = variances.len();
        if let (Some(e), true) = (expected, n > 2) {
            let per_m = (variances[n - 1] - variances[1]) / (self.distances[n - 1] - self.distances[1]);
            to.push(figure(
                format!("K_y by the growth from {:.2} to {:.2} m", self.distances[1], self.distances[n - 1]),
                "m2/s",
                0.5 * per_m * e.mean_m_s(),
                Some(e.k_y),
                "0.15 H u*: Fischer et al. 1979, section 5.1",
            ));
        }
    }

    pub(super) fn centreline(
        &self,
        expected: Option<&ChannelFigures>,
        volume_m3_s: Option<f64>,
        plume: &Plume,
        to: &mut Vec<PlumeFigure>,
    ) {
        let source = &plume.sources()[0];
        let kg_s = source.filament_kg * source.release.rate_hz.get();
        for (records, x) in self.odour.iter().zip(&self.distances) {
            let mean = records[0].mean();
            match volume_m3_s {
                Some(volume) => to.push(figure(
                    format!("centreline C/C0 at {x:.2} m"),
                    "",
                    mean * volume / kg_s,
                    expected.map(|e| e.centreline(*x, volume)),
                    "Q/(4 pi x sqrt(K_y K_z)): Csanady 1973; up to twice that by reflection at the bed",
                )),
                None => to.push(figure(
                    format!("mean concentration at {x:.2} m"),
                    "kg/m3",
                    mean,
                    None,
                    "at the source's height, down-stream of it",
                )),
            }
        }
    }

    pub(super) fn spikes(&self, threshold: f64, to: &mut Vec<PlumeFigure>) {
        let felt = "share of the time above 1 % of the nearest centreline mean; falls with distance and height";
        for (records, x) in self.odour.iter().zip(&self.distances) {
            for (record, height) in records.iter().zip(&self.heights) {
                let name = format!("intermittency at {x:.2} m, {height:.3} m above the bed");
                to.push(figure(name, "", record.above(threshold), None, felt));
            }
        }
        for (records, x) in self.odour.iter().zip(&self.distances) {
            let low = &records[1];
            let gaps = low.gaps(threshold);
            if !gaps.is_empty() {
                let short = gaps.iter().filter(|g| **g < SHORT_S).count();
                to.push(figure(
                    format!("gaps below 0.5 s at {x:.2} m, {:.3} m above the bed", self.heights[1]),
                    "",
                    short as f64 / gaps.len() as f64,
                    Some(0.95),
                    "almost all: Reidenbach & Koehl 2011, J. Exp. Biol. 214, 3138",
                ));
                let mut gaps = gaps;
                gaps.sort_unstable_by(f64::total_cmp);
                to.push(figure(
                    format!("median gap at {x:.2} m, {:.3} m above the bed", self.heights[1]),
                    "s",
                    gaps[gaps.len() / 2],
                    None,
                    "of the same gaps",
                ));
            }
        }
        for (records, x) in self.odour.iter().zip(&self.distances) {
            let mut felt = records[0].felt(threshold);
            if let Some((shape, distance)) = gamma::fit(&mut felt) {
                to.push(figure(
                    format!("rms/mean while felt, centreline at {x:.2} m"),
                    "",
                    1.0 / shape.sqrt(),
                    Some(1.0),
                    "exponential: Villermaux & Duplat 2003, Phys. Rev. Lett. 91, 184501",
                ));
                to.push(figure(
                    format!("gamma shape k while felt, centreline at {x:.2} m"),
                    "",
                    shape,
                    Some(1.0),
                    "exponential: Villermaux & Duplat 2003",
                ));
                to.push(figure(
                    format!("distance from that gamma law (KS), centreline at {x:.2} m"),
                    "",
                    distance,
                    None,
                    "0 would be a gamma law",
                ));
            }
        }
        for (records, x) in self.odour.iter().zip(&self.distances) {
            if let Some(time) = records[0].integral_time_s() {
                to.push(figure(
                    format!("integral time of the concentration, centreline at {x:.2} m"),
                    "s",
                    time,
                    None,
                    "autocorrelation summed to its first zero",
                ));
            }
        }
    }

    pub(super) fn water(&self, channel: &Channel, to: &mut Vec<PlumeFigure>) {
        to.push(figure(
            "friction velocity".to_owned(),
            "m/s",
            channel.u_star_m_s,
            None,
            "from mean speed, depth and bed; 2.8 mm/s (about 3 published) for 5 cm/s in 20 cm over a smooth bed",
        ));
        if let Some(time) = self.speed.integral_time_s() {
            let height = self.source.z - self.bed_z;
            to.push(figure(
                "integral time of the speed at the source's height".to_owned(),
                "s",
                time,
                Some(ChannelFigures::passing_s(channel, height)),
                "macro-scale H (z/H)^0.5 passing: Nezu & Nakagawa 1993",
            ));
        }
        for (sums, part) in self.profile.iter().zip(PROFILE) {
            let height = part * channel.depth_m;
            to.push(figure(
                format!("mean speed at z/H = {part}"),
                "m/s",
                sums[1] / sums[0],
                Some(channel.speed(height)),
                "the profile asked for: log law",
            ));
            let want = channel.intensities(height);
            for (c, name) in ["u'", "v'", "w'"].into_iter().enumerate() {
                let ours = (sums[2 + c] / sums[0]).sqrt();
                if ours > 0.0 {
                    to.push(figure(
                        format!("resolved {name} at z/H = {part}"),
                        "m/s",
                        ours,
                        Some(want[c]),
                        "all scales: Nezu & Nakagawa 1993",
                    ));
                }
            }
        }
    }
}
