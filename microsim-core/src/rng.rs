//! Random numbers: one PCG-XSH-RR 64/32 generator per organism, kept in the world's state
//! (O'Neill 2014, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms").

use serde::{Deserialize, Serialize};

/// A generator; equal seed and stream give equal numbers on every platform.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Rng {
    pub(crate) state: u64,
    pub(crate) increment: u64,
}

const MULTIPLIER: u64 = 6_364_136_223_846_793_005;

impl Rng {
    /// The generator of stream `stream` under `seed`; streams are independent.
    #[must_use]
    pub fn new(seed: u64, stream: u64) -> Self {
        let mut rng = Self { state: 0, increment: (stream << 1) | 1 };
        rng.next_u32();
        rng.state = rng.state.wrapping_add(seed);
        rng.next_u32();
        rng
    }

    /// Whether its increment is odd, as that of all but forged ones: else numbers repeat soon, and [`Rng::normal`] need not end.
    pub(crate) fn is_sound(&self) -> bool {
        self.increment % 2 == 1
    }

    /// The next 32 random bits.
    pub fn next_u32(&mut self) -> u32 {
        let old = self.state;
        self.state = old.wrapping_mul(MULTIPLIER).wrapping_add(self.increment);
        let folded = (((old >> 18) ^ old) >> 27) as u32;
        folded.rotate_right((old >> 59) as u32)
    }

    /// Uniform in `[0, 1)`, in steps of 2^-24.
    pub fn unit(&mut self) -> f32 {
        (self.next_u32() >> 8) as f32 / 16_777_216.0
    }

    /// Uniform in `[low, high)`.
    pub fn range(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    /// Exponential with mean 1: the time to the next of events that happen at a rate of 1.
    pub fn exponential(&mut self) -> f32 {
        -libm::logf(1.0 - self.unit())
    }

    /// Normal with mean 0 and standard deviation 1 (polar method, Marsaglia and Bray 1964; the second deviate is dropped, so
    /// that the state is the generator alone).
    pub fn normal(&mut self) -> f32 {
        loop {
            let (x, y) = (self.range(-1.0, 1.0), self.range(-1.0, 1.0));
            let square = x * x + y * y;
            if square > 0.0 && square < 1.0 {
                return x * (-2.0 * libm::logf(square) / square).sqrt();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reference_stream_of_the_pcg_paper() {
        // First outputs of pcg32_srandom(42, 54), as printed by the reference implementation's demo.
        let mut rng = Rng::new(42, 54);
        let first: Vec<u32> = (0..6).map(|_| rng.next_u32()).collect();
        assert_eq!(first, [0xa15c_02b7, 0x7b47_f409, 0xba1d_3330, 0x83d2_f293, 0xbfa4_784b, 0xcbed_606e]);
    }

    #[test]
    fn numbers_stay_in_range_and_vary() {
        let mut rng = Rng::new(1, 2);
        let numbers: Vec<f32> = (0..1000).map(|_| rng.range(-2.0, 3.0)).collect();
        assert!(numbers.iter().all(|n| (-2.0..3.0).contains(n)));
        let mean = numbers.iter().sum::<f32>() / 1000.0;
        assert!((mean - 0.5).abs() < 0.2, "mean {mean}");
    }

    #[test]
    fn deviates_have_their_moments() {
        let mut rng = Rng::new(3, 4);
        let moments = |next: &mut dyn FnMut() -> f32| {
            let numbers: Vec<f64> = (0..40_000).map(|_| f64::from(next())).collect();
            [1, 2, 4].map(|power| numbers.iter().map(|n| n.powi(power)).sum::<f64>() / 40_000.0)
        };
        let [mean, square, fourth] = moments(&mut || rng.normal());
        assert!(
            mean.abs() < 0.02 && (square - 1.0).abs() < 0.02 && (fourth - 3.0).abs() < 0.2,
            "{mean} {square} {fourth}"
        );
        let [mean, square, _] = moments(&mut || rng.exponential());
        assert!((mean - 1.0).abs() < 0.02 && (square - 2.0).abs() < 0.1, "{mean} {square}");
    }
}
