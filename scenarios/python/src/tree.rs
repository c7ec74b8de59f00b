//! The values of a scenario as a tree that keeps what JSON would lose: names of choices, and values in parentheses.

use serde::ser::{
    Error, Impossible, Serialize, SerializeSeq, SerializeStruct, SerializeStructVariant, SerializeTuple,
    SerializeTupleStruct, SerializeTupleVariant, Serializer,
};
use std::fmt::{self, Display};

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Tree {
    /// Nothing.
    None,
    /// Yes or no.
    Bool(bool),
    /// A whole number.
    Int(i64),
    /// Any other number.
    Float(f64),
    /// A text.
    Text(String),
    /// A choice without parameters, such as `GoHome`.
    Name(String),
    /// `[a, b]`.
    List(Vec<Tree>),
    /// `(a, b)`.
    Tuple(Vec<Tree>),
    /// `(x: a, y: b)`.
    Fields(Vec<(String, Tree)>),
    /// `Name(value)`, where the value may be fields or a tuple.
    Variant(String, Box<Tree>),
}

impl Tree {
    /// The tree of a value.
    pub(crate) fn from_value(value: &impl Serialize) -> Result<Self, Unfit> {
        value.serialize(Planter)
    }

    /// One step into it, by the name of a field or the number of an element. The name of a variant may be left out.
    pub(crate) fn step(&self, part: &str) -> Option<&Self> {
        match self {
            Tree::List(all) | Tree::Tuple(all) => all.get(part.parse::<usize>().ok()?),
            Tree::Fields(fields) => fields.iter().find(|(name, _)| name == part).map(|f| &f.1),
            Tree::Variant(name, inner) if name == part => Some(inner),
            Tree::Variant(_, inner) => inner.step(part),
            _ => None,
        }
    }

    /// What it has, for a message.
    pub(crate) fn has(&self) -> String {
        match self {
            Tree::List(all) | Tree::Tuple(all) => format!("{} elements", all.len()),
            Tree::Fields(fields) => {
                let names: Vec<&str> = fields.iter().map(|(name, _)| name.as_str()).collect();
                names.join(", ")
            }
            Tree::Variant(_, inner) => inner.has(),
            _ => "no fields".to_string(),
        }
    }
}

/// A value that has no tree: none of a scenario's.
#[derive(Debug)]
pub(crate) struct Unfit(String);

impl Display for Unfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Unfit {}

impl Error for Unfit {
    fn custom<T: Display>(said: T) -> Self {
        Self(said.to_string())
    }
}

/// Makes trees of values.
struct Planter;

