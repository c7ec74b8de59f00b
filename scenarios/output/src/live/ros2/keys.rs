//! Keys of rmw_zenoh: topics, liveliness tokens, and the id that follows from a token.
//!
//! *Source*: rmw_zenoh, `docs/design.md`, and `liveliness_utils.cpp` of 0.2.4 (Jazzy).
//! *Parameters*: none.
//! *Deviations*: no security enclave.

use super::topics::Qos;
use crate::ros::MessageKind;
use xxhash_rust::xxh3::xxh3_128;

/// A node: whose it is, and its name in the root namespace.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct NodeKey<'a> {
    /// Domain.
    pub(super) domain: u32,
    /// Id of the zenoh session.
    pub(super) session: &'a str,
    /// Number of the node in the session.
    pub(super) number: u32,
    /// Its name.
    pub(super) name: &'a str,
}

/// An end of a topic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    Publisher,
    Subscriber,
}

impl NodeKey<'_> {
    /// The token by which others see the node.
    pub(super) fn token(&self) -> String {
        self.entity(self.number, "NN")
    }

    /// The token by which others see one end of a topic, with its number in the session.
    pub(super) fn end(&self, end: End, number: u32, topic: &str, kind: MessageKind, qos: Qos) -> String {
        let name = match end {
            End::Publisher => "MP",
            End::Subscriber => "MS",
        };
        let (entity, topic) = (self.entity(number, name), topic.replace('/', "%"));
        let (dds, hash) = (kind.dds_name(), kind.hash());
        format!("{entity}/{topic}/{dds}/{hash}/{}", qos.chunk())
    }

    fn entity(&self, number: u32, kind: &str) -> String {
        let Self { domain, session, number: node, name } = self;
        // Enclave and namespace are those of the root.
        format!("@ros2_lv/{domain}/{session}/{node}/{number}/{kind}/%/%/{name}")
    }
}

/// The key of a topic's messages.
pub(super) fn topic(domain: u32, topic: &str, kind: MessageKind) -> String {
    let topic = topic.trim_matches('/');
    format!("{domain}/{topic}/{}/{}", kind.dds_name(), kind.hash())
}

/// The id of a publisher: a hash of its token.
pub(super) fn gid(token: &str) -> [u8; 16] {
    // The low half first, each half little-endian: the order of the bytes of a little-endian number.
    xxh3_128(token.as_bytes()).to_le_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    const NODE: NodeKey<'static> =
        NodeKey { domain: 3, session: "aac3178e146ba6f1fc6e6a4085e77f21", number: 0, name: "rheotaxis" };

    #[test]
    fn tokens_are_those_of_rmw_zenoh() {
        assert_eq!(NODE.token(), "@ros2_lv/3/aac3178e146ba6f1fc6e6a4085e77f21/0/0/NN/%/%/rheotaxis");
        assert_eq!(
            NODE.end(End::Publisher, 7, "/auv0/odom", MessageKind::Odometry, Qos::Reliable),
            "@ros2_lv/3/aac3178e146ba6f1fc6e6a4085e77f21/0/7/MP/%/%/rheotaxis/%auv0%odom/\
             nav_msgs::msg::dds_::Odometry_/\
             RIHS01_3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0/::,10:,:,:,,"
        );
    }

    /// Expected: `rmw_zenoh_gid` of pyzeros 0.1.0, which repeats `liveliness_utils.cpp`.
    #[test]
    fn ids_follow_from_tokens() {
        let hex = |id: [u8; 16]| id.map(|b| format!("{b:02x}")).concat();
        assert_eq!(hex(gid("")), "7f498d4624c30160d8984701d306aa99");
        assert_eq!(hex(gid(&NODE.token())), "df69bdb3a8e8c59cf74cbaf87a526c8c");
        let publisher = NODE.end(End::Publisher, 7, "/auv0/odom", MessageKind::Odometry, Qos::Reliable);
        assert_eq!(hex(gid(&publisher)), "e8c4f6484b75209f1f23d5d7f8acc4bb");
    }
}
