//! Reliability of source maps: the probability that they state, against the share of runs in which it is true.
//!
//! *Source*: reliability diagram: Murphy & Winkler 1977, Applied Statistics 26, 41; intervals of the shares: Wilson.

use super::plots::{colour, keys, line_style};
use super::text::{Table, TableColumn};
use super::unit::Unit;
use crate::campaign::RunRow;
use crate::campaign::stats::{Interval, wilson};
use output::charts::canvas::{Anchor, Canvas, Style};
use output::charts::palette::GREY;
use output::charts::panel::Panel;

/// Edges of the bins of the stated probability. They are closer where maps are sure.
const EDGES: [f64; 8] = [0.0, 0.2, 0.4, 0.6, 0.8, 0.9, 0.99, 1.0];

/// Of what a map states a probability.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StatedEvent {
    /// The source is in the best cell.
    Cell,
    /// The source is within 5 m of its centre.
    Near,
}

impl StatedEvent {
    /// Both.
    pub const ALL: [StatedEvent; 2] = [StatedEvent::Cell, StatedEvent::Near];

    /// In words.
    pub fn label(self) -> &'static str {
        match self {
            StatedEvent::Cell => "best cell",
            StatedEvent::Near => "within 5 m of it",
        }
    }

    /// The stated probability, and whether it was true; `None` without a map or a source.
    fn statement(self, r: &RunRow) -> Option<(f64, bool)> {
        let (p, yes) = match self {
            StatedEvent::Cell => (r.map_cell_p, r.map_cell_true),
            StatedEvent::Near => (r.map_near_p, r.map_near_true),
        };
        p.zip(yes.map(|y| y > 0))
    }
}

/// Runs whose maps stated a probability within some bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bin {
    /// Bounds of the stated probability.
    pub from: f64,
    /// See above; it belongs to the next bin, if there is one.
    pub to: f64,
    /// Number of runs.
    pub n: u64,
    /// Mean of what they stated.
    pub stated: f64,
    /// In how many it was true.
    pub count: u64,
}

impl Bin {
    fn new(from: f64, to: f64, said: &[(f64, bool)]) -> Option<Self> {
        let n = said.len();
        (n > 0).then(|| Self {
            from,
            to,
            n: n as u64,
            stated: said.iter().map(|s| s.0).sum::<f64>() / n as f64,
            count: said.iter().filter(|s| s.1).count() as u64,
        })
    }

    /// The share that was true.
    pub fn share(&self) -> f64 {
        self.count as f64 / self.n as f64
    }

    /// Its interval.
    pub fn interval(&self) -> Interval {
        wilson(self.count, self.n)
    }
}

/// How reliable the maps of an arm are.
#[derive(Clone, Debug, PartialEq)]
pub struct Reliability {
    /// Name of the arm.
    pub arm: String,
    /// Of what.
    pub of: StatedEvent,
    /// All runs.
    pub all: Bin,
    /// By what they stated; bins without a run are left out.
    pub bins: Vec<Bin>,
    /// How many of the maps are those at a declaration; the others are those of the end.
    pub declared: u64,
}

/// Of an arm's runs that have a map: two statements each.
pub(crate) fn reliability(arm: &str, rows: &[&RunRow]) -> Vec<Reliability> {
    let one = |of: StatedEvent| {
        let said: Vec<_> = rows.iter().filter_map(|r| of.statement(r)).collect();
        let bins = EDGES.windows(2).filter_map(|e| {
            let last = e[1] == EDGES[EDGES.len() - 1];
            let inside = |p: f64| p >= e[0] && (p < e[1] || last);
            let of: Vec<_> = said.iter().copied().filter(|s| inside(s.0)).collect();
            Bin::new(e[0], e[1], &of)
        });
        let declared = rows.iter().filter(|r| of.statement(r).is_some() && r.map_declared == Some(1));
        Some(Reliability {
            arm: arm.to_string(),
            of,
            all: Bin::new(0.0, 1.0, &said)?,
            bins: bins.collect(),
            declared: declared.count() as u64,
        })
    };
    StatedEvent::ALL.into_iter().filter_map(one).collect()
}

