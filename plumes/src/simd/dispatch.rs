//! The versions of the vector code, of which a machine runs the fastest that it can. All give the same bits.
//!
//! The arithmetic is written once, without fused multiply-add, and compiled for each version.

/// Which version of the vector code runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum InstructionSet {
    /// Runs on every machine of the target.
    Portable,
    /// AVX2.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// AVX-512 with its foundation, byte and word, doubleword and quadword instructions, at all vector lengths.
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl InstructionSet {
    /// The versions that this machine can run, the fastest last.
    pub(crate) fn all() -> Vec<Self> {
        let mut all = vec![InstructionSet::Portable];
        #[cfg(target_arch = "x86_64")]
        {
            use std::arch::is_x86_feature_detected as has;
            if has!("avx2") {
                all.push(InstructionSet::Avx2);
            }
            if has!("avx512f") && has!("avx512bw") && has!("avx512dq") && has!("avx512vl") {
                all.push(InstructionSet::Avx512);
            }
        }
        all
    }

    /// The fastest version that this machine can run.
    pub(crate) fn detect() -> Self {
        Self::all().pop().unwrap_or(InstructionSet::Portable)
    }

    fn name(self) -> &'static str {
        match self {
            InstructionSet::Portable if cfg!(target_arch = "x86_64") => "SSE2",
            InstructionSet::Portable => "portable",
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => "AVX2",
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => "AVX-512",
        }
    }
}

/// Names the vector instructions that the filaments' step uses on this machine. The results have the same bits with
/// all of them.
#[must_use]
pub fn instructions() -> &'static str {
    InstructionSet::detect().name()
}
