//! What a layer asks for, and the layers' names.

use crate::behave::Stride;
use crate::handoff::{Behaviour, Manoeuvre};
use strum::IntoStaticStr;

/// The kinds of layers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
pub(super) enum Kind {
    Find,
    Maintain,
    Reacquire,
    Declare,
    Avoid,
    PlumeMap,
    GoHome,
}

/// What a layer asks for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ask {
    pub(super) kind: Kind,
    /// What it does, in the terms of the field.
    pub(super) behaviour: Behaviour,
    pub(super) manoeuvre: Manoeuvre,
    /// It is a new goal, not a change of the last one.
    pub(super) anew: bool,
}

impl Ask {
    /// An ask, if there is a manoeuvre.
    pub(super) fn from_manoeuvre(
        kind: Kind,
        behaviour: Behaviour,
        manoeuvre: Option<Manoeuvre>,
        anew: bool,
    ) -> Option<Self> {
        manoeuvre.map(|manoeuvre| Self { kind, behaviour, manoeuvre, anew })
    }
}

/// Stores what a behaviour asks for; true if that is a new goal.
pub(super) fn keep(command: &mut Option<Manoeuvre>, stride: Stride) -> bool {
    if let Stride::Start(manoeuvre) | Stride::Adjust(manoeuvre) = stride {
        *command = Some(manoeuvre);
    }
    matches!(stride, Stride::Start(_))
}
