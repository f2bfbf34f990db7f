//! Lists of bounded length, because one byte of a snapshot may expand to a hundred in memory.

use serde::de::{Error as _, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::marker::PhantomData;

/// Reads a list of at most `MAX` parts.
///
/// # Errors
/// The format's own if there are more.
pub(crate) fn bounded<'de, D: Deserializer<'de>, T: Deserialize<'de>, const MAX: usize>(
    from: D,
) -> Result<Vec<T>, D::Error> {
    struct Parts<T, const MAX: usize>(PhantomData<T>);
    impl<'de, T: Deserialize<'de>, const MAX: usize> Visitor<'de> for Parts<T, MAX> {
        type Value = Vec<T>;

        fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            write!(f, "at most {MAX} parts")
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vec<T>, A::Error> {
            let mut parts = Vec::new();
            while let Some(part) = list.next_element()? {
                if parts.len() >= MAX {
                    return Err(A::Error::custom(format_args!("it has more than {MAX} parts")));
                }
                parts.push(part);
            }
            Ok(parts)
        }
    }
    from.deserialize_seq(Parts::<T, MAX>(PhantomData))
}
