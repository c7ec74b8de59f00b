//! `odour-<robot>.csv`: where a map expects odour, which way it came, and the way to meet it.

use crate::columns::{ColumnInfo, columns, header};
use robots::handoff::Odour;
use std::fmt::Write as _;
use std::sync::Arc;

/// Cells with a smaller probability are omitted.
const LEAST: f64 = 1e-4;

pub(crate) const COLUMNS: [ColumnInfo; 7] = columns! {
    "t_s", "s", "Time of the map since the start of the mission.";
    "what", "", "`detection`: odour may be met; `came`: the way it came; `walk`: the way most likely to meet it.";
    "step", "", "Number of the row in its list or way, from 0.";
    "east_m", "m", "Centre of the cell, east.";
    "north_m", "m", "Centre of the cell, north.";
    "up_m", "m", "Centre of the cell, up; empty for a map of the plane.";
    "chance", "", "Probability of a detection in the cell.";
};

/// The table: for each time, the cells where odour may be detected, then the two paths cell by cell.
pub(crate) fn csv(said: &[Arc<Odour>]) -> String {
    let mut text = header(&COLUMNS) + "\n";
    for o in said {
        let likely = (0..o.detection.len()).filter(|c| o.detection[*c] >= LEAST);
        let all = [("detection", likely.collect()), ("came", o.came.clone()), ("walk", o.walk.clone())];
        for (what, cells) in all {
            for (step, cell) in cells.into_iter().enumerate() {
                let p = o.grid.centre(cell);
                // A map of the plane does not tell the height.
                let up = if o.grid.n[2] == 1 { String::new() } else { format!("{:.3}", p.z) };
                let (t_s, chance) = (o.t_s, o.detection[cell]);
                writeln!(text, "{t_s:.3},{what},{step},{:.3},{:.3},{up},{chance:.6}", p.x, p.y)
                    .expect("writing to a String succeeds");
            }
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::odour;

    #[test]
    fn each_time_has_its_cells_and_its_paths() {
        let text = csv(&[Arc::new(odour(40.0)), Arc::new(odour(80.0))]);
        let columns = text.lines().next().unwrap().split(',').count();
        assert!(text.lines().all(|l| l.split(',').count() == columns));
        let rows = |what: &str| text.lines().filter(|l| l.starts_with("80.000") && l.contains(what)).count();
        let o = odour(80.0);
        assert_eq!((rows(",came,"), rows(",walk,")), (o.came.len(), o.walk.len()));
        assert!(rows(",detection,") > 0);
    }
}
