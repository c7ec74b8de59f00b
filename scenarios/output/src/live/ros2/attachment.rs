//! What a node of ROS wants to know beside a message: its number, when it was sent, and by which publisher.
//!
//! *Source*: `attachment_helpers.cpp` of rmw_zenoh, from 0.2.4 (Jazzy) and 0.6.0 (Kilted). A message without it is
//! dropped by nodes.
//! *Parameters*: none.
//! *Deviations*: none.

/// The 33 bytes: number and time as little-endian integers of 64 bits, length of the id, the id.
pub(super) fn attachment(number: i64, sent_ns: i64, gid: &[u8; 16]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(33);
    bytes.extend(number.to_le_bytes());
    bytes.extend(sent_ns.to_le_bytes());
    bytes.push(gid.len() as u8);
    bytes.extend(gid);
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_attachment_has_33_bytes_in_their_order() {
        let gid: [u8; 16] = std::array::from_fn(|i| 0xa0 + i as u8);
        let hex: String = (attachment(2, 0x0102_0304_0506_0708, &gid).iter()).map(|b| format!("{b:02x}")).collect();
        assert_eq!(hex, "0200000000000000080706050403020110a0a1a2a3a4a5a6a7a8a9aaabacadaeaf");
    }
}
