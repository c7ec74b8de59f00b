//! Parameters of a vehicle.

use super::kinematic_spec::KinematicSpec;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;

/// The vehicle.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum VehicleSpec {
    /// REMUS 100.
    #[default]
    Remus100(RemusSpec),
    /// A vehicle without dynamics.
    Kinematic(KinematicSpec),
    /// A vehicle that comes with the program, by the name of its folder: see `rheotaxis list vehicles`.
    Shipped(String),
    /// A vehicle of one's own: its folder, with `vehicle.ron` and a URDF, relative to the scenario file.
    File(String),
}

// The vehicle of the shipped folder `remus100`.
/// A REMUS 100.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RemusSpec {
    /// Hull parameters: `remus100` or `reference`.
    pub parameters: ParameterSet,
    /// URDF file, relative to the scenario file; `None`: the built-in one.
    pub urdf: Option<String>,
}

/// A set of hull parameters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum ParameterSet {
    /// The default: the published set without its quirks.
    #[default]
    #[serde(rename = "remus100")]
    Remus100,
    /// The published set with its quirks, to compare with its trajectories.
    #[serde(rename = "reference")]
    Reference,
}

/// Vehicles and gantries that a scenario can choose.
pub const CATALOGUE: &[Entry] = &[
    Entry {
        name: "Remus100",
        what: "Torpedo-shaped survey vehicle of 31 kg: six degrees of freedom, rudder, stern plane, propeller.",
        source: "Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control, 2nd ed. 2021; Prestero, MIT/WHOI \
            2001",
    },
    Entry {
        name: "Kinematic",
        what: "Vehicle without dynamics: speed over ground or through the water, bounded turn rate or turning radius, \
            lag.",
        source: "Dubins 1957; the point that searches in Li, Farrell & Cardé 2001, Adaptive Behavior 9",
    },
    Entry {
        name: "Shipped",
        what: "A vehicle of a folder that comes with the program, by the folder's name.",
        source: "Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control, 2nd ed. 2021; each folder names its own",
    },
    Entry {
        name: "File",
        what: "A vehicle of a folder of your own: vehicle.ron and a URDF.",
        source: "Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control, 2nd ed. 2021; its file names its own",
    },
    Entry {
        name: "CrabGantry",
        what: "Two-axis gantry over a flume with a head of three probes: servo drives, end stops, contacts.",
        source: "Webster, Volyanskyy & Weissburg 2012, section 3.1 and Figs. 5, 6",
    },
];
