//! The arena's figures: the ranking, and who has found the source by when.

use super::standing::Standing;
use super::total::Total;
use output::charts::canvas::{Anchor, Canvas, Style};
use output::charts::palette::{GREY, likelihood};
use output::charts::panel::Panel;

/// Colours that the colour-blind can tell apart (Okabe & Ito 2008); who ranks behind these is grey.
const COLOURS: [&str; 6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];

/// Space for names to the left of the cells, px.
const NAMES: f64 = 190.0;
/// Width and height of a cell, px.
const CELL: [f64; 2] = [104.0, 22.0];

/// Searchers against families: the range of ranks, and the mean time to success by the colour.
pub(super) fn ranking(standings: &[&Standing], total: &Total) -> String {
    let rows = &total.searchers;
    let width = NAMES + CELL[0] * (standings.len() + 1) as f64 + 16.0;
    let mut c = Canvas::new(width, 92.0 + CELL[1] * rows.len() as f64 + 40.0);
    c.bold([16.0, 24.0], 13.0, Anchor::Start, "Ranks by the mean time to success (95 %); success in brackets");
    let left = |column: usize| NAMES + CELL[0] * column as f64;
    let middle = |column: usize| left(column) + CELL[0] / 2.0;
    c.bold([middle(0), 62.0], 11.0, Anchor::Middle, "all families");
    for (k, s) in standings.iter().enumerate() {
        c.text([middle(k + 1), 62.0], 11.0, Anchor::Middle, &s.family);
        c.text([middle(k + 1), 78.0], 10.0, Anchor::Middle, &format!("n = {}", s.done[0]));
    }
    for (line, (name, rank)) in rows.iter().enumerate() {
        let top = 86.0 + CELL[1] * line as f64;
        c.text([NAMES - 8.0, top + 15.0], 11.0, Anchor::End, name);
        let mut cell = |column: usize, score: f64, [best, worst]: [usize; 2], more: &str| {
            c.rect(left(column), top, CELL[0] - 2.0, CELL[1] - 2.0, &Style::fill(&likelihood(score)));
            let ranks = if best == worst { best.to_string() } else { format!("{best}–{worst}") };
            c.rimmed([middle(column) - 1.0, top + 14.5], 11.0, Anchor::Middle, &format!("{ranks}{more}"));
        };
        cell(0, rank.score, rank.interval, "");
        for (k, s) in standings.iter().enumerate() {
            if let Some((f, rank)) = s.figures.iter().filter(|f| f.searcher == *name).find_map(|f| Some((f, f.rank?))) {
                cell(k + 1, rank.score, rank.interval, &format!(" ({:.0} %)", 100.0 * f.success.share().0));
            }
        }
    }
    let below = 86.0 + CELL[1] * rows.len() as f64 + 20.0;
    let words = "Light: found at once; dark: not found by the limit. Each range of ranks holds with 95 % by itself.";
    c.text([16.0, below], 11.0, Anchor::Start, words);
    c.svg("ranking")
}

