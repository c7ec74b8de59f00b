//! Each instrument with each of its faults: what it reads beside a healthy one.

use super::super::testing::fault;
use super::super::{
    DensityFault, DyeFault, EyeFault, Faulty, FixFault, HeadingFault, LieSpec, MetresFault, SensorFaults, SpeedFault,
};
use crate::handoff::Readings;
use crate::sense::testing::{all, around, suite};
use crate::sense::{LblSpec, OnBoard, SensorsSpec, Surroundings};
use nalgebra::{Vector2, Vector3};
use world::clock::Clock;
use world::fields::Concentration;
use world::frames::{Pose, Truth};
use world::ranges::{Finite, Fraction, NonNegative, Positive};
use world::units::{Heading, KG_M3_PER_UG_L};

/// Step, s; steps of a run; when faults begin and end, s.
const DT_S: f64 = 0.02;
const STEPS: u64 = 6000;
const AT_S: f64 = 40.0;
const UNTIL_S: f64 = 80.0;

/// 0.1 µg/L everywhere: a hundredth of full scale, below the threshold.
struct Faint;
impl Concentration for Faint {
    fn concentration(&self, _: &Vector3<f64>) -> f64 {
        0.1 * KG_M3_PER_UG_L
    }
}

fn sensors() -> SensorsSpec {
    all().with(LblSpec { period_s: Positive::new(5.0), dropout: Fraction::new(0.0), ..LblSpec::default() })
}

/// The readings of two minutes, `depth_m` deep over a bed at 8 m.
fn read(what: Option<Faulty>, depth_m: f64) -> Vec<Readings> {
    let mut suite = suite(&sensors(), OnBoard::new("auv0", 3, DT_S));
    let faults: Vec<_> = (what.into_iter()).map(|what| fault(AT_S, Some(UNTIL_S), what)).collect();
    let mut faults = SensorFaults::new(&faults, &sensors(), DT_S);
    let north = Heading::from_deg(0.0);
    let mut clock = Clock::new(DT_S);
    let mut read = Vec::new();
    for _ in 0..STEPS {
        let truth = Truth::at_rest(Pose::level(Vector3::new(0.0, 0.1 * clock.t_s(), -depth_m), north));
        let mut readings = suite.read(&Surroundings { dye: &Faint, ..around(&clock, &truth) });
        faults.alter(&clock, &mut readings);
        read.push(readings);
        clock.advance();
    }
    read
}

/// One number of a reading, if there is one.
type Number = fn(&Readings) -> Option<f64>;

/// Error of a bias and, per second, of a drift.
const BIAS: f64 = 0.5;
const DRIFT: f64 = 0.01;

/// Every instrument with a fault of each kind, and the number that it reads.
fn cases() -> Vec<(Number, [Faulty; 4])> {
    let (by, per_s) = (Finite::new(BIAS), Finite::new(DRIFT));
    let metres = |wrap: fn(MetresFault) -> Faulty| {
        [MetresFault::Silent, MetresFault::Stuck, MetresFault::Biased(by), MetresFault::Drifting(per_s)].map(wrap)
    };
    let speed = |wrap: fn(SpeedFault) -> Faulty| {
        [SpeedFault::Silent, SpeedFault::Stuck, SpeedFault::Biased(by), SpeedFault::Drifting(per_s)].map(wrap)
    };
    vec![
        (
            |r| r.chemical.map(|r| 10.0 * r.of_full_scale),
            [DyeFault::Silent, DyeFault::Stuck, DyeFault::Biased(by), DyeFault::Drifting(per_s)]
                .map(Faulty::Fluorometer),
        ),
        (
            // From south, so that it does not jump at north.
            |r| r.attitude.map(|r| r.heading.opposite().deg()),
            [HeadingFault::Silent, HeadingFault::Stuck, HeadingFault::Biased(by), HeadingFault::Drifting(per_s)]
                .map(Faulty::Compass),
        ),
        (|r| r.depth.map(|r| r.depth_m), metres(Faulty::Depth)),
        (|r| r.altimeter.map(|r| r.altitude_m), metres(Faulty::Altimeter)),
        (|r| r.dvl.map(|r| r.v_body_m_s.x), speed(Faulty::Dvl)),
        (|r| r.adcp.map(|r| r.v_body_m_s.x), speed(Faulty::Adcp)),
        (
            |r| r.ctd.map(|r| r.density_kg_m3),
            [DensityFault::Silent, DensityFault::Stuck, DensityFault::Biased(by), DensityFault::Drifting(per_s)]
                .map(Faulty::Ctd),
        ),
        (
            |r| r.lbl.map(|r| r.position.x),
            // The last grows to 0.4 m within the 40 s of the fault.
            [FixFault::Silent, FixFault::Stuck, lie(BIAS, 0.0), lie(40.0 * DRIFT, 40.0)].map(Faulty::Fixes),
        ),
    ]
}

