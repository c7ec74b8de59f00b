//! Checks of obstacles: shapes that cannot be built, sizes and places that make no sense, and water without a way.

use super::path::{names, twins, within};
use crate::scenario::fault::UnplacedFault;
use crate::scenario::schema::Scenario;
use plumes::error::PlumeError;
use plumes::filaments::cut_off;
use std::path::Path;
use world::area::Area;
use world::error::WorldError;
use world::obstacles::{Obstacle, ObstacleSpec, Obstacles};
use world::terrain::Terrain;

/// Builds the obstacles and returns those that can be built. Errors and warnings are added to `found`.
pub(super) fn obstacles(
    scenario: &Scenario,
    area: &Area,
    terrain: &Terrain,
    base_dir: &Path,
    found: &mut Vec<UnplacedFault>,
) -> Obstacles {
    let specs = &scenario.obstacles;
    let ids: Vec<&str> = specs.iter().map(|o| o.id.as_str()).collect();
    names("obstacles", &ids, found);
    twins("obstacles", &ids, found);
    let mut built = Vec::new();
    for (i, spec) in specs.iter().enumerate() {
        let path = format!("obstacles[{i}]");
        if let Some(twin) = specs[..i].iter().position(|other| spec.is_copy_of(other)) {
            let problem = format!(
                "obstacle \"{}\" fills exactly the same space as obstacles[{twin}], \"{}\"",
                spec.id, specs[twin].id
            );
            found.push(UnplacedFault::error(&path, problem).hint("remove one of them, or move it"));
            continue;
        }
        match Obstacle::build(spec, terrain, base_dir) {
            Ok(obstacle) => {
                for r in obstacle.remarks(spec, area, terrain) {
                    let of = if r.wrong { UnplacedFault::error } else { UnplacedFault::warning };
                    let at = if r.wrong { format!("{path}.shape") } else { path.clone() };
                    found.push(of(at, r.problem).hint(r.hint));
                }
                built.push(obstacle);
            }
            Err(e @ WorldError::File { .. }) => {
                found.push(
                    UnplacedFault::error(format!("{path}.shape.file"), e.to_string())
                        .hint("paths are relative to the scenario file"),
                );
            }
            Err(WorldError::Invalid { field, problem }) => {
                found.push(UnplacedFault::error(within(&path, "shape", &field), problem));
            }
        }
    }
    let built = Obstacles(built);
    if !built.leave_water(area, terrain) {
        found.push(
            UnplacedFault::error("obstacles", "they fill the whole area: there is no open water in it")
                .hint("make them smaller, or the area larger"),
        );
    }
    built
}

/// Checks that a list of ids names obstacles of the scenario.
pub(super) fn known(list: &str, ids: &[String], obstacles: &[ObstacleSpec], found: &mut Vec<UnplacedFault>) {
    for (k, id) in ids.iter().enumerate() {
        if !obstacles.iter().any(|o| o.id == *id) {
            let known: Vec<&str> = obstacles.iter().map(|o| o.id.as_str()).collect();
            found.push(UnplacedFault::error(
                format!("{list}[{k}]"),
                format!("the scenario has no obstacle \"{id}\"; it has {known:?}"),
            ));
        }
    }
}

/// Checks that the water can flow round the obstacles and past the sources.
pub(super) fn blockage(
    scenario: &Scenario,
    area: &Area,
    terrain: &Terrain,
    obstacles: &Obstacles,
    found: &mut Vec<UnplacedFault>,
) {
    let Some(spec) = &scenario.water.blockage else {
        return;
    };
    match spec.unfelt(area, terrain, obstacles, scenario.water.is_walled()) {
        Ok(thin) => {
            let cell_m = spec.cell_m.get();
            let felt = (obstacles.0.iter().enumerate()).filter(|(n, _)| !thin.contains(n));
            for (_, o) in felt {
                // What is thin and long is a wall; a pile only becomes as thick as a cell.
                let [thick_m, long_m] = o.plan_m();
                if thick_m < cell_m && long_m > 2.0 * cell_m {
                    found.push(
                        UnplacedFault::warning(
                            "water.blockage.cell_m",
                            format!(
                                "obstacle \"{}\" is {thick_m:.2} m thick, less than a cell of {cell_m} m: water flows \
                                 through it where it lies between the centres of the cells",
                                o.id
                            ),
                        )
                        .hint("use cells no larger than it is thick, or make it thicker"),
                    );
                }
            }
            for o in thin.iter().filter_map(|n| obstacles.0.get(*n)) {
                found.push(
                    UnplacedFault::warning(
                        "water.blockage.cell_m",
                        format!(
                            "obstacle \"{}\" lies between the centres of the cells: the water does not feel it",
                            o.id
                        ),
                    )
                    .hint("use smaller cells"),
                );
            }
        }
        Err(PlumeError::Invalid { field, problem }) => {
            found.push(UnplacedFault::error(field, problem));
            return;
        }
    }
    let dry = cut_off(&scenario.sources, &scenario.water, area, terrain, obstacles);
    for PlumeError::Invalid { field, problem } in dry.into_iter().flatten() {
        found.push(UnplacedFault::error(field, problem));
    }
}

