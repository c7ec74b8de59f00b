//! What `rheotaxis segment` and `rheotaxis score-vision` can be asked.

use robots::vision::{ColourSpec, Edges, VerifierSpec};
use std::path::PathBuf;
use world::ranges::{NonNegative, Positive};

/// Arguments of `segment`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(
    long_about = "Takes a picture apart with the fuzzy colour extractor of Tian et al. 2013, section 5, and judges whether it \
        shows a source giving off dye.\n\n\
        A pass looks for the colour in the picture that is nearest a reference, its colour pattern, and takes all pixels alike to it: \
        those whose fuzzy difference is below epsilon. What is taken turns white, and the next pass looks at what is left. Three \
        passes go towards RED (255, 0, 0): their union is the plume; then four towards DARK-BLUE (0, 0, 128): the source. Of \
        each group only the passes whose patterns lie near the first one's (delta1, delta2) are kept.\n\n\
        Leaves, in the folder, pass-N.png (what each pass took), plume.png and source.png (all passes united), plume-kept.png and \
        source-kept.png, their masks, left.png, overlay.png, clusters.svg and .png (the colour patterns with their distances), sheet.png (all \
        on one sheet) and segmentation.json (all numbers).\n\n\
        Pictures may be PNG, JPEG, BMP, PNM, TIFF or WebP of any size from 1 x 1 to 64 million pixels, grey or coloured, 8 \
        or 16 bits. White is what is not there; what is transparent is laid on white.",
    after_help = SEGMENT_AFTER
)]
pub struct SegmentArgs {
    /// The picture.
    #[arg(value_name = "IMAGE")]
    pub image: PathBuf,
    /// Folder for the results; without it `runs/IMAGE-segmented`.
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
  rheotaxis segment hazy.jpg --dehaze --give-back   as the simulated vehicle does

Exit codes: 0 done, whatever the picture shows; 1 error; 2 usage.";

/// Parameters of the extractor; levels are those of 8 bits, 0 to 255.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(next_help_heading = "Parameters, by default the paper's (levels from 0 to 255)")]
pub struct ColourArgs {
    /// Differences in a channel up to this are none.
    #[arg(long, value_name = "LEVELS", default_value = "35", value_parser = at_least_zero)]
    pub alpha1: NonNegative,
    /// From this on they are whole.
    #[arg(long, value_name = "LEVELS", default_value = "200", value_parser = above_zero)]
    pub alpha2: Positive,
    /// Width of the output sets Matched and Unmatched.
    #[arg(long, value_name = "LEVELS", default_value = "20", value_parser = above_zero)]
    pub rho_m: Positive,
    /// A pixel is taken if its fuzzy difference is below this.
    #[arg(long, value_name = "LEVELS", default_value = "80", value_parser = above_zero)]
    pub epsilon: Positive,
    /// Passes towards RED.
    #[arg(long, value_name = "N", default_value_t = 3)]
    pub plume_passes: u8,
    /// Passes towards DARK-BLUE.
    #[arg(long, value_name = "N", default_value_t = 4)]
    pub source_passes: u8,
    /// A pass is dropped if its pattern is farther from the reference than the nearest one by more than this.
    #[arg(long, value_name = "LEVELS", default_value = "40", value_parser = at_least_zero)]
    pub delta1: NonNegative,
    /// Or if the shortest way from it to the nearest one, over the others, is longer than this.
    #[arg(long, value_name = "LEVELS", default_value = "45", value_parser = at_least_zero)]
    pub delta2: NonNegative,
    /// What a way between two patterns measures.
    #[arg(long, value_enum, default_value_t = EdgesArg::Colours)]
    pub edges: EdgesArg,
    /// Put pixels of dropped plume passes back before the source is looked for (not in the paper).
    #[arg(long)]
    pub give_back: bool,
    /// First take out what changes slowly over the picture and bring each colour to the whole range of levels (not in the paper).
    #[arg(long)]
    pub dehaze: bool,
}

/// What a way between two colour patterns measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum EdgesArg {
    /// The distance of their colours.
    Colours,
    /// The difference of their distances to the reference.
    Reference,
}

impl ColourArgs {
    /// As the verifier takes them, or the flag that does not go with the others.
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
            None => Ok(VerifierSpec {
                colours,
                ..VerifierSpec::default()
            }),
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
#[command(
    long_about = "Renders scenes whose truth is known and scores how well dye and source are found in them.\n\n\
        Every other scene shows a source (1.0 m by 0.5 m, dark) giving off rhodamine into a turbulent stream, the others dye alone, a like body \
        that gives off nothing, or bare bed. Visibility goes evenly from 1.5 to 24 m in four ranges; light, sun, current, strength of \
        the dye, place and direction of the camera are drawn at random from the seed.\n\n\
        Scored are several readings of the extractor of Tian et al. 2013 and plain thresholds: precision and recall of the pixels of \
        dye (its light changes by a tenth or more) and source (2 % of its light arrives), and the verdicts as a curve of \
        true against false verifications, each by range of visibility with 95 % intervals.\n\n\
        Leaves scores.md, scores.csv, scores.json, scenes.csv, pixels.svg and .png, roc.svg and .png.",
    after_help = "Examples:\n  rheotaxis score-vision\n  rheotaxis score-vision --scenes 48 --pictures 48 --out look\n  \
        rheotaxis score-vision --seed 2 --scenes 960\n\n\
        Exit codes: 0 done, whatever the figures say; 130 interrupted; 1 error; 2 usage."
)]
pub struct ScoreVisionArgs {
    /// How many scenes.
    #[arg(long, value_name = "N", default_value_t = 240, value_parser = clap::value_parser!(u64).range(1..=100_000))]
    pub scenes: u64,
    /// Seed of the scenes.
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    pub seed: u64,
    /// Width of the pictures, px; their height is three quarters of it.
    #[arg(long, value_name = "PX", default_value_t = 320, value_parser = clap::value_parser!(u32).range(4..=2048))]
    pub width: u32,
    /// Also write the first N pictures with their truth into the folder.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub pictures: u64,
    /// Scenes at a time; 0 for one on each core.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub jobs: usize,
    /// Folder for the results.
    #[arg(long, value_name = "DIR", default_value = "runs/score-vision")]
    pub out: PathBuf,
    /// Show no progress.
    #[arg(long, short)]
    pub quiet: bool,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Of {
        #[command(flatten)]
        segment: SegmentArgs,
    }

    fn spec(args: &[&str]) -> Result<VerifierSpec, String> {
        let all = ["segment", "a.png"].iter().chain(args);
        Of::parse_from(all).segment.colours.spec()
    }

    #[test]
    fn defaults_are_the_papers_and_flags_go_through() {
        assert_eq!(spec(&[]).unwrap().colours, ColourSpec::default());
        let haze = spec(&["--give-back", "--dehaze"]).unwrap();
        assert_eq!(haze, VerifierSpec::default());
        let got = spec(&["--epsilon", "60", "--give-back", "--edges", "reference"])
            .unwrap()
            .colours;
        assert_eq!(
            (got.epsilon.get(), got.give_back, got.edges),
            (60.0, true, Edges::Reference)
        );
    }

    #[test]
    fn what_does_not_go_together_names_its_flag() {
        let said = spec(&["--alpha1", "210"]).unwrap_err();
        assert_eq!(said, "--alpha1 must be below alpha2 (200), got 210");
        for bad in ["0", "-3", "nan", "x"] {
            assert!(above_zero(bad).is_err(), "{bad}");
        }
    }
}
