//! Numbers as bytes and back, bit for bit: for a state that a program writes and later reads again.
//!
//! Words are little-endian on every machine; a list begins with its length. A reader compares a length with the bytes
//! that are left before it takes memory for it, so damaged bytes give an error and nothing else.

/// The bytes are not what was written: they end too early, go on too long, or hold what cannot be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the state cannot be read: {0}")]
pub struct Unreadable(pub &'static str);

/// A number of fixed width.
pub trait Word: Copy {
    /// Its bytes.
    const BYTES: usize;
    /// Appends its bytes.
    fn append(self, to: &mut Vec<u8>);
    /// The number of these bytes, of which there are [`Self::BYTES`].
    fn get(bytes: &[u8]) -> Self;
}

macro_rules! words {
    ($($word:ty)*) => {$(
        impl Word for $word {
            const BYTES: usize = size_of::<$word>();
            fn append(self, to: &mut Vec<u8>) {
                to.extend_from_slice(&self.to_le_bytes());
            }
            fn get(bytes: &[u8]) -> Self {
                Self::from_le_bytes(bytes.try_into().expect("as many bytes as the word has"))
            }
        }
    )*};
}

words!(u8 u32 u64 u128 f32 f64);

/// Collects numbers as bytes.
#[derive(Clone, Debug, Default)]
pub struct Writer(Vec<u8>);

impl Writer {
    /// Appends a number.
    pub fn word(&mut self, value: impl Word) {
        value.append(&mut self.0);
    }

    /// Appends a number that may be missing.
    pub fn maybe(&mut self, value: Option<impl Word>) {
        self.word(u8::from(value.is_some()));
        if let Some(value) = value {
            self.word(value);
        }
    }

    /// Appends a list and its length.
    pub fn write_list<W: Word>(&mut self, values: &[W]) {
        self.word(values.len() as u64);
        self.0.reserve(values.len() * W::BYTES);
        for value in values {
            value.append(&mut self.0);
        }
    }

    /// All bytes so far.
    pub fn into_bytes(self) -> Vec<u8> {
        self.0
    }
}

/// Reads numbers in the order in which they were written.
#[derive(Clone, Debug)]
pub struct Reader<'a>(&'a [u8]);

impl<'a> Reader<'a> {
    /// Begins at the first byte.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self(bytes)
    }

    fn take(&mut self, n: usize) -> Result<&'a [u8], Unreadable> {
        let (taken, rest) = (self.0.split_at_checked(n)).ok_or(Unreadable("it ends too early"))?;
        self.0 = rest;
        Ok(taken)
    }

    /// The next number.
    ///
    /// # Errors
    /// If the bytes end.
    pub fn word<W: Word>(&mut self) -> Result<W, Unreadable> {
        self.take(W::BYTES).map(W::get)
    }

    /// The next number that may be missing.
    ///
    /// # Errors
    /// If the bytes end, or say neither that it is there nor that it is not.
    pub fn maybe<W: Word>(&mut self) -> Result<Option<W>, Unreadable> {
        match self.word::<u8>()? {
            0 => Ok(None),
            1 => self.word().map(Some),
            _ => Err(Unreadable("a number neither is there nor is missing")),
        }
    }

    /// The next list.
    ///
    /// # Errors
    /// If the bytes end before the list does.
    pub fn read_list<W: Word>(&mut self) -> Result<Vec<W>, Unreadable> {
        let n = usize::try_from(self.word::<u64>()?).ok();
        let bytes = n.and_then(|n| n.checked_mul(W::BYTES));
        let bytes = self.take(bytes.ok_or(Unreadable("a list is longer than any memory"))?)?;
        Ok(bytes.chunks_exact(W::BYTES).map(W::get).collect())
    }

    /// The next list, which must have this length.
    ///
    /// # Errors
    /// As [`Self::read_list`]; also if it has another length.
    pub fn exactly<W: Word>(&mut self, n: usize) -> Result<Vec<W>, Unreadable> {
        let list = self.read_list()?;
        if list.len() == n { Ok(list) } else { Err(Unreadable("a list has another length than it must have")) }
    }

    /// The end of the bytes.
    ///
    /// # Errors
    /// If some are left.
    pub fn end(self) -> Result<(), Unreadable> {
        if self.0.is_empty() { Ok(()) } else { Err(Unreadable("it goes on after its end")) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written() -> Vec<u8> {
        let mut to = Writer::default();
        to.word(7_u32);
        to.maybe(Some(-0.0_f64));
        to.maybe(None::<u128>);
        to.write_list(&[f32::NAN, f32::MIN_POSITIVE, f32::from_bits(1)]);
        to.write_list(&[] as &[u64]);
        to.into_bytes()
    }

    type All = (u32, Option<u64>, Option<u128>, Vec<u32>, Vec<u64>);

    fn read(bytes: &[u8]) -> Result<All, Unreadable> {
        let mut from = Reader::new(bytes);
        let all = (
            from.word()?,
            from.maybe::<f64>()?.map(f64::to_bits),
            from.maybe()?,
            from.read_list::<f32>()?.into_iter().map(f32::to_bits).collect(),
            from.read_list()?,
        );
        from.end()?;
        Ok(all)
    }

    #[test]
    fn every_bit_comes_back() {
        let floats = vec![f32::NAN.to_bits(), f32::MIN_POSITIVE.to_bits(), 1];
        let all = (7, Some((-0.0_f64).to_bits()), None, floats, vec![]);
        assert_eq!(read(&written()), Ok(all));
    }

    #[test]
    fn fewer_bytes_or_more_are_an_error() {
        let whole = written();
        for n in 0..whole.len() {
            assert!(read(&whole[..n]).is_err(), "{n}");
        }
        assert!(read(&[whole.as_slice(), &[0]].concat()).is_err());
    }

    #[test]
    fn a_length_that_cannot_be_takes_no_memory() {
        for n in [u64::MAX, u64::MAX / 4, 1 << 40, 3] {
            let mut to = Writer::default();
            to.word(n);
            to.word(1.0_f64);
            let bytes = to.into_bytes();
            assert!(Reader::new(&bytes).read_list::<f64>().is_err(), "{n}");
        }
        let mut to = Writer::default();
        to.write_list(&[1.0_f32, 2.0]);
        let bytes = to.into_bytes();
        assert!(Reader::new(&bytes).exactly::<f32>(3).is_err());
        assert_eq!(Reader::new(&bytes).exactly(2), Ok(vec![1.0_f32, 2.0]));
    }
}
