//! What the numbers say, in sentences made from them.

use super::figure::{Which, front};
use super::forms::{Kind, sum};
use super::measure::{Look, Row};
use super::peers::Elsewhere;
use super::stopwatch::Timing;
use super::studies::{CurveRow, ExposureRow, GridRow, Growth, Measured};
use super::text::{bytes, figure, listed, plain, slope};

/// A form may differ from the film by so much at most, to be taken for it: about what an eye sees side by side.
const LIMIT: f64 = 1.0;

/// A piece of advice: for whom, and what.
pub(super) struct Advice {
    pub(super) whom: &'static str,
    pub(super) sentence: String,
}

/// What to choose, for three readers.
pub(super) fn advice(look: &Look, copy: Timing, elsewhere: &Elsewhere) -> Vec<Advice> {
    let near = || look.rows.iter().filter(|row| row.kind != Kind::Reference && row.error.max <= LIMIT);
    let none = format!("none of these forms stays under {} dE everywhere.", plain(LIMIT));
    let small = near().filter(|row| row.kind.is_table()).min_by_key(|row| row.bytes).map(|row| {
        format!(
            "{}, the smallest table that stays under {} dE: {}, largest difference {}, mean {}. {} ns for a pixel here; \
             this page holds no times of a phone.",
            row.name(),
            plain(LIMIT),
            row.bytes.map(bytes).unwrap_or_default(),
            figure(row.error.max),
            figure(row.error.mean),
            figure(row.time.ns)
        )
    });
    let fast = near().min_by(|a, b| a.time.ns.total_cmp(&b.time.ns).then(a.bytes.cmp(&b.bytes))).map(|row| {
        let card = elsewhere.of_look(&look.name).filter(|card| card.max <= LIMIT);
        let card = card.min_by(|a, b| a.ns_per_pixel.total_cmp(&b.ns_per_pixel)).map_or_else(
            || "No graphics card was measured.".to_owned(),
            |card| format!("On {}: {}, {} ns.", card.card, card.detail(), figure(card.ns_per_pixel)),
        );
        format!(
            "{}, the fastest under {} dE on this processor: {} ns for a pixel on one thread ({} times a copy), {}, \
             largest difference {}, to +6 stops {}. {card}",
            row.name(),
            plain(LIMIT),
            figure(row.time.ns),
            figure(row.time.ns / copy.ns),
            row.bytes.map(bytes).unwrap_or_default(),
            figure(row.error.max),
            figure(row.error.max_to_six)
        )
    });
    let tables = look.rows.iter().filter(|row| row.kind.is_table());
    let exact = tables.min_by(|a, b| a.error.max.total_cmp(&b.error.max)).map(|row| {
        let nearer = look.rows.iter().filter(|r| r.kind == Kind::Direct && r.error.max <= row.error.max);
        let direct = nearer.min_by(|a, b| a.time.ns.total_cmp(&b.time.ns)).map_or_else(String::new, |d| {
            format!(
                " Without a table, {} comes as near: {}, mean {}, {} ns.",
                d.name(),
                figure(d.error.max),
                figure(d.error.mean),
                figure(d.time.ns)
            )
        });
        format!(
            "{}, the table nearest to the film: largest difference {}, mean {}, {}, {} ns.{direct}",
            row.name(),
            figure(row.error.max),
            figure(row.error.mean),
            row.bytes.map(bytes).unwrap_or_default(),
            figure(row.time.ns)
        )
    });
    [("A phone", small), ("A game", fast), ("A grading suite", exact)]
        .map(|(whom, sentence)| Advice { whom, sentence: sentence.unwrap_or_else(|| none.clone()) })
        .into()
}

