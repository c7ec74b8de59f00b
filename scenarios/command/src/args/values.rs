//! How the values of options are read.

use std::ops::RangeInclusive;
use std::str::FromStr;
use std::time::Duration;

/// A size of memory: a number of bytes, or of K, M, G or T (thousands).
pub(super) fn bytes(s: &str) -> Result<f64, String> {
    let units = [('K', 1e3), ('M', 1e6), ('G', 1e9), ('T', 1e12)];
    let last = s.chars().last().map(|c| c.to_ascii_uppercase());
    let unit = units.into_iter().find(|(name, _)| Some(*name) == last);
    let (number, times) = unit.map_or((s, 1.0), |(_, times)| (&s[..s.len() - 1], times));
    match number.trim().parse::<f64>() {
        Ok(n) if n * times >= 1e6 && (n * times).is_finite() => Ok(n * times),
        Ok(n) if n >= 0.0 => Err("must be at least 1M".to_string()),
        _ => Err("must be a size such as 500M, 4G or 1.5T".to_string()),
    }
}

/// Reads a number in a range; `must` says which there are.
pub(super) fn within(
    legal: RangeInclusive<f64>,
    must: &'static str,
) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |s| s.parse().ok().filter(|v| legal.contains(v)).ok_or_else(|| must.to_string())
}

/// Hours, minutes and seconds, in this order.
pub(super) fn wall_time(text: &str) -> Result<Duration, String> {
    let wrong = || "must be like 90s, 55m or 1h30m".to_string();
    let (mut rest, mut seconds) = (text, 0_u64);
    for (unit, length) in [('h', 3600), ('m', 60), ('s', 1)] {
        if let Some((n, after)) = rest.split_once(unit) {
            let n: u64 = n.parse().map_err(|_| wrong())?;
            let part = n.checked_mul(length).ok_or_else(wrong)?;
            seconds = seconds.checked_add(part).ok_or_else(wrong)?;
            rest = after;
        }
    }
    if !rest.is_empty() || seconds == 0 {
        return Err(wrong());
    }
    Ok(Duration::from_secs(seconds))
}

/// A fixed count of numbers, separated by commas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numbers<const N: usize>(pub [f64; N]);

impl<const N: usize> FromStr for Numbers<N> {
    type Err = String;
    fn from_str(s: &str) -> Result<Self, String> {
        let all = s.split(',').map(|part| part.trim().parse().ok().filter(|v: &f64| v.is_finite()));
        let all: Option<Vec<f64>> = all.collect();
        let all = all.and_then(|all| all.try_into().ok());
        all.map(Self).ok_or_else(|| format!("must be {N} numbers separated by commas"))
    }
}

/// How fast a run goes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Speed {
    /// As fast as the machine can.
    #[default]
    Max,
    /// So many simulated seconds in a second.
    Times(f64),
}

impl FromStr for Speed {
    type Err = String;
    fn from_str(s: &str) -> Result<Self, String> {
        match s {
            "max" => Ok(Speed::Max),
            "realtime" => Ok(Speed::Times(1.0)),
            _ => match s.strip_suffix('x').unwrap_or(s).parse::<f64>() {
                Ok(x) if x > 0.0 && x.is_finite() => Ok(Speed::Times(x)),
                _ => Err("must be `max`, `realtime` or a number > 0".to_string()),
            },
        }
    }
}
