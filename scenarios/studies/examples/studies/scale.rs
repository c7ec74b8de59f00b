//! How cost grows with filaments, robots and lanes: `cargo run --release -p rheotaxis-studies --example studies scale`.
//!
//! Each point is the steady channel of the catalogue in its second minute of mission, on one thread: wall time for a
//! second of mission, and the memory of a process of its own. Run it on an idle machine. It prints a table and writes
//! `docs/figures/scale.svg`, or the file that is named.

#![allow(clippy::print_stdout, clippy::disallowed_methods, reason = "it measures and speaks")]

use output::charts::canvas::{Anchor, Canvas, Style};
use output::charts::panel::Panel;
use rheotaxis::lanes::{LaneError, Lanes};
use rheotaxis::scenario::{Loaded, load};
use rheotaxis::trial::{Event, Observer, Trial};
use std::error::Error;
use std::process::Command;
use std::time::Instant;
use world::math;

/// Mission before and during the measurement, s.
const WARM_S: f64 = 60.0;
const TIMED_S: f64 = 60.0;
/// Time that a filament takes through the channel, s.
const STAYS_S: f64 = 2000.0;
/// Asks for a single point.
const POINT: &str = "--point";
const FILAMENTS: [usize; 5] = [1_000, 10_000, 100_000, 300_000, 1_000_000];
const ROBOTS: [usize; 4] = [1, 10, 30, 100];
const LANES: [usize; 5] = [1, 2, 5, 10, 20];

/// One point of a curve.
struct Point {
    n: usize,
    /// Wall time for a second of mission, ms.
    ms: f64,
    /// Memory of the process, MB.
    mb: f64,
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let args: Vec<String> = std::env::args().skip(2).collect();
    if let [asked, what, n] = &args[..]
        && asked == POINT
    {
        let (ms, mb) = measured(what, n.parse()?)?;
        println!("{ms} {mb}");
        return Ok(());
    }
    let file = args.first().map_or("docs/figures/scale.svg", |file| file);
    if file.starts_with('-') {
        println!("usage: scale [FILE]   measures, prints a table and draws FILE [default: docs/figures/scale.svg]");
        return Ok(());
    }
    let mut curves = Vec::new();
    println!("{}", crate::head("scale"));
    println!("| what | number | ms for a second of mission | memory, MB |\n|---|---|---|---|");
    for (what, numbers) in [
        ("filaments, one robot", &FILAMENTS[..]),
        ("robots, 100 000 filaments", &ROBOTS[..]),
        ("lanes, 10 000 filaments", &LANES[..]),
    ] {
        let mut curve = Vec::new();
        for &n in numbers {
            let (ms, mb) = in_a_process(what, n)?;
            println!("| {what} | {n} | {ms:.3} | {mb:.0} |");
            curve.push(Point { n, ms, mb });
        }
        curves.push((what, curve));
    }
    std::fs::write(file, drawn(&curves))?;
    println!("{file}");
    Ok(())
}

/// A point measured by a process of its own, so that none holds the memory of those before it.
fn in_a_process(what: &str, n: usize) -> Result<(f64, f64), Box<dyn Error>> {
    let mut process = Command::new(std::env::current_exe()?);
    let ended = process.args(["scale", POINT, what, &n.to_string()]).output()?;
    let said = String::from_utf8_lossy(&ended.stdout).into_owned();
    let mut numbers = said.split_whitespace().map(str::parse::<f64>);
    match (numbers.next(), numbers.next()) {
        (Some(Ok(ms)), Some(Ok(mb))) => Ok((ms, mb)),
        _ => Err(format!("{what}, {n}: {}", String::from_utf8_lossy(&ended.stderr)).into()),
    }
}

fn measured(what: &str, n: usize) -> Result<(f64, f64), Box<dyn Error>> {
    match what.split(',').next() {
        Some("filaments") => alone(&channel(n, 1)?),
        Some("robots") => alone(&channel(100_000, n)?),
        _ => in_lanes(&channel(10_000, 1)?, n),
    }
}

/// The channel with about so many filaments in it, and so many robots that search from different places.
fn channel(filaments: usize, robots: usize) -> Result<Loaded, Box<dyn Error>> {
    let rate_hz = filaments as f64 / STAYS_S;
    let mut loaded = load("uniform_channel".as_ref())?
        .set("sources[0].release.rate_hz", &rate_hz.to_string())?
        .set("success", "Completed")?;
    let first = loaded.scenario.robots[0].clone();
    for k in 1..robots {
        let mut robot = first.clone();
        robot.id = format!("auv{k}").try_into()?;
        let place = |n: f64, low: f64, high: f64| low + (high - low) * (n * 0.618_034).fract();
        robot.start.east_m = world::ranges::Finite::new(place(k as f64, -100.0, 150.0));
        robot.start.north_m = world::ranges::Finite::new(place(k as f64 * 1.7, -50.0, 50.0));
        loaded.scenario.robots.push(robot);
    }
    Ok(loaded)
}

