//! Commands of ROS nodes to a robot: `/<robot>/cmd`, a `TwistStamped` in `<robot>/base_link`.
//!
//! Each question of the run takes the first command that came after the one it took last. Its velocities become
//! set-points over the time since the last question: x is the speed ahead through the water, z (up) changes the depth,
//! the rate about z (to port) the heading; y (left) moves hulls that go sideways. Stamps are not read. A command in
//! another frame, or with a number that is not finite, is none.
//!
//! *Source*: geometry_msgs/msg/TwistStamped; axes of REP 103.
//! *Parameters*: none.
//! *Deviations*: rates about x and y are ignored, for no autopilot here holds them.

use super::keys::{self, End, NodeKey};
use super::node::NAME;
use super::topics::Qos;
use crate::ros::MessageKind;
use crate::scene::frames::BODY;
use byteorder::LittleEndian;
use nalgebra::Vector2;
use rheotaxis::control::{Question, QuestionContent, Response};
use robots::handoff::{Behaviour, Manoeuvre, MotionOrder, MoveOrder, Reply, Vertical};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::Duration;
use zenoh::liveliness::LivelinessToken;
use zenoh::pubsub::Subscriber;
use zenoh::{Result, Session, Wait};

/// Numbers of subscribers in a session begin here, far above those of publishers.
static NEXT: AtomicU32 = AtomicU32::new(1_000_000);

/// A stamped header, then the linear and the angular velocity.
type Twist = (((i32, u32), String), [f64; 3], [f64; 3]);

/// The newest command, and how many came before it.
#[derive(Default)]
struct Inbox {
    newest: Mutex<(u64, Vec<u8>)>,
    came: Condvar,
}

/// The commands to a robot, as long as it lives.
pub(in crate::live) struct RosCommands {
    inbox: Arc<Inbox>,
    /// The frame in which commands are.
    frame: String,
    taken: u64,
    last_s: Option<f64>,
    _subscriber: Subscriber<()>,
    _alive: LivelinessToken,
}

impl RosCommands {
    /// Listens for a robot, and shows that in the ROS graph.
    pub(in crate::live) fn listen(session: &Session, domain: u32, robot: &str) -> Result<Self> {
        let (name, kind) = (format!("/{robot}/cmd"), MessageKind::TwistStamped);
        let inbox = Arc::new(Inbox::default());
        let put = Arc::clone(&inbox);
        let subscriber = session
            .declare_subscriber(keys::topic(domain, &name, kind))
            .callback(move |sample| {
                let mut newest = put.newest.lock().unwrap_or_else(PoisonError::into_inner);
                *newest = (newest.0 + 1, sample.payload().to_bytes().into_owned());
                put.came.notify_all();
            })
            .wait()?;
        let id = session.zid().to_string();
        let node = NodeKey { domain, session: &id, number: 0, name: NAME };
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let token = node.end(End::Subscriber, number, &name, kind, Qos::Reliable);
        Ok(Self {
            inbox,
            frame: format!("{robot}/{BODY}"),
            taken: 0,
            last_s: None,
            _subscriber: subscriber,
            _alive: session.liveliness().declare_token(token).wait()?,
        })
    }

    /// Whether any command has come.
    pub(in crate::live) fn any(&self) -> bool {
        let newest = self.inbox.newest.lock();
        newest.unwrap_or_else(PoisonError::into_inner).0 > 0
    }

    /// The answer to a question: the next command, within the question's deadline.
    pub(in crate::live) fn answer(&mut self, question: &Question, going: &dyn Fn() -> bool) -> Response {
        const NAP: Duration = Duration::from_millis(20);
        let mut left = Duration::try_from_secs_f64(question.deadline_s).unwrap_or(Duration::MAX);
        let mut newest = (self.inbox.newest.lock()).unwrap_or_else(PoisonError::into_inner);
        while newest.0 == self.taken {
            if left.is_zero() || !going() {
                return Response::Late;
            }
            let nap = left.min(NAP);
            let waited = self.inbox.came.wait_timeout(newest, nap);
            newest = waited.unwrap_or_else(PoisonError::into_inner).0;
            left -= nap;
        }
        self.taken = newest.0;
        let bytes = newest.1.clone();
        drop(newest);
        let dt_s = question.t_s - self.last_s.replace(question.t_s).unwrap_or(question.t_s);
        match twist(&bytes).and_then(|said| sound(said, &self.frame)) {
            Ok([linear, angular]) => order(question, linear, angular[2], dt_s),
            Err(why) => Response::Nonsense(why),
        }
    }
}

