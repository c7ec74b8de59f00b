//! `--key`: the secret that a contest gives its runs beside the seed.

use world::seeds::{Key, Seed};

/// The key of the runs.
#[derive(Clone, Debug, Default, PartialEq, Eq, clap::Args)]
pub struct KeyArgs {
    /// Secret text on which all random numbers depend beside the seed. Without it, anyone who knows the seed can
    /// compute every random number of the run. The text itself is stored nowhere; summary.json and campaign.json hold
    /// a hash, by which it is recognised. Use at least 20 random characters. The environment variable keeps the text
    /// out of the list of processes. An empty text is none, and is refused.
    #[arg(
        long,
        value_name = "TEXT",
        env = "RHEOTAXIS_KEY",
        value_parser = clap::builder::NonEmptyStringValueParser::new(),
        hide_env_values = true
    )]
    pub key: Option<String>,
}

impl KeyArgs {
    /// The key; the public one if none was given.
    pub fn get(&self) -> Key {
        self.key.as_deref().map_or_else(Key::public, Key::secret)
    }

    /// The seed of a number under the key.
    pub fn seed(&self, number: u64) -> Seed {
        self.get().seed(number)
    }
}
