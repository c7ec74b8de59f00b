//! The row files that come with the program.

macro_rules! row {
    ($name:literal) => {
        ($name, include_str!(concat!("../../../rows/", $name, ".ron")))
    };
}

/// Their names and texts.
pub(super) const ROWS: &[(&str, &str)] = &[
    row!("crab"),
    row!("crab_arms"),
    row!("crab_identify"),
    row!("eyes"),
    row!("duck_st"),
    row!("dalian_bay"),
    row!("duck_mt"),
    row!("san_clemente"),
    row!("reliability_duck"),
    row!("reliability_four"),
    row!("reliability_harbour"),
    row!("reliability_laminar"),
    row!("reliability_turbulent"),
    row!("t13_rate"),
    row!("t13_ladder_t"),
    row!("t13_ladder_f"),
    row!("t13_turns"),
    row!("t13_siz_t"),
    row!("t13_siz_f"),
    row!("hulls_lauv"),
    row!("hulls_harbour"),
    row!("hulls_lake"),
    row!("wp_laminar"),
    row!("wp_turbulent"),
    row!("wp_dead_end"),
];
