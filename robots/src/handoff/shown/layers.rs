//! State of the layers of a subsumption planner: which one controls the vehicle, and which ones it suppresses.

use serde::Serialize;
use strum::IntoStaticStr;

/// How a layer stands in a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
#[serde(rename_all = "snake_case")]
pub enum LayerState {
    /// Asks for nothing.
    #[default]
    Silent,
    /// Its command moves the vehicle.
    Holds,
    /// Asks for something, but the command of a higher layer replaces its own.
    Suppressed,
    /// A higher layer has taken its input away, so that it does nothing.
    Inhibited,
}

impl LayerState {
    /// Name as it stands in files and topics.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// A layer in a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Layer {
    /// Name, as in the scenario.
    pub name: &'static str,
    /// How it stands.
    pub state: LayerState,
}
