//! A line of a table: a struct whose fields are the columns, each with name, unit and meaning.

use output::columns::ColumnInfo;

/// How a column is read from a record and written to it. A value that is missing is not written: it stays as in a new
/// record.
pub(crate) enum Column<T> {
    Number(fn(&T) -> Option<u64>, fn(&mut T, u64)),
    Truth(fn(&T) -> bool, fn(&mut T, bool)),
    Text(fn(&T) -> Option<&str>, fn(&mut T, String)),
    Real(fn(&T) -> Option<f64>, fn(&mut T, f64)),
}

/// A line of a table.
pub(crate) trait Record: Default + 'static {
    /// Name of the table.
    const TABLE: &'static str;
    /// Of each column: description, whether it may be empty, and access.
    const COLUMNS: &'static [(ColumnInfo, bool, Column<Self>)];
}

/// Defines a record, whose fields are the columns of its table: name, meaning, kind and unit. What stands `beside` is
/// no column.
macro_rules! record {
    (
        $(#[$about:meta])* $record:ident, $table:literal:
        $($(#[doc = $what:literal])+ $field:ident: $kind:ident $unit:literal,)*
        $(beside: $(#[$more:meta])* $other:ident: $type:ty,)?
    ) => {
        $(#[$about])*
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct $record {
            $($(#[doc = $what])+ pub $field: record!(@type $kind),)*
            $($(#[$more])* pub $other: $type,)?
        }

        impl Record for $record {
            const TABLE: &'static str = $table;
            const COLUMNS: &'static [(ColumnInfo, bool, Column<Self>)] = &[$(record!(
                @column $kind $field,
                ColumnInfo::new(stringify!($field), $unit, concat!($($what),+))
            )),*];
        }
    };
    (@type Number) => { u64 };
    (@type Truth) => { bool };
    (@type Text) => { String };
    (@type Real) => { f64 };
    (@type MaybeNumber) => { Option<u64> };
    (@type MaybeText) => { Option<String> };
    (@type Maybe) => { Option<f64> };
    (@column Number $f:ident, $info:expr) => {
        ($info, false, Column::Number(|r| Some(r.$f), |r, v| r.$f = v))
    };
    (@column Truth $f:ident, $info:expr) => {
        ($info, false, Column::Truth(|r| r.$f, |r, v| r.$f = v))
    };
    (@column Text $f:ident, $info:expr) => {
        ($info, false, Column::Text(|r| Some(&r.$f), |r, v| r.$f = v))
    };
    (@column Real $f:ident, $info:expr) => {
        ($info, false, Column::Real(|r| Some(r.$f), |r, v| r.$f = v))
    };
    (@column MaybeNumber $f:ident, $info:expr) => {
        ($info, true, Column::Number(|r| r.$f, |r, v| r.$f = Some(v)))
    };
    (@column MaybeText $f:ident, $info:expr) => {
        ($info, true, Column::Text(|r| r.$f.as_deref(), |r, v| r.$f = Some(v)))
    };
    (@column Maybe $f:ident, $info:expr) => {
        ($info, true, Column::Real(|r| r.$f, |r, v| r.$f = Some(v)))
    };
}
pub(super) use record;
