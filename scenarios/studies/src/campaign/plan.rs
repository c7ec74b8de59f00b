//! The runs of a campaign: their number, their seeds and their scenarios.

use super::error::CampaignError;
use super::spec::{Arm, CampaignSpec, Conditions};
use super::threads::with_threads;
use crate::draw::number;
use crate::fill::fill;
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

    /// The scenario of a run.
    ///
    /// # Errors
    /// If a path leads nowhere, or the scenario does not allow a value; both name the arm.
    pub fn of_run(&self, place: &RunPlace) -> Result<Loaded, CampaignError> {
        self.loaded(place.condition, place.arm, &|path| number(place.seed, path))
    }

    /// The scenario of an arm under a condition, with the middle of all that is drawn for a seed.
    ///
    /// # Errors
    /// As [`Campaign::of_run`].
    pub fn typical(&self, condition: u64, arm: usize) -> Result<Loaded, CampaignError> {
        self.loaded(condition, arm, &|_| 0.5)
    }

    fn loaded(&self, condition: u64, arm: usize, number: &dyn Fn(&str) -> f64) -> Result<Loaded, CampaignError> {
        let (shown, text) = self.text_of(condition, arm, number)?;
        Ok(self.base.with_text(Path::new(&shown), text)?)
    }

    /// What errors call the scenario of an arm under a condition, and its text, where `number` is the number from 0
    /// to 1 of a path that is drawn for a seed.
    fn text_of(
        &self,
        condition: u64,
        arm: usize,
        number: &dyn Fn(&str) -> f64,
    ) -> Result<(String, String), CampaignError> {
        let named = self.condition_name(condition);
        let mut shown = format!("{} (arm {}", self.base.name, self.arm(arm).name);
        if !named.is_empty() {
            shown.push_str(&format!(", {named}"));
        }
        shown.push(')');
        let wrong =
            |path: &str, problem| CampaignError::Override { variant: shown.clone(), path: path.to_string(), problem };
        let mut text = self.base.text().into_owned();
        let mut all = self.condition(condition);
        let arm = self.arm(arm);
        let drawn = self.spec.draw.iter().filter(|draw| draw.in_arm(&arm.name));
        let drawn: Vec<_> = drawn.map(|draw| (draw.path.clone(), draw.value(number(&draw.path)))).collect();
        all.extend_from_slice(&drawn);
        for (path, value) in &arm.set {
            all.push((path.clone(), fill(value, &drawn, &[]).map_err(|problem| wrong(path, problem))?));
        }
        for (path, value) in &all {
            text = set_value(&text, path, value).map_err(|problem| wrong(path, problem))?;
        }
        Ok((shown, text))
    }

    /// Reads and checks every arm under every condition, so that no campaign starts that must fail. Warnings are not
    /// shown: `rheotaxis check` gives those of the base.
    ///
    /// # Errors
    /// The first mistake, in the order of conditions and arms.
    pub fn check(&self) -> Result<(), CampaignError> {
        self.check_with(false)
    }

    /// The same, where somebody outside the program may decide in its runs.
    ///
    /// # Errors
    /// As [`Campaign::check`].
    pub fn check_with(&self, outside: bool) -> Result<(), CampaignError> {
        with_threads(|| self.check_all(outside))
    }

    fn check_all(&self, outside: bool) -> Result<(), CampaignError> {
        let arms = self.spec.arms.len();
        // With the middle of all that is drawn for a seed, and with each end of it.
        let ends =
            (self.spec.draw.iter()).flat_map(|d| d.of.extremes().into_iter().map(|u| Some((d.path.as_str(), u))));
        let ends: Vec<Option<(&str, f64)>> = std::iter::once(None).chain(ends).collect();
        let variants = self.spec.n_conditions() * (arms * ends.len()) as u64;
        let place = |i: u64| {
            let (i, end) = (i / ends.len() as u64, ends[(i % ends.len() as u64) as usize]);
            let number = move |path: &str| end.filter(|(of, _)| *of == path).map_or(0.5, |(_, u)| u);
            (i / arms as u64, (i % arms as u64) as usize, number)
        };
        // Draws from a few values make the same scenario again and again: each is checked once.
        let hash_of = |(condition, arm, number)| -> Result<String, CampaignError> {
            Ok(hash(&self.text_of(condition, arm, &number)?.1))
        };
        let hashes: Vec<(u64, Result<String, CampaignError>)> =
            (0..variants).into_par_iter().map(|i| (i, hash_of(place(i)))).collect();
        let mut known = BTreeSet::new();
        let new = |(_, hash): &(u64, Result<String, CampaignError>)| {
            hash.as_ref().map_or(true, |hash| known.insert(hash.clone()))
        };
        let new: Vec<_> = hashes.into_iter().filter(new).collect();
        let one = |i: u64| -> Result<(), CampaignError> {
            let (condition, arm, number) = place(i);
            let loaded = self.loaded(condition, arm, &number)?;
            loaded.check()?;
            match controlled(&loaded.scenario) {
                asking if asking.is_empty() || outside => Ok(()),
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
        let arm = campaign_with(&registry, ARMS).typical(0, 1).unwrap();
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
        let changed = c.typical(2, 0).unwrap().scenario;
        assert_eq!(changed.time.limit_s.get(), 20.0);
        assert_ne!(changed.robots, c.base.scenario.robots);
        c.check().unwrap();
    }

    #[test]
    fn draws_stay_within_their_range_and_repeat() {
        let c = campaign(&format!(
            r#"{ARMS}, conditions: Random(n: 50, draw: [("time.limit_s", LogUniform(10, 1000)), ("terrain.depth_m", Choice(["9", "11"]))])"#
        ));
        let limits: Vec<f64> = (0..50).map(|i| c.typical(i, 0).unwrap().scenario.time.limit_s.get()).collect();
        assert!(limits.iter().all(|l| (10.0..1000.0).contains(l)));
        // Half of them lie below the geometric mean: 25 of 50, standard deviation 3.5; five of these are allowed.
        let below = limits.iter().filter(|l| **l < 100.0).count();
        assert!((8..=42).contains(&below), "{below}");
        assert_eq!(c.condition_name(7), c.clone().condition_name(7));
    }

    #[test]
    fn what_a_seed_draws_is_the_same_for_every_arm_and_an_arm_may_name_it() {
        let c = campaign(
            r#"seeds: 40, draw: [(path: "sources[0].east_m", of: Uniform(-190, -100))],
            arms: [(name: "a"), (name: "told", set: [("robots[0].start.east_m", "{sources[0].east_m}")])]"#,
        );
        let of = |run: u64| c.of_run(&c.place(run)).unwrap().scenario;
        let east = |run: u64| of(run).sources[0].east_m.get();
        for run in (0..80).step_by(2) {
            assert!(east(run) == east(run + 1) && (-190.0..-100.0).contains(&east(run)));
            assert_eq!(of(run + 1).robots[0].start.east_m.get(), east(run));
        }
        let mut sealed = c.clone();
        sealed.key = Key::secret("of the contest");
        assert_ne!(sealed.of_run(&sealed.place(0)).unwrap().scenario.sources, of(0).sources);
        c.check().unwrap();
        let astray = campaign(
            r#"seeds: 1, draw: [(path: "time.limit_s", of: Uniform(5, 9))],
            arms: [(name: "a", set: [("time.spin_up_s", "{time.limit}")])]"#,
        );
        let said = astray.check().unwrap_err().to_string();
        assert!(said.contains("`{time.limit}` is not given; there are: time.limit_s"), "{said}");
        let beyond = campaign(r#"seeds: 1, arms: [(name: "a")], draw: [(path: "time.limit_s", of: Uniform(-1, 9))]"#);
        assert!(beyond.check().is_err(), "an end that is not legal");
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