/// For each family the share of runs in which a searcher has declared the source by a time, the best ones in colour.
pub(super) fn curves(standings: &[&Standing], total: &Total) -> String {
    let columns = 2;
    let (w, h) = (400.0, 220.0);
    let lines = standings.len().div_ceil(columns);
    let best: Vec<&String> = total.searchers.iter().map(|(name, _)| name).take(COLOURS.len()).collect();
    let keys = 40.0 + lines as f64 * (h + 84.0);
    let mut c = Canvas::new(72.0 + columns as f64 * (w + 70.0), keys + 17.0 * (best.len() + 2) as f64);
    c.bold([16.0, 24.0], 13.0, Anchor::Start, "Source declared by a time, share of runs");
    for (k, s) in standings.iter().enumerate() {
        let (column, line) = ((k % columns) as f64, (k / columns) as f64);
        let panel = Panel {
            left: 56.0 + column * (w + 70.0),
            top: 62.0 + line * (h + 84.0),
            width: w,
            height: h,
            x: [0.0, s.limit_s],
            y: [0.0, 1.0],
        };
        c.bold([panel.left, panel.top - 8.0], 11.0, Anchor::Start, &format!("{} (n = {})", s.family, s.done[0]));
        panel.grid(&mut c, 60.0);
        // The best ones last, so that nothing hides them.
        let mut order: Vec<_> = s.figures.iter().filter(|f| !f.privileged).collect();
        order.sort_by_key(|f| std::cmp::Reverse(best.iter().position(|b| **b == f.searcher).unwrap_or(usize::MAX)));
        for f in order {
            let style = match best.iter().position(|b| **b == f.searcher) {
                Some(k) => Style::line(COLOURS[k], 2.0),
                None => Style::line(GREY, 0.8),
            };
            let mut points = vec![[0.0, 0.0]];
            for (k, t_s) in f.times_s.iter().enumerate() {
                let share = |k: usize| k as f64 / f.success.n.max(1) as f64;
                points.extend([[*t_s, share(k)], [*t_s, share(k + 1)]]);
            }
            points.push([s.limit_s, points[points.len() - 1][1]]);
            c.polyline(panel.all(&points), &style);
        }
        panel.axes(&mut c, 60.0, 10.0);
        panel.names(&mut c, 11.0, ["Mission time (s)", "Share"], [34.0, 34.0]);
    }
    for (k, name) in best.iter().enumerate() {
        let y = keys + 17.0 * k as f64;
        c.line([56.0, y - 4.0], [82.0, y - 4.0], &Style::line(COLOURS[k], 2.0));
        c.text([90.0, y], 11.0, Anchor::Start, name);
    }
    let y = keys + 17.0 * best.len() as f64;
    c.line([56.0, y - 4.0], [82.0, y - 4.0], &Style::line(GREY, 0.8));
    c.text([90.0, y], 11.0, Anchor::Start, "the others");
    c.svg("declared_by")
}

/// Over all families together, each counting alike: the share of runs in which a searcher has declared the source by a
/// share of the family's time limit.
pub(super) fn profile(standings: &[&Standing], total: &Total) -> String {
    let mut c = Canvas::new(72.0 + 560.0 + 240.0, 40.0 + 360.0 + 60.0);
    c.bold([56.0, 24.0], 13.0, Anchor::Start, "Profile over families: source declared by a share of the time limit");
    let panel = Panel { left: 56.0, top: 38.0, width: 560.0, height: 360.0, x: [0.0, 1.0], y: [0.0, 1.0] };
    panel.grid(&mut c, 60.0);
    let by = |name: &str, x: f64| {
        let of = |s: &&Standing| {
            let f = s.figures.iter().find(|f| f.searcher == name)?;
            let found = f.times_s.iter().filter(|t| **t <= x * s.limit_s).count();
            Some(found as f64 / f.success.n.max(1) as f64)
        };
        let shares: Vec<f64> = standings.iter().filter_map(of).collect();
        shares.iter().sum::<f64>() / shares.len().max(1) as f64
    };
    for (k, (name, _)) in total.searchers.iter().enumerate().rev() {
        let style = COLOURS.get(k).map_or(Style::line(GREY, 0.8), |colour| Style::line(colour, 2.0));
        let points: Vec<[f64; 2]> = (0..=200).map(|x| f64::from(x) / 200.0).map(|x| [x, by(name, x)]).collect();
        c.polyline(panel.all(&points), &style);
    }
    panel.axes(&mut c, 60.0, 11.0);
    panel.names(&mut c, 12.0, ["Share of the time limit", "Share of runs"], [38.0, 40.0]);
    for (k, (name, _)) in total.searchers.iter().enumerate().take(COLOURS.len() + 1) {
        let y = 50.0 + 17.0 * k as f64;
        let (style, name) = match COLOURS.get(k) {
            Some(colour) => (Style::line(colour, 2.0), name.as_str()),
            None => (Style::line(GREY, 0.8), "the others"),
        };
        c.line([632.0, y - 4.0], [658.0, y - 4.0], &style);
        c.text([664.0, y], 11.0, Anchor::Start, name);
    }
    c.svg("profile")
}
