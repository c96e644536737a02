mod header;
mod lines;
mod numbers;

use std::io::BufRead;

use super::CubeFile;
use crate::error::{Error, TextProblem};
use crate::text::{RESERVED, one_line};
use header::{Header, Layout};
use lines::Lines;
use numbers::numbers;

impl CubeFile {
    /// The same as [`CubeFile::read`], from text that is in memory.
    ///
    /// # Errors
    ///
    /// As [`CubeFile::read`], but for failing input.
    pub fn parse(text: &str) -> Result<Self, Error> {
        Self::read(text.as_bytes())
    }

    /// Reads a file, to its end.
    ///
    /// Keywords count in any case. Line ends may be LF or CRLF, numbers may be separated by spaces or tabs, a
    /// title may lack its quotes, lines starting with `#` are comments wherever they stand, and blank lines are
    /// skipped. In a file with two tables the lines of the 1D table come first.
    ///
    /// # Errors
    ///
    /// If the input fails, or a line is not as the format wants it: an unknown or repeated keyword, one after
    /// the first data line, a size out of bounds (see [`onelight_lut::Lut1d`], [`onelight_lut::Lut3d`]), a wrong number of
    /// numbers or of data lines, or a number that is not finite in `f32`. The limits of this type keep a hostile
    /// file from taking more memory than its own bytes warrant.
    pub fn read(input: impl BufRead) -> Result<Self, Error> {
        let mut lines = Lines::new(input);
        let mut header = Header::default();
        let mut comments = Vec::new();
        let mut comment_bytes = 0;
        let mut other_lines = 0;
        let mut body: Option<Body> = None;

        while let Some(line) = lines.next_line()? {
            let number = line.number;
            let fail = |problem| Error::text(number, problem);
            let text = line.text.trim();
            if starts_as_data(text) {
                let body = match &mut body {
                    Some(body) => body,
                    None => body.insert(Body::new(header.layout().map_err(fail)?)),
                };
                body.push(text).map_err(fail)?;
                continue;
            }
            other_lines += 1;
            if other_lines > Self::MAX_OTHER_LINES {
                let max = Self::MAX_OTHER_LINES;
                return Err(fail(TextProblem::TooManyOtherLines { max }));
            }
            if let Some(comment) = text.strip_prefix('#') {
                comment_bytes += comment.len();
                if comment_bytes > Self::MAX_COMMENT_BYTES {
                    let max = Self::MAX_COMMENT_BYTES;
                    return Err(fail(TextProblem::TooManyCommentBytes { max }));
                }
                comments.push(comment.strip_prefix(' ').unwrap_or(comment).to_owned());
            } else if !text.is_empty() {
                let keyword = header.keyword(text).map_err(fail)?;
                if body.is_some() {
                    return Err(fail(TextProblem::KeywordAfterData { keyword }));
                }
            }
        }

        let end = |problem| Error::text(lines.last_number(), problem);
        let body = match body {
            Some(body) => body,
            None => Body::new(header.layout().map_err(|problem| match problem {
                TextProblem::DataBeforeSize => end(TextProblem::NoTable),
                other => end(other),
            })?),
        };
        body.check_complete().map_err(end)?;
        let title = header.title().unwrap_or_default();
        let mut file = body.layout.file(body.entries)?.with_title(&title);
        let mut comments: Vec<String> = comments.iter().map(|text| one_line(text).trim_end().to_owned()).collect();
        if file.may_have_title_in_comments() {
            file = file.with_title(&take_title(&mut comments));
        }
        file = file.with_comments(comments);
        // What a long comment was cut into would be taken for a title next time.
        if file.may_have_title_in_comments() {
            let title = take_title(&mut file.comments);
            file = file.with_title(&title);
        }
        Ok(file)
    }
}

impl CubeFile {
    /// Whether [`CubeFile::write`] would have put a title into the first comment.
    fn may_have_title_in_comments(&self) -> bool {
        self.title.is_empty() && self.lut1d.is_some() && self.lut3d.is_some()
    }
}

/// Takes the title out of the first comment.
fn take_title(comments: &mut Vec<String>) -> String {
    let title = |comment: &String| Some(comment.strip_prefix("TITLE \"")?.strip_suffix('"')?.trim().to_owned());
    let titles: Vec<String> = comments.iter().map_while(title).collect();
    // Empty ones are not written again.
    let empty = titles.iter().take_while(|title| title.is_empty()).count();
    comments.drain(..titles.len().min(empty + 1));
    titles.into_iter().nth(empty).unwrap_or_default()
}

/// The data lines so far, of both tables in one row.
struct Body {
    layout: Layout,
    expected: usize,
    entries: Vec<[f32; 3]>,
}

impl Body {
    fn new(layout: Layout) -> Self {
        let expected = layout.data_lines();
        Self { layout, expected, entries: Vec::with_capacity(expected.min(RESERVED)) }
    }

    fn push(&mut self, text: &str) -> Result<(), TextProblem> {
        let expected = self.expected;
        if self.entries.len() == expected {
            return Err(TextProblem::TooManyDataLines { expected });
        }
        self.entries.push(numbers("a data line", text)?);
        Ok(())
    }

    fn check_complete(&self) -> Result<(), TextProblem> {
        let [found, expected] = [self.entries.len(), self.expected];
        if found == expected { Ok(()) } else { Err(TextProblem::Truncated { found, expected }) }
    }
}

/// Whether a line holds numbers rather than a keyword; "nan" and "inf" are numbers, though bad ones.
fn starts_as_data(text: &str) -> bool {
    match text.bytes().next() {
        Some(b'0'..=b'9' | b'-' | b'+' | b'.') => true,
        Some(b'n' | b'N' | b'i' | b'I') => {
            text.split_whitespace().next().is_some_and(|word| word.parse::<f32>().is_ok())
        }
        _ => false,
    }
}
