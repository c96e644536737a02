use super::noise::{DROPPED_BITS, NoiseKey, white};

/// `a -> a + (s + t ds) z + (m + t dm)`, z the field of [`GrainNumbers::field`] times `scale`, the rest from the interval of a table in
/// which the amount lies.
#[derive(Debug, Clone, PartialEq)]
pub struct GrainNumbers {
    /// Another seed, another pattern.
    pub seed: u32,
    /// Taps along x and y: that of the pixel itself, then those at distance 1, 2, and so on.
    pub taps: [Vec<i32>; 2],
    /// What makes the standard deviation of the field 1.
    pub scale: f32,
    /// For each layer, the amount at which its table begins, and intervals in a unit of amount.
    pub axes: [[f32; 2]; 3],
    /// For each layer, s, ds, m and dm of each interval; outside the ends hold.
    pub intervals: [Vec<[f32; 4]>; 3],
}

impl GrainNumbers {
    /// The integer field of `size` pixels from `place` on, counted from the frame's origin: what must come out the same to the bit, whoever
    /// makes it. Frame `number` of a sequence.
    ///
    /// With taps of 256 alone each number is 256 times that of the hash, over 64 between the axes:
    ///
    /// ```
    /// use onelight_spatial::GrainNumbers;
    /// let white = GrainNumbers { seed: 0, taps: [vec![256], vec![256]], scale: 1.0, axes: [[0.0, 1.0]; 3], intervals: Default::default() };
    /// assert_eq!(white.field([0, 0], [1, 1], 0), [[927, 3789, -411].map(|z| z * 4 * 256)]);
    /// ```
    #[must_use]
    pub fn field(&self, [x, y]: [i32; 2], [width, height]: [u32; 2], number: u32) -> Vec<[i32; 3]> {
        let key = NoiseKey { frame: number, seed: self.seed };
        let [along_x, along_y] = &self.taps;
        let sum = |taps: &[i32], at: &dyn Fn(i32) -> [i32; 3]| {
            let own = at(0).map(|z| z.wrapping_mul(taps[0]));
            (1..).zip(&taps[1..]).fold(own, |sum, (d, tap)| {
                let (before, after) = (at(-d), at(d));
                std::array::from_fn(|k| sum[k].wrapping_add(tap.wrapping_mul(before[k].wrapping_add(after[k]))))
            })
        };
        let pixel = |i: u32| {
            let (x, y) = (x.wrapping_add((i % width) as i32), y.wrapping_add((i / width) as i32));
            let row = |dy: i32| {
                let white = |dx: i32| white(x.wrapping_add(dx) as u32, y.wrapping_add(dy) as u32, key);
                sum(along_x, &white).map(|z| z.wrapping_add(1 << (DROPPED_BITS - 1)) >> DROPPED_BITS)
            };
            sum(along_y, &row)
        };
        (0..width * height).map(pixel).collect()
    }
}
