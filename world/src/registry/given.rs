//! What a format gives: asked for in code that is compiled once, taken by the visitor of a type.

use super::source_error::SourceError;
use serde::de::{
    DeserializeSeed, Deserializer, EnumAccess, Error as _, MapAccess, SeqAccess, Unexpected, VariantAccess, Visitor,
};
use std::fmt;

pub(super) type Format<'f, 'de> = dyn erased_serde::Deserializer<'de> + 'f;
pub(super) type Result<T> = std::result::Result<T, SourceError>;

/// What a format gives, to be taken by the visitor of a type.
pub(super) enum InputValue<'g, 'de> {
    Nothing,
    /// The text of a value as it stands in the file: `ron::value::RawValue` asks for it.
    Text(&'g str),
    Inner(&'g mut Format<'g, 'de>),
    Map(&'g mut dyn Pairs<'de>),
    Seq(&'g mut dyn Elements<'de>),
    Choice(&'g mut dyn Variants<'de>),
}

impl InputValue<'_, '_> {
    /// It is not what the type asked for.
    pub(super) fn unfit(&self, expected: &dyn serde::de::Expected) -> SourceError {
        SourceError::invalid_type(
            match self {
                Self::Nothing => Unexpected::Unit,
                Self::Text(text) => Unexpected::Str(text),
                Self::Inner(_) => Unexpected::NewtypeStruct,
                Self::Map(_) => Unexpected::Map,
                Self::Seq(_) => Unexpected::Seq,
                Self::Choice(_) => Unexpected::Enum,
            },
            expected,
        )
    }
}

pub(super) type Take<'t, 'de> = &'t mut dyn FnMut(InputValue<'_, 'de>) -> Result<()>;

/// A map, one step after the other.
pub(super) trait Pairs<'de> {
    /// Passes the next key on, if there is one.
    fn key(&mut self, take: Take<'_, 'de>) -> Result<bool>;
    /// Passes the value of that key on.
    fn value(&mut self, take: Take<'_, 'de>) -> Result<()>;
}

/// A sequence.
pub(super) trait Elements<'de> {
    /// Passes the next element on, if there is one.
    fn element(&mut self, take: Take<'_, 'de>) -> Result<bool>;
}

/// A choice: first its name, then what it holds.
pub(super) trait Variants<'de> {
    fn name(&mut self, take: Take<'_, 'de>) -> Result<()>;
    fn unit(&mut self) -> Result<()>;
    fn newtype(&mut self, take: Take<'_, 'de>) -> Result<()>;
    fn tuple(&mut self, len: usize, take: Take<'_, 'de>) -> Result<()>;
    fn fields(&mut self, fields: &'static [&'static str], take: Take<'_, 'de>) -> Result<()>;
}

/// Passes on what a format gives: as a seed the value itself, as a visitor what is in it.
struct Pass<'t, 'de>(Take<'t, 'de>);

impl<'de> DeserializeSeed<'de> for Pass<'_, 'de> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> std::result::Result<(), D::Error> {
        let mut from = <dyn erased_serde::Deserializer>::erase(from);
        (self.0)(InputValue::Inner(&mut from)).map_err(SourceError::into_other)
    }
}

impl<'de> Visitor<'de> for Pass<'_, 'de> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("another kind of value")
    }

    fn visit_none<E: serde::de::Error>(self) -> std::result::Result<(), E> {
        (self.0)(InputValue::Nothing).map_err(SourceError::into_other)
    }

    fn visit_unit<E: serde::de::Error>(self) -> std::result::Result<(), E> {
        self.visit_none()
    }

    fn visit_str<E: serde::de::Error>(self, text: &str) -> std::result::Result<(), E> {
        (self.0)(InputValue::Text(text)).map_err(SourceError::into_other)
    }

    fn visit_some<D: Deserializer<'de>>(self, from: D) -> std::result::Result<(), D::Error> {
        self.deserialize(from)
    }

    fn visit_newtype_struct<D: Deserializer<'de>>(self, from: D) -> std::result::Result<(), D::Error> {
        self.deserialize(from)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> std::result::Result<(), A::Error> {
        (self.0)(InputValue::Map(&mut map)).map_err(SourceError::into_other)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> std::result::Result<(), A::Error> {
        (self.0)(InputValue::Seq(&mut seq)).map_err(SourceError::into_other)
    }

    fn visit_enum<A: EnumAccess<'de>>(self, choice: A) -> std::result::Result<(), A::Error> {
        let mut choice = OneOf { choice: Some(choice), variant: None };
        (self.0)(InputValue::Choice(&mut choice)).map_err(SourceError::into_other)
    }
}

