//! Waters in few words.

use world::ranges::{Finite, HeadingDeg, NonNegative, Positive};

use crate::flow::WaterSpec;
use crate::flow::bed::BedSpec;
use crate::flow::catalogue::CurrentSpec;
use crate::flow::layered::{InterfaceSpec, LayerSpec, LayeredSpec, WaveSpec};
use crate::flow::plane_current::meander::MeanderSpec;
use crate::flow::plane_current::tide::{ConstituentSpec, TideSpec};
use crate::flow::plane_current::uniform::UniformSpec;

/// Water of these currents and nothing else.
pub(crate) fn of(currents: Vec<CurrentSpec>) -> WaterSpec {
    WaterSpec { currents, ..WaterSpec::default() }
}

pub(crate) fn uniform(speed: f64, heading: f64) -> CurrentSpec {
    CurrentSpec::new(UniformSpec { speed_m_s: NonNegative::new(speed), heading_deg: HeadingDeg::new(heading) })
}

pub(crate) fn layer(speed: f64, heading: f64, density: f64) -> LayerSpec {
    LayerSpec {
        speed_m_s: NonNegative::new(speed),
        heading_deg: HeadingDeg::new(heading),
        density_kg_m3: Positive::new(density),
    }
}

pub(crate) fn wave(amplitude: f64, length: f64, period: f64, heading: f64, phase: Option<f64>) -> WaveSpec {
    WaveSpec {
        amplitude_m: NonNegative::new(amplitude),
        length_m: Positive::new(length),
        period_s: Positive::new(period),
        heading_deg: HeadingDeg::new(heading),
        phase_deg: phase.map(Finite::new),
    }
}

/// Two layers and the interface between them.
pub(crate) fn two_layers(layers: [LayerSpec; 2], depth: f64, thickness: f64, waves: Vec<WaveSpec>) -> LayeredSpec {
    LayeredSpec {
        layers: layers.into(),
        interfaces: vec![InterfaceSpec { depth_m: Positive::new(depth), thickness_m: Positive::new(thickness), waves }],
    }
}

pub(crate) fn meander(std: f64, omega: f64, cell: f64) -> CurrentSpec {
    CurrentSpec::new(meander_spec(std, omega, cell))
}

pub(crate) fn meander_spec(std: f64, omega: f64, cell: f64) -> MeanderSpec {
    MeanderSpec {
        std_m_s: NonNegative::new(std),
        omega_rad_s: Positive::new(omega),
        damping: Positive::new(0.1),
        cell_m: Positive::new(cell),
        diffusivity_m2_s: None,
    }
}

/// A tide of 0.3 m/s.
pub(crate) fn tide(minor: f64, heading: f64) -> CurrentSpec {
    CurrentSpec::new(tide_spec(minor, heading))
}

pub(crate) fn tide_spec(minor: f64, heading: f64) -> TideSpec {
    TideSpec {
        constituents: vec![ConstituentSpec {
            period_h: Positive::new(12.42),
            major_m_s: NonNegative::new(0.3),
            minor_m_s: Finite::new(minor),
            heading_deg: HeadingDeg::new(heading),
            phase_deg: Finite::new(40.0),
        }],
    }
}

pub(crate) fn rough(roughness: f64, thickness: f64) -> Option<BedSpec> {
    Some(BedSpec { roughness_m: Positive::new(roughness), thickness_m: Positive::new(thickness) })
}
