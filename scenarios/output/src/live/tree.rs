//! The keys of one run in zenoh: they publish messages, keep them for late subscribers, and show that the run is alive.

use super::message::Message;
use super::{LiveOptions, Payload, Plane};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};
use zenoh::bytes::Encoding;
use zenoh::key_expr::{KeyExpr, OwnedKeyExpr, keyexpr};
use zenoh::liveliness::LivelinessToken;
use zenoh::qos::CongestionControl;
use zenoh::query::{Query, Queryable};
use zenoh::{Result, Session, Wait};
use zenoh_ext::{AdvancedPublisher, AdvancedPublisherBuilderExt, CacheConfig, MissDetectionConfig};

/// The newest message of every key, to answer queries.
type KeptMessages = Arc<Mutex<BTreeMap<String, (OwnedKeyExpr, Message)>>>;

/// One run's part of the tree, alive until dropped.
pub(super) struct Tree<'a> {
    session: &'a Session,
    base: String,
    kept: KeptMessages,
    // Kept because others see that they exist.
    meta: Vec<AdvancedPublisher<'static>>,
    _asked: Queryable<()>,
    _alive: LivelinessToken,
}

impl<'a> Tree<'a> {
    /// Declares the run. A subscriber that sees the token can already ask for all of `meta`.
    pub(super) fn grow(session: &'a Session, options: &LiveOptions, meta: Vec<Message>) -> Result<Self> {
        let base = format!("rheotaxis/{}", options.run_id);
        let kept = KeptMessages::default();
        let asked = session
            .declare_queryable(format!("{base}/**"))
            .complete(true)
            .callback({
                let (kept, plane) = (Arc::clone(&kept), Arc::clone(&options.plane));
                let own = OwnedKeyExpr::new(base.clone())?;
                move |query| match command(&own, query.key_expr()) {
                    Some((command, key)) => obey(&plane, &command, key, query),
                    None => answer(&kept, &query),
                }
            })
            .wait()?;
        let mut publishers = Vec::new();
        for message in meta {
            publishers.push(keep_published(session, &base, &kept, message)?);
        }
        let alive = session.liveliness().declare_token(format!("{base}/@live/sim")).wait()?;
        Ok(Self { session, base, kept, meta: publishers, _asked: asked, _alive: alive })
    }

    /// Sends and keeps a message. If it does not fit into a subscriber's queue at once, that subscriber loses it.
    pub(super) fn say(&self, message: Message) -> Result<()> {
        self.put(message, CongestionControl::Drop)
    }

    /// Sends and keeps the last message. It waits for room in the queues of subscribers, so that none that reads loses
    /// it.
    pub(super) fn say_last(&self, message: Message) -> Result<()> {
        self.put(message, CongestionControl::Block)
    }

    fn put(&self, message: Message, congestion: CongestionControl) -> Result<()> {
        let key = self.key(&message)?;
        keep(&self.kept, key.clone(), message.clone());
        let put =
            self.session.put(&key, message.payload.clone()).encoding(encoding(&message)).congestion_control(congestion);
        put.attachment(message.attachment).wait()
    }

    /// Sends and keeps a message for zenoh-ext's advanced subscribers too, like those from the start.
    pub(super) fn say_for_good(&mut self, message: Message) -> Result<()> {
        let publisher = keep_published(self.session, &self.base, &self.kept, message)?;
        self.meta.push(publisher);
        Ok(())
    }

    fn key(&self, message: &Message) -> Result<OwnedKeyExpr> {
        OwnedKeyExpr::new(format!("{}/{}", self.base, message.key))
    }
}

/// Before it is sent: who subscribes in between, and then asks for what was said, hears it at least once.
fn keep(kept: &KeptMessages, key: OwnedKeyExpr, message: Message) {
    kept.lock().unwrap_or_else(PoisonError::into_inner).insert(message.key.clone(), (key, message));
}

/// Publishes once with a cache of one, which advanced subscribers find whenever they come.
fn keep_published(
    session: &Session,
    base: &str,
    kept: &KeptMessages,
    message: Message,
) -> Result<AdvancedPublisher<'static>> {
    let key = OwnedKeyExpr::new(format!("{base}/{}", message.key))?;
    let publisher = session
        .declare_publisher(key.clone())
        .encoding(encoding(&message))
        .congestion_control(CongestionControl::Drop)
        // Numbered, not time-stamped: time stamps need a setting that only routers have by default.
        .sample_miss_detection(MissDetectionConfig::default())
        .cache(CacheConfig::default().max_samples(1))
        .publisher_detection()
        .wait()?;
    keep(kept, key, message.clone());
    publisher.put(message.payload).wait()?;
    Ok(publisher)
}

