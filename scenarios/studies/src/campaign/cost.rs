//! How many runs a block holds, from the cost of a run.

use super::plan::Campaign;

/// Wall time of a block on one thread, s, if a run is short enough.
const BLOCK_S: f64 = 30.0;

/// Most runs in a block unless another length is asked for.
pub const LONGEST: u64 = 256;

/// Least number of blocks per share, where the campaign has enough runs, so that work can be distributed.
const A_SHARE: u64 = 4;

/// Runs in a block: as many as one thread does in about half a minute. The number is a multiple of the arms, at most
/// [`LONGEST`], and small enough that each of `shares` processes has several. `spin_up_s` and `mission_s` are the wall
/// times of one run.
pub fn block_of(campaign: &Campaign, spin_up_s: f64, mission_s: f64, shares: u64) -> u64 {
    let arms = campaign.n_arms();
    // At best, the arms of a seed share its spin-up.
    let group_s = spin_up_s + arms as f64 * mission_s;
    let in_time = if group_s > 0.0 { (BLOCK_S / group_s).min(LONGEST as f64) as u64 } else { LONGEST };
    let groups = campaign.n_runs() / arms;
    let dealt = groups / shares.saturating_mul(A_SHARE).max(1);
    arms * in_time.min(LONGEST / arms).min(dealt).max(1)
}

#[cfg(test)]
mod tests {
    use super::super::load;
    use super::*;
    use std::path::Path;
    use world::registry::Registry;

    #[test]
    fn blocks_take_half_a_minute_hold_whole_seeds_and_leave_something_to_deal_out() {
        // Six arms, two conditions, 50 seeds: 600 runs.
        let campaign = load(&Registry::default(), Path::new("crab_units")).unwrap();
        let of = |spin_up_s, mission_s, shares| block_of(&campaign, spin_up_s, mission_s, shares);
        assert_eq!(of(4.0, 1.0, 1), 18);
        assert_eq!(of(3600.0, 60.0, 1), 6);
        // 100 seeds in at least 4 blocks.
        assert_eq!(of(0.0, 0.01, 1), 150);
        assert_eq!(of(0.0, 0.0, 1), 150);
        assert_eq!(of(0.0, 0.01, 5), 30);
        assert_eq!(of(0.0, 0.01, u64::MAX), 6);
        for bad in [f64::NAN, f64::INFINITY, -1.0] {
            assert_eq!(of(bad, 1.0, 1) % 6, 0);
        }
    }
}
