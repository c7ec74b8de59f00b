//! A source of odour: where it is, how much it releases, and in what portions.
//!
//! *Source*: Farrell, Murlis, Long, Li & Cardé 2002, Environ. Fluid Mech. 2, 143 (release and growth of filaments).
//!
//! *Parameters*: `rate_g_s` mass released (g/s); `release.rate_hz` filaments per second (1/s; 5 to 10);
//! `release.initial_size_m` R0 (m; √0.001); `release.growth_m2_s` γ (m²/s; 0.001); `release.vertical_size_limit_m`
//! greatest vertical size (m; none); `release.eddy_size_m` (m; none), see `filaments::size`; `release.nozzle` (none).
//!
//! *Deviations*: the paper counts molecules in arbitrary units; here the quantity is mass. The vertical limit is not in
//! the paper. In stratified water no eddy overturns more than about the Ozmidov length (ε/N³)^½, so a filament cannot
//! get thicker (Pearson, Puttock & Hunt 1983, J. Fluid Mech. 129, 219). A nozzle of diameter d releases, at its speed
//! U, a thread of filaments of size d/4, which have the variance of a disc: U/(d/4) of them per second, so that each
//! overlaps the next.

use crate::error::PlumeError;
use nalgebra::{Vector2, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::area::Area;
use world::cost::{Cost, Part, Times};
use world::obstacles::Obstacles;
use world::ranges::{Finite, NonNegative, Positive};
use world::terrain::Terrain;

/// A source as in the scenario file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SourceSpec {
    /// Name, unique in the scenario.
    pub id: String,
    /// East of the datum, m.
    #[serde(deserialize_with = "world::limits::place_m")]
    #[schemars(transform = world::limits::schema::place_m)]
    pub east_m: Finite,
    /// North of the datum, m.
    #[serde(deserialize_with = "world::limits::place_m")]
    #[schemars(transform = world::limits::schema::place_m)]
    pub north_m: Finite,
    /// Height above the bed, m; either this or `depth_m`.
    #[serde(default)]
    pub height_m: Option<Finite>,
    /// Depth below the still surface, m; either this or `height_m`.
    #[serde(default)]
    pub depth_m: Option<Finite>,
    /// Mass released, g/s.
    #[serde(deserialize_with = "world::limits::source_g_s")]
    #[schemars(transform = world::limits::schema::source_g_s)]
    pub rate_g_s: Positive,
    /// How it is divided into filaments.
    #[serde(default)]
    pub release: ReleaseSpec,
}

/// How a source divides its release into filaments.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ReleaseSpec {
    /// Filaments per second, 1/s.
    pub rate_hz: Positive,
    /// Size (standard deviation of the kernel) at release, m.
    #[serde(deserialize_with = "world::limits::filament_m")]
    #[schemars(transform = world::limits::schema::filament_m)]
    pub initial_size_m: Positive,
    /// Growth of the squared size, m²/s.
    #[serde(deserialize_with = "world::limits::growth_m2_s")]
    #[schemars(transform = world::limits::schema::growth_m2_s)]
    pub growth_m2_s: NonNegative,
    /// Greatest vertical size, m; without it half the local depth.
    #[serde(deserialize_with = "world::limits::depth_m")]
    #[schemars(transform = world::limits::schema::depth_m)]
    pub vertical_size_limit_m: Option<Positive>,
    /// At random times (true) or at equal intervals (false).
    pub poisson: bool,
    /// Size of the smallest eddies that are resolved, m. Below it a filament grows by the eddies smaller than itself
    /// instead of by `growth_m2_s`, and only the larger ones kick it.
    #[serde(deserialize_with = "world::limits::filament_m")]
    #[schemars(transform = world::limits::schema::filament_m)]
    pub eddy_size_m: Option<Positive>,
    /// A nozzle that releases a thread; it sets `rate_hz`, `initial_size_m` and equal intervals.
    pub nozzle: Option<NozzleSpec>,
}

/// A round nozzle in the stream.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NozzleSpec {
    /// Inner diameter, m.
    #[serde(deserialize_with = "world::limits::nozzle_m")]
    #[schemars(transform = world::limits::schema::nozzle_m)]
    pub diameter_m: Positive,
    /// Speed of the fluid that leaves it, m/s; iso-kinetic if it is that of the water around.
    #[serde(deserialize_with = "world::limits::nozzle_m_s")]
    #[schemars(transform = world::limits::schema::nozzle_m_s)]
    pub speed_m_s: Positive,
}

/// Memory of a filament with its place in the index, twice while the arrays grow, bytes.
const FILAMENT_BYTES: f64 = 100.0;
/// Time to move a filament, s.
const FILAMENT_S: f64 = 17e-9;
/// Additional time with eddies, s.
const EDDIES_S: f64 = 60e-9;

impl NozzleSpec {
    /// Volume released, m³/s.
    #[must_use]
    pub fn volume_m3_s(&self) -> f64 {
        let d = self.diameter_m.get();
        std::f64::consts::FRAC_PI_4 * d * d * self.speed_m_s.get()
    }
}

