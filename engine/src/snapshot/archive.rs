//! Writing and reading in one function: each part names its values once, so what is written is what
//! is read.
//!
//! A part that is archived passes its values one by one, in the same order for both. While reading,
//! each value is checked by itself: its form, its length if the scenario fixes one, its numbers.
//! Parts check how their values fit together.

use super::error::SnapshotError;
use super::walk::{NumberPlace, walk};
use postcard::ser_flavors::Flavor;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt;

/// A stream of values being written to bytes or read from them.
pub(crate) struct Archive<'a> {
    way: ArchiveWay<'a>,
}

enum ArchiveWay<'a> {
    Out(Vec<u8>),
    In(&'a [u8]),
}

impl<'a> Archive<'a> {
    /// Starts writing, after some bytes.
    pub(super) fn writing(bytes: Vec<u8>) -> Archive<'a> {
        Archive { way: ArchiveWay::Out(bytes) }
    }

    /// Starts reading.
    pub(super) fn reading(bytes: &'a [u8]) -> Archive<'a> {
        Archive { way: ArchiveWay::In(bytes) }
    }

    /// Whether this archive reads.
    pub(crate) fn is_reading(&self) -> bool {
        matches!(self.way, ArchiveWay::In(_))
    }

    /// Writes two parts in the other order than they are archived in: `first` is called when
    /// `second` has been, and stands before it. They are read in the order in which they stand.
    pub(crate) fn in_order<C>(
        &mut self,
        context: &mut C,
        first: impl FnOnce(&mut C, &mut Self) -> Result<(), SnapshotError>,
        second: impl FnOnce(&mut C, &mut Self) -> Result<(), SnapshotError>,
    ) -> Result<(), SnapshotError> {
        if self.is_reading() {
            first(context, self)?;
            return second(context, self);
        }
        let mut behind = Archive::writing(Vec::new());
        second(context, &mut behind)?;
        first(context, self)?;
        if let ArchiveWay::Out(bytes) = &mut self.way {
            bytes.extend_from_slice(&behind.into_bytes());
        }
        Ok(())
    }

    /// The bytes, including those that were there before.
    pub(super) fn into_bytes(self) -> Vec<u8> {
        match self.way {
            ArchiveWay::Out(bytes) => bytes,
            ArchiveWay::In(_) => Vec::new(),
        }
    }

    /// The bytes not yet read.
    pub(super) fn rest(&self) -> &'a [u8] {
        match self.way {
            ArchiveWay::Out(_) => &[],
            ArchiveWay::In(rest) => rest,
        }
    }

    /// Writes a value; no-op while reading.
    pub(super) fn put<T: Serialize + ?Sized>(
        &mut self,
        name: &str,
        value: &T,
    ) -> Result<(), SnapshotError> {
        if let ArchiveWay::Out(bytes) = &mut self.way {
            let behind = Growing(std::mem::take(bytes));
            *bytes = postcard::serialize_with_flavor(value, behind)
                .map_err(|why| fault(format_args!("{name}"), why))?;
        }
        Ok(())
    }

    /// Writes a value, or replaces it by the one that was read.
    pub(crate) fn value<T: Serialize + DeserializeOwned>(
        &mut self,
        name: &str,
        value: &mut T,
    ) -> Result<(), SnapshotError> {
        if self.is_reading() {
            *value = self.read(name)?;
        }
        self.put(name, value)
    }

    /// Reads a value. May only be called while reading.
    pub(crate) fn read<T: Serialize + DeserializeOwned>(
        &mut self,
        name: &str,
    ) -> Result<T, SnapshotError> {
        self.read_at(format_args!("{name}"))
    }

    fn read_at<T: Serialize + DeserializeOwned>(
        &mut self,
        name: fmt::Arguments<'_>,
    ) -> Result<T, SnapshotError> {
        let (value, rest) =
            postcard::take_from_bytes::<T>(self.rest()).map_err(|why| fault(name, why))?;
        walk(&value).map_err(|fault| {
            let NumberPlace { place, why } = fault.found();
            SnapshotError::damaged(format!("{name}{place}"), why)
        })?;
        self.way = ArchiveWay::In(rest);
        Ok(value)
    }

    /// Like [`Self::value`], for a list whose length the scenario fixes.
    pub(crate) fn slots<T: Serialize + DeserializeOwned>(
        &mut self,
        name: &str,
        slots: &mut [T],
    ) -> Result<(), SnapshotError> {
        if !self.is_reading() {
            return self.put(name, slots);
        }
        // A list is its length, then its parts.
        let length = self.read::<u64>(name)?;
        if length != slots.len() as u64 {
            let why = format!("has {length} parts where the scenario has {}", slots.len());
            return Err(SnapshotError::damaged(name, why));
        }
        for (at, slot) in slots.iter_mut().enumerate() {
            *slot = self.read_at(format_args!("{name}[{at}]"))?;
        }
        Ok(())
    }

    /// Archives a part; its name appears in errors about it.
    pub(crate) fn part(
        &mut self,
        name: &str,
        content: impl FnOnce(&mut Self) -> Result<(), SnapshotError>,
    ) -> Result<(), SnapshotError> {
        content(self).map_err(|error| match error {
            SnapshotError::Damaged { place, why } => {
                SnapshotError::damaged(format!("{name}.{place}"), why)
            }
            other => other,
        })
    }
}

/// Appends bytes at once; postcard's own way goes byte by byte.
struct Growing(Vec<u8>);

impl Flavor for Growing {
    type Output = Vec<u8>;

    fn try_extend(&mut self, data: &[u8]) -> postcard::Result<()> {
        self.0.extend_from_slice(data);
        Ok(())
    }

    fn try_push(&mut self, byte: u8) -> postcard::Result<()> {
        self.0.push(byte);
        Ok(())
    }

    fn finalize(self) -> postcard::Result<Vec<u8>> {
        Ok(self.0)
    }
}

#[cold]
fn fault(name: fmt::Arguments<'_>, why: postcard::Error) -> SnapshotError {
    let words = match why {
        postcard::Error::DeserializeUnexpectedEnd => "ends early".to_owned(),
        postcard::Error::SerdeDeCustom | postcard::Error::DeserializeBadEnum => {
            "has a value of none of its kinds".to_owned()
        }
        other => format!("can't be read: {other}"),
    };
    SnapshotError::damaged(name.to_string(), words)
}
