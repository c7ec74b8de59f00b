//! A macro that makes a struct the parameters of something that a scenario can name.

/// Parameters that a scenario can ask for by name, each with its default: the struct, how files and the schema know it,
/// and its entry in lists. The doc comments of the fields are what `rheotaxis explain` says of them.
///
/// ```
/// rheotaxis::params! {
///     /// Parameters of a strategy.
///     pub struct UpFlow as "UpFlow", "up-stream until it smells something", from "an example" {
///         /// Speed through the water, m/s.
///         speed_m_s: rheotaxis::prelude::Positive = rheotaxis::prelude::Positive::new(1.5),
///     }
/// }
/// assert_eq!(UpFlow::default().speed_m_s.get(), 1.5);
/// ```
#[macro_export]
macro_rules! params {
    (
        $(#[$about:meta])*
        $vis:vis struct $name:ident as $listed:literal, $what:literal, from $source:literal {
            $($(#[$says:meta])* $field:ident: $type:ty = $default:expr),* $(,)?
        }
    ) => {
        $(#[$about])*
        #[derive(
            Clone, Debug, PartialEq, $crate::serde::Serialize, $crate::serde::Deserialize, $crate::schemars::JsonSchema,
        )]
        #[serde(crate = "rheotaxis::serde", deny_unknown_fields, default)]
        #[schemars(crate = "rheotaxis::schemars")]
        $vis struct $name {
            $($(#[$says])* pub $field: $type,)*
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: $default,)* }
            }
        }

        impl $crate::world::registry::Listed for $name {
            const ENTRY: $crate::world::catalogue::Entry =
                $crate::world::catalogue::Entry { name: $listed, what: $what, source: $source };
        }
    };
}
