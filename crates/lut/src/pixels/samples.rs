use half::f16;

/// The samples of a picture, whichever type they have.
///
/// The loops that cut a picture up take these, so that they are compiled once and not for each pair of types.
#[derive(Clone, Copy)]
pub enum Samples<'a> {
    F32(&'a [f32]),
    F16(&'a [f16]),
    U16(&'a [u16]),
    U8(&'a [u8]),
}

/// [`Samples`] that can be written.
pub enum SamplesMut<'a> {
    F32(&'a mut [f32]),
    F16(&'a mut [f16]),
    U16(&'a mut [u16]),
    U8(&'a mut [u8]),
}

impl Samples<'_> {
    /// The first `count` samples and the rest; fewer where there are fewer.
    pub(super) fn split_at(self, count: usize) -> (Self, Self) {
        match self {
            Self::F32(samples) => pair(samples.split_at(count.min(samples.len())), Self::F32),
            Self::F16(samples) => pair(samples.split_at(count.min(samples.len())), Self::F16),
            Self::U16(samples) => pair(samples.split_at(count.min(samples.len())), Self::U16),
            Self::U8(samples) => pair(samples.split_at(count.min(samples.len())), Self::U8),
        }
    }
}

impl SamplesMut<'_> {
    pub(super) fn len(&self) -> usize {
        match self {
            Self::F32(samples) => samples.len(),
            Self::F16(samples) => samples.len(),
            Self::U16(samples) => samples.len(),
            Self::U8(samples) => samples.len(),
        }
    }

    /// The first `count` samples and the rest; fewer where there are fewer.
    pub(super) fn split_at(self, count: usize) -> (Self, Self) {
        let count = count.min(self.len());
        match self {
            Self::F32(samples) => pair(samples.split_at_mut(count), Self::F32),
            Self::F16(samples) => pair(samples.split_at_mut(count), Self::F16),
            Self::U16(samples) => pair(samples.split_at_mut(count), Self::U16),
            Self::U8(samples) => pair(samples.split_at_mut(count), Self::U8),
        }
    }

    /// The same samples, to be read.
    pub(super) fn as_samples(&self) -> Samples<'_> {
        match self {
            Self::F32(samples) => Samples::F32(samples),
            Self::F16(samples) => Samples::F16(samples),
            Self::U16(samples) => Samples::U16(samples),
            Self::U8(samples) => Samples::U8(samples),
        }
    }
}

fn pair<S, T>((head, tail): (S, S), of: impl Fn(S) -> T) -> (T, T) {
    (of(head), of(tail))
}
