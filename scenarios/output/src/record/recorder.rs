//! Records a run as `run.mcap`: the content of frames as ROS 2 topics.

use super::map_record::{self, MapTimes};
use super::recorder_gantry::{GantryRecorder, frames_of};
use super::recorder_log::LogRecorder;
use super::recorder_scene::SceneRecorder;
use super::recorder_ways::WayRecorder;
use crate::files::ReportError;
use crate::mcap::{CONTROL, McapFile, RecordError};
use crate::results::RunInfo;
use crate::ros::{
    MessageKind, Odometry, Transform, clock, echo_cloud, float64, nanoseconds, point_cloud, pose_stamped, text,
    transforms, vector3_stamped,
};
use crate::scene::Scene;
use nalgebra::{UnitQuaternion, Vector2, Vector3};
use rheotaxis::control::{Exchange, consultation_json};
use rheotaxis::frame::{Frame, RobotFrame, TimedReading};
use robots::handoff::{Belief, Command, Declaration, Layer, Vertical, region_name};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Frame of all poses.
pub(super) const WORLD: &str = "world";
/// Frame of clouds, at the centre of the area: their numbers of single precision would be coarse far from the datum.
pub(super) const AREA: &str = "world/area";

/// The recording of one run. If it is dropped without [`Recorder::finish`], it stays under its temporary name and is
/// readable.
pub struct Recorder {
    pub(super) file: McapFile,
    seed: u64,
    behaviours: Vec<&'static str>,
    declared: Vec<Vec<Declaration>>,
    regions: Vec<Option<u32>>,
    layers: Vec<Vec<Layer>>,
    gantries: Vec<GantryRecorder>,
    maps: Vec<(String, MapTimes)>,
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
            behaviours: Vec::new(),
            layers: Vec::new(),
            declared: Vec::new(),
            regions: Vec::new(),
            gantries: Vec::new(),
            maps: Vec::new(),
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
    #[must_use]
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
        self.behaviours.resize(frame.robots.len(), "");
        self.declared.resize(frame.robots.len(), Vec::new());
        self.regions.resize(frame.robots.len(), None);
        self.layers.resize_with(frame.robots.len(), Vec::new);
        for (k, robot) in frame.robots.iter().enumerate() {
            self.robot(t, k, robot)?;
            self.map(frame.t_s, robot)?;
        }
        self.gantries.resize_with(frame.gantries.len(), GantryRecorder::default);
        for (known, gantry) in self.gantries.iter_mut().zip(&frame.gantries) {
            known.record(&mut self.file, t, gantry)?;
        }
        for p in &frame.published {
            let (topic, at) = (format!("/{}", p.key), nanoseconds(p.t_s));
            (self.file).write_json(&topic, p.topic.name, || p.topic.schema(), at, &p.value)?;
        }
        let of_robots = frame.robots.iter().flat_map(|r| {
            let e = &r.estimate;
            [
                in_world(t, r.id.clone(), r.truth.pose.p_WB, r.truth.pose.R_WB),
                in_world(t, believed_frame(&r.id), e.p_WB(), e.attitude.R_WB()),
            ]
        });
        let of_gantries = frame.gantries.iter().flat_map(|g| frames_of(t, g));
        let mut tf: Vec<Transform> = of_robots.chain(of_gantries).collect();
        self.scene.moving(t, frame, &mut tf);
        let tf = transforms(&tf);
        self.file.write("/tf", MessageKind::TfMessage, t, &tf)?;
        self.ways.frame(&mut self.file, t, frame)?;
        self.log.frame(&mut self.file, t, frame)?;
        self.newest_ns = t;
        Ok(())
    }

    fn robot(&mut self, t: u64, k: usize, r: &RobotFrame) -> Result<(), RecordError> {
        let id = &r.id;
        let truth = Odometry {
            t_ns: t,
            frame: WORLD,
            child: id,
            position: r.truth.pose.p_WB,
            attitude: r.truth.pose.R_WB,
            linear: r.truth.v_WB_B,
            angular: r.truth.w_WB_B,
        };
        let e = &r.estimate;
        let estimate = Odometry {
            t_ns: t,
            frame: WORLD,
            child: &believed_frame(id),
            position: e.p_WB(),
            attitude: e.attitude.R_WB(),
            linear: e.v_ground_body,
            angular: e.attitude.rates_rad_s,
        };
        let file = &mut self.file;
        let mut put = |name: &str, kind: MessageKind, cdr: &[u8]| file.write(&format!("/{id}/{name}"), kind, t, cdr);
        put("truth", MessageKind::Odometry, &truth.cdr())?;
        put("estimate", MessageKind::Odometry, &estimate.cdr())?;
        put("altitude", MessageKind::Float64, &float64(r.altitude_m))?;
        if let Some(c) = r.chemical {
            put("chemical", MessageKind::Float64, &float64(c.volts))?;
        }
        if let Some(TimedReading { t_s, value: scan }) = &r.readings.ranging {
            let cloud = echo_cloud(nanoseconds(*t_s), id, scan);
            put("ranging", MessageKind::PointCloud2, &cloud)?;
        }
        if let Some(flow) = e.flow {
            let v = Vector3::new(flow.velocity.x, flow.velocity.y, 0.0);
            put("flow", MessageKind::Vector3Stamped, &vector3_stamped(t, WORLD, &v))?;
        }
        for (name, v) in r.actuators.named() {
            put(&format!("actuators/{name}"), MessageKind::Float64, &float64(v))?;
        }
        let asked = match r.command {
            Some(Command::Steer(s)) => Some((s.heading, s.water_speed_m_s, None)),
            Some(Command::Move(s)) => {
                let v = s.over_ground_m_s;
                Some((s.heading, v.norm(), Some(v)))
            }
            Some(Command::Direct(_) | Command::Drives(_)) | None => None,
        };
        if let Some((heading, speed_m_s, over_ground)) = asked {
            put("command/heading_rad", MessageKind::Float64, &float64(heading.rad()))?;
            match over_ground {
                None => put("command/water_speed_m_s", MessageKind::Float64, &float64(speed_m_s))?,
                Some(v) => {
                    put("command/east_m_s", MessageKind::Float64, &float64(v.x))?;
                    put("command/north_m_s", MessageKind::Float64, &float64(v.y))?;
                }
            }
        }
        if let Some(vertical) = r.asked_height() {
            let (name, height) = match vertical {
                Vertical::Altitude(m) => ("command/altitude_m", m),
                Vertical::Depth(m) => ("command/depth_m", m),
            };
            put(name, MessageKind::Float64, &float64(height))?;
        }
        if self.behaviours[k] != r.behaviour.name() {
            self.behaviours[k] = r.behaviour.name();
            put("behaviour", MessageKind::Text, &text(r.behaviour.name()))?;
        }
        if self.layers[k] != r.shown.layers {
            self.layers[k] = r.shown.layers.clone();
            put("layers", MessageKind::Text, &text(&layers_line(&r.shown.layers)))?;
            let holds = r.holding_layer().unwrap_or("");
            put("layer", MessageKind::Text, &text(holds))?;
        }
        for d in &r.declarations {
            let known = &mut self.declared[k];
            if known.contains(d) {
                continue;
            }
            d.join(known);
            let at = nanoseconds(d.t_s);
            let p = on_plane(d.position, 0.0);
            let pose = pose_stamped(at, WORLD, &p, &UnitQuaternion::identity());
            put("declaration", MessageKind::PoseStamped, &pose)?;
        }
        if self.regions[k] != r.shown.regions.now {
            self.regions[k] = r.shown.regions.now;
            let name = r.shown.regions.now.map_or_else(String::new, region_name);
            put("region", MessageKind::Text, &text(&name))?;
        }
        Ok(())
    }

    fn map(&mut self, t_s: f64, robot: &RobotFrame) -> Result<(), RecordError> {
        let Some(belief) = &robot.belief else {
            return Ok(());
        };
        let k = match self.maps.iter().position(|(id, _)| *id == robot.id) {
            Some(k) => k,
            None => {
                self.maps.push((robot.id.clone(), MapTimes::default()));
                self.maps.len() - 1
            }
        };
        match self.maps[k].1.due(t_s, self.map_period_s, belief) {
            Some(due) => self.write_map(&robot.id, &due),
            None => Ok(()),
        }
    }

    fn write_map(&mut self, id: &str, belief: &Belief) -> Result<(), RecordError> {
        let t = nanoseconds(belief.t_s);
        let rows = map_record::points(belief, self.scene.centre());
        let cloud = point_cloud(t, AREA, map_record::FIELDS, &rows);
        let topic = format!("/{id}/map");
        self.file.write(&topic, MessageKind::PointCloud2, t, &cloud)
    }

    /// Closes the recording with the run's digest and its ticks, and gives it its name.
    ///
    /// # Errors
    /// If the file cannot be written or renamed.
    pub fn finish(mut self, digest: &str, steps: u64) -> Result<PathBuf, ReportError> {
        for (id, mut times) in std::mem::take(&mut self.maps) {
            if let Some(last) = times.last() {
                self.write_map(&id, &last)?;
            }
        }
        self.ways.whole(&mut self.file, self.newest_ns)?;
        let steps = steps.to_string();
        let result = [("digest", digest), ("steps", steps.as_str())];
        self.file.metadata("result", &result)?;
        Ok(self.file.finish()?)
    }
}

/// A frame's pose in the world.
pub(super) fn in_world(t_ns: u64, child: String, position: Vector3<f64>, attitude: UnitQuaternion<f64>) -> Transform {
    Transform { t_ns, parent: WORLD.to_owned(), child, position, attitude }
}

fn believed_frame(id: &str) -> String {
    [id, "/estimate"].concat()
}

/// `find suppressed, maintain holds, ...`, the lowest layer first.
fn layers_line(layers: &[Layer]) -> String {
    let words: Vec<String> = (layers.iter()).map(|l| format!("{} {}", l.name, l.state.name())).collect();
    words.join(", ")
}

pub(super) fn on_plane(p: Vector2<f64>, z: f64) -> Vector3<f64> {
    Vector3::new(p.x, p.y, z)
}
