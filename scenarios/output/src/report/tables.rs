//! All tables that a run leaves, with their columns.

use super::write::PLUME;
use crate::columns::TableInfo;
use crate::results::{belief_track, odour, pictures, probes, track_columns};

/// The tables of a run, in the order of docs/outputs.md.
pub fn tables() -> Vec<TableInfo> {
    let tables = [
        (
            "track.csv",
            "Where each robot was, and what it believed, read and did: a row for each robot and each \
                `record.frame_period_s`.",
            track_columns::columns(true, true, &["<number>"]),
        ),
        (
            "probes-<gantry>.csv",
            "Readings of a gantry's probes, what its searcher derived, where its head was: a row for each \
                `record.frame_period_s`.",
            [&probes::COLUMNS[..], &probes::OF_PROBE].concat(),
        ),
        (
            "plume.csv",
            "Filaments at the end: every k-th of each source, at most `record.plume_points`.",
            PLUME.to_vec(),
        ),
        (
            "belief-<robot>.csv",
            "How a robot's map of where the source may be converged: a row for each update.",
            [&belief_track::COLUMNS[..], &belief_track::CREDIBLE].concat(),
        ),
        (
            "odour-<robot>.csv",
            "Where a robot's map expects odour, which way it came, and the way to meet it: a row for each cell.",
            odour::COLUMNS.to_vec(),
        ),
        (
            "pictures.csv",
            "Where and when each picture of the robots' cameras was taken: a row for each picture.",
            pictures::COLUMNS.to_vec(),
        ),
    ];
    let info = |(file, what, columns)| TableInfo { file, what, columns };
    tables.map(info).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_unit_is_the_one_that_the_name_ends_with() {
        for column in tables().iter().flat_map(|t| &t.columns) {
            for (end, unit) in [
                ("_m_s", "m/s"),
                ("_m", "m"),
                ("_s", "s"),
                ("_deg", "degrees"),
                ("_v", "V"),
                ("_ug_l", "ug/L"),
                ("_kg", "kg"),
                ("_hz", "1/s"),
                ("_nat", "nat"),
                ("_m2", "m2"),
                ("_m3", "m3"),
            ] {
                if column.name.ends_with(end) {
                    assert_eq!(column.unit, unit, "{column:?}");
                    break;
                }
            }
        }
    }
}
