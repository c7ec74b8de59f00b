//! Where the sources are in the water, and what is wrong with a place.

use super::source::{Source, SourceSpec};
use crate::error::PlumeError;
use nalgebra::{Vector2, Vector3};
use world::area::Area;
use world::obstacles::Obstacles;
use world::ranges::Finite;
use world::terrain::Terrain;

/// Places the sources in the water.
///
/// # Errors
/// If a source lies outside the area, under the bed or above the surface, if it has both or neither of `height_m` and
/// `depth_m`, or if two have the same name. The field is a path such as `sources[0].height_m`.
pub fn place(specs: &[SourceSpec], area: &Area, terrain: &Terrain) -> Result<Vec<Source>, PlumeError> {
    let mut sources: Vec<Source> = Vec::with_capacity(specs.len());
    for (n, spec) in specs.iter().enumerate() {
        if let Some(twin) = sources.iter().position(|s| s.id == spec.id) {
            return Err(invalid(n, "id", format!("\"{}\" is already the name of sources[{twin}]", spec.id)));
        }
        sources.push(placed(n, spec, area, terrain)?);
    }
    Ok(sources)
}

/// Checks that no source stands inside a solid.
///
/// # Errors
/// Names the first that does, such as `sources[0]`.
pub fn clear(sources: &[Source], obstacles: &Obstacles) -> Result<(), PlumeError> {
    let mut sources = sources.iter().enumerate();
    sources.try_for_each(|(n, source)| outside(n, source, obstacles))
}

/// What is wrong with each source by itself; nothing of their names.
pub fn misplaced(specs: &[SourceSpec], area: &Area, terrain: &Terrain, obstacles: &Obstacles) -> Vec<PlumeError> {
    let wrong = |(n, spec)| {
        let source = placed(n, spec, area, terrain);
        source.and_then(|source| outside(n, &source, obstacles)).err()
    };
    specs.iter().enumerate().filter_map(wrong).collect()
}

fn placed(n: usize, spec: &SourceSpec, area: &Area, terrain: &Terrain) -> Result<Source, PlumeError> {
    let release = spec.release.settled();
    Ok(Source {
        id: spec.id.clone(),
        p_W: position(n, spec, area, terrain)?,
        filament_kg: 1e-3 * spec.rate_g_s.get() / release.rate_hz.get(),
        release,
    })
}

fn outside(n: usize, source: &Source, obstacles: &Obstacles) -> Result<(), PlumeError> {
    match obstacles.containing(&source.p_W) {
        None => Ok(()),
        Some(solid) => {
            let problem = format!("source \"{}\" stands inside obstacle \"{}\"; bring it outside", source.id, solid.id);
            Err(PlumeError::new(format!("sources[{n}]"), problem))
        }
    }
}

fn invalid(n: usize, field: &str, problem: String) -> PlumeError {
    PlumeError::new(format!("sources[{n}].{field}"), problem)
}

fn position(n: usize, spec: &SourceSpec, area: &Area, terrain: &Terrain) -> Result<Vector3<f64>, PlumeError> {
    let (e, north) = (spec.east_m.get(), spec.north_m.get());
    let (distance, normal) = area.edge_distance(Vector2::new(e, north));
    if distance < 0.0 {
        let field = if normal.x.abs() > normal.y.abs() { "east_m" } else { "north_m" };
        let problem = format!(
            "source \"{}\" at east {e} m, north {north} m lies {:.1} m outside the area; bring it inside",
            spec.id, -distance
        );
        return Err(invalid(n, field, problem));
    }
    let bed = terrain.bed_z(e, north);
    let depth = -bed;
    let wrong = |field: &str, problem: String| Err(invalid(n, field, format!("source \"{}\" {problem}", spec.id)));
    match (spec.height_m.map(Finite::get), spec.depth_m.map(Finite::get)) {
        (Some(h), None) if h < 0.0 => wrong(
            "height_m",
            format!(
                "is {} m under the bottom; must be from 0 (on the bed) to {depth:.2} (the water's depth there)",
                -h
            ),
        ),
        (Some(h), None) if h > depth => wrong(
            "height_m",
            format!(
                "is {:.2} m above the surface; the water is {depth:.2} m deep there, so must be from 0 to {depth:.2}",
                h - depth
            ),
        ),
        (None, Some(d)) if d > depth => wrong(
            "depth_m",
            format!(
                "is {:.2} m under the bottom; must be from 0 (the surface) to {depth:.2} (the water's depth there)",
                d - depth
            ),
        ),
        (None, Some(d)) if d < 0.0 => {
            wrong("depth_m", format!("is {} m above the surface; must be from 0 to {depth:.2}", -d))
        }
        (Some(h), None) => Ok(Vector3::new(e, north, bed + h)),
        (None, Some(d)) => Ok(Vector3::new(e, north, -d)),
        (Some(_), Some(_)) => wrong("depth_m", "has both height_m and depth_m; give one of them".into()),
        (None, None) => wrong(
            "height_m",
            "has neither height_m (above the bed) nor depth_m (below the surface); give one of them".into(),
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::super::ReleaseSpec;
    use super::*;
    use world::ranges::Positive;
    use world::units::Heading;

    fn sea() -> (Area, Terrain) {
        let area = Area { centre: Vector2::zeros(), length_m: 100.0, width_m: 60.0, axis: Heading::from_deg(0.0) };
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
        let (area, terrain) = sea();
        let twin = || spec(0.0, 0.0, Some(1.0), None);
        for (specs, field, said) in [
            (vec![spec(0.0, 70.0, Some(0.2), None)], "sources[0].north_m", "lies 20.0 m outside"),
            (vec![spec(0.0, 0.0, Some(-0.5), None)], "sources[0].height_m", "0.5 m under the bottom"),
            (vec![spec(0.0, 0.0, None, Some(6.5))], "sources[0].depth_m", "0.50 m under the bottom"),
            (vec![spec(0.0, 0.0, Some(7.0), None)], "sources[0].height_m", "1.00 m above the surface"),
            (vec![spec(0.0, 0.0, Some(1.0), Some(1.0))], "sources[0]", "both height_m and depth_m"),
            (vec![spec(0.0, 0.0, None, None)], "sources[0]", "neither height_m"),
            (vec![twin(), twin()], "sources[1].id", "already the name of sources[0]"),
        ] {
            let e = place(&specs, &area, &terrain).expect_err(said).to_string();
            assert!(e.starts_with(field) && e.contains(said), "{e}");
        }
    }

    #[test]
    fn each_misplaced_source_is_told_by_its_own_number() {
        let (area, terrain) = sea();
        let specs =
            [spec(0.0, 70.0, Some(0.2), None), spec(0.0, 0.0, Some(0.2), None), spec(0.0, 0.0, Some(-0.5), None)];
        let said = misplaced(&specs, &area, &terrain, &Obstacles::default());
        let fields = said.iter().map(|PlumeError::Invalid { field, .. }| field.as_str());
        let fields: Vec<&str> = fields.collect();
        assert_eq!(fields, ["sources[0].north_m", "sources[2].height_m"]);
    }
}
