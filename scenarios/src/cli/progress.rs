//! The line that moves while a run goes on, and the words at its end.

use super::args::RunArgs;
use crate::frame::Frame;
use crate::report::Summary;
use crate::scenario::Loaded;
use indicatif::{ProgressBar, ProgressStyle};
use std::path::Path;

/// Resolution of the spin-up's share.
const PARTS: u64 = 1000;

/// Progress of one run; silent with `--quiet` and off a terminal (but for the words).
pub(super) struct Progress {
    bar: ProgressBar,
    quiet: bool,
    name: String,
    limit_s: f64,
    flying: bool,
    detections: u64,
}

impl Progress {
    pub(super) fn new(loaded: &Loaded, args: &RunArgs) -> Self {
        let scenario = &loaded.scenario;
        let bar = if args.quiet {
            ProgressBar::hidden()
        } else {
            ProgressBar::new(PARTS)
        };
        bar.set_style(style(
            "{prefix} spin-up [{bar:30}] {percent:>3} %, {eta} left",
        ));
        let progress = Self {
            bar,
            quiet: args.quiet,
            name: loaded.name.clone(),
            limit_s: scenario.time.limit_s.get(),
            flying: false,
            detections: 0,
        };
        progress.bar.set_prefix(progress.name.clone());
        progress.say(&format!(
            "{}: {}, seed {}",
            progress.name, scenario.title, args.seed
        ));
        progress
    }

    /// One line that stays.
    pub(super) fn say(&self, line: &str) {
        if !self.quiet {
            self.bar.suspend(|| eprintln!("{line}"));
        }
    }

    pub(super) fn spun_up(&mut self, share: f64) {
        self.bar.set_position((share * PARTS as f64) as u64);
    }

    pub(super) fn frame(&mut self, frame: &Frame) {
        if !self.flying {
            self.flying = true;
            self.bar.reset();
            self.bar.set_length(self.limit_s.ceil() as u64);
            self.bar.set_style(style(
                "{prefix} {pos:>5} s of at most {len} s [{bar:30}] {per_sec} {msg}",
            ));
        }
        self.detections += frame.robots.iter().filter(|r| r.detected).count() as u64;
        self.bar.set_position(frame.t_s as u64);
        if frame.step.is_multiple_of(50) || frame.robots.iter().any(|r| r.declaration.is_some()) {
            let doing: Vec<&str> = frame.robots.iter().map(|r| r.behaviour.name()).collect();
            self.bar.set_message(format!(
                "| {} | detections {}",
                doing.join(", "),
                self.detections
            ));
        }
    }

    /// Takes the bar away and says how it ended and where the results lie.
    pub(super) fn finish(&self, summary: &Summary, out: &Path) {
        self.bar.finish_and_clear();
        if self.quiet {
            return;
        }
        let run = &summary.run;
        println!(
            "{}: {} after {:.0} s ({} filaments, {})",
            self.name,
            summary.outcome.words(),
            run.totals.mission_s,
            run.totals.filaments,
            match run.real_time_factor_with_spin_up {
                Some(x) => format!("{x:.0} x real time, spin-up included"),
                None => "no time at all".to_string(),
            }
        );
        for robot in &summary.robots {
            println!(
                "  {}: travelled {:.0} m, {} detections{}",
                robot.id,
                robot.travelled_m,
                robot.detections,
                match robot.first_detection_s {
                    Some(t) => format!(", the first after {t:.0} s"),
                    None => String::new(),
                }
            );
            let Some(declared) = &robot.declaration else {
                println!("  {}: declared nothing", robot.id);
                continue;
            };
            let at = declared.position;
            println!(
                "  {}: declared a source at {:.0} m E, {:.0} m N after {:.0} s{}",
                robot.id,
                at.east_m,
                at.north_m,
                declared.t_s,
                match robot.traced_m {
                    Some(m) => format!(", {m:.0} m from the first detection"),
                    None => String::new(),
                }
            );
            if let Some(error) = &declared.error {
                print!(
                    "  {}: {:.1} m from {}",
                    robot.id, error.total_m, error.source
                );
                if let (Some(along), Some(across)) = (error.along_flow_m, error.across_flow_m) {
                    print!(" ({along:+.1} m along the flow, {across:+.1} m across)");
                }
                println!();
            }
        }
        println!("  digest {}", summary.digest);
        println!("  results in {}: open report.html", out.display());
    }
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template)
        .expect("the template is well formed")
        .progress_chars("=> ")
}
