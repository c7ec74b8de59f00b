//! What parameters are read from: one reader for all formats.
//!
//! A type is compiled for this reader alone, and its visitor is asked only for what the type says it wants:
//! `deserialize_struct` ends in `visit_map` and nowhere else. `erased_serde` by itself makes all 27 methods of a visitor
//! for each type and for the names of its fields, a quarter of all code of the robots. What a type asks for reaches the
//! format, and its errors keep their kind.

use super::given::{Elements, Format, InputValue, Pairs, Request, Result, Variants, request, unit, word};
use super::source_error::SourceError;
use serde::Deserialize;
use serde::de::{
    DeserializeSeed, Deserializer, EnumAccess, Error as _, IgnoredAny, MapAccess, SeqAccess, VariantAccess, Visitor,
};

/// Reads a value from any format.
///
/// # Errors
/// The format's, and those of the type.
pub fn read_from<'de, T: Deserialize<'de>, D: Deserializer<'de>>(from: D) -> std::result::Result<T, D::Error> {
    let mut from = <dyn erased_serde::Deserializer>::erase(from);
    T::deserialize(Source(&mut from)).map_err(SourceError::into_other)
}

/// A value in any format.
pub(super) struct Source<'f, 'de>(pub(super) &'f mut Format<'f, 'de>);

/// Where a type takes what it is given: once, as it asks once. As little as possible hangs on the type.
struct Taker<F, T> {
    take: Option<F>,
    value: Option<T>,
}

impl<F, T> Taker<F, T> {
    fn new(take: F) -> Self {
        Self { take: Some(take), value: None }
    }

    fn give<'de>(&mut self, given: InputValue<'_, 'de>) -> Result<()>
    where
        F: FnOnce(InputValue<'_, 'de>) -> Result<T>,
    {
        if let Some(take) = self.take.take() {
            self.value = Some(take(given)?);
        }
        Ok(())
    }

    /// The value, if the format has given one.
    fn value(self) -> Result<T> {
        self.value.ok_or_else(SourceError::nothing_given)
    }
}

/// What `take` makes of what the format gives.
fn value_of<'de, T>(
    from: &mut Format<'_, 'de>,
    what: Request,
    take: impl FnOnce(InputValue<'_, 'de>) -> Result<T>,
) -> Result<T> {
    let mut taker = Taker::new(take);
    request(from, what, &mut |given| taker.give(given))?;
    taker.value()
}

/// A seed on the value within.
fn seeded<'de, S: DeserializeSeed<'de>>(seed: S, given: InputValue<'_, 'de>) -> Result<S::Value> {
    match given {
        InputValue::Inner(from) => seed.deserialize(Source(from)),
        other => Err(other.unfit(&"a value")),
    }
}

fn in_sequence<'de, V: Visitor<'de>>(visitor: V, given: InputValue<'_, 'de>) -> Result<V::Value> {
    match given {
        InputValue::Seq(seq) => visitor.visit_seq(Access(seq)),
        other => Err(other.unfit(&visitor)),
    }
}

fn in_map<'de, V: Visitor<'de>>(visitor: V, given: InputValue<'_, 'de>) -> Result<V::Value> {
    match given {
        InputValue::Map(map) => visitor.visit_map(Access(map)),
        other => Err(other.unfit(&visitor)),
    }
}

macro_rules! plain {
    ($($method:ident $visit:ident $of:ty;)*) => {$(
        fn $method<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
            visitor.$visit(<$of>::deserialize(self.0).map_err(SourceError::custom)?)
        }
    )*};
}

macro_rules! as_the_format_does {
    ($($method:ident)*) => {$(
        fn $method<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
            self.0.$method(visitor).map_err(SourceError::custom)
        }
    )*};
}

impl<'de> Deserializer<'de> for Source<'_, 'de> {
    type Error = SourceError;

    plain! {
        deserialize_bool visit_bool bool;
        deserialize_i8 visit_i8 i8;
        deserialize_i16 visit_i16 i16;
        deserialize_i32 visit_i32 i32;
        deserialize_i64 visit_i64 i64;
        deserialize_u8 visit_u8 u8;
        deserialize_u16 visit_u16 u16;
        deserialize_u32 visit_u32 u32;
        deserialize_u64 visit_u64 u64;
        deserialize_f32 visit_f32 f32;
        deserialize_f64 visit_f64 f64;
        deserialize_char visit_char char;
        deserialize_str visit_string String;
        deserialize_string visit_string String;
    }

