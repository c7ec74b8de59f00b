//! The rules in made-up missions: headway up-flow, then points scattered around the source.

use super::testing::{n, siz_f, siz_t};
use super::{AdaptiveSize, SizF, ZoneSize};
use crate::handoff::Lcdp;
use crate::memory::{FixMove, NavigationFix, PlumeMemory};
use nalgebra::Vector2;
use world::math;
use world::seeds::Stream;
use world::units::Heading;

fn up() -> Heading {
    Heading::from_deg(270.0)
}

const SOURCE: Vector2<f64> = Vector2::new(20.0, 0.0);

/// `way` points 10 m apart down-flow of the source, then `near` points around it, scattered by `scatter_m` in each
/// axis.
fn mission(way: usize, near: usize, scatter_m: f64, rng: &mut Stream) -> Vec<Lcdp> {
    let mut off = || Vector2::new(rng.normal(), rng.normal()) * scatter_m;
    let along = |k: usize| SOURCE + Vector2::new(10.0 * (way - k) as f64, 0.0);
    (0..way + near)
        .map(|k| {
            let at = if k < way { along(k) } else { SOURCE };
            Lcdp::new_at(90.0 * k as f64, at + off())
        })
        .collect()
}

/// Share of `trials` in which something happens.
fn share(trials: u32, mut happens: impl FnMut() -> bool) -> f64 {
    f64::from((0..trials).filter(|_| happens()).count() as u32) / f64::from(trials)
}

/// Five standard errors of a share over `trials`.
fn five_errors(p: f64, trials: u32) -> f64 {
    5.0 * (p * (1.0 - p) / f64::from(trials)).sqrt()
}

#[test]
fn two_points_are_declared_as_often_as_chance_has_it() {
    // Two points off by sigma an axis differ by a Rayleigh-distributed way of scale sqrt(2) sigma, which is the
    // diagonal; their distance from their mean is half of it.
    let mut rng = Stream::new(1, "two", "test");
    for (eps_m, scatter_m) in [(3.0, 1.0), (4.0, 2.0), (3.0, 5.0)] {
        let mut pair = || mission(0, 2, scatter_m, &mut rng);
        let ratio = (eps_m / scatter_m) * (eps_m / scatter_m);
        let p_t = 1.0 - math::exp(-ratio / 4.0);
        let t = share(4000, || siz_t(eps_m, 2).declare(&pair(), up(), 0.0).is_some());
        assert!((t - p_t).abs() < five_errors(p_t, 4000), "{t}, {p_t}");
        let p_f = 1.0 - math::exp(-ratio);
        let f = share(4000, || siz_f(eps_m, 2).declare(&pair(), up(), 0.0).is_some());
        assert!((f - p_f).abs() < five_errors(p_f, 4000), "{f}, {p_f}");
    }
}

#[test]
fn the_paper_s_settings_find_a_narrow_cluster_at_the_end_of_the_way() {
    let mut rng = Stream::new(2, "narrow", "test");
    for _ in 0..200 {
        let points = mission(5, 6, 0.3, &mut rng);
        // 4 m hold six points off by 0.3 m an axis, and 3 m three: a range of 13 sigma, and of 10.
        let (mean, evidence) = siz_t(4.0, 6).declare(&points, up(), 0.0).expect("narrow");
        assert!((mean - SOURCE).norm() < 1.0);
        assert_eq!((evidence.points, evidence.since_s), (6, 450.0));
        assert!(siz_t(3.0, 3).declare(&points, up(), 0.0).is_some());
        let (first, evidence) = siz_f(6.0, 6).declare(&points, up(), 0.0).expect("narrow");
        // 10 m down-flow of six the next point is 8.6 m off the mean of seven, and goes.
        assert_eq!(evidence.points, 6);
        assert!((first - SOURCE).norm() < 2.0 && first.x < SOURCE.x + 0.3);
        // One fewer is not enough.
        let early = &points[..10];
        assert!(siz_t(4.0, 6).declare(early, up(), 0.0).is_none());
        assert!(siz_f(6.0, 6).declare(early, up(), 0.0).is_none());
    }
}

#[test]
fn jumps_of_ten_metres_keep_a_small_box_from_ever_filling() {
    // Points off by 5 m an axis, as if each had a fix of its own: six of them in 4 m are hopeless, an adaptive zone
    // that knows of the fixes holds them.
    let mut rng = Stream::new(3, "wide", "test");
    let mut wide = || mission(5, 6, 5.0, &mut rng);
    let small = share(2000, || siz_t(4.0, 6).declare(&wide(), up(), 5.0).is_some());
    // Dead reckoning is exact here, but the fixes err by 5 m in each axis and one comes before each point.
    assert!(small < 0.001, "{small}");
    let adaptive = SizF { size: ZoneSize::Adaptive(AdaptiveSize::default()), ..SizF::default() };
    let grown = share(2000, || adaptive.declare(&wide(), up(), 5.0).is_some());
    let fixed = share(2000, || siz_f(6.0, 6).declare(&wide(), up(), 5.0).is_some());
    assert!(grown > 0.9 && fixed < 0.5, "{grown}, {fixed}");
}

#[test]
fn points_that_move_with_their_fixes_lie_as_dead_reckoning_has_them() {
    // Only the newest fix and the mean of the cluster are in error.
    let mut rng = Stream::new(4, "moved", "test");
    for _ in 0..100 {
        let (mut stay, mut whole) = (PlumeMemory::new(n(9), n(9)), PlumeMemory::new(n(9), n(9)));
        let mut off = Vector2::zeros();
        for (k, p) in mission(0, 6, 0.3, &mut rng).iter().enumerate() {
            let fix_off = Vector2::new(rng.normal(), rng.normal()) * 5.0;
            let fix =
                NavigationFix { since_s: 90.0 * (k as f64 - 1.0), t_s: 90.0 * k as f64 - 1.0, jump: fix_off - off };
            off = fix_off;
            stay.take_fix(&fix, FixMove::Stay);
            whole.take_fix(&fix, FixMove::Whole);
            let believed = Lcdp::new_at(p.t_s, p.position + off);
            stay.lcdps.add(believed);
            whole.lcdps.add(believed);
        }
        let (mean, _) = siz_t(4.0, 6).declare(whole.lcdps.all(), up(), 0.0).expect("narrow");
        // All that is wrong is the newest fix, and the cluster's own mean.
        assert!((mean - SOURCE - off).norm() < 1.0);
        assert!(siz_t(4.0, 6).declare(stay.lcdps.all(), up(), 0.0).is_none());
    }
}
