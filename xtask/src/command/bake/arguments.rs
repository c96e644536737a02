//! The options of `bake`, and those that would do nothing.

use std::path::PathBuf;

use anyhow::{Result, bail};
use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use onelight::baked::{FileFormat, Form, ShaperChoice, Target};
use onelight::lut::Storage;
use onelight::{Entries, Nodes, TableCoding, Word as _};

use crate::look::LookArguments;
use crate::words::words;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    pub(super) look: LookArguments,
    /// Stops by which the scene is made brighter before the film [default: 0]
    #[arg(long, value_name = "STOPS", allow_hyphen_values = true)]
    pub(super) ev: Option<f64>,
    /// Programs to bake for, comma-separated: each gets the form, coding, size and file that it loads best
    #[arg(long = "for", value_delimiter = ',', value_name = "PROGRAMS", value_parser = targets(),
        conflicts_with_all = ["form", "size", "stops", "entries", "storage", "coding", "format", "nodes", "max_de", "unclamped"])]
    pub(super) targets: Vec<Wanted>,
    /// What the look is baked to [default: plain, scene-linear and sRGB-coded]
    #[arg(long, value_parser = words::<Form>())]
    pub(super) form: Option<Form>,
    /// Nodes along each side of the table [default: 33 plain, 65 where it takes a coding, 32 structured]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(2..=129))]
    pub(super) size: Option<u16>,
    /// How scene light becomes a coordinate of a plain table, or which coding it takes instead [default: log2]
    #[arg(long, visible_alias = "input-coding", value_parser = words::<ShaperChoice>())]
    pub(super) shaper: Option<ShaperChoice>,
    /// Where the range of a plain table ends, in stops over mid grey [default: fitted to the look]
    #[arg(long, value_name = "STOPS", value_parser = stops)]
    pub(super) stops: Option<f64>,
    /// Where the entries come from [default: sampled plain, fitted structured]
    #[arg(long, value_parser = words::<Entries>())]
    pub(super) entries: Option<Entries>,
    /// How the entries are stored; what is measured is what was stored [default: f32]
    #[arg(long, value_parser = words::<Storage>())]
    pub(super) storage: Option<Storage>,
    /// What the entries of a structured table are [default: density]
    #[arg(long, value_parser = words::<TableCoding>())]
    pub(super) coding: Option<TableCoding>,
    /// Leave entries of a table that takes a coding outside 0 to 1, where programs with integer pixels wrap them
    #[arg(long)]
    pub(super) unclamped: bool,
    /// Files to write, comma-separated [default: cube for plain, clf for structured, json for direct]
    #[arg(long, value_delimiter = ',', value_name = "FORMATS", value_parser = words::<FileFormat>())]
    pub(super) format: Vec<FileFormat>,
    /// Exponentials of the direct form: of the projection, and of the print's exposure [default: 10,5, and up to 12,8 where a print shows misses]
    #[arg(long, value_name = "P[,D]", value_parser = nodes)]
    pub(super) nodes: Option<Nodes>,
    /// Choose the smallest structured table, or with --form direct the fewest exponentials, whose certified maximum is at most X
    #[arg(long, value_name = "X", conflicts_with_all = ["size", "storage", "coding", "shaper", "stops", "entries", "nodes"])]
    pub(super) max_de: Option<f64>,
    /// Write the LUT alone, at once: no certificate, no preview
    #[arg(long, conflicts_with_all = ["max_de", "scene"])]
    pub(super) quick: bool,
    /// Pictures to measure on, and to fit the range of a plain table to
    #[arg(long, num_args = 1.., value_name = "EXR")]
    pub(super) scene: Vec<PathBuf>,
    /// Folder to write to (target/onelight/ and the films' names if left out)
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Print the result as one JSON object
    #[arg(long)]
    pub(super) json: bool,
}

/// A program that files are wanted for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Wanted {
    All,
    One(Target),
}

