use onelight_lut::Storage;
use onelight_spectra::SceneCurve;

use super::coordinate::Coordinate;
use crate::direct::{DirectSettings, Nodes};
use crate::error::Error;
use crate::process::ColourSpaces;
use crate::structured::{Entries, TableCoding};
use crate::word::{Word as _, words};

/// The forms that a look can be baked to.
///
/// ```
/// use onelight::baked::{Form, Recipe};
/// use onelight::Word;
/// assert_eq!(Recipe::of(Form::parse("structured")?).form, Form::Structured);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Form {
    /// A log2 shaper and one table: every program reads it; the scene's range is limited. The only form of a look without film
    /// curves.
    #[default]
    Plain,
    /// The film's own curves as axes of the table: any range, several times as accurate.
    Structured,
    /// No table: the film's curves and a few exponentials; any range, most accurate.
    Direct,
}

/// How scene light becomes a coordinate of a plain table.
///
/// ```
/// use onelight::baked::ShaperChoice;
/// use onelight::Word;
/// assert_eq!(ShaperChoice::parse("logc4")?.word(), "logc4");
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum ShaperChoice {
    /// log2 with offset and range fitted to the look.
    #[default]
    Log2,
    /// That of \[Gotanda2010\]: log2(u + 0.191406), 0 to 4.
    Gotanda,
    /// The table takes ACEScct (AP1 primaries) instead of scene light.
    Acescct,
    /// It takes ARRI LogC4 (ARRI Wide Gamut 4).
    Logc4,
    /// It takes Sony S-Log3 (S-Gamut3.Cine).
    Slog3,
    /// It takes DaVinci Intermediate (DaVinci Wide Gamut).
    Intermediate,
    /// It takes PQ (BT.2020), scene 1.0 at 100 cd/m^2.
    Pq,
    /// It takes sRGB-coded colour: nothing brighter than white.
    Srgb,
    /// It takes log2(x / 0.18) from -11 to +12: Bevy's tone-mapping tables, with linear output.
    Bevy,
}

/// Where the entries of a table that takes coded colour may lie.
///
/// Programs that keep a picture in integers wrap what lies outside 0 to 1 or cut it, each in its own way; entries of saturated
/// colours lie as low as -0.43 before they are cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum EntryRange {
    /// Cut to 0 to 1, what a display shows.
    #[default]
    Unit,
    /// As the film gives them.
    Any,
}

words! {
    Form, "form":
        Form::Plain = "plain" "A log2 shaper and one table: every program reads it; the scene's range is limited",
        Form::Structured = "structured" "The film's own curves as axes of the table: any range, several times as accurate",
        Form::Direct = "direct" "No table: the film's curves and a few exponentials; any range, most accurate";
    ShaperChoice, "shaper":
        ShaperChoice::Log2 = "log2" "log2 with offset and range fitted to the look",
        ShaperChoice::Gotanda = "gotanda" "The talk's: log2(u + 0.191406), 0 to 4",
        ShaperChoice::Acescct = "acescct" "The table takes ACEScct (AP1 primaries) instead of scene light",
        ShaperChoice::Logc4 = "logc4" "It takes ARRI LogC4 (ARRI Wide Gamut 4)",
        ShaperChoice::Slog3 = "slog3" "It takes Sony S-Log3 (S-Gamut3.Cine)",
        ShaperChoice::Intermediate = "intermediate" "It takes DaVinci Intermediate (DaVinci Wide Gamut)",
        ShaperChoice::Pq = "pq" "It takes PQ (BT.2020), scene 1.0 at 100 cd/m^2",
        ShaperChoice::Srgb = "srgb" "It takes sRGB-coded colour: nothing brighter than white",
        ShaperChoice::Bevy = "bevy" "It takes log2(x / 0.18) from -11 to +12: Bevy's tone-mapping tables, with linear output";
}

impl ShaperChoice {
    /// Whether the table takes a coding of light instead of scene-linear light: what pictures of tables, which hold no shaper,
    /// need.
    #[must_use]
    pub fn is_coding(self) -> bool {
        !matches!(self, Self::Log2 | Self::Gotanda)
    }