impl<'de, A: MapAccess<'de>> Pairs<'de> for A {
    fn key(&mut self, take: Take<'_, 'de>) -> Result<bool> {
        let next = self.next_key_seed(Pass(take)).map_err(SourceError::custom)?;
        Ok(next.is_some())
    }

    fn value(&mut self, take: Take<'_, 'de>) -> Result<()> {
        self.next_value_seed(Pass(take)).map_err(SourceError::custom)
    }
}

impl<'de, A: SeqAccess<'de>> Elements<'de> for A {
    fn element(&mut self, take: Take<'_, 'de>) -> Result<bool> {
        let next = self.next_element_seed(Pass(take)).map_err(SourceError::custom)?;
        Ok(next.is_some())
    }
}

/// A choice of a format before and after its name is read.
struct OneOf<A, V> {
    choice: Option<A>,
    variant: Option<V>,
}

impl<A, V> OneOf<A, V> {
    fn held(&mut self) -> V {
        self.variant.take().expect("its name was read, and what it holds is read once")
    }
}

impl<'de, A: EnumAccess<'de, Variant = V>, V: VariantAccess<'de>> Variants<'de> for OneOf<A, V> {
    fn name(&mut self, take: Take<'_, 'de>) -> Result<()> {
        let choice = self.choice.take().expect("its name is read once");
        let ((), variant) = choice.variant_seed(Pass(take)).map_err(SourceError::custom)?;
        self.variant = Some(variant);
        Ok(())
    }

    fn unit(&mut self) -> Result<()> {
        self.held().unit_variant().map_err(SourceError::custom)
    }

    fn newtype(&mut self, take: Take<'_, 'de>) -> Result<()> {
        self.held().newtype_variant_seed(Pass(take)).map_err(SourceError::custom)
    }

    fn tuple(&mut self, len: usize, take: Take<'_, 'de>) -> Result<()> {
        self.held().tuple_variant(len, Pass(take)).map_err(SourceError::custom)
    }

    fn fields(&mut self, fields: &'static [&'static str], take: Take<'_, 'de>) -> Result<()> {
        self.held().struct_variant(fields, Pass(take)).map_err(SourceError::custom)
    }
}

// What asks a format, compiled once.

pub(super) fn word(from: &mut Format<'_, '_>) -> Result<String> {
    struct Word;
    impl Visitor<'_> for Word {
        type Value = String;

        fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
            f.write_str("a name")
        }

        fn visit_str<E: serde::de::Error>(self, name: &str) -> std::result::Result<String, E> {
            Ok(name.to_string())
        }
    }
    from.deserialize_identifier(Word).map_err(SourceError::custom)
}

pub(super) fn unit(from: &mut Format<'_, '_>, name: &'static str) -> Result<()> {
    let nothing = &mut |_: InputValue<'_, '_>| Ok(());
    from.deserialize_unit_struct(name, Pass(nothing)).map_err(SourceError::custom)
}

/// What a type asks a format for.
pub(super) enum Request {
    Option,
    Newtype(&'static str),
    Seq,
    Tuple(usize),
    TupleStruct(&'static str, usize),
    Map,
    Struct(&'static str, &'static [&'static str]),
    Enum(&'static str, &'static [&'static str]),
}

pub(super) fn request<'de>(from: &mut Format<'_, 'de>, what: Request, take: Take<'_, 'de>) -> Result<()> {
    let pass = Pass(take);
    let given = match what {
        Request::Option => from.deserialize_option(pass),
        Request::Newtype(name) => from.deserialize_newtype_struct(name, pass),
        Request::Seq => from.deserialize_seq(pass),
        Request::Tuple(len) => from.deserialize_tuple(len, pass),
        Request::TupleStruct(name, len) => from.deserialize_tuple_struct(name, len, pass),
        Request::Map => from.deserialize_map(pass),
        Request::Struct(name, legal) => from.deserialize_struct(name, legal, pass),
        Request::Enum(name, legal) => from.deserialize_enum(name, legal, pass),
    };
    given.map_err(SourceError::custom)
}