/// Wall time for a second of mission of a run alone, ms, and the memory of the process at its end, MB.
fn alone(loaded: &Loaded) -> Result<(f64, f64), Box<dyn Error>> {
    let mut trial = Trial::assemble(loaded, 1)?;
    trial.until(WARM_S);
    let begun = Instant::now();
    trial.until(WARM_S + TIMED_S);
    let ms = 1e3 * begun.elapsed().as_secs_f64() / TIMED_S;
    Ok((ms, memory_mb()))
}

/// Takes the times at which a lane passes the beginning and the end of the measurement.
#[derive(Default)]
struct Stopwatch {
    begun: Option<Instant>,
    seconds: f64,
    over: bool,
}

impl Observer for Stopwatch {
    fn see(&mut self, event: &Event) {
        let Event::Tick(t_s) = *event else {
            return;
        };
        if t_s >= WARM_S {
            let begun = *self.begun.get_or_insert_with(Instant::now);
            self.seconds = begun.elapsed().as_secs_f64();
        }
        self.over = t_s >= WARM_S + TIMED_S;
    }

    fn goes_on(&mut self) -> bool {
        !self.over
    }
}

/// The same with so many runs in one plume.
fn in_lanes(loaded: &Loaded, n: usize) -> Result<(f64, f64), Box<dyn Error>> {
    let mut lanes = Lanes::default();
    for _ in 0..n {
        lanes.add(loaded, 1, || Ok::<_, LaneError>(Stopwatch::default()))?;
    }
    let (mut seconds, mut mb): (f64, f64) = (0.0, 0.0);
    lanes.run(|watch, _| {
        seconds = seconds.max(watch.seconds);
        mb = mb.max(memory_mb());
    });
    Ok((1e3 * seconds / TIMED_S, mb))
}

/// Memory of this process, MB; 0 where the system does not say.
fn memory_mb() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|l| l.starts_with("VmRSS:"));
    let kb = line.and_then(|l| l.split_whitespace().nth(1)?.parse::<f64>().ok());
    kb.unwrap_or(0.0) / 1024.0
}

/// Time and memory over number, each on logarithmic axes, with a line of proportion.
fn drawn(curves: &[(&str, Vec<Point>)]) -> String {
    const INK: [&str; 2] = ["#1f5fa8", "#b3541e"];
    let mut c = Canvas::new(330.0 * curves.len() as f64 + 30.0, 330.0);
    for (k, (what, curve)) in curves.iter().enumerate() {
        let log = |v: f64| math::ln(v.max(1e-3)) / math::ln(10.0);
        let x: Vec<f64> = curve.iter().map(|p| log(p.n as f64)).collect();
        let columns: [Vec<f64>; 2] =
            [curve.iter().map(|p| log(p.ms)).collect(), curve.iter().map(|p| log(p.mb)).collect()];
        let all = || columns.iter().flatten().copied();
        let panel = Panel {
            left: 330.0 * k as f64 + 60.0,
            top: 40.0,
            width: 260.0,
            height: 230.0,
            x: [x[0] - 0.1, x[x.len() - 1] + 0.1],
            y: [all().fold(f64::MAX, f64::min) - 0.2, all().fold(f64::MIN, f64::max) + 0.2],
        };
        panel.grid(&mut c, 40.0);
        panel.frame(&mut c, 1.0);
        panel.x_ticks(&mut c, true, 11.0);
        panel.y_ticks(&mut c, 40.0, 11.0);
        c.bold([panel.left, 26.0], 13.0, Anchor::Start, what);
        let middle = panel.left + 0.5 * panel.width;
        c.text([middle, 310.0], 11.0, Anchor::Middle, "log10 of the number");
        for (column, ink) in columns.iter().zip(INK) {
            let points: Vec<_> = x.iter().zip(column).map(|(x, y)| panel.position([*x, *y])).collect();
            for p in &points {
                c.circle(*p, 3.0, &Style::fill(ink));
            }
            c.polyline(points, &Style::line(ink, 1.6));
        }
        // Proportional growth through the last time.
        let (end, last) = (x[x.len() - 1], columns[0][x.len() - 1]);
        let line = [[x[0], last - (end - x[0])], [end, last]].map(|p| panel.position(p));
        panel.clip(&mut c);
        c.line(line[0], line[1], &Style::line("#888888", 1.0).dashed("4 3"));
        c.unclip();
        if k == 0 {
            let legend = ["log10 of ms for a second of mission", "log10 of memory, MB"];
            for (n, (text, ink)) in legend.iter().zip(INK).enumerate() {
                let y = 56.0 + 15.0 * n as f64;
                c.circle([panel.left + 10.0, y - 4.0], 3.0, &Style::fill(ink));
                c.text([panel.left + 18.0, y], 11.0, Anchor::Start, text);
            }
            let y = 56.0 + 30.0;
            c.text([panel.left + 18.0, y], 11.0, Anchor::Start, "dashed: in proportion");
        }
    }
    c.svg("scale")
}
