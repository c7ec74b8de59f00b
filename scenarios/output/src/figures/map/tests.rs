//! Geometry of the map: labels do not overlap, the inset is enlarged, keys have room, and the section appears where
//! useful.

use super::section;
use super::{inset, sheet};
use crate::charts::canvas::{Anchor, Canvas};
use crate::charts::label_box::LabelBox;
use crate::charts::palette::DECLARED;
use crate::charts::panel::Panel;
use crate::figures::marks;
use crate::figures::series_panels::event;
use crate::results::{ObstacleOutline, RunReport, SourceTruth};
use crate::sample::{area, frames, plume, source};
use crate::sample_run::Told;
use nalgebra::{Vector2, Vector3};
use rheotaxis::frame::Frame;
use robots::handoff::{Declaration, Region, RegionState, Regions, UP_FLOW_EDGE};
use world::area::Area;
use world::fields::Concentration;
use world::math;
use world::units::Heading;

/// A report of frames, with as much as the map needs.
pub(super) fn reported(frames: &[Frame], sources: &[SourceTruth]) -> Told {
    Told { plume: Some(plume()), dye: Some(&Straight), ..Told::new(frames, sources) }
}

/// A plume down-flow of the sample's source.
struct Straight;

impl Concentration for Straight {
    fn concentration(&self, p: &Vector3<f64>) -> f64 {
        let d = p - source().position;
        let along = d.xy().dot(&source().flow.normalize());
        let sd = 1.0 + 0.05 * along.max(0.0);
        let r2 = d.norm_squared() - along * along;
        if along > 0.0 { 1e-6 * math::exp(-0.5 * r2 / (sd * sd)) / (sd * sd) } else { 0.0 }
    }
}

/// Four subregions, two of them with a plume at their edge, and two sources declared close together.
fn mission() -> Vec<Frame> {
    let mut run = frames(400);
    let part = |k: i32| {
        let at = Vector2::new(f64::from(k / 2) * 547.0 - 273.5, f64::from(k % 2) * 183.5 - 91.75);
        Area { centre: area().world(at), length_m: 547.0, width_m: 183.5, ..area() }
    };
    let states = [RegionState::UpFlowEdge, RegionState::TimedOut, RegionState::UpFlowEdge, RegionState::Declared];
    let all: Vec<Region> = (0..4)
        .map(|k| Region { area: part(k), state: states[k as usize], from_s: Some(0.0), until_s: Some(1.0) })
        .collect();
    let from = source().position.xy();
    let said = |k: u32, rule, at: [f64; 2]| Declaration {
        number: k,
        region: Some(k),
        ..Declaration::first(300.0, from + Vector2::from(at), rule)
    };
    let said = [
        said(0, UP_FLOW_EDGE, [80.0, -300.0]),
        said(1, "along_flow", [3.0, -4.0]),
        said(2, UP_FLOW_EDGE, [300.0, -300.0]),
        said(3, "along_flow", [6.0, 2.0]),
    ];
    for f in &mut run {
        let r = &mut f.robots[0];
        r.declarations = said.to_vec();
        r.shown.regions = Regions { all: all.clone(), now: None };
    }
    run
}

/// A block of 40 m, 60 m down-flow of the source, between these heights.
fn quay(low: f64, high: f64) -> ObstacleOutline {
    let p = source().position.xy() + source().flow.normalize() * 60.0;
    let corners = [[-20.0, -20.0], [20.0, -20.0], [20.0, 20.0], [-20.0, 20.0]];
    let corners = corners.map(|c| [p.x + c[0], p.y + c[1]]).to_vec();
    ObstacleOutline { id: "quay".into(), corners, z: [low, high], permeable: false }
}

fn panel(width: f64, height: f64) -> Panel {
    Panel { left: 90.0, top: 40.0, width, height, x: [0.0, 1000.0], y: [0.0, 1.0] }
}

