//! The runs of a campaign: their number, their seeds and their scenarios.

use super::error::CampaignError;
use super::spec::{Arm, CampaignSpec, Conditions};
use super::threads::with_threads;
use rayon::prelude::*;
pub(super) use rheotaxis::scenario::hash;
use rheotaxis::scenario::{Loaded, set_value};
use rheotaxis::trial::controlled;
use std::collections::BTreeSet;
use std::path::Path;
use world::seeds::{Key, Seed};

/// A campaign, read and laid out.
#[derive(Clone, Debug)]
pub struct Campaign {
    /// The content of its file.
    pub spec: CampaignSpec,
    /// Name: that of the file, without its ending.
    pub name: String,
    /// The name that errors use: the file as it was asked for.
    pub shown: String,
    /// The file, word for word.
    pub text: String,
    /// Hash of the text, 32 hexadecimal digits.
    pub hash: String,
    /// The scenario that arms and conditions change; they may ask for what its registry adds.
    pub base: Loaded,
    /// The key of its runs.
    pub key: Key,
}

/// The position of a run in its campaign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RunPlace {
    /// Index of the run.
    pub run: u64,
    /// Index of its condition.
    pub condition: u64,
    /// Index of the seed.
    pub seed_index: u64,
    /// Index of its arm.
    pub arm: usize,
    /// Its seed. It is the same for every arm (common random numbers) and that of `rheotaxis run --seed`.
    pub seed: Seed,
}

impl Campaign {
    /// Makes a campaign from its parts, which have been read; errors call it `shown`.
    ///
    /// # Errors
    /// If the text is not a campaign.
    pub fn new(shown: &str, name: &str, text: &str, base: Loaded) -> Result<Self, CampaignError> {
        Ok(Self {
            spec: CampaignSpec::parse(shown, text)?,
            name: name.to_string(),
            shown: shown.to_string(),
            text: text.to_string(),
            hash: hash(text),
            base,
            key: Key::public(),
        })
    }

    /// Number of runs.
    pub fn n_runs(&self) -> u64 {
        self.spec.n_runs()
    }

    /// Number of arms.
    pub fn n_arms(&self) -> u64 {
        self.spec.n_arms()
    }

    /// Number of arms under each condition, times conditions.
    pub fn n_cells(&self) -> u64 {
        self.spec.n_conditions() * self.n_arms()
    }

    /// The arm with an index.
    pub fn arm(&self, arm: usize) -> &Arm {
        &self.spec.arms[arm]
    }

    /// Position of a run: arms of one seed are neighbours, then seeds, then conditions.
    pub fn place(&self, run: u64) -> RunPlace {
        let (group, seeds) = (run / self.n_arms(), self.spec.seeds);
        let (condition, seed_index) = match &self.spec.until {
            None => (group / seeds.count(), group % seeds.count()),
            // Seed by seed, so that a campaign that ends early has the same number of runs of each condition.
            Some(_) => (group % self.spec.n_conditions(), group / self.spec.n_conditions()),
        };
        RunPlace {
            run,
            condition,
            seed_index,
            arm: (run % self.n_arms()) as usize,
            seed: self.key.seed(seeds.seed(condition, seed_index)),
        }
    }

    /// The paths and values that a condition sets.
    pub fn condition(&self, condition: u64) -> Vec<(String, String)> {
        match &self.spec.conditions {
            Conditions::Single => Vec::new(),
            Conditions::Grid(axes) => {
                let mut rest = condition;
                let mut set: Vec<(String, String)> = Vec::new();
                for (path, values) in axes.iter().rev() {
                    let n = values.len() as u64;
                    set.push((path.clone(), values[(rest % n) as usize].clone()));
                    rest /= n;
                }
                set.reverse();
                set
            }
            Conditions::Random(random) => random.set("condition", condition),
        }
    }

    /// The condition's name in rows of the table: `path=value; path=value`.
    pub fn condition_name(&self, condition: u64) -> String {
        let set = self.condition(condition);
        let named: Vec<String> = set.iter().map(|(p, v)| format!("{p}={v}")).collect();
        named.join("; ")
    }

