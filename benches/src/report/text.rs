//! Numbers and words as they are written on the page.

/// A text with the characters that markup takes for itself replaced.
pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// About three figures: 1234, 123, 12.3, 1.23, 0.123, 0.012.
pub(super) fn figure(value: f64) -> String {
    match value.abs() {
        v if !v.is_finite() => "-".to_owned(),
        0.0 => "0".to_owned(),
        v if v >= 99.95 => format!("{value:.0}"),
        v if v >= 9.995 => format!("{value:.1}"),
        v if v >= 0.9995 => format!("{value:.2}"),
        v if v >= 0.000_95 => format!("{value:.3}"),
        _ => format!("{value:.1e}"),
    }
}

/// A round number in full, without zeros at its end.
pub(super) fn plain(value: f64) -> String {
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text.is_empty() || text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Bytes in the unit that suits them.
pub(super) fn bytes(count: usize) -> String {
    let kib = count as f64 / 1024.0;
    if kib >= 1024.0 { format!("{} MiB", figure(kib / 1024.0)) } else { format!("{} KiB", figure(kib)) }
}

/// `a, b and c`
pub(super) fn listed(words: &[String]) -> String {
    match words {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// The exponent of the power law nearest to points, in least squares of logarithms; `None` for fewer than two.
pub(super) fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let logs: Vec<(f64, f64)> =
        points.iter().filter(|(x, y)| *x > 0.0 && *y > 0.0).map(|(x, y)| (x.ln(), y.ln())).collect();
    let count = logs.len() as f64;
    let (mx, my) = logs.iter().fold((0.0, 0.0), |(a, b), (x, y)| (a + x / count, b + y / count));
    let (above, below) =
        logs.iter().fold((0.0, 0.0), |(a, b), (x, y)| (a + (x - mx) * (y - my), b + (x - mx) * (x - mx)));
    (below > 1e-12).then(|| above / below)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        for (value, expected) in [
            (0.0, "0"),
            (1234.5, "1234"),
            (99.96, "100"),
            (12.345, "12.3"),
            (1.2345, "1.23"),
            (0.12345, "0.123"),
            (0.00012, "1.2e-4"),
            (f64::NAN, "-"),
        ] {
            assert_eq!(figure(value), expected);
        }
        assert_eq!([plain(0.01), plain(1000.0), plain(0.0)], ["0.01", "1000", "0"]);
        assert_eq!([bytes(512), bytes(3 << 20)], ["0.500 KiB", "3.00 MiB"]);
    }

    #[test]
    fn a_power_law_has_its_exponent() {
        let points: Vec<(f64, f64)> = (1..9).map(|i| (f64::from(i), 7.0 * f64::from(i).powf(-1.5))).collect();
        assert!((slope(&points).unwrap() + 1.5).abs() < 1e-9);
        assert_eq!(slope(&points[..1]), None);
        assert_eq!(slope(&[(1.0, 2.0), (1.0, 3.0)]), None);
        assert_eq!(slope(&[(1.0, 0.0), (2.0, 0.0)]), None);
    }

    #[test]
    fn markup_is_escaped() {
        assert_eq!(escaped("a < b & \"c\""), "a &lt; b &amp; &quot;c&quot;");
        assert_eq!(listed(&["a".to_owned(), "b".to_owned(), "c".to_owned()]), "a, b and c");
    }
}
