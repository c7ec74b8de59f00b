//! Size of the smallest set of cells that holds a share of the probability.
//!
//! *Source*: highest-density credible regions, Box & Tiao 1973, Bayesian Inference in Statistical Analysis, section
//! 2.8.
//!
//! *Parameters*: the share.
//!
//! *Deviations*: cells are whole: the last one is counted as a whole.

/// How many cells, the most probable first, reach `share` of the total. It works by halving, in a time linear in the
/// number of cells. `work` is scratch space.
pub(super) fn cells(p: &[f64], share: f64, work: &mut Vec<f64>) -> usize {
    work.clear();
    work.extend_from_slice(p);
    let mut rest: &mut [f64] = work;
    let (mut taken, mut wanted) = (0, share);
    while rest.len() > 1 {
        let mid = rest.len() / 2;
        rest.select_nth_unstable_by(mid, |a, b| b.total_cmp(a));
        let upper: f64 = rest[..mid].iter().sum();
        if upper >= wanted {
            rest = &mut rest[..mid];
        } else {
            wanted -= upper;
            taken += mid;
            rest = &mut rest[mid..];
        }
    }
    taken + rest.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn equal_cells_are_counted_as_all_others() {
        // 1000 equal cells: 950, plus or minus the one that rounding may add or remove.
        let even = vec![0.001; 1000];
        assert!(cells(&even, 0.95, &mut Vec::new()).abs_diff(950) <= 1);
    }

    proptest! {
        #![proptest_config(crate::handoff::testing::fixed(128))]

        #[test]
        fn same_as_by_sorting(p in proptest::collection::vec(0.001..1.0f64, 1..200)) {
            let total: f64 = p.iter().sum();
            let p: Vec<f64> = p.iter().map(|v| v / total).collect();
            let mut sorted = p.clone();
            sorted.sort_by(|a, b| b.total_cmp(a));
            let mut sum = 0.0;
            let by_sorting = sorted.iter().take_while(|v| {
                let before = sum;
                sum += **v;
                before < 0.95
            }).count();
            prop_assert_eq!(cells(&p, 0.95, &mut Vec::new()), by_sorting);
        }
    }
}
