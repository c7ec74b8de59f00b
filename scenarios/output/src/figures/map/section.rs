//! A vertical section below the map, along the flow at the source. It shows what passes under, over or between things
//! that the map shows only from above. Drawn if there are layers of water, or gaps above or below obstacles.

use super::legend::plume_levels;
use crate::charts::canvas::{Anchor, Canvas, Style};
use crate::charts::contours::Grid;
use crate::charts::palette::{self, INK};
use crate::charts::panel::Panel;
use crate::figures::marks;
use crate::figures::plume_load::PlumeLoad;
use crate::figures::solids;
use crate::figures::solids::Passage;
use crate::figures::thinned::thinned;
use crate::results::{ObstacleOutline, RobotTrack, RunReport, SourceTruth, TrackRow};
use nalgebra::{Vector2, Vector3};
use world::obstacles::Obstacle;

const HEIGHT: f64 = 150.0;
/// Distance between the nodes of the field, px.
const CELL_PX: [f64; 2] = [5.0, 3.0];
/// Number of lines across the section; their mean is drawn.
const ACROSS: i32 = 4;
/// Half of the width for which the section stands: smallest and largest share of its length.
const HALF: [f64; 2] = [0.02, 0.1];
const BED: &str = "#b9a48b";
const INTERFACE: &str = "#1f4e79";

/// Position of the section.
struct Cut {
    origin: Vector2<f64>,
    along: Vector2<f64>,
    /// Beginning and end, m down-flow of the source.
    s: [f64; 2],
    /// Half of the width for which it stands, m.
    half_m: f64,
}

/// Draws the section with its left edge below the map's and its upper edge at `top`. Returns where it ends; `None` if
/// the map already shows everything.
pub(super) fn draw(c: &mut Canvas, run: &RunReport<'_>, map: &Panel, top: f64) -> Option<f64> {
    let source = run.best_declared()?;
    let cut = Cut::through_source(run, source, map)?;
    let beds = (0..=60).map(|k| cut.s[0] + f64::from(k) / 60.0 * (cut.s[1] - cut.s[0]));
    let bed = |s: f64| {
        let p = cut.world(s, 0.0);
        run.terrain.bed_z(p.x, p.y)
    };
    let deepest = beds.clone().map(bed).fold(0.0, f64::min);
    if deepest >= 0.0 || (run.interfaces.is_empty() && !cut.meets_a_gap(run)) {
        return None;
    }
    let panel =
        Panel { left: map.left, top, width: map.width, height: HEIGHT, x: cut.s, y: [1.06 * deepest, -0.06 * deepest] };
    let field = run.dye.and_then(|dye| {
        let n = [panel.width / CELL_PX[0], panel.height / CELL_PX[1]].map(|n| n.ceil() as usize + 1);
        let mean = |s: f64, z: f64| {
            if z > 0.0 || z < bed(s) {
                return 0.0;
            }
            let lines = (-ACROSS..=ACROSS).map(|k| cut.half_m * f64::from(k) / f64::from(ACROSS));
            let places = lines.map(|d| cut.world(s, d));
            let sum: f64 = places.map(|p| dye.concentration(&Vector3::new(p.x, p.y, z))).sum();
            // kg/m³ to µg/L.
            1e6 * sum / f64::from(2 * ACROSS + 1)
        };
        PlumeLoad::on(Grid::evaluate(panel.x, panel.y, n, mean))
    });
    panel.clip(c);
    let water = Style::fill("#eef4f8");
    let (surface, left) = (panel.py(0.0), panel.left);
    c.rect(left, surface, panel.width, panel.bottom() - surface, &water);
    if let Some(field) = &field {
        marks::plume(c, &panel, field);
    }
    for z in run.interfaces {
        let y = panel.py(*z);
        let style = Style::line(INTERFACE, 1.0).dashed("6 3");
        c.line([left, y], [panel.right(), y], &style);
    }
    let mut ground: Vec<_> = beds.map(|s| panel.position([s, bed(s)])).collect();
    ground.extend([[panel.right(), panel.bottom()], [left, panel.bottom()]]);
    c.polygon(ground, &Style::fill(BED));
    let outlined = obstacles(c, run, &cut, &panel);
    c.line([left, surface], [panel.right(), surface], &Style::line(INK, 0.8));
    for t in &run.track.robots {
        track(c, &cut, &panel, t);
    }
    marks::true_source(c, panel.position([0.0, source.position.z]));
    for t in &run.track.robots {
        for d in t.declarations.iter().filter(|d| !d.at_edge()) {
            let at = cut.local([d.position.x, d.position.y]);
            if let Some(z) = t.declared_z(d).filter(|_| at.y.abs() <= cut.half_m) {
                marks::declared(c, panel.position([at.x, z]));
            }
        }
    }
    c.unclip();
    panel.axes(c, 32.0, 10.0);
    panel.names(c, 11.0, ["Down-flow of the source (m)", "Up (m)"], [32.0, left - 22.0]);
    let name = if run.sources.len() > 1 { &source.id } else { "the source" };
    let words = format!("Vertical section along the flow at {name}; mean of ±{} m across", short_m(cut.half_m));
    c.bold([left, top - 8.0], 10.5, Anchor::Start, &words);
    let Some(field) = &field else {
        return Some(panel.bottom() + 40.0);
    };
    let mut y = panel.bottom() + 58.0;
    let words = "Concentration in the section (µg/L)";
    c.bold([left, y], 10.5, Anchor::Start, words);
    plume_levels(c, left + 250.0, &mut y, field);
    let (x, mut line) = (left + 480.0, y - 40.0);
    let interface = Style::line(INTERFACE, 1.0).dashed("6 3");
    let layered = !run.interfaces.is_empty();
    for (there, style, words) in
        [(layered, &interface, "interface of layers"), (outlined, &beside_style(), "obstacle beside the middle")]
    {
        if there {
            c.line([x, line], [x + 24.0, line], style);
            c.text([x + 31.0, line + 4.0], 10.5, Anchor::Start, words);
            line += 18.0;
        }
    }
    Some(y - 8.0)
}