#[cfg(test)]
mod tests {
    use crate::testing::{CHANNEL, NOTHING, changed, told, told_once};

    const PILE: &str = "(id: \"pile\", shape: Cylinder(radius_m: 0.2, height_m: 9), east_m: 0, north_m: 0.3)";

    /// The channel with these obstacles, and a grid round them if cells have a size.
    fn values<'a>(obstacles: &'a str, cell_m: &'a str) -> Vec<(&'static str, &'a str)> {
        let blockage = (!cell_m.is_empty()).then_some(("water.blockage.cell_m", cell_m));
        std::iter::once(("obstacles", obstacles)).chain(blockage).collect()
    }

    fn said(obstacles: &str, cell_m: &str) -> Vec<String> {
        told(CHANNEL, &values(&format!("[{obstacles}]"), cell_m))
    }

    fn said_once(obstacles: &str, cell_m: &str) -> String {
        told_once(CHANNEL, &values(&format!("[{obstacles}]"), cell_m))
    }

    #[test]
    fn piles_under_a_quay_may_overlap_it_and_a_copy_is_refused() {
        let quay = "(id: \"quay\", shape: Box(size_m: (20, 20, 2)), east_m: 0, north_m: 0, base: Depth(3))";
        assert_eq!(said(&format!("{quay}, {PILE}"), ""), NOTHING);
        let copy = said_once(&format!("{PILE}, {}", PILE.replace("pile", "other")), "");
        assert!(copy.starts_with("obstacles[1]: ") && copy.ends_with("obstacles[0], \"pile\""), "{copy}");
    }

    #[test]
    fn what_is_thinner_than_a_cell_is_told() {
        let pile = said_once(PILE, "4");
        assert!(pile.starts_with("water.blockage.cell_m: obstacle \"pile\" lies between the centres"), "{pile}");
        said_once(PILE, "0.001");
        let wall =
            |size: &str| format!("(id: \"wall\", shape: Box(size_m: {size}), east_m: 0, north_m: 0, heading_deg: 60)");
        for thin in ["(0.5, 60, 9)", "(60, 0.5, 9)"] {
            let said = said_once(&wall(thin), "4");
            let thickness = "water.blockage.cell_m: obstacle \"wall\" is 0.50 m thick, less than a cell of 4 m: ";
            assert!(said.starts_with(thickness), "{said}");
        }
        assert_eq!(said(&wall("(60, 4.5, 9)"), "4"), NOTHING);
    }

    /// The source of the channel stands where a caisson's cell reaches beyond it.
    #[test]
    fn a_source_that_no_water_comes_by_is_refused() {
        let source = changed(CHANNEL, &[]).scenario.sources[0].clone();
        let (east, north) = (source.east_m.get() + 3.0, source.north_m.get());
        let said = |away: f64| {
            let east = east + away;
            let caisson =
                format!("(id: \"caisson\", shape: Box(size_m: (6, 6, 20)), east_m: {east}, north_m: {north})");
            said(&caisson, "5")
        };
        let shut = (1..40).map(|k| said(0.1 * f64::from(k))).find(|s| !s.is_empty());
        let shut = shut.expect("some cell reaches beyond the caisson");
        assert!(shut[0].starts_with("sources[0]: source \"") && shut[0].contains("no water comes by"), "{shut:?}");
        assert_eq!(said(9.0), NOTHING);
    }

    #[test]
    fn an_area_without_water_and_a_missing_field_of_heights_are_refused() {
        let land = "(id: \"land\", shape: Box(size_m: (900, 900, 20)), east_m: 0, north_m: 0)";
        let reef = "(id: \"reef\", shape: Heightfield(file: \"reef.asc\"), east_m: 0, north_m: 0)";
        let (land, reef) = (said(land, "2"), said(reef, ""));
        for (said, begins) in [
            (&land[0], "obstacles: they fill the whole area"),
            (&land[1], "water.blockage: no water that could flow is left"),
            (&reef[0], "obstacles[0].shape.file: /nowhere/reef.asc: No such file"),
        ] {
            assert!(said.starts_with(begins), "{said}");
        }
    }
}
