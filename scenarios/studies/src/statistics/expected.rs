//! The textbook's expectations for the plume of a channel.
//!
//! *Source*: transverse K = 0.15 u_*H and depth mean of the vertical one 0.067 u_*H (Fischer et al. 1979, Mixing in
//! Inland and Coastal Waters, section 5.1); plume of a steady point source, Q/(4πx√(K_yK_z)), σ = √(2Kx/U) (Csanady
//! 1973, Turbulent Diffusion in the Environment); intensities and macro-scale of Nezu & Nakagawa 1993.
//!
//! *Parameters*: depth, mean speed, friction velocity.
//!
//! *Deviations*: as in the textbook, the centreline figure ignores bed and surface, which can as much as double it.

use plumes::flow::channel::{Channel, TRANSVERSE};

/// Elder's depth mean divided by u_*H.
const VERTICAL: f64 = 0.067;

/// Figures of a channel.
pub(super) struct ChannelFigures {
    pub(super) k_y: f64,
    pub(super) k_z: f64,
    mean_m_s: f64,
}

impl ChannelFigures {
    pub(super) fn from_channel(channel: &Channel) -> Self {
        let scale = channel.u_star_m_s * channel.depth_m;
        Self { k_y: TRANSVERSE * scale, k_z: VERTICAL * scale, mean_m_s: channel.mean_m_s }
    }

    /// Mean speed, m/s.
    pub(super) fn mean_m_s(&self) -> f64 {
        self.mean_m_s
    }

    /// Half-width of the mean plume, m.
    pub(super) fn sigma_y(&self, x_m: f64) -> f64 {
        (2.0 * self.k_y * x_m / self.mean_m_s).sqrt()
    }

    /// Mean concentration on the centreline divided by that at the nozzle, for the volume that it releases (m³/s).
    pub(super) fn centreline(&self, x_m: f64, volume_m3_s: f64) -> f64 {
        let mixing = (self.k_y * self.k_z).sqrt();
        volume_m3_s / (4.0 * std::f64::consts::PI * x_m * mixing)
    }

    /// Time in which the macro-scale L = H(z/H)^½ passes, s.
    pub(super) fn passing_s(channel: &Channel, height_m: f64) -> f64 {
        let part = (height_m / channel.depth_m).min(0.6);
        channel.depth_m * part.sqrt() / channel.speed(height_m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The flume of Webster et al. 2012 with u_* = 2.8 mm/s: 4.1, 5.8, 7.1, 8.2 cm and 2.0e-3, 9.9e-4, 4.9e-4.
    #[test]
    fn textbook_figures_of_the_flume() {
        let e = ChannelFigures { k_y: 0.15 * 0.0028 * 0.2, k_z: 0.067 * 0.0028 * 0.2, mean_m_s: 0.05 };
        for (x, cm) in [(0.5, 4.1), (1.0, 5.8), (1.5, 7.1), (2.0, 8.2)] {
            assert!((100.0 * e.sigma_y(x) - cm).abs() < 0.06, "{x}");
        }
        let volume = std::f64::consts::FRAC_PI_4 * 0.0042 * 0.0042 * 0.05;
        for (x, c) in [(0.5, 2.0e-3), (1.0, 9.9e-4), (2.0, 4.9e-4)] {
            assert!((e.centreline(x, volume) / c - 1.0).abs() < 0.03, "{x}");
        }
    }
}
