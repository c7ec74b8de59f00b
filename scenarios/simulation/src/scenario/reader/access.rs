//! serde's access to the fields, elements and choices of a value.

use super::fail::{Fail, What};
use super::tree::{Item, Kind};
use super::value::Value;
use serde::de::{DeserializeSeed, Deserializer, EnumAccess, MapAccess, SeqAccess, VariantAccess, Visitor};

/// The name of a field or choice. A failure about it is one about the value that it belongs to.
struct Name<'n, 'a, 'b> {
    of: Value<'a, 'b>,
    name: &'n str,
}

impl Deserializer<'static> for Name<'_, '_, '_> {
    type Error = Fail;

    fn deserialize_any<V: Visitor<'static>>(self, visitor: V) -> Result<V::Value, Fail> {
        let read = visitor.visit_str(self.name);
        read.map_err(|e: Fail| self.of.about(e))
    }

    serde::forward_to_deserialize_any! {
        <W: Visitor<'static>>
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map struct enum identifier ignored_any
    }
}

/// Fields, by their names.
pub(super) struct Fields<'a, 'b> {
    pub of: Value<'a, 'b>,
    pub items: std::vec::IntoIter<Item>,
    pub value: Option<Item>,
}

impl MapAccess<'static> for Fields<'_, '_> {
    type Error = Fail;

    fn next_key_seed<K: DeserializeSeed<'static>>(&mut self, seed: K) -> Result<Option<K::Value>, Fail> {
        self.value = self.items.next();
        let Some(item) = &self.value else {
            return Ok(None);
        };
        let name = item.key.as_deref().unwrap_or_default();
        let key = seed.deserialize(Name { of: self.of, name });
        key.map(Some).map_err(|e| self.of.about(e))
    }

    fn next_value_seed<V: DeserializeSeed<'static>>(&mut self, seed: V) -> Result<V::Value, Fail> {
        let id = self.value.as_ref().expect("its name was asked for before").node;
        seed.deserialize(self.of.kid(id)).map_err(|e| self.of.reading.about(id, e))
    }
}

/// Elements, in their order.
pub(super) struct Elements<'a, 'b> {
    pub of: Value<'a, 'b>,
    pub elements: std::vec::IntoIter<usize>,
}

impl SeqAccess<'static> for Elements<'_, '_> {
    type Error = Fail;

    fn next_element_seed<T: DeserializeSeed<'static>>(&mut self, seed: T) -> Result<Option<T::Value>, Fail> {
        let next = self.elements.next();
        next.map(|id| seed.deserialize(self.of.kid(id)).map_err(|e| self.of.reading.about(id, e))).transpose()
    }
}

/// A choice: its name and the value in its parentheses.
pub(super) struct Choice<'a, 'b> {
    pub of: Value<'a, 'b>,
    pub name: String,
}

impl<'b, 'a> EnumAccess<'static> for Choice<'a, 'b> {
    type Error = Fail;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'static>>(self, seed: V) -> Result<(V::Value, Self), Fail> {
        let variant = seed.deserialize(Name { of: self.of, name: &self.name });
        Ok((variant.map_err(|e| self.of.about(e))?, self))
    }
}

impl<'a, 'b> Choice<'a, 'b> {
    /// The value in its parentheses.
    fn content(&self) -> Result<Value<'a, 'b>, Fail> {
        match self.of.node().kind {
            Kind::Hole(_) => Ok(self.of.hole_kid(&self.name)),
            Kind::Group(group) if group.bracket == '(' => Ok(Value { unwrapped: true, ..self.of }),
            _ => self.of.fail(What::Parentheses(self.name.clone())),
        }
    }
}

impl VariantAccess<'static> for Choice<'_, '_> {
    type Error = Fail;

    fn unit_variant(self) -> Result<(), Fail> {
        match self.of.node().kind {
            Kind::Group(_) => self.of.fail(What::Bare(self.name)),
            _ => Ok(()),
        }
    }

    fn newtype_variant_seed<T: DeserializeSeed<'static>>(self, seed: T) -> Result<T::Value, Fail> {
        let content = self.content()?;
        let at = content.only().unwrap_or(content).id;
        seed.deserialize(content).map_err(|e| content.reading.about(at, e))
    }

    fn tuple_variant<V: Visitor<'static>>(self, len: usize, visitor: V) -> Result<V::Value, Fail> {
        self.content()?.tuple(len, visitor)
    }

    fn struct_variant<V: Visitor<'static>>(self, legal: &'static [&'static str], visitor: V) -> Result<V::Value, Fail> {
        self.content()?.fields("", legal, visitor)
    }
}
