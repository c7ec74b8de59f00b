//! Keeps the commanded heading within the vehicle's heading rate.
//!
//! *Source*: Pang 2009, section 4: "the heading commands are filtered before they are sent".
//!
//! *Parameters*: greatest heading rate, `heading_rate_deg_s`, °/s, 10.
//!
//! *Deviations*: the paper prints no filter. This one turns the command toward the wanted heading the short way, by
//! at most rate · dt in a step, starting from the vehicle's heading.

use world::units::Heading;

/// Rate limiter on a heading.
#[derive(Clone, Copy, Debug)]
pub(super) struct RateFilter {
    rate_rad_s: f64,
    last: Option<Heading>,
}

impl RateFilter {
    pub(super) fn new(rate_rad_s: f64) -> Self {
        Self { rate_rad_s, last: None }
    }

    /// Forgets the last command: the next one starts from the vehicle's heading.
    pub(super) fn reset(&mut self) {
        self.last = None;
    }

    /// The command `dt_s` after the last one.
    pub(super) fn step(&mut self, wanted: Heading, vehicle: Heading, dt_s: f64) -> Heading {
        let from = self.last.unwrap_or(vehicle);
        let most = self.rate_rad_s * dt_s;
        let next = from.turned(from.turn_to(wanted).clamp(-most, most));
        self.last = Some(next);
        next
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crosses_north_the_short_way() {
        let mut f = RateFilter::new(10f64.to_radians());
        let start = Heading::from_deg(355.0);
        let mut h = start;
        for _ in 0..50 {
            h = f.step(Heading::from_deg(5.0), start, 0.02);
        }
        assert!((h.turn_to(Heading::from_deg(5.0))).abs() < 1e-9);
    }
}