impl Cut {
    /// Through a source, along the flow there, as far as the map reaches, and wide enough for the declarations.
    fn through_source(run: &RunReport<'_>, source: &SourceTruth, map: &Panel) -> Option<Self> {
        let speed = source.flow.norm();
        if speed < 1e-6 {
            return None;
        }
        let (origin, along) = (source.position.xy(), source.flow / speed);
        let mut s = [f64::NEG_INFINITY, f64::INFINITY];
        for (from, dir, range) in [(origin.x, along.x, map.x), (origin.y, along.y, map.y)] {
            if dir.abs() > 1e-9 {
                let (a, b) = ((range[0] - from) / dir, (range[1] - from) / dir);
                s = [s[0].max(a.min(b)), s[1].min(a.max(b))];
            }
        }
        let length = s[1] - s[0];
        if !(length > 0.0 && length.is_finite()) {
            return None;
        }
        let mut cut = Self { origin, along, s, half_m: 0.0 };
        let robots = run.track.robots.iter();
        let declared = robots.flat_map(RobotTrack::declared_inside);
        let aside = declared.map(|d| 1.2 * cut.local(d).y.abs()).fold(0.0, f64::max);
        cut.half_m = aside.clamp(HALF[0] * length, HALF[1] * length);
        Some(cut)
    }

    /// Coordinates (down-flow, to its left) of a place on the map, m.
    fn local(&self, p: [f64; 2]) -> Vector2<f64> {
        let d = Vector2::from(p) - self.origin;
        Vector2::new(d.dot(&self.along), self.along.perp(&d))
    }

    fn world(&self, s: f64, left: f64) -> Vector2<f64> {
        let aside = Vector2::new(-self.along.y, self.along.x);
        self.origin + self.along * s + aside * left
    }

