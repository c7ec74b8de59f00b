//! What tables and figures need to know about the gantries of a scenario.

use super::run::RunError;
use output::results::GantryInfo;
use rheotaxis::error::AssembleError;
use rheotaxis::scenario::{Beside, GantryBlock, Loaded};
use robots::vehicles::Gantry;
use world::ranges::Finite;

/// That of each gantry, in the order of the scenario.
pub(super) fn gantries(loaded: &Loaded) -> Result<Vec<GantryInfo>, RunError> {
    let scenario = &loaded.scenario;
    // Of several effluents, the strongest.
    let effluent = (scenario.sources.iter())
        .filter_map(|s| Some(1e-3 * s.rate_g_s.get() / s.release.nozzle.as_ref()?.volume_m3_s()))
        .max_by(f64::total_cmp);
    let info = |block: &GantryBlock| {
        let id = block.id.as_str().to_string();
        let gantry = Gantry::load(&block.gantry, &Beside(&loaded.base_dir)).map_err(|source| {
            AssembleError::Robot {
                id: id.clone(),
                source,
            }
        })?;
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
