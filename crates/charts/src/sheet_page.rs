use std::fmt::Write as _;

/// A contact sheet with the figures of its pictures, as one part of a [`sheet_page`].
#[derive(Debug, Clone, PartialEq)]
pub struct SheetSection {
    /// Its name within the page, of letters, digits and underscores, such as that of the sheet's own file.
    pub file: String,
    /// What stands above it.
    pub title: String,
    /// What to look for.
    pub text: String,
    /// The sheet, as [`contact_sheet`](crate::contact_sheet) draws it.
    pub png: Vec<u8>,
    /// Figures of its pictures.
    pub rows: Vec<SheetRow>,
}

/// What one picture of a sheet lies from another.
#[derive(Debug, Clone, PartialEq)]
pub struct SheetRow {
    /// Caption of the picture.
    pub shot: String,
    /// Caption of the picture that it is compared with.
    pub beside: String,
    /// Mean, 95 % and largest CIEDE2000 on the picture that the sheet shows.
    pub here: [f64; 3],
    /// The same on a chart of colours, if there is any.
    pub chart: Option<[f64; 3]>,
    /// What else the row says.
    pub note: String,
    /// The differences as a picture, PNG.
    pub picture: Option<Vec<u8>>,
}

const HEAD: &str = "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n\
<meta name=\"viewport\" content=\"width=device-width\">\n<title>Film simulation, compared</title>\n<style>\n\
body{background:#181818;color:#ccc;font:16px/1.45 sans-serif;max-width:1720px;margin:0 auto;padding:0 1em 4em}\n\
img{max-width:100%;height:auto;display:block;margin:.6em 0}a{color:#9cf}h2{margin:2em 0 .2em}p{max-width:60em;margin:.2em 0}\n\
table{border-collapse:collapse}td,th{padding:.1em .9em .1em 0;text-align:right;vertical-align:top}\n\
td:first-child,th:first-child,td:nth-child(2),th:nth-child(2){text-align:left}summary{cursor:pointer}\n\
</style>\n<h1>Film simulation, compared</h1>\n\
<p>Each sheet as PNG, and under it what its pictures differ by: CIEDE2000 of the display colours, mean, 95 % and maximum, on the \
picture shown and on the ColorChecker from -2 to +2 stops. Difference pictures: black 0, red 5, yellow 10, white 20 and more.</p>\n";

/// The sheets as one HTML page that needs nothing else: all pictures are in it.
///
/// ```
/// use onelight_charts::{SheetRow, SheetSection, sheet_page};
/// let row = SheetRow {
///     shot: "one white lamp".into(),
///     beside: "separations".into(),
///     here: [1.9, 4.2, 7.0],
///     chart: None,
///     note: String::new(),
///     picture: None,
/// };
/// let (title, text) = ("Lights".into(), "White light costs chroma.".into());
/// let page = sheet_page(&[SheetSection { file: "lights".into(), title, text, png: Vec::new(), rows: vec![row] }]);
/// assert!(page.contains("<h2 id=\"lights\">Lights</h2>") && page.contains("<td>4.20"));
/// ```
#[must_use]
pub fn sheet_page(sections: &[SheetSection]) -> String {
    let mut html = HEAD.to_owned();
    html.push_str("<ul>\n");
    for section in sections {
        let _ = writeln!(html, "<li><a href=\"#{}\">{}</a>", escaped(&section.file), escaped(&section.title));
    }
    html.push_str("</ul>\n");
    for section in sections {
        let SheetSection { file, title, text, png, rows } = section;
        let (file, title) = (escaped(file), escaped(title));
        let _ = writeln!(html, "<h2 id=\"{file}\">{title}</h2>\n<p>{}</p>", escaped(text));
        let _ = writeln!(html, "<img alt=\"{title}\" src=\"data:image/png;base64,{}\">", base64(png));
        if !rows.is_empty() {
            table(&mut html, rows);
        }
    }
    html
}

fn table(html: &mut String, rows: &[SheetRow]) {
    html.push_str(
        "<table>\n<tr><th>picture<th>against<th>mean<th>95 %<th>max<th>chart: mean<th>95 %<th>max<th><th>difference\n",
    );
    for row in rows {
        let [mean, p95, max] = row.here;
        let chart = row.chart.map_or_else(
            || "<td><td><td>".to_owned(),
            |[mean, p95, max]| format!("<td>{mean:.2}<td>{p95:.2}<td>{max:.2}"),
        );
        let picture = row.picture.as_ref().map_or_else(String::new, |png| {
            let data = base64(png);
            format!("<details><summary>show</summary><img alt=\"difference\" src=\"data:image/png;base64,{data}\"></details>")
        });
        let _ = writeln!(
            html,
            "<tr><td>{}<td>{}<td>{mean:.2}<td>{p95:.2}<td>{max:.2}{chart}<td>{}<td>{picture}",
            escaped(&row.shot),
            escaped(&row.beside),
            escaped(&row.note),
        );
    }
    html.push_str("</table>\n");
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// The alphabet of RFC 4648, section 4.
fn base64(bytes: &[u8]) -> String {
    const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let at = |i: usize| u32::from(group.get(i).copied().unwrap_or_default());
        let bits = at(0) << 16 | at(1) << 8 | at(2);
        for i in 0..4 {
            let letter = ALPHABET[(bits >> (18 - 6 * i)) as usize & 63];
            text.push(if i > group.len() { '=' } else { char::from(letter) });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_the_standards() {
        // RFC 4648, section 10.
        for (plain, coded) in
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foob", "Zm9vYg=="), ("foobar", "Zm9vYmFy")]
        {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
        assert_eq!(base64(&[255, 254, 253, 252]), "//79/A==");
    }

    #[test]
    fn a_page_asks_nothing_of_the_network() {
        let distance = [1.0, 2.0, 3.0];
        let row = SheetRow {
            shot: "a < b".to_owned(),
            beside: "c".to_owned(),
            here: distance,
            chart: Some(distance),
            note: String::new(),
            picture: Some(vec![1, 2, 3]),
        };
        let section = SheetSection {
            file: "x".to_owned(),
            title: "T & t".to_owned(),
            text: "words".to_owned(),
            png: vec![0; 4],
            rows: vec![row],
        };
        let page = sheet_page(&[section]);
        assert!(
            !page.contains("http")
                && !page.contains("<script")
                && page.contains("a &lt; b")
                && page.contains("T &amp; t")
        );
        assert_eq!(page.matches("data:image/png;base64,").count(), 2);
    }
}
