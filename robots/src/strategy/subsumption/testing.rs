//! Layers for tests, and what they say.

use super::{GoHomeSpec, LayerSpec, MaintainSpec, PlumeMapSpec, Subsumption, SubsumptionSpec};
use crate::behave::{AvoidParams, FindSpec, ReacquireSpec};
use crate::declare::DeclareSpec;
use crate::handoff::LayerState;
use crate::strategy::testing::{Desk, Ticked, setting};

pub(super) fn find() -> LayerSpec {
    LayerSpec::Find(FindSpec::default())
}
pub(super) fn maintain() -> LayerSpec {
    LayerSpec::Maintain(MaintainSpec::default())
}
pub(super) fn reacquire() -> LayerSpec {
    LayerSpec::Reacquire(ReacquireSpec::default())
}
pub(super) fn declare() -> LayerSpec {
    LayerSpec::Declare(DeclareSpec::default())
}
pub(super) fn avoid() -> LayerSpec {
    LayerSpec::Avoid(AvoidParams::default())
}
pub(super) fn plume_map() -> LayerSpec {
    LayerSpec::PlumeMap(PlumeMapSpec::default())
}
pub(super) fn go_home() -> LayerSpec {
    LayerSpec::GoHome(GoHomeSpec::default())
}

pub(super) fn all() -> Vec<LayerSpec> {
    vec![find(), maintain(), reacquire(), declare(), avoid(), plume_map(), go_home()]
}

pub(super) fn desk(layers: Vec<LayerSpec>) -> Desk<Subsumption> {
    let spec = SubsumptionSpec::with_layers(layers);
    Desk::new(Subsumption::new(&spec, &setting(8.0, true)).expect("these layers make sense"))
}

/// The state of each layer.
pub(super) fn said(d: &Ticked) -> String {
    let word = |s| match s {
        LayerState::Silent => '.',
        LayerState::Holds => 'H',
        LayerState::Suppressed => 's',
        LayerState::Inhibited => 'i',
    };
    d.shown.layers.iter().map(|l| word(l.state)).collect()
}
