//! Which frames: `1001-1100`, `1001-1010,1020`, `1001-1100x2`; and which of them: `3/10`.

use std::collections::BTreeSet;
use std::str::FromStr;

use super::pattern::MAX_FRAME;

/// Numbers of frames, each once and in order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct FrameNumbers(pub(super) BTreeSet<u32>);

/// Most frames of one job: more are a mistyped number.
const MAX_FRAMES: usize = 1_000_000;

impl FromStr for FrameNumbers {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut numbers = BTreeSet::new();
        for part in text.split(',') {
            let (first, last, step) = range(part)?;
            for number in (first..=last).step_by(step) {
                numbers.insert(number);
                if numbers.len() > MAX_FRAMES {
                    return Err(format!("found more than {MAX_FRAMES} frames"));
                }
            }
        }
        Ok(Self(numbers))
    }
}

/// First, last and step of `1001`, `1001-1100` or `1001-1100x2`.
fn range(part: &str) -> Result<(u32, u32, usize), String> {
    let wrong = || format!("found `{part}`, expected frames such as 1001-1100, 1001-1010,1020 or 1001-1100x2");
    let number = |text: &str| {
        let digits = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
        digits.then(|| text.parse().ok()).flatten().filter(|number| *number <= MAX_FRAME)
    };
    let (range, step) = match part.split_once('x') {
        Some((range, step)) if range.contains('-') => (range, number(step).filter(|step| *step > 0)),
        Some(_) => return Err(wrong()),
        None => (part, Some(1)),
    };
    let (first, last) = range.split_once('-').unwrap_or((range, range));
    let (Some(first), Some(last), Some(step)) = (number(first), number(last), step) else { return Err(wrong()) };
    if last < first {
        return Err(format!("found `{part}`, which ends before it begins"));
    }
    Ok((first, last, step as usize))
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
pub(super) fn ranges(numbers: &[u32]) -> String {
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

    fn frames(text: &str) -> Vec<u32> {
        text.parse::<FrameNumbers>().unwrap().0.into_iter().collect()
    }

    #[test]
    fn frames_are_read_as_renderers_write_them() {
        assert_eq!(frames("1001-1004"), [1001, 1002, 1003, 1004]);
        assert_eq!(frames("1001"), [1001]);
        assert_eq!(frames("7-7"), [7]);
        assert_eq!(frames("1001-1010x4"), [1001, 1005, 1009]);
        assert_eq!(frames("5,1-3,2-4x2,0009"), [1, 2, 3, 4, 5, 9]);
        assert_eq!(frames("999999999"), [MAX_FRAME]);
    }

    #[test]
    fn mistyped_frames_are_named() {
        let message = |text: &str| text.parse::<FrameNumbers>().unwrap_err();
        for text in
            ["", "a", "1-", "-1", "1,,2", "1-5x0", "1-5x", "5x2", "1-2-3", "1 - 5", "+1", "1000000000", "1-4294967297"]
        {
            assert!(message(text).contains("1001-1100x2"), "{text}: {}", message(text));
        }
        assert!(message("1,20-10").contains("`20-10`, which ends before"));
        assert!(message("0-999999999").contains("more than 1000000"));
        assert_eq!(frames("1-1000000").len(), 1_000_000);
    }

    /// Together the shards are the job, and none has much more than another.
    #[test]
    fn shards_share_the_frames_out() {
        let all: Vec<u32> = (0..100).collect();
        for of in [1, 3, 7, 100, 130] {
            let shards: Vec<Vec<u32>> =
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
        assert!(ranges(&(0..100).map(|i| 2 * i).collect::<Vec<_>>()).ends_with("14, ..."));
    }
}
