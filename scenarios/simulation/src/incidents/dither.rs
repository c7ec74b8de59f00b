//! Behaviours that take turns on one spot: the vehicle switches between them and gets no further.

use nalgebra::Vector3;
use robots::handoff::Behaviour;
use std::collections::VecDeque;

/// So many switches of behaviour within so long (s), the first and the last less than so far apart (m), are no search.
const SWITCHES: usize = 12;
const WITHIN_S: f64 = 60.0;
const WITHIN_M: f64 = 3.0;

/// The newest switches of behaviour of a robot, with time (s) and place.
#[derive(Clone, Debug, Default)]
pub(crate) struct Switches {
    behaviour: Behaviour,
    newest: VecDeque<(f64, Vector3<f64>)>,
}

impl Switches {
    /// Takes in the present behaviour. Returns whether behaviours alternate without progress.
    pub(crate) fn alternate(&mut self, behaviour: Behaviour, t_s: f64, p_W: &Vector3<f64>) -> bool {
        if behaviour != self.behaviour {
            self.behaviour = behaviour;
            self.newest.push_back((t_s, *p_W));
            if self.newest.len() > SWITCHES {
                self.newest.pop_front();
            }
        }
        self.newest.len() == SWITCHES
            && self
                .newest
                .front()
                .is_some_and(|(first_s, place)| t_s - first_s < WITHIN_S && (p_W - place).norm() < WITHIN_M)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// When behaviours that take turns every second are first told of, at a speed.
    fn told_s(speed_m_s: f64, every_s: f64) -> Option<f64> {
        let mut switches = Switches::default();
        (0..1000).map(|k| 0.1 * f64::from(k)).find(|t_s| {
            let avoids = ((t_s / every_s) as u32).is_multiple_of(2);
            let behaviour = if avoids { Behaviour::Avoid } else { Behaviour::Reacquire };
            let place = Vector3::new(speed_m_s * t_s, 0.0, -2.0);
            switches.alternate(behaviour, *t_s, &place)
        })
    }

    #[test]
    fn behaviours_that_take_turns_on_one_spot_are_told() {
        assert!(told_s(0.0, 1.0).is_some_and(|t_s| (t_s - 11.0).abs() < 0.2));
        // With progress, or now and then, that is a search.
        assert_eq!(told_s(0.5, 1.0), None);
        assert_eq!(told_s(0.0, 8.0), None);
    }
}
