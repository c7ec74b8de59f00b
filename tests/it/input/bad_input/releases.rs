//! Buoyant releases that cannot be: each mistake is named with its place and what would be legal.

use super::{in_folder, pond};

/// What `check` says to a release, which ends with this.
fn said(release: &str) -> String {
    let text = pond(&[("rate_g_s: 0.025),", &format!("rate_g_s: 0.025, release: ({release})),"))]);
    let ended = in_folder(text.as_bytes(), &["check", "pond.ron"]);
    // One paragraph, so that line breaks do not matter.
    let words: Vec<&str> = ended.err.split_whitespace().collect();
    assert_eq!(ended.code, Some(if words.is_empty() { 0 } else { 1 }));
    words.join(" ").replace("│ ", "")
}

#[test]
fn a_buoyant_release_in_the_pond_is_fine() {
    for buoyancy in [
        "buoyancy: Excess(-2), volume_l_s: 1",
        "buoyancy: Composition(temperature_c: 30), volume_l_s: 1",
        "buoyancy: Composition(solutes: [(what: Ethanol, g_l: 100)]), nozzle: (diameter_m: 0.05, speed_m_s: 0.1)",
        "buoyancy: Neutral",
        "structure: 0.5, volume_l_s: 1, pulse: (on_s: 2, off_s: 3)",
    ] {
        assert_eq!(said(buoyancy), "", "{buoyancy}");
    }
}

#[test]
fn impossible_releases_are_named() {
    for (release, says) in [
        ("buoyancy: Excess(-2)", "needs the volume that it releases, in L/s"),
        ("buoyancy: Excess(-2), volume_l_s: 1, nozzle: (diameter_m: 0.05, speed_m_s: 0.1)", "leave it out"),
        ("buoyancy: Excess(-2000), volume_l_s: 1", "from -500 to 500 kg/m³"),
        ("buoyancy: Excess(-2), volume_l_s: 0", "must be"),
        ("structure: 0.5", "needs the volume"),
        ("structure: 1.5, volume_l_s: 1", "from 0 to 1"),
        ("pulse: (on_s: 0, off_s: 1)", "must be > 0"),
        ("buoyancy: Composition(solutes: [(what: Brine, g_l: 10)]), volume_l_s: 1", "SodiumChloride"),
        ("buoyancy: Composition(solutes: [(what: Propanol, g_l: 900)]), volume_l_s: 1", "must be at most 280"),
        (
            "buoyancy: Composition(solutes: [(what: Ethanol, g_l: 600), (what: Propanol, g_l: 280)]), volume_l_s: 1",
            "more than a litre",
        ),
        ("buoyancy: Composition(temperature_c: 90), volume_l_s: 1", "from -2 to 40 °C"),
        (
            "buoyancy: Composition(neutral_with: SodiumChloride, salinity: 42, around_c: 30), volume_l_s: 1",
            "no amount of",
        ),
    ] {
        let got = said(release);
        assert!(got.contains("pond.ron") && got.contains(says), "{release}: {got}");
    }
}