/// All runs of each arm, then bin by bin.
fn lines(all: &[Reliability]) -> impl Iterator<Item = (&Reliability, &Bin)> {
    all.iter().flat_map(|r| std::iter::once(&r.all).chain(&r.bins).map(move |b| (r, b)))
}

/// The table: all runs of an arm, then bin by bin.
pub(crate) fn table(all: &[Reliability]) -> Table {
    let share = Unit::Share.scale([]);
    let between = |b: &Bin| match [b.from, b.to] {
        [0.0, 1.0] => "any".to_string(),
        [from, to] => format!("{:.0} to {:.0}", 100.0 * from, 100.0 * to),
    };
    Table::of(
        lines(all),
        &[
            ("arm", &|(r, _)| r.arm.clone()),
            ("probability of", &|(r, _)| r.of.label().to_string()),
            (&share.head("stated"), &|(_, b)| between(b)),
            ("runs", &|(_, b)| b.n.to_string()),
            (&share.head("stated, mean"), &|(_, b)| share.number(b.stated)),
            (&share.head("true"), &|(_, b)| share.number(b.share())),
            (&share.head("95 % interval"), &|(_, b)| share.numbers(b.interval())),
        ],
    )
}

/// What stands below the table.
pub(crate) fn notes(all: &[Reliability]) -> String {
    let ends: Vec<String> = (all.iter().filter(|r| r.of == StatedEvent::Cell))
        .filter(|r| r.declared < r.all.n)
        .map(|r| format!("{} of {} of {}", r.all.n - r.declared, r.all.n, r.arm))
        .collect();
    let without = match ends.as_slice() {
        [] => "All declared.".to_string(),
        some => format!("Without a declaration: {}.", some.join(", ")),
    };
    format!(
        "One statement a run: of the map at the robot's first declaration, or at the end of a run without one. {without} \
         Shares with Wilson's 95 % interval."
    )
}

/// The same as CSV.
pub(crate) fn csv(all: &[Reliability]) -> String {
    let columns: [TableColumn<'_, (&Reliability, &Bin)>; 10] = [
        ("arm", &|(r, _)| r.arm.clone()),
        ("probability_of", &|(r, _)| r.of.label().to_string()),
        ("from", &|(_, b)| b.from.to_string()),
        ("to", &|(_, b)| b.to.to_string()),
        ("n", &|(_, b)| b.n.to_string()),
        ("stated", &|(_, b)| b.stated.to_string()),
        ("count", &|(_, b)| b.count.to_string()),
        ("share", &|(_, b)| b.share().to_string()),
        ("low", &|(_, b)| b.interval().low.to_string()),
        ("high", &|(_, b)| b.interval().high.to_string()),
    ];
    Table::of(lines(all), &columns).csv()
}

const SIDE: f64 = 330.0;
const LEFT: f64 = 72.0;
const TOP: f64 = 62.0;