/// Sentences that say what a reader sees in the plot of speed against error.
pub(super) fn reading(look: &Look, copy: Timing) -> Vec<String> {
    let mut said = Vec::new();
    let rows = |kind: Kind| look.rows.iter().filter(move |row| row.kind == kind);
    let span = |kind: Kind| {
        let times: Vec<f64> = rows(kind).map(|row| row.time.ns).collect();
        let (least, most) = times.iter().fold((f64::INFINITY, 0f64), |(a, b), &v| (a.min(v), b.max(v)));
        let (least, most) = (figure(least), figure(most));
        let range = if least == most { least } else { format!("{least} to {most}") };
        (!times.is_empty()).then(|| format!("{} {range} ns", kind.name()))
    };
    let spans: Vec<String> = [Kind::Plain, Kind::Structured, Kind::Direct].into_iter().filter_map(span).collect();
    if let Some(film) = rows(Kind::Reference).next() {
        said.push(format!(
            "Time for a pixel on one thread: {}; the film itself {} ns, a copy of the picture {} ns.",
            listed(&spans),
            figure(film.time.ns),
            figure(copy.ns)
        ));
    }
    let best: Vec<String> = front(&look.rows, Which::Max).into_iter().map(Row::name).collect();
    said.push(format!(
        "No other form is both faster and nearer to the film, by the largest difference, than {}.",
        listed(&best)
    ));
    let of_size = |kind: Kind, sizes: &[usize]| {
        let found =
            sizes.iter().find_map(|size| rows(kind).find(|row| row.size == Some(*size) && row.storage == Some("f32")));
        found.cloned()
    };
    if let (Some(plain), Some(structured)) = (of_size(Kind::Plain, &[33, 17]), of_size(Kind::Structured, &[32, 16])) {
        said.push(compared(&structured, &plain));
    }
    if let (Some(talk), Some(plain)) = (rows(Kind::Talk).next(), of_size(Kind::Plain, &[33, 17])) {
        said.push(compared(&plain, talk));
    }
    let coarse = rows(Kind::Structured).filter(|row| row.storage == Some("unorm10")).max_by_key(|row| row.size);
    if let Some(coarse) = coarse
        && let Some(fine) = rows(Kind::Structured).find(|row| row.size == coarse.size && row.storage == Some("f16"))
    {
        said.push(format!(
            "{} instead of {}: mean difference {} instead of {}, {} instead of {}.",
            coarse.name(),
            fine.name(),
            figure(coarse.error.mean),
            figure(fine.error.mean),
            coarse.bytes.map(bytes).unwrap_or_default(),
            fine.bytes.map(bytes).unwrap_or_default()
        ));
    }
    said
}

/// `structured 32, f32 against plain 33, f32: 1.2 times the time, a third of ...`
fn compared(row: &Row, other: &Row) -> String {
    format!(
        "{} beside {}: {} times its time, {} times its mean difference, {} times its largest ({} beside {}).",
        row.name(),
        other.name(),
        figure(row.time.ns / other.time.ns),
        figure(row.error.mean / other.error.mean),
        figure(row.error.max / other.error.max),
        figure(row.error.max),
        figure(other.error.max)
    )
}

pub(super) fn grids(rows: &[GridRow]) -> String {
    let said = [0.1, 0.5, 1.0].map(|limit| {
        let few = rows.iter().filter(|row| row.both.max <= limit).min_by_key(|row| row.nodes.iter().sum::<usize>());
        few.map(|row| format!("under {} dE: {} ({} ns)", plain(limit), sum(row.nodes), figure(row.ns)))
    });
    let said: Vec<String> = said.into_iter().flatten().collect();
    let stages = if rows.iter().any(|row| row.nodes[0] > 0) { ", printing + projection," } else { "" };
    if said.is_empty() {
        return "None of these stays under 1 dE.".to_owned();
    }
    format!("The fewest exponentials{stages} that stay {}.", said.join("; "))
}

pub(super) fn exposure(rows: &[ExposureRow]) -> String {
    let said: Vec<String> =
        rows.iter().map(|row| format!("by {} nm up to {} dE", row.step_nm, figure(row.unmatched.max))).collect();
    let matched = rows.last().map_or_else(String::new, |row| {
        format!(
            " With the matching vector made on the same grid, {} dE by {} nm.",
            figure(row.matched.max),
            row.step_nm
        )
    });
    format!(
        "Integrating spectra and sensitivities on a coarse grid costs, all else exact, {}.{matched} The matrix is made once, so \
         it is always made by 1 nm.",
        listed(&said)
    )
}

pub(super) fn curves(rows: &[CurveRow]) -> String {
    let few = rows.iter().find(|row| row.miss.max <= 0.01);
    let falls = slope(&rows.iter().take(4).map(|row| (row.points as f64, row.miss.max)).collect::<Vec<_>>());
    let falls = falls.map_or_else(String::new, |s| {
        let last = rows.get(3).map_or(0, |row| row.points);
        format!(" Up to {last} points the largest difference goes with their number to the power {s:.1}.")
    });
    match few {
        Some(row) => format!("{} points keep the largest difference under 0.01 dE.{falls}", row.points),
        None => format!("No number of points tried keeps the largest difference under 0.01 dE.{falls}"),
    }
}

