//! The report: one page that needs nothing else, with every form on it, and all numbers beside it.

use std::collections::HashSet;
use std::fs;

use quick_xml::Reader;
use quick_xml::events::Event;

use crate::program::program;

const GPU: &str = r#"[{"form": "structured", "name": "kodak-5207_kodak-2383", "size": 32, "ns_per_pixel": 0.05,
    "mean": 0.01, "max": 0.3, "card": "A <card>", "date": "2026-01-01"}]"#;
const PEERS: &str = r#"{"rows": [{"job": "a program & its table", "peer": "it", "threads": 1, "state": "warm",
    "ours_ns_per_pixel": 10.0, "theirs_ns_per_pixel": 20.0, "ratio": 2.0, "difference": 1e-5}]}"#;

#[test]
fn a_quick_report_is_whole_and_holds_every_form() {
    // A workspace of its own: what was measured in this one would be on the page too.
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir_all(folder.path().join("target/onelight")).unwrap();
    fs::create_dir(folder.path().join("xtask")).unwrap();
    fs::write(folder.path().join("Cargo.toml"), "[workspace]\n").unwrap();
    fs::write(folder.path().join("target/onelight/gpu.json"), GPU).unwrap();
    fs::write(folder.path().join("target/onelight/peers.json"), PEERS).unwrap();
    let output = program()
        .args(["report", "--quick", "--json"])
        .current_dir(folder.path())
        .env_remove("CARGO_MANIFEST_DIR")
        .output()
        .unwrap();
    let folder = folder.path().join("target/onelight/report");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let said: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let page = fs::read_to_string(folder.join("index.html")).unwrap();
    let written: serde_json::Value = serde_json::from_slice(&fs::read(folder.join("report.json")).unwrap()).unwrap();
    assert_eq!(written["looks"], said["looks"]);

    elements_nest(&page);
    for outside in ["http", "//", "src=", "href=", "url(", "@import"] {
        // Two slashes begin no comment in the script, either.
        assert!(!page.contains(outside), "the page reaches outside by {outside}");
    }
    assert!(page.contains("A quick run"));

    let looks = said["looks"].as_array().unwrap();
    assert_eq!(looks.len(), 2, "a negative and a reversal film");
    for look in looks {
        let rows = look["look"]["rows"].as_array().unwrap();
        let kinds: HashSet<&str> = rows.iter().map(|row| row["kind"].as_str().unwrap()).collect();
        for kind in ["talk", "plain", "structured", "direct", "reference"] {
            assert!(kinds.contains(kind), "{kind}");
        }
        for row in rows {
            let number = |value: &serde_json::Value| value.as_f64().unwrap_or_else(|| panic!("{row}"));
            let exact = row["kind"] == "reference";
            assert!(
                number(&row["time"]["ns"]) > 0.0 && number(&row["time"]["median_ns"]) >= number(&row["time"]["ns"])
            );
            let error = &row["error"];
            assert!(number(&error["max"]) >= number(&error["p99"]) && number(&error["p99"]) >= 0.0, "{row}");
            assert_eq!(number(&error["mean"]) == 0.0, exact, "only the film itself has no error: {row}");
        }
        let misses = |study: &str, of: &str| -> Vec<f64> {
            let rows = look["studies"][study].as_array().unwrap();
            rows.iter().map(|row| row[of]["max"].as_f64().unwrap()).collect()
        };
        let (curves, exposure) = (misses("curves", "miss"), misses("exposure", "unmatched"));
        assert!(curves[0] > 10.0 * curves[6], "finer tables are nearer: {curves:?}");
        assert!(exposure[0] < exposure[3], "coarser grids are farther: {exposure:?}");
    }
    for study in ["picture", "table", "nodes", "threads"] {
        assert!(!said["growth"][study][0]["points"].as_array().unwrap().is_empty(), "{study}");
    }
    let ours = ["plain 17, f32", "structured 16 display, 10 bit", "direct 5 + 9", "the talk's 32", "the film itself"];
    for form in ours.into_iter().chain(["structured 32 on A &lt;card&gt;", "a program &amp; its table"]) {
        assert!(page.contains(form), "{form} is not on the page");
    }
}

/// Every element is closed, and no attribute or reference is malformed: the page is XML too.
fn elements_nest(page: &str) {
    let page = page.strip_prefix("<!DOCTYPE html>").unwrap();
    let mut reader = Reader::from_str(page);
    let mut charts = 0;
    loop {
        match reader.read_event().unwrap_or_else(|e| panic!("at byte {}: {e}", reader.error_position())) {
            Event::Eof => break,
            Event::Start(tag) | Event::Empty(tag) => {
                tag.attributes().for_each(|attribute| drop(attribute.unwrap()));
                charts += usize::from(tag.name().as_ref() == "svg");
            }
            Event::GeneralRef(name) => {
                assert!(["amp", "lt", "gt", "quot"].contains(&&*name), "{name:?}");
            }
            _ => {}
        }
    }
    assert!(charts >= 12, "{charts} charts");
}
