//! A stage as bare numbers: for whoever runs it elsewhere, such as on a graphics card.

use crate::cells::CellAxis;
use crate::frame::Frame;
use crate::grain::{Grain, GrainNumbers};
use crate::halation::{Halation, HaloKernel};
use crate::operator::{AxisMap, Operator, across_layers, blur_operators};
use crate::sharpness::{AdjacencyBlur, LayerBlurs};
use crate::stage::SpatialStage;

/// The numbers of a [`SpatialStage`], in the order in which they are used; an effect that is left out has none.
///
/// Sums are in another order than in the loops of the stage, so that exposures differ by some 1e-6 of the largest nearby. Grain is in
/// whole numbers and the same to the bit ([`GrainNumbers`]).
///
/// ```
/// # use onelight_film::{SheetText, Stock};
/// # use onelight_spatial::{FilmFormat, Frame, Sharpness, SpatialStage};
/// # let f = onelight_stocks::find("kodak-5207").ok_or("no such stock")?;
/// # let stock = Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #     characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?
/// #     .with_figures(f.mtf_csv, f.granularity_csv)?;
/// let frame = Frame::new([64, 36], FilmFormat::Super35.pitch(2048, 1.0)?)?;
/// let numbers = SpatialStage::new(frame).with_sharpness(&Sharpness::of_stock(&stock)?).numbers();
/// let [x, _] = &numbers.scatter.ok_or("sharpness scatters")?.wide;
/// // A red layer of 1 everywhere stays so.
/// let sum: f32 = x.weights[..x.count].iter().map(|layers| layers[0]).sum();
/// assert!((sum - 1.0).abs() < 1e-6 && x.first.len() == 64);
/// assert!(numbers.halation.is_none() && numbers.grain.is_none());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct StageNumbers {
    /// The picture.
    pub frame: Frame,
    /// Exposure to exposure.
    pub scatter: Option<ScatterNumbers>,
    /// Exposure to exposure, from the exposures before scatter.
    pub halation: Option<HalationNumbers>,
    /// Amounts to amounts, after development.
    pub adjacency: Option<AdjacencyNumbers>,
    /// Amounts to amounts.
    pub grain: Option<GrainNumbers>,
}

/// `E -> wide + share (narrow - wide)`, two blurs of exposures along x, then along y.
#[derive(Debug, Clone, PartialEq)]
pub struct ScatterNumbers {
    /// Share of the narrow blur in each layer.
    pub share: [f32; 3],
    /// The narrow blur.
    pub narrow: [AxisMap; 2],
    /// The wide blur.
    pub wide: [AxisMap; 2],
}

/// `E -> E + pull (field - E)`. The field is made of means over cells: `max(0, own - hole + sum of share (blurred - own))`.
#[derive(Debug, Clone, PartialEq)]
pub struct HalationNumbers {
    /// By how much each layer's exposure goes towards the field.
    pub pull: [f32; 3],
    /// Pixels to means of cells, along x, then along y.
    pub to_cells: [AxisMap; 2],
    /// Share and blur of each Gaussian, cells to cells.
    pub gaussians: Vec<(f32, [AxisMap; 2])>,
    /// How many cells the hole reaches on either side, along x and y.
    pub hole_reach: [usize; 2],
    /// Weights of the cells of the hole, row by row, all of them: what is lost is `sum of weight (cell - own)`. Beyond the picture its
    /// cells repeat.
    pub hole: Vec<f32>,
    /// Cells to pixels, along x, then along y.
    pub to_pixels: [AxisMap; 2],
}

/// `a -> max(0, a + strength (a - blurred))`.
#[derive(Debug, Clone, PartialEq)]
pub struct AdjacencyNumbers {
    /// Strength in each layer.
    pub strength: [f32; 3],
    /// The blur, along x, then along y.
    pub blur: [AxisMap; 2],
}

impl SpatialStage {
    /// The numbers that its loops work with.
    #[must_use]
    pub fn numbers(&self) -> StageNumbers {
        let frame = *self.frame();
        let size = [frame.width(), frame.height()];
        let layers: Option<[&LayerBlurs; 3]> = self.blurs().map(<[LayerBlurs; 3]>::each_ref);
        let scatter = layers.filter(|layers| layers.iter().any(|layer| layer.scatter.is_some())).map(|layers| {
            let scatter = layers.map(|layer| layer.scatter.as_ref());
            let map = |pick: fn(&crate::sharpness::Scatter) -> &[Vec<f32>; 2]| {
                [0, 1].map(|axis| {
                    across_layers(&scatter.map(|layer| {
                        layer.map_or_else(
                            || Operator::identity(size[axis]),
                            |s| Operator::taps(size[axis], &pick(s)[axis]),
                        )
                    }))
                })
            };
            ScatterNumbers {
                share: scatter.map(|layer| layer.map_or(0.0, |scatter| scatter.narrow_share)),
                narrow: map(|scatter| &scatter.narrow),
                wide: map(|scatter| &scatter.wide),
            }
        });
        let adjacency = layers.filter(|layers| layers.iter().any(|layer| layer.adjacency.is_some())).map(|layers| {
            let adjacency = layers.map(|layer| layer.adjacency.as_ref());
            let blur = |axis: usize| {
                across_layers(&adjacency.map(|layer| match layer.map(|adjacency| &adjacency.blur) {
                    None => Operator::identity(size[axis]),
                    Some(AdjacencyBlur::Pixels(taps)) => Operator::taps(size[axis], &taps[axis]),
                    Some(AdjacencyBlur::Cells(axes, taps)) => Operator::in_cells(&axes[axis], &taps[axis]),
                }))
            };
            AdjacencyNumbers {
                strength: adjacency.map(|layer| layer.map_or(0.0, |adjacency| adjacency.strength)),
                blur: [blur(0), blur(1)],
            }
        });
        StageNumbers {
            frame,
            scatter,
            halation: self.halation().map(|halation| halation_numbers(halation, &frame)),
            adjacency,
            grain: self.grain().map(Grain::numbers),
        }
    }
}

fn halation_numbers(halation: &Halation, frame: &Frame) -> HalationNumbers {
    let axes: [CellAxis; 2] = halation.cell_axes(frame);
    let pitch = [frame.pitch().x_um(), frame.pitch().y_um()];
    let kernel = HaloKernel::new(halation, axes, pitch);
    let same = |operator: Operator| across_layers(&[operator.clone(), operator.clone(), operator]);
    let gaussians = kernel.gaussians().iter().map(|(share, sigma)| {
        let [x, y] = blur_operators([&axes[0], &axes[1]], *sigma);
        (*share, [same(x), same(y)])
    });
    let hole = kernel.hole();
    let reach = [hole.iter().map(|(_, side)| side.len()).max().unwrap_or(0), hole.len() - 1];
    let weight = |dx: usize, dy: usize| {
        let (centre, side) = &hole[dy];
        if dx == 0 { *centre } else { side.get(dx - 1).copied().unwrap_or(0.0) }
    };
    let rows = 0..=2 * reach[1];
    let weights = rows.flat_map(|y| (0..=2 * reach[0]).map(move |x| (x, y)));
    HalationNumbers {
        pull: halation.pull().map(|pull| pull as f32),
        to_cells: axes.map(|axis| same(Operator::means(&axis))),
        gaussians: gaussians.collect(),
        hole: weights.map(|(x, y)| weight(x.abs_diff(reach[0]), y.abs_diff(reach[1]))).collect(),
        hole_reach: reach,
        to_pixels: axes.map(|axis| same(Operator::expansion(&axis))),
    }
}
