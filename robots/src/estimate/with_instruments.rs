//! The estimate with real instruments: what drifts, what bounds the drift, and from which layer the flow comes.

#[cfg(test)]
mod tests {
    use super::super::{DeadReckoning, DeadReckoningSpec, LayerAwareSpec, Start};
    use crate::handoff::Estimate;
    use crate::sense::testing::{LOWER, TwoLayers, UPPER, around, suite};
    use crate::sense::{
        AdcpSpec, CompassSpec, CtdSpec, DepthSpec, DvlSpec, LblSpec, OnBoard, SensorsSpec, Surroundings,
    };
    use nalgebra::{Vector2, Vector3};
    use world::clock::Clock;
    use world::frames::{Pose, Truth};
    use world::units::Heading;

    const START: Vector2<f64> = Vector2::new(150.0, -500.0);
    const DT_S: f64 = 0.04;

    fn instruments() -> SensorsSpec {
        SensorsSpec::default().with(DvlSpec::default()).with(AdcpSpec::default()).with(CompassSpec::default())
    }

    /// True and believed states on the way eastward at 2 m/s, at a depth of each time, seen through real instruments.
    fn sail(
        spec: &SensorsSpec,
        reckoning: &DeadReckoningSpec,
        seed: u64,
        steps: u64,
        depth_m: impl Fn(f64) -> f64,
    ) -> Vec<(Vector2<f64>, Estimate)> {
        let east = Heading::from_deg(90.0);
        let mut suite = suite(spec, OnBoard::new("auv0", seed, DT_S));
        let start = Start { position: START, heading: east, depth_m: depth_m(0.0) };
        let mut e = DeadReckoning::new(reckoning, start, DT_S);
        let mut clock = Clock::new(DT_S);
        let mut all = Vec::new();
        for _ in 0..steps {
            let p = START + Vector2::new(2.0 * clock.t_s(), 0.0);
            let truth = Truth {
                v_WB_B: Vector3::new(2.0, 0.0, 0.0),
                ..Truth::at_rest(Pose::level(p.push(-depth_m(clock.t_s())), east))
            };
            let readings = suite.read(&Surroundings { flow: &TwoLayers, ..around(&clock, &truth) });
            all.push((p, e.step(&clock, &readings)));
            clock.advance();
        }
        all
    }

    #[test]
    fn with_a_ctd_it_takes_no_flow_from_the_other_layer() {
        let spec = instruments().with(DepthSpec::default()).with(CtdSpec::default());
        let aware = DeadReckoningSpec { layer_aware: Some(LayerAwareSpec::default()), ..Default::default() };
        // A dive to 3.6 m in 31 s, where the ADCP cell lies in the layer above; from 100 s on to 5 m.
        let depth_m = |t: f64| (0.5 + 0.1 * t).min(3.6 + (0.1 * (t - 100.0)).clamp(0.0, 1.4));
        let believed = sail(&spec, &aware, 11, 5000, depth_m);
        // In the upper layer its flow, near the interface none, in the lower layer the lower flow; five times the
        // low-passed noise, as below.
        let at = |t_s: f64| believed[(t_s / DT_S) as usize].1.flow.map(|f| f.velocity.y);
        assert!((at(24.0).expect("measured") - UPPER.y).abs() < 0.0225 * 2.0);
        assert_eq!(at(90.0), None);
        assert!((at(190.0).expect("measured") - LOWER.y).abs() < 0.0225);
    }

    /// An hour at a given depth. With this seed the heading bias is some 1 degree, the standard deviation of the
    /// specification.
    fn an_hour(spec: &SensorsSpec, depth_m: f64) -> Vec<(Vector2<f64>, Estimate)> {
        sail(spec, &DeadReckoningSpec::default(), 12, 90_000, |_| depth_m)
    }

    #[test]
    fn fixes_bound_what_dead_reckoning_lets_grow() {
        let error = |(p, e): &(Vector2<f64>, Estimate)| (e.position - p).norm();
        let alone = an_hour(&instruments(), 5.0);
        let (half, whole) = (error(&alone[44_999]), error(&alone[89_999]));
        // Bias and scale error are constant: the error grows with the way.
        assert!(whole > 20.0 && (whole / half - 2.0).abs() < 0.1, "{half} m, {whole} m");
        let fixed = an_hour(&instruments().with(LblSpec::default()), 5.0);
        let after_fixes: Vec<f64> =
            (fixed.iter()).filter(|(_, e)| e.fix_jump_m() > 0.0).map(|x| error(x).powi(2)).collect();
        // Just after a fix the error is that of the fix: 2 · 5² m² in the mean, five standard errors.
        let n = after_fixes.len() as f64;
        let mean = after_fixes.iter().sum::<f64>() / n;
        assert!((mean / 50.0 - 1.0).abs() < 5.0 / n.sqrt(), "{mean} m² over {n}");
        // 1 in 4e5 fixes is off by more than 25 m; the drift since adds under 2 m a minute.
        assert!(fixed.iter().map(error).fold(0.0, f64::max) < 25.0 + 10.0);
    }

    #[test]
    fn near_the_interface_the_flow_believed_is_the_other_layers() {
        for (depth_m, flow) in [(3.6, UPPER), (5.0, LOWER)] {
            let believed = an_hour(&instruments(), depth_m)[89_999].1.flow.unwrap().velocity;
            // 0.02 m/s through 10 s of readings once a second: 0.02 · √(tanh(0.05)) = 0.0045 m/s;
            // five of that, and 0.2 % of 2 m/s along the way, times five.
            assert!((believed.y - flow.y).abs() < 0.0225, "{believed:?}");
            assert!((believed.x - flow.x).abs() < 0.0425, "{believed:?}");
        }
    }
}