/// The picture: a panel for each statement, a line for each arm; the diagonal is a map that is as sure as it should be.
pub(crate) fn picture(all: &[Reliability]) -> String {
    let mut arms: Vec<&str> = all.iter().map(|r| r.arm.as_str()).collect();
    arms.dedup();
    let below = TOP + SIDE + 38.0;
    let width = LEFT + 2.0 * SIDE + 96.0;
    let mut c = Canvas::new(width, below + 17.0 * arms.len() as f64 + 14.0);
    let title = "Probability that the map states, and the share that is true, with 95 % interval";
    c.bold([LEFT, 24.0], 13.0, Anchor::Start, title);
    for (k, of) in StatedEvent::ALL.into_iter().enumerate() {
        let panel = Panel {
            left: LEFT + k as f64 * (SIDE + 72.0),
            top: TOP,
            width: SIDE,
            height: SIDE,
            x: [0.0, 1.0],
            y: [0.0, 1.0],
        };
        panel.grid(&mut c, 60.0);
        let diagonal = panel.all(&[[0.0, 0.0], [1.0, 1.0]]);
        c.polyline(diagonal, &Style::line(GREY, 1.0).dashed("4 4"));
        for (n, arm) in arms.iter().enumerate() {
            let line = Style { width: 1.6, ..line_style(n) };
            let Some(r) = all.iter().find(|r| r.arm == *arm && r.of == of) else {
                continue;
            };
            let points: Vec<[f64; 2]> = r.bins.iter().map(|b| [b.stated, b.share()]).collect();
            c.polyline(panel.all(&points), &line);
            for b in &r.bins {
                let i = b.interval();
                let bar = [i.low, i.high].map(|y| panel.position([b.stated, y]));
                c.line(bar[0], bar[1], &Style::line(colour(n), 0.8));
                // Area by the number of runs.
                let share = b.n as f64 / r.all.n as f64;
                let size = 2.0 + 5.0 * share.sqrt();
                c.circle(panel.position([b.stated, b.share()]), size, &Style::fill(colour(n)));
            }
        }
        panel.axes(&mut c, 60.0, 11.0);
        let middle = panel.left + SIDE / 2.0;
        c.text([middle, TOP - 10.0], 12.0, Anchor::Middle, of.label());
        c.text([middle, TOP + SIDE + 34.0], 12.0, Anchor::Middle, "Stated");
    }
    c.upright([22.0, TOP + SIDE / 2.0], 12.0, "Share that is true");
    let n = |arm: &str| all.iter().find(|r| r.arm == arm).map_or(0, |r| r.all.n);
    keys(&mut c, LEFT, below, arms.iter().map(|arm| (*arm, n(arm))));
    c.svg("reliability")
}

#[cfg(test)]
mod tests {
    use super::super::sample::row;
    use super::*;

    /// States `p` of the cell and 1 of 5 m round it.
    fn stated(k: u64, p: f64, cell: bool, declared: bool) -> RunRow {
        RunRow {
            map_cell_p: Some(p),
            map_near_p: Some(1.0),
            map_cell_true: Some(cell.into()),
            map_near_true: Some(1),
            map_declared: Some(declared.into()),
            ..row(k, None)
        }
    }

    #[test]
    fn each_run_counts_once_in_the_bin_of_what_it_stated() {
        let mut rows: Vec<RunRow> = (0..10).map(|k| stated(k, 0.3, k < 3, true)).collect();
        rows.extend((0..4).map(|k| stated(10 + k, 1.0, k < 2, k > 0)));
        rows.push(row(99, Some((1.0, 1.0))));
        let of: Vec<&RunRow> = rows.iter().collect();
        let all = reliability("a", &of);
        assert_eq!(all.len(), 2);
        let cell = &all[0];
        assert_eq!((cell.all.n, cell.all.count, cell.declared), (14, 5, 13));
        assert!((cell.all.stated - 0.5).abs() < 1e-12);
        let bins: Vec<_> = cell.bins.iter().map(|b| (b.from, b.n, b.count)).collect();
        assert_eq!(bins, [(0.2, 10, 3), (0.99, 4, 2)]);
        assert_eq!(cell.bins[0].interval(), wilson(3, 10));
        // A bin's lower bound belongs to it, its upper one to the next.
        let edge = stated(0, 0.2, true, true);
        assert_eq!(reliability("a", &[&edge])[0].bins[0].from, 0.2);
        let near = &all[1];
        assert_eq!((near.all.share(), near.bins.len()), (1.0, 1));
        let words = table(&all);
        assert_eq!(words.rows[1][..6], ["a", "best cell", "20 to 40", "10", "30.0", "30.0"]);
        assert!(notes(&all).contains("Without a declaration: 1 of 14 of a."));
        assert_eq!(csv(&all).lines().count(), 1 + 3 + 2);
        let svg = picture(&all);
        assert!(svg.contains("a (n = 14)") && !svg.contains("NaN"));
    }

    #[test]
    fn without_maps_there_is_none() {
        let bare = row(1, None);
        assert!(reliability("a", &[&bare]).is_empty());
    }
}
