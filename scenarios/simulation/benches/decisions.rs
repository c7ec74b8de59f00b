//! Decisions of searchers outside in the oceans that they share, one core: `cargo bench -p rheotaxis --bench decisions`.
//!
//! As `scenarios/python/examples/benchmark.py`, without Python: one decision a second of simulated time, about 1000
//! filaments. An item is a decision.

use divan::Bencher;
use divan::counter::ItemsCount;
use rheotaxis::control::{Question, Response};
use rheotaxis::lanes::{Shared, Worlds};
use rheotaxis::scenario::{Loaded, load};
use robots::handoff::{Manoeuvre, MotionOrder, MoveOrder, Reply};
use std::sync::Arc;
use world::units::Heading;

/// Asked every second.
const ASKED: [(&str, &str); 4] = [
    ("robots[0].strategy", "External()"),
    ("sources[0].release.rate_hz", "0.5"),
    ("time.limit_s", "36000"),
    ("record", "(frame_period_s: 40000, plume_period_s: 40000)"),
];
/// A point that moves in steps of a second.
const KINEMATIC: [(&str, &str); 3] = [
    ("robots[0].vehicle", "Kinematic()"),
    (
        "robots[0].sensors",
        "(fluorometer: (rate_hz: 1), dvl: (rate_hz: 1), adcp: (rate_hz: 1), compass: (rate_hz: 1), \
         depth: (rate_hz: 1), altimeter: (rate_hz: 1), lbl: (noise_m: 1))",
    ),
    ("time.step_s", "1"),
];

fn main() {
    divan::main();
}

/// The channel with a searcher outside that is asked every second.
fn channel(kinematic: bool) -> Loaded {
    let channel = load("uniform_channel".as_ref()).expect("in the catalogue");
    let changes = ASKED.iter().chain(KINEMATIC.iter().filter(|_| kinematic));
    changes.fold(channel, |loaded, (path, value)| loaded.set(path, value).expect("legal"))
}

fn answer(place: usize, question: &Question) -> Response {
    let heading = Heading::from_deg(((place as u64 * 77 + question.number * 50) % 360) as f64);
    let order = MoveOrder { id: None, manoeuvre: Manoeuvre::Steer { heading }, vertical: None, speed_m_s: Some(1.0) };
    Response::Answer(Reply { order: Some(MotionOrder::Move(order)), ..Reply::default() })
}

#[divan::bench(args = [(true, 8, 32), (true, 256, 1), (true, 1, 32), (false, 8, 32), (false, 32, 1)], sample_count = 20)]
fn decisions(bencher: Bencher<'_, '_>, (kinematic, plumes, each): (bool, usize, usize)) {
    let loaded = channel(kinematic);
    let spun_up = Shared::spin_up(&loaded, 1).expect("legal");
    let worlds = Arc::new(Worlds::new(&loaded));
    let begin = |_| {
        let mut ocean = Shared::among(&worlds, 1, each, Some(&spun_up)).expect("legal");
        let begun = (0..each).flat_map(|place| {
            let asked = ocean.begin(place, place as u64).expect("legal");
            asked.into_iter().map(move |question| (place, question))
        });
        let open: Vec<_> = begun.collect();
        (ocean, open)
    };
    let mut all: Vec<_> = (0..plumes).map(begin).collect();
    bencher.counter(ItemsCount::new(plumes * each)).bench_local(|| {
        for (ocean, open) in &mut all {
            for (place, question) in open.drain(..) {
                ocean.answer(place, "auv0", answer(place, &question)).expect("it asks");
            }
            *open = ocean.until_asked();
            assert!(open.len() == each, "all go on");
        }
    });
}
