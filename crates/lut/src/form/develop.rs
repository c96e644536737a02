use fearless_simd::Level;

use crate::error::{Error, ErrorKind};
use crate::kernel::block::Block;
use crate::kernel::coupling::{CouplingCurves, MAX_PIECES};
use crate::kernel::curves::Curves;
use crate::kernel::steps::widened;
use crate::lut1d::Lut1d;
use crate::number::Number;
use crate::scene_light::{Rows, check_rows, times};

/// From the log2 exposure of each layer to what the first film holds: the second step of
/// [`StructuredLut`](crate::StructuredLut) and [`DirectForm`](crate::DirectForm).
///
/// ```
/// use onelight_lut::{Coupling, Develop, Lut1d};
/// let curves = Lut1d::sample(64, [-10.0, 10.0], |h| h)?;
/// let alone = Develop { coupling: None, curves: curves.clone() };
/// assert!((alone.apply([1.0, 0.0, 0.0])[1]).abs() < 1e-6);
/// // A layer that gets more light than its neighbours is raised, they are held back.
/// let matrix = [[0.2, -0.1, -0.1], [-0.1, 0.2, -0.1], [-0.1, -0.1, 0.2]];
/// let coupled = Develop { coupling: Some(Coupling { curves: curves.clone(), matrix }), curves };
/// let [red, green, _] = coupled.apply([1.0, 0.0, 0.0]);
/// assert!((red - 1.2).abs() < 1e-5 && (green + 0.1).abs() < 1e-5);
/// assert!((coupled.apply([2.0; 3])[0] - 2.0).abs() < 1e-5);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Develop {
    /// What layers do to each other before their curves are read.
    pub coupling: Option<Coupling>,
    /// A curve over log2 exposure for each layer.
    pub curves: Lut1d,
}

/// Layers that act on each other: `h' = h + matrix q`, where `q` are the values of `curves` at the log2 exposures `h`. The curves
/// of [`Develop`] are then read at `h'`.
///
/// ```
/// use onelight_lut::{Coupling, Lut1d};
/// // Each layer holds the two others back by a tenth of a stop for each stop of its own exposure.
/// let matrix = [[0.2, -0.1, -0.1], [-0.1, 0.2, -0.1], [-0.1, -0.1, 0.2]];
/// let coupling = Coupling { curves: Lut1d::sample(Coupling::MAX_SIZE, [-16.0, 16.0], |h| h)?, matrix };
/// assert!(coupling.matrix.iter().all(|row| row.iter().sum::<f32>().abs() < 1e-6), "greys stay");
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Coupling {
    /// A curve over log2 exposure for each layer: what acts. At most [`Coupling::MAX_SIZE`] entries.
    pub curves: Lut1d,
    /// In log2 exposure for a unit of `q`. Where rows sum to 0 and layers are alike, nothing moves.
    pub matrix: Rows,
}

impl Coupling {
    /// The most entries of its curves.
    pub const MAX_SIZE: usize = MAX_PIECES + 1;
}

impl Develop {
    /// What the layers hold at these log2 exposures.
    #[inline]
    pub fn apply(&self, log2_exposure: [f32; 3]) -> [f32; 3] {
        self.apply_in(log2_exposure)
    }

    /// The one definition of [`Develop::apply`], for float32 and float64.
    #[inline]
    pub(crate) fn apply_in<N: Number>(&self, h: [N; 3]) -> [N; 3] {
        let Some(Coupling { curves, matrix }) = &self.coupling else { return self.curves.apply_in(h) };
        let shift = times(matrix, curves.apply_in(h));
        self.curves.apply_in(std::array::from_fn(|i| h[i] + shift[i]))
    }

    pub(crate) fn check(&self) -> Result<(), Error> {
        let Some(coupling) = &self.coupling else { return Ok(()) };
        let found = coupling.curves.size();
        if found > Coupling::MAX_SIZE {
            return Err(ErrorKind::Size {
                what: "curves of a coupling",
                found,
                min: Lut1d::MIN_SIZE,
                max: Coupling::MAX_SIZE,
            }
            .into());
        }
        check_rows("coupling matrix", &coupling.matrix)
    }
}

/// The curves of a [`Develop`] as the loops read them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DevelopCurves {
    coupling: Option<CouplingCurves>,
    curves: Curves,
    /// The least and the largest that each curve gives, widened.
    held: [[f32; 2]; 3],
}

impl DevelopCurves {
    pub(crate) fn new(develop: &Develop) -> Self {
        let coupling = develop.coupling.as_ref();
        let coupling = coupling.map(|coupling| CouplingCurves::new(&coupling.curves, coupling.matrix));
        Self { coupling, curves: Curves::new(&develop.curves), held: widened(develop.curves.ends()) }
    }

    /// Between what values are held that do not come from the curves.
    pub(crate) fn held(&self) -> [[f32; 2]; 3] {
        self.held
    }

    /// [`Develop::apply`] of the block's colours.
    pub(crate) fn apply(&self, level: Level, block: &mut Block, count: usize) {
        if let Some(coupling) = &self.coupling {
            coupling.apply(level, block, count);
        }
        self.curves.apply(level, block, count);
    }
}
