//! CRC-32 as PNG and gzip have it (ISO 3309), for `png` and `flate2`. It takes the place of the crate of this name, whose tables
//! are for speed: 16 kB that do not compress, a fiftieth of what the page loads. Pictures are small.

/// The polynomial of ISO 3309, lowest power in the highest bit.
const POLYNOMIAL: u32 = 0xedb8_8320;
/// What four bits at the low end do to the rest.
const TABLE: [u32; 16] = table();

const fn table() -> [u32; 16] {
    let mut table = [0; 16];
    let mut k = 0;
    while k < 16 {
        let mut rest = k as u32;
        let mut bit = 0;
        while bit < 4 {
            rest = (rest >> 1) ^ if rest & 1 == 1 { POLYNOMIAL } else { 0 };
            bit += 1;
        }
        table[k] = rest;
        k += 1;
    }
    table
}

/// The sum of bytes that come in parts.
#[derive(Clone, Debug, Default)]
pub struct Hasher {
    sum: u32,
    length: u64,
}

impl Hasher {
    /// That of no bytes.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds bytes at the end.
    pub fn update(&mut self, bytes: &[u8]) {
        self.length += bytes.len() as u64;
        self.sum = !bytes.iter().fold(!self.sum, |rest, &byte| after_byte(rest ^ u32::from(byte)));
    }

    /// The sum.
    #[must_use]
    pub fn finalize(self) -> u32 {
        self.sum
    }

    /// Forgets all bytes.
    pub fn reset(&mut self) {
        *self = Self::new();
    }

    /// Adds at the end what another one has seen; takes as long as seeing it.
    pub fn combine(&mut self, other: &Self) {
        self.sum = (0..other.length).fold(self.sum, |rest, _| after_byte(rest)) ^ other.sum;
        self.length += other.length;
    }
}

fn after_byte(rest: u32) -> u32 {
    [(); 2].iter().fold(rest, |rest, ()| (rest >> 4) ^ TABLE[(rest & 15) as usize])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sum(bytes: &[u8]) -> Hasher {
        let mut hasher = Hasher::new();
        hasher.update(bytes);
        hasher
    }

    /// The check value of the catalogue of CRCs, and the sum of the chunk that ends each PNG.
    #[test]
    fn sums_are_those_of_the_standard() {
        assert_eq!(sum(b"123456789").finalize(), 0xcbf4_3926);
        assert_eq!(sum(b"IEND").finalize(), 0xae42_6082);
        assert_eq!(sum(b"").finalize(), 0);
    }

    #[test]
    fn parts_have_the_sum_of_the_whole() {
        let whole = sum(b"an amoeba and its meal").finalize();
        let mut parts = sum(b"an amoeba ");
        parts.update(b"and ");
        parts.combine(&sum(b"its meal"));
        assert_eq!(parts.clone().finalize(), whole);
        parts.reset();
        parts.update(b"an amoeba and its meal");
        assert_eq!(parts.finalize(), whole);
    }
}
