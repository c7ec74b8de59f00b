//! CDR encoding, little-endian, as ROS 2 serialises its messages.
//!
//! *Source*: OMG DDSI-RTPS 2.5, section 10 (encapsulation header `00 01 00 00`: plain CDR,
//! little-endian); OMG CORBA 3.0, section 15.3 (alignment: each number at a multiple of its own
//! size, counted from the end of that header).
//! *Parameters*: none.
//! *Deviations*: only what our messages need; no wide strings, no unions, no XCDR2.

/// One message being written.
#[derive(Clone, Debug)]
pub struct Cdr {
    bytes: Vec<u8>,
}

/// Bytes before the body; alignment is counted from their end.
const HEADER: [u8; 4] = [0, 1, 0, 0];

impl Default for Cdr {
    fn default() -> Self {
        Self::new()
    }
}

impl Cdr {
    /// An empty message: the encapsulation header alone.
    #[must_use]
    pub fn new() -> Self {
        Self {
            bytes: HEADER.to_vec(),
        }
    }

    fn align(&mut self, to: usize) {
        while !(self.bytes.len() - HEADER.len()).is_multiple_of(to) {
            self.bytes.push(0);
        }
    }

    /// A byte.
    pub fn u8(&mut self, v: u8) -> &mut Self {
        self.bytes.push(v);
        self
    }

    /// A truth value, one byte.
    pub fn bool(&mut self, v: bool) -> &mut Self {
        self.u8(u8::from(v))
    }

    /// A signed 32-bit number.
    pub fn i32(&mut self, v: i32) -> &mut Self {
        self.align(4);
        self.bytes.extend(v.to_le_bytes());
        self
    }

    /// An unsigned 32-bit number.
    pub fn u32(&mut self, v: u32) -> &mut Self {
        self.align(4);
        self.bytes.extend(v.to_le_bytes());
        self
    }

    /// A double.
    pub fn f64(&mut self, v: f64) -> &mut Self {
        self.align(8);
        self.bytes.extend(v.to_le_bytes());
        self
    }

    /// Doubles of a fixed-length array, or of several small messages in a row.
    pub fn f64s(&mut self, values: &[f64]) -> &mut Self {
        for v in values {
            self.f64(*v);
        }
        self
    }

    /// Length of a sequence; its elements follow.
    pub fn len(&mut self, n: usize) -> &mut Self {
        self.u32(u32::try_from(n).expect("a message holds fewer than 2^32 elements"))
    }

    /// A string: its length including the final zero, its bytes, the zero.
    pub fn text(&mut self, s: &str) -> &mut Self {
        self.len(s.len() + 1);
        self.bytes.extend(s.as_bytes());
        self.bytes.push(0);
        self
    }

    /// A sequence of bytes.
    pub fn blob(&mut self, b: &[u8]) -> &mut Self {
        self.len(b.len());
        self.bytes.extend(b);
        self
    }

    /// A `builtin_interfaces/Time`: whole seconds and nanoseconds.
    pub fn time(&mut self, t_ns: u64) -> &mut Self {
        const NS: u64 = 1_000_000_000;
        let sec = i32::try_from(t_ns / NS).expect("simulated time stays below 68 years");
        self.i32(sec).u32((t_ns % NS) as u32)
    }

    /// A `std_msgs/Header`.
    pub fn header(&mut self, t_ns: u64, frame: &str) -> &mut Self {
        self.time(t_ns).text(frame)
    }

    /// The whole message.
    #[must_use]
    pub fn finish(self) -> Vec<u8> {
        self.bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_align_to_their_size_counted_after_the_header() {
        let mut c = Cdr::new();
        c.u8(7).u32(1).f64(1.0).u8(9);
        // 1 byte, 3 of padding, u32; the f64 then stands at 8 already.
        let body = [7, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xf0, 0x3f, 9];
        let bytes = c.finish();
        assert_eq!(bytes[..4], HEADER);
        assert_eq!(bytes[4..], body);
    }

    #[test]
    fn strings_count_their_zero_and_do_not_pad_after() {
        let mut c = Cdr::new();
        c.text("ab").u8(5).text("");
        let body = [3, 0, 0, 0, b'a', b'b', 0, 5, 1, 0, 0, 0, 0];
        assert_eq!(c.finish()[4..], body);
    }

    #[test]
    fn header_is_seconds_nanoseconds_and_frame() {
        let mut c = Cdr::new();
        c.header(2_500_000_001, "odom");
        let body = [
            2, 0, 0, 0, 0x01, 0x65, 0xcd, 0x1d, 5, 0, 0, 0, b'o', b'd', b'o', b'm', 0,
        ];
        assert_eq!(c.finish()[4..], body);
    }

    #[test]
    fn doubles_after_text_skip_to_a_multiple_of_eight() {
        let mut c = Cdr::new();
        c.text("abc").f64(-2.0);
        let body = [4, 0, 0, 0, b'a', b'b', b'c', 0, 0, 0, 0, 0, 0, 0, 0, 0xc0];
        assert_eq!(c.finish()[4..], body);
    }
}
