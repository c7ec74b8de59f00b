//! Kinds of things that are chosen by name, and what all things of all kinds can do.

use super::{Choice, Row};
use crate::catalogue::Entry;
use dyn_clone::DynClone;
use std::any::Any;
use std::fmt::Debug;

/// A place in a scenario where one of several things stands by its name. Made by [`kind!`](crate::kind).
pub trait Kind: Sized + 'static {
    /// What each of its things can do: a trait object.
    type Spec: ?Sized + Spec;
    /// Its name to readers and writers of files.
    const NAME: &'static str;
    /// Its heading in lists.
    const HEADING: &'static str;
    /// What it is for, in one or two sentences.
    const WHAT: &'static str;

    /// The rows that come with the program, in the order of lists.
    fn built_in() -> Vec<Row<Self>>;
}

/// A kind that takes parameters `S`. [`kind!`](crate::kind) says it of all that implement the kind's trait.
pub trait Takes<S>: Kind {
    /// The parameters as what the kind's things can do.
    fn boxed(spec: S) -> Box<Self::Spec>;
}

/// A kind with a thing for those who do not choose.
pub trait Standard: Kind {
    /// That thing with its standard parameters.
    fn standard() -> Choice<Self>;
}

/// Parameters that a scenario can ask for by name.
pub trait Listed {
    /// Name as written in RON, one sentence, source.
    const ENTRY: Entry;
}

/// What the parameters of anything that is chosen by name can do; the trait of each kind builds on it. It comes by itself with
/// the derives of a plain struct and [`Listed`].
pub trait Spec: Debug + Send + Sync + DynClone + erased_serde::Serialize {
    /// Name as written in RON, one sentence, source.
    fn entry(&self) -> Entry;
    /// The parameters, for those who know their type.
    fn as_any(&self) -> &dyn Any;
    /// The same, to change them.
    fn as_any_mut(&mut self) -> &mut dyn Any;
    /// Whether these are the same parameters.
    fn same(&self, other: &dyn Any) -> bool;
}

impl<S> Spec for S
where
    S: Listed + Debug + Clone + PartialEq + serde::Serialize + Send + Sync + 'static,
{
    fn entry(&self) -> Entry {
        S::ENTRY
    }

    fn as_any(&self) -> &dyn Any {
        self
    }

    fn as_any_mut(&mut self) -> &mut dyn Any {
        self
    }

    fn same(&self, other: &dyn Any) -> bool {
        other.downcast_ref::<S>() == Some(self)
    }
}

/// Makes a kind, its rows and the type that stands in a scenario.
///
/// `pub FindSpec = Finds of BehaviourSpec { heading: "...", rows: [ZigZag, ...], standard: ZigZag }` makes the kind `Finds`, whose
/// things implement the trait `BehaviourSpec`, and `FindSpec`, a [`Choice`] of them. `standard` may be left out.
#[macro_export]
macro_rules! kind {
    (
        $(#[doc = $what:literal])+
        $vis:vis $choice:ident = $kind:ident of $spec:ident {
            heading: $heading:expr,
            rows: [$($row:ty),* $(,)?]
            $(, standard: $standard:ty)? $(,)?
        }
    ) => {
        $(#[doc = $what])+
        #[derive(Clone, Copy, Debug)]
        $vis enum $kind {}

        $(#[doc = $what])+
        $vis type $choice = $crate::registry::Choice<$kind>;

        impl $crate::registry::Kind for $kind {
            type Spec = dyn $spec;
            const NAME: &'static str = stringify!($choice);
            const HEADING: &'static str = $heading;
            const WHAT: &'static str = concat!($($what),+);

            fn built_in() -> Vec<$crate::registry::Row<Self>> {
                vec![$($crate::registry::Row::new::<$row>()),*]
            }
        }

        impl<S: $spec + 'static> $crate::registry::Takes<S> for $kind {
            fn boxed(spec: S) -> Box<dyn $spec> {
                Box::new(spec)
            }
        }

        $(impl $crate::registry::Standard for $kind {
            fn standard() -> $choice {
                $choice::new(<$standard>::default())
            }
        })?
    };
}
