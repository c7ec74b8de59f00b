//! An invented run for the tests: a zig-zag up a straight plume, a bowtie, a declaration, the way home.

use crate::results::{RobotInfo, RunInfo, SourceTruth};
use image::RgbImage;
use nalgebra::{UnitQuaternion, Vector2, Vector3};
use rheotaxis::frame::{Frame, PictureFrame, PingFrame, PlumeFrame, RobotFrame};
use rheotaxis::score::Score;
use robots::handoff::{
    Actuation, Attitude, Behaviour, Belief, BeliefGrid, ChemicalReading, Command, Declaration, Estimate, FlowEstimate,
    Layer, LayerState, Odour, Picture, Setpoint, Shown, SidescanPing, Vertical,
};
use std::path::Path;
use std::sync::Arc;
use world::area::Area;
use world::files::Folder;
use world::frames::{Pose, Truth};
use world::math;
use world::terrain::Terrain;
use world::units::Heading;

pub(crate) fn folder(dir: &Path) -> Folder {
    crate::files::begin_folder(dir, "run").unwrap()
}

pub(crate) fn area() -> Area {
    Area { centre: Vector2::zeros(), length_m: 1094.0, width_m: 367.0, axis: Heading::from_deg(340.0) }
}

pub(crate) fn terrain() -> Terrain {
    Terrain::sloping_over(&area(), Heading::from_deg(250.0), 4.0, 8.0)
}

pub(crate) fn info() -> RunInfo {
    RunInfo {
        scenario_name: "sample <&>".into(),
        title: "A sample <&>".into(),
        success: "a source is declared within 20 m of a true one".into(),
        scenario_text: "(version: 1, title: \"a < b\")\n".into(),
        seed: 7.into(),
        version: "0.1.0".into(),
    }
}

pub(crate) fn robots() -> Vec<RobotInfo> {
    vec![RobotInfo {
        id: "auv0".into(),
        full_scale_ug_l: Some(10.0),
        threshold: Some(0.04),
        regions: false,
        layered: true,
        numbers: Vec::new(),
    }]
}

pub(crate) fn source() -> SourceTruth {
    SourceTruth {
        id: "s1".into(),
        position: Vector3::new(-242.0, 414.0, -6.0),
        flow: Heading::from_deg(158.0).unit() * 0.1,
    }
}

/// Odour down-flow of a believed source, and ways to and from it.
pub(crate) fn odour(t_s: f64) -> Odour {
    let b = belief(t_s);
    let [nx, ..] = b.grid.n;
    let row = b.best - b.best % nx;
    Odour {
        t_s,
        detection: b.p.iter().map(|p| 0.5 * p).collect(),
        came: (row..row + nx / 2).collect(),
        walk: (row..row + nx / 3).rev().collect(),
        grid: b.grid,
    }
}

/// A belief that converges round the source.
pub(crate) fn belief(t_s: f64) -> Belief {
    let grid = BeliefGrid::over(&area(), 0.0, 8.0, [40, 15, 1]);
    let wide = 400.0 / (1.0 + t_s / 10.0);
    let from = source().position.xy();
    let weight = |i: usize| {
        let d = (grid.centre(i).xy() - from).norm_squared();
        math::exp(-0.5 * d / (wide * wide)) + 1e-12
    };
    let p: Vec<f64> = (0..grid.len()).map(weight).collect();
    let total: f64 = p.iter().sum();
    let p: Vec<f64> = p.iter().map(|p| p / total).collect();
    Belief {
        t_s,
        updates: 1 + t_s as u64,
        informed: t_s > 20.0,
        best: (0..p.len()).fold(0, |m, i| if p[i] > p[m] { i } else { m }),
        entropy_nat: p.iter().map(|p| -p * math::ln(*p)).sum(),
        credible_95: 7.0 * wide * wide,
        odour: None,
        outlook: None,
        p: Arc::new(p),
        grid: Arc::new(grid),
    }
}

