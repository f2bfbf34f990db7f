//! Arrays longer than serde knows of, for `#[serde(with = …)]`.

use arrayvec::ArrayVec;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Writes its elements in order.
pub(crate) fn serialize<T: Serialize, S: Serializer, const N: usize>(
    array: &[T; N],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(array)
}

/// Reads exactly as many.
pub(crate) fn deserialize<'de, T: Deserialize<'de>, D: Deserializer<'de>, const N: usize>(
    deserializer: D,
) -> Result<[T; N], D::Error> {
    let read = ArrayVec::<T, N>::deserialize(deserializer)?;
    let found = read.len();
    read.into_inner().map_err(|_| D::Error::invalid_length(found, &"more of them"))
}
