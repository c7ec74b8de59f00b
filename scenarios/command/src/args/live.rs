//! Arguments of the commands that show live state: `topics` and `listen`.

use std::num::NonZeroU64;
use std::path::PathBuf;

/// Arguments of `topics`.
#[derive(Clone, Debug, PartialEq, Eq, clap::Args)]
#[command(
    after_help = "Examples:\n  rheotaxis topics\n  rheotaxis topics --schema > schemas.json\n  rheotaxis topics --ros2"
)]
pub struct TopicsArgs {
    /// Print the JSON Schemas of all messages instead, as one object. With --ros2: definition and hash of each type.
    #[arg(long)]
    pub schema: bool,
    /// List the topics that `rheotaxis run --ros2` publishes, with type and QoS.
    #[arg(long)]
    pub ros2: bool,
}

/// What the help of this command begins with.
pub(super) const TOPICS_ABOUT: &str = "Lists the keys under which a run publishes its state over zenoh: each with its rate, its meaning and \
        its fields. A `?` marks a field that may be missing. With --ros2 it lists the topics of ROS 2 instead.";

/// Arguments of `listen`.
#[derive(Clone, Debug, PartialEq, Eq, clap::Args)]
#[command(after_help = LISTEN_AFTER)]
pub struct ListenArgs {
    /// Key of the messages to print, as `rheotaxis topics` lists them [default: all but the schemas].
    ///
    /// `*` stands for one part between slashes, `**` for any number of them. A key that begins with `rheotaxis/` names
    /// its run: rheotaxis/duck_st_1/clock.
    pub key: Option<String>,
    /// End after so many messages.
    #[arg(long, value_name = "N")]
    pub count: Option<NonZeroU64>,
    /// Go on when all runs have ended, and wait for the next one.
    #[arg(long)]
    pub follow: bool,
    /// Endpoint of the run, as `rheotaxis run` prints it [default: tcp/127.0.0.1:7447 to 7510, where runs listen].
    #[arg(long, value_name = "ENDPOINT")]
    pub connect: Option<String>,
    /// Configuration file of zenoh (JSON5), for a user's password or TLS: docs/zenoh/as_user.json5 and over_tls.json5.
    #[arg(long, value_name = "FILE")]
    pub zenoh_config: Option<PathBuf>,
}

/// What the help of this command begins with.
pub(super) const LISTEN_ABOUT: &str = "Prints what runs on this machine publish over zenoh, one JSON object a line: `key`, and the `message`. Of \
        packed numbers (plume, maps, sidescan) `message` is the header, and `packed` has their count, least, greatest \
        and mean, column by column where the header names columns; of a picture, `jpeg` has the size.\n\n\
        Start it before, during or after a run: it waits for one, begins with the newest message of each key, and \
        ends when all the runs it has found say that they have ended. It cannot slow a run down: who reads too slowly \
        misses messages.";

const LISTEN_AFTER: &str = "\
Examples:
  rheotaxis listen                              everything, until the run ends
  rheotaxis listen clock                        simulated time, and whether the run has ended
  rheotaxis listen 'auv/*/truth' --count 10     ten poses
  rheotaxis listen plume | head -n 1            how large the plume is now
  rheotaxis listen 'rheotaxis/duck_st_1/**' --follow

Exit codes: 0 all runs have ended, or N messages are printed; 130 interrupted; 1 error, or a run is gone that did not
say that it ended; 2 wrong usage.";
