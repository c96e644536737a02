use super::direction::Direction;

/// The monotone sequence nearest to `values` in least squares: pool adjacent violators.
pub(crate) fn isotonic(values: &[f64], direction: Direction) -> Vec<f64> {
    let sign = direction.sign();
    // Blocks of pooled values: sum and count.
    let mut blocks: Vec<(f64, usize)> = Vec::with_capacity(values.len());
    for &value in values {
        blocks.push((sign * value, 1));
        while let [.., (sum_a, count_a), (sum_b, count_b)] = blocks[..]
            && sum_a / count_a as f64 > sum_b / count_b as f64
        {
            blocks.truncate(blocks.len() - 2);
            blocks.push((sum_a + sum_b, count_a + count_b));
        }
    }
    let pooled = blocks.iter().flat_map(|&(sum, count)| std::iter::repeat_n((sum, count), count));
    // A block of one keeps its value to the bit.
    pooled.map(|(sum, count)| sign * if count == 1 { sum } else { sum / count as f64 }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_what_is_monotone_and_pools_the_rest() {
        let rising = [0.1, 0.2, 0.2, 0.9];
        assert_eq!(isotonic(&rising, Direction::Rising), rising);
        assert_eq!(isotonic(&[1.0, 3.0, 2.0, 4.0], Direction::Rising), [1.0, 2.5, 2.5, 4.0]);
        assert_eq!(isotonic(&[4.0, 2.0, 3.0, 1.0], Direction::Falling), [4.0, 2.5, 2.5, 1.0]);
        assert_eq!(isotonic(&[3.0, 2.0, 1.0], Direction::Rising), [2.0, 2.0, 2.0]);
    }
}
