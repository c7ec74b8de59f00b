//! What `rheotaxis explain` can be asked.

/// Arguments of `explain`.
#[derive(Clone, Debug, PartialEq, Eq, clap::Args)]
#[command(
    long_about = "Explains what a scenario file may say: of every field its unit, legal range, default, meaning and, of algorithms, \
        the paper they come from. Made from the types that read a scenario, so it says what this program does.\n\n\
        PATH is one of those that errors name. Numbers of elements may be left out, and so may names of variants: then every variant \
        that has the field is shown. Alone it shows the top of a scenario.",
    after_help = "Examples:\n  rheotaxis explain water.currents.Meander\n  rheotaxis explain robots.strategy.reacquire\n  \
        rheotaxis explain 'robots[0].strategy.Amp.reacquire.Bowtie'\n  rheotaxis explain --json-schema > scenario.schema.json\n\n\
        Exit codes: 0 explained; 1 nothing has this path: the nearest that are legal are shown; 2 usage."
)]
pub struct ExplainArgs {
    /// Path of a field or variant, such as `robots[0].strategy.reacquire`; without it the top of a scenario.
    #[arg(value_name = "PATH")]
    pub path: Option<String>,
    /// Print the whole reference as Markdown instead (docs/reference.md).
    #[arg(long, conflicts_with_all = ["path", "json_schema"])]
    pub markdown: bool,
    /// Print a JSON Schema of scenario files instead, for editors (docs/scenario.schema.json).
    #[arg(long, conflicts_with = "path")]
    pub json_schema: bool,
}
