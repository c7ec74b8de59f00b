//! Tells of currents that change over less than the plume's grid and its renewals can show.

use crate::scenario::fault::UnplacedFault;
use crate::scenario::schema::Scenario;
use plumes::flow::GridShape;
use std::f64::consts::LN_10;
use world::area::Area;
use world::limits::shown;
use world::math;
use world::terrain::Terrain;

/// A number to two digits, rounded as told.
fn digits(v: f64, round: impl Fn(f64) -> f64) -> String {
    let scale = 10_f64.powi(1 - (math::ln(v) / LN_10).floor() as i32);
    shown(round(v * scale) / scale)
}

fn about(v: f64) -> String {
    digits(v, f64::round)
}

/// Finds internal waves and interfaces that are finer than the grid on which the plume sees the water, or faster than
/// it is renewed. The hull is in the exact water, so there dye and hull would move apart.
pub(super) fn resolved(scenario: &Scenario, area: &Area, terrain: &Terrain, found: &mut Vec<UnplacedFault>) {
    if scenario.sources.is_empty() {
        return;
    }
    let depth_m = terrain.deepest_m();
    let shape = scenario.water.grid_shape(area, depth_m);
    let by_blockage = scenario.water.blockage.is_some();
    let flow_s = scenario.time.flow_period_s.get();
    for (i, current) in scenario.water.currents.iter().enumerate() {
        let path = format!("water.currents[{i}]");
        let scales = current.scales();
        let least_m = GridShape::CELLS_OF_WAVE * shape.cell_m;
        if scales.shortest_m < 0.999 * least_m {
            let cure = if by_blockage {
                format!(
                    "set water.blockage.cell_m to {} m",
                    digits(scales.shortest_m / GridShape::CELLS_OF_WAVE, f64::floor)
                )
            } else {
                "make the area smaller, or leave out waves that are short beside it".to_string()
            };
            let problem = format!(
                "its shortest internal wave, {} m, has less than {} cells of the plume's grid, {} m: it moves dye less \
                 than a hull; {cure}",
                about(scales.shortest_m),
                GridShape::CELLS_OF_WAVE,
                about(shape.cell_m),
            );
            found.push(UnplacedFault::warning(&path, problem));
        }
        let longest_s = scales.shortest_s / GridShape::CELLS_OF_WAVE;
        if flow_s > longest_s {
            let problem = format!(
                "the plume's water is renewed every {flow_s} s, less than {} times in the {} s of the shortest internal \
                 wave of {path}: dye lags behind; at most {} s shows it",
                GridShape::CELLS_OF_WAVE,
                about(scales.shortest_s),
                about(longest_s),
            );
            found.push(UnplacedFault::warning("time.flow_period_s", problem));
        }
        for (k, face) in scales.interfaces.iter().enumerate().filter(|(_, f)| f.depth_m < depth_m) {
            let gap_m = shape.spacing_m(depth_m - face.depth_m, depth_m);
            if gap_m > 1.001 * face.thickness_m {
                let problem = format!(
                    "is thinner than the plume's levels are apart there, {} m: within that distance dye moves with a \
                     mean of both layers' currents (what mixes through is right); {} m or more is shown as it is",
                    about(gap_m),
                    digits(gap_m, f64::ceil),
                );
                found.push(UnplacedFault::warning(format!("{path}.interfaces[{k}].thickness_m"), problem));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::testing::{CHANNEL, NOTHING, told as told_of};

    /// What is told of a channel 10 m deep with an interface of this depth, thickness and wave.
    fn told(thickness_m: f64, length_m: f64, period_s: f64) -> Vec<String> {
        let layered = format!(
            "[Layered(layers: [(speed_m_s: 0.2, heading_deg: 90, density_kg_m3: 1020), \
             (speed_m_s: 0.1, heading_deg: 90, density_kg_m3: 1025)], interfaces: [(depth_m: 4, \
             thickness_m: {thickness_m}, waves: [(amplitude_m: 0.2, length_m: {length_m}, period_s: {period_s}, \
             heading_deg: 90)])])]"
        );
        let mut said = told_of(CHANNEL, &[("water.currents", &layered)]);
        said.retain(|line| line.contains("plume's"));
        said
    }

    #[test]
    fn what_the_plume_cannot_show_is_told_with_a_cure() {
        assert_eq!(told(1.0, 60.0, 120.0), NOTHING);
        // The grid becomes finer by itself, as far as a computer bears it.
        assert_eq!(told(0.4, 25.0, 62.0), NOTHING);
        let [short, quick, thin] =
            [[1.0, 2.0, 62.0], [1.0, 60.0, 30.0], [0.05, 60.0, 120.0]].map(|[a, b, c]| told(a, b, c));
        for (said, begins, ends) in [
            (&short, "water.currents[0]: its shortest internal wave, 2 m", ""),
            (&quick, "time.flow_period_s: ", "at most 2.5 s shows it"),
            (&thin, "water.currents[0].interfaces[0].thickness_m: ", ""),
        ] {
            assert!(said.len() == 1 && said[0].starts_with(begins) && said[0].ends_with(ends), "{said:?}");
        }
        let cure: f64 = thin[0].rsplit("; ").next().unwrap().split(' ').next().unwrap().parse().unwrap();
        assert_eq!(told(cure, 60.0, 120.0), NOTHING);
    }
}