fn answer(kept: &KeptMessages, query: &Query) {
    // Copied, so that a slow receiver of the answer does not hold the lock.
    let answers: Vec<(OwnedKeyExpr, Message)> = kept
        .lock()
        .unwrap_or_else(PoisonError::into_inner)
        .values()
        .filter(|(key, _)| query.key_expr().intersects(key))
        .cloned()
        .collect();
    for (key, message) in answers {
        let encoding = encoding(&message);
        // It is no failure if the one who asked has gone away.
        let _gone =
            query.reply(KeyExpr::from(key), message.payload).encoding(encoding).attachment(message.attachment).wait();
    }
}

/// The command that a query names, and its key in this run. The name of the run may be a wildcard, but not `rpc`: who
/// asks for all that a run keeps commands nothing.
fn command(own: &keyexpr, asked: &keyexpr) -> Option<(String, OwnedKeyExpr)> {
    let (runs, command) = asked.as_str().rsplit_once("/rpc/")?;
    let to_this = keyexpr::new(runs).is_ok_and(|runs| runs.intersects(own));
    let key = OwnedKeyExpr::new(format!("{own}/rpc/{command}")).ok()?;
    to_this.then(|| (command.to_owned(), key))
}

/// Does a command of the control plane, which answers the query: at once, or when it is done.
fn obey(plane: &Plane, command: &str, key: OwnedKeyExpr, query: Query) {
    let parameter = ["s", "times"].iter().find_map(|name| query.parameters().get(*name)).map(str::to_owned);
    plane.command(command, parameter.as_deref(), move |told| {
        // It is no failure if the one who asked has gone away.
        let _gone = match told {
            Ok(told) => query.reply(KeyExpr::from(key), told.to_string()).encoding(Encoding::APPLICATION_JSON).wait(),
            Err(why) => query.reply_err(why).wait(),
        };
    });
}

fn encoding(message: &Message) -> Encoding {
    match message.packed {
        Payload::Json | Payload::Schema => Encoding::APPLICATION_JSON,
        Payload::PackedF32 => Encoding::APPLICATION_OCTET_STREAM,
        Payload::Jpeg => Encoding::IMAGE_JPEG,
    }
}

#[cfg(test)]
mod tests {
    use super::super::{LiveCounts, message};
    use super::*;
    use zenoh::Config;

    #[test]
    fn a_command_is_named_in_a_run_that_may_be_any() {
        let own = OwnedKeyExpr::new("rheotaxis/run_1").unwrap();
        let of = |asked: &str| {
            let (command, key) = super::command(&own, keyexpr::new(asked).unwrap())?;
            assert_eq!(key.as_str(), format!("rheotaxis/run_1/rpc/{command}"));
            Some(command)
        };
        for asked in ["rheotaxis/run_1", "rheotaxis/*", "rheotaxis/**", "**"] {
            assert_eq!(of(&format!("{asked}/rpc/step")).as_deref(), Some("step"));
        }
        for asked in ["rheotaxis/run_2/rpc/step", "rheotaxis/run_1/**", "rheotaxis/run_1/*/step", "**"] {
            assert_eq!(of(asked), None, "{asked}");
        }
    }

    #[test]
    fn what_reaches_a_subscriber_is_already_kept() {
        let alone = r#"{ mode: "peer", listen: { endpoints: [] }, scouting: { multicast: { enabled: false } } }"#;
        let session = zenoh::open(Config::from_json5(alone).unwrap()).wait();
        let session = session.unwrap();
        let options = LiveOptions::new("order_1".to_owned());
        let mut tree = Tree::grow(&session, &options, Vec::new()).unwrap();
        let kept = Arc::clone(&tree.kept);
        let (told, heard) = std::sync::mpsc::channel();
        // A subscriber of the session that sends hears before the call that sends returns.
        let _subscriber = session
            .declare_subscriber("rheotaxis/order_1/**")
            .callback(move |sample| {
                let key = sample.key_expr().as_str()["rheotaxis/order_1/".len()..].to_owned();
                let there = kept.lock().unwrap().contains_key(&key);
                told.send((key, there)).unwrap();
            })
            .wait()
            .unwrap();
        let clock = message::clock(0.1, 1, false, LiveCounts::default());
        tree.say(clock).unwrap();
        tree.say_for_good(message::digest("d1")).unwrap();
        let heard: Vec<(String, bool)> = heard.try_iter().collect();
        let both = ["clock", "meta/digest"].map(|key| (key.to_owned(), true));
        assert_eq!(heard, both);
    }
}
