//! Names of enum variants as files and reports write them: those of serde, so that no second list of words must be kept in
//! step with a type.

use std::fmt;

use serde::{Serialize, Serializer, ser::Impossible};

/// The name that serde writes for a variant without fields.
///
/// # Panics
/// If serde writes something else than the name of a variant.
/// # Examples
/// ```
/// use congruent_input::{Severity, serde_name};
/// assert_eq!(serde_name(&Severity::Warning), "warning");
/// ```
pub fn serde_name(variant: &impl Serialize) -> &'static str {
    variant.serialize(NameOnly).expect("a variant without fields")
}

/// Takes the name of a variant and refuses everything else.
struct NameOnly;

type Refused = Impossible<&'static str, fmt::Error>;

macro_rules! refuse {
    ($($method:ident($($argument:ty),*) -> $value:ty;)*) => {
        $(fn $method(self, $(_: $argument),*) -> Result<$value, fmt::Error> {
            Err(fmt::Error)
        })*
    };
}

impl Serializer for NameOnly {
    type Ok = &'static str;
    type Error = fmt::Error;
    type SerializeSeq = Refused;
    type SerializeTuple = Refused;
    type SerializeTupleStruct = Refused;
    type SerializeTupleVariant = Refused;
    type SerializeMap = Refused;
    type SerializeStruct = Refused;
    type SerializeStructVariant = Refused;

    fn serialize_unit_variant(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
    ) -> Result<&'static str, fmt::Error> {
        Ok(variant)
    }

    fn serialize_some<T: ?Sized + Serialize>(self, _: &T) -> Result<&'static str, fmt::Error> {
        Err(fmt::Error)
    }

    fn serialize_newtype_struct<T: ?Sized + Serialize>(
        self,
        _: &'static str,
        _: &T,
    ) -> Result<&'static str, fmt::Error> {
        Err(fmt::Error)
    }

    fn serialize_newtype_variant<T: ?Sized + Serialize>(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: &T,
    ) -> Result<&'static str, fmt::Error> {
        Err(fmt::Error)
    }

    refuse! {
        serialize_bool(bool) -> &'static str;
        serialize_i8(i8) -> &'static str;
        serialize_i16(i16) -> &'static str;
        serialize_i32(i32) -> &'static str;
        serialize_i64(i64) -> &'static str;
        serialize_u8(u8) -> &'static str;
        serialize_u16(u16) -> &'static str;
        serialize_u32(u32) -> &'static str;
        serialize_u64(u64) -> &'static str;
        serialize_f32(f32) -> &'static str;
        serialize_f64(f64) -> &'static str;
        serialize_char(char) -> &'static str;
        serialize_str(&str) -> &'static str;
        serialize_bytes(&[u8]) -> &'static str;
        serialize_none() -> &'static str;
        serialize_unit() -> &'static str;
        serialize_unit_struct(&'static str) -> &'static str;
        serialize_seq(Option<usize>) -> Refused;
        serialize_tuple(usize) -> Refused;
        serialize_tuple_struct(&'static str, usize) -> Refused;
        serialize_tuple_variant(&'static str, u32, &'static str, usize) -> Refused;
        serialize_map(Option<usize>) -> Refused;
        serialize_struct(&'static str, usize) -> Refused;
        serialize_struct_variant(&'static str, u32, &'static str, usize) -> Refused;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Serialize)]
    #[serde(rename_all = "snake_case")]
    enum Kind {
        WithTwoWords,
        #[serde(rename = "ratio")]
        Renamed,
    }

    #[test]
    fn names_are_those_of_serde() {
        assert_eq!(serde_name(&Kind::WithTwoWords), "with_two_words");
        assert_eq!(serde_name(&Kind::Renamed), "ratio");
    }

    #[test]
    #[should_panic(expected = "a variant without fields")]
    fn other_values_have_no_name() {
        serde_name(&1.0);
    }
}
