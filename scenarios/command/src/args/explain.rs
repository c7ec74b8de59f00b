//! Arguments of `rheotaxis explain`.

/// Arguments of `explain`.
#[derive(Clone, Debug, PartialEq, Eq, clap::Args)]
#[command(after_help = "Examples:\n  rheotaxis explain water.currents.Meander\n  \
        rheotaxis explain robots.strategy.reacquire\n  \
        rheotaxis explain 'robots[0].strategy.Amp.reacquire.Bowtie'\n  \
        rheotaxis explain campaign.conditions\n  \
        rheotaxis explain vehicle.hydrodynamics\n  \
        rheotaxis explain track.csv\n\n\
        Exit codes: 0 explained; 1 there is no such path, and the nearest ones are shown; 2 wrong usage.")]
pub struct ExplainArgs {
    /// Path of a field or variant, such as `robots[0].strategy.reacquire` or `campaign.arms`, or name of a table.
    #[arg(value_name = "PATH")]
    pub path: Option<String>,
    /// Print the whole reference as Markdown instead (docs/reference.md).
    #[arg(long, conflicts_with_all = ["path", "json_schema"])]
    pub markdown: bool,
    /// Print a JSON Schema of scenarios instead, for programs that write them.
    #[arg(long, conflicts_with = "path")]
    pub json_schema: bool,
}

/// What the help of this command begins with.
pub(super) const EXPLAIN_ABOUT: &str = "Explains a field of a scenario file: its unit, legal range, default and meaning, and for an \
        algorithm the paper it comes from; also the fields of a campaign file (`campaign`) and of a vehicle's \
        `vehicle.ron` (`vehicle`), and the columns of a table (`track.csv`). The text is made from the types that read \
        and write these files, so it always fits this program.\n\n\
        PATH is written as in error messages. You may leave out the numbers of list elements and the names of \
        variants; then every variant that has the field is shown. Without PATH, the blocks of a scenario are shown.";
