use fearless_simd::Level;

/// A processor's vector instructions. Pixel loops take the best ones by themselves; results differ by rounding.
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
    /// The best instructions that this machine has.
    pub fn best() -> Self {
        Self(Level::new())
    }

    /// All that this machine can run: the first is what every machine of its kind has.
    pub fn available() -> Vec<Self> {
        let best = Level::new();
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        {
            let mut all = Vec::new();
            all.extend(best.as_sse2().map(Level::Sse2));
            all.extend(best.as_sse4_2().map(Level::Sse4_2));
            all.extend(best.as_avx2().map(Level::Avx2));
            all.extend(best.as_avx512().map(Level::Avx512));
            if !all.is_empty() {
                return all.into_iter().map(Self).collect();
            }
        }
        vec![Self(best)]
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
