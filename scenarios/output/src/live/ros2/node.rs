//! A node of the ROS graph, with a publisher for each topic that something was said on.

use super::attachment::attachment;
use super::keys::{self, End, NodeKey};
use super::topics::{Qos, RosTopic};
use std::collections::BTreeMap;
use std::time::{Duration, SystemTime, UNIX_EPOCH};
use zenoh::liveliness::LivelinessToken;
use zenoh::pubsub::Publisher;
use zenoh::qos::{CongestionControl, Reliability};
use zenoh::{Result, Session, Wait};
use zenoh_ext::{AdvancedPublisher, AdvancedPublisherBuilderExt, CacheConfig, MissDetectionConfig};

/// Name of the node.
pub(super) const NAME: &str = "rheotaxis";

/// Longest time after a message of a latched topic in which its number is told again, as in rmw_zenoh.
const HEARTBEAT: Duration = Duration::from_millis(500);

/// The node, seen by others until it is dropped.
pub(super) struct Node<'a> {
    session: &'a Session,
    domain: u32,
    id: String,
    /// The next number of an entity in the session; the node itself has 0.
    next: u32,
    said: BTreeMap<String, TopicPublisher>,
    _alive: LivelinessToken,
}

/// A publisher of a topic.
struct TopicPublisher {
    by: By,
    gid: [u8; 16],
    messages: i64,
    _alive: LivelinessToken,
}

enum By {
    Once(Publisher<'static>),
    /// Keeps the newest message for those who come late.
    Latched(AdvancedPublisher<'static>),
}

impl<'a> Node<'a> {
    /// Declares the node.
    pub(super) fn join(session: &'a Session, domain: u32) -> Result<Self> {
        let id = session.zid().to_string();
        let token = key(domain, &id).token();
        let alive = session.liveliness().declare_token(token).wait()?;
        Ok(Self { session, domain, id, next: 1, said: BTreeMap::new(), _alive: alive })
    }

    /// Says something on a topic of a name. If it does not fit into a subscriber's queue at once, that one loses it.
    pub(super) fn say(&mut self, topic: &RosTopic, name: &str, cdr: Vec<u8>) -> Result<()> {
        if !self.said.contains_key(name) {
            let said = self.declare(topic, name)?;
            self.said.insert(name.to_owned(), said);
        }
        let said = (self.said.get_mut(name)).expect("it was declared just above");
        said.messages += 1;
        let attachment = attachment(said.messages, wall_ns(), &said.gid);
        match &said.by {
            By::Once(publisher) => publisher.put(cdr).attachment(attachment).wait(),
            By::Latched(publisher) => publisher.put(cdr).attachment(attachment).wait(),
        }
    }

    fn declare(&mut self, topic: &RosTopic, name: &str) -> Result<TopicPublisher> {
        let RosTopic { kind, qos, .. } = *topic;
        let token = key(self.domain, &self.id).end(End::Publisher, self.next, name, kind, qos);
        self.next += 1;
        let reliability = match qos {
            Qos::Clock | Qos::Sensor => Reliability::BestEffort,
            Qos::Reliable | Qos::Latched => Reliability::Reliable,
        };
        let publisher = (self.session)
            .declare_publisher(keys::topic(self.domain, name, kind))
            .congestion_control(CongestionControl::Drop)
            .reliability(reliability);
        let by = match qos {
            Qos::Latched => By::Latched(
                publisher
                    .cache(CacheConfig::default().max_samples(1))
                    .publisher_detection()
                    .sample_miss_detection(MissDetectionConfig::default().sporadic_heartbeat(HEARTBEAT))
                    .wait()?,
            ),
            _ => By::Once(publisher.wait()?),
        };
        Ok(TopicPublisher {
            by,
            gid: keys::gid(&token),
            messages: 0,
            _alive: self.session.liveliness().declare_token(token).wait()?,
        })
    }
}

fn key(domain: u32, session: &str) -> NodeKey<'_> {
    NodeKey { domain, session, number: 0, name: NAME }
}

/// Wall-clock time since 1970, ns.
#[expect(clippy::disallowed_methods, reason = "tools of ROS measure delays with it; this thread cannot reach the run")]
fn wall_ns() -> i64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    since.map_or(0, |t| i64::try_from(t.as_nanos()).unwrap_or(i64::MAX))
}
