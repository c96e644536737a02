//! The forms that are compared, and what they are called.

use onelight::baked::{Form as BakedAs, Recipe, ShaperChoice};
use onelight::lut::Storage;
use onelight::{DirectSettings, Entries, Look, Nodes, Reference, TableCoding, Word};
use serde::Serialize;

use super::scope::Scope;
use crate::error::Result;
use crate::form::Form;

/// What a figure belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Kind {
    /// The 32^3 table of \[Gotanda2010\].
    Talk,
    Plain,
    Structured,
    Direct,
    /// The film itself, float64 at 1 nm.
    Reference,
    /// A form on a graphics card, measured by another command.
    Gpu,
    /// Our plain table applied by another program, measured by another command.
    Outside,
}

impl Kind {
    pub(super) const ALL: [Self; 7] =
        [Self::Talk, Self::Plain, Self::Structured, Self::Direct, Self::Reference, Self::Gpu, Self::Outside];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Talk => "the talk's",
            Self::Plain => "plain",
            Self::Structured => "structured",
            Self::Direct => "direct",
            Self::Reference => "reference",
            Self::Gpu => "on a graphics card",
            Self::Outside => "plain 33 by another program",
        }
    }

    /// Whether it is one of our tables: a fetch for each pixel, and a file that programs load.
    pub(super) fn is_table(self) -> bool {
        matches!(self, Self::Plain | Self::Structured)
    }
}

/// One form of a look, with the facts that a reader chooses by.
pub(super) struct Made {
    pub(super) kind: Kind,
    /// What tells it from others of its kind: `32, f16`.
    pub(super) detail: String,
    pub(super) size: Option<usize>,
    pub(super) storage: Option<Storage>,
    pub(super) coding: Option<TableCoding>,
    /// Exponentials of the print's exposure (none for reversal film) and of the projection.
    pub(super) nodes: Option<[usize; 2]>,
    /// Of all tables and curves.
    pub(super) bytes: usize,
    pub(super) form: Form,
    /// Which time it shares: on a processor all storages are read as 32-bit floats.
    pub(super) timed: usize,
}

/// Bytes of a curve's point, three channels of 32 bits, and of a term of a sum of exponentials.
const CURVE_POINT: usize = 12;
const TERM: usize = 24;

const STORED_DENSITY: [Storage; 3] = [Storage::F32, Storage::F16, Storage::Unorm16];
const STORED_DISPLAY: [Storage; 3] = [Storage::F16, Storage::Unorm10, Storage::Unorm8];
/// Largest table of display-coded entries.
const DISPLAY_SIZE: usize = 32;
const GRIDS_NM: [usize; 5] = [1, 2, 5, 10, 20];
/// Fitted exponentials of printing and of projection, as many of each as keep their shares of the difference alike.
const FITTED: [[usize; 2]; 9] = [[3, 4], [3, 5], [4, 6], [4, 7], [4, 8], [5, 9], [5, 10], [6, 12], [7, 14]];

/// All forms of a look, those of one time next to each other.
pub(super) fn all(film: &Reference, scope: Scope, done: impl Fn()) -> Result<Vec<Made>> {
    let look = Look::from(film.clone());
    let (plain, structured): (&[usize], &[usize]) = match scope {
        Scope::Full => (&[17, 33, 65], &[8, 16, 24, 32, 48, 64]),
        Scope::Quick => (&[17], &[8, 16]),
    };
    let mut made = Made::direct(film, scope)?;
    done();
    let mut add = |kind, form: Form, stored: &[Storage], coding: Option<TableCoding>, detail: &str| -> Result<()> {
        let group = made.last().map_or(0, |last| last.timed + 1);
        let stored = Made::stored((kind, detail), &form, coding, stored)?;
        made.extend(stored.into_iter().map(|m| Made { timed: group, ..m }));
        done();
        Ok(())
    };
    let usual = Recipe { entries: Entries::Fitted, ..Recipe::of(BakedAs::Plain) };
    let talk = Recipe { size: 32, shaper: ShaperChoice::Gotanda, entries: Entries::Sampled, ..usual };
    add(Kind::Talk, Form::baked(&look, &talk)?, &[Storage::F16], None, "")?;
    for &size in plain {
        let all = [&STORED_DENSITY[..], &STORED_DISPLAY[1..]].concat();
        add(Kind::Plain, Form::baked(&look, &Recipe { size, ..usual })?, &all, None, "")?;
    }
    if scope == Scope::Full {
        add(Kind::Plain, Form::baked(&look, &Recipe { stops: Some(6.0), ..usual })?, &[Storage::F16], None, " to +6")?;
    }
    let of_structured = |size, coding| Form::baked(&look, &Recipe { size, coding, ..Recipe::of(BakedAs::Structured) });
    for &size in structured {
        let coding = TableCoding::Density;
        add(Kind::Structured, of_structured(size, coding)?, &STORED_DENSITY, Some(coding), "")?;
        // Finer tables gain nothing from entries as coarse as these.
        if size <= DISPLAY_SIZE {
            let coding = TableCoding::Display;
            add(Kind::Structured, of_structured(size, coding)?, &STORED_DISPLAY, Some(coding), " display")?;
        }
    }
    Ok(made)
}

