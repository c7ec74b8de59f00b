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

    /// AVX2 in place of AVX-512, with which the compiler makes slower code of some loops.
    pub(crate) fn narrow(self) -> Self {
        #[cfg(target_arch = "x86_64")]
        if self == InstructionSet::Avx512 {
            return InstructionSet::Avx2;
        }
        self
    }

    /// Does `work` with the instructions of this version. The closure and all that it calls must be
    /// `#[inline(always)]`, because only what becomes a part of this function is compiled for them.
    #[inline(always)]
    pub(crate) fn run<R>(self, work: impl FnOnce() -> R) -> R {
        self.run_known(
            #[inline(always)]
            |_| work(),
        )
    }

    /// The same for work that asks for the version: the compiler knows it, and leaves out what belongs to others.
    #[inline(always)]
    pub(crate) fn run_known<R>(self, work: impl FnOnce(Self) -> R) -> R {
        match self {
            InstructionSet::Portable => work(InstructionSet::Portable),
            // SAFETY: here and below, these variants are only made after the features were detected.
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => unsafe { with_avx2(work) },
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => unsafe { with_avx512(work) },
        }
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

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn with_avx2<R>(work: impl FnOnce(InstructionSet) -> R) -> R {
    work(InstructionSet::Avx2)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl")]
fn with_avx512<R>(work: impl FnOnce(InstructionSet) -> R) -> R {
    work(InstructionSet::Avx512)
}

/// Names the vector instructions that the filaments' step uses on this machine. The results have the same bits with
/// all of them.
pub fn instructions() -> &'static str {
    InstructionSet::detect().name()
}
