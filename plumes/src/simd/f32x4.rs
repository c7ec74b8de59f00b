//! Four f32 side by side: the four numbers at a node of the flow grid.
//!
//! *Source*: none. On its own, the compiler puts four filaments side by side and then fetches every number of every
//! node separately, which halves the speed. SSE2 is part of every x86-64.
//!
//! *Parameters*: none.
//!
//! *Deviations*: on other machines these are plain arrays, with the same operations in the same order, hence the same
//! bits.

#[cfg(target_arch = "x86_64")]
use std::arch::x86_64 as x86;

/// Four f32.
#[derive(Clone, Copy)]
#[cfg(target_arch = "x86_64")]
pub(crate) struct F32x4(x86::__m128);

#[cfg(target_arch = "x86_64")]
impl F32x4 {
    #[inline(always)]
    pub(crate) fn new(v: &[f32; 4]) -> Self {
        // SAFETY: reads four f32 at any alignment.
        Self(unsafe { x86::_mm_loadu_ps(v.as_ptr()) })
    }

    #[inline(always)]
    pub(crate) fn add(self, b: Self) -> Self {
        // SAFETY: SSE is part of every x86-64.
        unsafe { Self(x86::_mm_add_ps(self.0, b.0)) }
    }

    #[inline(always)]
    pub(crate) fn sub(self, b: Self) -> Self {
        // SAFETY: SSE is part of every x86-64.
        unsafe { Self(x86::_mm_sub_ps(self.0, b.0)) }
    }

    #[inline(always)]
    pub(crate) fn times(self, s: f32) -> Self {
        // SAFETY: SSE is part of every x86-64.
        unsafe { Self(x86::_mm_mul_ps(self.0, x86::_mm_set1_ps(s))) }
    }

    /// As numbers.
    #[inline(always)]
    pub(crate) fn array(self) -> [f32; 4] {
        let mut out = [0.0; 4];
        // SAFETY: writes four f32 at any alignment.
        unsafe { x86::_mm_storeu_ps(out.as_mut_ptr(), self.0) };
        out
    }

    /// Four quads as rows become columns.
    #[inline(always)]
    pub(crate) fn columns(r: [Self; 4]) -> [[f32; 4]; 4] {
        // SAFETY: SSE is part of every x86-64.
        let rows = unsafe {
            let ab = x86::_mm_unpacklo_ps(r[0].0, r[1].0);
            let cd = x86::_mm_unpacklo_ps(r[2].0, r[3].0);
            let ef = x86::_mm_unpackhi_ps(r[0].0, r[1].0);
            let gh = x86::_mm_unpackhi_ps(r[2].0, r[3].0);
            [
                x86::_mm_movelh_ps(ab, cd),
                x86::_mm_movehl_ps(cd, ab),
                x86::_mm_movelh_ps(ef, gh),
                x86::_mm_movehl_ps(gh, ef),
            ]
        };
        let mut out = [[0.0; 4]; 4];
        for d in 0..4 {
            // SAFETY: writes four f32 at any alignment.
            unsafe { x86::_mm_storeu_ps(out[d].as_mut_ptr(), rows[d]) };
        }
        out
    }
}

/// Four f32.
#[derive(Clone, Copy)]
#[cfg(not(target_arch = "x86_64"))]
pub(crate) struct F32x4([f32; 4]);

#[cfg(not(target_arch = "x86_64"))]
impl F32x4 {
    #[inline(always)]
    pub(crate) fn new(v: &[f32; 4]) -> Self {
        Self(*v)
    }

    #[inline(always)]
    pub(crate) fn add(self, b: Self) -> Self {
        Self(std::array::from_fn(|d| self.0[d] + b.0[d]))
    }

    #[inline(always)]
    pub(crate) fn sub(self, b: Self) -> Self {
        Self(std::array::from_fn(|d| self.0[d] - b.0[d]))
    }

    #[inline(always)]
    pub(crate) fn times(self, s: f32) -> Self {
        Self(self.0.map(|v| v * s))
    }

