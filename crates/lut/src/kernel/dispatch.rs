//! Which of the compiled copies of a loop runs.

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
pub(crate) use x86::{Copy, dispatch};

#[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
pub(crate) use fearless_simd::dispatch;

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
mod x86 {
    use fearless_simd::{Level, x86};

    /// The copies of every loop that are compiled.
    ///
    /// fearless_simd's own `dispatch!` compiles one for SSE4.2 too, always. Dev builds leave it out and have those machines run the
    /// copy for SSE2, which takes up to twice as long: everybody who compiles gets a quarter less to do. The unit tests of this crate
    /// compile the copy for SSE2 alone; `tests/it/pixels.rs` holds all of them to their definition.
    pub(crate) enum Copy {
        #[cfg(not(test))]
        Avx512(x86::Avx512),
        #[cfg(not(test))]
        Avx2(x86::Avx2),
        #[cfg(all(not(test), any(not(debug_assertions), feature = "all-levels")))]
        Sse42(x86::Sse4_2),
        Sse2(x86::Sse2),
        #[cfg(any(feature = "all-levels", not(all(target_feature = "sse2", target_feature = "fxsr"))))]
        Fallback(fearless_simd::Fallback),
    }

    impl Copy {
        /// The best one that runs on a level.
        #[inline]
        pub(crate) fn of(level: Level) -> Self {
            #[cfg(not(test))]
            if let Some(token) = level.as_avx512() {
                return Self::Avx512(token);
            }
            #[cfg(not(test))]
            if let Some(token) = level.as_avx2() {
                return Self::Avx2(token);
            }
            #[cfg(all(not(test), any(not(debug_assertions), feature = "all-levels")))]
            if let Some(token) = level.as_sse4_2() {
                return Self::Sse42(token);
            }
            if let Some(token) = level.as_sse2() {
                return Self::Sse2(token);
            }
            #[cfg(any(feature = "all-levels", not(all(target_feature = "sse2", target_feature = "fxsr"))))]
            return Self::Fallback(fearless_simd::Fallback::new());
            #[cfg(not(any(feature = "all-levels", not(all(target_feature = "sse2", target_feature = "fxsr")))))]
            unreachable!("this is compiled for processors that have SSE2")
        }
    }

    /// Runs an expression with the token of the copy that runs on a level.
    macro_rules! dispatch {
        ($level:expr, $simd:pat => $run:expr) => {{
            use $crate::kernel::dispatch::Copy;
            macro_rules! with {
                ($token:expr) => {{
                    let token = $token;
                    let $simd = token;
                    fearless_simd::Simd::vectorize(
                        token,
                        #[inline(always)]
                        || $run,
                    )
                }};
            }
            match Copy::of($level) {
                #[cfg(not(test))]
                Copy::Avx512(token) => with!(token),
                #[cfg(not(test))]
                Copy::Avx2(token) => with!(token),
                #[cfg(all(not(test), any(not(debug_assertions), feature = "all-levels")))]
                Copy::Sse42(token) => with!(token),
                Copy::Sse2(token) => with!(token),
                #[cfg(any(feature = "all-levels", not(all(target_feature = "sse2", target_feature = "fxsr"))))]
                Copy::Fallback(token) => with!(token),
            }
        }};
    }
    pub(crate) use dispatch;
}
