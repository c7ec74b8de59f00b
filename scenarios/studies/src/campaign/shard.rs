//! Which share of a campaign's blocks this process does.

use crate::campaign::error::CampaignError;
use std::str::FromStr;

/// A share: that of process `index` (from 0) of `count` processes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Index of this process, from 0.
    pub index: u64,
    /// Number of processes.
    pub count: u64,
}

/// The only process.
impl Default for Shard {
    fn default() -> Self {
        Self { index: 0, count: 1 }
    }
}

impl std::fmt::Display for Shard {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}/{}", self.index + 1, self.count)
    }
}

impl FromStr for Shard {
    type Err = String;
    fn from_str(s: &str) -> Result<Self, String> {
        let wrong = || "must be I/N with I from 1 to N, such as 3/8".to_string();
        let (i, n) = s.split_once('/').ok_or_else(wrong)?;
        let (i, count): (u64, u64) = (i.parse().map_err(|_| wrong())?, n.parse().map_err(|_| wrong())?);
        if i == 0 || i > count {
            return Err(wrong());
        }
        Ok(Self { index: i - 1, count })
    }
}

impl Shard {
    /// Whether this process has to do a block; blocks are assigned in turn.
    pub fn has(self, block: u64) -> bool {
        block % self.count == self.index
    }

    /// The share that a cluster's scheduler gives in its environment variables; the whole work if there are none. The
    /// first of these counts: a Slurm array (`SLURM_ARRAY_TASK_ID`, `_MIN`, `_STEP`, `_COUNT`), a HyperQueue task array
    /// (`HQ_TASK_ID`, counted from 1), and an indexed Job of Kubernetes (`JOB_COMPLETION_INDEX`). The latter two do not
    /// tell their tasks how many there are: set `RHEOTAXIS_SHARDS`, or for Kubernetes `JOB_COMPLETIONS`, to that
    /// number.
    ///
    /// # Errors
    /// If the variables do not make a share.
    pub fn from_environment(get: impl Fn(&str) -> Option<String>) -> Result<Option<Self>, CampaignError> {
        let number = |name: &str| -> Result<Option<u64>, CampaignError> {
            let Some(text) = get(name) else {
                return Ok(None);
            };
            text.trim()
                .parse()
                .map(Some)
                .map_err(|_| CampaignError::Shard(format!("{name} is `{text}`, not a whole number: give --shard")))
        };
        let total = |names: &[&str]| -> Result<u64, CampaignError> {
            for name in names {
                if let Some(n) = number(name)? {
                    return Ok(n);
                }
            }
            Err(CampaignError::Shard(format!(
                "the number of tasks is not known: set {} to it, or give --shard",
                names[0]
            )))
        };
        let (what, index, count) = if let Some(id) = number("SLURM_ARRAY_TASK_ID")? {
            let min = number("SLURM_ARRAY_TASK_MIN")?.unwrap_or(0);
            let step = number("SLURM_ARRAY_TASK_STEP")?.unwrap_or(1).max(1);
            let Some(count) = number("SLURM_ARRAY_TASK_COUNT")? else {
                return Err(CampaignError::Shard(
                    "SLURM_ARRAY_TASK_ID is set but not SLURM_ARRAY_TASK_COUNT: give --shard".into(),
                ));
            };
            let index = id.checked_sub(min).filter(|d| d % step == 0).map(|d| d / step);
            ("SLURM_ARRAY_TASK_ID", index, count)
        } else if let Some(id) = number("HQ_TASK_ID")? {
            let count = total(&["RHEOTAXIS_SHARDS"])?;
            ("HQ_TASK_ID", id.checked_sub(1), count)
        } else if let Some(index) = number("JOB_COMPLETION_INDEX")? {
            let count = total(&["JOB_COMPLETIONS", "RHEOTAXIS_SHARDS"])?;
            ("JOB_COMPLETION_INDEX", Some(index), count)
        } else {
            return Ok(None);
        };
        match index {
            Some(index) if index < count => Ok(Some(Self { index, count })),
            _ => Err(CampaignError::Shard(format!(
                "{what} is {}, which is none of {count} tasks without gaps: give --shard",
                get(what).unwrap_or_default()
            ))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn from(variables: &[(&str, &str)]) -> Result<Option<Shard>, String> {
        Shard::from_environment(|name| {
            let found = variables.iter().find(|(n, _)| *n == name);
            found.map(|(_, v)| (*v).to_string())
        })
        .map_err(|e| e.to_string())
    }

    #[test]
    fn shares_read_as_one_of_many() {
        assert_eq!("3/8".parse(), Ok(Shard { index: 2, count: 8 }));
        assert_eq!("3/8".parse::<Shard>().unwrap().to_string(), "3/8");
        for bad in ["0/3", "4/3", "3", "a/b", "1/0", "-1/3"] {
            assert!(bad.parse::<Shard>().is_err(), "{bad}");
        }
    }

    #[test]
    fn every_block_belongs_to_one_share() {
        for count in [1, 3, 7] {
            for block in 0..50 {
                let owners = (0..count).filter(|&index| Shard { index, count }.has(block));
                assert_eq!(owners.count(), 1);
            }
        }
    }

    #[test]
    fn schedulers_are_understood() {
        let share = |index, count| Ok(Some(Shard { index, count }));
        assert_eq!(from(&[]), Ok(None));
        let slurm = |id, min, step, count| {
            from(&[
                ("SLURM_ARRAY_TASK_ID", id),
                ("SLURM_ARRAY_TASK_MIN", min),
                ("SLURM_ARRAY_TASK_STEP", step),
                ("SLURM_ARRAY_TASK_COUNT", count),
            ])
        };
        assert_eq!(slurm("7", "5", "1", "4"), share(2, 4));
        assert_eq!(slurm("9", "1", "4", "3"), share(2, 3));
        assert!(slurm("9", "1", "1", "3").unwrap_err().contains("give --shard"));
        let hq = [("HQ_TASK_ID", "2"), ("RHEOTAXIS_SHARDS", "5")];
        assert_eq!(from(&hq), share(1, 5));
        assert!(from(&hq[..1]).unwrap_err().contains("set RHEOTAXIS_SHARDS"));
        let k8s = [("JOB_COMPLETION_INDEX", "0"), ("JOB_COMPLETIONS", "5")];
        assert_eq!(from(&k8s), share(0, 5));
        assert!(from(&k8s[..1]).unwrap_err().contains("set JOB_COMPLETIONS"));
        let word = [("JOB_COMPLETION_INDEX", "x"), ("JOB_COMPLETIONS", "5")];
        assert!(from(&word).unwrap_err().contains("`x`"));
    }
}
