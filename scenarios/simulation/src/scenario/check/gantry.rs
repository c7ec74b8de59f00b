//! Checks of a gantry; each finding has the field's path.

use super::path::robot_error;
use crate::scenario::fault::UnplacedFault;
use crate::scenario::folder_files::FolderFiles;
use crate::scenario::gantry::GantryBlock;
use robots::sense::{OnBoard, Probes};
use robots::vehicles::Gantry;
use std::path::Path;
use world::area::Area;
use world::terrain::Terrain;

/// Finds everything that is wrong with `gantries[i]`.
pub(crate) fn check(
    i: usize,
    block: &GantryBlock,
    area: &Area,
    terrain: &Terrain,
    step_s: f64,
    base_dir: &Path,
    found: &mut Vec<UnplacedFault>,
) {
    let path = format!("gantries[{i}]");
    let fault = |part, error| robot_error(&path, part, error);
    let gantry = match Gantry::load(&block.gantry, &FolderFiles(base_dir)) {
        Ok(gantry) => gantry,
        Err(e) => return found.push(fault("gantry", e)),
    };
    if let Err(e) = gantry.check_step(step_s) {
        found.push(fault("gantry", e));
    }
    let base = block.base(terrain);
    let start_m = block.start_m();
    match gantry.body_spec(block.id.as_str(), &base, start_m) {
        Err(e) => found.push(fault("start", e)),
        Ok(_) => {
            let head = base.point(start_m.push(0.0)).xy();
            let (inside_m, _) = area.edge_distance(head);
            if inside_m < 0.0 {
                found.push(
                    UnplacedFault::error(
                        format!("{path}.place"),
                        format!(
                            "gantry \"{}\" starts with its head at east {:.2} m, north {:.2} m, \
                             {:.2} m outside the area",
                            block.id.as_str(),
                            head.x,
                            head.y,
                            -inside_m
                        ),
                    )
                    .hint("the head is at `place`, moved by `start` along heading_deg and to its left"),
                );
            }
        }
    }
    let layout = block.layout(&gantry);
    let names: Vec<String> = layout.probes.iter().map(|p| p.name.clone()).collect();
    let on = OnBoard::new(block.id.as_str(), 0, step_s);
    if let Err(e) = Probes::new(&block.probes, &names, &on) {
        found.push(fault("probes", e));
    }
    if let Err(e) = block.tracker.build(&layout) {
        found.push(fault("tracker", e));
    }
}