/// Reads a message in little-endian CDR.
fn twist(bytes: &[u8]) -> std::result::Result<Twist, String> {
    let ([0, 1, _, _], body) = bytes.split_first_chunk::<4>().ok_or("a command without content")? else {
        return Err("a command must be little-endian CDR".to_string());
    };
    let read = cdr_encoding::from_bytes::<Twist, LittleEndian>(body);
    read.map(|(twist, _)| twist).map_err(|e| format!("no TwistStamped: {e}"))
}

/// The velocities of a command that is in a frame; one that names none is.
fn sound(((_, frame), linear, angular): Twist, own: &str) -> std::result::Result<[[f64; 3]; 2], String> {
    if !frame.is_empty() && frame != own {
        let frame: String = frame.chars().take(100).collect();
        return Err(format!("a command must be in the frame `{own}`, or name none, got `{frame}`"));
    }
    for (name, vector) in [("linear", linear), ("angular", angular)] {
        for (axis, value) in ["x", "y", "z"].into_iter().zip(vector) {
            if !value.is_finite() {
                return Err(format!("twist.{name}.{axis} of a command must be a finite number, got {value}"));
            }
        }
    }
    Ok([linear, angular])
}

fn order(question: &Question, [ahead, left, up]: [f64; 3], yaw_rad_s: f64, dt_s: f64) -> Response {
    let QuestionContent::Robot(seen, _) = &question.seen else {
        return Response::Nonsense("a gantry takes no TwistStamped".to_string());
    };
    let e = &seen.estimate;
    // Compass headings grow to starboard.
    let heading = e.attitude.heading.turned(-yaw_rad_s * dt_s);
    let manoeuvre = if seen.able.sideways {
        let forward = e.attitude.heading.unit();
        let port = Vector2::new(-forward.y, forward.x);
        Manoeuvre::Slide { heading, over_ground_m_s: forward * ahead + port * left }
    } else {
        Manoeuvre::Steer { heading }
    };
    Response::Answer(Reply {
        order: Some(MotionOrder::Move(MoveOrder {
            id: None,
            manoeuvre,
            vertical: Some(Vertical::Depth((e.depth_m - up * dt_s).max(0.0))),
            speed_m_s: Some(ahead.max(0.0)),
        })),
        behaviour: Some(Behaviour::Other("ros_cmd")),
        ..Reply::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ros::twist_stamped;
    use nalgebra::Vector3;

    #[test]
    fn what_others_write_is_read() {
        let velocity = Vector3::new(1.5, -0.25, 0.125);
        let said = twist_stamped(1_500_000_000, "auv0/base_link", &velocity);
        let (head, linear, angular) = twist(&said).expect("it is one");
        assert_eq!(head, ((1, 500_000_000), "auv0/base_link".to_string()));
        assert_eq!((linear, angular), ([1.5, -0.25, 0.125], [0.0; 3]));
    }

    #[test]
    fn what_is_none_is_refused() {
        for wrong in [&b""[..], b"\0\x01\0", b"\0\0\0\0\0\0\0\0", b"\0\x01\0\0\x01\0\0\0"] {
            assert!(twist(wrong).is_err(), "{wrong:?}");
        }
    }

    #[test]
    fn what_is_not_finite_or_in_another_frame_is_refused() {
        let own = "auv0/base_link";
        let said = |frame: &str, all: [f64; 6]| {
            let [linear, angular] = [[all[0], all[1], all[2]], [all[3], all[4], all[5]]];
            sound((((0, 0), frame.to_string()), linear, angular), own)
        };
        let ahead = [1.5, 0.0, 0.0, 0.0, 0.0, 0.0];
        for frame in ["", own] {
            assert_eq!(said(frame, ahead), Ok([[1.5, 0.0, 0.0], [0.0; 3]]));
        }
        for frame in ["map", "base_link", "auv1/base_link", "/auv0/base_link"] {
            let why = said(frame, ahead).unwrap_err();
            assert!(why.contains(own) && why.ends_with(&format!("got `{frame}`")));
        }
        let names = ["linear.x", "linear.y", "linear.z", "angular.x", "angular.y", "angular.z"];
        for (value, word) in [(f64::NAN, "NaN"), (f64::INFINITY, "inf")] {
            for (k, name) in names.into_iter().enumerate() {
                let mut all = [0.0; 6];
                all[k] = value;
                let why = said(own, all).unwrap_err();
                assert!(why.contains(name) && why.ends_with(word), "{why}");
            }
        }
    }
}
