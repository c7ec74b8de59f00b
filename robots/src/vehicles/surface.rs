//! How much of a hull is under water near the surface.
//!
//! *Source:* hydrostatics of a prolate spheroid cut into slices, each wet in proportion to how much of its diameter
//! is below z = 0.
//!
//! *Parameters:* length and diameter of the hull.
//!
//! *Deviations:* the wetted share of a round slice is taken as linear in its draught (an error of at most 6 % of the
//! slice); no waves at the surface.

/// Slices along the hull.
const SLICES: usize = 10;

/// Share of the volume under water, and its middle along the hull (m), for a hull whose centre is at height `z_m` and
/// whose nose points up with sine `climb`.
pub(super) fn wet(length_m: f64, diameter_m: f64, z_m: f64, climb: f64) -> (f64, f64) {
    let half = length_m / 2.0;
    if z_m + half * climb.abs() + diameter_m / 2.0 <= 0.0 {
        return (1.0, 0.0);
    }
    let (mut all, mut wet, mut at) = (0.0, 0.0, 0.0);
    for i in 0..SLICES {
        let s = (i as f64 + 0.5) / SLICES as f64 * 2.0 - 1.0;
        let volume = 1.0 - s * s;
        let radius = diameter_m / 2.0 * volume.sqrt();
        let z = z_m + s * half * climb;
        let share = ((radius - z) / (2.0 * radius)).clamp(0.0, 1.0);
        all += volume;
        wet += volume * share;
        at += volume * share * s * half;
    }
    let middle = if wet > 0.0 { at / wet } else { 0.0 };
    (wet / all, middle)
}

#[cfg(test)]
mod tests {
    use super::wet;

    #[test]
    fn deep_is_wet_and_high_is_dry() {
        assert_eq!(wet(1.6, 0.19, -1.0, 1.0), (1.0, 0.0));
        assert_eq!(wet(1.6, 0.19, 0.2, 0.0), (0.0, 0.0));
        let (half, middle) = wet(1.6, 0.19, 0.0, 0.0);
        assert!((half - 0.5).abs() < 1e-12 && middle.abs() < 1e-12);
    }

    #[test]
    fn the_high_end_dries_first() {
        let (share, middle) = wet(1.6, 0.19, 0.0, 0.5);
        assert!(middle < -0.1 && share > 0.4 && share < 0.6);
    }
}
