//! Turns the layers of a scenario into layers that work together: checks which ones are missing, and that their order
//! makes sense.

use super::super::setting::Setting;
use super::ask::Kind;
use super::maintain::Maintain;
use super::plume::PlumeLayers;
use super::plume_map::PlumeMap;
use super::spec::{LayerSpec, SubsumptionSpec};
use crate::behave::{GoTo, SoftAvoid};
use crate::declare::DeclareSpec;
use crate::error::{RobotError, require};

fn kind(layer: &LayerSpec) -> Kind {
    match layer {
        LayerSpec::Find(_) => Kind::Find,
        LayerSpec::Maintain(_) => Kind::Maintain,
        LayerSpec::Reacquire(_) => Kind::Reacquire,
        LayerSpec::Declare(_) => Kind::Declare,
        LayerSpec::Avoid(_) => Kind::Avoid,
        LayerSpec::PlumeMap(_) => Kind::PlumeMap,
        LayerSpec::GoHome(_) => Kind::GoHome,
    }
}

/// The states of the layers.
#[derive(Debug)]
pub(super) struct Layers {
    /// Their order, lowest first.
    pub(super) order: Vec<Kind>,
    pub(super) plume: PlumeLayers,
    pub(super) declare: Option<DeclareSpec>,
    pub(super) avoid: Option<SoftAvoid>,
    pub(super) go_home: Option<GoTo>,
}

/// Which layer must be above which other, and why.
const ABOVE: &[(Kind, Kind, &str)] = &[
    (Kind::Maintain, Kind::Find, "Find always asks for the vehicle: a layer below it would never control it"),
    (Kind::Reacquire, Kind::Find, "Find always asks for the vehicle: a layer below it would never control it"),
    (Kind::PlumeMap, Kind::Find, "PlumeMap's command replaces Find's"),
    (Kind::Avoid, Kind::Find, "Avoid changes the commands of the layers below it, and there is none below it"),
    (Kind::Reacquire, Kind::Maintain, "Reacquire looks for the plume that Maintain has lost"),
    (Kind::Declare, Kind::Find, "a declaration must not wait for a layer that always asks"),
    (Kind::Declare, Kind::Maintain, "a declaration must not wait for the end of the tracing"),
    (Kind::Declare, Kind::Reacquire, "a declaration must not wait for the end of the search around a lost point"),
    (Kind::GoHome, Kind::Find, "Go-Home inhibits the layers below it"),
    (Kind::GoHome, Kind::Maintain, "Go-Home inhibits the layers below it"),
    (Kind::GoHome, Kind::Reacquire, "Go-Home inhibits the layers below it"),
    (Kind::GoHome, Kind::Declare, "Go-Home inhibits the layers below it"),
    (Kind::GoHome, Kind::PlumeMap, "Go-Home inhibits the layers below it"),
];

fn wrong(field: &str, problem: String) -> RobotError {
    RobotError::invalid(format!("strategy.Subsumption.{field}"), problem)
}

/// The order of the layers, after checking it.
fn order(spec: &SubsumptionSpec) -> Result<Vec<Kind>, RobotError> {
    let order: Vec<Kind> = spec.layers.iter().map(kind).collect();
    let place = |kind: Kind| order.iter().position(|k| *k == kind);
    for (i, kind) in order.iter().enumerate() {
        let first = place(*kind).unwrap_or(i);
        if first < i {
            let problem = format!("there already is a {kind:?}, layers[{first}]; each layer may occur once");
            return Err(wrong(&format!("layers[{i}]"), problem));
        }
    }
    for (kind, why) in [
        (Kind::Find, "nothing would move the vehicle before the first detection"),
        (Kind::Maintain, "detections would have no effect"),
    ] {
        require(
            place(kind).is_some(),
            "strategy.Subsumption.layers",
            format!("there is no {kind:?}: {why}; add {kind:?}(...)"),
        )?;
    }
    if let (Some(i), None) = (place(Kind::GoHome), place(Kind::Declare)) {
        let problem = "GoHome waits for a declaration, and there is no Declare; add one, or remove GoHome";
        return Err(wrong(&format!("layers[{i}]"), problem.into()));
    }
    if spec.eyes.is_some() && place(Kind::Declare).is_none() {
        let problem = "a source seen by the camera is declared, and there is no Declare; add one, or remove eyes";
        return Err(wrong("eyes", problem.into()));
    }
    for (upper, lower, why) in ABOVE {
        if let (Some(i), Some(j)) = (place(*upper), place(*lower))
            && i < j
        {
            let problem = format!("{upper:?} must be above (after) {lower:?}, layers[{j}]: {why}");
            return Err(wrong(&format!("layers[{i}]"), problem));
        }
    }
    Ok(order)
}

impl Layers {
    pub(super) fn new(spec: &SubsumptionSpec, setting: &Setting) -> Result<Self, RobotError> {
        let order = order(spec)?;
        let mut find = None;
        let mut maintain = None;
        let (mut reacquire, mut declare, mut go_home) = (None, None, None);
        let (mut avoid, mut plume_map) = (None, None);
        for (i, layer) in spec.layers.iter().enumerate() {
            let here = |e: RobotError| within(i, e);
            match layer {
                LayerSpec::Find(f) => find = Some(f.build().map_err(here)?),
                LayerSpec::Maintain(m) => maintain = Some(Maintain::new(m).map_err(here)?),
                LayerSpec::Reacquire(r) => reacquire = Some(r.build().map_err(here)?),
                LayerSpec::Declare(rule) => {
                    rule.check(spec.lost_points, spec.lcdps).map_err(here)?;
                    declare = Some(rule.clone());
                }
                LayerSpec::Avoid(p) => {
                    avoid = Some(SoftAvoid::new(p, setting.bed.clone()).map_err(here)?);
                }
                LayerSpec::PlumeMap(p) if setting.maps => plume_map = Some(PlumeMap::new(p)),
                LayerSpec::PlumeMap(_) => {
                    let problem = "needs a source map, and the robot has none; add one, for example map: Hmm()";
                    return Err(wrong(&format!("layers[{i}]"), problem.into()));
                }
                LayerSpec::GoHome(_) => go_home = Some(GoTo::home()),
            }
        }
        Ok(Self {
            order,
            plume: PlumeLayers::new(
                find.expect("the order has a Find"),
                maintain.expect("the order has a Maintain"),
                reacquire,
                plume_map,
            ),
            declare,
            avoid,
            go_home,
        })
    }
}

/// The error of a part, named with its layer: `reacquire.Bowtie.angle_deg` becomes `layers[2].angle_deg`.
fn within(layer: usize, error: RobotError) -> RobotError {
    match error {
        RobotError::Invalid { field, problem } => {
            // A layer that has a single part does not name the part in its path; Maintain's two parts are named.
            let inner = ["find.", "reacquire.", "declare.", "avoid."]
                .iter()
                .find_map(|part| field.strip_prefix(part))
                .unwrap_or(&field);
            wrong(&format!("layers[{layer}].{inner}"), problem)
        }
        file @ RobotError::File { .. } => file,
    }
}
