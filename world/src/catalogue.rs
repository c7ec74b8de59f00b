//! One row of a catalogue: what `rheotaxis list` prints and what the structure tests check.

/// A named thing that a scenario can use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Name as written in RON.
    pub name: &'static str,
    /// What it is, in one sentence.
    pub what: &'static str,
    /// Where it comes from: paper, section, equation.
    pub source: &'static str,
}