fn targets() -> impl TypedValueParser<Value = Wanted> {
    let programs = Target::ALL.iter().map(|(_, word, help)| PossibleValue::new(*word).help(*help));
    let all = PossibleValue::new("all").help("all of them");
    PossibleValuesParser::new(programs.chain([all])).try_map(|word| match word.as_str() {
        "all" => Ok(Wanted::All),
        word => Target::parse(word).map(Wanted::One),
    })
}

fn stops(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|v| (1.0..=40.0).contains(v))
        .ok_or_else(|| "expected a number of stops from 1 to 40".to_owned())
}

fn nodes(text: &str) -> Result<Nodes, String> {
    let counts: Result<Vec<usize>, _> = text.split(',').map(str::parse).collect();
    match (counts.as_deref(), Nodes::USUAL_COUNTS) {
        (Ok(&[projection, duplication]), _) | (Ok(&[projection]), Nodes::Counts { duplication, .. }) => {
            Ok(Nodes::Counts { projection, duplication })
        }
        _ => Err("expected one or two numbers from 2 to 16, such as 8 or 8,4".to_owned()),
    }
}

impl Arguments {
    /// The programs that files are wanted for, each once.
    pub(super) fn programs(&self) -> Vec<Target> {
        let all = || Target::ALL.iter().map(|(target, ..)| *target);
        if self.targets.contains(&Wanted::All) {
            return all().collect();
        }
        all().filter(|target| self.targets.contains(&Wanted::One(*target))).collect()
    }

    /// Whether nothing says which table is wanted.
    pub(super) fn leaves_the_table_open(&self) -> bool {
        let said = self.form.is_some()
            || self.shaper.is_some()
            || self.stops.is_some()
            || self.entries.is_some()
            || self.coding.is_some()
            || self.nodes.is_some()
            || self.max_de.is_some()
            || self.unclamped;
        !said && self.format.is_empty()
    }

    /// Refuses options that would change nothing.
    pub(super) fn refuse_idle_options(&self, usual: ShaperChoice) -> Result<()> {
        let form = self.form.unwrap_or_default();
        let shaper = self.shaper.unwrap_or(usual);
        let forms = |allowed: &[Form]| !allowed.contains(&form);
        let (plain, table) = (&[Form::Plain][..], &[Form::Plain, Form::Structured][..]);
        let by_form = [
            ("--shaper", self.shaper.is_some() && forms(plain), "--form plain"),
            ("--stops", self.stops.is_some() && forms(plain), "--form plain"),
            ("--unclamped", self.unclamped && forms(plain), "--form plain"),
            ("--size", self.size.is_some() && forms(table), "--form plain or structured"),
            ("--storage", self.storage.is_some() && forms(table), "--form plain or structured"),
            ("--entries", self.entries.is_some() && forms(table), "--form plain or structured"),
            ("--coding", self.coding.is_some() && forms(&[Form::Structured]), "--form structured"),
            ("--nodes", self.nodes.is_some() && forms(&[Form::Direct]), "--form direct"),
        ];
        if self.max_de.is_none()
            && let Some((option, _, expected)) = by_form.into_iter().find(|(_, idle, _)| *idle)
        {
            bail!("{option} changes nothing in the {} form, expected {expected} with it", form.word());
        }
        let coded = shaper.is_coding();
        let by_shaper = [
            (
                "--stops",
                self.stops.is_some() && shaper != ShaperChoice::Log2,
                "--shaper log2: the range is the coding's own",
            ),
            (
                "--entries",
                self.entries.is_some() && coded,
                "--shaper log2 or gotanda: entries over a coding are sampled",
            ),
            (
                "--unclamped",
                self.unclamped && !coded,
                "a coding such as --shaper srgb: other tables are never cut to 0 to 1",
            ),
        ];
        if let Some((option, _, expected)) = by_shaper.into_iter().find(|(_, idle, _)| *idle) {
            bail!("{option} changes nothing with --shaper {}, expected {expected}", shaper.word());
        }
        Ok(())
    }
}
