//! Records a run as `run.mcap`: the content of frames as ROS 2 topics.

use super::recorder_gantry::{self, GantryRecorder};
use super::recorder_log::LogRecorder;
use super::recorder_robot::{self, RobotRecorder};
use super::recorder_scene::SceneRecorder;
use super::recorder_ways::WayRecorder;
use crate::files::ReportError;
use crate::mcap::{CONTROL, McapFile};
use crate::results::RunInfo;
use crate::ros::{MessageKind, Transform, clock, nanoseconds, text, transforms};
use crate::scene::Scene;
use rheotaxis::control::{Exchange, consultation_json};
use rheotaxis::frame::Frame;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The recording of one run. If it is dropped without [`Recorder::finish`], it stays under its temporary name and is
/// readable.
pub struct Recorder {
    pub(super) file: McapFile,
    seed: u64,
    robots: Vec<RobotRecorder>,
    gantries: Vec<GantryRecorder>,
    map_period_s: f64,
    pub(super) scene: SceneRecorder,
    pub(super) ways: WayRecorder,
    log: LogRecorder,
    newest_ns: u64,
}

/// Meaning of the numbers of `/plume`; the schema has only their names.
const PLUME: [(&str, &str); 7] = [
    ("topic", "/plume"),
    ("x, y, z", "middle of a filament, east and north of the centre of the area (frame world/area), up, m"),
    ("size", "its horizontal size, m"),
    ("mass", "mass of all filaments that it stands for, kg: the masses of a message sum to what is in the water"),
    ("concentration", "at its own middle, of it alone, kg/m3"),
    ("stands_for", "how many filaments it stands for; its own mass is mass / stands_for"),
    ("shown", "at most record.plume_points of the scenario, every k-th of each source"),
];

/// Default time between two recorded maps, s.
const MAP_PERIOD_S: f64 = 10.0;

impl Recorder {
    /// Starts a recording that will end at `path`; the folder must exist.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn create(path: &Path, run: &RunInfo) -> Result<Self, ReportError> {
        let mut file = McapFile::create(path, &format!("rheotaxis {}", run.version))?;
        let seed = run.seed.to_string();
        file.metadata(
            "run",
            &[
                ("scenario", &run.scenario_name),
                ("title", &run.title),
                ("success", &run.success),
                ("seed", &seed),
                ("version", &run.version),
            ],
        )?;
        file.metadata("plume", &PLUME)?;
        file.attach("scenario.ron", "text/plain", run.scenario_text.as_bytes())?;
        Ok(Self {
            file,
            seed: run.seed.number(),
            robots: Vec::new(),
            gantries: Vec::new(),
            map_period_s: MAP_PERIOD_S,
            scene: SceneRecorder::default(),
            ways: WayRecorder::default(),
            log: LogRecorder::default(),
            newest_ns: 0,
        })
    }

    /// Records what is there before the run: the attachment `scene.json`, `/scene`, `/tf_static` and the URDFs. Fins,
    /// propellers and slides then move in `/tf`.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn scene(&mut self, scene: &Arc<Scene>) -> Result<(), ReportError> {
        self.ways = WayRecorder::from_scene(scene);
        self.scene = SceneRecorder::begin(scene, &mut self.file, self.seed)?;
        Ok(())
    }

    /// The temporary path, until the recording is complete.
    pub fn temporary(&self) -> &Path {
        self.file.temporary()
    }

    /// Sets the period between two recorded maps of where the source may be, s.
    #[must_use]
    pub fn with_map_period(mut self, period_s: f64) -> Self {
        self.map_period_s = period_s;
        self
    }

    /// Records what a searcher outside the program was asked and answered, from which the run can be made again.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn consulted(&mut self, told: &Exchange) -> Result<(), ReportError> {
        let (t, said) = (nanoseconds(told.t_s), consultation_json(told).to_string());
        let topic = format!("/{}/{CONTROL}", told.robot);
        self.file.write(&topic, MessageKind::Text, t, &text(&said))?;
        Ok(())
    }

    /// Records one frame. Behaviours, layers, plans, marks and declarations are written when they change.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn frame(&mut self, frame: &Frame) -> Result<(), ReportError> {
        let t = nanoseconds(frame.t_s);
        self.file.write("/clock", MessageKind::Clock, t, &clock(t))?;
        if self.robots.is_empty() {
            self.robots = frame.robots.iter().map(RobotRecorder::new).collect();
        }
        let centre = self.scene.centre();
        for (known, robot) in self.robots.iter_mut().zip(&frame.robots) {
            known.record(&mut self.file, t, robot)?;
            known.map(&mut self.file, centre, [frame.t_s, self.map_period_s], robot)?;
        }
        self.gantries.resize_with(frame.gantries.len(), GantryRecorder::default);
        for (known, gantry) in self.gantries.iter_mut().zip(&frame.gantries) {
            known.record(&mut self.file, t, gantry)?;
        }
        for p in &frame.published {
            let (topic, at) = (format!("/{}", p.key), nanoseconds(p.t_s));
            (self.file).write_json(&topic, p.topic.name, || p.topic.schema(), at, &p.value)?;
        }
        let of_robots = frame.robots.iter().flat_map(|r| recorder_robot::frames_of(t, r));
        let of_gantries = frame.gantries.iter().flat_map(|g| recorder_gantry::frames_of(t, g));
        let mut tf: Vec<Transform> = of_robots.chain(of_gantries).collect();
        self.scene.moving(t, frame, &mut tf);
        let tf = transforms(&tf);
        self.file.write("/tf", MessageKind::TfMessage, t, &tf)?;
        self.ways.frame(&mut self.file, t, frame)?;
        self.log.frame(&mut self.file, t, frame)?;
        self.newest_ns = t;
        Ok(())
    }

    /// Closes the recording with the run's digest and its ticks, and gives it its name.
    ///
    /// # Errors
    /// If the file cannot be written or renamed.
    pub fn finish(mut self, digest: &str, steps: u64) -> Result<PathBuf, ReportError> {
        let centre = self.scene.centre();
        for robot in &mut self.robots {
            robot.last_map(&mut self.file, centre)?;
        }
        self.ways.whole(&mut self.file, self.newest_ns)?;
        let steps = steps.to_string();
        let result = [("digest", digest), ("steps", steps.as_str())];
        self.file.metadata("result", &result)?;
        Ok(self.file.finish()?)
    }
}
