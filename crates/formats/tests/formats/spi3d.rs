use onelight_formats::spi3d;
use onelight_lut::Lut3d;

use crate::tables::bent;

fn text(table: &Lut3d) -> String {
    let mut bytes = Vec::new();
    spi3d::write(&mut bytes, table).unwrap();
    String::from_utf8(bytes).unwrap()
}

#[test]
fn tables_come_back_bit_for_bit_in_any_order() {
    for size in [2, 9, 17] {
        let table = bent(size);
        let written = text(&table);
        assert_eq!(spi3d::read(written.as_bytes()).unwrap(), table);
        assert_eq!(spi3d::read(written.replace("SPILUT", "spilut").as_bytes()).unwrap(), table);
        let (head, body) = written.split_at(written.match_indices('\n').nth(2).unwrap().0);
        let mut lines: Vec<_> = body.trim().lines().collect();
        lines.reverse();
        let turned = format!("\u{feff}{head}\r\n# a comment\r\n\r\n{}\r\n", lines.join("\r\n"));
        assert_eq!(spi3d::read(turned.as_bytes()).unwrap(), table);
    }
}

#[test]
fn the_first_line_of_a_table_is_black_and_blue_follows() {
    let written = text(&Lut3d::identity(2).unwrap());
    let head: Vec<_> = written.lines().take(5).collect();
    assert_eq!(head, ["SPILUT 1.0", "3 3", "2 2 2", "0 0 0 0 0 0", "0 0 1 0 0 1"]);
}

#[test]
fn bad_files_are_refused_with_their_line() {
    let good = text(&bent(2));
    let change = |from: &str, to: &str| good.replacen(from, to, 1);
    let cases = [
        (String::new(), 1, "header: found the end of the file, expected SPILUT 1.0"),
        (change("SPILUT 1.0", "SPILUT 2.0"), 1, "first line: found \"SPILUT 2.0\""),
        (change("3 3", "1 3"), 2, "channels in and out: found \"1 3\""),
        ("SPILUT 1.0\n3 3\n".to_owned(), 2, "header: found the end of the file"),
        (change("2 2 2", "2 2 3"), 3, "sizes: found \"2 2 3\""),
        (change("2 2 2", "100000 100000 100000"), 3, "sizes: found"),
        (change("2 2 2", "99999999999999999999 2 2"), 3, "sizes: found"),
        (change("2 2 2", "1 1 1"), 3, "sizes: found"),
        (change("2 2 2", "256 256 256"), 11, "end of the file: found"),
        (change("3 3\n2 2 2", "2 2 2\n3 3"), 2, "channels in and out"),
        (change("0 0 1 ", "0 0 0 "), 5, "node: found [0, 0, 0] again"),
        (change("0 0 1 ", "0 0 2 "), 5, "node: found 0 0 2"),
        (change("0 0 1 ", "0 0 -1 "), 5, "node: found -1"),
        (change("0 0 1 ", "0 0 1 5 "), 5, "numbers in a data line: found 7, expected 6"),
        (change("0 0 1 0 0 ", "0 0 1 0 nan "), 5, "a data line: found \"nan\", expected a number finite"),
        (change("0 0 1 0 0 ", "0 0 1 0 1e40 "), 5, "a data line: found \"1e40\", expected a number finite"),
        (change("0 0 1 0 0 ", "0 0 1 0 zero "), 5, "a data line: found \"zero\", expected a number"),
        (format!("{good}0 0 0 1 1 1\n"), 12, "found another data line, expected 8"),
        (good.lines().take(10).collect::<Vec<_>>().join("\n") + "\n####################", 11, "found 7 data lines"),
    ];
    for (file, line, says) in cases {
        let error = spi3d::read(file.as_bytes()).unwrap_err();
        assert!(error.to_string().contains(says), "{error} for {says}");
        assert_eq!(error.line(), Some(line), "{error}");
    }
    // Of the last number any first digits would do.
    for end in 0..good.trim_end().rfind(' ').unwrap() {
        assert!(spi3d::read(&good.as_bytes()[..end]).is_err(), "{end}");
    }
}
