//! Numbers that take as many bits as they need, one after the other, the lowest bit of each first.

/// Bits that say how many bits a number has.
const WIDTH: u32 = 6;

/// Writes bits.
#[derive(Debug, Default)]
pub(super) struct BitWriter {
    bytes: Vec<u8>,
    /// Bits of the last byte that are not yet used.
    spare: u32,
}

/// Reads what a [`BitWriter`] wrote; `None` where there is nothing left, or no number that it writes.
#[derive(Debug)]
pub(super) struct BitReader<'a> {
    bytes: &'a [u8],
    /// Place of the next bit.
    at: usize,
}

/// How many bits a number needs.
pub(super) fn width(number: u32) -> u32 {
    u32::BITS - number.leading_zeros()
}

impl BitWriter {
    /// The lowest `width` bits of a number.
    pub(super) fn put(&mut self, number: u64, width: u32) {
        for k in 0..width {
            if self.spare == 0 {
                self.bytes.push(0);
                self.spare = u8::BITS;
            }
            let byte = self.bytes.len() - 1;
            self.bytes[byte] |= ((number >> k & 1) as u8) << (u8::BITS - self.spare);
            self.spare -= 1;
        }
    }

    /// How many bits the numbers have that follow.
    pub(super) fn width(&mut self, width: u32) {
        self.put(u64::from(width), WIDTH);
    }

    /// A number and before it how many bits it has.
    pub(super) fn number(&mut self, number: u32) {
        self.width(width(number));
        self.put(u64::from(number), width(number));
    }

    /// All bits, and zeros up to the end of the last byte.
    pub(super) fn finish(self) -> Vec<u8> {
        self.bytes
    }
}

impl<'a> BitReader<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    /// A number of `width` bits, 64 at most.
    pub(super) fn get(&mut self, width: u32) -> Option<u64> {
        let mut number = 0;
        for k in 0..width {
            let byte = self.bytes.get(self.at / 8)?;
            number |= u64::from(byte >> (self.at % 8) & 1) << k;
            self.at += 1;
        }
        Some(number)
    }

    pub(super) fn flag(&mut self) -> Option<bool> {
        Some(self.get(1)? == 1)
    }

    pub(super) fn number(&mut self) -> Option<u32> {
        let width = self.width()?;
        self.get(width).map(|number| number as u32)
    }

    pub(super) fn width(&mut self) -> Option<u32> {
        self.get(WIDTH).map(|width| width as u32).filter(|&width| width <= u32::BITS)
    }

    /// Whether only zeros follow, and less than a byte of them.
    pub(super) fn is_at_end(&mut self) -> bool {
        let left = 8 * self.bytes.len() - self.at;
        left < 8 && self.get(left as u32) == Some(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn numbers_are_read_as_they_were_written(numbers in prop::collection::vec((any::<u32>(), 0u32..33), 0..40)) {
            let numbers: Vec<u32> = numbers.iter().map(|&(number, width)| (u64::from(number) >> (32 - width)) as u32).collect();
            let mut bits = BitWriter::default();
            numbers.iter().for_each(|&number| bits.number(number));
            bits.put(u64::MAX, 64);
            let expected: u32 = numbers.iter().map(|&number| WIDTH + width(number)).sum::<u32>() + 64;
            let bytes = bits.finish();
            prop_assert_eq!(bytes.len(), expected.div_ceil(8) as usize);
            let mut bits = BitReader::new(&bytes);
            for number in numbers {
                prop_assert_eq!(bits.number(), Some(number));
            }
            prop_assert_eq!(bits.get(64), Some(u64::MAX));
            prop_assert!(bits.is_at_end());
            prop_assert_eq!(bits.get(8), None);
        }
    }

    #[test]
    fn what_is_left_over_is_seen() {
        assert!(BitReader::new(&[]).is_at_end());
        assert!(!BitReader::new(&[0]).is_at_end(), "a whole byte");
        let mut bits = BitReader::new(&[0b100]);
        assert_eq!((bits.get(2), bits.is_at_end()), (Some(0), false), "a bit that is set");
        assert_eq!(BitReader::new(&[33, 0, 0, 0, 0, 0]).number(), None, "more bits than a number has");
    }
}
