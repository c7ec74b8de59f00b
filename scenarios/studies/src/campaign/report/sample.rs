//! Invented rows for tests.

use crate::campaign::RunRow;

/// A row of arm `a`. It declared with this error (along, across) and found the source if within 40 m, or it declared
/// nothing.
pub(crate) fn row(seed_index: u64, error: Option<(f64, f64)>) -> RunRow {
    let error_m = error.map(|(a, c)| (a * a + c * c).sqrt());
    let success = error_m.is_some_and(|e| e <= 40.0);
    let k = seed_index as f64;
    RunRow {
        run: seed_index,
        arm: "a".to_string(),
        condition: String::new(),
        seed_index,
        seed: seed_index + 1,
        outcome: if success { "found" } else { "not_found" }.to_string(),
        success,
        error: None,
        digest: format!("{seed_index:032x}"),
        mission_s: 1000.0 + k,
        first_detection_s: Some(100.0 + k),
        declared_s: error.map(|_| 900.0 + 10.0 * k),
        declared_east_m: error.map(|e| e.0),
        declared_north_m: error.map(|e| e.1),
        error_m,
        error_along_m: error.map(|e| e.0),
        error_across_m: error.map(|e| e.1),
        traced_m: error.map(|_| 950.0 + k),
        travelled_m: 1800.0 + k,
        detections: 50,
        spin_up_wall_s: 2.0,
        mission_wall_s: 1.0,
        ..RunRow::default()
    }
}
