//! serde's data format on the values of a tree.

use super::access::Choice;
use super::fail::{Fail, Misfit, What};
use super::scalar;
use super::tree::{Kind, WantedKind, is_name};
use super::value::Value;
use serde::de::value::StrDeserializer;
use serde::de::{Deserializer, IntoDeserializer, Visitor};

/// The name by which `ron::value::RawValue` asks for the text of a value.
const RAW: &str = "$ron::private::RawValue";

macro_rules! whole_numbers {
    ($($method:ident, $visit:ident, $of:ty;)*) => {$(
        fn $method<V: Visitor<'static>>(self, visitor: V) -> Result<V::Value, Fail> {
            let value = self.inner()?;
            let v = value.whole(<$of>::MIN.into(), <$of>::MAX.into())?;
            visitor.$visit(<$of>::try_from(v).expect("within its bounds")).map_err(|e: Fail| value.about(e))
        }
    )*};
}

impl Deserializer<'static> for Value<'_, '_> {
    type Error = Fail;

    fn deserialize_any<V: Visitor<'static>>(self, visitor: V) -> Result<V::Value, Fail> {
        let value = self.inner()?;
        match (value.word(), value.group()) {
            (Some("true"), _) => visitor.visit_bool(true),
            (Some("false"), _) => visitor.visit_bool(false),
            (Some(word), _) if word.starts_with(['"', 'r']) => value.deserialize_string(visitor),
            (Some(word), _) => match scalar::number(word) {
                Some(v) => visitor.visit_f64(v),
                None => visitor.visit_string(word.to_string()),
            },
            (None, Some(group)) if group.items.iter().any(|i| i.key.is_some()) => {
                value.visit_fields(&group, &[], visitor)
            }
            (None, Some(group)) => value.visit_elements(group.items.iter().map(|i| i.node).collect(), visitor),
            (None, None) => visitor.visit_unit(),
        }
        .map_err(|e: Fail| value.about(e))
    }

    fn deserialize_bool<V: Visitor<'static>>(self, visitor: V) -> Result<V::Value, Fail> {
        let value = self.inner()?;
        if value.asks(WantedKind::Plain("true or false")) {
            return visitor.visit_bool(self.reading.filling == 1);
        }
        match value.word() {
            Some("true") => visitor.visit_bool(true),
            Some("false") => visitor.visit_bool(false),
            _ => value.wanted(WantedKind::Plain("true or false")),
        }
    }

    whole_numbers! {
        deserialize_i8, visit_i8, i8;
        deserialize_i16, visit_i16, i16;
        deserialize_i32, visit_i32, i32;
        deserialize_i64, visit_i64, i64;
        deserialize_u8, visit_u8, u8;
        deserialize_u16, visit_u16, u16;
        deserialize_u32, visit_u32, u32;
        deserialize_u64, visit_u64, u64;
    }

    fn deserialize_f32<V: Visitor<'static>>(self, visitor: V) -> Result<V::Value, Fail> {
        self.deserialize_f64(visitor)
    }

    fn deserialize_f64<V: Visitor<'static>>(self, visitor: V) -> Result<V::Value, Fail> {
        let value = self.inner()?;
        visitor.visit_f64(value.float()?).map_err(|e: Fail| value.about(e))
    }

    fn deserialize_char<V: Visitor<'static>>(self, visitor: V) -> Result<V::Value, Fail> {
        let value = self.inner()?;
        if value.asks(WantedKind::Plain("a character in quotes")) {
            return visitor.visit_char('a');
        }
        match value.word().and_then(|w| w.strip_prefix('\'')?.strip_suffix('\'')) {
            Some(c) => visitor.visit_str(c),
            None => value.wanted(WantedKind::Plain("a character in quotes")),
        }
        .map_err(|e: Fail| value.about(e))
    }

    fn deserialize_str<V: Visitor<'static>>(self, visitor: V) -> Result<V::Value, Fail> {
        self.deserialize_string(visitor)
    }

    fn deserialize_string<V: Visitor<'static>>(self, visitor: V) -> Result<V::Value, Fail> {
        let value = self.inner()?;
        if value.asks(WantedKind::Plain("a text in quotes")) {
            return visitor
                .visit_string("a".repeat(value.refused() + self.reading.filling))
                .map_err(|e: Fail| value.about(e));
        }
        match value.word().map(scalar::text) {
            Some(Some(Ok(text))) => visitor.visit_string(text).map_err(|e: Fail| value.about(e)),
            Some(Some(Err(escape))) => value.misfit(Misfit::Escape(escape)),
            _ => value.wanted(WantedKind::Plain("a text in quotes")),
        }
    }

    fn deserialize_bytes<V: Visitor<'static>>(self, visitor: V) -> Result<V::Value, Fail> {
        self.deserialize_string(visitor)
    }

    fn deserialize_byte_buf<V: Visitor<'static>>(self, visitor: V) -> Result<V::Value, Fail> {
        self.deserialize_string(visitor)
    }

    fn deserialize_option<V: Visitor<'static>>(self, visitor: V) -> Result<V::Value, Fail> {
        let value = self.inner()?;
        let node = value.node();
        if matches!(&node.kind, Kind::Hole(h) if h.wanted.is_none() && h.refused > 0) {
            return visitor.visit_none();
        }
        match (value.word(), value.group()) {
            (Some("None"), _) => visitor.visit_none(),
            (None, Some(group)) if group.name.as_deref() == Some("Some") => {
                visitor.visit_some(Value { unwrapped: true, ..value })
            }
            _ => visitor.visit_some(value),
        }
        .map_err(|e: Fail| value.about(e))
    }

    fn deserialize_unit<V: Visitor<'static>>(self, visitor: V) -> Result<V::Value, Fail> {
        let empty = self.group().is_some_and(|g| g.bracket == '(' && g.items.is_empty());
        if self.asks(WantedKind::Fields) || empty {
            return visitor.visit_unit();
        }
        self.wanted(WantedKind::Plain("`()`"))
    }

    fn deserialize_unit_struct<V: Visitor<'static>>(self, name: &'static str, visitor: V) -> Result<V::Value, Fail> {
        if self.word() == Some(name) { visitor.visit_unit() } else { self.deserialize_unit(visitor) }
    }

    fn deserialize_newtype_struct<V: Visitor<'static>>(self, name: &'static str, visitor: V) -> Result<V::Value, Fail> {
        if name == RAW {
            let text =
                if self.asks(WantedKind::Plain("a value")) { "()" } else { &self.reading.text[self.node().value] };
            let text: StrDeserializer<'_, Fail> = text.into_deserializer();
            return visitor.visit_newtype_struct(text).map_err(|e| self.about(e));
        }
        let wrapped = self.group().is_some_and(|g| g.bracket == '(') && !self.unwrapped;
        visitor.visit_newtype_struct(Value { unwrapped: wrapped, ..self.inner()? }).map_err(|e: Fail| self.about(e))
    }

    fn deserialize_seq<V: Visitor<'static>>(self, visitor: V) -> Result<V::Value, Fail> {
        let value = self.inner()?;
        if value.asks(WantedKind::List) {
            let kids =
                (0..value.refused() + self.reading.filling / 2).map(|i| value.hole_kid(&i.to_string()).id).collect();
            return value.visit_elements(kids, visitor);
        }
        match value.group().filter(|g| g.bracket == '[' && g.name.is_none()) {
            // The parser has reported names in a list already.
            Some(group) => value.visit_elements(group.items.iter().map(|i| i.node).collect(), visitor),
            None => value.wanted(WantedKind::List),
        }
    }

    fn deserialize_tuple<V: Visitor<'static>>(self, len: usize, visitor: V) -> Result<V::Value, Fail> {
        self.tuple(len, visitor)
    }

    fn deserialize_tuple_struct<V: Visitor<'static>>(
        self,
        _: &'static str,
        len: usize,
        visitor: V,
    ) -> Result<V::Value, Fail> {
        self.tuple(len, visitor)
    }

    fn deserialize_map<V: Visitor<'static>>(self, visitor: V) -> Result<V::Value, Fail> {
        let value = self.inner()?;
        if value.asks(WantedKind::Plain("names and values in braces")) {
            return value.visit_elements(Vec::new(), visitor);
        }
        match value.group().filter(|g| g.bracket == '{') {
            Some(group) => value.visit_fields(&group, &[], visitor),
            None => value.wanted(WantedKind::Plain("names and values in braces")),
        }
    }

    fn deserialize_struct<V: Visitor<'static>>(
        self,
        name: &'static str,
        legal: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fail> {
        self.fields(name, legal, visitor)
    }

    fn deserialize_enum<V: Visitor<'static>>(
        self,
        _: &'static str,
        legal: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fail> {
        let value = self.inner()?;
        let name = if value.asks(WantedKind::Choice(legal)) {
            let n = legal.len().max(1);
            legal.get((self.reading.filling + value.refused()) % n).map(|l| (*l).to_string())
        } else {
            let word = value.word().filter(|w| is_name(w)).map(str::to_string);
            word.or_else(|| value.group().and_then(|g| g.name))
        };
        let Some(name) = name else {
            return value.fail(What::Unnamed(legal));
        };
        visitor.visit_enum(Choice { of: value, name }).map_err(|e| value.about(e))
    }

    fn deserialize_identifier<V: Visitor<'static>>(self, visitor: V) -> Result<V::Value, Fail> {
        match self.word() {
            Some(word) => visitor.visit_string(word.to_string()),
            None => self.wanted(WantedKind::Plain("a name")),
        }
    }

    fn deserialize_ignored_any<V: Visitor<'static>>(self, visitor: V) -> Result<V::Value, Fail> {
        visitor.visit_unit()
    }
}
