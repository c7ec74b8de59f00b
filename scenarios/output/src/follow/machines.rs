//! What tables and figures need to know beforehand about a scenario's robots and gantries.

use crate::results::{GantryInfo, RobotInfo};
use rheotaxis::error::AssembleError;
use rheotaxis::scenario::{FolderFiles, GantryBlock, Loaded};
use robots::sense::FluorometerSpec;
use robots::vehicles::Gantry;
use world::ranges::Finite;

/// Its robots.
pub(super) fn robots(loaded: &Loaded) -> Vec<RobotInfo> {
    let robots = loaded.scenario.robots.iter().map(|spec| {
        let about = spec.strategy.about();
        let dye = spec.sensors.get::<FluorometerSpec>();
        RobotInfo {
            id: spec.id.as_str().to_string(),
            full_scale_ug_l: dye.map(|f| f.full_scale_ug_l.get()),
            threshold: dye.map(|f| f.threshold.get()),
            regions: about.regions,
            layered: about.layers,
            numbers: spec.sensors.iter().flat_map(|s| s.numbers().iter().copied()).collect(),
        }
    });
    robots.collect()
}

/// Its gantries.
///
/// # Errors
/// If the files of one cannot be read.
pub(super) fn gantries(loaded: &Loaded) -> Result<Vec<GantryInfo>, AssembleError> {
    let scenario = &loaded.scenario;
    // Of several effluents, the strongest.
    let effluent = (scenario.sources.iter())
        .filter_map(|s| Some(1e-3 * s.rate_g_s.get() / s.release.nozzle.as_ref()?.volume_m3_s()))
        .max_by(f64::total_cmp);
    let info = |block: &GantryBlock| {
        let id = block.id.as_str().to_string();
        let gantry = Gantry::load(&block.gantry, &FolderFiles(&loaded.base_dir))
            .map_err(|source| AssembleError::Robot { id: id.clone(), source })?;
        let range_v = block.probes.range_v.map(Finite::get);
        let layout = gantry.layout(block.probes.rate_hz.get(), range_v);
        Ok(GantryInfo {
            id,
            probes: layout.probes.into_iter().map(|p| p.name).collect(),
            range_v,
            full_scale_kg_m3: block.probes.full_scale_kg_m3.get(),
            effluent_kg_m3: effluent,
        })
    };
    scenario.gantries.iter().map(info).collect()
}
