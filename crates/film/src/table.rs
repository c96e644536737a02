use csv::{ReaderBuilder, StringRecord, Trim};

use onelight_spectra::TablePoints;

use crate::error::{Error, ErrorKind};
use crate::printable::printable;

/// Most rows a table may have: ten times the largest spectral table in use.
pub const MAX_ROWS: usize = 10_000;
/// Most columns a table may have.
pub const MAX_COLUMNS: usize = 64;

/// Most bytes of text a table may have.
const MAX_BYTES: usize = 4 << 20;
/// Most characters of a name or cell that a message repeats.
const SHOWN: usize = 40;

/// A comma-separated table of numbers: `#` lines are comments, the first other line names the columns, a blank cell
/// means "not published".
///
/// ```
/// use onelight_film::NumberTable;
/// let table = NumberTable::parse("lamp.csv", "# a lamp\nwavelength_nm,power\n400,0.5\n405,\n")?;
/// assert_eq!(table.column("power")?, [Some(0.5), None]);
/// # Ok::<(), onelight_film::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct NumberTable {
    source: String,
    names: Vec<String>,
    columns: Vec<Vec<Option<f64>>>,
    /// The line of the text that each row stands on, counted from 1.
    lines: Vec<u64>,
}

impl NumberTable {
    /// Reads `text`; `source` is the name that messages carry.
    ///
    /// # Errors
    /// If the text is not such a table, or longer than 4 MiB; the message names the line.
    pub fn parse(source: &str, text: &str) -> Result<Self, Error> {
        if text.len() > MAX_BYTES {
            return Err(at(source, 1, format!("{} bytes, expected at most {MAX_BYTES}", text.len())));
        }
        let mut reader = ReaderBuilder::new().comment(Some(b'#')).trim(Trim::All).from_reader(text.as_bytes());
        let names: Vec<String> = match reader.headers() {
            Ok(headers) => headers.iter().map(str::to_owned).collect(),
            Err(error) => return Err(unreadable(source, &error)),
        };
        if names.len() < 2 || names.len() > MAX_COLUMNS {
            let problem = format!("found {} columns, expected 2 to {MAX_COLUMNS}", names.len());
            return Err(at(source, reader.position().line(), problem));
        }
        let mut table =
            Self { source: source.to_owned(), columns: vec![Vec::new(); names.len()], names, lines: Vec::new() };
        for record in reader.records() {
            let record = record.map_err(|error| unreadable(source, &error))?;
            table.push(&record)?;
        }
        if table.lines.is_empty() {
            return Err(at(source, 1, "no rows, expected at least one".to_owned()));
        }
        Ok(table)
    }

    fn push(&mut self, record: &StringRecord) -> Result<(), Error> {
        let line = record.position().map_or(0, csv::Position::line);
        if self.lines.len() == MAX_ROWS {
            return Err(at(&self.source, line, format!("more than {MAX_ROWS} rows")));
        }
        for ((cell, column), name) in record.iter().zip(&mut self.columns).zip(&self.names) {
            column.push(match cell {
                "" => None,
                _ => match cell.parse::<f64>() {
                    Ok(value) if value.is_finite() => Some(value),
                    _ => {
                        return Err(at(
                            &self.source,
                            line,
                            format!(
                                "{}: found {:?}, expected a number or nothing",
                                printable(name, SHOWN),
                                printable(cell, SHOWN)
                            ),
                        ));
                    }
                },
            });
        }
        self.lines.push(line);
        Ok(())
    }

    /// The name of the file that messages carry.
    #[must_use]
    pub fn source(&self) -> &str {
        &self.source
    }

    /// The names of the columns from left to right.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The cells of a column from first to last row.
    ///
    /// # Errors
    /// If there is no such column.
    pub fn column(&self, name: &str) -> Result<&[Option<f64>], Error> {
        match self.names.iter().position(|n| n == name) {
            Some(i) => Ok(&self.columns[i]),
            None => {
                let found: Vec<String> = self.names.iter().map(|name| printable(name, SHOWN)).collect();
                let found = printable(&found.join(", "), 8 * SHOWN);
                Err(at(&self.source, 1, format!("no column {name:?}, found {found}")))
            }
        }
    }

