//! The words in which a crate declares its kinds and their rows.

/// Makes a kind, its rows and the type that stands in a scenario.
///
/// `pub FindSpec = Finds of BehaviourSpec { heading: "...", rows: [ZigZag, ...], standard: ZigZag }` makes the kind `Finds`, whose
/// things implement the trait `BehaviourSpec`, and `FindSpec`, a [`Choice`](crate::registry::Choice) of them. `standard` may be
/// left out.
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

        $crate::rows! {
            $(#[doc = $what])+
            $choice = $kind of $spec { heading: $heading, rows: [$($row),*] }
        }

        $(impl $crate::registry::Standard for $kind {
            fn standard() -> $choice {
                $choice::new(<$standard>::default())
            }
        })?
    };
}

/// Gives rows to a kind that is declared elsewhere, because some of its things hold others of the same kind: written as
/// [`kind!`](crate::kind).
#[macro_export]
macro_rules! rows {
    (
        $(#[doc = $what:literal])+
        $choice:ident = $kind:ident of $spec:ident { heading: $heading:expr, rows: [$($row:ty),* $(,)?] $(,)? }
    ) => {
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
    };
}
