//! Reads RON: whole texts, and values from their own text.

use ron::de::Deserializer as Ron;
use ron::error::{Position, SpannedError};
use ron::extensions::Extensions;
use serde::Deserializer;
use serde::de::{DeserializeOwned, DeserializeSeed, EnumAccess, Error as _, VariantAccess, Visitor};
use std::cell::Cell;
use std::fmt;
use std::ops::Range;

/// Why a text cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReadError {
    /// Its place, in bytes.
    pub at: Range<usize>,
    /// What is wrong.
    pub message: String,
}

thread_local! {
    /// The first failure in a value that is read from its own text; its place is one in memory. The format knows only
    /// the place of the whole value.
    static INNERMOST: Cell<Option<ReadError>> = const { Cell::new(None) };
}

/// Reads a whole text.
pub(super) fn whole<T: DeserializeOwned>(text: &str) -> Result<T, ReadError> {
    INNERMOST.take();
    options().from_str(text).map_err(|error| {
        let whole = text.as_ptr() as usize;
        let inner = INNERMOST.take().filter(|e| whole <= e.at.start && e.at.end <= whole + text.len());
        let inner = inner.map(|e| ReadError { at: e.at.start - whole..e.at.end - whole, ..e });
        inner.unwrap_or_else(|| placed(text, &error))
    })
}

fn options() -> ron::Options {
    ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME | Extensions::UNWRAP_VARIANT_NEWTYPES)
}

fn placed(text: &str, error: &SpannedError) -> ReadError {
    let at = offset(text, error.span.start)..offset(text, error.span.end);
    ReadError { at, message: error.code.to_string() }
}

/// Byte offset of a line and column (in characters).
fn offset(text: &str, at: Position) -> usize {
    let start: usize = text.split_inclusive('\n').take(at.line - 1).map(str::len).sum();
    text[start..].char_indices().nth(at.col - 1).map_or(text.len(), |(i, _)| start + i)
}

/// Reads a value from its text, by a function that is compiled for RON alone: a type that is chosen by name is compiled
/// once, in its own crate.
pub(super) fn from_text<'de, D: Deserializer<'de>, T>(
    from: D,
    read: impl FnOnce(&mut Ron<'de>) -> ron::Result<T>,
) -> Result<T, D::Error> {
    let text = from.deserialize_newtype_struct(RAW, AsWritten)?;
    part(text, read).map_err(D::Error::custom)
}

fn part<'de, T>(text: &'de str, read: impl FnOnce(&mut Ron<'de>) -> ron::Result<T>) -> Result<T, String> {
    let mut from = Ron::from_str_with_options(text, &options()).map_err(|e| e.code.to_string())?;
    read(&mut from).map_err(|code| {
        let mut found = placed(text, &from.span_error(code));
        let start = text.as_ptr() as usize;
        found.at = start + found.at.start..start + found.at.end;
        let first = INNERMOST.take().unwrap_or(found);
        let message = first.message.clone();
        INNERMOST.set(Some(first));
        message
    })
}

/// The name by which ron is asked for the text of a value. Its own `RawValue` refuses what extensions allow.
const RAW: &str = "$ron::private::RawValue";

/// Takes the text of a value.
struct AsWritten;

impl<'de> Visitor<'de> for AsWritten {
    type Value = &'de str;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a value in RON")
    }

    fn visit_borrowed_str<E: serde::de::Error>(self, text: &'de str) -> Result<&'de str, E> {
        Ok(text)
    }
}

/// The parameters of a thing: a struct in parentheses. ron reads it as the fields of a variant, because what it looks for
/// in structs (ranges such as `1..2`) makes each type four times as long to compile.
pub(super) struct Parameters<'f, 'de>(pub(super) &'f mut Ron<'de>);

impl<'de> Deserializer<'de> for Parameters<'_, 'de> {
    type Error = ron::Error;

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> ron::Result<V::Value> {
        self.0.deserialize_enum("", &[], Fields(visitor))
    }

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> ron::Result<V::Value> {
        Err(ron::Error::custom("the parameters of what is chosen by name must be a struct"))
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map enum identifier ignored_any
    }
}

struct Fields<V>(V);

impl<'de, V: Visitor<'de>> Visitor<'de> for Fields<V> {
    type Value = V::Value;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.0.expecting(f)
    }

    fn visit_enum<A: EnumAccess<'de>>(self, parentheses: A) -> Result<V::Value, A::Error> {
        let ((), fields) = parentheses.variant_seed(Nameless)?;
        fields.struct_variant(&[], self.0)
    }
}

/// In the place of a variant's name: nothing is read.
struct Nameless;

impl<'de> DeserializeSeed<'de> for Nameless {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, _: D) -> Result<(), D::Error> {
        Ok(())
    }
}

/// Reads a word: whether it is `None`.
pub(super) struct IsNone;

impl Visitor<'_> for IsNone {
    type Value = bool;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a name")
    }

    fn visit_str<E: serde::de::Error>(self, name: &str) -> Result<bool, E> {
        Ok(name == "None")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_characters() {
        let text = "ab\né€x";
        assert_eq!(&text[offset(text, Position { line: 2, col: 3 })..], "x");
        assert_eq!(offset(text, Position { line: 2, col: 9 }), text.len());
    }
}
