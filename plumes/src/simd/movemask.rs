//! Which of 32 places a loop of vector code has marked, as the bits of one word.
//!
//! From a sum of shifted bits the compiler makes a chain of ten instructions; SSE2, which is part of every x86-64, has
//! one for each sixteen places.

#[cfg(target_arch = "x86_64")]
use std::arch::x86_64 as x86;

/// A byte for each place.
pub(crate) type LaneMask = [u8; 32];

/// What a loop writes for a place: all ones if it is marked.
#[inline(always)]
pub(crate) fn mark(marked: bool) -> u8 {
    u8::from(marked).wrapping_neg()
}

/// The marks as bits, the first place in the last one.
#[inline(always)]
pub(crate) fn bits(marks: &LaneMask) -> u32 {
    #[cfg(target_arch = "x86_64")]
    {
        let [low, high] = [0, 16].map(|from| {
            // SAFETY: reads sixteen of the 32 bytes at any alignment.
            let bits = unsafe { x86::_mm_movemask_epi8(x86::_mm_loadu_si128(marks.as_ptr().add(from).cast())) };
            bits.cast_unsigned()
        });
        low | high << 16
    }
    #[cfg(not(target_arch = "x86_64"))]
    marks.iter().enumerate().fold(0, |all, (l, mark)| all | u32::from(mark & 1) << l)
}
