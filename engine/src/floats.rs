//! Lists of many floats as bytes, for `#[serde(with = …)]`: read and written at once,
//! little-endian.

use serde::de::{Error, Visitor};
use serde::{Deserializer, Serializer};
use std::fmt;

/// Writes four bytes each.
pub(crate) fn serialize<S: Serializer, const N: usize>(
    floats: &[f32; N],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    if serializer.is_human_readable() {
        return serializer.collect_seq(floats);
    }
    serializer.serialize_bytes(floats.map(f32::to_le_bytes).as_flattened())
}

/// Reads exactly as many.
pub(crate) fn deserialize<'de, D: Deserializer<'de>, const N: usize>(
    deserializer: D,
) -> Result<[f32; N], D::Error> {
    deserializer.deserialize_bytes(Bytes)
}

struct Bytes<const N: usize>;

impl<const N: usize> Visitor<'_> for Bytes<N> {
    type Value = [f32; N];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{N} floats")
    }

    fn visit_bytes<E: Error>(self, bytes: &[u8]) -> Result<[f32; N], E> {
        match bytes.as_chunks() {
            (floats, []) => match <&[[u8; 4]; N]>::try_from(floats) {
                Ok(floats) => Ok(floats.map(f32::from_le_bytes)),
                Err(_) => Err(E::invalid_length(floats.len(), &self)),
            },
            _ => Err(E::invalid_length(bytes.len(), &self)),
        }
    }
}

#[cfg(test)]
mod tests {
    #[derive(Debug, PartialEq, serde::Serialize, serde::Deserialize)]
    struct Lane<const N: usize>(#[serde(with = "super")] [f32; N]);

    #[test]
    fn as_many_are_read_as_were_written() {
        let lane = Lane([1.5, -0.0, 3.0e-9]);
        let mut bytes = postcard::to_stdvec(&lane).unwrap();
        assert_eq!(bytes.len(), 1 + 3 * 4);
        assert_eq!(postcard::from_bytes::<Lane<3>>(&bytes).unwrap(), lane);
        assert!(postcard::from_bytes::<Lane<2>>(&bytes).is_err());
        // One byte less, with a matching length: not a whole number of floats.
        bytes[0] -= 1;
        assert!(postcard::from_bytes::<Lane<3>>(&bytes).is_err());
    }
}