/// Items so far, and what they become.
struct Items(Vec<Tree>, fn(Vec<Tree>) -> Tree, Option<&'static str>);

/// Fields so far, and the variant whose they are.
struct Fields(Vec<(String, Tree)>, Option<&'static str>);

fn whole<N: TryInto<i64> + Display + Copy>(n: N) -> Result<Tree, Unfit> {
    let fits = n.try_into().map(Tree::Int);
    fits.map_err(|_| Unfit(format!("{n} is too large")))
}

fn named(variant: Option<&'static str>, tree: Tree) -> Tree {
    match variant {
        Some(name) => Tree::Variant(name.to_string(), Box::new(tree)),
        None => tree,
    }
}

macro_rules! whole_numbers {
    ($($method:ident: $number:ty),*) => {
        $(fn $method(self, n: $number) -> Result<Tree, Unfit> {
            whole(n)
        })*
    };
}

impl Serializer for Planter {
    type Ok = Tree;
    type Error = Unfit;
    type SerializeSeq = Items;
    type SerializeTuple = Items;
    type SerializeTupleStruct = Items;
    type SerializeTupleVariant = Items;
    type SerializeMap = Impossible<Tree, Unfit>;
    type SerializeStruct = Fields;
    type SerializeStructVariant = Fields;

    whole_numbers!(serialize_i8: i8, serialize_i16: i16, serialize_i32: i32, serialize_i64: i64);
    whole_numbers!(serialize_u8: u8, serialize_u16: u16, serialize_u32: u32, serialize_u64: u64);

    fn serialize_bool(self, v: bool) -> Result<Tree, Unfit> {
        Ok(Tree::Bool(v))
    }
    fn serialize_f32(self, v: f32) -> Result<Tree, Unfit> {
        Ok(Tree::Float(v.into()))
    }
    fn serialize_f64(self, v: f64) -> Result<Tree, Unfit> {
        Ok(Tree::Float(v))
    }
    fn serialize_char(self, v: char) -> Result<Tree, Unfit> {
        Ok(Tree::Text(v.to_string()))
    }
    fn serialize_str(self, v: &str) -> Result<Tree, Unfit> {
        Ok(Tree::Text(v.to_string()))
    }
    fn serialize_bytes(self, _: &[u8]) -> Result<Tree, Unfit> {
        Err(Unfit("bytes".to_string()))
    }
    fn serialize_none(self) -> Result<Tree, Unfit> {
        Ok(Tree::None)
    }
    fn serialize_some<T: ?Sized + Serialize>(self, value: &T) -> Result<Tree, Unfit> {
        value.serialize(self)
    }
    fn serialize_unit(self) -> Result<Tree, Unfit> {
        Ok(Tree::Tuple(Vec::new()))
    }
    fn serialize_unit_struct(self, _: &'static str) -> Result<Tree, Unfit> {
        self.serialize_unit()
    }
    fn serialize_unit_variant(self, _: &'static str, _: u32, variant: &'static str) -> Result<Tree, Unfit> {
        Ok(Tree::Name(variant.to_string()))
    }
    fn serialize_newtype_struct<T: ?Sized + Serialize>(self, _: &'static str, value: &T) -> Result<Tree, Unfit> {
        value.serialize(self)
    }
    fn serialize_newtype_variant<T: ?Sized + Serialize>(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        value: &T,
    ) -> Result<Tree, Unfit> {
        let inner = match value.serialize(self)? {
            // `Name((a, b))` is not `Name(a, b)`.
            tuple @ Tree::Tuple(_) => Tree::Tuple(vec![tuple]),
            other => other,
        };
        Ok(named(Some(variant), inner))
    }
    fn serialize_seq(self, _: Option<usize>) -> Result<Items, Unfit> {
        Ok(Items(Vec::new(), Tree::List, None))
    }
    fn serialize_tuple(self, _: usize) -> Result<Items, Unfit> {
        Ok(Items(Vec::new(), Tree::Tuple, None))
    }
    fn serialize_tuple_struct(self, _: &'static str, n: usize) -> Result<Items, Unfit> {
        self.serialize_tuple(n)
    }
    fn serialize_tuple_variant(self, _: &'static str, _: u32, variant: &'static str, _: usize) -> Result<Items, Unfit> {
        Ok(Items(Vec::new(), Tree::Tuple, Some(variant)))
    }
    fn serialize_map(self, _: Option<usize>) -> Result<Self::SerializeMap, Unfit> {
        Err(Unfit("a map".to_string()))
    }
    fn serialize_struct(self, _: &'static str, _: usize) -> Result<Fields, Unfit> {
        Ok(Fields(Vec::new(), None))
    }
    fn serialize_struct_variant(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        _: usize,
    ) -> Result<Fields, Unfit> {
        Ok(Fields(Vec::new(), Some(variant)))
    }
}

macro_rules! items {
    ($($kind:ident: $add:ident),*) => {
        $(impl $kind for Items {
            type Ok = Tree;
            type Error = Unfit;
            fn $add<T: ?Sized + Serialize>(&mut self, value: &T) -> Result<(), Unfit> {
                self.0.push(Tree::from_value(&value)?);
                Ok(())
            }
            fn end(self) -> Result<Tree, Unfit> {
                Ok(named(self.2, self.1(self.0)))
            }
        })*
    };
}

items!(
    SerializeSeq: serialize_element,
    SerializeTuple: serialize_element,
    SerializeTupleStruct: serialize_field,
    SerializeTupleVariant: serialize_field
);

macro_rules! fields {
    ($($kind:ident),*) => {
        $(impl $kind for Fields {
            type Ok = Tree;
            type Error = Unfit;
            fn serialize_field<T: ?Sized + Serialize>(
                &mut self,
                name: &'static str,
                value: &T,
            ) -> Result<(), Unfit> {
                self.0.push((name.to_string(), Tree::from_value(&value)?));
                Ok(())
            }
            fn end(self) -> Result<Tree, Unfit> {
                Ok(named(self.1, Tree::Fields(self.0)))
            }
        })*
    };
}

fields!(SerializeStruct, SerializeStructVariant);
