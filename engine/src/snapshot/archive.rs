//! Writing and reading in one: a part names its values once, and what is written is what is read.
//!
//! A part that is archived hands over its values by turns, in the same order either way. On the way in each is checked
//! by itself: its form, its length where the scenario gives one, its numbers. Parts check what hangs together.

use super::error::SnapshotError;
use super::walk::walk;
use crate::judge::script::Shelf;
use postcard::ser_flavors::Flavor;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Room for a match of eleven a side: bytes that outgrow their place are copied.
const USUAL_BYTES: usize = 12 * 1024;

/// Values on their way to bytes or from them.
pub(crate) struct Archive<'a> {
    way: Way<'a>,
    /// What scripts were shown and have kept.
    pub(crate) shelf: Shelf,
}

enum Way<'a> {
    Out(Vec<u8>),
    In(&'a [u8]),
}

impl<'a> Archive<'a> {
    /// To be written.
    pub(crate) fn writing() -> Archive<'a> {
        Archive { way: Way::Out(Vec::with_capacity(USUAL_BYTES)), shelf: Shelf::default() }
    }

    /// To be read.
    pub(crate) fn reading(bytes: &'a [u8]) -> Archive<'a> {
        Archive { way: Way::In(bytes), shelf: Shelf::default() }
    }

    /// Whether it is read.
    pub(crate) fn is_reading(&self) -> bool {
        matches!(self.way, Way::In(_))
    }

    /// What was written.
    pub(super) fn into_bytes(self) -> Vec<u8> {
        match self.way {
            Way::Out(bytes) => bytes,
            Way::In(_) => Vec::new(),
        }
    }

    /// What is still to be read.
    pub(super) fn rest(&self) -> &'a [u8] {
        match self.way {
            Way::Out(_) => &[],
            Way::In(rest) => rest,
        }
    }

    /// Writes a value, or puts the one that was read in its place.
    pub(crate) fn value<T: Serialize + DeserializeOwned>(
        &mut self,
        name: &str,
        value: &mut T,
    ) -> Result<(), SnapshotError> {
        match &mut self.way {
            Way::Out(bytes) => *bytes = write(name, value, std::mem::take(bytes))?,
            Way::In(_) => *value = self.read(name)?,
        }
        Ok(())
    }

    /// Reads a value; there is none on the way out.
    pub(crate) fn read<T: Serialize + DeserializeOwned>(&mut self, name: &str) -> Result<T, SnapshotError> {
        let (value, rest) = postcard::take_from_bytes::<T>(self.rest()).map_err(|why| fault(name, why))?;
        walk(&value).map_err(|fault| SnapshotError::damaged(format!("{name}{}", fault.place), fault.why))?;
        self.way = Way::In(rest);
        Ok(value)
    }

    /// The same for as many values as there are: the scenario says how many.
    pub(crate) fn slots<T: Serialize + DeserializeOwned>(
        &mut self,
        name: &str,
        slots: &mut [T],
    ) -> Result<(), SnapshotError> {
        if let Way::Out(bytes) = &mut self.way {
            *bytes = write(name, slots, std::mem::take(bytes))?;
            return Ok(());
        }
        let read: Vec<T> = self.read(name)?;
        if read.len() != slots.len() {
            let why = format!("has {} parts where the scenario has {}", read.len(), slots.len());
            return Err(SnapshotError::damaged(name, why));
        }
        slots.iter_mut().zip(read).for_each(|(slot, read)| *slot = read);
        Ok(())
    }

    /// Passes a part: what is wrong in it is told by its name.
    pub(crate) fn part(
        &mut self,
        name: &str,
        pass: impl FnOnce(&mut Self) -> Result<(), SnapshotError>,
    ) -> Result<(), SnapshotError> {
        pass(self).map_err(|error| match error {
            SnapshotError::Damaged { place, why } => SnapshotError::damaged(format!("{name}.{place}"), why),
            other => other,
        })
    }
}

fn write<T: Serialize + ?Sized>(name: &str, value: &T, bytes: Vec<u8>) -> Result<Vec<u8>, SnapshotError> {
    postcard::serialize_with_flavor(value, Growing(bytes)).map_err(|why| fault(name, why))
}

/// Bytes that are written behind others: postcard's own way to do so goes byte by byte.
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

fn fault(name: &str, why: postcard::Error) -> SnapshotError {
    let words = match why {
        postcard::Error::DeserializeUnexpectedEnd => "ends early".to_owned(),
        postcard::Error::SerdeDeCustom | postcard::Error::DeserializeBadEnum => {
            "has a value of none of its kinds".to_owned()
        }
        other => format!("can't be read: {other}"),
    };
    SnapshotError::damaged(name, words)
}
