//! All sheets on one page that needs nothing but itself.

use std::fmt::Write as _;

use super::develop::Distance;

/// A sheet as PNG with its figures.
pub(super) struct Section {
    /// Name of the sheet's file beside the page.
    pub(super) file: String,
    pub(super) title: String,
    pub(super) text: String,
    pub(super) png: Vec<u8>,
    pub(super) rows: Vec<Row>,
}

/// What one shot lies from another.
pub(super) struct Row {
    pub(super) shot: String,
    pub(super) beside: String,
    /// The distance on the picture that the sheet shows.
    pub(super) here: Distance,
    /// On the ColorChecker from -2 to +2 stops.
    pub(super) chart: Option<Distance>,
    /// What else the cell says.
    pub(super) note: String,
    /// Picture of the differences, as PNG.
    pub(super) picture: Option<Vec<u8>>,
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

/// The page as HTML, with all pictures in it.
pub(super) fn page(sections: &[Section]) -> String {
    let mut html = HEAD.to_owned();
    html.push_str("<ul>\n");
    for section in sections {
        let _ = writeln!(html, "<li><a href=\"#{}\">{}</a>", escaped(&section.file), escaped(&section.title));
    }
    html.push_str("</ul>\n");
    for section in sections {
        let Section { file, title, text, png, rows } = section;
        let (file, title) = (escaped(file), escaped(title));
        let _ = writeln!(html, "<h2 id=\"{file}\">{title}</h2>\n<p>{}</p>", escaped(text));
        let _ = writeln!(html, "<img alt=\"{title}\" src=\"data:image/png;base64,{}\">", base64(png));
        if !rows.is_empty() {
            table(&mut html, rows);
        }
    }
    html
}

fn table(html: &mut String, rows: &[Row]) {
    html.push_str(
        "<table>\n<tr><th>picture<th>against<th>mean<th>95 %<th>max<th>chart: mean<th>95 %<th>max<th><th>difference\n",
    );
    for row in rows {
        let Distance { mean, p95, max } = row.here;
        let chart = row.chart.map_or_else(
            || "<td><td><td>".to_owned(),
            |d| format!("<td>{:.2}<td>{:.2}<td>{:.2}", d.mean, d.p95, d.max),
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
        let distance = Distance { mean: 1.0, p95: 2.0, max: 3.0 };
        let row = Row {
            shot: "a < b".to_owned(),
            beside: "c".to_owned(),
            here: distance,
            chart: Some(distance),
            note: String::new(),
            picture: Some(vec![1, 2, 3]),
        };
        let section = Section {
            file: "x".to_owned(),
            title: "T & t".to_owned(),
            text: "words".to_owned(),
            png: vec![0; 4],
            rows: vec![row],
        };
        let page = page(&[section]);
        assert!(
            !page.contains("http")
                && !page.contains("<script")
                && page.contains("a &lt; b")
                && page.contains("T &amp; t")
        );
        assert_eq!(page.matches("data:image/png;base64,").count(), 2);
    }
}