/// Labels placed after `before` that cover something that was already there, or each other.
fn clashes(before: usize, c: &Canvas) -> Vec<(LabelBox, LabelBox)> {
    let all = c.taken();
    let pairs = (before..all.len()).flat_map(|k| (0..k).map(move |j| (k, j)));
    pairs.map(|(k, j)| (all[k], all[j])).filter(|(a, b)| a.shared(b) > 0.0).collect()
}

#[test]
fn events_of_a_series_keep_off_its_key_and_each_other() {
    let mut c = Canvas::new(900.0, 300.0);
    let panel = panel(800.0, 128.0);
    panel.key(&mut c, &[("vehicle", "#000"), ("bed", "#000"), ("commanded", "#000")]);
    let before = c.taken().len();
    // Under the key, at the very end, and three within the width of a word.
    for t_s in [700.0, 760.0, 830.0, 915.0, 1000.0, 300.0, 310.0, 320.0, 0.0] {
        event(&mut c, &panel, t_s, "declared");
    }
    assert_eq!(c.taken().len(), before + 9);
    assert_eq!(clashes(before, &c), []);
    let inside = |r: &LabelBox| panel.outside(r) == 0.0;
    assert!(c.taken()[before..].iter().all(inside));
}

#[test]
fn names_on_a_map_keep_off_marks_and_each_other() {
    let east = SourceTruth { id: "east".into(), position: source().position + Vector3::new(9.0, 1.0, 0.0), ..source() };
    let told = reported(&mission(), &[source(), east]);
    let run = &told.report();
    let map = Panel { x: [-600.0, 600.0], y: [-600.0, 600.0], ..panel(600.0, 600.0) };
    let mut c = Canvas::new(900.0, 700.0);
    let track = &run.track.robots[0];
    marks::reserve(&mut c, &map);
    marks::marks(&mut c, &map, track);
    marks::sources(&mut c, &map, run);
    let before = c.taken().len();
    marks::source_names(&mut c, &map, run);
    marks::names(&mut c, &map, track, true);
    // Two true sources, four subregions, a robot, two declared sources.
    assert_eq!(c.taken().len(), before + 9);
    assert_eq!(clashes(before, &c), []);
    let svg = sheet(run).svg("map");
    for words in [
        ">A: plume to up-flow edge<",
        ">B: timed out<",
        ">D: source declared<",
        ">source 2<",
        ">plume at up-flow edge<",
    ] {
        assert!(svg.contains(words), "{words}");
    }
    // Edges are no declared sources: two diamonds, one of them again in the inset, and that of the key.
    assert!(!svg.contains(">source 3<") && !svg.contains("source free"));
}

#[test]
fn the_closer_look_is_closer_or_not_there() {
    let map = |span: f64| Panel { x: [-span, span], y: [-span, span], ..panel(660.0, 660.0) };
    let told = reported(&frames(400), &[source()]);
    let run: &RunReport<'_> = &told.report();
    for span in [40.0, 200.0, 600.0, 5000.0] {
        let map = map(span);
        let look = inset(run, &map, [0.0, 0.0], 225.0);
        // Declared 13 m off: on the smallest map, an enlarged view cannot contain both places.
        assert_eq!(look.is_some(), span > 50.0, "{span}");
        let Some(look) = look else { continue };
        assert!(look.px_per_unit() >= 1.5 * map.px_per_unit(), "{span}");
        let (s, d) = (source().position, run.track.robots[0].declarations[0].position);
        for p in [[s.x, s.y], [d.x, d.y]] {
            assert!(look.position(p).iter().all(|px| (0.0..=225.0).contains(px)));
        }
    }
    assert!(inset(run, &map(600.0), [0.0, 0.0], 100.0).is_none());
}

