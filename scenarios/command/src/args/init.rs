//! Arguments of `rheotaxis init`.

use std::path::PathBuf;

/// Arguments of `init`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(after_help = "Examples:\n  rheotaxis init\n  rheotaxis init duck_st mine.ron\n  \
        rheotaxis init --gantry .")]
pub struct InitArgs {
    /// Name of a scenario that comes with the program.
    pub template: Option<String>,
    /// File to write, or the folder to write it in [default: TEMPLATE.ron in this folder].
    pub path: Option<PathBuf>,
    /// Write the URDF of the built-in gantry into this folder instead: its slides and where each probe sits.
    #[arg(long, value_name = "FOLDER", conflicts_with = "template")]
    pub gantry: Option<PathBuf>,
}
