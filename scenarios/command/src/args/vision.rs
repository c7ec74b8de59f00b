//! Arguments of `rheotaxis segment` and `rheotaxis score-vision`.

use robots::strategy::{ColourSpec, Edges, VerifierSpec};
use std::path::PathBuf;
use world::ranges::{NonNegative, Positive};

/// Arguments of `segment`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(after_help = SEGMENT_AFTER)]
pub struct SegmentArgs {
    /// Picture to examine; of several, only the verdicts are printed, with their rate.
    #[arg(value_name = "IMAGE", required = true)]
    pub images: Vec<PathBuf>,
    /// Folder for the results of one picture [default: runs/IMAGE-segmented].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// How colours are told apart.
    #[command(flatten)]
    pub colours: ColourArgs,
}

const SEGMENT_AFTER: &str = "\
Examples:
  rheotaxis segment dive.jpg
  rheotaxis segment dive.jpg --out seen --epsilon 60
  rheotaxis segment hazy.jpg --dehaze --give-back   # as the simulated vehicle does
  rheotaxis segment dives/*.jpg --dehaze --give-back   # how often your pictures raise a false alarm

Exit codes: 0 done, whatever the picture shows; 1 error; 2 wrong usage.";

/// Parameters of the extractor. Levels are those of 8 bits, 0 to 255.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(next_help_heading = "Parameters (defaults as in the paper; levels from 0 to 255)")]
pub struct ColourArgs {
    /// A difference in a channel up to this counts as none.
    #[arg(long, value_name = "LEVELS", default_value = "35", value_parser = at_least_zero)]
    pub alpha1: NonNegative,
    /// A difference from this on counts as full.
    #[arg(long, value_name = "LEVELS", default_value = "200", value_parser = above_zero)]
    pub alpha2: Positive,
    /// Width of the fuzzy output sets Matched and Unmatched.
    #[arg(long, value_name = "LEVELS", default_value = "20", value_parser = above_zero)]
    pub rho_m: Positive,
    /// A pixel is taken if its fuzzy difference is below this value.
    #[arg(long, value_name = "LEVELS", default_value = "80", value_parser = above_zero)]
    pub epsilon: Positive,
    /// Passes with the reference RED, for the plume.
    #[arg(long, value_name = "N", default_value_t = 3)]
    pub plume_passes: u8,
    /// Passes with the reference DARK-BLUE, for the source.
    #[arg(long, value_name = "N", default_value_t = 4)]
    pub source_passes: u8,
    /// Drop a pass if its pattern is farther from the reference than the nearest pattern, by more than this.
    #[arg(long, value_name = "LEVELS", default_value = "40", value_parser = at_least_zero)]
    pub delta1: NonNegative,
    /// Drop a pass if the shortest path from its pattern to the nearest pattern, over the others, is longer than this.
    #[arg(long, value_name = "LEVELS", default_value = "45", value_parser = at_least_zero)]
    pub delta2: NonNegative,
    /// What the length of a path between two patterns is.
    #[arg(long, value_enum, default_value_t = EdgesArg::Colours)]
    pub edges: EdgesArg,
    /// Put the pixels of dropped plume passes back before the search for the source (not in the paper).
    #[arg(long)]
    pub give_back: bool,
    /// First remove what changes slowly over the picture, and stretch each colour to the full range of levels (not in
    /// the paper).
    #[arg(long)]
    pub dehaze: bool,
}

/// What the length of a path between two colour patterns is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum EdgesArg {
    /// The distance of their colours.
    Colours,
    /// The difference of their distances to the reference.
    Reference,
}

impl ColourArgs {
    /// The parameters as the verifier takes them, or the flag that contradicts the others.
    ///
    /// # Errors
    /// Names the flag and its legal range.
    pub fn spec(&self) -> Result<VerifierSpec, String> {
        let colours = ColourSpec {
            alpha1: self.alpha1,
            alpha2: self.alpha2,
            rho_m: self.rho_m,
            epsilon: self.epsilon,
            plume_passes: self.plume_passes,
            source_passes: self.source_passes,
            delta1: self.delta1,
            delta2: self.delta2,
            edges: match self.edges {
                EdgesArg::Colours => Edges::Colours,
                EdgesArg::Reference => Edges::Reference,
            },
            give_back: self.give_back,
            dehaze: self.dehaze,
        };
        match colours.fault() {
            Some((field, problem)) => Err(format!("--{} {problem}", field.replace('_', "-"))),
            None => Ok(VerifierSpec { colours, ..VerifierSpec::default() }),
        }
    }
}

fn number<T: TryFrom<f64, Error = String>>(s: &str) -> Result<T, String> {
    let v: f64 = s.parse().map_err(|_| "must be a number".to_string())?;
    T::try_from(v)
}

fn above_zero(s: &str) -> Result<Positive, String> {
    number(s)
}

fn at_least_zero(s: &str) -> Result<NonNegative, String> {
    number(s)
}

/// Arguments of `score-vision`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(after_help = "Examples:\n  rheotaxis score-vision\n  \
        rheotaxis score-vision --scenes 48 --pictures 48 --out look\n  \
        rheotaxis score-vision --seed 2 --scenes 960\n\n\
        Exit codes: 0 done, whatever the figures say; 130 interrupted; 1 error; 2 wrong usage.")]
pub struct ScoreVisionArgs {
    /// Number of scenes.
    #[arg(long, value_name = "N", default_value_t = 240,
        value_parser = clap::value_parser!(u64).range(1..=100_000))]
    pub scenes: u64,
    /// Seed of the scenes.
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    pub seed: u64,
    /// Width of the pictures, px. Their height is three quarters of it.
    #[arg(long, value_name = "PX", default_value_t = 320, value_parser = clap::value_parser!(u32).range(4..=2048))]
    pub width: u32,
    /// Also write the first N pictures with their truth into the folder.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub pictures: u64,
    /// Scenes at the same time; 0 means one on each core.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub jobs: usize,
    /// Folder for the results.
    #[arg(long, value_name = "DIR", default_value = "runs/score-vision")]
    pub out: PathBuf,
    /// Do not show progress.
    #[arg(long, short)]
    pub quiet: bool,
}

/// What the help of this command begins with.
pub(super) const SEGMENT_ABOUT: &str = "Separates dye and source from the rest of a picture with the fuzzy colour extractor of Tian et al. \
        2013, section 5, and judges whether the picture shows a source that gives off dye.\n\n\
        A pass finds the colour in the picture that is nearest to a reference colour, its colour pattern. It takes all \
        pixels whose fuzzy difference from the pattern is below epsilon and turns them white for the next pass. Three \
        passes use RED (255, 0, 0) as the reference; together they are the plume. Four use DARK-BLUE (0, 0, 128); \
        together they are the source. In each group only the passes whose patterns lie near the first one's are kept \
        (delta1, delta2).\n\n\
        The folder then holds sheet.png (everything on one sheet), overlay.png, pass-N.png (what each pass took), \
        plume.png and source.png (all passes), plume-kept.png and source-kept.png with their masks, left.png (what no \
        pass took), clusters.svg and .png (the colour patterns and their distances) and segmentation.json (all \
        numbers).\n\n\
        A picture may be PNG, JPEG, BMP, PNM, TIFF or WebP, grey or colour, 8 or 16 bits, with up to 64 million \
        pixels. White counts as empty, and transparent pixels are laid on white.";

/// What the help of this command begins with.
pub(super) const SCORE_VISION_ABOUT: &str = "Renders underwater scenes whose truth is known, and scores how well dye and source are found in \
        them.\n\n\
        Half of the scenes show a dark source of 1.0 m by 0.5 m that releases rhodamine into a turbulent stream. The \
        others show dye alone, a similar body that releases nothing, or the bare bed. The visibility is 1.5 to 24 m, \
        evenly spread over four ranges. Light, sun, current, strength of the dye and pose of the camera are drawn at \
        random from the seed.\n\n\
        Several readings of the extractor of Tian et al. 2013 and plain thresholds are scored, each by range of \
        visibility and with 95 % intervals: precision and recall for pixels of dye (it changes their light by a tenth \
        or more) and of the source (at least 2 % of its light arrives), and true against false verifications.\n\n\
        The results are scores.md, scores.csv, scores.json, scenes.csv, pixels.svg and .png, roc.svg and .png.";