    as_the_format_does! { deserialize_any deserialize_i128 deserialize_u128 deserialize_bytes deserialize_byte_buf }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        value_of(self.0, Request::Option, |given| match given {
            InputValue::Nothing => visitor.visit_none(),
            InputValue::Inner(from) => visitor.visit_some(Source(from)),
            other => Err(other.unfit(&visitor)),
        })
    }

    fn deserialize_unit<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        <()>::deserialize(self.0).map_err(SourceError::custom)?;
        visitor.visit_unit()
    }

    fn deserialize_unit_struct<V: Visitor<'de>>(self, name: &'static str, visitor: V) -> Result<V::Value> {
        unit(self.0, name)?;
        visitor.visit_unit()
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(self, name: &'static str, visitor: V) -> Result<V::Value> {
        value_of(self.0, Request::Newtype(name), |given| match given {
            InputValue::Text(text) => visitor.visit_str(text),
            InputValue::Inner(from) => visitor.visit_newtype_struct(Source(from)),
            other => Err(other.unfit(&visitor)),
        })
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        value_of(self.0, Request::Seq, |given| in_sequence(visitor, given))
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, len: usize, visitor: V) -> Result<V::Value> {
        value_of(self.0, Request::Tuple(len), |given| in_sequence(visitor, given))
    }

    fn deserialize_tuple_struct<V: Visitor<'de>>(self, name: &'static str, len: usize, visitor: V) -> Result<V::Value> {
        value_of(self.0, Request::TupleStruct(name, len), |given| in_sequence(visitor, given))
    }

    fn deserialize_map<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        value_of(self.0, Request::Map, |given| in_map(visitor, given))
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        legal: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value> {
        value_of(self.0, Request::Struct(name, legal), |given| in_map(visitor, given))
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        name: &'static str,
        legal: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value> {
        value_of(self.0, Request::Enum(name, legal), |given| match given {
            InputValue::Choice(of) => visitor.visit_enum(Access(of)),
            other => Err(other.unfit(&visitor)),
        })
    }

    fn deserialize_identifier<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        visitor.visit_string(word(self.0)?)
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value> {
        IgnoredAny::deserialize(self.0).map_err(SourceError::custom)?;
        visitor.visit_unit()
    }
}

/// serde's access to what a format gives.
struct Access<A>(A);

impl<'de> MapAccess<'de> for Access<&mut dyn Pairs<'de>> {
    type Error = SourceError;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>> {
        let mut taker = Taker::new(|given: InputValue<'_, 'de>| seeded(seed, given));
        self.0.key(&mut |given| taker.give(given))?;
        Ok(taker.value)
    }

    fn next_value_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<S::Value> {
        let mut taker = Taker::new(|given: InputValue<'_, 'de>| seeded(seed, given));
        self.0.value(&mut |given| taker.give(given))?;
        taker.value()
    }
}

impl<'de> SeqAccess<'de> for Access<&mut dyn Elements<'de>> {
    type Error = SourceError;

    fn next_element_seed<S: DeserializeSeed<'de>>(&mut self, seed: S) -> Result<Option<S::Value>> {
        let mut taker = Taker::new(|given: InputValue<'_, 'de>| seeded(seed, given));
        self.0.element(&mut |given| taker.give(given))?;
        Ok(taker.value)
    }
}

impl<'de> EnumAccess<'de> for Access<&mut dyn Variants<'de>> {
    type Error = SourceError;
    type Variant = Self;

    fn variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<(S::Value, Self)> {
        let mut taker = Taker::new(|given: InputValue<'_, 'de>| seeded(seed, given));
        self.0.name(&mut |given| taker.give(given))?;
        Ok((taker.value()?, self))
    }
}

impl<'de> VariantAccess<'de> for Access<&mut dyn Variants<'de>> {
    type Error = SourceError;

    fn unit_variant(self) -> Result<()> {
        self.0.unit()
    }

    fn newtype_variant_seed<S: DeserializeSeed<'de>>(self, seed: S) -> Result<S::Value> {
        let mut taker = Taker::new(|given: InputValue<'_, 'de>| seeded(seed, given));
        self.0.newtype(&mut |given| taker.give(given))?;
        taker.value()
    }

    fn tuple_variant<V: Visitor<'de>>(self, len: usize, visitor: V) -> Result<V::Value> {
        let mut taker = Taker::new(|given: InputValue<'_, 'de>| in_sequence(visitor, given));
        self.0.tuple(len, &mut |given| taker.give(given))?;
        taker.value()
    }

    fn struct_variant<V: Visitor<'de>>(self, legal: &'static [&'static str], visitor: V) -> Result<V::Value> {
        let mut taker = Taker::new(|given: InputValue<'_, 'de>| in_map(visitor, given));
        self.0.fields(legal, &mut |given| taker.give(given))?;
        taker.value()
    }
}