fn lie(east_m: f64, over_s: f64) -> FixFault {
    FixFault::Lie(LieSpec { east_m: Finite::new(east_m), north_m: Finite::new(0.0), over_s: NonNegative::new(over_s) })
}

/// Readings before and after the fault are those of a healthy instrument; so are all others.
#[track_caller]
fn only_this_in_its_time(healthy: &[Readings], faulty: &[Readings], number: Number) {
    let mut changed = 0;
    for (n, (well, ill)) in healthy.iter().zip(faulty).enumerate() {
        let t_s = n as f64 * DT_S;
        if !(AT_S..UNTIL_S).contains(&t_s) {
            assert!(well == ill, "at {t_s} s");
        } else if number(well) == number(ill) {
            assert!(well == ill, "another instrument at {t_s} s");
        } else {
            changed += 1;
        }
    }
    assert!(changed >= 7, "{changed} readings changed");
}

#[test]
fn every_instrument_with_every_fault() {
    let healthy = read(None, 5.0);
    let (from, until) = ((AT_S / DT_S) as usize, (UNTIL_S / DT_S) as usize);
    for (number, [silent, stuck, biased, drifting]) in cases() {
        let said = format!("{biased:?}");
        let within = |what: &Faulty| -> Vec<(f64, Option<f64>, Option<f64>)> {
            let faulty = read(Some(what.clone()), 5.0);
            only_this_in_its_time(&healthy, &faulty, number);
            (from..until)
                .map(|n| (n as f64 * DT_S, number(&healthy[n]), number(&faulty[n])))
                .filter(|(_, well, _)| well.is_some())
                .collect()
        };
        assert!(within(&silent).iter().all(|(.., ill)| ill.is_none()), "{said}");
        let last = healthy[..from].iter().rev().find_map(number);
        assert!(within(&stuck).iter().all(|(.., ill)| *ill == last), "{said}");
        for (what, error) in [(biased, (BIAS, 0.0)), (drifting, (0.0, DRIFT))] {
            for (t_s, well, ill) in within(&what) {
                let want = well.expect("there") + error.0 + error.1 * (t_s - AT_S);
                let got = ill.expect("as often as before");
                assert!((got - want).abs() < 1e-9, "{what:?} at {t_s}: {got}, {want}");
            }
        }
    }
}

#[test]
fn eyes_fall_silent_or_stick() {
    let healthy = read(None, 5.0);
    let (from, until) = ((AT_S / DT_S) as usize, (UNTIL_S / DT_S) as usize);
    let silent = read(Some(Faulty::Sidescan(EyeFault::Silent)), 5.0);
    assert!(silent[from..until].iter().all(|r| r.sidescan.is_none()));
    let stuck = read(Some(Faulty::Sidescan(EyeFault::Stuck)), 5.0);
    let last = healthy[..from].iter().rev().find_map(|r| r.sidescan.clone());
    let pings: Vec<_> = stuck[from..until].iter().filter_map(|r| r.sidescan.clone()).collect();
    assert_eq!(pings.len(), 40);
    assert!(pings.iter().all(|p| Some(p) == last.as_ref()));
}