    /// The rows at which both `x` and `y` are given, checked to increase in `x`.
    ///
    /// # Errors
    /// If a column is missing, `x` is blank somewhere or does not increase, or fewer than two rows hold both.
    pub fn points(&self, x: &str, y: &str) -> Result<TablePoints, Error> {
        let mut points = TablePoints { x: Vec::new(), y: Vec::new() };
        for ((cell_x, cell_y), &line) in self.column(x)?.iter().zip(self.column(y)?).zip(&self.lines) {
            let Some(value_x) = *cell_x else {
                return Err(self.problem(line, format!("{x} is blank, expected a number in every row")));
            };
            let Some(value_y) = *cell_y else { continue };
            if let Some(&last) = points.x.last()
                && value_x <= last
            {
                return Err(self.problem(line, format!("{x} must increase: {value_x} after {last}")));
            }
            points.x.push(value_x);
            points.y.push(value_y);
        }
        if points.x.len() < 2 {
            return Err(self.problem(self.lines[0], format!("{y}: {} values, expected at least 2", points.x.len())));
        }
        Ok(points)
    }

    /// An error at a line of this table.
    pub(crate) fn problem(&self, line: u64, problem: String) -> Error {
        at(&self.source, line, problem)
    }
}

fn at(source: &str, line: u64, problem: String) -> Error {
    ErrorKind::Sheet { file: source.to_owned(), line, problem }.into()
}

fn unreadable(source: &str, error: &csv::Error) -> Error {
    let line = error.position().map_or(1, csv::Position::line);
    let problem = match error.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("found {len} cells, expected {expected_len}")
        }
        csv::ErrorKind::Utf8 { .. } => "not UTF-8 text".to_owned(),
        _ => error.to_string(),
    };
    at(source, line, problem)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str) -> String {
        NumberTable::parse("t.csv", text).and_then(|t| t.points("x", "y")).unwrap_err().to_string()
    }

    #[test]
    fn errors_name_the_line() {
        assert_eq!(message("# c\nx,y\n1,2\n1,3\n"), "t.csv:4: x must increase: 1 after 1");
        assert_eq!(message("x,y\n1,2\n2\n"), "t.csv:3: found 1 cells, expected 2");
        assert_eq!(message("x,y\n1,abc\n"), "t.csv:2: y: found \"abc\", expected a number or nothing");
        assert_eq!(message("x,y\n1,inf\n"), "t.csv:2: y: found \"inf\", expected a number or nothing");
        assert_eq!(message("x,z\n1,2\n"), "t.csv:1: no column \"y\", found x, z");
        assert_eq!(message("x,y\n,2\n3,4\n"), "t.csv:2: x is blank, expected a number in every row");
        assert!(message("").contains("expected 2 to"));
        assert!(message("x,y\n").contains("no rows"));
    }

    #[test]
    fn hostile_sizes_are_refused_and_not_repeated() {
        let lines = |count: usize| format!("x,y\n{}", (0..count).map(|i| format!("{i},1\n")).collect::<String>());
        assert!(NumberTable::parse("t.csv", &lines(MAX_ROWS)).is_ok());
        assert_eq!(message(&lines(MAX_ROWS + 1)), "t.csv:10002: more than 10000 rows");
        assert_eq!(message(&"#\n".repeat(MAX_BYTES)), "t.csv:1: 8388608 bytes, expected at most 4194304");
        for text in [format!("x,y\n1,{}\n", "z".repeat(9999)), format!("{},b\n1,2\n", "a\u{7}".repeat(9999))] {
            let sentence = message(&text);
            assert!(sentence.len() < 200 && !sentence.contains(char::is_control), "{sentence}");
        }
        assert!(message(&format!("{}\n1\n", "a,".repeat(65))).contains("found 66 columns, expected 2 to 64"));
    }

    #[test]
    fn blanks_are_skipped_per_column() {
        let table = NumberTable::parse("t.csv", "x,y,z\n1,,5\n2,3,\n4,5,6\n").unwrap();
        assert_eq!(table.points("x", "y").unwrap().x, [2.0, 4.0]);
        assert_eq!(table.points("x", "z").unwrap().x, [1.0, 4.0]);
    }
}
