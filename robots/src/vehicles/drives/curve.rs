//! Thrust in still water by input, and the input for a thrust.
//!
//! *Source:* tables and polynomials as makers of thrusters print them.
//!
//! *Parameters:* [`CurveSpec`].
//!
//! *Deviations:* every curve is kept as a table; a polynomial has 64 straight pieces on each side of zero, 1.2e-4 of
//! full thrust off at most.

use super::spec::CurveSpec;
use crate::error::ensure;
use crate::handoff::ThrustTable;

/// Pieces of a polynomial on each side of zero.
const PIECES: usize = 64;

/// Builds the table of a curve.
///
/// # Errors
/// Which field is wrong, and what would be legal.
pub(in crate::vehicles) fn table(spec: &CurveSpec) -> Result<ThrustTable, String> {
    let points: Vec<(f64, f64)> = match spec {
        CurveSpec::Newtons((astern, ahead)) => {
            let (astern, ahead) = (astern.get(), ahead.get());
            ensure(astern <= 0.0 && ahead >= 0.0 && ahead > astern, || {
                format!("Newtons: must go from a thrust <= 0 to a thrust >= 0, got {astern} to {ahead}")
            })?;
            vec![(astern, astern), (ahead, ahead)]
        }
        CurveSpec::Table(pairs) => pairs.iter().map(|(i, n)| (i.get(), n.get())).collect(),
        CurveSpec::Polynomial((c_1, c_2, from, to)) => {
            let (from, to) = (from.get(), to.get());
            ensure(from <= 0.0 && to >= 0.0 && to > from, || {
                format!("Polynomial: must go from an input <= 0 to an input >= 0, got {from} to {to}")
            })?;
            let at = |n: f64| (n, c_1.get() * n * n.abs() + c_2.get() * n);
            let share = |k: usize| k as f64 / PIECES as f64;
            let below = (1..=PIECES).rev().map(|k| from * share(k));
            let above = (1..=PIECES).map(|k| to * share(k));
            let all = below.chain([0.0]).chain(above);
            let mut points: Vec<_> = all.map(at).collect();
            points.dedup();
            points
        }
    };
    if points.len() < 2 {
        return Err("Table: needs at least two pairs of input and thrust".into());
    }
    for pair in points.windows(2) {
        let [(i, n), (j, m)] = [pair[0], pair[1]];
        ensure(j > i && m >= n, || {
            format!("inputs must rise and thrusts must not fall, but {i} gives {n} N and {j} gives {m} N")
        })?;
    }
    let table = ThrustTable(points);
    let [least, most] = table.thrusts_n();
    ensure(least <= 0.0 && most >= 0.0 && most != least, || {
        format!("thrusts must include zero, got {least} to {most} N")
    })?;
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::*;
    use world::ranges::Finite;

    fn f(v: f64) -> Finite {
        Finite::new(v)
    }

    #[test]
    fn a_table_with_a_dead_band() {
        let pairs = [(1100.0, -40.0), (1464.0, 0.0), (1536.0, 0.0), (1900.0, 51.0)];
        let pairs = pairs.map(|(i, n)| (f(i), f(n))).to_vec();
        let curve = table(&CurveSpec::Table(pairs)).unwrap();
        assert_eq!(curve.thrust_n(1500.0), 0.0);
        assert_eq!(curve.input(0.0), 1500.0);
        assert_eq!(curve.thrust_n(5000.0), 51.0);
        for n in [-40.0, -3.0, 0.5, 20.0, 51.0] {
            assert!((curve.thrust_n(curve.input(n)) - n).abs() < 1e-12, "{n}");
        }
    }

    #[test]
    fn a_polynomial_is_near_its_pieces() {
        let spec = CurveSpec::Polynomial((f(2e-5), f(0.001), f(-1000.0), f(1500.0)));
        let curve = table(&spec).unwrap();
        for n in [-990.0, -321.0, 3.0, 700.0, 1499.0] {
            let exact = 2e-5 * n * f64::abs(n) + 0.001 * n;
            assert!((curve.thrust_n(n) - exact).abs() < 1.3e-4 * 46.5, "{n}");
        }
    }

    #[test]
    fn curves_that_fall_or_push_only_one_way_round_zero_are_refused() {
        let pairs = |pairs: &[(f64, f64)]| CurveSpec::Table(pairs.iter().map(|&(i, n)| (f(i), f(n))).collect());
        for (spec, why) in [
            (pairs(&[(0.0, 0.0)]), "at least two pairs"),
            (pairs(&[(0.0, 0.0), (1.0, -1.0)]), "must not fall"),
            (pairs(&[(0.0, 0.0), (0.0, 1.0)]), "inputs must rise"),
            (pairs(&[(0.0, 1.0), (1.0, 2.0)]), "must include zero"),
            (CurveSpec::Newtons((f(5.0), f(9.0))), "thrust <= 0"),
        ] {
            let said = table(&spec).unwrap_err();
            assert!(said.contains(why), "{said}");
        }
    }
}
