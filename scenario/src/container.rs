//! The head that every binary file of Setpiece begins with: mark, version, checksum, length.
//!
//! A compiled scenario, a snapshot and a replay are such files. What stands behind the head is
//! their own.
//!
//! | bytes | content |
//! |---|---|
//! | 0..8 | the mark, which says what the file is |
//! | 8..12 | the version, `u32`, little-endian, as the numbers below |
//! | 12..16 | the [`checksum`] of the body, `u32` |
//! | 16..24 | the length of the body in bytes, `u64` |
//! | 24.. | the body |

/// Length of the head, bytes.
pub const HEAD_BYTES: usize = 24;

/// A kind of file: its mark, and the version that this build writes and reads.
#[derive(Clone, Copy, Debug)]
pub struct Container {
    /// The first bytes of the file. No text begins with them.
    pub mark: &'static [u8; 8],
    /// The version of the body.
    pub version: u32,
}

/// Why a file's head is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeadError {
    /// It has another mark, or none.
    Mark,
    /// It ends before the end of its body.
    Truncated,
    /// It has another version.
    Version(u32),
    /// Its body is not what was written.
    Checksum,
}

impl Container {
    /// Says whether a file has this mark.
    pub fn marks(&self, file: &[u8]) -> bool {
        file.starts_with(self.mark)
    }

    /// Returns an empty head, with room for a body behind it.
    pub fn begin(body_bytes: usize) -> Vec<u8> {
        let mut file = Vec::with_capacity(HEAD_BYTES + body_bytes);
        file.resize(HEAD_BYTES, 0);
        file
    }

    /// Fills in the head of a file that was [begun](Self::begin), for the body behind it.
    pub fn seal(&self, mut file: Vec<u8>) -> Vec<u8> {
        let body = file.get(HEAD_BYTES..).unwrap_or_default();
        let mut head = [0; HEAD_BYTES];
        head[..8].copy_from_slice(self.mark);
        head[8..12].copy_from_slice(&self.version.to_le_bytes());
        head[12..16].copy_from_slice(&checksum(body).to_le_bytes());
        head[16..].copy_from_slice(&(body.len() as u64).to_le_bytes());
        file.resize(file.len().max(HEAD_BYTES), 0);
        file[..HEAD_BYTES].copy_from_slice(&head);
        file
    }

    /// Returns the body of a file.
    ///
    /// # Errors
    /// [`HeadError`] for anything but an unchanged file of this kind and version.
    pub fn open<'a>(&self, file: &'a [u8]) -> Result<&'a [u8], HeadError> {
        let rest = file.strip_prefix(self.mark).ok_or(HeadError::Mark)?;
        let (version, rest) = rest.split_first_chunk::<4>().ok_or(HeadError::Truncated)?;
        let version = u32::from_le_bytes(*version);
        // Before anything else: other versions may have another head.
        if version != self.version {
            return Err(HeadError::Version(version));
        }
        let (sum, rest) = rest.split_first_chunk::<4>().ok_or(HeadError::Truncated)?;
        let (length, body) = rest.split_first_chunk::<8>().ok_or(HeadError::Truncated)?;
        match u64::from_le_bytes(*length) {
            wanted if wanted > body.len() as u64 => Err(HeadError::Truncated),
            wanted if wanted < body.len() as u64 => Err(HeadError::Checksum),
            _ if checksum(body) != u32::from_le_bytes(*sum) => Err(HeadError::Checksum),
            _ => Ok(body),
        }
    }
}

/// The checksum of files, CRC-32 (ISO-HDLC, as in zip and PNG): against accidents, not against
/// malice.
pub fn checksum(bytes: &[u8]) -> u32 {
    crc32fast::hash(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    const KIND: Container = Container { mark: b"\x8bsample\n", version: 3 };

    fn sample() -> Vec<u8> {
        let mut file = Container::begin(5);
        file.extend_from_slice(b"hello");
        KIND.seal(file)
    }

    #[test]
    fn what_is_sealed_opens() {
        assert_eq!(KIND.open(&sample()), Ok(b"hello".as_slice()));
        assert_eq!(KIND.open(&KIND.seal(Container::begin(0))), Ok(b"".as_slice()));
        assert!(KIND.marks(&sample()));
        assert_eq!(checksum(b"123456789"), 0xcbf4_3926, "the check value of CRC-32");
    }

    #[test]
    fn every_cut_and_every_changed_byte_is_refused() {
        let file = sample();
        for end in 0..file.len() {
            let expected = if end < 8 { HeadError::Mark } else { HeadError::Truncated };
            assert_eq!(KIND.open(&file[..end]), Err(expected), "cut at {end}");
        }
        for at in 0..file.len() {
            let mut changed = file.clone();
            changed[at] ^= 1;
            assert!(KIND.open(&changed).is_err(), "byte {at}");
        }
        let longer = [&*file, b"x"].concat();
        assert_eq!(KIND.open(&longer), Err(HeadError::Checksum));
    }

    #[test]
    fn another_version_is_named_whatever_follows() {
        let other = Container { version: 2, ..KIND };
        assert_eq!(KIND.open(&other.seal(sample())), Err(HeadError::Version(2)));
        assert_eq!(KIND.open(b"\x8bsample\n\x02\0\0\0"), Err(HeadError::Version(2)));
    }
}
