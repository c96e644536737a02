//! The pixel loops: each step of a form over a block of pixels, one colour channel after the other, on whatever vector
//! instructions the machine has.
//!
//! A step is written once for all levels (SSE2 to AVX-512, NEON, WebAssembly's, none), chosen at run time; the levels differ in rounding
//! only. The scalar functions beside them are the definition.

pub(crate) mod block;
pub(crate) mod cells;
pub(crate) mod coding;
pub(crate) mod coupling;
pub(crate) mod curves;
pub(crate) mod dispatch;
pub(crate) mod expose;
mod log2_exp2;
pub(crate) mod lookup;
mod matrix;
mod pair;
pub(crate) mod steps;
pub(crate) mod sum;

/// All levels that this machine can run.
#[cfg(test)]
pub(crate) fn levels() -> Vec<fearless_simd::Level> {
    use fearless_simd::Level;

    let mut levels = vec![Level::new()];
    #[cfg(feature = "all-levels")]
    levels.push(Level::fallback());
    #[cfg(target_arch = "x86_64")]
    {
        let best = Level::new();
        levels.extend(best.as_sse2().map(Level::Sse2));
        levels.extend(best.as_sse4_2().map(Level::Sse4_2));
        levels.extend(best.as_avx2().map(Level::Avx2));
    }
    levels
}