/// How often `done` of [`all`] is called.
pub(super) fn steps(scope: Scope) -> u64 {
    match scope {
        Scope::Full => 1 + 1 + 4 + 10,
        Scope::Quick => 1 + 1 + 1 + 4,
    }
}

impl Made {
    /// One table in several storages: fitted once.
    fn stored(
        (kind, detail): (Kind, &str),
        exact: &Form,
        coding: Option<TableCoding>,
        stored: &[Storage],
    ) -> Result<Vec<Self>> {
        let curves = match exact {
            Form::Structured(lut) => {
                lut.parts().develop.curves.size() + lut.parts().mix.as_ref().map_or(0, |mix| mix.curves.size())
            }
            Form::Plain(_) | Form::Direct(_) => 0,
        };
        let Some(table) = exact.table() else { return Ok(Vec::new()) };
        let size = table.size();
        let mut made = Vec::new();
        for &storage in stored {
            made.push(Self {
                kind,
                detail: format!("{size}{detail}, {}", short(storage)),
                size: Some(size),
                storage: Some(storage),
                coding,
                nodes: None,
                bytes: storage.bytes() * size.pow(3) + curves * CURVE_POINT,
                form: exact.with_table(storage.stored(table)?),
                timed: 0,
            });
        }
        Ok(made)
    }

    /// Even grids of wavelengths, and fitted exponentials.
    fn direct(film: &Reference, scope: Scope) -> Result<Vec<Self>> {
        let grids = GRIDS_NM.into_iter().filter(|&nm| scope == Scope::Full || nm >= 10);
        let grids = grids.map(|step_nm| (Some(step_nm), Nodes::Grid { step_nm }));
        let fitted = FITTED.into_iter().filter(|counts| scope == Scope::Full || counts[1] == 9);
        let fitted = fitted.map(|[duplication, projection]| (None, Nodes::Counts { projection, duplication }));
        let mut made = Vec::new();
        for (timed, (step_nm, nodes)) in grids.chain(fitted).enumerate() {
            let form = film.direct(&DirectSettings { nodes })?;
            let parts = form.parts();
            let terms = [parts.print.as_ref().map_or(0, |p| p.exposure.terms().len()), parts.projection.terms().len()];
            let detail = step_nm.map_or_else(|| sum(terms), |step_nm| format!("{step_nm} nm"));
            let curves = parts.develop.curves.size() + parts.print.as_ref().map_or(0, |p| p.curves.size());
            made.push(Self {
                kind: Kind::Direct,
                detail,
                size: None,
                storage: None,
                coding: None,
                nodes: Some(terms),
                bytes: terms.iter().sum::<usize>() * TERM + curves * CURVE_POINT,
                form: Form::Direct(Box::new(form)),
                timed,
            });
        }
        Ok(made)
    }
}

/// Exponentials of printing and of projection: `5 + 9`, or `9` where nothing is printed.
pub(super) fn sum([printing, projection]: [usize; 2]) -> String {
    if printing == 0 { projection.to_string() } else { format!("{printing} + {projection}") }
}

/// A storage as it is written beside a size.
pub(super) fn short(storage: Storage) -> &'static str {
    match storage {
        Storage::Unorm10 => "10 bit",
        Storage::Unorm8 => "8 bit",
        Storage::Unorm16 => "16 bit",
        Storage::F32 | Storage::F16 => storage.word(),
    }
}
