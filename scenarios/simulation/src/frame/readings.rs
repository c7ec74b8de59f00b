//! What a robot's instruments reported between two frames.

use robots::handoff::{AdcpReading, AltimeterReading, Attitude, DepthReading, DvlReading, RangeScan, Readings};

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
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn depth(depth_m: f64) -> Readings {
        Readings { depth: Some(DepthReading { depth_m }), ..Readings::default() }
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
