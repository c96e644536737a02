use rayon::prelude::*;

/// A map of colours, called from all threads. What is measured is handed on behind these, so that programs with many maps compile
/// the measuring once.
pub(super) type Map<'a> = &'a (dyn Fn([f64; 3]) -> [f64; 3] + Sync);

/// How far two colours lie apart, called from all threads.
pub(super) type Difference<'a> = &'a (dyn Fn(&[f64; 3], &[f64; 3]) -> f64 + Sync);

/// Told how much was done, from any thread.
pub(super) type OnProgress<'a> = &'a (dyn Fn(usize) + Sync);

/// Two maps at the same colours.
pub(super) struct Compared<'a> {
    pub(super) colours: &'a [[f64; 3]],
    pub(super) reference: &'a [[f64; 3]],
    pub(super) candidate: &'a [[f64; 3]],
}

impl Compared<'_> {
    /// In the order of the colours, whatever the threads.
    pub(super) fn differences(&self, difference: Difference<'_>) -> Vec<f64> {
        self.reference.par_iter().zip(self.candidate).map(|(a, b)| difference(a, b)).collect()
    }
}
