//! The whole Duck mission on one core, spin-up included: `cargo bench -p rheotaxis --bench mission`.
//!
//! Prints how many simulated seconds of mission pass in a second of waiting; the time itself is divan's.

use divan::Bencher;
use rheotaxis::scenario::load;
use rheotaxis::trial::{RunEnd, Trial};
use std::path::Path;
use std::time::Instant;

fn main() {
    divan::main();
}

fn run(name: &str, seed: u64) -> RunEnd {
    let loaded = load(Path::new(name)).expect("a scenario of the catalogue");
    let trial = Trial::assemble(&loaded, seed).expect("that can be assembled");
    trial.finish_quietly()
}

#[divan::bench(args = ["duck_st", "flume_crab_paper", "uniform_channel"], sample_count = 3, sample_size = 1)]
#[allow(clippy::disallowed_methods, clippy::print_stdout, reason = "a benchmark reads the clock and speaks")]
fn mission(bencher: Bencher<'_, '_>, name: &str) {
    let mut seed = 0;
    bencher.bench_local(|| {
        seed += 1;
        let begun = Instant::now();
        let ended = run(name, seed);
        let factor = ended.t_s / begun.elapsed().as_secs_f64();
        println!("{name}, seed {seed}: {:.0} s of mission, {factor:.0} x real time", ended.t_s);
    });
}
