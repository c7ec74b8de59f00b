//! Colours for the colour-blind (Okabe & Ito 2008), and ramps that also differ in lightness.

use robots::handoff::Behaviour;

/// Ink of axes and frames.
pub const INK: &str = "#222222";
/// Ink of things in the background.
pub const GREY: &str = "#7f7f7f";
/// Grid lines.
pub const GRID: &str = "#e3e3e3";
/// A true source.
pub const TRUE_SOURCE: &str = "#ffffff";
/// A declared source.
pub const DECLARED: &str = "#f0e442";
/// A detection.
pub const DETECTION: &str = "#7a0c2e";
/// The believed track.
pub const BELIEVED: &str = "#555555";
/// The flow.
pub const FLOW: &str = "#1f4e79";

/// Colour of a behaviour, and its name for people.
pub fn behaviour_look(b: Behaviour) -> (&'static str, &'static str) {
    match b {
        Behaviour::Idle => ("#bbbbbb", "Idle"),
        Behaviour::OpenLoop => ("#0072b2", "Open loop"),
        Behaviour::GoTo => ("#56b4e9", "Go-To"),
        Behaviour::Find => ("#0072b2", "Find"),
        Behaviour::TrackIn => ("#d55e00", "Track-In"),
        Behaviour::TrackOut => ("#e69f00", "Track-Out"),
        Behaviour::Reacquire => ("#cc79a7", "Reacquire"),
        Behaviour::GoHome => ("#000000", "Go-Home"),
        Behaviour::Done => ("#888888", "Done"),
        Behaviour::FollowPath => ("#009e73", "Follow path"),
        Behaviour::Avoid => ("#f0e442", "Avoid"),
        Behaviour::Survey => ("#6a3d9a", "Survey"),
        Behaviour::Sweep => ("#0072b2", "Full sweep"),
        Behaviour::ToBest => ("#56b4e9", "To best place"),
        Behaviour::StepUp => ("#d55e00", "Step up-stream"),
        Behaviour::Cast => ("#cc79a7", "Cast"),
        Behaviour::Other(name) => ("#a6761d", name),
    }
}

/// Colour of a behaviour.
pub fn behaviour(b: Behaviour) -> &'static str {
    behaviour_look(b).0
}

/// Colour of the vehicle of this number, where there are several; none is that of the search, or of the plume.
pub fn vehicle(k: usize) -> &'static str {
    const COLOURS: [&str; 6] = ["#7b3fd1", "#00d8c0", "#c9d400", "#e8304f", "#8a5a2b", "#1f3a93"];
    COLOURS[k % COLOURS.len()]
}

/// The same of a gantry, which stops where others have done.
pub fn gantry_look(b: Behaviour) -> (&'static str, &'static str) {
    match b {
        Behaviour::Done => ("#888888", "Stopped"),
        b => behaviour_look(b),
    }
}

fn mix(a: [u8; 3], b: [u8; 3], share: f64) -> String {
    let c = |k: usize| {
        let (a, b) = (f64::from(a[k]), f64::from(b[k]));
        (a + (b - a) * share.clamp(0.0, 1.0)).round() as u8
    };
    format!("#{:02x}{:02x}{:02x}", c(0), c(1), c(2))
}

/// Depth, from shallow (0) to deep (1).
pub fn depth(share: f64) -> String {
    mix([0xf6, 0xf9, 0xfb], [0xb9, 0xcf, 0xdf], share)
}

/// A ramp over three colours.
fn ramp([low, middle, high]: [[u8; 3]; 3], share: f64) -> String {
    if share < 0.5 { mix(low, middle, 2.0 * share) } else { mix(middle, high, 2.0 * share - 1.0) }
}

/// Plume, from thin (0) to dense (1).
pub fn plume(share: f64) -> String {
    ramp([[0xd3, 0xe8, 0xa8], [0x5a, 0xae, 0x61], [0x00, 0x44, 0x1b]], share)
}

/// Colour of the probability that the source is there, from small (0) to the largest (1).
pub fn likelihood(share: f64) -> String {
    ramp([[0xff, 0xf7, 0xec], [0xfc, 0x8d, 0x59], [0x7f, 0x00, 0x00]], share)
}

/// Colour of a sidescan's echo, from none (0) to strong (1): the copper of paper records.
pub fn echo(share: f64) -> String {
    ramp([[0x08, 0x06, 0x04], [0x9a, 0x5f, 0x22], [0xff, 0xf3, 0xd2]], share)
}
