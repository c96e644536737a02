use rayon::prelude::*;

/// Two maps at the same colours.
pub(super) struct Compared<'a> {
    pub(super) colours: &'a [[f64; 3]],
    pub(super) reference: &'a [[f64; 3]],
    pub(super) candidate: &'a [[f64; 3]],
}

impl Compared<'_> {
    /// In the order of the colours, whatever the threads.
    pub(super) fn differences(&self, difference: &(impl Fn(&[f64; 3], &[f64; 3]) -> f64 + Sync)) -> Vec<f64> {
        self.reference.par_iter().zip(self.candidate).map(|(a, b)| difference(a, b)).collect()
    }
}