impl ReleaseSpec {
    /// The same release with the values that a nozzle sets: filaments with the variance of its disc, (d/4)², one
    /// standard deviation apart.
    #[must_use]
    pub fn settled(&self) -> Self {
        let Some(nozzle) = &self.nozzle else {
            return self.clone();
        };
        let size = nozzle.diameter_m.get() / 4.0;
        Self {
            // Within its range as long as speed and diameter are within theirs.
            rate_hz: Positive::new(nozzle.speed_m_s.get() / size),
            initial_size_m: Positive::new(size),
            poisson: false,
            ..self.clone()
        }
    }
}

impl ReleaseSpec {
    /// What the filaments need in an area whose water carries them at `carries_m_s`. Filaments that eddies or slow
    /// water keep longer are not counted.
    #[must_use]
    pub fn cost(&self, area: &Area, carries_m_s: f64, times: &Times) -> Cost {
        let (path, value, rate_hz, power) = match &self.nozzle {
            None => ("rate_hz", self.rate_hz.get(), self.rate_hz.get(), 1.0),
            Some(nozzle) => {
                let size = nozzle.diameter_m.get() / 4.0;
                let rate_hz = nozzle.speed_m_s.get() / size;
                ("nozzle.diameter_m", nozzle.diameter_m.get(), rate_hz, -1.0)
            }
        };
        let stays_s = (area.length_m + area.width_m) / carries_m_s.max(1e-9);
        let whole_s = times.whole_s();
        let most = rate_hz * whole_s.min(stays_s);
        // Their number rises to its maximum and then stays.
        let rising = (0.5 * stays_s / whole_s).clamp(0.0, 0.5);
        let each_s = FILAMENT_S
            + if self.eddy_size_m.is_some() {
                EDDIES_S
            } else {
                0.0
            };
        let part = Part::new(path, format!("{most:.2e} filaments at once"))
            .holds(most * FILAMENT_BYTES)
            .takes(most * (1.0 - rising) * times.drifts() * each_s)
            .by(value, power);
        Cost::of(part)
    }
}

impl Default for ReleaseSpec {
    fn default() -> Self {
        Self {
            rate_hz: Positive::new(5.0),
            initial_size_m: Positive::new(0.031_622_776),
            growth_m2_s: NonNegative::new(0.001),
            vertical_size_limit_m: None,
            poisson: true,
            eddy_size_m: None,
            nozzle: None,
        }
    }
}

/// A source placed in the water.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// Name.
    pub id: String,
    /// Position, ENU, m.
    pub p_W: Vector3<f64>,
    /// Mass of one filament, kg.
    pub filament_kg: f64,
    /// How it is divided into filaments.
    pub release: ReleaseSpec,
}

/// Places the sources in the water.
///
/// # Errors
/// If a source lies outside the area, under the bed or above the surface, if it has both or neither of `height_m` and
/// `depth_m`, or if two have the same name. The field is a path such as `sources[0].height_m`.
pub fn place(
    specs: &[SourceSpec],
    area: &Area,
    terrain: &Terrain,
) -> Result<Vec<Source>, PlumeError> {
    let mut sources: Vec<Source> = Vec::with_capacity(specs.len());
    for (n, spec) in specs.iter().enumerate() {
        if let Some(twin) = sources.iter().position(|s| s.id == spec.id) {
            return Err(invalid(
                n,
                "id",
                format!("\"{}\" is already the name of sources[{twin}]", spec.id),
            ));
        }
        let release = spec.release.settled();
        sources.push(Source {
            id: spec.id.clone(),
            p_W: position(n, spec, area, terrain)?,
            filament_kg: 1e-3 * spec.rate_g_s.get() / release.rate_hz.get(),
            release,
        });
    }
    Ok(sources)
}

/// Checks that no source stands inside a solid.
///
/// # Errors
/// Names the first that does, such as `sources[0]`.
pub fn clear(sources: &[Source], obstacles: &Obstacles) -> Result<(), PlumeError> {
    for (n, source) in sources.iter().enumerate() {
        if let Some(solid) = obstacles.containing(&source.p_W) {
            return Err(PlumeError::Invalid {
                field: format!("sources[{n}]"),
                problem: format!(
                    "source \"{}\" stands inside obstacle \"{}\"; bring it outside",
                    source.id, solid.id
                ),
            });
        }
    }
    Ok(())
}

fn invalid(n: usize, field: &str, problem: String) -> PlumeError {
    PlumeError::Invalid {
        field: format!("sources[{n}].{field}"),
        problem,
    }
}

