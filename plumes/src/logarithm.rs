//! Natural logarithm in single precision.
//!
//! *Source*: ln m = 2 artanh((m − 1)/(m + 1)) by its series.
//!
//! *Parameters*: none.
//!
//! *Deviations*: within 1e-6 of the function. It has neither branches nor tables, so that the compiler can compute eight
//! at once, and gives the same bits on every machine.

use std::f32::consts::LN_2;

/// ln(u·2^−halvings) of a positive, normal number.
#[inline(always)]
pub(crate) fn ln(u: f32, halvings: i32) -> f32 {
    // u = m·2^e with m in [√½, √2), so that (m − 1)/(m + 1) is below 0.172.
    let raw = u.to_bits() as i32;
    let e = (raw - 0x3f35_04f3) >> 23;
    let m = f32::from_bits((raw - (e << 23)) as u32);
    let t = (m - 1.0) / (m + 1.0);
    let q = t * t;
    let ln_m = 2.0 * t * (1.0 + q * (1.0 / 3.0 + q * (0.2 + q * (1.0 / 7.0))));
    (e - halvings) as f32 * LN_2 + ln_m
}
