//! Precision and recall by visibility and the verification curves, computed and drawn.

use super::draw::{BINS, Content, bin};
use super::methods::{METHODS, Method};
use super::pixels::{Counts, Ratio, precision, recall};
use super::roc::{Roc, ScoredPicture};
use super::run::SceneRow;
use output::charts::canvas::{Anchor, Canvas, Style};
use output::charts::palette::{GREY, INK};
use output::charts::panel::Panel;
use serde::Serialize;

/// All figures of one method in one range of visibility.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Figures {
    pub(super) method: Method,
    /// Range of visibility, m; `None` for all ranges.
    pub(super) visibility_m: Option<(f64, f64)>,
    pub(super) dye_precision: Ratio,
    pub(super) dye_recall: Ratio,
    pub(super) source_precision: Ratio,
    pub(super) source_recall: Ratio,
    pub(super) verification: Roc,
}

impl Figures {
    /// Its shares of pixels, by their names in tables.
    pub(super) fn shares(&self) -> [(&'static str, &Ratio); 4] {
        [
            ("dye_precision", &self.dye_precision),
            ("dye_recall", &self.dye_recall),
            ("source_precision", &self.source_precision),
            ("source_recall", &self.source_recall),
        ]
    }
}

/// The figures of each method: all scenes, then each range.
pub(super) fn figures(rows: &[SceneRow]) -> Vec<Figures> {
    let mut all = Vec::new();
    for method in METHODS {
        let of_method: Vec<&SceneRow> = rows.iter().filter(|r| r.method == method).collect();
        all.push(one(method, None, &of_method));
        for (k, range) in BINS.into_iter().enumerate() {
            let within: Vec<&SceneRow> =
                (of_method.iter().copied()).filter(|r| bin(r.scene.visibility_m) == k).collect();
            all.push(one(method, Some(range), &within));
        }
    }
    all
}

fn one(method: Method, visibility_m: Option<(f64, f64)>, rows: &[&SceneRow]) -> Figures {
    let name = |what: &str| format!("{} {visibility_m:?} {what}", method.name());
    let dye: Vec<Counts> = rows.iter().map(|r| r.dye).collect();
    let source: Vec<Counts> = rows.iter().map(|r| r.source).collect();
    let scored: Vec<ScoredPicture> =
        (rows.iter()).map(|r| ScoredPicture { score: r.score, source: r.scene.content == Content::Source }).collect();
    Figures {
        method,
        visibility_m,
        dye_precision: precision(&dye, &name("dye precision")),
        dye_recall: recall(&dye, &name("dye recall")),
        source_precision: precision(&source, &name("source precision")),
        source_recall: recall(&source, &name("source recall")),
        verification: Roc::new(&scored, &name("verification")),
    }
}

pub(super) fn range_words(range: Option<(f64, f64)>) -> String {
    range.map_or("all".to_string(), |(low, high)| format!("{low}–{high} m"))
}

/// Colours of the methods (Okabe & Ito 2008), in their order.
const COLOURS: [&str; 6] = ["#999999", "#0072b2", "#56b4e9", "#d55e00", "#e69f00", "#009e73"];

fn find_figures(all: &[Figures], way: usize, range: Option<(f64, f64)>) -> &Figures {
    (all.iter()).find(|f| f.method == METHODS[way] && f.visibility_m == range).expect("every way has every range")
}

fn legend(c: &mut Canvas, left: f64, top: f64) {
    for (way, method) in METHODS.into_iter().enumerate() {
        let x = left + 185.0 * (way % 3) as f64;
        let y = top + 18.0 * (way / 3) as f64;
        c.line([x, y], [x + 22.0, y], &Style::line(COLOURS[way], 2.5));
        c.circle([x + 11.0, y], 3.2, &Style::fill(COLOURS[way]));
        c.text([x + 28.0, y + 4.0], 11.5, Anchor::Start, method.name());
    }
}

/// Precision and recall of dye and source, by range of visibility.
pub(super) fn shares(all: &[Figures]) -> Canvas {
    let mut c = Canvas::new(940.0, 640.0);
    legend(&mut c, 60.0, 22.0);
    for (k, (name, _)) in all[0].shares().into_iter().enumerate() {
        let p = Panel {
            left: 60.0 + 450.0 * (k % 2) as f64,
            top: 85.0 + 285.0 * (k / 2) as f64,
            width: 400.0,
            height: 215.0,
            x: [0.0, BINS.len() as f64],
            y: [0.0, 1.0],
        };
        c.bold([p.left, p.top - 8.0], 12.5, Anchor::Start, &name.replace('_', ": "));
        p.grid(&mut c, 45.0);
        p.frame(&mut c, 1.0);
        p.y_ticks(&mut c, 45.0, 11.0);
        for (b, range) in BINS.into_iter().enumerate() {
            let at = [p.px(b as f64 + 0.5), p.bottom() + 16.0];
            c.text(at, 11.0, Anchor::Middle, &range_words(Some(range)));
        }
        if k >= 2 {
            c.text([p.left + 200.0, p.bottom() + 36.0], 12.0, Anchor::Middle, "visibility");
        }
        for (way, colour) in COLOURS.into_iter().enumerate() {
            let mut line = Vec::new();
            for (b, range) in BINS.into_iter().enumerate() {
                let (_, ratio) = find_figures(all, way, Some(range)).shares()[k];
                let x = p.px(b as f64 + 0.5 + 0.09 * (way as f64 - 2.5));
                let Some(v) = ratio.value else { continue };
                line.push([x, p.py(v)]);
                c.circle([x, p.py(v)], 3.2, &Style::fill(colour));
                if let Some(i) = ratio.interval {
                    c.line([x, p.py(i.low)], [x, p.py(i.high)], &Style::line(colour, 1.3));
                }
            }
            c.polyline(line, &Style::line(colour, 1.0).faint(0.5));
        }
    }
    c
}

/// True against false verifications as the score's limit varies, one panel for each range of visibility; a ring marks
/// limit 1.
pub(super) fn curves(all: &[Figures]) -> Canvas {
    let mut c = Canvas::new(1240.0, 440.0);
    legend(&mut c, 60.0, 22.0);
    for (b, range) in BINS.into_iter().enumerate() {
        let p = Panel {
            left: 60.0 + 295.0 * b as f64,
            top: 85.0,
            width: 250.0,
            height: 250.0,
            x: [0.0, 1.0],
            y: [0.0, 1.0],
        };
        let title = format!("visibility {}", range_words(Some(range)));
        c.bold([p.left, p.top - 8.0], 12.5, Anchor::Start, &title);
        p.grid(&mut c, 60.0);
        c.line(p.position([0.0, 0.0]), p.position([1.0, 1.0]), &Style::line(GREY, 0.8).dashed("4 4"));
        p.x_ticks(&mut c, true, 11.0);
        p.y_ticks(&mut c, 60.0, 11.0);
        for (way, colour) in COLOURS.into_iter().enumerate() {
            let roc = &find_figures(all, way, Some(range)).verification;
            let mut line = p.all(&roc.curve);
            line.push(p.position([1.0, 1.0]));
            c.polyline(line, &Style::line(colour, 1.8).faint(0.85));
            let share = |(n, k): (u64, u64)| k as f64 / n.max(1) as f64;
            let at = p.position([share(roc.without), share(roc.with)]);
            c.circle(at, 4.5, &Style::line(colour, 2.0));
        }
        p.frame(&mut c, 1.0);
        let middle = [p.left + 125.0, p.bottom() + 36.0];
        c.text(middle, 11.5, Anchor::Middle, "verified without a source");
        if b == 0 {
            c.upright([p.left - 40.0, p.top + 125.0], 11.5, "verified with a source");
        }
    }
    c.line([60.0, 412.0], [1200.0, 412.0], &Style::line(INK, 0.3));
    c.text([60.0, 430.0], 11.0, Anchor::Start, "ring: score 1, the verifier's own limit");
    c
}
