//! What `rheotaxis picture` can be asked.

use super::args_key::KeyArgs;
use std::path::PathBuf;
use std::str::FromStr;

/// Arguments of `picture`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(
    long_about = "Lets a scenario's plume develop, takes one picture of it from a place of your choice, and writes it as a PNG file. \
        Clarity and light are those of the scenario's `optics`, lens and sensor those of the first robot with a camera, or of a \
        default one. The same scenario, seed and place give the same picture, bit by bit.",
    after_help = PICTURE_AFTER
)]
pub struct PictureArgs {
    /// Scenario file, or the name of a scenario that comes with the program.
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Where the camera is: metres east, north and up (negative: below the surface).
    #[arg(long, value_name = "EAST,NORTH,UP", allow_hyphen_values = true)]
    pub at: Numbers<3>,
    /// Where it looks: compass heading and angle down from the horizon, degrees.
    #[arg(
        long,
        value_name = "HEADING,DOWN",
        default_value = "0,20",
        allow_hyphen_values = true
    )]
    pub look: Numbers<2>,
    /// The picture's file (PNG).
    #[arg(long, value_name = "FILE", default_value = "picture.png")]
    pub out: PathBuf,
    /// A second file (PNG) with the truth: red, how much the dye changes a pixel; blue, the light of a solid that arrives.
    #[arg(long, value_name = "FILE")]
    pub truth: Option<PathBuf>,
    /// Visibility in the water, metres, in place of the scenario's.
    #[arg(long, value_name = "M")]
    pub visibility: Option<f64>,
    /// Seed of all random numbers.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// The key of the runs.
    #[command(flatten)]
    pub key: KeyArgs,
}

const PICTURE_AFTER: &str = "\
Examples:
  rheotaxis picture duck_st --at 30,40,-5 --look 90,20
  rheotaxis picture mine.ron --at=-3,0,-4.5 --look 85,30 --visibility 4 --out murky.png --truth truth.png

Exit codes: 0 taken; 1 error; 2 usage.";

/// So many numbers with commas between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numbers<const N: usize>(pub [f64; N]);

impl<const N: usize> FromStr for Numbers<N> {
    type Err = String;
    fn from_str(s: &str) -> Result<Self, String> {
        let mut all = [0.0; N];
        let mut parts = s.split(',');
        for v in &mut all {
            *v = (parts.next())
                .and_then(|part| part.trim().parse().ok())
                .filter(|v: &f64| v.is_finite())
                .ok_or_else(|| format!("must be {N} numbers with commas between them"))?;
        }
        match parts.next() {
            None => Ok(Self(all)),
            Some(_) => Err(format!("must be {N} numbers with commas between them")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn so_many_numbers_and_no_others_are_read() {
        assert_eq!("1, -2.5,3e1".parse(), Ok(Numbers([1.0, -2.5, 30.0])));
        for wrong in ["", "1,2", "1,2,3,4", "1,2,x", "1,2,inf", "1,,3"] {
            let said = wrong.parse::<Numbers<3>>();
            assert_eq!(
                said,
                Err("must be 3 numbers with commas between them".into()),
                "{wrong}"
            );
        }
    }
}
