//! The crab's plume from the side, beside a neutral one:
//! `cargo run --release -p rheotaxis-studies --example studies rising_thread`.
//!
//! A nozzle in the flume of `flume_crab_paper` releases water that stays neutral; the paper's brine made neutral with
//! alcohol, as warm as the flume, and 2 K and 4 K warmer and 2 K colder; and, to show what it is worth that its
//! buoyancy comes with molecular mixing, a release that is as light from the start. It prints the mean height of the
//! filaments by distance over five minutes, with the rise that Briggs's law would give without turbulence, and writes `docs/figures/rising_thread.png`, or the file that is named
//! after `--`: the filaments at the end, and the mean height of all minutes.

#![allow(clippy::print_stdout, reason = "it measures and speaks")]

use output::charts::canvas::{Anchor, Canvas, Style};
use output::charts::panel::Panel;
use output::charts::png;
use plumes::release::{BuoyancySpec, CompositionSpec};
use rheotaxis::ocean::Origin;
use rheotaxis::scenario::load;
use std::error::Error;
use std::path::Path;
use world::fields::Flow;
use world::math;
use world::ranges::Finite;

/// Time over which heights are averaged, s.
const WATCHED_S: f64 = 300.0;
/// Width of a slice along the stream, and the number of slices, m.
const SLICE_M: f64 = 0.1;
const SLICES: usize = 14;
/// Heights of the outer probes and of the middle one above the bed, cm.
const PROBES_CM: [f64; 2] = [7.5, 12.5];

/// What a plume looks like from the side: filaments at the end (m down-stream, m above the bed), and mean heights.
struct Side {
    filaments: Vec<[f64; 2]>,
    heights_m: Vec<f64>,
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(2);
    let file = file.as_deref().unwrap_or("docs/figures/rising_thread.png");
    let loaded = load(Path::new("flume_crab_paper"))?;
    let BuoyancySpec::Composition(brine) = loaded.scenario.sources[0].release.buoyancy.clone() else {
        return Err("flume_crab_paper releases a solution".into());
    };
    let warm = |temperature_c| {
        BuoyancySpec::Composition(CompositionSpec { temperature_c: Finite::new(temperature_c), ..brine.clone() })
    };
    let mut sides = Vec::new();
    for (title, buoyancy) in [
        ("neutral", BuoyancySpec::Neutral),
        ("47 g/L of salt, made neutral with 2-propanol", warm(20.0)),
        ("2 K colder", warm(18.0)),
        ("2 K warmer", warm(22.0)),
        ("4 K warmer", warm(24.0)),
        ("as light at once", BuoyancySpec::Excess(Finite::new(-7.0))),
    ] {
        let mut scenario = loaded.scenario.clone();
        scenario.sources[0].release.buoyancy = buoyancy;
        let origin = Origin::from_scenario(&scenario, &loaded.base_dir, 1);
        sides.push((title, watched(&origin, &loaded.base_dir)?));
    }
    let titles: Vec<&str> = sides.iter().map(|(title, _)| *title).collect();
    println!("Mean height, cm above the bed:\n");
    println!("| distance, cm | {} | rise by Briggs without turbulence, cm |", titles.join(" | "));
    println!("|---{}|", "|---".repeat(sides.len() + 1));
    for slice in 0..SLICES {
        let x = (slice as f64 + 0.5) * SLICE_M;
        let heights: Vec<String> = sides.iter().map(|(_, s)| format!("{:.1}", 100.0 * s.heights_m[slice])).collect();
        println!("| {:.0} | {} | {:.1} |", 100.0 * x, heights.join(" | "), 100.0 * briggs(x));
    }
    std::fs::write(file, png(&drawn(&sides[..2]))?)?;
    println!("\n{file}");
    Ok(())
}

/// 1.6 F^⅓ x^⅔/U with the final buoyancy of 4.8e-8 m⁴/s³ at 5 cm/s, m (Briggs 1969).
fn briggs(x_m: f64) -> f64 {
    let f = 4.8e-8 / std::f64::consts::PI;
    1.6 * math::cbrt(f) * math::powf(x_m, 2.0 / 3.0) / 0.05
}

fn watched(origin: &Origin, base_dir: &Path) -> Result<Side, Box<dyn Error>> {
    let (mut water, mut plume) = origin.build(base_dir)?.state();
    let spin_up_s = origin.spin_up_s();
    let (mut count, mut sum) = (vec![0.0; SLICES], vec![0.0; SLICES]);
    plume.pace(0.0, f64::INFINITY, 0.05);
    let bed_m = 0.2;
    for n in 0..((spin_up_s + WATCHED_S) / 0.5) as usize {
        let t_s = 0.5 * (n + 1) as f64;
        water.advance(t_s);
        plume.advance(&water, t_s);
        if t_s > spin_up_s {
            for f in plume.iter() {
                let slice = (f[0] / SLICE_M) as usize;
                if slice < SLICES && f[0] >= 0.0 {
                    count[slice] += 1.0;
                    sum[slice] += f[2] + bed_m;
                }
            }
        }
    }
    Ok(Side {
        filaments: plume.iter().map(|f| [f[0], f[2] + bed_m]).collect(),
        heights_m: sum.iter().zip(&count).map(|(s, n)| s / n).collect(),
    })
}

fn drawn(sides: &[(&str, Side)]) -> String {
    let mut c = Canvas::new(860.0, 420.0);
    for (k, (title, side)) in sides.iter().enumerate() {
        let panel = Panel {
            left: 60.0,
            top: 36.0 + 185.0 * k as f64,
            width: 780.0,
            height: 130.0,
            x: [-5.0, 100.0 * SLICE_M * SLICES as f64],
            y: [0.0, 20.0],
        };
        panel.grid(&mut c, 60.0);
        panel.clip(&mut c);
        for [x, z] in &side.filaments {
            let p = panel.position([100.0 * x, 100.0 * z]);
            c.circle(p, 1.6, &Style::fill("#7a4fa3").faint(0.45));
        }
        for height in PROBES_CM {
            let line = [panel.x[0], panel.x[1]].map(|x| panel.position([x, height]));
            c.line(line[0], line[1], &Style::line("#444444", 1.0).dashed("5 4"));
        }
        let mean = side
            .heights_m
            .iter()
            .enumerate()
            .map(|(n, z)| panel.position([100.0 * SLICE_M * (n as f64 + 0.5), 100.0 * z]));
        c.polyline(mean.collect(), &Style::line("#d2691e", 2.2));
        c.unclip();
        panel.frame(&mut c, 1.0);
        panel.x_ticks(&mut c, true, 11.0);
        panel.y_ticks(&mut c, 40.0, 11.0);
        c.bold([panel.left, panel.top - 8.0], 13.0, Anchor::Start, title);
        c.upright([22.0, panel.top + 65.0], 11.0, "cm above the bed");
        let at = panel.position([panel.x[1] - 1.0, 12.9]);
        c.text(at, 10.0, Anchor::End, "height of the middle probe");
        let at = panel.position([panel.x[1] - 1.0, 7.9]);
        c.text(at, 10.0, Anchor::End, "outer probes");
    }
    c.text([450.0, 400.0], 11.0, Anchor::Middle, "cm down-stream of the nozzle; line: mean height over five minutes");
    c.svg("rising_thread")
}
