//! Lines of a log.
//!
//! *Source*: ROS 2 rcl_interfaces (Jazzy).
//! *Parameters*: none.
//! *Deviations*: none.

use super::cdr::{Time, cdr};
use serde::Serialize;

/// How much a line of a log matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LogLevel {
    /// What was to be expected.
    Info = 20,
    /// What went wrong.
    Warn = 30,
}

/// A `Log`: a line by `name`.
pub fn log_line(t_ns: u64, level: LogLevel, name: &str, line: &str) -> Vec<u8> {
    #[derive(Serialize)]
    struct Message<'a> {
        stamp: Time,
        level: u8,
        name: &'a str,
        msg: &'a str,
        file: &'a str,
        function: &'a str,
        line: u32,
    }
    cdr(&Message { stamp: Time::new(t_ns), level: level as u8, name, msg: line, file: "", function: "", line: 0 })
}

#[cfg(test)]
mod tests {
    use super::super::messages::tests::is;
    use super::*;

    #[test]
    fn lines_keep_their_bytes() {
        is(
            &log_line(1_000_000_005, LogLevel::Warn, "a", "bc"),
            "0100000005000000 1e 000000 0200000061 00 0000 03000000626300 00 \
             01000000 00 000000 01000000 00 000000 00000000",
        );
    }
}
