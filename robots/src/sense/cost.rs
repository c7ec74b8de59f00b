//! What instruments will hold and do; the unit costs are measured as `world::cost` says.

use super::suite::SensorsSpec;
use world::cost::{Cost, Part, Times};

/// Time of a beam, of an obstacle on its way and of a metre that the bed is looked for, s.
const BEAM_S: [f64; 3] = [0.5e-6, 0.15e-6, 30e-9];
/// Time of a sample of the sidescan, and of an obstacle on its way, s.
const SAMPLE_S: [f64; 2] = [0.2e-6, 0.1e-6];
/// Time of a picture's pixel, and memory while it is made and judged, bytes.
const PIXEL: (f64, f64) = (0.5e-6, 200.0);
/// Share of a mission in which a vehicle surveys or looks with its camera, of one that does so at all.
const SURVEYS: f64 = 0.05;
/// Shares of a picture of a pass that are kept: of each sonar at most so many lines, see `survey::waterfall`.
const PASSES_BYTES: f64 = 5e6;

impl SensorsSpec {
    /// What they take among so many obstacles; paths below `sensors`. `looks`: whether the strategy asks for sidescan or pictures.
    #[must_use]
    pub fn cost(&self, obstacles: usize, looks: bool, times: &Times) -> Cost {
        let mut cost = Cost::default();
        let obstacles = obstacles as f64;
        let share = |always: bool| match (always, looks) {
            (true, _) => 1.0,
            (false, true) => SURVEYS,
            (false, false) => 0.0,
        };
        if let Some(r) = &self.ranging {
            let beams = f64::from(r.beams) * f64::from(r.rows);
            let each_s = BEAM_S[0] + obstacles * BEAM_S[1] + r.max_range_m.get() * BEAM_S[2];
            let what = format!("{:.0} beams a second", beams * r.rate_hz.get());
            let part = Part::new("ranging.rate_hz", what)
                .takes(times.mission_s * r.rate_hz.get() * beams * each_s)
                .by(r.rate_hz.get(), 1.0);
            cost.parts.push(part);
        }
        if let Some(s) = &self.sidescan {
            let samples = 2.0 * f64::from(s.samples) * s.rate_hz.get();
            let each_s = SAMPLE_S[0] + obstacles * SAMPLE_S[1];
            let part = Part::new("sidescan.rate_hz", format!("{samples:.0} samples a second"))
                .holds(PASSES_BYTES)
                .takes(times.mission_s * share(s.always) * samples * each_s)
                .by(s.rate_hz.get(), 1.0);
            cost.parts.push(part);
        }
        if let Some(c) = &self.camera {
            let pixels = f64::from(c.width) * f64::from(c.height);
            let pictures = times.mission_s * share(false) * c.rate_hz.get().min(1.0);
            let what = format!("about {pictures:.0} pictures of {pixels:.1e} pixels");
            let part = Part::new("camera.width", what)
                .holds(pixels * PIXEL.1)
                .takes(pictures * pixels * PIXEL.0)
                .by(f64::from(c.width), 1.0);
            cost.parts.push(part);
        }
        cost
    }
}