    /// Where a convex outline begins and ends within the section's width, m down-flow.
    fn through(&self, corners: &[[f64; 2]], half_m: f64) -> Option<[f64; 2]> {
        let local: Vec<Vector2<f64>> = corners.iter().map(|p| self.local(*p)).collect();
        let mut along: Vec<f64> = (local.iter()).filter(|p| p.y.abs() <= half_m).map(|p| p.x).collect();
        for (k, a) in local.iter().enumerate() {
            let b = local[(k + 1) % local.len()];
            for side in [-half_m, half_m] {
                if (a.y < side) != (b.y < side) {
                    along.push(a.x + (side - a.y) / (b.y - a.y) * (b.x - a.x));
                }
            }
        }
        let low = along.iter().copied().fold(f64::INFINITY, f64::min);
        let high = along.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        (low < high).then_some([low, high])
    }

    /// Whether an obstacle with water above or below it lies in the section.
    fn meets_a_gap(&self, run: &RunReport<'_>) -> bool {
        run.obstacles.iter().any(|o| {
            let passage = solids::passage(o, run.terrain);
            let gap = matches!(passage, Passage::Over | Passage::Under);
            let range = self.through(&o.corners, self.half_m);
            gap && range.is_some_and(|r| r[0] < self.s[1] && r[1] > self.s[0])
        })
    }
}

fn beside_style() -> Style<'static> {
    Style::line("#8c6d4f", 1.2).dashed("4 2")
}

/// Obstacles: filled if the section's middle cuts them, outlined if only its width does. Returns whether any is
/// outlined.
fn obstacles(c: &mut Canvas, run: &RunReport<'_>, cut: &Cut, panel: &Panel) -> bool {
    let mut outlined = false;
    // No farther than the sheet can resolve.
    let at = |s: f64, z: f64| panel.position([s.clamp(cut.s[0], cut.s[1]), z.clamp(panel.y[0], panel.y[1])]);
    for o in run.obstacles {
        let middle = cut.through(&o.corners, 1e-6 * cut.half_m);
        let whole = cut.through(&o.corners, cut.half_m);
        match (middle, whole) {
            (Some(range), _) if !o.permeable => {
                let all = run.solids.into_iter().flat_map(|all| &all.0);
                let shape = all.into_iter().find(|shape| shape.id == o.id);
                let profile = profile(o, shape, cut, range);
                let corners: Vec<_> = profile.iter().map(|[s, z]| at(*s, *z)).collect();
                solids::solid(c, panel, &corners, Passage::Round);
            }
            (_, Some([from, to])) => {
                outlined = true;
                let [low, high] = o.z;
                let corners = [[from, low], [to, low], [to, high], [from, high]];
                let corners = corners.map(|[s, z]| at(s, z));
                c.polygon(corners.to_vec(), &beside_style());
            }
            _ => {}
        }
    }
    outlined
}

/// Outline of an obstacle on the section's middle, upper and lower side: (down-flow, up), m.
fn profile(o: &ObstacleOutline, shape: Option<&Obstacle>, cut: &Cut, [from, to]: [f64; 2]) -> Vec<[f64; 2]> {
    const COLUMNS: usize = 80;
    let [low, high] = o.z;
    let Some(shape) = shape else {
        return vec![[from, low], [to, low], [to, high], [from, high]];
    };
    // From above and from below, slightly inside at both ends.
    let (inset, reach) = (1e-4 * (to - from), 2.0 * (high - low) + 1.0);
    let mut upper = Vec::new();
    let mut lower = Vec::new();
    for k in 0..=COLUMNS {
        let s = from + inset + (to - from - 2.0 * inset) * k as f64 / COLUMNS as f64;
        let p = cut.world(s, 0.0);
        let hit = |z: f64, up: f64| {
            let dir = Vector3::z() * up;
            let way = shape.ray(&Vector3::new(p.x, p.y, z), &dir, reach)?;
            Some([s, z + up * way])
        };
        if let (Some(a), Some(b)) = (hit(high + 0.5, -1.0), hit(low - 0.5, 1.0)) {
            upper.push(a);
            lower.push(b);
        }
    }
    upper.extend(lower.into_iter().rev());
    upper
}