/// States of a planner's layers for a behaviour.
fn layers(b: Behaviour) -> Vec<Layer> {
    let names = ["find", "maintain", "reacquire", "go_home"];
    let holds = match b {
        Behaviour::TrackIn | Behaviour::TrackOut => 1,
        Behaviour::Reacquire => 2,
        Behaviour::GoHome => 3,
        _ => 0,
    };
    let state = |k: usize| match k {
        _ if k == holds => LayerState::Holds,
        _ if holds == 3 => LayerState::Inhibited,
        0 => LayerState::Suppressed,
        _ => LayerState::Silent,
    };
    (names.iter().enumerate()).map(|(k, name)| Layer { name, state: state(k) }).collect()
}

/// A robot at a place with a heading, 1 m/s fast, that knows where it is and has sensed nothing.
pub(crate) fn robot(place: Vector3<f64>, heading: Heading) -> RobotFrame {
    RobotFrame {
        id: "auv0".into(),
        truth: Truth { v_WB_B: Vector3::x(), ..Truth::at_rest(Pose::level(place, heading)) },
        altitude_m: 2.0,
        estimate: Estimate {
            t_s: 0.0,
            position: place.xy(),
            depth_m: -place.z,
            altitude_m: None,
            attitude: Attitude { heading, roll_rad: 0.0, pitch_rad: 0.0, rates_rad_s: Vector3::zeros() },
            v_ground_body: Vector3::x(),
            flow: None,
            fix_jump: Vector2::zeros(),
        },
        goal: None,
        command: None,
        keeps_height: true,
        actuators: Actuation::default(),
        readings: Default::default(),
        chemical: None,
        detected: false,
        behaviour: Behaviour::Find,
        shown: Shown::default(),
        belief: None,
        declarations: Vec::new(),
        fix_m: None,
    }
}

/// A black picture that a robot takes ahead.
pub(crate) fn picture(of: &RobotFrame, t_s: f64) -> PictureFrame {
    let picture = Picture {
        image: Arc::new(RgbImage::new(4, 2)),
        p_BC: Vector3::new(0.5, 0.0, -0.1),
        R_BC: UnitQuaternion::identity(),
        view_rad: 1.0,
    };
    PictureFrame { t_s, robot: of.id.clone(), picture, truth: of.truth.pose, estimate: of.estimate }
}

/// A ping of a robot's sidescan with these echoes.
pub(crate) fn ping(of: &RobotFrame, t_s: f64, port_db: Arc<[f32]>, starboard_db: Arc<[f32]>) -> PingFrame {
    let ping = SidescanPing { p_BS: Vector3::zeros(), max_m: 20.0, port_db, starboard_db };
    PingFrame { t_s, robot: of.id.clone(), ping, estimate: of.estimate }
}

