//! The floating-point environment: how results are rounded, whether subnormal numbers count as zero, what traps. Each thread
//! has its own, and a host may have changed it (audio libraries flush subnormals to zero), which would change results silently.
//! What computes state therefore runs in the default one: to nearest, with subnormals, without traps.

use std::hint::black_box;

/// Runs `work` in the default floating-point environment, and then restores the caller's, in a panic too.
///
/// The library does so itself, from reading a scenario to the step. It is public for what a host computes that ends in a world:
/// places, poses of obstacles, nodes of templates, goals.
///
/// ```
/// use microsim_core::{Intent, glam::Vec2, with_default_float_environment};
///
/// let goal = with_default_float_environment(|| Vec2::new(20.0, 10.0) / 3.0);
/// let intent = Intent::toward(goal)?;
/// # Ok::<(), microsim_core::Error>(())
/// ```
///
/// x86 with SSE2, x86-64 and AArch64 have control registers that this sets; elsewhere, as in WebAssembly, it does nothing.
pub fn with_default_float_environment<W: FnOnce() -> R, R>(work: W) -> R {
    let _callers = Restore(register::read());
    register::write(register::DEFAULT);
    // The compiler knows of no environment and may move arithmetic past such writes, but not this call: through a pointer
    // whose target is hidden from it, it may do anything, as the writes may, so they keep their order.
    black_box(call::<W, R> as fn(W) -> R)(work)
}

#[inline(never)]
fn call<W: FnOnce() -> R, R>(work: W) -> R {
    work()
}

/// Sets the register to this when it goes.
struct Restore(register::Value);

impl Drop for Restore {
    fn drop(&mut self) {
        register::write(self.0);
    }
}

#[cfg(any(target_arch = "x86_64", all(target_arch = "x86", target_feature = "sse2")))]
#[expect(unsafe_code, reason = "no safe function reads or writes the control register")]
mod register {
    use std::arch::asm;

    /// MXCSR (Intel 64 manual, volume 1, 10.2.3).
    pub(super) type Value = u32;

    /// To nearest, subnormals kept, all exceptions masked: as a process starts.
    pub(super) const DEFAULT: Value = 0x1f80;

    pub(super) fn read() -> Value {
        let mut value = 0;
        // SAFETY: stores four bytes, in `value`.
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut value, options(nostack, preserves_flags)) };
        value
    }

    /// Sets the register to the default, or back to what was read.
    pub(super) fn write(value: Value) {
        // SAFETY: loads four bytes, of `value`; no reserved bit is set in what was read or in the default, so it cannot trap.
        // Compiled code assumes the default; another environment comes back only where the caller was already in it.
        unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const value, options(nostack)) };
    }
}

#[cfg(target_arch = "aarch64")]
#[expect(unsafe_code, reason = "no safe function reads or writes the control register")]
mod register {
    use std::arch::asm;

    /// FPCR (Arm Architecture Reference Manual, C5.2).
    pub(super) type Value = u64;

    /// To nearest, subnormals kept, nothing traps.
    pub(super) const DEFAULT: Value = 0;

    pub(super) fn read() -> Value {
        let value;
        // SAFETY: reads a register that every program may read.
        unsafe { asm!("mrs {}, fpcr", out(reg) value, options(nostack, preserves_flags)) };
        value
    }

    /// Sets the register to the default, or back to what was read.
    pub(super) fn write(value: Value) {
        // SAFETY: writes a register that every program may write.
        // Compiled code assumes the default; another environment comes back only where the caller was already in it.
        unsafe { asm!("msr fpcr, {}", in(reg) value, options(nostack)) };
    }
}

#[cfg(not(any(target_arch = "x86_64", all(target_arch = "x86", target_feature = "sse2"), target_arch = "aarch64")))]
mod register {
    pub(super) type Value = ();

    pub(super) const DEFAULT: Value = ();

    pub(super) fn read() -> Value {}

    pub(super) fn write((): Value) {}
}
