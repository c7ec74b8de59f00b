//! A height is shown as commanded only for vehicles that keep one.

use rheotaxis::registry::Registry;
use rheotaxis::scenario::{load_text, template};
use rheotaxis::trial::{Event, Observer, Trial};
use world::ranges::{NonNegative, Positive};

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
        let text = template(name).expect("in the catalogue").text;
        let mut loaded = load_text(&Registry::default(), name, text).expect("legal");
        let time = &mut loaded.scenario.time;
        time.spin_up_s = NonNegative::new(0.0);
        time.limit_s = Positive::new(10.0);
        let mut heights = Heights::default();
        Trial::assemble(&loaded, 1).expect("a run").run(&mut heights);
        let Heights(frames, asked) = heights;
        assert!(frames > 5, "{name}: {frames} frames");
        // The first frame comes before the first command.
        assert!(if keeps { asked + 1 >= frames } else { asked == 0 }, "{name}: {asked} of {frames}");
    }
}