#[test]
fn a_biased_fluorometer_smells_what_is_not_there() {
    let detects = |what: DyeFault| {
        let all = read(Some(Faulty::Fluorometer(what)), 5.0);
        let seen = all.iter().filter_map(|r| r.chemical);
        assert!(seen.clone().all(|r| (0.0..=1.0).contains(&r.of_full_scale)));
        assert!(seen.clone().all(|r| r.volts == 5.0 * r.of_full_scale));
        seen.filter(|r| r.detected).count()
    };
    // A hundredth of full scale is there; the threshold is four hundredths, the converter ends at full scale.
    let at = |ug_l: f64| detects(DyeFault::Biased(Finite::new(ug_l)));
    assert_eq!([at(-0.5), at(0.5), at(1e6)], [0, 400, 400]);
}

#[test]
fn what_is_invalid_stays_so_and_no_range_is_negative() {
    let (up, down) = (Finite::new(3.0), Finite::new(-10.0));
    // 0.1 m above the bed neither altimeter nor Doppler log hears it.
    let blind = read(None, 7.9);
    assert!(blind.iter().filter_map(|r| r.dvl).all(|r| !r.valid));
    for what in [
        Faulty::Dvl(SpeedFault::Biased(up)),
        Faulty::Dvl(SpeedFault::Drifting(Finite::new(0.1))),
        Faulty::Altimeter(MetresFault::Biased(up)),
    ] {
        assert!(read(Some(what), 7.9) == blind);
    }
    let low = read(Some(Faulty::Altimeter(MetresFault::Biased(down))), 5.0);
    let heights = || low.iter().filter_map(|r| r.altimeter);
    assert!(heights().all(|r| r.valid && r.altitude_m >= 0.0));
    assert_eq!(heights().filter(|r| r.altitude_m == 0.0).count(), 200);
    // The ranging sees nothing here: a bias makes no echo.
    let ranging = read(Some(Faulty::Ranging(MetresFault::Biased(up))), 2.0);
    let healthy = read(None, 2.0);
    assert!(ranging == healthy);
}

#[test]
fn a_biased_ranging_moves_its_echoes() {
    use crate::handoff::{Beam, RangeScan};
    let scan = |echoes: [Option<f64>; 3]| RangeScan {
        p_BS: Vector3::zeros(),
        max_m: 20.0,
        beams: echoes.map(|echo_m| Beam { dir_B: Vector3::x(), echo_m }).into(),
    };
    for (by, want) in [(5.0, [Some(8.0), None, None]), (-5.0, [Some(0.0), None, Some(12.0)])] {
        let what = Faulty::Ranging(MetresFault::Biased(Finite::new(by)));
        let faults = [fault(0.0, None, what)];
        let mut faults = SensorFaults::new(&faults, &SensorsSpec::default(), DT_S);
        let mut readings = Readings { ranging: Some(scan([Some(3.0), None, Some(17.0)])), ..Readings::default() };
        faults.alter(&Clock::new(DT_S), &mut readings);
        assert_eq!(readings.ranging, Some(scan(want)));
    }
}

#[test]
fn an_instrument_that_sticks_before_its_first_reading_sticks_at_that() {
    let stuck = FixFault::Stuck;
    let faults = [fault(0.0, None, Faulty::Fixes(stuck))];
    let mut faults = SensorFaults::new(&faults, &sensors(), DT_S);
    let fixes: Vec<_> = (0..4)
        .map(|step| {
            let position = Vector2::new(step as f64, 0.0);
            let mut readings =
                Readings { lbl: (step % 2 == 1).then_some(crate::handoff::LblFix { position }), ..Readings::default() };
            faults.alter(&Clock { step, dt_s: DT_S }, &mut readings);
            readings.lbl.map(|f| f.position.x)
        })
        .collect();
    assert_eq!(fixes, [None, Some(1.0), None, Some(1.0)]);
}
