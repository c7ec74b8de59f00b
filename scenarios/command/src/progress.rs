//! Progress bars; that of a run, and the lines at its end.

use super::args::RunArgs;
use super::say;
use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use nalgebra::Vector2;
use output::results::Summary;
use output::shown::printable;
use rheotaxis::frame::Frame;
use rheotaxis::gantry::GantryFrame;
use rheotaxis::scenario::Loaded;
use rheotaxis::trial::{Event, Observer};
use robots::handoff::region_name;
use std::path::Path;

/// Steps of a bar that shows a share.
pub(super) const PARTS: u64 = 1000;

/// Progress of one run. The bar appears only on a terminal, and nothing is printed with `--quiet`.
pub(super) struct Progress {
    bar: ProgressBar,
    quiet: bool,
    name: String,
    limit_s: f64,
    flying: bool,
    detections: u64,
    /// Abnormal events printed so far.
    told: usize,
    /// Declarations when the bar was last updated.
    declared: usize,
    /// True positions of the sources (east, north), m. The user may see them; the searchers do not.
    sources: Vec<Vector2<f64>>,
}

impl Progress {
    /// Adds its bar to those of the runs in lanes beside it.
    pub(super) fn new(loaded: &Loaded, args: &RunArgs, bars: &MultiProgress) -> Self {
        let scenario = &loaded.scenario;
        let bar = bars.add(bar(args.quiet, PARTS, "{prefix} spin-up [{bar:30}] {percent:>3} %, {eta} left"));
        let progress = Self {
            bar,
            quiet: args.quiet,
            name: loaded.name.clone(),
            limit_s: scenario.time.limit_s.get(),
            flying: false,
            detections: 0,
            told: 0,
            declared: 0,
            sources: (scenario.sources.iter()).map(|s| Vector2::new(s.east_m.get(), s.north_m.get())).collect(),
        };
        let name = printable(&progress.name).into_owned();
        progress.bar.set_prefix(name);
        progress.say(&format!("{}: {}, seed {}", progress.name, scenario.title, args.seed));
        progress
    }

    /// Prints a line above the bar.
    pub(super) fn say(&self, line: &str) {
        if !self.quiet {
            self.bar.suspend(|| say::note(line));
        }
    }

    /// Prints a warning above the bar, also when nothing else is shown.
    pub(super) fn warn(&self, line: &str) {
        self.bar.suspend(|| say::note(format_args!("warning: {line}")));
    }

    fn spun_up(&mut self, share: f64) {
        self.bar.set_position((share * PARTS as f64) as u64);
    }

    fn frame(&mut self, frame: &Frame) {
        if !self.flying {
            self.flying = true;
            self.bar.reset();
            self.bar.set_length(self.limit_s.ceil() as u64);
            self.bar.set_style(style("{prefix} {pos:>5} s of at most {len} s [{bar:30}] {per_sec} {msg}"));
        }
        self.detections += frame.robots.iter().filter(|r| r.detected).count() as u64;
        self.bar.set_position(frame.t_s as u64);
        for abnormal in frame.abnormal.iter().skip(self.told) {
            self.say(&format!("  ! {}: {}", abnormal.robot, abnormal.line()));
        }
        self.told = frame.abnormal.len();
        let declared = frame.robots.iter().map(|r| r.declarations.len()).sum();
        let stopped = frame.gantries.iter().any(|g| g.outcome.is_some());
        if frame.step.is_multiple_of(50) || declared > self.declared || stopped {
            self.declared = declared;
            let mut doing: Vec<String> = (frame.robots.iter())
                .map(|r| match r.shown.regions.now {
                    Some(k) => format!("subregion {}: {}", region_name(k), r.behaviour.name()),
                    None => r.behaviour.name().to_string(),
                })
                .collect();
            if !frame.robots.is_empty() {
                doing.push(format!("detections {}", self.detections));
            }
            let all = || frame.robots.iter().flat_map(|r| &r.declarations);
            let edges = all().filter(|d| d.at_edge()).count();
            for (words, n) in [("declared", declared - edges), ("edges", edges)] {
                if n > 0 {
                    doing.push(format!("{words} {n}"));
                }
            }
            doing.extend(frame.gantries.iter().map(|g| self.gantry(g)));
            self.bar.set_message(format!("| {}", doing.join(", ")));
        }
    }

    fn gantry(&self, g: &GantryFrame) -> String {
        let away = (self.sources.iter().map(|s| (s - g.head_W.xy()).norm())).min_by(f64::total_cmp);
        let away = away.map_or_else(String::new, |m| format!(", {:.0} cm away", 100.0 * m));
        format!("{}{away}, {:.1} spikes/s", g.behaviour.name(), g.shown.spike_hz)
    }

    /// Removes the bar. If there are results, prints how the run ended and where they are.
    pub(super) fn finish(&self, summary: &Summary, out: Option<&Path>) {
        self.bar.finish_and_clear();
        if let Some(out) = out.filter(|_| !self.quiet) {
            // The bars of lanes that go on would break the lines.
            self.bar.suspend(|| self.tell(summary, out));
        }
    }

    fn tell(&self, summary: &Summary, out: &Path) {
        say::line(summary.headline());
        for (_, id, facts) in summary.machine_facts() {
            for fact in facts.iter().filter(|f| f.brief) {
                say::line(format_args!("  {id}: {}: {}", fact.name, fact.value));
            }
        }
        for abnormal in &summary.abnormal {
            say::line(format_args!("  ! {}: {}", abnormal.robot, abnormal.line));
        }
        for fact in summary.run_facts().iter().filter(|f| f.brief) {
            say::line(format_args!("  {}: {}", fact.name, fact.value));
        }
        say::line(format_args!("  results in {}: open report.html", out.display()));
    }
}

impl Observer for Progress {
    fn see(&mut self, event: &Event) {
        match event {
            Event::SpinUp(share) => self.spun_up(*share),
            Event::SpinUpFromCache(true) => self.say("spin-up taken from the cache"),
            Event::Frame(frame) => self.frame(frame),
            _ => {}
        }
    }
}

/// A bar of a length, which nobody sees if the command is quiet or there is no terminal.
pub(super) fn bar(quiet: bool, length: u64, template: &str) -> ProgressBar {
    let bar = if quiet { ProgressBar::hidden() } else { ProgressBar::new(length) };
    bar.with_style(style(template))
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).expect("the template is well formed").progress_chars("=> ")
}
