//! Warns of chemical sensors whose noise alone crosses the threshold of detection.

use crate::scenario::fault::UnplacedFault;
use crate::scenario::gantry::GantryBlock;
use crate::scenario::schema::RobotSpec;
use robots::sense::{FluorometerSpec, FluorometersAsideSpec};
use robots::track::{CrabSpec, SurgeCastSpec, ThresholdSpec};

/// Noise of a normal distribution rises above this many of its standard deviations once in 740 readings: at 10 Hz, about
/// once a minute.
const SIGMAS: f64 = 3.0;

/// A robot's fluorometers.
pub(super) fn fluorometer(i: usize, robot: &RobotSpec, found: &mut Vec<UnplacedFault>) {
    let own = robot.sensors.get::<FluorometerSpec>().map(|spec| ("fluorometer", spec));
    let aside = robot.sensors.get::<FluorometersAsideSpec>().map(|pair| ("fluorometers_aside.each", &pair.each));
    for (field, spec) in own.into_iter().chain(aside) {
        let above_v = spec.threshold.get() * spec.full_scale_v.get();
        let path = format!("robots[{i}].sensors.{field}.noise_v");
        loud(path, spec.noise_v.get(), above_v, found);
    }
}

/// A gantry's probes, against the least threshold of its searcher.
pub(super) fn probes(i: usize, block: &GantryBlock, found: &mut Vec<UnplacedFault>) {
    let crab = block.tracker.get::<CrabSpec>().map(|crab| &crab.threshold);
    let surges = || block.tracker.get::<SurgeCastSpec>().map(|spec| &spec.threshold);
    if let Some(threshold) = crab.or_else(surges) {
        let least_v = match threshold {
            ThresholdSpec::HalfMean(rule) => rule.floor_v.get(),
            ThresholdSpec::Level(rule) => rule.level_v.get(),
        };
        let above_v = least_v - block.probes.range_v[0].get();
        let path = format!("gantries[{i}].probes.noise_v");
        loud(path, block.probes.noise_v.get(), above_v, found);
    }
}

/// Noise against a threshold that lies so far above the output in clean water.
fn loud(path: String, noise_v: f64, above_v: f64, found: &mut Vec<UnplacedFault>) {
    if noise_v > 0.0 && above_v < SIGMAS * noise_v {
        let problem = format!(
            "noise of {noise_v} V is more than a third of what the threshold lies above clean water, {above_v:.4} V: it \
             detects where nothing is"
        );
        found.push(UnplacedFault::warning(path, problem).hint("lower the noise, or raise the threshold"));
    }
}

#[cfg(test)]
mod tests {
    use crate::testing::{CHANNEL, NOTHING, told, told_once};

    #[test]
    fn noise_that_crosses_the_threshold_is_told() {
        let fluorometer = "robots[0].sensors.fluorometer";
        // Four per cent of 5 V are 0.2 V.
        for (loud, noise_v, above_v) in [
            ("(noise_v: 0.3)", "0.3", "0.2000"),
            ("(noise_v: 0.07)", "0.07", "0.2000"),
            ("(threshold: 0.01)", "0.02", "0.0500"),
        ] {
            let said = told_once(CHANNEL, &[(fluorometer, loud)]);
            assert!(said.starts_with(&format!("{fluorometer}.noise_v: noise of {noise_v} V ")), "{said}");
            assert!(said.contains(&format!("above clean water, {above_v} V")), "{said}");
        }
        for fine in ["(noise_v: 0.06)", "(threshold: 0.01, noise_v: 0.01)", "(threshold: 0, noise_v: 0)"] {
            assert_eq!(told(CHANNEL, &[(fluorometer, fine)]), NOTHING);
        }
        let aside = told_once(CHANNEL, &[("robots[0].sensors.fluorometers_aside", "(each: (noise_v: 0.3))")]);
        assert!(aside.starts_with("robots[0].sensors.fluorometers_aside.each.noise_v: noise of 0.3 V "), "{aside}");
        let said = told("flume_crab_paper", &[("gantries[0].probes.noise_v", "0.01")]);
        assert!(said[0].starts_with("gantries[0].probes.noise_v: noise of 0.01 V"), "{said:?}");
    }
}
