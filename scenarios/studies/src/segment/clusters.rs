//! The colour patterns of both groups as swatches, with their distances, and whether they are kept or dropped.

use eyes::vision::{Fate, Pass, Reference, Target};
use output::charts::canvas::{Anchor, Canvas, Style};
use output::charts::palette::{GREY, INK};
use output::charts::panel::Panel;
use robots::strategy::ColourSpec;

/// Width of the figure.
pub(super) const WIDTH: f64 = 980.0;
/// Height of a group: its axis and what stands below it.
const GROUP: f64 = 96.0;
/// Height of a row of the table.
const ROW: f64 = 26.0;
/// Side of a swatch.
const SIDE: f64 = 18.0;
/// Where the columns of the table begin.
const COLUMNS: [f64; 6] = [30.0, 90.0, 125.0, 285.0, 455.0, 610.0];
/// Colour of dropped patterns.
const DROPPED: &str = "#d55e00";
/// Band in which the first criterion keeps a pattern.
const BAND: &str = "#dcefe6";

fn hex(rgb: [u8; 3]) -> String {
    format!("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2])
}

/// Draws both groups.
pub(super) fn clusters(passes: &[Pass], spec: &ColourSpec) -> Canvas {
    let of = |t: Target| passes.iter().filter(|p| p.target == t).collect::<Vec<_>>();
    let groups = [of(Target::Plume), of(Target::Source)];
    let height = 60.0 + groups.iter().map(|g| GROUP + 44.0 + ROW * g.len() as f64).sum::<f64>();
    let mut c = Canvas::new(WIDTH, height);
    c.bold([30.0, 28.0], 15.0, Anchor::Start, "Colour patterns of the passes");
    let mut top = 48.0;
    for (group, target) in groups.iter().zip([Target::Plume, Target::Source]) {
        top = one_group(&mut c, group, target.reference(), spec, top);
    }
    c
}

fn one_group(c: &mut Canvas, group: &[&Pass], reference: Reference, spec: &ColourSpec, top: f64) -> f64 {
    let name = match reference {
        Reference::Red => "plume: distance to RED (255, 0, 0), levels",
        Reference::DarkBlue => "source: distance to DARK-BLUE (0, 0, 128), levels",
    };
    let axis =
        Panel { left: 70.0, top: top + 22.0, width: WIDTH - 110.0, height: 34.0, x: [0.0, 450.0], y: [0.0, 1.0] };
    c.text([30.0, top + 14.0], 12.5, Anchor::Start, name);
    if let Some(pivot) = group.iter().find(|p| p.fate == Fate::Pivot) {
        let (a, b) = (pivot.pattern.distance, pivot.pattern.distance + spec.delta1.get());
        let (a, b) = (axis.px(a), axis.px(b.min(450.0)));
        c.rect(a, axis.top, b - a, axis.height, &Style::fill(BAND));
    }
    c.line([axis.left, axis.bottom()], [axis.right(), axis.bottom()], &Style::line(INK, 1.0));
    axis.x_ticks(c, true, 11.0);
    let swatch = |c: &mut Canvas, x: f64, y: f64, rgb: [u8; 3]| {
        let colour = hex(rgb);
        c.rect(x, y, SIDE, SIDE, &Style::fill(&colour).edged(INK, 0.8));
    };
    swatch(c, axis.px(0.0) - 0.5 * SIDE, axis.top + 8.0, reference.rgb());
    for p in group {
        let x = axis.px(p.pattern.distance) - 0.5 * SIDE;
        swatch(c, x, axis.top + 8.0, p.pattern.rgb);
        c.text([x + 0.5 * SIDE, axis.top + 4.0], 10.0, Anchor::Middle, &p.number.to_string());
    }
    let mut y = top + GROUP;
    let heads = ["pass", "", "pattern", "from the reference", "from the pivot", "in the group"];
    for (head, x) in heads.into_iter().zip(COLUMNS) {
        c.bold([x, y + 8.0], 11.0, Anchor::Start, head);
    }
    y += 14.0;
    for p in group {
        let [r, g, b] = p.pattern.rgb;
        c.text([COLUMNS[0], y + 14.0], 12.0, Anchor::Start, &p.number.to_string());
        swatch(c, COLUMNS[1], y, p.pattern.rgb);
        c.text([COLUMNS[2], y + 14.0], 12.0, Anchor::Start, &format!("({r}, {g}, {b})"));
        c.text([COLUMNS[3], y + 14.0], 12.0, Anchor::Start, &format!("{:.1}", p.pattern.distance));
        let (way, says) = fate(p.fate, spec);
        c.text([COLUMNS[4], y + 14.0], 12.0, Anchor::Start, &way);
        c.text([COLUMNS[5], y + 14.0], 12.0, Anchor::Start, &says);
        if !p.fate.kept() {
            let (x, m) = (COLUMNS[1], SIDE);
            c.line([x - 3.0, y - 3.0], [x + m + 3.0, y + m + 3.0], &Style::line(DROPPED, 2.5));
            c.line([x - 3.0, y + m + 3.0], [x + m + 3.0, y - 3.0], &Style::line(DROPPED, 2.5));
        }
        y += ROW;
    }
    if group.is_empty() {
        c.text([COLUMNS[0], y + 14.0], 12.0, Anchor::Start, "none: nothing was left");
    }
    c.line([30.0, y + 14.0], [WIDTH - 30.0, y + 14.0], &Style::line(GREY, 0.6));
    y + 30.0
}

/// The distance to the pivot and what happens to the pattern, in words.
pub(super) fn fate(fate: Fate, spec: &ColourSpec) -> (String, String) {
    match fate {
        Fate::Pivot => ("–".into(), "pivot".into()),
        Fate::Kept(way) => (format!("{way:.1}"), "kept".into()),
        Fate::OffReference(more) => {
            ("–".into(), format!("dropped: {more:.1} farther than the pivot, > {}", spec.delta1.get()))
        }
        Fate::OffPivot(way) => {
            (format!("{way:.1}"), format!("dropped: {way:.1} from the pivot, > {}", spec.delta2.get()))
        }
    }
}
