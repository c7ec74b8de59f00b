//! Tests of the sidescan sonar.

use super::super::testing::{BED, at, bare, run, slope};
use super::*;
use crate::handoff::testing;
use world::obstacles::Obstacles;
use world::terrain::Terrain;

/// A block of a metre on the bed.
fn block(east_m: f64, north_m: f64, bed: &Terrain) -> Obstacles {
    Obstacles(vec![testing::block(bed, "block", [east_m, north_m], [1.0; 3])])
}

fn sonar(spec: SidescanSpec) -> Sidescan {
    Sidescan::new(&spec, Vector3::zeros(), &OnBoard::new("auv0", 1, 0.02)).unwrap()
}

/// Mean strength (dB above the floor) of each sample to starboard over `pings`, by intensities.
fn mean(truth: &Truth, solids: &Obstacles, bed: &Terrain, pings: u64) -> Vec<f64> {
    let mut s = sonar(SidescanSpec::default());
    let got = run(5 * pings, 0.02, |c| s.read(c, truth, &EchoTarget { terrain: bed, obstacles: solids }, true));
    assert_eq!(got.len() as u64, pings);
    let power = |k: usize| {
        let sum: f64 = got.iter().map(|p| from_db(f64::from(p.starboard_db[k]))).sum();
        10.0 / LN_10 * math::ln(sum / got.len() as f64)
    };
    (0..400).map(power).collect()
}

/// Two metres above a level bed.
fn low() -> Truth {
    at(0.0, 0.0, -6.0)
}

#[test]
fn a_level_bed_follows_lambert_behind_the_water_column() {
    let got = mean(&low(), &Obstacles::default(), &BED, 400);
    let db = |x: f64| 10.0 / LN_10 * math::ln(x);
    // The mean of 400 exponentials is within 5 / sqrt(400) of its own, in dB about 1.
    for (k, got) in got.into_iter().enumerate() {
        let r = (k as f64 + 0.5) * 0.05;
        let noise = db((r / 20.0) * (r / 20.0) * (r / 20.0)) + 2.0 * 0.17 * (r - 20.0);
        if r < 1.95 {
            assert!((got - noise).abs() < 1.2, "{r}: {} for {noise}", got);
        } else if r > 2.3 {
            let s = 2.0 / r;
            let c = (1.0 - s * s).sqrt();
            let off = (math::asin(s).to_degrees() - 20.0) / 25.0;
            let echo = 60.0 - 27.0 + db(s * s / c) - (6.0206 * off * off).min(40.0);
            let both = db(from_db(echo) + from_db(noise));
            assert!((got - both).abs() < 1.3, "{r}: {} for {both}", got);
        }
    }
}

#[test]
fn a_block_is_bright_and_throws_a_shadow_of_the_right_length() {
    // Heading north, starboard is east; the block's face is at 9.5 m, its top edge a metre up, half as high as the
    // sonar.
    let bare = mean(&low(), &Obstacles::default(), &BED, 100);
    let got = mean(&low(), &block(10.0, 0.0, &BED), &BED, 100);
    let slant = |ground: f64, up: f64| (ground * ground + (2.0 - up) * (2.0 - up)).sqrt();
    // The face's echo comes from between its top edge (which is nearer) and its foot.
    let sample = |r: f64| (r / 0.05) as usize;
    let face: Vec<_> = (sample(slant(9.5, 1.0)) + 1..sample(slant(9.5, 0.0))).collect();
    assert!(!face.is_empty());
    for k in face {
        assert!(got[k] > bare[k] + 15.0, "{k}: {} over {}", got[k], bare[k]);
    }
    // Behind the far top edge at 10.5 m the bed is hidden to twice that distance.
    for k in sample(slant(10.5, 1.0)) + 3..400 {
        assert!(got[k] < bare[k] - 8.0, "{k}: {} under {}", got[k], bare[k]);
    }
    // A nearer block has a shorter shadow: from 5.5 to 11 m, and the bed beyond is unchanged.
    let got = mean(&low(), &block(5.0, 0.0, &BED), &BED, 100);
    let dark = (sample(slant(5.5, 1.0)) + 2..400).filter(|k| got[*k] < bare[*k] - 6.0);
    let dark: Vec<_> = dark.collect();
    let end = *dark.last().unwrap() as f64 * 0.05;
    assert!((end - slant(11.0, 0.0)).abs() < 0.3, "{end}");
    assert!(dark.len() > 90, "{}", dark.len());
    // Ahead of the beam and to port it is not hit: the samples are the same, bit by bit.
    for away in [block(10.0, 3.0, &BED), block(-10.0, 0.0, &BED)] {
        assert_eq!(mean(&low(), &away, &BED, 100), bare);
    }
}

#[test]
fn speckle_is_rayleigh_in_amplitude() {
    let mut s = sonar(SidescanSpec::default());
    let t = low();
    let got = run(50_000, 0.02, |c| s.read(c, &t, &bare(&BED), true));
    let power: Vec<f64> = got.iter().map(|p| from_db(f64::from(p.port_db[200]))).collect();
    let n = power.len() as f64;
    let mean = power.iter().sum::<f64>() / n;
    // An exponential: a share e^-2 above twice its mean; five standard errors sqrt(p q / n).
    let above = power.iter().filter(|p| **p > 2.0 * mean).count() as f64 / n;
    let p = math::exp(-2.0);
    assert!((above - p).abs() < 5.0 * (p * (1.0 - p) / n).sqrt(), "{above} for {p}");
}

#[test]
fn on_a_slope_the_bottom_comes_back_from_where_it_is() {
    // Rising to the east by one in ten.
    let slope = slope(90.0, 8.0);
    let bare = mean(&low(), &Obstacles::default(), &slope, 400);
    let level = mean(&low(), &Obstacles::default(), &BED, 400);
    // At 15 m the ray meets the rising bed at a greater angle: sin of asin(1.99 / 15) against 2 / 15 is the same, but
    // seen below the horizontal it is 5.7 degrees higher up, in the upper half of the beam.
    let k = 300;
    let off = |deg: f64| 6.0206 * ((deg - 20.0) / 25.0) * ((deg - 20.0) / 25.0);
    let want = off(7.6) - off(7.6 - 5.7);
    assert!((bare[k] - level[k] - want).abs() < 1.5, "{} for {want}", bare[k] - level[k]);
    // No gaps and no peaks: neighbouring samples differ by no more than speckle and the law's own decrease.
    for k in 60..399 {
        assert!((bare[k] - bare[k + 1]).abs() < 2.5, "{k}");
    }
}

#[test]
fn off_a_survey_it_is_silent_unless_told() {
    let t = low();
    let read = |always: bool, surveying: bool| {
        let mut s = sonar(SidescanSpec { always, ..Default::default() });
        s.read(&Clock::new(0.02), &t, &bare(&BED), surveying).is_some()
    };
    assert_eq!([read(false, false), read(false, true), read(true, false)], [false, true, true]);
}
