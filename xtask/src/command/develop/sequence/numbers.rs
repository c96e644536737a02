//! Which frames: `1001-1100`, `1001-1010,1020`, `1001-1100x2`, `-10-10`, `1100-1001`; and which of them: `3/10`.

use std::collections::BTreeSet;
use std::str::FromStr;

use super::pattern::MAX_FRAME;

/// Numbers of frames, each once and in the order in which they were named.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct FrameNumbers(pub(super) Vec<i32>);

/// Most frames of one job: more are a mistyped number.
const MAX_FRAMES: usize = 1_000_000;

impl FromStr for FrameNumbers {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (mut numbers, mut seen) = (Vec::new(), BTreeSet::new());
        for part in text.split(',') {
            let (first, last, step) = range(part)?;
            let steps = first.abs_diff(last) / step;
            if steps as usize >= MAX_FRAMES {
                return Err(format!("found more than {MAX_FRAMES} frames"));
            }
            let way = if last < first { -1 } else { 1 };
            for number in (0..=steps).map(|index| i64::from(first) + way * i64::from(index) * i64::from(step)) {
                // Between the ends, which fit.
                let number = number as i32;
                if seen.insert(number) {
                    numbers.push(number);
                }
            }
            if numbers.len() > MAX_FRAMES {
                return Err(format!("found more than {MAX_FRAMES} frames"));
            }
        }
        Ok(Self(numbers))
    }
}

/// First, last and step of `1001`, `1001-1100`, `-10--5` or `1100-1001x2`.
fn range(part: &str) -> Result<(i32, i32, u32), String> {
    let wrong = || format!("found `{part}`, expected frames such as 1001-1100, 1001-1010,1020, 1001-1100x2 or -10-10");
    let number = |text: &str| {
        let digits = text.strip_prefix('-').unwrap_or(text);
        let is_number = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
        is_number.then(|| text.parse::<i32>().ok()).flatten().filter(|number| number.abs() <= MAX_FRAME)
    };
    let (range, step) = part.split_once('x').map_or((part, None), |(range, step)| (range, Some(step)));
    // The sign of the first number does not end it.
    let between = range.get(1..).and_then(|rest| rest.find('-')).map(|at| at + 1);
    let (first, last) = match (between, step) {
        (Some(at), _) => (&range[..at], &range[at + 1..]),
        (None, None) => (range, range),
        (None, Some(_)) => return Err(wrong()),
    };
    let step = step.map_or(Some(1), |step| number(step).filter(|step| *step > 0));
    let (Some(first), Some(last), Some(step)) = (number(first), number(last), step) else { return Err(wrong()) };
    Ok((first, last, step.unsigned_abs()))
}

/// Part `which` of `of`, counted from 1: every `of`th frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Shard {
    which: usize,
    of: usize,
}

impl Shard {
    /// Its own of a list. Neighbours go to different shards, as slow frames lie together.
    pub(super) fn of<T>(self, list: Vec<T>) -> Vec<T> {
        list.into_iter().skip(self.which - 1).step_by(self.of).collect()
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/').and_then(|(which, of)| Some((which.parse().ok()?, of.parse().ok()?)));
        match parts {
            Some((which, of)) if 1 <= which && which <= of => Ok(Self { which, of }),
            _ => Err("expected K/N with K from 1 to N, such as 3/10".to_owned()),
        }
    }
}

/// `1001-1003, 1007`, at most so many ranges of them.
pub(super) fn ranges(numbers: &[i32]) -> String {
    const SHOWN: usize = 8;
    let runs = numbers.chunk_by(|a, b| *b == *a + 1);
    let mut shown: Vec<String> = runs
        .map(|run| match run {
            [first, .., last] => format!("{first}-{last}"),
            [one] => one.to_string(),
            [] => String::new(),
        })
        .collect();
    if shown.len() > SHOWN {
        shown.truncate(SHOWN);
        shown.push("...".to_owned());
    }
    shown.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frames(text: &str) -> Vec<i32> {
        text.parse::<FrameNumbers>().unwrap().0
    }

    #[test]
    fn frames_are_read_as_renderers_write_them() {
        assert_eq!(frames("1001-1004"), [1001, 1002, 1003, 1004]);
        assert_eq!(frames("1001"), [1001]);
        assert_eq!(frames("7-7"), [7]);
        assert_eq!(frames("1001-1010x4"), [1001, 1005, 1009]);
        assert_eq!(frames("5,1-3,2-4x2,0009"), [5, 1, 2, 3, 4, 9]);
        assert_eq!(frames("999999999"), [MAX_FRAME]);
        assert_eq!(frames("-2-1"), [-2, -1, 0, 1]);
        assert_eq!(frames("-10--8,-5"), [-10, -9, -8, -5]);
        assert_eq!(frames("1004-1001"), [1004, 1003, 1002, 1001]);
        assert_eq!(frames("5--5x4"), [5, 1, -3]);
    }

    #[test]
    fn mistyped_frames_are_named() {
        let message = |text: &str| text.parse::<FrameNumbers>().unwrap_err();
        for text in [
            "",
            "a",
            "1-",
            "-",
            "--1",
            "1---2",
            "1,,2",
            "1-5x0",
            "1-5x-1",
            "1-5x",
            "5x2",
            "-5x2",
            "1-2-3",
            "1 - 5",
            "+1",
            "1000000000",
            "-1000000000",
            "1-4294967297",
            "ü-1",
        ] {
            assert!(message(text).contains("1001-1100x2"), "{text}: {}", message(text));
        }
        assert!(message("0-999999999").contains("more than 1000000"));
        assert_eq!(frames("1-1000000").len(), 1_000_000);
    }

    /// Together the shards are the job, and none has much more than another.
    #[test]
    fn shards_share_the_frames_out() {
        let all: Vec<i32> = (0..100).collect();
        for of in [1, 3, 7, 100, 130] {
            let shards: Vec<Vec<i32>> =
                (1..=of).map(|which| format!("{which}/{of}").parse::<Shard>().unwrap().of(all.clone())).collect();
            let mut together = shards.concat();
            together.sort_unstable();
            assert_eq!(together, all);
            let sizes = || shards.iter().map(Vec::len);
            assert!(sizes().max().unwrap() - sizes().min().unwrap() <= 1);
        }
        for text in ["0/3", "4/3", "1/0", "1", "/", "a/b", "-1/3", "1/3/5"] {
            assert!(text.parse::<Shard>().unwrap_err().contains("K from 1 to N"), "{text}");
        }
    }

    #[test]
    fn runs_of_frames_are_shown_short() {
        assert_eq!(ranges(&[]), "");
        assert_eq!(ranges(&[1, 2, 3, 7, 9, 10]), "1-3, 7, 9-10");
        assert_eq!(ranges(&[-3, -2, 0]), "-3--2, 0");
        assert!(ranges(&(0..100).map(|i| 2 * i).collect::<Vec<_>>()).ends_with("14, ..."));
    }
}
