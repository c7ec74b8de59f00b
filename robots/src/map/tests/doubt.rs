//! What a map may doubt: places within a cell, strength and size of releases, errors of navigation and of the flow,
//! readings that repeat each other.

use crate::map::catalogue::MapSpec;
use crate::map::doubt::evidence::{DoubtSpec, Repeats};
use crate::map::hmm::HmmSpec;
use crate::map::mapper::Mapper;
use crate::map::pomdp::PomdpSpec;
use crate::map::spec::{GridSpec, TrajectorySpec};
use crate::map::testing::{ToyPlume, build, every, grid, paper_area};
use crate::map::watch::MapObservation;
use crate::map::workings::CellsSpec;
use nalgebra::{Vector2, Vector3};
use world::math;
use world::ranges::{Fraction, NonNegative, Positive};
use world::seeds::Stream;

fn plain() -> CellsSpec {
    CellsSpec {
        grid: GridSpec { along: 20, across: 10, ..GridSpec::default() },
        trajectory: TrajectorySpec {
            lookback_s: Positive::new(60.0),
            merge: Fraction::new(0.0),
            ..TrajectorySpec::default()
        },
        false_detection: Fraction::new(1e-3),
        ..CellsSpec::default()
    }
}

/// Everything at once.
fn doubtful() -> DoubtSpec {
    DoubtSpec {
        missed: Fraction::new(0.05),
        correlation_s: NonNegative::new(2.0),
        repeats: Repeats::Markov,
        fix_m: NonNegative::new(3.0),
        drift_m_s: NonNegative::new(0.05),
        flow_m_s: NonNegative::new(0.05),
        strengths: [1.0, 4.0].map(Positive::new).to_vec(),
        flow_lasts_s: Some(Positive::new(100.0)),
    }
}

fn pomdp(spec: &CellsSpec) -> Box<dyn Mapper> {
    build(&MapSpec::new(PomdpSpec(spec.clone())))
}

fn refused(spec: &MapSpec) -> String {
    spec.build(&paper_area(), Stream::new(3, "auv0", "map")).expect_err("refused").to_string()
}

/// A vehicle on the line y = 50 m, and what it detects there.
fn seen(t_s: f64, x: f64, detected: bool) -> MapObservation {
    MapObservation {
        t_s,
        p_W: Vector3::new(x, 50.1, -2.0),
        detected: Some(detected),
        flow: Some(Vector2::new(0.5, 0.0)),
        fixed: false,
    }
}

#[test]
fn every_map_with_every_doubt_stays_a_belief() {
    let mut spec = plain();
    spec.grid.places = 3;
    // The plume is met 75 m down-flow of its source.
    spec.trajectory.lookback_s = Positive::new(200.0);
    spec.trajectory.merge = Fraction::new(0.3);
    spec.trajectory.initial_m = NonNegative::new(0.5);
    spec.doubt = doubtful();
    for map in every(&spec, 300) {
        let mut mapper = build(&map);
        let mut plume = ToyPlume::slow();
        for t in 1..=240 {
            mapper.step(&MapObservation { fixed: t % 30 == 0, ..plume.seen(f64::from(t)) });
            let b = mapper.belief();
            let total: f64 = b.p.iter().sum();
            assert!((total - 1.0).abs() < 1e-9, "{}: {total}", map.name());
            assert_eq!(b.p.len(), 200);
        }
        let b = mapper.belief();
        let near = b.within(plume.source, 20.0);
        // An even map has an eighth there.
        assert!(b.informed && near > 0.25, "{}: {near}", map.name());
    }
}

/// The cell's probability is the likelihood of all readings together, averaged over its places: eq. 2 written out.
#[test]
fn a_cell_has_the_sum_of_its_places() {
    let mut spec = plain();
    spec.grid.places = 3;
    let mut mapper = pomdp(&spec);
    let fine = grid([60, 30, 1]);
    let mut ln_l = vec![0.0; fine.len()];
    let path = [(1.0, 60.0, false), (2.0, 61.0, true), (3.0, 63.0, true), (4.0, 65.0, false)];
    mapper.step(&seen(0.0, 60.0, false));
    for (t, x, detected) in path {
        mapper.step(&seen(t, x, detected));
        let at = fine.local_centre(fine.cell(&Vector3::new(x, 50.1, -2.0)).expect("inside"));
        for (i, ln_l) in ln_l.iter_mut().enumerate() {
            let from = fine.local_centre(i);
            let mut gamma = 1.0;
            for age in 1..=60 {
                let age = f64::from(age);
                let d = [at[0] - from[0] - 0.5 * age, at[1] - from[1]];
                let var = 0.25 * age;
                // Dye is met within a cell of 5 by 10 m.
                let top = 50.0 / (std::f64::consts::TAU * var);
                let p = top * math::exp(-0.5 * (d[0] * d[0] + d[1] * d[1]) / var);
                gamma *= 1.0 - 0.9 * p.min(1.0);
            }
            *ln_l += math::ln(if detected { 1e-3 + (1.0 - 1e-3) * (1.0 - gamma) } else { gamma.max(1e-280) });
        }
    }
    let b = mapper.belief();
    let mut wanted = vec![0.0; 200];
    for (i, ln_l) in ln_l.iter().enumerate() {
        let [x, y, _] = fine.place(i);
        wanted[y / 3 * 20 + x / 3] += math::exp(*ln_l);
    }
    let total: f64 = wanted.iter().sum();
    for (p, wanted) in b.p.iter().zip(&wanted) {
        assert!((p - wanted / total).abs() < 1e-9, "{p} {}", wanted / total);
    }
}

