//! The content of a scene and how it is seen, drawn at random: source, dye, water, light, camera.

use serde::Serialize;
use world::math;
use world::seeds::Stream;

/// Ranges of visibility by which results are shown, m.
pub const BINS: [(f64, f64); 4] = [(1.5, 3.0), (3.0, 6.0), (6.0, 12.0), (12.0, 24.0)];

/// The objects in front of the camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Content {
    /// The source, releasing dye.
    Source,
    /// Dye alone: the plume some metres down-flow.
    Dye,
    /// A body that looks like the source but releases nothing.
    Body,
    /// Only water and bed.
    Nothing,
}

impl Content {
    /// The content of scene `n`: every other scene shows the source, the rest take turns.
    fn for_scene(n: u64) -> Self {
        match n % 6 {
            0..=2 => Content::Source,
            3 => Content::Dye,
            4 => Content::Body,
            _ => Content::Nothing,
        }
    }

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Content::Source => "source",
            Content::Dye => "dye",
            Content::Body => "body",
            Content::Nothing => "nothing",
        }
    }
}

/// A scene before it is rendered.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SceneDraw {
    /// Its number, from 0.
    pub n: u64,
    /// Its content.
    pub content: Content,
    /// Visibility, m.
    pub visibility_m: f64,
    /// Daylight on the surface, klx.
    pub illuminance_klx: f64,
    /// Height of the sun, °.
    pub sun_elevation_deg: f64,
    /// Direction of the sun, °.
    pub sun_heading_deg: f64,
    /// Mean current, m/s.
    pub current_m_s: f64,
    /// Dye released, g/min.
    pub dye_g_min: f64,
    /// Share of light that the body reflects.
    pub albedo: f64,
    /// Direction of the body's long side, °.
    pub body_heading_deg: f64,
    /// Horizontal distance from the camera to its target, m.
    pub range_m: f64,
    /// Direction of the camera seen from the target, anticlockwise from down-flow, °.
    pub bearing_deg: f64,
    /// Height above the bed, m.
    pub height_m: f64,
    /// Offset of the picture's centre from the target, left and up, °.
    pub off_deg: [f64; 2],
    /// The target on the plume if there is no body, m down-flow.
    pub down_flow_m: f64,
}

/// The range of visibility to which a scene belongs.
pub fn bin(visibility_m: f64) -> usize {
    (BINS.iter().position(|(_, high)| visibility_m < *high)).unwrap_or(BINS.len() - 1)
}

/// Scene `n` of a seed; no scene depends on another.
pub fn draw(seed: u64, n: u64) -> SceneDraw {
    let mut rng = Stream::new(seed, &format!("scene-{n}"), "score_vision");
    let mut even = |low: f64, high: f64| low + (high - low) * rng.uniform();
    // Each range of visibility gets a quarter of the scenes of each content.
    let (low, high) = BINS[(n / 6 % BINS.len() as u64) as usize];
    let growing = |u: f64, low: f64, high: f64| low * math::exp(u * math::ln(high / low));
    let visibility_m = growing(even(0.0, 1.0), low, high);
    SceneDraw {
        n,
        content: Content::for_scene(n),
        visibility_m,
        illuminance_klx: growing(even(0.0, 1.0), 5.0, 80.0),
        sun_elevation_deg: even(20.0, 75.0),
        sun_heading_deg: even(0.0, 360.0),
        current_m_s: [0.05, 0.1, 0.2][(even(0.0, 3.0) as usize).min(2)],
        // Dalian Bay: 1 to 2 g/min (Tian et al. 2013, section 4).
        dye_g_min: growing(even(0.0, 1.0), 1.0, 10.0),
        albedo: even(0.03, 0.08),
        body_heading_deg: even(0.0, 180.0),
        range_m: even(1.5, 5.0),
        bearing_deg: even(0.0, 360.0),
        height_m: even(0.8, 2.5),
        off_deg: [even(-10.0, 10.0), even(-8.0, 8.0)],
        down_flow_m: even(4.0, 8.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_range_of_visibility_gets_its_share_of_every_content() {
        let scenes: Vec<SceneDraw> = (0..240).map(|n| draw(1, n)).collect();
        for k in 0..BINS.len() {
            let of = |c: Content| (scenes.iter()).filter(|s| s.content == c && bin(s.visibility_m) == k).count();
            assert_eq!([Content::Source, Content::Dye, Content::Body, Content::Nothing].map(of), [30, 10, 10, 10]);
        }
    }

    #[test]
    fn a_scene_depends_on_its_seed_and_number_alone() {
        assert_eq!(draw(3, 17), draw(3, 17));
        assert_ne!(draw(3, 17).visibility_m, draw(4, 17).visibility_m);
        assert_ne!(draw(3, 17).bearing_deg, draw(3, 41).bearing_deg);
    }
}
