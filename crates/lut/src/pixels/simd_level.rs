use fearless_simd::Level;

/// A processor's vector instructions. Pixel loops take the best ones by themselves; results differ by rounding.
///
/// Builds with debug assertions have none for SSE4.2, and machines with it run those for SSE2.
///
/// For renders that must be the same to the bit on different machines, and for measuring by how much they are not.
///
/// ```
/// # use onelight_lut::SimdLevel;
/// assert!(!SimdLevel::available().is_empty());
/// println!("{}", SimdLevel::best().name());
/// ```
#[derive(Clone, Copy, Debug)]
pub struct SimdLevel(Level);

impl SimdLevel {
    /// The best instructions that this machine has and the pixel loops are compiled for.
    pub fn best() -> Self {
        let level = Level::new();
        #[cfg(all(any(target_arch = "x86", target_arch = "x86_64"), debug_assertions, not(feature = "all-levels")))]
        if let (Level::Sse4_2(_), Some(sse2)) = (level, level.as_sse2()) {
            return Self(Level::Sse2(sse2));
        }
        Self(level)
    }

    /// All of them that this machine can run, the best last: the first is what every machine of its kind has.
    pub fn available() -> Vec<Self> {
        let mut all = Vec::new();
        #[cfg(feature = "all-levels")]
        all.push(Level::fallback());
        let best = Self::best().0;
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        {
            all.extend(best.as_sse2().map(Level::Sse2));
            #[cfg(any(not(debug_assertions), feature = "all-levels"))]
            all.extend(best.as_sse4_2().map(Level::Sse4_2));
            all.extend(best.as_avx2().map(Level::Avx2));
            all.extend(best.as_avx512().map(Level::Avx512));
        }
        if all.last().is_none_or(|last| std::mem::discriminant(last) != std::mem::discriminant(&best)) {
            all.push(best);
        }
        all.into_iter().map(Self).collect()
    }

    /// Their name: `SSE2`, `SSE4.2`, `AVX2`, `AVX-512`, `NEON`, `SIMD128`, or `none`.
    pub fn name(self) -> &'static str {
        match self.0 {
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Sse2(_) => "SSE2",
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Sse4_2(_) => "SSE4.2",
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Avx2(_) => "AVX2",
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Avx512(_) => "AVX-512",
            #[cfg(target_arch = "aarch64")]
            Level::Neon(_) => "NEON",
            #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
            Level::WasmSimd128(_) => "SIMD128",
            _ => "none",
        }
    }

    /// The level that the pixel loops dispatch on.
    pub(super) fn level(self) -> Level {
        self.0
    }
}
