mod build;
mod cdl;
mod coupling;
mod op;
mod read;
mod write;

use crate::text::{one_line, printable};
use op::Op;

/// A file of the Common LUT Format, the Academy's version 3 \[S2014-006\] and SMPTE's \[ST2136-1\] in one: operations that one colour passes in turn.
///
/// It holds a structured LUT whole, so a program that reads CLF needs nothing beside it. Written are, for a
/// [`onelight_lut::StructuredLut`]:
///
/// | Step | Operations |
/// |---|---|
/// | input | `Range` ±1e16, `Matrix`, `Range` 0 to 1e16; without a matrix only the second range |
/// | exposure | `Matrix`, `Range` from 1e-12, `Log` of base 2 scaled to the curves' domain, `LUT1D` |
/// | mix, where there is one | `Matrix` with offset, scaled to the second curves' domain, `LUT1D` |
/// | table | `LUT3D` |
/// | densities, where the table holds them | `Matrix` -1, `Log` antiLog10, `Matrix`, `Exponent` mirrored about 0 |
///
/// All numbers are 32-bit floats to the program that reads them (`32f`). The first range lets no infinity reach a
/// matrix, where it would become NaN; NaN in a colour reads as the lower end of that range. With an input matrix that is
/// -1e16, whose effect on the other channels differs from [`onelight_lut::StructuredLut`], where NaN counts as 0.
///
/// Reading takes the operations `Matrix`, `Range`, `Log`, `Exponent`, `ASC_CDL`, `LUT1D` and `LUT3D` in any order and of every style,
/// in depths of floats and integers, the codes of which become parts of the largest: [`ClfProcess::apply`] takes and gives numbers
/// of which 1 is white. Half-float domains and raw halfs are refused by name; so are files without an operation or an
/// id, and operations whose depths do not join.
///
/// ```
/// use onelight_formats::ClfProcess;
/// use onelight_lut::{Interpolation, Lut3d, PlainLut, Shaper};
///
/// let lut = PlainLut::new(Shaper::log2(0.02, 4.0)?, Lut3d::identity(5)?, Interpolation::Tetrahedral);
/// let mut file = Vec::new();
/// ClfProcess::from_plain(&lut)?.with_name("log").write(&mut file)?;
///
/// let back = ClfProcess::read(file.as_slice())?;
/// let [found, expected] = [back.apply([0.18; 3])[0], lut.apply([0.18; 3])[0]];
/// assert!((found - expected).abs() < 1e-6);
/// # Ok::<(), onelight_formats::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ClfProcess {
    name: String,
    descriptions: Vec<String>,
    input: String,
    output: String,
    ops: Vec<Op>,
}

impl ClfProcess {
    /// The most bytes of text that are read.
    pub const MAX_BYTES: u64 = 1 << 30;

    /// The most operations of a file that is read.
    pub const MAX_OPERATIONS: usize = 64;

    /// The most bytes that all descriptions of a file that is read may have.
    pub const MAX_DESCRIPTION_BYTES: usize = 1 << 20;

    /// The same operations under a name, which is also the file's `id`.
    #[must_use]
    pub fn with_name(mut self, name: &str) -> Self {
        self.name = one_line(name).trim().to_owned();
        self
    }

    /// The same operations under other descriptions; each may have several lines.
    #[must_use]
    pub fn with_descriptions<S: AsRef<str>>(mut self, descriptions: impl IntoIterator<Item = S>) -> Self {
        self.descriptions = descriptions.into_iter().map(|text| printable(text.as_ref()).trim().to_owned()).collect();
        self
    }

    /// The same operations with a word on what goes in and what comes out, such as "scene-linear sRGB primaries".
    #[must_use]
    pub fn with_descriptors(mut self, input: &str, output: &str) -> Self {
        [self.input, self.output] = [input, output].map(|text| printable(text).trim().to_owned());
        self
    }

    /// The name, empty if there is none.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The descriptions of the whole file.
    pub fn descriptions(&self) -> &[String] {
        &self.descriptions
    }

    /// What goes in and what comes out, empty where the file does not say.
    pub fn descriptors(&self) -> [&str; 2] {
        [&self.input, &self.output]
    }

    /// The elements of the operations, in turn, such as `Matrix`.
    pub fn operations(&self) -> impl ExactSizeIterator<Item = &'static str> {
        self.ops.iter().map(Op::element)
    }

    /// What the file's numbers say about one colour.
    ///
    /// Analytic operations are evaluated in `f64`, tables in `f32`.
    pub fn apply(&self, rgb: [f32; 3]) -> [f32; 3] {
        self.ops.iter().fold(rgb.map(f64::from), |rgb, op| op.apply(rgb)).map(|v| v as f32)
    }

    fn with_ops(ops: Vec<Op>) -> Self {
        Self { name: String::new(), descriptions: Vec::new(), input: String::new(), output: String::new(), ops }
    }
}