    /// The scenario of an arm under a condition.
    ///
    /// # Errors
    /// If a path leads nowhere, or the scenario does not allow a value; both name the arm.
    pub fn loaded(&self, condition: u64, arm: usize) -> Result<Loaded, CampaignError> {
        let (shown, text) = self.text_of(condition, arm)?;
        Ok(self.base.with_text(Path::new(&shown), text)?)
    }

    /// What errors call the scenario of an arm under a condition, and its text.
    fn text_of(&self, condition: u64, arm: usize) -> Result<(String, String), CampaignError> {
        let named = self.condition_name(condition);
        let mut shown = format!("{} (arm {}", self.base.name, self.arm(arm).name);
        if !named.is_empty() {
            shown.push_str(&format!(", {named}"));
        }
        shown.push(')');
        let mut text = self.base.text().into_owned();
        let condition = self.condition(condition);
        for (path, value) in condition.iter().chain(&self.arm(arm).set) {
            text = set_value(&text, path, value).map_err(|problem| CampaignError::Override {
                variant: shown.clone(),
                path: path.clone(),
                problem,
            })?;
        }
        Ok((shown, text))
    }

    /// Reads and checks every arm under every condition, so that no campaign starts that must fail. Warnings are not
    /// shown: `rheotaxis check` gives those of the base.
    ///
    /// # Errors
    /// The first mistake, in the order of conditions and arms.
    pub fn check(&self) -> Result<(), CampaignError> {
        with_threads(|| self.check_all())
    }

