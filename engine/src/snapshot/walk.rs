//! Checks every number in a value that was read: play must be able to continue from it.
//!
//! This is a serializer that writes nothing. 32-bit floats, which make up a match, must be finite
//! and of a plausible size. Counts must leave room for further counting. 64-bit numbers are
//! unrestricted: they are sums, parameters and keys, or values of programs, where infinity and NaN
//! are valid.

use serde::Serialize;
use serde::ser::{self, Error as _, Impossible, Serializer};
use std::fmt::{self, Display};

/// The largest float of a match: metres, m/s, rad/s, seconds.
const FLOAT_MAX: f32 = 1.0e4;
/// The largest count. In ticks this is a third of a year of play.
const COUNT_MAX: u32 = 1 << 30;
/// Counts that may be `u32::MAX`, which means never or nowhere.
const NEVER: &[&str] = &["limit_steps", "at_tick", "from_tick", "node"];

/// Finds an impossible number in a value.
pub(super) fn walk(value: &impl Serialize) -> Result<(), NumberFault> {
    value.serialize(Walk { key: "" })
}

/// An impossible number. It is boxed because nearly every value is valid and the result should be
/// small.
#[derive(Debug)]
pub(super) struct NumberFault(Box<NumberPlace>);

/// The content of a [`NumberFault`].
#[derive(Debug)]
pub(super) struct NumberPlace {
    /// Its place within the value: `.players[3].pos[0]`.
    pub(super) place: String,
    /// What is wrong with it.
    pub(super) why: String,
}

impl NumberFault {
    #[cold]
    fn at(mut self, step: impl Display) -> NumberFault {
        self.0.place.insert_str(0, &step.to_string());
        self
    }

    /// What and where.
    pub(super) fn found(self) -> NumberPlace {
        *self.0
    }
}

impl Display for NumberFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.0.place, self.0.why)
    }
}

impl std::error::Error for NumberFault {}

impl ser::Error for NumberFault {
    #[cold]
    fn custom<T: Display>(message: T) -> NumberFault {
        NumberFault(Box::new(NumberPlace { place: String::new(), why: message.to_string() }))
    }
}

#[derive(Clone, Copy)]
struct Walk {
    /// The name of the current field; none within a list.
    key: &'static str,
}

/// The parts of a value, in order.
struct Parts(usize);

impl Parts {
    fn next<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), NumberFault> {
        let at = self.0;
        self.0 += 1;
        value.serialize(Walk { key: "" }).map_err(|fault| fault.at(format_args!("[{at}]")))
    }
}

fn named<T: Serialize + ?Sized>(key: &'static str, value: &T) -> Result<(), NumberFault> {
    value.serialize(Walk { key }).map_err(|fault| fault.at(format_args!(".{key}")))
}

macro_rules! free {
    ($($method:ident: $type:ty),+ $(,)?) => {
        $(fn $method(self, _: $type) -> Result<(), NumberFault> { Ok(()) })+
    };
}

impl Serializer for Walk {
    type Ok = ();
    type Error = NumberFault;
    type SerializeSeq = Parts;
    type SerializeTuple = Parts;
    type SerializeTupleStruct = Parts;
    type SerializeTupleVariant = Parts;
    type SerializeMap = Impossible<(), NumberFault>;
    type SerializeStruct = Parts;
    type SerializeStructVariant = Parts;

    free! {
        serialize_bool: bool, serialize_i8: i8, serialize_i16: i16, serialize_i64: i64,
        serialize_u8: u8, serialize_u16: u16, serialize_u64: u64, serialize_f64: f64,
        serialize_char: char, serialize_str: &str,
        serialize_unit_struct: &'static str,
    }

    fn serialize_i32(self, value: i32) -> Result<(), NumberFault> {
        self.serialize_u32(value.unsigned_abs())
    }

    fn serialize_u32(self, value: u32) -> Result<(), NumberFault> {
        if value <= COUNT_MAX || (value == u32::MAX && NEVER.contains(&self.key)) {
            Ok(())
        } else {
            Err(NumberFault::custom(format_args!("is {value}")))
        }
    }

    fn serialize_f32(self, value: f32) -> Result<(), NumberFault> {
        // NaN fails this comparison too.
        if value.abs() <= FLOAT_MAX {
            Ok(())
        } else {
            Err(NumberFault::custom(format_args!("is {value}")))
        }
    }

    /// The same as for writing a snapshot, so that the walk covers what is written.
    fn is_human_readable(&self) -> bool {
        false
    }

    /// Bytes are floats: see [`crate::floats`].
    fn serialize_bytes(self, bytes: &[u8]) -> Result<(), NumberFault> {
        let floats = bytes.as_chunks().0.iter().map(|float| f32::from_le_bytes(*float));
        // Checks all at once first, because they are nearly always valid.
        if floats.clone().fold(true, |sound, value| sound & (value.abs() <= FLOAT_MAX)) {
            return Ok(());
        }
        let mut parts = Parts(0);
        floats.into_iter().try_for_each(|value| parts.next(&value))
    }

