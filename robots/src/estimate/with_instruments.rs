//! The estimate with real instruments: what drifts, what bounds the drift, and from which layer the flow comes.

#[cfg(test)]
mod tests {
    use super::super::{DeadReckoning, DeadReckoningSpec, LayerAwareSpec, Start};
    use crate::handoff::Estimate;
    use crate::sense::testing::Dark;
    use crate::sense::{
        AdcpSpec, CompassSpec, CtdSpec, DepthSpec, DvlSpec, LblSpec, OnBoard, SensorSuite, SensorsSpec, Surroundings,
    };
    use nalgebra::{Vector2, Vector3};
    use world::clock::Clock;
    use world::fields::{Clean, Flow};
    use world::frames::{Pose, Truth};
    use world::terrain::Terrain;
    use world::units::Heading;

    const START: Vector2<f64> = Vector2::new(150.0, -500.0);

    fn instruments() -> SensorsSpec {
        SensorsSpec::default().with(DvlSpec::default()).with(AdcpSpec::default()).with(CompassSpec::default())
    }

    /// Southward below an interface 3 m down, northward above it.
    struct TwoLayers;
    impl Flow for TwoLayers {
        fn velocity(&self, p: &Vector3<f64>, _t_s: f64) -> Vector3<f64> {
            Vector3::new(0.0, if p.z > -3.0 { 0.22 } else { -0.11 }, 0.0)
        }
    }

    /// The same water with a different density in each layer.
    struct Stratified;
    impl Flow for Stratified {
        fn velocity(&self, p: &Vector3<f64>, t_s: f64) -> Vector3<f64> {
            TwoLayers.velocity(p, t_s)
        }
        fn density(&self, p: &Vector3<f64>, _t_s: f64) -> f64 {
            if p.z > -3.0 { 1020.0 } else { 1024.0 }
        }
    }

    #[test]
    fn with_a_ctd_it_takes_no_flow_from_the_other_layer() {
        let spec = instruments().with(DepthSpec::default()).with(CtdSpec::default());
        let east = Heading::from_deg(90.0);
        let mounts = |_: &str| Some(Pose::level(Vector3::zeros(), east));
        let dt_s = 0.04;
        let mut suite = SensorSuite::new(&spec, &mounts, OnBoard::new("auv0", 11, dt_s)).unwrap();
        let start = Start { position: START, heading: east, depth_m: 0.5 };
        let aware = DeadReckoningSpec { layer_aware: Some(LayerAwareSpec::default()), ..Default::default() };
        let mut e = DeadReckoning::new(&aware, start, dt_s);
        let mut clock = Clock::new(dt_s);
        // A dive to 3.6 m in 31 s, where the ADCP cell lies in the layer above; from 100 s on to 5 m.
        let mut believed = Vec::new();
        for _ in 0..5000 {
            let t = clock.t_s();
            let depth_m = (0.5 + 0.1 * t).min(3.6 + (0.1 * (t - 100.0)).clamp(0.0, 1.4));
            let p = START + Vector2::new(2.0 * t, 0.0);
            let truth = Truth {
                v_WB_B: Vector3::new(2.0, 0.0, 0.0),
                ..Truth::at_rest(Pose::level(Vector3::new(p.x, p.y, -depth_m), east))
            };
            let bed = Terrain::Level { depth_m: 8.0 };
            let obstacles = Default::default();
            let said = suite.read(&Surroundings {
                clock: &clock,
                truth: &truth,
                flow: &Stratified,
                dye: &Clean,
                terrain: &bed,
                obstacles: &obstacles,
                imaging: &Dark,
                asked: Default::default(),
            });
            believed.push(e.step(&clock, &said).flow.map(|f| f.velocity.y));
            clock.advance();
        }
        // In the upper layer its flow, near the interface none, in the lower layer the lower flow; five times the
        // low-passed noise, as below.
        let at = |t_s: f64| believed[(t_s / dt_s) as usize];
        assert!((at(24.0).expect("measured") - 0.22).abs() < 0.0225 * 2.0);
        assert_eq!(at(90.0), None);
        assert!((at(190.0).expect("measured") + 0.11).abs() < 0.0225);
    }

    /// An hour eastward at 2 m/s and a given depth, seen through real instruments.
    fn an_hour(lbl: Option<LblSpec>, depth_m: f64) -> Vec<(Vector2<f64>, Estimate)> {
        let spec = match lbl {
            Some(lbl) => instruments().with(lbl),
            None => instruments(),
        };
        let east = Heading::from_deg(90.0);
        let mounts = |_: &str| Some(Pose::level(Vector3::zeros(), east));
        let dt_s = 0.04;
        // With this seed the heading bias is some 1 degree, the standard deviation of the specification.
        let mut suite = SensorSuite::new(&spec, &mounts, OnBoard::new("auv0", 12, dt_s)).unwrap();
        let start = Start { position: START, heading: east, depth_m };
        let mut e = DeadReckoning::new(&DeadReckoningSpec::default(), start, dt_s);
        let mut clock = Clock::new(dt_s);
        let mut all = Vec::new();
        for _ in 0..90_000 {
            let p = START + Vector2::new(2.0 * clock.t_s(), 0.0);
            let truth = Truth {
                v_WB_B: Vector3::new(2.0, 0.0, 0.0),
                ..Truth::at_rest(Pose::level(Vector3::new(p.x, p.y, -depth_m), east))
            };
            let bed = Terrain::Level { depth_m: 8.0 };
            let readings = suite.read(&Surroundings {
                clock: &clock,
                truth: &truth,
                flow: &TwoLayers,
                dye: &Clean,
                terrain: &bed,
                obstacles: &Default::default(),
                imaging: &Dark,
                asked: Default::default(),
            });
            all.push((p, e.step(&clock, &readings)));
            clock.advance();
        }
        all
    }

    #[test]
    fn fixes_bound_what_dead_reckoning_lets_grow() {
        let error = |(p, e): &(Vector2<f64>, Estimate)| (e.position - p).norm();
        let alone = an_hour(None, 5.0);
        let (half, whole) = (error(&alone[44_999]), error(&alone[89_999]));
        // Bias and scale error are constant: the error grows with the way.
        assert!(whole > 20.0 && (whole / half - 2.0).abs() < 0.1, "{half} m, {whole} m");
        let fixed = an_hour(Some(LblSpec::default()), 5.0);
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
        for (depth_m, north_m_s) in [(3.6, 0.22), (5.0, -0.11)] {
            let believed = an_hour(None, depth_m)[89_999].1.flow.unwrap().velocity;
            // 0.02 m/s through 10 s of readings once a second: 0.02 · √(tanh(0.05)) = 0.0045 m/s;
            // five of that, and 0.2 % of 2 m/s along the way, times five.
            assert!((believed.y - north_m_s).abs() < 0.0225, "{believed:?}");
            assert!(believed.x.abs() < 0.0425, "{believed:?}");
        }
    }
}
