//! The plume over a run, for the animation: a bounded number of moments, each with a bounded number of filaments.

use super::thinning::Thinning;
use rheotaxis::frame::PlumeFrame;

/// One filament of one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wisp {
    /// Its place (ENU), m.
    pub p: [f64; 3],
    /// Its size, m.
    pub size_m: f64,
    /// Concentration at its middle, kg/m³.
    pub dense_kg_m3: f64,
}

/// The plume at some moments, evenly thinned if the run is long.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlumeFilm {
    /// Times (s) and filaments, in order of time.
    pub moments: Vec<(f64, Vec<Wisp>)>,
    thinning: Thinning,
}

/// Most moments kept.
const MOMENTS: usize = 72;
/// Most filaments kept of a moment.
const WISPS: usize = 800;

impl PlumeFilm {
    /// Adds a moment.
    pub fn push(&mut self, plume: &PlumeFrame) {
        self.thinning.push(&mut self.moments, MOMENTS, || {
            let every = plume.points.len().div_ceil(WISPS).max(1);
            let wisps = plume.points.iter().step_by(every).filter_map(wisp);
            (plume.t_s, wisps.collect())
        });
    }
}

/// `None` for a filament with a number that is not finite, or without size.
fn wisp(&[x, y, z, size_m, mass, n]: &[f64; 6]) -> Option<Wisp> {
    // A Gaussian of standard deviation `size` holds mass / n; its middle has that over (2 pi)^1.5 size^3.
    let dense_kg_m3 = mass / n.max(1e-9) / (15.75 * size_m.powi(3));
    let sound = [x, y, z, size_m, dense_kg_m3].iter().all(|v| v.is_finite());
    (sound && size_m > 0.0 && dense_kg_m3 > 0.0).then_some(Wisp { p: [x, y, z], size_m, dense_kg_m3 })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(k: u16, n: usize) -> PlumeFrame {
        PlumeFrame {
            t_s: f64::from(k) * 10.0,
            total: n,
            points: vec![[1.0, 2.0, -3.0, 0.5, 1e-6, 2.0]; n],
            ..PlumeFrame::default()
        }
    }

    #[test]
    fn a_long_run_is_thinned_evenly_and_stays_bounded() {
        let mut film = PlumeFilm::default();
        for k in 0..1000 {
            film.push(&frame(k, 2000));
        }
        let n = film.moments.len();
        assert!((MOMENTS / 2..=MOMENTS).contains(&n), "{n}");
        assert!(film.moments.iter().all(|m| m.1.len() <= WISPS));
        let gaps: Vec<f64> = film.moments.windows(2).map(|w| w[1].0 - w[0].0).collect();
        assert!(gaps.iter().all(|g| *g == gaps[0]), "{gaps:?}");
    }

    #[test]
    fn what_is_not_a_number_is_left_out() {
        let mut one = frame(0, 3);
        one.points[0][0] = f64::NAN;
        one.points[1][3] = 0.0;
        let mut film = PlumeFilm::default();
        film.push(&one);
        assert_eq!(film.moments[0].1.len(), 1);
        let dense = film.moments[0].1[0].dense_kg_m3;
        assert!((dense / (0.5e-6 / (15.75 * 0.125)) - 1.0).abs() < 1e-5);
    }
}
