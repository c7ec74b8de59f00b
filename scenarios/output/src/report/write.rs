//! Writes everything that a run leaves into one folder.

use super::{film, html};
use crate::charts::png;
use crate::columns::{ColumnInfo, columns, header};
use crate::figures as draw;
use crate::files::{PendingFiles, ReportError, guarded};
use crate::results::probes::file_name;
use crate::results::{RunReport, belief_track, odour};
use rheotaxis::frame::PlumeFrame;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use world::area::Area;
use world::files::Folder;

/// Writes `summary.json`, `plume.csv`, figures and `report.html` into a folder and returns the paths. Figures, each as
/// `.svg` and `.png`: `map` (not if there are only gantries), `series-<robot>`, and `flume-<gantry>`,
/// `probes-<gantry>`, `approach-<gantry>`. For robots with a map also `belief-<robot>` and `convergence`, and
/// `belief-<robot>.csv`; for those whose map says more about the odour `odour-<robot>`, with a table; for one whose
/// sidescan surveyed a declared place `sidescan-<robot>`.
///
/// # Errors
/// If files cannot be written or figures cannot be drawn; names each of them. All others are written.
pub fn write_all(out: &Folder, run: &RunReport<'_>) -> Result<Vec<PathBuf>, ReportError> {
    let mut kept = PendingFiles::new(out);
    kept.write("summary.json", run.summary.json().as_bytes());
    if let Some(plume) = run.plume {
        kept.write("plume.csv", plume_csv(plume, run.area).as_bytes());
    }
    for robot in &run.beliefs.robots {
        let name = file_name(&robot.id);
        let csv = belief_track::csv(robot, run.sources);
        kept.write(&format!("belief-{name}.csv"), csv.as_bytes());
        if !robot.odour.is_empty() {
            let csv = odour::csv(&robot.odour);
            kept.write(&format!("odour-{name}.csv"), csv.as_bytes());
        }
    }
    let figures = figures(run);
    // The pictures are painted beside each other, and while the animation is made.
    let (film, painted) = beside_each_other(2, &figures, Figure::png, || guarded(|| film::film(run)));
    let mut shown = Vec::new();
    for (Figure { name, title, svg }, png) in figures.into_iter().zip(painted) {
        if let Ok(svg) = svg {
            kept.write(&format!("{name}.svg"), svg.as_bytes());
            shown.push((title, svg));
        }
        kept.draw(&format!("{name}.png"), png);
    }
    // A broken animation is no reason to lose the page.
    let film = match film.transpose() {
        Some(Ok(film)) => Some(film),
        Some(Err(cause)) => {
            kept.draw("report.html (animation)", Err(cause));
            None
        }
        None => None,
    };
    let page = html::page(run.summary, film.as_deref(), &shown, run.pictures, run.scenario_text);
    kept.write("report.html", page.as_bytes());
    kept.done()
}

/// What `here` makes in this thread, and what `each` makes of every item meanwhile, in so many further threads. They end
/// with this call: a pool that stays would be dead in a process that is forked later. What they have not made by then,
/// or all where the system gives no threads, this one makes.
fn beside_each_other<T: Sync, R: Send, H>(
    threads: usize,
    items: &[T],
    each: impl Fn(&T) -> R + Sync,
    here: impl FnOnce() -> H,
) -> (H, Vec<R>) {
    let (next, made) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let take = || {
        let n = next.fetch_add(1, Ordering::Relaxed);
        Some((n, items.get(n)?))
    };
    let work = || {
        while let Some((n, item)) = take() {
            let one = each(item);
            made.lock().expect("nobody panics with it").push((n, one));
        }
    };
    let here = thread::scope(|scope| {
        for _ in 0..threads {
            drop(thread::Builder::new().spawn_scoped(scope, work));
        }
        let here = here();
        work();
        here
    });
    let mut made = made.into_inner().expect("nobody panics with it");
    made.sort_by_key(|(n, _)| *n);
    (here, made.into_iter().map(|(_, one)| one).collect())
}

/// A figure of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Its name: that of its files, without their endings.
    pub name: String,
    /// Its title.
    pub title: String,
    /// The drawing as SVG, or the reason why there is none.
    pub svg: Result<String, String>,
}

