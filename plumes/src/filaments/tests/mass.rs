//! Exact tests of mass: the kernel integrates to 1, and what was released is either present or has left.

use super::water::{Given, plume, pour, source};
use nalgebra::Vector3;
use world::fields::Concentration;
use world::terrain::Terrain;

/// Integral of the concentration of one filament of the given age over the whole water column, divided by its mass.
fn integral(age_s: f64, depth: f64, z: f64) -> f64 {
    let mut p = plume(source(0.5, 1.0, 0.001, 0.0316), &Terrain::Level { depth_m: depth });
    pour(&mut p, 1, -depth, |_| [0.0, 0.0, z]);
    let still = Given(|_| 0.0, |_| (0.0, 0.0));
    // The source itself is far away, so that its own releases have no effect at the datum.
    p.drift(&still, 0.0, age_s);
    let f = p.iter().next().expect("the filament");
    let size = f[3];
    let (cells, layers) = (40, (8.0 * depth / size.min(0.5 * depth)).ceil() as usize);
    let (side, height) = (9.0 * size / f64::from(cells), depth / layers as f64);
    let mut sum = 0.0;
    for i in 0..cells {
        for j in 0..cells {
            for k in 0..layers {
                let x = (f64::from(i) + 0.5) * side - 4.5 * size;
                let y = (f64::from(j) + 0.5) * side - 4.5 * size;
                let z = -(k as f64 + 0.5) * height;
                sum += p.concentration(&Vector3::new(x, y, z));
            }
        }
    }
    sum * side * side * height / f[4]
}

#[test]
fn kernel_integrates_to_one_wherever_it_is() {
    // Midpoint sums with cells of about a quarter of the size; the remaining error is the jump at the cut, 3e-4 of the
    // peak.
    for (age, depth, z) in [
        (10.0, 4.0, -2.0),
        (10.0, 4.0, -4.0),
        (10.0, 4.0, -3.95),
        (10.0, 4.0, 0.0),
        (500.0, 2.0, -1.0),
        (500.0, 2.0, -1.7),
        (2000.0, 1.0, -0.1),
        (2000.0, 1.0, -1.0),
        (2000.0, 1.0, -0.5),
    ] {
        let total = integral(age, depth, z);
        assert!((total - 1.0).abs() < 1e-3, "age {age}, depth {depth}, z {z}: {total}");
    }
}

#[test]
fn released_is_here_or_has_left() {
    let mut p = plume(source(1.0, 37.0, 0.001, 0.03), &Terrain::Level { depth_m: 6.0 });
    let water = Given(|z| 0.8 + 0.05 * z, |_| (0.3, 0.01));
    for k in 0..1500 {
        p.drift(&water, 0.7 * f64::from(k), 0.7 * f64::from(k + 1));
        let (released, here, left) = (p.mass_released_kg(), p.mass_in_kg(), p.mass_left_kg());
        assert!((released - here - left).abs() <= 1e-6 * released);
        let listed: f64 = p.iter().map(|f| f[4]).sum();
        assert!((listed - here).abs() <= 1e-6 * here);
    }
    // 1 g/s for 1050 s, within five times the root of 38850 portions of 1/37 g.
    assert!((p.mass_released_kg() - 1.05).abs() < 0.027, "{}", p.mass_released_kg());
    assert!(p.mass_left_kg() > 0.1 && p.mass_in_kg() > 0.1);
    // Fewer filaments stand for all of them: mass and number sum to the true total, however few are shown.
    for most in [1, 37, 500, 1_000_000] {
        let few = p.decimated(most);
        assert!(few.len() <= most && few == p.decimated(most));
        let sum = |k: usize| few.iter().map(|f| f[k]).sum::<f64>();
        assert!((sum(4) / p.mass_in_kg() - 1.0).abs() < 1e-5, "{most}");
        assert!((sum(5) / p.len() as f64 - 1.0).abs() < 1e-5, "{most}");
    }
    assert!(p.decimated(500).len() > 400);
}