    fn serialize_none(self) -> Result<(), NumberFault> {
        Ok(())
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<(), NumberFault> {
        value.serialize(self)
    }

    fn serialize_unit(self) -> Result<(), NumberFault> {
        Ok(())
    }

    fn serialize_unit_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
    ) -> Result<(), NumberFault> {
        Ok(())
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        value: &T,
    ) -> Result<(), NumberFault> {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        value: &T,
    ) -> Result<(), NumberFault> {
        value.serialize(self)
    }

    fn serialize_seq(self, _: Option<usize>) -> Result<Parts, NumberFault> {
        Ok(Parts(0))
    }

    fn serialize_tuple(self, _: usize) -> Result<Parts, NumberFault> {
        Ok(Parts(0))
    }

    fn serialize_tuple_struct(self, _: &'static str, _: usize) -> Result<Parts, NumberFault> {
        Ok(Parts(0))
    }

    fn serialize_tuple_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Parts, NumberFault> {
        Ok(Parts(0))
    }

    fn serialize_map(self, _: Option<usize>) -> Result<Self::SerializeMap, NumberFault> {
        Err(NumberFault::custom("is a map"))
    }

    fn serialize_struct(self, _: &'static str, _: usize) -> Result<Parts, NumberFault> {
        Ok(Parts(0))
    }

    fn serialize_struct_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Parts, NumberFault> {
        Ok(Parts(0))
    }
}

macro_rules! elements {
    ($($kind:ident)+) => {$(
        impl ser::$kind for Parts {
            type Ok = ();
            type Error = NumberFault;

            fn serialize_element<T: Serialize + ?Sized>(
                &mut self,
                value: &T,
            ) -> Result<(), NumberFault> {
                self.next(value)
            }

            fn end(self) -> Result<(), NumberFault> {
                Ok(())
            }
        }
    )+};
}

elements!(SerializeSeq SerializeTuple);

macro_rules! fields {
    ($($kind:ident)+) => {$(
        impl ser::$kind for Parts {
            type Ok = ();
            type Error = NumberFault;

            fn serialize_field<T: Serialize + ?Sized>(
                &mut self,
                value: &T,
            ) -> Result<(), NumberFault> {
                self.next(value)
            }

            fn end(self) -> Result<(), NumberFault> {
                Ok(())
            }
        }
    )+};
}

fields!(SerializeTupleStruct SerializeTupleVariant);

macro_rules! named_fields {
    ($($kind:ident)+) => {$(
        impl ser::$kind for Parts {
            type Ok = ();
            type Error = NumberFault;

            fn serialize_field<T: Serialize + ?Sized>(
                &mut self,
                key: &'static str,
                value: &T,
            ) -> Result<(), NumberFault> {
                named(key, value)
            }

            fn end(self) -> Result<(), NumberFault> {
                Ok(())
            }
        }
    )+};
}

named_fields!(SerializeStruct SerializeStructVariant);

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Serialize)]
    struct Sample {
        pos: [f32; 2],
        #[serde(with = "crate::floats")]
        lane: [f32; 3],
        tick: u32,
        limit_steps: Option<u32>,
        sum: f64,
    }

    const SOUND: Sample = Sample {
        pos: [1.0, -50.0],
        lane: [0.5; 3],
        tick: 7,
        limit_steps: Some(u32::MAX),
        sum: f64::INFINITY,
    };

    #[test]
    fn lists_of_floats_are_walked_as_they_are_written() {
        assert!(!Walk { key: "" }.is_human_readable());
        assert!(Walk { key: "" }.serialize_bytes(&1.0e4_f32.to_le_bytes()).is_ok());
        assert!(Walk { key: "" }.serialize_bytes(&1.1e4_f32.to_le_bytes()).is_err());
    }

    fn fault(sample: &Sample) -> String {
        walk(&[sample]).unwrap_err().to_string()
    }

    #[test]
    fn an_impossible_number_is_found_at_its_place() {
        assert!(walk(&SOUND).is_ok());
        assert_eq!(fault(&Sample { pos: [0.0, f32::NAN], ..SOUND }), "[0].pos[1] is NaN");
        assert_eq!(fault(&Sample { pos: [2.0e4, 0.0], ..SOUND }), "[0].pos[0] is 20000");
        assert_eq!(
            fault(&Sample { lane: [0.0, 1.0e4, f32::INFINITY], ..SOUND }),
            "[0].lane[2] is inf"
        );
        assert_eq!(fault(&Sample { tick: u32::MAX, ..SOUND }), "[0].tick is 4294967295");
    }
}