impl Figure {
    /// The drawing as PNG, or the reason why there is none.
    fn png(&self) -> Result<Vec<u8>, String> {
        guarded(|| png(self.svg.as_deref().map_err(String::clone)?)).flatten()
    }
}

/// Draws each figure of the run.
pub fn figures(run: &RunReport<'_>) -> Vec<Figure> {
    let mut figures: Vec<Figure> = Vec::new();
    let mut add = |kind: &str, id: &str, title: String, svg: Result<Option<String>, String>| {
        let name = if id.is_empty() { kind.to_owned() } else { format!("{kind}-{}", file_name(id)) };
        figures.extend(svg.transpose().map(|svg| Figure { name, title, svg }));
    };
    let some = |draw: &dyn Fn() -> String| guarded(draw).map(Some);
    // A gantry's own figures show all of a flume.
    if run.gantries.is_empty() || !run.track.robots.is_empty() {
        add("map", "", "Map".to_owned(), some(&|| draw::map(run)));
    }
    for robot in &run.track.robots {
        let id = &robot.info.id;
        add("series", id, format!("Time series of {id}"), some(&|| draw::series(run, robot)));
    }
    for robot in &run.beliefs.robots {
        let id = &robot.id;
        add("belief", id, format!("Where {id} believed the source"), some(&|| draw::belief(run, robot)));
        if !robot.odour.is_empty() {
            add("odour", id, format!("Where {id} believed the odour"), some(&|| draw::odour(run, robot)));
        }
    }
    for robot in &run.echoes.robots {
        add("sidescan", &robot.id, format!("Sidescan of {}", robot.id), guarded(|| draw::sidescan(run, robot)));
    }
    if !run.beliefs.robots.is_empty() {
        add("convergence", "", "Convergence of the maps".to_owned(), some(&|| draw::convergence(run)));
    }
    for t in run.gantries {
        let id = &t.info.id;
        add("flume", id, format!("Track over the plume: {id}"), guarded(|| draw::flume(run, t)));
        add("probes", id, format!("Probes, thresholds and spikes: {id}"), guarded(|| draw::probe_records(run, t)));
        let title = format!("Speed and distance from the centreline: {id}");
        add("approach", id, title, guarded(|| draw::approach(run, t)));
    }
    figures
}

/// The columns of `plume.csv`.
pub(super) const PLUME: [ColumnInfo; 7] = columns! {
    "t_s", "s", "Time since the start of the mission.";
    "east_m", "m", "Centre of the filament, east.";
    "north_m", "m", "Centre of the filament, north.";
    "up_m", "m", "Centre of the filament, up.";
    "size_m", "m", "Horizontal standard deviation of its concentration about the centre.";
    "mass_kg", "kg", "Mass of all filaments that the row stands for; the column sums to the mass in the water.";
    "stands_for", "", "Number of filaments that the row stands for.";
};

/// The filaments that the map shows. `mass_kg` is that of all filaments for which one stands, so that the column sums
/// to the mass in the water; `stands_for` is their number. Places are rounded to a hundredth of a metre, in a flume of
/// a millimetre.
pub(super) fn plume_csv(plume: &PlumeFrame, area: &Area) -> String {
    let (d, d_z, s) = if area.width_m < 10.0 { (5, 5, 6) } else { (2, 3, 4) };
    let mut text = header(&PLUME) + "\n";
    for [x, y, z, size, mass, n] in &plume.points {
        writeln!(text, "{:.2},{x:.d$},{y:.d$},{z:.d_z$},{size:.s$},{mass:.6e},{n:.3}", plume.t_s)
            .expect("writing to a String succeeds");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// None stands for a system that gives no threads: spawning them then fails, and this is what is left.
    #[test]
    fn all_is_made_in_order_with_any_number_of_threads() {
        let items: Vec<u32> = (0..50).collect();
        for threads in [0, 1, 2] {
            let (here, made) = beside_each_other(threads, &items, |n| n * n, || "here");
            assert_eq!(here, "here");
            assert!(made.iter().copied().eq((0..50).map(|n| n * n)));
        }
        assert!(beside_each_other(2, &[0u8; 0], |n| *n, || ()).1.is_empty());
    }
}