    /// As numbers.
    #[inline(always)]
    pub(crate) fn array(self) -> [f32; 4] {
        self.0
    }

    /// Four quads as rows become columns.
    #[inline(always)]
    pub(crate) fn columns(r: [Self; 4]) -> [[f32; 4]; 4] {
        std::array::from_fn(|d| std::array::from_fn(|n| r[n].0[d]))
    }
}

/// Asks the processor to fetch a value of a table that will be read soon; without effect on any result.
#[inline(always)]
pub(crate) fn fetch_soon<T>(table: &[T], n: usize) {
    #[cfg(target_arch = "x86_64")]
    if let Some(value) = table.get(n) {
        // SAFETY: SSE is part of every x86-64, and the address is that of a value.
        unsafe { x86::_mm_prefetch::<{ x86::_MM_HINT_T0 }>(std::ptr::from_ref(value).cast()) };
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (table, n);
}

/// Two quads, such as the numbers at two levels of a column.
pub(crate) trait Pair: Copy {
    /// Reads both.
    ///
    /// # Safety
    /// The machine must have the instructions that this pair uses.
    unsafe fn new(a: &[f32; 4], b: &[f32; 4]) -> Self;

    fn add(self, b: Self) -> Self;

    fn times(self, s: f32) -> Self;

    fn apart(self) -> [F32x4; 2];
}

/// A pair on any machine.
impl Pair for [F32x4; 2] {
    #[inline(always)]
    unsafe fn new(a: &[f32; 4], b: &[f32; 4]) -> Self {
        [F32x4::new(a), F32x4::new(b)]
    }

    #[inline(always)]
    fn add(self, b: Self) -> Self {
        [self[0].add(b[0]), self[1].add(b[1])]
    }

    #[inline(always)]
    fn times(self, s: f32) -> Self {
        self.map(
            #[inline(always)]
            |v| v.times(s),
        )
    }

    #[inline(always)]
    fn apart(self) -> [F32x4; 2] {
        self
    }
}

/// A pair in one register of AVX.
#[derive(Clone, Copy)]
#[cfg(target_arch = "x86_64")]
pub(crate) struct AvxPair(x86::__m256);

#[cfg(target_arch = "x86_64")]
impl Pair for AvxPair {
    #[inline(always)]
    unsafe fn new(a: &[f32; 4], b: &[f32; 4]) -> Self {
        // SAFETY: reads four f32 twice at any alignment; the caller promises AVX.
        Self(unsafe { x86::_mm256_loadu2_m128(b.as_ptr(), a.as_ptr()) })
    }

    #[inline(always)]
    fn add(self, b: Self) -> Self {
        // SAFETY: whoever made the pair promised AVX.
        Self(unsafe { x86::_mm256_add_ps(self.0, b.0) })
    }

    #[inline(always)]
    fn times(self, s: f32) -> Self {
        // SAFETY: as above.
        Self(unsafe { x86::_mm256_mul_ps(self.0, x86::_mm256_set1_ps(s)) })
    }

    #[inline(always)]
    fn apart(self) -> [F32x4; 2] {
        // SAFETY: as above.
        unsafe { [F32x4(x86::_mm256_castps256_ps128(self.0)), F32x4(x86::_mm256_extractf128_ps::<1>(self.0))] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arithmetic_is_lane_by_lane() {
        let a = F32x4::new(&[1.0, 2.0, 3.0, 4.0]);
        let b = F32x4::new(&[0.5, -1.0, 8.0, 0.25]);
        let got = F32x4::columns([a.add(b), a.sub(b), a.times(3.0), b]);
        for (d, (x, y)) in [(1.0, 0.5), (2.0, -1.0), (3.0, 8.0), (4.0, 0.25)].into_iter().enumerate() {
            assert_eq!(got[d], [x + y, x - y, x * 3.0, y]);
        }
        assert_eq!(b.array(), [0.5, -1.0, 8.0, 0.25]);
    }
}
