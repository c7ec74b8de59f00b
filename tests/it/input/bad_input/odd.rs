//! Odd input: characters out of place, and what is legal number by number and yet cannot be.

use super::{POND, golden, in_folder, pond, refused, stderr};

/// A minus sign copied from a document, a dash, a letter of another alphabet.
#[test]
fn an_odd_character_anywhere_is_an_error_like_any_other() {
    for odd in ['\u{2212}', '\u{e9}', '\u{feff}', '\0'] {
        for at in 0..POND.len() {
            let text = format!("{}{odd}{}", &POND[..at], &POND[at..]);
            if let Err(error) = rheotaxis::scenario::parse("pond.ron", &text) {
                assert!(!error.lines().is_empty(), "{odd:?} at {at}");
            }
        }
    }
}

#[test]
fn a_minus_sign_from_a_document() {
    refused(pond("north_m: -30", "north_m: \u{2212}30"), &golden("a_minus_sign_from_a_document"));
}

#[test]
fn a_mark_of_the_encoding_at_the_beginning_is_read_over() {
    let output = in_folder(format!("\u{feff}{POND}").as_bytes(), &["check", "pond.ron"]);
    assert_eq!(stderr(&output), "");
    assert_eq!(output.status.code(), Some(0));
}

#[test]
fn water_too_large_for_any_computer() {
    refused(
        pond("length_m: 100, width_m: 50", "length_m: 1e7, width_m: 1e7"),
        &golden("water_too_large_for_any_computer"),
    );
}

#[test]
fn a_list_of_no_points() {
    let text = pond("OpenLoop(table: [(t_s: 0, rpm: 0)], end_s: 1)", "Amp(lost_points: 0)");
    refused(text, &golden("a_list_of_no_points"));
}

#[test]
fn hulls_in_one_another() {
    let start = POND.find("        (\n            id").unwrap();
    let end = POND.find("    ],\n    time").unwrap();
    let robot = &POND[start..end];
    let second = robot.replace("auv0", "auv1");
    refused(POND.replacen(robot, &format!("{robot}{second}"), 1), &golden("hulls_in_one_another"));
}