/// The belief of several strengths is the mean of theirs, by what each gave to the readings.
#[test]
fn strengths_are_weighted_by_what_they_predict() {
    let of = |strengths: &[f64]| {
        let mut spec = plain();
        spec.doubt.strengths = strengths.iter().map(|s| Positive::new(*s)).collect();
        let mut mapper = pomdp(&spec);
        let mut plume = ToyPlume::slow();
        for t in 1..=120 {
            mapper.step(&plume.seen(f64::from(t)));
        }
        mapper
    };
    let (none, one, four, both) = (of(&[]), of(&[1.0]), of(&[4.0]), of(&[1.0, 4.0]));
    assert_eq!(none.belief().p, one.belief().p);
    assert_ne!(none.belief().p, four.belief().p);
    let [a, b] = [&one, &four].map(|m| m.ln_evidence());
    let share = 1.0 / (1.0 + math::exp(b - a));
    assert!(a < 0.0 && (0.0..=1.0).contains(&share));
    let all = one.belief().p.iter().zip(four.belief().p.iter());
    for ((p, q), got) in all.zip(both.belief().p.iter()) {
        let wanted = share * p + (1.0 - share) * q;
        assert!((got - wanted).abs() < 1e-9, "{got} {wanted}");
    }
}

/// The flow is measured without its part across; with a stated error the map finds the source all the same.
#[test]
fn a_flow_that_is_wrong_all_along_moves_the_map_and_a_stated_error_keeps_the_place_possible() {
    let of = |flow_m_s: f64| {
        let mut spec = plain();
        spec.doubt.flow_m_s = NonNegative::new(flow_m_s);
        let mut mapper = pomdp(&spec);
        let mut plume = ToyPlume::new([20.0, 40.0].into(), |_| [0.6, 0.1].into(), 4);
        for t in 1..=240 {
            let seen = plume.seen(f64::from(t));
            mapper.step(&MapObservation { flow: Some(Vector2::new(0.6, 0.0)), ..seen });
        }
        mapper.belief().within(Vector2::new(20.0, 40.0), 10.0)
    };
    let [told, untold] = [of(0.06), of(0.0)];
    assert!(told > 0.5 && told > untold, "{told} {untold}");
}

/// Fixes with a large stated error leave the map wide, drift alone less so; the order of map and truth stays.
#[test]
fn an_error_that_readings_share_widens_the_map() {
    let of = |fix_m: f64| {
        let mut spec = plain();
        spec.grid.places = 3;
        spec.doubt.fix_m = NonNegative::new(fix_m);
        let mut mapper = pomdp(&spec);
        let mut plume = ToyPlume::slow();
        for t in 0..=100 {
            mapper.step(&MapObservation { fixed: t == 5, ..plume.seen(f64::from(t)) });
        }
        mapper.belief().entropy_nat
    };
    let [sharp, same, wide] = [of(0.0), of(0.01), of(12.0)];
    assert!((sharp - same).abs() < 0.05, "{sharp} {same}");
    assert!(wide > sharp + 0.5, "{sharp} {wide}");
}

#[test]
fn odd_doubts_are_refused_with_the_legal_range() {
    let cells = |change: &dyn Fn(&mut CellsSpec)| {
        let mut spec = plain();
        change(&mut spec);
        every(&spec, 300).to_vec()
    };
    let first = |change: &dyn Fn(&mut CellsSpec)| cells(change)[..1].to_vec();
    let hmm = |change: &dyn Fn(&mut HmmSpec)| {
        let mut spec = HmmSpec::default();
        change(&mut spec);
        vec![MapSpec::new(spec)]
    };
    let m = Positive::new;
    for (maps, says) in [
        (cells(&|s| s.grid.places = 2), "map.grid.places: must be odd and from 1 to 9, got 2"),
        (
            first(&|s| (s.grid.places, s.grid.along) = (9, 2000)),
            "map.grid: must have at most 1000000 places, got 1620000",
        ),
        (
            cells(&|s| s.doubt.strengths = vec![m(1.0), m(1e3)]),
            "map.doubt.strengths: must be from 0.01 to 100 each, got 1000",
        ),
        (first(&|s| s.doubt.strengths = vec![m(1.0); 10]), "map.doubt.strengths: must be at most 9, got 10"),
        (cells(&|s| s.doubt.missed = Fraction::new(1.0)), "map.doubt.missed: must be less than 1, got 1"),
        (
            first(&|s| s.false_detection = Fraction::new(0.0)),
            "map.false_detection: must be greater than 0 and less than 1, got 0",
        ),
        (
            hmm(&|s| (s.odour_every_s, s.grid.places) = (Some(m(60.0)), 3)),
            "map.odour_every_s: must not be given with grid.places 3",
        ),
        (hmm(&|s| s.trajectory.initial_m = NonNegative::new(1e4)), "map.trajectory.initial_m: must be at most "),
    ] {
        for map in maps {
            assert!(refused(&map).starts_with(says), "{}", refused(&map));
        }
    }
}