fn position(
    n: usize,
    spec: &SourceSpec,
    area: &Area,
    terrain: &Terrain,
) -> Result<Vector3<f64>, PlumeError> {
    let (e, north) = (spec.east_m.get(), spec.north_m.get());
    let (distance, normal) = area.edge_distance(Vector2::new(e, north));
    if distance < 0.0 {
        let field = if normal.x.abs() > normal.y.abs() {
            "east_m"
        } else {
            "north_m"
        };
        let problem = format!(
            "source \"{}\" at east {e} m, north {north} m lies {:.1} m outside the area; bring it inside",
            spec.id, -distance
        );
        return Err(invalid(n, field, problem));
    }
    let bed = terrain.bed_z(e, north);
    let depth = -bed;
    match (
        spec.height_m.map(Finite::get),
        spec.depth_m.map(Finite::get),
    ) {
        (Some(h), None) if h < 0.0 => Err(invalid(
            n,
            "height_m",
            format!(
                "source \"{}\" is {} m under the bottom; must be from 0 (on the bed) to {depth:.2} (the water's depth there)",
                spec.id, -h
            ),
        )),
        (Some(h), None) if h > depth => Err(invalid(
            n,
            "height_m",
            format!(
                "source \"{}\" is {:.2} m above the surface; the water is {depth:.2} m deep there, so must be from 0 to {depth:.2}",
                spec.id,
                h - depth
            ),
        )),
        (None, Some(d)) if d > depth => Err(invalid(
            n,
            "depth_m",
            format!(
                "source \"{}\" is {:.2} m under the bottom; must be from 0 (the surface) to {depth:.2} (the water's depth there)",
                spec.id,
                d - depth
            ),
        )),
        (None, Some(d)) if d < 0.0 => Err(invalid(
            n,
            "depth_m",
            format!(
                "source \"{}\" is {} m above the surface; must be from 0 to {depth:.2}",
                spec.id, -d
            ),
        )),
        (Some(h), None) => Ok(Vector3::new(e, north, bed + h)),
        (None, Some(d)) => Ok(Vector3::new(e, north, -d)),
        (Some(_), Some(_)) => Err(invalid(
            n,
            "depth_m",
            format!(
                "source \"{}\" has both height_m and depth_m; give one of them",
                spec.id
            ),
        )),
        (None, None) => Err(invalid(
            n,
            "height_m",
            format!(
                "source \"{}\" has neither height_m (above the bed) nor depth_m (below the surface); give one of them",
                spec.id
            ),
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use world::units::Heading;

    fn sea() -> (Area, Terrain) {
        let area = Area {
            centre: Vector2::zeros(),
            length_m: 100.0,
            width_m: 60.0,
            axis: Heading::from_deg(0.0),
        };
        (area, Terrain::Level { depth_m: 6.0 })
    }

    fn spec(e: f64, n: f64, height: Option<f64>, depth: Option<f64>) -> SourceSpec {
        SourceSpec {
            id: "s1".into(),
            east_m: Finite::new(e),
            north_m: Finite::new(n),
            height_m: height.map(Finite::new),
            depth_m: depth.map(Finite::new),
            rate_g_s: Positive::new(0.025),
            release: ReleaseSpec::default(),
        }
    }

    fn problem(spec: SourceSpec) -> String {
        let (area, terrain) = sea();
        place(&[spec], &area, &terrain).unwrap_err().to_string()
    }

    #[test]
    fn height_and_depth_name_the_same_place() {
        let (area, terrain) = sea();
        let a = place(&[spec(3.0, 4.0, Some(0.5), None)], &area, &terrain).unwrap();
        let b = place(&[spec(3.0, 4.0, None, Some(5.5))], &area, &terrain).unwrap();
        assert_eq!(a, b);
        assert_eq!(a[0].p_W, Vector3::new(3.0, 4.0, -5.5));
        assert!((a[0].filament_kg - 5e-6).abs() < 1e-18);
    }

    #[test]
    fn what_cannot_be_is_said_with_its_place() {
        assert_eq!(
            problem(spec(0.0, 70.0, Some(0.2), None)),
            "sources[0].north_m: source \"s1\" at east 0 m, north 70 m lies 20.0 m outside the area; bring it inside"
        );
        assert_eq!(
            problem(spec(0.0, 0.0, Some(-0.5), None)),
            "sources[0].height_m: source \"s1\" is 0.5 m under the bottom; must be from 0 (on the bed) to 6.00 (the water's depth there)"
        );
        assert!(
            problem(spec(0.0, 0.0, None, Some(6.5)))
                .starts_with("sources[0].depth_m: source \"s1\" is 0.50 m under the bottom")
        );
        assert!(problem(spec(0.0, 0.0, Some(7.0), None)).contains("1.00 m above the surface"));
        assert!(
            problem(spec(0.0, 0.0, Some(1.0), Some(1.0))).contains("both height_m and depth_m")
        );
        assert!(problem(spec(0.0, 0.0, None, None)).contains("neither height_m"));
        let (area, terrain) = sea();
        let twins = [
            spec(0.0, 0.0, Some(1.0), None),
            spec(1.0, 0.0, Some(1.0), None),
        ];
        let said = place(&twins, &area, &terrain).unwrap_err().to_string();
        assert_eq!(
            said,
            "sources[1].id: \"s1\" is already the name of sources[0]"
        );
    }
}