/// Frames at 10 Hz for `seconds`.
pub(crate) fn frames(seconds: usize) -> Vec<Frame> {
    let terrain = terrain();
    let flow = Heading::from_deg(158.0);
    let side = flow.turned(std::f64::consts::FRAC_PI_2).unit();
    let from = source().position.xy();
    let start = Vector2::new(150.0, -500.0);
    let (n, declare_at) = (10 * seconds, 7 * seconds);
    let mut p = start;
    let frame = |k: usize| {
        let t_s = k as f64 * 0.1;
        let share = (k as f64 / declare_at as f64).min(1.0);
        let away = 950.0 * (1.0 - share);
        let across = (20.0 + 0.1 * away) * math::sin(t_s / 9.0);
        let aim = if k < declare_at {
            from + flow.unit() * away + side * across
        } else {
            from + (start - from) * ((k - declare_at) as f64 / (n - declare_at) as f64)
        };
        let heading = Heading::from_vector(aim - p);
        p = aim;
        let in_plume = k < declare_at && away < 800.0 && across.abs() < 9.0;
        let behaviour = match k {
            0..20 => Behaviour::GoTo,
            _ if k >= declare_at => Behaviour::GoHome,
            _ if away >= 800.0 => Behaviour::Find,
            _ if in_plume => Behaviour::TrackIn,
            _ if away < 60.0 => Behaviour::Reacquire,
            _ => Behaviour::TrackOut,
        };
        let bed = terrain.bed_z(p.x, p.y);
        let altitude_m = 2.0 + 0.3 * math::sin(t_s / 17.0);
        let of_full_scale = if in_plume { 0.3 + 0.2 * math::sin(t_s) } else { 0.01 };
        let lost_points = (0..4).map(|i| from + side * (3.0 * f64::from(i) - 4.0)).filter(|_| away < 60.0).collect();
        let odour = (away < 60.0).then(|| Arc::new(odour(t_s.floor())));
        let declared_at = from + flow.unit() * 12.0 + side * 5.0;
        let declared = Declaration::first(declare_at as f64 * 0.1, declared_at, "along_flow");
        let mut robot = robot(Vector3::new(p.x, p.y, bed + altitude_m), heading);
        robot.truth.v_WB_B.x = 2.0;
        robot.altitude_m = altitude_m;
        robot.estimate.t_s = t_s;
        robot.estimate.position += Vector2::new(3.0 + 3.0 * math::sin(t_s / 60.0), 4.0);
        robot.estimate.altitude_m = Some(altitude_m);
        robot.estimate.attitude.pitch_rad = 0.1;
        robot.estimate.v_ground_body.x = 2.0;
        robot.estimate.flow = Some(FlowEstimate { velocity: flow.unit() * 0.1, age_s: 0.0 });
        let steer = Setpoint { heading, water_speed_m_s: 2.0, vertical: Vertical::Altitude(2.0) };
        robot.command = Some(Command::Steer(steer));
        robot.chemical = Some(ChemicalReading { volts: 5.0 * of_full_scale, of_full_scale, detected: in_plume });
        robot.detected = in_plume;
        robot.behaviour = behaviour;
        robot.shown = Shown { layers: layers(behaviour), lost_points, ..Shown::default() };
        robot.belief = Some(Belief { odour, ..belief(t_s.floor()) });
        robot.declarations.extend((k >= declare_at).then_some(declared));
        robot.fix_m = k.is_multiple_of(300).then_some(7.0);
        Frame { t_s, step: 5 * k as u64, robots: vec![robot], ..Frame::default() }
    };
    (0..n).map(frame).collect()
}

/// The score of a run with these frames.
pub(crate) fn scored(frames: &[Frame]) -> Score {
    let mut score = Score::new(vec![source().position]);
    for f in frames {
        for r in &f.robots {
            let p = r.truth.pose.p_WB;
            let n = place(&mut score, &r.id);
            score.moved_to(n, &p);
            let own = &mut score.searchers[n];
            own.misplaced((r.estimate.position - p.xy()).norm());
            if r.detected {
                own.detected(f.t_s, p.xy());
            }
            r.declarations.iter().for_each(|d| own.declared(*d));
        }
        for g in &f.gantries {
            let n = place(&mut score, &g.id);
            let own = &mut score.searchers[n];
            own.moved(&g.head_W);
            if g.shown.spike.contains(&true) {
                own.detected(f.t_s, g.head_W.xy());
            }
            g.declarations.iter().for_each(|d| own.declared(*d));
        }
        score.abnormal.clone_from(&f.abnormal);
    }
    score
}

fn place(score: &mut Score, id: &str) -> usize {
    let known = score.searchers.iter().position(|s| s.id == id);
    known.unwrap_or_else(|| score.join(id))
}

/// A meandering plume that thins out and widens.
pub(crate) fn plume() -> PlumeFrame {
    let flow = Heading::from_deg(158.0);
    let side = flow.turned(std::f64::consts::FRAC_PI_2).unit();
    let points = (0..4000)
        .map(|k| {
            let s = f64::from(k) * 0.25;
            // A fixed scatter from the golden ratio's multiples.
            let scatter = (f64::from(k) * 0.618_033_988_75).fract() - 0.5;
            let across = 0.03 * s * math::sin(s / 90.0) + scatter * (1.0 + 0.05 * s);
            let p = source().position.xy() + flow.unit() * s + side * across;
            let size = (0.001 + 0.001 * s / 0.1).sqrt();
            [p.x, p.y, -5.5, size, 5e-5, 10.0]
        })
        .collect();
    PlumeFrame { t_s: 600.0, total: 40_000, points, ..PlumeFrame::default() }
}
