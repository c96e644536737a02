/// The value at `at` of the straight lines through the points `(x(i), y[i])`, `None` outside them; `x` increases.
pub(crate) fn linear_at(x: impl Fn(usize) -> f64, y: &[f64], at: f64) -> Option<f64> {
    let last = y.len().checked_sub(1)?;
    if last == 0 || !(x(0)..=x(last)).contains(&at) {
        return (last == 0 && x(0) == at).then(|| y[0]);
    }
    let (mut low, mut high) = (0, last);
    while high - low > 1 {
        let middle = low.midpoint(high);
        if x(middle) <= at { low = middle } else { high = middle }
    }
    Some(y[low] + (at - x(low)) / (x(high) - x(low)) * (y[high] - y[low]))
}
