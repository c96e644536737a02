use crate::error::{Error, ErrorKind};
use crate::tabulated::TablePoints;

/// A comma-separated table that is compiled into the program: `#` lines are comments, the first other line names the columns,
/// every cell below is a number and none is quoted. The first column is the wavelength in nm.
///
/// Tables of others, with all that their authors may write, are a reader's work: data sheets are read in `onelight-film`.
pub(crate) struct BuiltInTable {
    source: &'static str,
    names: Vec<&'static str>,
    columns: Vec<Vec<f64>>,
}

impl BuiltInTable {
    /// # Errors
    /// If the text is not such a table; the message names `source` and the line.
    pub(crate) fn parse(source: &'static str, text: &'static str) -> Result<Self, Error> {
        let mut lines = (1..).zip(text.lines()).filter(|(_, line)| !line.starts_with('#'));
        let (_, header) = lines.next().ok_or_else(|| at(source, 1, "no columns, expected at least 2".to_owned()))?;
        let names: Vec<&str> = header.split(',').map(str::trim).collect();
        let mut columns = vec![Vec::new(); names.len()];
        for (line, row) in lines {
            let cells = row.split(',').map(|cell| cell.trim().parse::<f64>());
            let cells: Vec<f64> =
                cells.collect::<Result<_, _>>().map_err(|error| at(source, line, error.to_string()))?;
            if cells.len() != names.len() {
                return Err(at(source, line, format!("found {} cells, expected {}", cells.len(), names.len())));
            }
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
        Ok(Self { source, names, columns })
    }

    /// The names of the columns after the wavelength.
    pub(crate) fn value_names(&self) -> &[&'static str] {
        &self.names[1..]
    }

    /// A column over the wavelength.
    pub(crate) fn points(&self, name: &str) -> Result<TablePoints, Error> {
        let found = self.names.iter().position(|found| *found == name);
        let found = found.ok_or_else(|| at(self.source, 1, format!("no column {name:?}")))?;
        Ok(TablePoints { x: self.columns[0].clone(), y: self.columns[found].clone() })
    }
}

fn at(source: &'static str, line: usize, problem: String) -> Error {
    ErrorKind::Table { source, line, problem }.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_name_the_line() {
        let message = |text| BuiltInTable::parse("t.csv", text).and_then(|t| t.points("y")).unwrap_err().to_string();
        assert_eq!(message("# c\nx,y\n1,2\n1,a\n"), "t.csv:4: invalid float literal");
        assert_eq!(message("x,y\n1,2\n2\n"), "t.csv:3: found 1 cells, expected 2");
        assert_eq!(message("x,z\n1,2\n"), "t.csv:1: no column \"y\"");
        assert!(message("").starts_with("t.csv:1: no columns"));
        let table = BuiltInTable::parse("t.csv", "# c\n x , y\n400, 2.5\n410,3\n").unwrap();
        assert_eq!(table.points("y").unwrap(), TablePoints { x: vec![400.0, 410.0], y: vec![2.5, 3.0] });
    }
}