pub(super) fn buffers(steps: &[(&'static str, f64)]) -> String {
    let visible: Vec<String> =
        steps.iter().filter(|(_, step)| *step > LIMIT).map(|(name, _)| (*name).to_owned()).collect();
    if visible.is_empty() {
        return "No buffer tried makes a step larger than 1 dE.".to_owned();
    }
    format!("Steps larger than 1 dE, which show as bands on a smooth grey: {}.", listed(&visible))
}

/// Sentences on growth: picture, table, exponentials, threads.
pub(super) fn growth(growth: &Growth) -> [String; 4] {
    let powers = |all: &[Measured]| {
        let said: Vec<String> =
            all.iter().filter_map(|m| Some(format!("{:.2} ({})", slope(&m.points)?, m.name))).collect();
        listed(&said)
    };
    let picture = format!(
        "Time goes with the picture's size to the power {}; strips go through two buffers of {} together, whatever the size.",
        powers(&growth.picture),
        bytes(growth.buffers)
    );
    let table = format!(
        "Time goes with the nodes along a side to the power {}: the work is the same, only the table's memory grows.",
        powers(&growth.table)
    );
    let ends = growth.nodes.first().and_then(|m| Some((*m.points.first()?, *m.points.last()?)));
    let each = ends.filter(|(first, last)| last.0 > first.0).map_or_else(String::new, |(first, last)| {
        format!(
            " From {} to {}, each one more costs {} ns.",
            first.0,
            last.0,
            figure((last.1 - first.1) / (last.0 - first.0))
        )
    });
    let nodes = format!("Time goes with the number of exponentials to the power {}.{each}", powers(&growth.nodes));
    let threads: Vec<String> = growth
        .threads
        .iter()
        .filter_map(|m| {
            let (first, last) = (m.points.first()?, m.points.last()?);
            Some(format!("{} times ({})", figure(last.1 / first.1), m.name))
        })
        .collect();
    let most = growth.threads.first().and_then(|m| m.points.last()).map_or(1.0, |p| p.0);
    let threads = format!("{most} threads do {} what one does.", listed(&threads));
    [picture, table, nodes, threads]
}

#[cfg(test)]
mod tests {
    use onelight::Process;

    use super::*;
    use crate::report::difference::Difference;

    fn row(kind: Kind, detail: &str, (ns, bytes): (f64, usize), max: f64) -> Row {
        let time = Timing { ns, median_ns: ns };
        let error = Difference { mean: max / 10.0, max, ..Difference::default() };
        Row { bytes: Some(bytes), ..Row::bare(kind, detail, time, error) }
    }

    fn said(rows: Vec<Row>) -> Vec<String> {
        let look = Look { name: "a".to_owned(), title: "A".to_owned(), process: Process::default(), rows };
        let copy = Timing { ns: 2.0, median_ns: 2.0 };
        advice(&look, copy, &Elsewhere::default()).into_iter().map(|advice| advice.sentence).collect()
    }

    #[test]
    fn advice_goes_by_bytes_by_time_and_by_difference() {
        let rows = vec![
            row(Kind::Plain, "coarse", (10.0, 10), 3.0),
            row(Kind::Plain, "fast", (20.0, 4000), 0.9),
            row(Kind::Structured, "small", (30.0, 1024), 0.8),
            row(Kind::Structured, "exact", (40.0, 9000), 0.1),
            row(Kind::Direct, "bare", (50.0, 100), 0.09),
            row(Kind::Direct, "rough", (45.0, 90), 0.2),
        ];
        let said = said(rows);
        assert!(said[0].starts_with("structured small,") && said[0].contains("1.00 KiB"), "{}", said[0]);
        assert!(said[1].starts_with("plain fast,") && said[1].contains("10.0 times a copy"), "{}", said[1]);
        assert!(said[1].contains("No graphics card was measured"), "{}", said[1]);
        assert!(
            said[2].starts_with("structured exact,") && said[2].contains("direct bare comes as near"),
            "{}",
            said[2]
        );
    }

    #[test]
    fn nothing_is_advised_where_nothing_is_near() {
        let said = said(vec![row(Kind::Plain, "coarse", (10.0, 10), 3.0)]);
        assert!(said[0].contains("none of these") && said[1].contains("none of these"), "{said:?}");
        assert!(said[2].contains("largest difference 3.00") && !said[2].contains("Without a table"), "{}", said[2]);
    }
}
