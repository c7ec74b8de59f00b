//! A height is shown as commanded only for vehicles that keep one.

use crate::common::short;
use rheotaxis::trial::{Event, Observer, Trial};

/// Frames, and how many of them have a commanded height.
#[derive(Default)]
struct Heights(usize, usize);

impl Observer for Heights {
    fn see(&mut self, event: &Event) {
        if let Event::Frame(frame) = event {
            self.0 += 1;
            self.1 += usize::from(frame.robots[0].asked_height().is_some());
        }
    }
}

#[test]
fn a_glider_and_a_craft_on_the_surface_have_no_commanded_height() {
    for (name, keeps) in
        [("lauv_bay", true), ("bluerov_harbour", true), ("glider_shelf", false), ("surface_lake", false)]
    {
        let loaded = short(name, 0.0, 10.0);
        let mut heights = Heights::default();
        Trial::assemble(&loaded, 1).expect("a run").run(&mut heights);
        let Heights(frames, asked) = heights;
        assert!(frames > 5, "{name}: {frames} frames");
        // The first frame comes before the first command.
        assert!(if keeps { asked + 1 >= frames } else { asked == 0 }, "{name}: {asked} of {frames}");
    }
}