    /// The coding that a table takes instead of scene-linear light.
    pub(super) fn coordinate(self, spaces: &ColourSpaces) -> Result<Option<Coordinate>, Error> {
        let (curve, primaries) = match self {
            Self::Log2 | Self::Gotanda => return Ok(None),
            Self::Bevy => return Coordinate::bevy(spaces).map(Some),
            Self::Acescct => (SceneCurve::AcesCct, "AP1"),
            Self::Logc4 => (SceneCurve::LogC4, "ARRI Wide Gamut 4"),
            Self::Slog3 => (SceneCurve::SLog3, "S-Gamut3.Cine"),
            Self::Intermediate => (SceneCurve::DaVinciIntermediate, "DaVinci Wide Gamut"),
            Self::Pq => (SceneCurve::Pq, "BT.2020"),
            Self::Srgb => (SceneCurve::Srgb, "sRGB"),
        };
        Coordinate::of_curve(self.word(), curve, primaries, spaces).map(Some)
    }
}

/// Everything that decides what a look is baked to.
///
/// ```
/// use onelight::baked::{Form, Recipe};
/// use onelight::lut::Storage;
/// let half = Recipe { storage: Storage::F16, ..Recipe::of(Form::Structured) };
/// assert_eq!(half.size, 32);
/// assert_eq!(Recipe::cube(17).form, Form::Plain);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Recipe {
    /// What is made: a table, a table with curves, or curves and exponentials.
    pub form: Form,
    /// Nodes along each side of the table, 2 to [`onelight_lut::Lut3d::MAX_SIZE`]; the direct form has none.
    pub size: usize,
    /// How scene light becomes a coordinate of a plain table.
    pub shaper: ShaperChoice,
    /// Where the range of a plain table ends, in stops about mid grey; `None` fits it.
    pub stops: Option<f64>,
    /// Where the entries come from.
    pub entries: Entries,
    /// How the entries are stored; what is applied and certified is what was stored.
    pub storage: Storage,
    /// Where the entries of a table that takes coded colour may lie.
    pub range: EntryRange,
    /// What the entries of a structured table are.
    pub coding: TableCoding,
    /// The exponentials of a direct form.
    pub nodes: Nodes,
}

impl Default for Recipe {
    fn default() -> Self {
        Self::of(Form::default())
    }
}

impl Recipe {
    /// The usual recipe of a form: 33 nodes plain, 32 structured, 10 + 5 exponentials direct.
    #[must_use]
    pub fn of(form: Form) -> Self {
        let (size, entries) = match form {
            Form::Plain => (33, Entries::Sampled),
            Form::Structured => (32, Entries::Fitted),
            Form::Direct => (0, Entries::Fitted),
        };
        let (storage, coding) = (Storage::F32, TableCoding::Density);
        let nodes = DirectSettings::default().nodes;
        let range = EntryRange::Unit;
        Self { form, size, shaper: ShaperChoice::Log2, stops: None, entries, storage, range, coding, nodes }
    }

    /// The usual plain table behind a shaper: 33 nodes for scene-linear light, 65 for a coding (33 leave a false bright band
    /// from cyan to blue in wide gamuts), the 64 that Bevy's tables have.
    ///
    /// ```
    /// use onelight::baked::{Recipe, ShaperChoice};
    /// assert_eq!(Recipe::taking(ShaperChoice::Logc4).size, 65);
    /// ```
    #[must_use]
    pub fn taking(shaper: ShaperChoice) -> Self {
        let size = match shaper {
            ShaperChoice::Log2 | ShaperChoice::Gotanda => 33,
            ShaperChoice::Bevy => 64,
            _ => 65,
        };
        Self { size, shaper, ..Self::of(Form::Plain) }
    }

    /// A table of this size behind a log2 shaper fitted to the look: what a `.cube` file holds.
    #[must_use]
    pub fn cube(size: usize) -> Self {
        Self { size, ..Self::of(Form::Plain) }
    }
}