    fn check_all(&self) -> Result<(), CampaignError> {
        let arms = self.spec.arms.len();
        let variants = self.spec.n_conditions() * arms as u64;
        let place = |i: u64| (i / arms as u64, (i % arms as u64) as usize);
        // Draws from a few values make the same scenario again and again: each is checked once.
        let hash_of = |(condition, arm)| Ok(hash(&self.text_of(condition, arm)?.1));
        let hashes: Vec<(u64, Result<String, CampaignError>)> =
            (0..variants).into_par_iter().map(|i| (i, hash_of(place(i)))).collect();
        let mut known = BTreeSet::new();
        let new = |(_, hash): &(u64, Result<String, CampaignError>)| {
            hash.as_ref().map_or(true, |hash| known.insert(hash.clone()))
        };
        let new: Vec<_> = hashes.into_iter().filter(new).collect();
        let one = |i: u64| -> Result<(), CampaignError> {
            let loaded = self.loaded(place(i).0, place(i).1)?;
            loaded.check()?;
            match controlled(&loaded.scenario) {
                asking if asking.is_empty() => Ok(()),
                asking => Err(CampaignError::Outside { arm: loaded.name.clone(), robots: asking.join(", ") }),
            }
        };
        let first = (new.into_par_iter())
            .filter_map(|(i, hash)| {
                let found = hash.and_then(|_| one(i));
                found.err().map(|e| (i, e))
            })
            .min_by_key(|(i, _)| *i);
        first.map_or(Ok(()), |(_, error)| Err(error))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rheotaxis::scenario;
    use world::registry::Registry;

    fn campaign(rest: &str) -> Campaign {
        campaign_with(&Registry::default(), rest)
    }

    fn campaign_with(registry: &Registry, rest: &str) -> Campaign {
        let base = scenario::load_with(registry, Path::new("uniform_channel")).unwrap();
        let text = format!("(version: 2, title: \"t\", base: \"uniform_channel\", {rest})");
        Campaign::new("c.ron", "c", &text, base).unwrap()
    }

    /// Systems and topics of other crates are in every run, on whatever thread it is made.
    #[test]
    fn every_arm_keeps_the_registry_of_the_base() {
        let registry = Registry::default().carrying(7_u8);
        let arm = campaign_with(&registry, ARMS).loaded(0, 1).unwrap();
        assert_eq!(arm.registry.carried::<u8>().collect::<Vec<_>>(), [&7]);
    }

    const ARMS: &str =
        r#"seeds: 3, arms: [(name: "slow", set: [("robots[0].strategy.speed_m_s", "1")]), (name: "fast")]"#;

    #[test]
    fn arms_share_seeds_and_so_do_conditions_unless_they_are_hashed() {
        let c = campaign(&format!(
            r#"{ARMS}, conditions: Grid([("time.limit_s", ["10", "20"]), ("sources[0].rate_g_s", ["1", "2"])])"#
        ));
        assert_eq!(c.n_runs(), 24);
        let places: Vec<RunPlace> = (0..24).map(|run| c.place(run)).collect();
        for pair in places.chunks(2) {
            assert_eq!(pair[0].seed, pair[1].seed);
            assert_eq!((pair[0].arm, pair[1].arm), (0, 1));
        }
        // Three seeds under each condition: the first three of the campaign.
        for (k, place) in places.iter().enumerate() {
            assert_eq!(place.seed.number(), 1 + k as u64 / 2 % 3);
        }
        let grid = format!("{ARMS}, conditions: Grid([(\"time.limit_s\", [\"10\", \"20\"])])");
        let hashed = campaign(&grid.replace("seeds: 3", "seeds: Hashed(seed: 1, count: 3)"));
        let seeds: BTreeSet<u64> = (0..12).map(|run| hashed.place(run).seed.number()).collect();
        assert_eq!(seeds.len(), 6);
        assert_eq!(c.condition_name(1), "time.limit_s=10; sources[0].rate_g_s=2");
        assert_eq!(c.condition_name(2), "time.limit_s=20; sources[0].rate_g_s=1");
        assert_eq!(places[12].condition, 2);
        let changed = c.loaded(2, 0).unwrap().scenario;
        assert_eq!(changed.time.limit_s.get(), 20.0);
        assert_ne!(changed.robots, c.base.scenario.robots);
        c.check().unwrap();
    }

    #[test]
    fn draws_stay_within_their_range_and_repeat() {
        let c = campaign(&format!(
            r#"{ARMS}, conditions: Random(n: 50, draw: [("time.limit_s", LogUniform(10, 1000)), ("terrain.depth_m", Choice(["9", "11"]))])"#
        ));
        let limits: Vec<f64> = (0..50).map(|i| c.loaded(i, 0).unwrap().scenario.time.limit_s.get()).collect();
        assert!(limits.iter().all(|l| (10.0..1000.0).contains(l)));
        // Half of them lie below the geometric mean: 25 of 50, standard deviation 3.5; five of these are allowed.
        let below = limits.iter().filter(|l| **l < 100.0).count();
        assert!((8..=42).contains(&below), "{below}");
        assert_eq!(c.condition_name(7), c.clone().condition_name(7));
    }

    #[test]
    fn the_least_time_limit_counts() {
        let limit_s = |rest: &str| campaign(rest).limit_s().unwrap();
        let base = campaign(ARMS).base.scenario.time.limit_s.get();
        assert_eq!(limit_s(ARMS), base);
        assert_eq!(limit_s(&format!(r#"{ARMS}, conditions: Grid([("time.limit_s", ["30", "20"])])"#)), 20.0);
        let arm = r#"seeds: 3, arms: [(name: "a"), (name: "b", set: [("time.limit_s", "9")])]"#;
        assert_eq!(limit_s(arm), 9.0);
    }

    #[test]
    fn mistakes_in_an_arm_are_the_loaders_and_name_it() {
        for (path, value, says) in [
            ("time.limit_s", "-1", "time.limit_s: must be > 0"),
            ("time.limits", "1", "there is no field `limits`"),
            ("sources[0].east_m", "9000", "sources[0]"),
            ("robots[4].id", "1", "`robots` has no element 4"),
        ] {
            let arms = format!(r#"[(name: "good"), (name: "odd", set: [("{path}", "{value}")])]"#);
            let said = match campaign(&format!("seeds: 1, arms: {arms}")).check().unwrap_err() {
                CampaignError::Scenario(e) => e.lines().join("\n"),
                other => other.to_string(),
            };
            assert!(said.starts_with("uniform_channel (arm odd):") && said.contains(says), "{said}");
        }
    }
}
