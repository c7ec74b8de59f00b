//! What a robot's instruments reported between two frames.

use robots::handoff::{AdcpReading, AltimeterReading, Attitude, DepthReading, DvlReading, RangeScan, Readings};
use std::collections::BTreeMap;

/// A reading and its time.
#[derive(Clone, Debug, PartialEq)]
pub struct TimedReading<T> {
    /// When it was taken, s.
    pub t_s: f64,
    /// The reading.
    pub value: T,
}

/// The newest reading of each instrument since the previous frame; `None` if there was none. Chemical readings,
/// pictures and pings come in other ways.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NewestReadings {
    /// Bottom track.
    pub dvl: Option<TimedReading<DvlReading>>,
    /// Water track.
    pub adcp: Option<TimedReading<AdcpReading>>,
    /// Compass and inertial unit.
    pub attitude: Option<TimedReading<Attitude>>,
    /// Depth.
    pub depth: Option<TimedReading<DepthReading>>,
    /// Altitude.
    pub altimeter: Option<TimedReading<AltimeterReading>>,
    /// Forward ranging.
    pub ranging: Option<TimedReading<RangeScan>>,
    /// Numbers of instruments of other crates, by name.
    pub other: BTreeMap<&'static str, TimedReading<f64>>,
}

impl NewestReadings {
    /// The newest readings of all instruments are those of `readings`, as far as there are any.
    pub(crate) fn hear(&mut self, t_s: f64, readings: &Readings) {
        fn replace<T: Clone>(newest: &mut Option<TimedReading<T>>, t_s: f64, read: Option<&T>) {
            if let Some(value) = read.cloned() {
                *newest = Some(TimedReading { t_s, value });
            }
        }
        replace(&mut self.dvl, t_s, readings.dvl.as_ref());
        replace(&mut self.adcp, t_s, readings.adcp.as_ref());
        replace(&mut self.attitude, t_s, readings.attitude.as_ref());
        replace(&mut self.depth, t_s, readings.depth.as_ref());
        replace(&mut self.altimeter, t_s, readings.altimeter.as_ref());
        replace(&mut self.ranging, t_s, readings.ranging.as_ref());
        self.other.extend(readings.other.iter().map(|&(name, value)| (name, TimedReading { t_s, value })));
    }

    /// Fills what is missing with earlier readings, for whoever leaves out a frame.
    pub fn fill(&mut self, earlier: &Self) {
        fn keep<T: Clone>(newest: &mut Option<TimedReading<T>>, earlier: &Option<TimedReading<T>>) {
            if newest.is_none() {
                newest.clone_from(earlier);
            }
        }
        keep(&mut self.dvl, &earlier.dvl);
        keep(&mut self.adcp, &earlier.adcp);
        keep(&mut self.attitude, &earlier.attitude);
        keep(&mut self.depth, &earlier.depth);
        keep(&mut self.altimeter, &earlier.altimeter);
        keep(&mut self.ranging, &earlier.ranging);
        for (name, reading) in &earlier.other {
            self.other.entry(name).or_insert_with(|| reading.clone());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn depth(depth_m: f64) -> Readings {
        Readings { depth: Some(DepthReading { depth_m }), ..Readings::default() }
    }

    #[test]
    fn a_number_of_another_crate_is_heard_under_its_name() {
        let of = |name, value| Readings { other: vec![(name, value)], ..Readings::default() };
        let mut heard = NewestReadings::default();
        heard.hear(1.0, &of("pressure_pa", 8e4));
        let mut next = NewestReadings::default();
        next.hear(2.0, &of("salt_g_l", 35.0));
        next.fill(&heard);
        let values: Vec<_> = next.other.iter().map(|(name, r)| (*name, r.t_s, r.value)).collect();
        assert_eq!(values, [("pressure_pa", 1.0, 8e4), ("salt_g_l", 2.0, 35.0)]);
    }

    #[test]
    fn the_newest_reading_stays_until_there_is_another() {
        let mut heard = NewestReadings::default();
        heard.hear(1.0, &depth(3.0));
        heard.hear(2.0, &Readings::default());
        assert_eq!(heard.depth.as_ref().map(|d| d.t_s), Some(1.0));
        let mut next = NewestReadings::default();
        next.fill(&heard);
        assert_eq!(next, heard);
        next.hear(3.0, &depth(4.0));
        next.fill(&heard);
        assert_eq!(next.depth.map(|d| d.value.depth_m), Some(4.0));
    }
}
