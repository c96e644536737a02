use half::f16;

use crate::error::Error;
use crate::lut3d::Lut3d;

/// How the entries of a table are kept where it is used: a texture, a file.
///
/// ```
/// use onelight_lut::{Lut3d, Storage};
/// let table = Lut3d::new(2, vec![[0.0, 0.4, 1.0]; 8])?;
/// let stored = Storage::Unorm8.stored(&table)?;
/// assert_eq!(stored.entry([0, 0, 0]), Some([0.0, 102.0 / 255.0, 1.0]));
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Storage {
    /// Floats of 32 bits, as tables are held.
    #[default]
    F32,
    /// Floats of 16 bits, up to ±65504.
    F16,
    /// 16-bit integers over the range of the table's entries.
    Unorm16,
    /// 10-bit integers over that range, four bytes an entry.
    Unorm10,
    /// 8-bit integers over that range.
    Unorm8,
}

impl Storage {
    /// All of them, the largest first.
    pub const ALL: [Self; 5] = [Self::F32, Self::F16, Self::Unorm16, Self::Unorm10, Self::Unorm8];

    /// Bytes of an entry in memory: four channels, as textures have them.
    pub fn bytes(self) -> usize {
        match self {
            Self::F32 => 16,
            Self::F16 | Self::Unorm16 => 8,
            Self::Unorm10 | Self::Unorm8 => 4,
        }
    }

    /// The table as it reads once it was stored: what a deviation is measured on. Integers are rounded over the range from
    /// the smallest to the largest entry of all channels, floats to the nearest.
    ///
    /// # Errors
    /// If an entry is too large for 16-bit floats (65504).
    pub fn stored(self, table: &Lut3d) -> Result<Lut3d, Error> {
        let (low, high) = range(table);
        let codes = |count: f32| move |v: f32| low + ((v - low) / (high - low) * count).round() / count * (high - low);
        let round: Box<dyn Fn(f32) -> f32> = match self {
            Self::F32 => Box::new(|v| v),
            Self::F16 => Box::new(|v| f16::from_f32(v).to_f32()),
            // A table of one value has no range to divide.
            _ if low == high => Box::new(|v| v),
            Self::Unorm16 => Box::new(codes(65535.0)),
            Self::Unorm10 => Box::new(codes(1023.0)),
            Self::Unorm8 => Box::new(codes(255.0)),
        };
        Lut3d::new(table.size(), table.entries().map(|entry| entry.map(&round)).collect())
    }
}

/// Smallest and largest entry of all channels.
fn range(table: &Lut3d) -> (f32, f32) {
    let all = table.entries().flatten();
    all.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_stays_within_half_a_step() {
        let table = Lut3d::new(3, (0..27).map(|i| [0.1 * i as f32 - 0.7, 0.031 * i as f32, 1.0]).collect()).unwrap();
        let (low, high) = range(&table);
        for (storage, step) in [
            (Storage::F32, 0.0),
            (Storage::F16, 2e-3),
            (Storage::Unorm16, 1.0 / 65535.0),
            (Storage::Unorm10, 1.0 / 1023.0),
            (Storage::Unorm8, 1.0 / 255.0),
        ] {
            let stored = storage.stored(&table).unwrap();
            let largest = stored
                .entries()
                .flatten()
                .zip(table.entries().flatten())
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f32::max);
            assert!(largest <= 0.5 * step * (high - low) + 1e-6, "{storage:?}: {largest}");
            assert_eq!(storage.stored(&stored).unwrap(), stored, "{storage:?} twice");
        }
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let large = Lut3d::new(2, vec![[1e5; 3]; 8]).unwrap();
        assert!(Storage::F16.stored(&large).is_err());
        assert_eq!(Storage::Unorm8.stored(&large).unwrap(), large);
    }
}