#[test]
fn a_sheet_fits_its_map() {
    for (length_m, width_m) in [(400.0, 100.0), (120.0, 100.0), (100.0, 300.0), (1094.0, 367.0)] {
        let area = Area { centre: Vector2::zeros(), length_m, width_m, axis: Heading::from_deg(90.0) };
        let c = sheet(&Told { area, ..reported(&[], &[]) }.report());
        let shown = c.taken();
        let reach = shown.iter().map(|r| r.bottom).fold(0.0, f64::max);
        // All text lies on the sheet, and none is left over.
        assert!(reach <= c.height && c.height - reach < 60.0, "{length_m}: {reach} of {}", c.height);
        assert!(shown.iter().all(|r| r.right <= c.width + 1.0 && r.left >= 0.0), "{length_m}");
        assert!(length_m <= 2.0 * width_m || c.height < 0.75 * c.width, "{} by {}", c.width, c.height);
    }
}

#[test]
fn a_section_is_drawn_where_the_map_cannot_show_the_way_of_the_water() {
    let mut told = reported(&frames(400), &[source()]);
    for (obstacles, drawn, why) in [
        (vec![], false, "nothing in the way"),
        (vec![quay(-20.0, 1.0)], false, "from bed to surface"),
        (vec![quay(-1.0, 1.0)], true, "water under it"),
        (vec![quay(-20.0, -3.0)], true, "water over it"),
    ] {
        told.obstacles = obstacles;
        let svg = sheet(&told.report()).svg("map");
        assert_eq!(svg.contains("Vertical section along the flow"), drawn, "{why}");
    }
}

/// Where the section has the diamond of a declaration of this height: its upper corner, px.
fn diamond_px(z_m: Option<f64>) -> f64 {
    let mut run = frames(400);
    for f in &mut run {
        f.robots[0].declarations.iter_mut().for_each(|d| d.z_m = z_m);
    }
    let told = Told { obstacles: vec![quay(-1.0, 1.0)], ..reported(&run, &[source()]) };
    let map = Panel { x: [-700.0, 700.0], y: [-700.0, 700.0], ..panel(600.0, 600.0) };
    let mut c = Canvas::new(800.0, 1000.0);
    section::draw(&mut c, &told.report(), &map, 700.0).expect("a section");
    let svg = c.svg("section");
    let mut drawn = svg.split('<').filter(|e| e.contains(DECLARED));
    let diamond = drawn.next().expect("the declaration");
    assert!(drawn.next().is_none());
    let first = diamond.split_once("M").expect("a path").1;
    let numbers = first.split(|c: char| c != '.' && !c.is_ascii_digit());
    numbers.filter_map(|n| n.parse().ok()).nth(1).expect("x and y")
}

#[test]
fn a_section_shows_a_declaration_at_its_height_or_at_that_of_the_vehicle() {
    let [one, two, five] = [-1.0, -2.0, -5.0].map(|z| diamond_px(Some(z)));
    let a_metre = two - one;
    assert!(a_metre > 5.0 && (five - two - 3.0 * a_metre).abs() < 0.5, "{one} {two} {five}");
    let run = frames(400);
    let declared = run.iter().find(|f| !f.robots[0].declarations.is_empty());
    let z = declared.expect("it declares").robots[0].truth.pose.p_WB.z;
    let expected = one + a_metre * (-1.0 - z);
    let px = diamond_px(None);
    assert!((px - expected).abs() < 0.5, "{px} for {expected}: {z} m");
}

#[test]
fn a_label_without_a_free_place_is_left_out_or_hides_least() {
    let panel = panel(100.0, 40.0);
    let mut c = Canvas::new(300.0, 100.0);
    let places = [([100.0, 60.0], Anchor::Start), ([100.0, 75.0], Anchor::Start)];
    c.keep_free(LabelBox::round([110.0, 58.0], 6.0));
    c.keep_free(LabelBox::round([140.0, 72.0], 2.0));
    let before = c.taken().len();
    panel.label_at(&mut c, &places, 10.0, "declared", true);
    assert_eq!(c.taken().len(), before);
    panel.label_at(&mut c, &places, 10.0, "declared", false);
    assert_eq!(c.taken()[before].bottom, 75.0 + 0.24 * 10.0);
}
