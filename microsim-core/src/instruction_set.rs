//! One binary for old and new processors: kernels are compiled once for what the target has at least and once for AVX2,
//! and which one runs is decided when the world is made.
//!
//! The same source, lane by lane IEEE arithmetic that is never contracted, gives the same bits either way. All of a
//! kernel has to be inlined into the closure that is run, so whatever it calls is marked `#[inline(always)]`.

/// The instructions that stepping may use. Results are the same to the bit with each of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InstructionSet {
    /// What the binary was compiled for at least, for example SSE2 on x86-64.
    Baseline,
    /// The widest that this processor has and that there is code for: AVX2 on x86-64, otherwise the baseline.
    #[default]
    Best,
}

/// Runs kernels on an instruction set.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dispatch {
    /// Never true where the processor lacks it.
    has_avx2: bool,
}

impl Dispatch {
    pub(crate) fn new(set: InstructionSet) -> Self {
        #[cfg(target_arch = "x86_64")]
        let has_avx2 = std::arch::is_x86_feature_detected!("avx2");
        #[cfg(not(target_arch = "x86_64"))]
        let has_avx2 = false;
        Self { has_avx2: has_avx2 && set == InstructionSet::Best }
    }

    /// Runs a kernel: a closure marked `#[inline(always)]`.
    #[inline(always)]
    pub(crate) fn run<R>(self, kernel: impl FnOnce() -> R) -> R {
        // Elsewhere kernels are compiled once.
        if cfg!(target_arch = "x86_64") && self.has_avx2 { with_avx2(kernel) } else { kernel() }
    }
}

/// A value for each lane of a kernel. (`std::array::from_fn` is not always inlined, and what is not inlined is not compiled for
/// the instructions that are wanted.)
#[inline(always)]
pub(crate) fn each<const L: usize>(value: impl Fn(usize) -> f32) -> [f32; L] {
    let mut lanes = [0.0; L];
    for (l, lane) in lanes.iter_mut().enumerate() {
        *lane = value(l);
    }
    lanes
}

impl Default for Dispatch {
    fn default() -> Self {
        Self::new(InstructionSet::default())
    }
}

#[cfg(target_arch = "x86_64")]
fn with_avx2<R>(kernel: impl FnOnce() -> R) -> R {
    #[target_feature(enable = "avx2")]
    fn compiled_for_avx2<R>(kernel: impl FnOnce() -> R) -> R {
        kernel()
    }
    #[expect(unsafe_code, reason = "the only way to call code for instructions that not every processor has")]
    // SAFETY: only `Dispatch::run` calls this, and only after the processor was found to have AVX2.
    unsafe {
        compiled_for_avx2(kernel)
    }
}

#[cfg(not(target_arch = "x86_64"))]
fn with_avx2<R>(kernel: impl FnOnce() -> R) -> R {
    kernel()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Rng;

    #[test]
    fn each_set_gives_the_same_bits() {
        let mut rng = Rng::new(1, 2);
        let [a, b, c] = [(); 3].map(|()| [(); 64].map(|()| rng.range(-1e3, 1e3)));
        let of = |set| {
            let mut out = [0.0f32; 64];
            Dispatch::new(set).run(
                #[inline(always)]
                || {
                    // A contracted product and sum would round once instead of twice.
                    for k in 0..64 {
                        out[k] = (a[k] * b[k] + c[k]).abs().sqrt() / (c[k] * c[k] - a[k]);
                    }
                },
            );
            out.map(f32::to_bits)
        };
        assert_eq!(of(InstructionSet::Baseline), of(InstructionSet::Best));
    }

    #[test]
    fn the_baseline_never_runs_avx2() {
        assert!(!Dispatch::new(InstructionSet::Baseline).has_avx2);
    }
}
