//! FNV-1a, 64 bits (Fowler, Noll, Vo): the hash of digests and the checksum of files. A change of a single byte always
//! changes it.

/// What was hashed so far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fnv1a(u64);

impl Fnv1a {
    const OFFSET: u64 = 0xcbf2_9ce4_8422_2325;
    const PRIME: u64 = 0x0000_0100_0000_01b3;

    pub(crate) fn new() -> Self {
        Self(Self::OFFSET)
    }

    #[inline]
    pub(crate) fn bytes(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(Self::PRIME);
        }
    }

    pub(crate) fn finish(self) -> u64 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::Fnv1a;

    #[test]
    fn agrees_with_the_published_value() {
        let mut hash = Fnv1a::new();
        hash.bytes(b"abcd");
        assert_eq!(hash.finish(), 0xfc17_9f83_ee07_24dd);
    }
}