/// The part of the robot's track that lies in the section's width.
fn track(c: &mut Canvas, cut: &Cut, panel: &Panel, t: &RobotTrack) {
    let place = |r: &TrackRow| cut.local([r.p[0], r.p[1]]);
    let inside = |r: &TrackRow| place(r).y.abs() <= cut.half_m;
    for run in t.rows.chunk_by(|a, b| a.behaviour == b.behaviour && inside(a) == inside(b)).filter(|r| inside(&r[0])) {
        let points = run.iter().map(|r| panel.position([place(r).x, r.p[2]]));
        c.polyline(thinned(points), &Style::line(palette::behaviour(run[0].behaviour), 1.6));
    }
}

/// A width with few digits.
fn short_m(m: f64) -> String {
    if m < 3.0 { format!("{m:.1}") } else { format!("{m:.0}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;
    use world::registry::Registry;
    use world::terrain::Terrain;

    /// The reef of the catalogue's mesh in 15 m of water, cut from west to east through its middle.
    #[test]
    fn a_section_shows_a_reef_as_it_is_not_as_a_block() {
        let text = r#"(id: "reef", shape: Mesh(file: "meshes/reef.obj"), east_m: 0, north_m: 0, base: Z(-16))"#;
        let spec = rheotaxis::scenario::read(&Registry::default(), "reef", text, |_| Vec::new());
        let catalog = Path::new(env!("CARGO_MANIFEST_DIR")).join("../catalog");
        let terrain = Terrain::Level { depth_m: 15.0 };
        let shape = Obstacle::build(&spec.unwrap(), &terrain, &catalog).unwrap();
        let (low, high) = shape.bounds();
        let outline =
            ObstacleOutline { id: "reef".into(), corners: shape.outline(), z: [low.z, high.z], permeable: false };
        let cut = Cut { origin: Vector2::zeros(), along: Vector2::x(), s: [-100.0, 100.0], half_m: 5.0 };
        let range = cut.through(&outline.corners, 1e-6).unwrap();
        let seen = profile(&outline, Some(&shape), &cut, range);
        assert!(seen.len() > 100, "{}", seen.len());
        let half = seen.len() / 2;
        let tops = || seen[..half].iter();
        // Every corner lies on the reef's surface, and its slopes are lower than its crest.
        for [s, z] in &seen {
            let p = cut.world(*s, 0.0);
            assert!(shape.distance(&Vector3::new(p.x, p.y, *z)).abs() < 1e-6);
        }
        let crest = tops().map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max);
        let mean = tops().map(|p| p[1]).sum::<f64>() / half as f64;
        assert!(crest - mean > 0.1 * (high.z - low.z), "{mean} below {crest}");
        // Without the shape, its bounds represent it.
        assert_eq!(profile(&outline, None, &cut, range).len(), 4);
    }

    #[test]
    fn a_width_of_the_section_reaches_what_its_middle_misses() {
        let cut = Cut { origin: Vector2::new(10.0, 0.0), along: Vector2::y(), s: [-50.0, 50.0], half_m: 4.0 };
        // 3 to 8 m left of the line, 20 to 30 m down-flow.
        let block = [[7.0, 20.0], [7.0, 30.0], [2.0, 30.0], [2.0, 20.0]];
        assert_eq!(cut.through(&block, 1e-6), None);
        assert_eq!(cut.through(&block, 4.0), Some([20.0, 30.0]));
        assert_eq!(cut.local([7.0, 20.0]), Vector2::new(20.0, 3.0));
    }
}
