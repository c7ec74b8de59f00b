//! Which of 32 places a loop of vector code has marked, as the bits of one word.
//!
//! From a sum of shifted bits the compiler makes a chain of ten instructions; the processor has one for
//! each four to sixteen places.

#[cfg(target_arch = "x86_64")]
use std::arch::x86_64 as x86;

/// A word for each place.
pub(crate) type LaneMask = [u32; 32];

/// What a loop writes for a place: all ones if it is marked.
#[inline(always)]
pub(crate) fn mark(marked: bool) -> u32 {
    u32::from(marked).wrapping_neg()
}

/// The instructions that make bits of marks.
pub(crate) trait Movemask {
    /// The marks as bits, the first place in the last one.
    ///
    /// # Safety
    /// The machine must have these instructions.
    unsafe fn bits(marks: &LaneMask) -> u32;
}

/// Those of every machine.
pub(crate) struct Portable;

impl Movemask for Portable {
    #[inline(always)]
    unsafe fn bits(marks: &LaneMask) -> u32 {
        let bits = marks.iter().enumerate().map(|(l, mark)| mark & (1 << l));
        bits.fold(0, |all, one| all | one)
    }
}

/// Those of AVX2.
#[cfg(target_arch = "x86_64")]
pub(crate) struct Avx2;

#[cfg(target_arch = "x86_64")]
impl Movemask for Avx2 {
    #[inline(always)]
    unsafe fn bits(marks: &LaneMask) -> u32 {
        let mut all = 0;
        for (n, eight) in marks.as_chunks::<8>().0.iter().enumerate() {
            // SAFETY: reads eight words at any alignment; the caller promises AVX2.
            let bits = unsafe { x86::_mm256_movemask_ps(x86::_mm256_loadu_ps(eight.as_ptr().cast())) };
            all |= bits.cast_unsigned() << (8 * n);
        }
        all
    }
}

/// Those of AVX-512.
#[cfg(target_arch = "x86_64")]
pub(crate) struct Avx512;

#[cfg(target_arch = "x86_64")]
impl Movemask for Avx512 {
    #[inline(always)]
    unsafe fn bits(marks: &LaneMask) -> u32 {
        let mut all = 0;
        for (n, some) in marks.as_chunks::<16>().0.iter().enumerate() {
            // SAFETY: reads sixteen words at any alignment; the caller promises AVX-512.
            let bits = unsafe {
                let some = x86::_mm512_loadu_si512(some.as_ptr().cast());
                x86::_mm512_test_epi32_mask(some, some)
            };
            all |= u32::from(bits) << (16 * n);
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::dispatch::InstructionSet;

    #[test]
    fn bits_are_the_marked_places() {
        let mut r = world::seeds::Stream::new(1, "test", "marks");
        for n in 0..1000 {
            let want = match n {
                0 => 0,
                1 => u32::MAX,
                _ => (r.uniform() * f64::from(u32::MAX)) as u32,
            };
            let marks: LaneMask = std::array::from_fn(|l| mark(want >> l & 1 == 1));
            for path in InstructionSet::all() {
                // SAFETY: only versions that this machine can run.
                let bits = unsafe {
                    match path {
                        InstructionSet::Portable => Portable::bits(&marks),
                        #[cfg(target_arch = "x86_64")]
                        InstructionSet::Avx2 => Avx2::bits(&marks),
                        #[cfg(target_arch = "x86_64")]
                        InstructionSet::Avx512 => Avx512::bits(&marks),
                    }
                };
                assert_eq!(bits, want, "{path:?}");
            }
        }
    }
}
