//! Arguments of `rheotaxis picture`.

use super::cache::CacheArgs;
use super::key::KeyArgs;
use super::values::Numbers;
use std::path::PathBuf;

/// Arguments of `picture`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(after_help = PICTURE_AFTER)]
pub struct PictureArgs {
    /// Scenario file, or the name of a scenario that comes with the program.
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Position of the camera: metres east, north and up from the datum. Up is negative below the surface.
    #[arg(long, value_name = "EAST,NORTH,UP", allow_hyphen_values = true)]
    pub at: Numbers<3>,
    /// Direction of view: compass heading and angle below the horizon, degrees.
    #[arg(long, value_name = "HEADING,DOWN", default_value = "0,20", allow_hyphen_values = true)]
    pub look: Numbers<2>,
    /// File for the picture (PNG).
    #[arg(long, value_name = "FILE", default_value = "picture.png")]
    pub out: PathBuf,
    /// File for a second picture (PNG) with the truth. Red is how much the dye changes a pixel, blue is the share of a
    /// solid's light that arrives.
    #[arg(long, value_name = "FILE")]
    pub truth: Option<PathBuf>,
    /// Visibility in the water, m [default: the scenario's].
    #[arg(long, value_name = "M")]
    pub visibility: Option<f64>,
    /// Seed of all random numbers.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// The key of the runs.
    #[command(flatten)]
    pub key: KeyArgs,
    /// The cache of spin-ups.
    #[command(flatten)]
    pub cache: CacheArgs,
}

const PICTURE_AFTER: &str = "\
Examples:
  rheotaxis picture duck_st --at 30,40,-5 --look 90,20
  rheotaxis picture mine.ron --at=-3,0,-4.5 --look 85,30 --visibility 4 --out murky.png --truth truth.png

Exit codes: 0 the picture is written; 130 interrupted; 1 error; 2 wrong usage.";

/// What the help of this command begins with.
pub(super) const PICTURE_ABOUT: &str = "Lets a scenario's plume develop, takes one picture from a place of your choice, and writes it as a \
        PNG file.\n\n\
        Clarity and light of the water come from the scenario's `optics`. The camera is that of the first robot that \
        has one, or a default camera. The same scenario, seed and place give the same picture, bit by bit.";
