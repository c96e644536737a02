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
    /// It takes Sony S-Log3 (S-Gamut3).
    Slog3Sgamut3,
    /// It takes DaVinci Intermediate (DaVinci Wide Gamut).
    Intermediate,
    /// It takes ARRI LogC3 at exposure index 800 (ARRI Wide Gamut 3).
    Logc3,
    /// It takes Panasonic V-Log (V-Gamut).
    Vlog,
    /// It takes Canon Log 2 (Cinema Gamut).
    Clog2,
    /// It takes Canon Log 3 (Cinema Gamut).
    Clog3,
    /// It takes Fujifilm F-Log (F-Gamut, which is BT.2020's).
    Flog,
    /// It takes Fujifilm F-Log2 (F-Gamut, which is BT.2020's).
    Flog2,
    /// It takes Nikon N-Log (N-Gamut, which is BT.2020's).
    Nlog,
    /// It takes RED Log3G10 (`REDWideGamutRGB`).
    Log3g10,
    /// It takes Apple Log (BT.2020).
    AppleLog,
    /// It takes DJI D-Log (D-Gamut).
    Dlog,
    /// It takes HLG (BT.2020), scene 1.0 at 75 %.
    Hlg,
    /// It takes PQ (BT.2020), scene 1.0 at 203 cd/m^2.
    Pq,
    /// It takes Cineon codes of a scanned negative, 0 to 1023: the only one for a print without a camera film.
    Cineon,
    /// It takes sRGB-coded colour: nothing brighter than white.
    Srgb,
    /// It takes video as a studio display shows it, a power of 2.4 (BT.709 primaries): nothing brighter than white.
    Rec709Display,
    /// It takes log2(x / 0.18) from -11 to +12: Bevy's tone-mapping tables, with linear output.
    Bevy,
}

/// Where the entries of a table that takes coded colour may lie.
///
/// Programs that keep a picture in integers wrap what lies outside 0 to 1 or cut it, each in its own way; entries of saturated
/// colours lie as low as -0.43 before they are cut.
///
/// ```
/// use onelight::baked::{EntryRange, Recipe, ShaperChoice};
/// let table = Recipe::taking(ShaperChoice::Srgb);
/// assert_eq!(table.range, EntryRange::Unit);
/// let unclamped = Recipe { range: EntryRange::Any, ..table };
/// # assert_ne!(unclamped, table);
/// ```
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
        ShaperChoice::Slog3Sgamut3 = "slog3-sgamut3" "It takes Sony S-Log3 (S-Gamut3)",
        ShaperChoice::Intermediate = "intermediate" "It takes DaVinci Intermediate (DaVinci Wide Gamut)",
        ShaperChoice::Logc3 = "logc3" "It takes ARRI LogC3, EI 800 (ARRI Wide Gamut 3)",
        ShaperChoice::Vlog = "vlog" "It takes Panasonic V-Log (V-Gamut)",
        ShaperChoice::Clog2 = "clog2" "It takes Canon Log 2 (Cinema Gamut)",
        ShaperChoice::Clog3 = "clog3" "It takes Canon Log 3 (Cinema Gamut)",
        ShaperChoice::Flog = "flog" "It takes Fujifilm F-Log (F-Gamut)",
        ShaperChoice::Flog2 = "flog2" "It takes Fujifilm F-Log2 (F-Gamut)",
        ShaperChoice::Nlog = "nlog" "It takes Nikon N-Log (N-Gamut)",
        ShaperChoice::Log3g10 = "log3g10" "It takes RED Log3G10 (REDWideGamutRGB)",
        ShaperChoice::AppleLog = "apple-log" "It takes Apple Log (BT.2020)",
        ShaperChoice::Dlog = "dlog" "It takes DJI D-Log (D-Gamut)",
        ShaperChoice::Hlg = "hlg" "It takes HLG (BT.2020), scene 1.0 at 75 %",
        ShaperChoice::Pq = "pq" "It takes PQ (BT.2020), scene 1.0 at 203 cd/m^2",
        ShaperChoice::Cineon = "cineon" "It takes Cineon codes of a scanned negative, 0 to 1023: with --camera none",
        ShaperChoice::Srgb = "srgb" "It takes sRGB-coded colour: nothing brighter than white",
        ShaperChoice::Rec709Display = "rec709-display" "It takes video as a display of gamma 2.4 shows it: nothing brighter than white",
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
        let curve = match self {
            Self::Log2 | Self::Gotanda => return Ok(None),
            Self::Bevy => return Coordinate::bevy(spaces).map(Some),
            Self::Cineon => return Coordinate::cineon(spaces).map(Some),
            Self::Acescct => SceneCurve::AcesCct,
            Self::Logc4 => SceneCurve::LogC4,
            Self::Slog3 => SceneCurve::SLog3,
            Self::Slog3Sgamut3 => SceneCurve::SLog3SGamut3,
            Self::Intermediate => SceneCurve::DaVinciIntermediate,
            Self::Logc3 => SceneCurve::LogC3,
            Self::Vlog => SceneCurve::VLog,
            Self::Clog2 => SceneCurve::CLog2,
            Self::Clog3 => SceneCurve::CLog3,
            Self::Flog => SceneCurve::FLog,
            Self::Flog2 => SceneCurve::FLog2,
            Self::Nlog => SceneCurve::NLog,
            Self::Log3g10 => SceneCurve::Log3G10,
            Self::AppleLog => SceneCurve::AppleLog,
            Self::Dlog => SceneCurve::DLog,
            Self::Hlg => SceneCurve::Hlg,
            Self::Pq => SceneCurve::Pq,
            Self::Srgb => SceneCurve::Srgb,
            Self::Rec709Display => SceneCurve::Rec709Display,
        };
        Coordinate::of_curve(self.word(), curve, spaces).map(Some)
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
