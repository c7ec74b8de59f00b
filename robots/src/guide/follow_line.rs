//! Tracks a straight line after its start has been reached with its heading.
//!
//! *Source*: Pang 2009, section 4.2, eq. 7-10.
//!
//! *Parameters*: gain K, `line_gain_deg_m`, °/m, 5.0; capture angle, `line_capture_deg`, °, 45 (so d1 = 45/K = 9 m);
//! start radius R, `line_start_m`, m, 10; start angle θ, `line_start_angle_deg`, °, 15; end radius R, `arrive_m`, m,
//! 10; overshoot R_L, `line_overshoot_m`, m (not printed), 10.
//!
//! *Deviations*: eq. 8 is meant for |d| (as printed, a vehicle far right of the line would get K · d without bound).
//! The direction compared with θ is the course over ground, not the heading: in a cross flow the two differ by the
//! crab angle, and the vehicle could otherwise never enter a line.

use super::spec::GuidanceSpec;
use nalgebra::Vector2;
use world::units::Heading;

/// A line and how it is tracked.
#[derive(Clone, Copy, Debug)]
pub(super) struct FollowLine {
    from: Vector2<f64>,
    to: Vector2<f64>,
    alpha: Heading,
}

impl FollowLine {
    /// A line; its ends must differ.
    pub(super) fn new(from: Vector2<f64>, to: Vector2<f64>) -> Self {
        Self { from, to, alpha: Heading::from_vector(to - from) }
    }

    /// Direction of the line (eq. 7).
    pub(super) fn direction(&self) -> Heading {
        self.alpha
    }

    /// Whether the vehicle is near enough to the start, in place and direction, to begin; `moving` gives the course
    /// over ground.
    pub(super) fn entered(
        &self,
        spec: &GuidanceSpec,
        position: Vector2<f64>,
        moving: impl FnOnce() -> Heading,
    ) -> bool {
        (position - self.from).norm() < spec.line_start_m.get()
            && moving().turn_to(self.alpha).abs() < spec.line_start_angle_deg.get().to_radians()
    }

    /// Distance from the line, positive to its left, m.
    fn off_m(&self, position: Vector2<f64>) -> f64 {
        self.alpha.unit().perp(&(position - self.from))
    }

    /// Course to take (eq. 8).
    pub(super) fn course(&self, spec: &GuidanceSpec, position: Vector2<f64>) -> Heading {
        self.alpha.turned(spec.turn_to_line(self.off_m(position)))
    }

    /// Whether its end has been reached (eq. 6) or passed (eq. 10).
    pub(super) fn finished(&self, spec: &GuidanceSpec, position: Vector2<f64>) -> bool {
        let v = position - self.to;
        v.norm() < spec.arrive_m.get() || v.dot(&self.alpha.unit()) > spec.line_overshoot_m.get()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn spec() -> GuidanceSpec {
        GuidanceSpec::default()
    }

    fn north() -> FollowLine {
        FollowLine::new(Vector2::zeros(), Vector2::new(0.0, 100.0))
    }

    #[test]
    fn equation_8_by_hand() {
        let l = north();
        // Left (west) of a northward line: steer right.
        assert!((l.course(&spec(), Vector2::new(-2.0, 50.0)).deg() - 10.0).abs() < 1e-9);
        assert!((l.course(&spec(), Vector2::new(-9.0, 50.0)).deg() - 45.0).abs() < 1e-9);
        assert!((l.course(&spec(), Vector2::new(-80.0, 50.0)).deg() - 45.0).abs() < 1e-9);
        // Right of it: the heading wraps below north.
        assert!((l.course(&spec(), Vector2::new(2.0, 50.0)).deg() - 350.0).abs() < 1e-9);
        assert!((l.course(&spec(), Vector2::new(80.0, 50.0)).deg() - 315.0).abs() < 1e-9);
    }

    #[test]
    fn ends_near_the_end_or_past_it() {
        let l = north();
        assert!(!l.finished(&spec(), Vector2::new(0.0, 89.0)));
        assert!(l.finished(&spec(), Vector2::new(0.0, 90.5)));
        // A navigation fix put it 30 m aside: only the overshoot ends the mode.
        assert!(!l.finished(&spec(), Vector2::new(30.0, 109.0)));
        assert!(l.finished(&spec(), Vector2::new(30.0, 110.5)));
    }

    #[test]
    fn entered_only_in_place_and_direction() {
        let l = north();
        let near = Vector2::new(3.0, -5.0);
        assert!(l.entered(&spec(), near, || Heading::from_deg(350.0)));
        assert!(!l.entered(&spec(), near, || Heading::from_deg(340.0)));
        assert!(!l.entered(&spec(), Vector2::new(3.0, -15.0), || Heading::from_deg(0.0)));
    }

    proptest! {
        #![proptest_config(crate::handoff::testing::fixed(256))]

        #[test]
        fn closes_the_line_at_any_angle(alpha in 0.0..360.0, aside in -60.0..60.0) {
            let a = Heading::from_deg(alpha);
            let l = FollowLine::new(Vector2::zeros(), a.unit() * 400.0);
            let right = a.turned(std::f64::consts::FRAC_PI_2).unit();
            let mut p = right * aside;
            let mut h = a;
            while !l.finished(&spec(), p) {
                let most = 10f64.to_radians() * 0.1;
                h = h.turned(h.turn_to(l.course(&spec(), p)).clamp(-most, most));
                p += h.unit() * 0.2;
            }
            prop_assert!((p - a.unit() * 400.0).norm() <= 10.0 && l.off_m(p).abs() < 0.5);
        }
    }
}
