//! Warns of steps of the plume that are too long for the mixing of the water.

use crate::scenario::fault::UnplacedFault;
use crate::scenario::schema::{Scenario, TimeSpec};
use plumes::filaments::{EVEN, SharpestMixing, Uneven};
use plumes::flow::{Water, WaterSpec};
use std::cell::RefCell;
use world::area::Area;
use world::clock::Every;
use world::terrain::Terrain;

/// What the answer follows from.
#[derive(PartialEq)]
struct StepInputs {
    water: WaterSpec,
    time: TimeSpec,
    area: Area,
    terrain: Terrain,
}

thread_local! {
    /// The latest answer. The arms of a campaign differ in their searchers and have the same water and steps; to work it
    /// out takes a twentieth of a lane at Duck.
    static LATEST: RefCell<Option<(StepInputs, Vec<UnplacedFault>)>> = const { RefCell::new(None) };
}

/// Finds steps so long that evenly mixed dye would gather in the layers and thin out at the interfaces. The water is
/// checked before.
pub(super) fn steps(
    scenario: &Scenario,
    water: &Water,
    area: &Area,
    terrain: &Terrain,
    found: &mut Vec<UnplacedFault>,
) {
    if scenario.sources.is_empty() {
        return;
    }
    let asked = StepInputs {
        water: scenario.water.clone(),
        time: scenario.time.clone(),
        area: *area,
        terrain: terrain.clone(),
    };
    LATEST.with_borrow_mut(|latest| {
        if latest.as_ref().is_none_or(|(of, _)| *of != asked) {
            *latest = Some((asked, worked_out(scenario, water, area, terrain)));
        }
        found.extend(latest.iter().flat_map(|(_, found)| found.clone()));
    });
}

fn worked_out(scenario: &Scenario, water: &Water, area: &Area, terrain: &Terrain) -> Vec<UnplacedFault> {
    let mut found = Vec::new();
    let t = &scenario.time;
    let (spin_up_s, limit_s, step_s) = (t.spin_up_s.get(), t.limit_s.get(), t.step_s.get());
    let shape = scenario.water.grid_shape(area, terrain.deepest_m());
    let sharpest = SharpestMixing::sharpest(water, area, terrain, &shape, spin_up_s + limit_s);
    let drift_s = Every::period(t.drift_period_s.get(), step_s).period_s(step_s);
    for (field, dt_s, lasts_s) in
        [("drift_period_s", drift_s, limit_s), ("spin_up_period_s", t.spin_up_period_s.get().min(spin_up_s), spin_up_s)]
    {
        if sharpest.surely_even(dt_s) {
            continue;
        }
        let Some(uneven) = sharpest.uneven(dt_s, lasts_s).filter(|u| u.part > EVEN) else {
            continue;
        };
        // A whole number of physics steps, as the mission takes them.
        let whole = |s: f64| (s / step_s).floor() * step_s;
        let longest_s = sharpest.longest_step_s(dt_s, lasts_s).map(whole);
        let longest_s = longest_s.filter(|s| *s > 0.0).map(below);
        found.push(findings(field, dt_s, step_s, lasts_s, &uneven, longest_s));
    }
    found
}

/// A positive number rounded down to two digits.
fn below(s: f64) -> f64 {
    let mut scale = 1.0;
    while s * scale < 10.0 {
        scale *= 10.0;
    }
    while s * scale >= 100.0 {
        scale /= 10.0;
    }
    // A little more, so that a number just below a digit by rounding keeps that digit.
    (s * scale + 1e-6).floor() / scale
}

fn findings(
    field: &str,
    dt_s: f64,
    step_s: f64,
    lasts_s: f64,
    uneven: &Uneven,
    longest_s: Option<f64>,
) -> UnplacedFault {
    let percent = |part: f64| (100.0 * part - 1e-9).ceil();
    let cure = match longest_s {
        Some(s) => format!("at most {s} s keeps it within {} %", percent(EVEN)),
        None => format!("no step from time.step_s ({step_s} s) upwards keeps it within {} %", percent(EVEN)),
    };
    let problem = format!(
        "in steps of {dt_s} s dye that is mixed over the depth becomes up to {} % uneven in {lasts_s} s, because \
         vertical mixing changes sharply with height (worst at east {:.0} m, north {:.0} m); {cure}",
        percent(uneven.part),
        uneven.place.x,
        uneven.place.y,
    );
    let gentler = "make mixing change more gently, by a thicker interface or less mixing beside it";
    let hint = match longest_s {
        Some(s) => {
            format!("set time.{field} to {s} (the plume then takes {:.1} times as long), or {gentler}", dt_s / s)
        }
        None => gentler.to_string(),
    };
    UnplacedFault::warning(format!("time.{field}"), problem).hint(hint)
}

#[cfg(test)]
mod tests {
    use super::below;
    use crate::testing::{CHANNEL, NOTHING, told};

    /// What is said of the channel in two layers over a rough bed, K_z up to about 1e-2 m²/s, in these steps of the
    /// plume in spin-up and mission.
    fn said(thickness_m: f64, spin_up_s: f64, drift_s: f64) -> Vec<String> {
        let layers = format!(
            "[Layered(
                layers: [
                    (speed_m_s: 0.45, heading_deg: 90, density_kg_m3: 1023),
                    (speed_m_s: 0.35, heading_deg: 90, density_kg_m3: 1025),
                ],
                interfaces: [(depth_m: 2, thickness_m: {thickness_m})],
            )]"
        );
        let values = [
            ("water.currents", layers.as_str()),
            ("water.mixing", "(background_vertical_m2_s: 0.00001)"),
            ("time.spin_up_period_s", &spin_up_s.to_string()),
            ("time.drift_period_s", &drift_s.to_string()),
        ];
        told(CHANNEL, &values)
    }

    /// The longest step that a message allows, s.
    fn longest_s(message: &str) -> f64 {
        let number = message.split("at most ").nth(1).expect("it says how much");
        number.split(' ').next().and_then(|n| n.parse().ok()).expect("a number first")
    }

    #[test]
    fn long_steps_at_a_sharp_interface_are_warned_of() {
        let long = said(0.3, 5.0, 5.0);
        assert_eq!(long.len(), 2, "{long:?}");
        for (message, field) in long.iter().zip(["time.drift_period_s", "time.spin_up_period_s"]) {
            assert!(message.starts_with(&format!("{field}: in steps of 5 s dye")), "{message}");
            assert!(longest_s(message) < 2.0, "{message}");
        }
        // What it says is enough.
        assert_eq!(said(0.3, longest_s(&long[1]), 0.02), NOTHING);
        // A gentle one may be stepped over as it always was.
        assert_eq!(said(2.0, 1.0, 0.5), NOTHING);
    }

    #[test]
    fn two_digits_and_never_above() {
        for (s, said) in [(0.678, 0.67), (4.99, 4.9), (12.9, 12.0), (0.0345, 0.034), (0.5, 0.5)] {
            assert!((below(s) - said).abs() < 1e-12, "{s}: {}", below(s));
        }
    }
}
