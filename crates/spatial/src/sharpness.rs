use onelight_film::{PerLayer, Stock};

use crate::cells::{CELLS_PER_SIGMA, CellAxis, cell_taps};
use crate::error::Error;
use crate::format::Pitch;
use crate::frame::Frame;
use crate::mtf::MtfFit;
use crate::taps::Taps;

/// A strength of adjacency that changes no amount by more than grain of a hundredth of its least strength.
const LEAST_ADJACENCY: f64 = 1e-4;

/// Sharpness of a film: light scatters in the emulsion before it is developed, and development depends on the development beside it.
///
/// ```
/// use onelight_film::{SheetText, Stock};
/// use onelight_spatial::{FilmFormat, Sharpness};
/// # let f = onelight_stocks::find("kodak-5207").ok_or("no such stock")?;
/// # let stock = Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #     characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?
/// #     .with_figures(f.mtf_csv, f.granularity_csv)?;
/// let sharpness = Sharpness::of_stock(&stock)?;
/// assert!(sharpness.layers().green.response(10.0) > 1.0, "adjacency");
/// let pitch = FilmFormat::Super35.pitch(8192, 1.0)?;
/// assert!(sharpness.is_extrapolated(pitch), "the sheet ends at 79 cycles per mm");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Sharpness {
    layers: PerLayer<MtfFit>,
    /// The highest frequency that the sheet publishes, in cycles per mm.
    last_published: f64,
}

impl Sharpness {
    /// From the sheet of a stock.
    ///
    /// # Errors
    /// As [`MtfFit::of_stock`].
    pub fn of_stock(stock: &Stock) -> Result<Self, Error> {
        let layers = MtfFit::of_stock(stock)?;
        let ends = stock.modulation_transfer()?.map(|curve| curve.points().map(|(f, _)| f).fold(0.0, f64::max));
        Ok(Self { layers, last_published: ends.to_array().into_iter().fold(0.0, f64::max) })
    }

    /// The fits of the layers.
    #[must_use]
    pub fn layers(&self) -> PerLayer<&MtfFit> {
        self.layers.as_ref()
    }

    /// Whether pixels of this size show frequencies beyond the sheet's last, for which the fit goes on by itself.
    #[must_use]
    pub fn is_extrapolated(&self, pitch: Pitch) -> bool {
        500.0 / pitch.x_um().min(pitch.y_um()) > self.last_published
    }

    /// The blurs of each layer in pixels.
    pub(crate) fn in_pixels(&self, frame: &Frame) -> [LayerBlurs; 3] {
        self.layers.map(|fit| LayerBlurs::new(&fit, frame)).to_array()
    }
}

/// The blurs of one layer, in the pixels of one frame.
#[derive(Debug, Clone)]
pub(crate) struct LayerBlurs {
    pub(crate) scatter: Option<Scatter>,
    pub(crate) adjacency: Option<Adjacency>,
}

/// Two Gaussians of light.
#[derive(Debug, Clone)]
pub(crate) struct Scatter {
    /// Share of the narrow one.
    pub(crate) narrow_share: f32,
    /// Taps along both axes.
    pub(crate) narrow: [Vec<f32>; 2],
    pub(crate) wide: [Vec<f32>; 2],
}

/// What development beside it does to development.
#[derive(Debug, Clone)]
pub(crate) struct Adjacency {
    pub(crate) strength: f32,
    pub(crate) blur: AdjacencyBlur,
}

#[derive(Debug, Clone)]
pub(crate) enum AdjacencyBlur {
    /// Taps along both axes.
    Pixels([Vec<f32>; 2]),
    /// Cells, and taps over them, along both axes.
    Cells([CellAxis; 2], [Vec<f32>; 2]),
}

impl LayerBlurs {
    fn new(fit: &MtfFit, frame: &Frame) -> Self {
        let pitch = [frame.pitch().x_um(), frame.pitch().y_um()];
        let taps = |um: f64| pitch.map(|pitch| Taps::of(um / pitch).rounded());
        let (narrow, wide) = (taps(fit.narrow_um), taps(fit.wide_um));
        let scatters = [&narrow, &wide].iter().any(|taps| taps.iter().any(|side| !side.is_empty()));
        let scatter = scatters.then_some(Scatter { narrow_share: fit.narrow_share as f32, narrow, wide });
        let blur = AdjacencyBlur::new(fit.adjacency_um, frame);
        let acts = fit.adjacency > LEAST_ADJACENCY && blur.acts();
        let adjacency = acts.then_some(Adjacency { strength: fit.adjacency as f32, blur });
        Self { scatter, adjacency }
    }
}

impl LayerBlurs {
    /// The same on the film for a part of the picture: cells are counted from the frame's origin.
    pub(crate) fn for_part(&self, part: &Frame) -> Self {
        let mut blurs = self.clone();
        if let Some(Adjacency { blur: AdjacencyBlur::Cells([x, y], _), .. }) = &mut blurs.adjacency {
            *x = CellAxis::new(x.size(), part.offset()[0], part.width());
            *y = CellAxis::new(y.size(), part.offset()[1], part.height());
        }
        blurs
    }
}

impl AdjacencyBlur {
    fn new(um: f64, frame: &Frame) -> Self {
        let sigma = [um / frame.pitch().x_um(), um / frame.pitch().y_um()];
        let sizes = sigma.map(|sigma| (sigma / CELLS_PER_SIGMA).floor().max(1.0) as usize);
        if sizes == [1, 1] {
            return Self::Pixels(sigma.map(|sigma| Taps::of(sigma).rounded()));
        }
        let [x, y] = frame.offset();
        let axes = [CellAxis::new(sizes[0], x, frame.width()), CellAxis::new(sizes[1], y, frame.height())];
        let taps = [0, 1].map(|i| cell_taps(&axes[i], sigma[i]).rounded());
        Self::Cells(axes, taps)
    }

    fn acts(&self) -> bool {
        match self {
            Self::Pixels(taps) => taps.iter().any(|side| !side.is_empty()),
            Self::Cells(..) => true,
        }
    }
}

impl Scatter {
    /// Pixels that a pixel depends on, on either side along an axis.
    pub(crate) fn reach(&self, axis: usize) -> usize {
        self.narrow[axis].len().max(self.wide[axis].len())
    }
}
