//! The rows of a campaign and their tables.

pub(super) mod columns;
pub(super) mod record;
pub(super) mod row;
pub(super) mod table;
