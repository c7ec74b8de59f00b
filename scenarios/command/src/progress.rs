//! Progress bars; that of a run, and the lines at its end.

use super::args::RunArgs;
use super::say;
use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use nalgebra::Vector2;
use output::results::GantrySummary;
use output::results::{DeclarationSummary, DeclaredKind, RobotSummary, Summary};
use output::shown::printable;
use rheotaxis::frame::Frame;
use rheotaxis::gantry::GantryFrame;
use rheotaxis::scenario::Loaded;
use rheotaxis::trial::{Event, Observer};
use robots::handoff::{RegionState, Verdict, region_name};
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
        let run = &summary.run;
        say::line(format_args!(
            "{}: {} after {:.0} s ({} filaments, {})",
            self.name,
            summary.outcome.label(),
            run.totals.mission_s,
            run.totals.filaments,
            match run.real_time_factor_with_spin_up {
                Some(x) if run.totals.spin_up_kept => {
                    format!("{x:.0} x real time, spin-up taken from the cache")
                }
                Some(x) => format!("{x:.0} x real time, spin-up included"),
                None => "in no time".to_string(),
            }
        ));
        for robot in &summary.robots {
            say::line(format_args!(
                "  {}: travelled {:.0} m, {} detections{}",
                robot.id,
                robot.travelled_m,
                robot.detections,
                match robot.first_detection_s {
                    Some(t) => format!(", the first after {t:.0} s"),
                    None => String::new(),
                }
            ));
            for line in declared_lines(robot) {
                say::line(format_args!("  {}: {line}", robot.id));
            }
        }
        for abnormal in &summary.abnormal {
            say::line(format_args!("  ! {}: {}", abnormal.robot, abnormal.line));
        }
        for g in &summary.gantries {
            for line in gantry_lines(g) {
                say::line(format_args!("  {}: {line}", g.id));
            }
        }
        say::line(format_args!("  digest {}", summary.digest));
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

/// What a robot declared, how the search of each subregion ended, and the remark about its map.
fn declared_lines(robot: &RobotSummary) -> Vec<String> {
    let of_region = |d: &DeclarationSummary| (d.region.unwrap_or(0), declaration(d));
    let mut by_region: Vec<(u32, String)> = robot.declarations.iter().map(of_region).collect();
    let quiet = |state| matches!(state, RegionState::Declared | RegionState::UpFlowEdge);
    for (k, region) in (0..).zip(&robot.regions) {
        if !quiet(region.state) {
            let said = format!("subregion {}: {}", region.name, region.state.label());
            by_region.push((k, said));
        }
    }
    by_region.sort_by_key(|(k, _)| *k);
    let none = (robot.sources_declared == 0).then(|| "declared no source".to_string());
    let remark = robot.map.as_ref().and_then(|m| m.remark.clone());
    let lines = by_region.into_iter().map(|(_, said)| said);
    none.into_iter().chain(lines).chain(remark).collect()
}

/// A declaration in words.
fn declaration(d: &DeclarationSummary) -> String {
    let mut said = match &d.region_name {
        Some(name) => format!("subregion {name}: "),
        None => String::new(),
    };
    let at = d.position;
    said += match d.kind {
        DeclaredKind::Source => "declared a source",
        DeclaredKind::UpFlowEdge => "traced the plume to its up-flow edge",
    };
    said += &format!(" at {:.0} m E, {:.0} m N after {:.0} s ({})", at.east_m, at.north_m, d.t_s, d.rule);
    if let Some(m) = d.traced_m {
        said += &format!(", {m:.0} m from the first detection");
    }
    if d.kind == DeclaredKind::UpFlowEdge {
        return said;
    }
    if let Some(error) = &d.error {
        said += &format!("; {:.1} m from {}", error.total_m, error.source);
        if let (Some(along), Some(across)) = (error.along_flow_m, error.across_flow_m) {
            said += &format!(" ({along:+.1} m along the flow, {across:+.1} m across)");
        }
    }
    if d.verdict != Verdict::Unchecked {
        said += &format!("; {}", d.verdict.label());
    }
    said
}

/// The results of a gantry in words.
fn gantry_lines(g: &GantrySummary) -> Vec<String> {
    let [steps, casts, sweeps] = g.moves;
    let mut lines = vec![format!(
        "travelled {:.2} m in {steps} steps, {casts} casts and {sweeps} sweeps; {} scans with a spike{}",
        g.travelled_m,
        g.spikes,
        match g.first_spike_s {
            Some(t) => format!(", the first after {t:.1} s"),
            None => String::new(),
        }
    )];
    if let (Some(v), Some(ngdr)) = (g.speed_m_s, g.ngdr) {
        lines.push(format!(
            "from the first step up-stream: {:.1} cm/s, straight distance over path length (NGDR) {ngdr:.2}",
            100.0 * v
        ));
    }
    match (&g.declaration, g.stopped) {
        (Some(d), _) => {
            let error = d.error.as_ref();
            let off = error.map_or_else(String::new, |e| format!(", {:.1} cm from {}", 100.0 * e.total_m, e.source));
            let parts = error.and_then(|e| Some((e.along_flow_m?, e.across_flow_m?)));
            let parts = parts.map_or_else(String::new, |(along, across)| {
                let (along, across) = (100.0 * along, 100.0 * across);
                format!(" ({along:+.1} cm along the flow, {across:+.1} cm across)")
            });
            lines.push(format!("stopped after {:.1} s{off}{parts}", d.t_s));
        }
        (None, Some(_)) => lines.push("gave up".to_string()),
        (None, None) => lines.push("did not stop".to_string()),
    }
    if g.blocked {
        lines.push("a drive stopped because something was in its way".to_string());
    }
    lines
}

/// A bar of a length, which nobody sees if the command is quiet or there is no terminal.
pub(super) fn bar(quiet: bool, length: u64, template: &str) -> ProgressBar {
    let bar = if quiet { ProgressBar::hidden() } else { ProgressBar::new(length) };
    bar.with_style(style(template))
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).expect("the template is well formed").progress_chars("=> ")
}
