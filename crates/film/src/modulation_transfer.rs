use crate::error::Error;
use crate::layer::PerLayer;
use crate::table::NumberTable;

/// Column of a sheet that shows one curve for all layers.
const ALL: &str = "all";
/// Largest response that is believed: published ones stay below 1.5.
const MAX_RESPONSE: f64 = 3.0;

/// Modulation transfer (MTF) of one layer, as published: how much of the modulation of a sine wave of light is left in the
/// developed film. 1 is that of a large area; development effects raise it above 1.
///
/// ```
/// use onelight_film::{ModulationTransfer, NumberTable};
/// let table = NumberTable::parse("mine/mtf.csv", "cycles_per_mm,all\n5,1.05\n20,0.9\n60,0.3\n")?;
/// let curve = ModulationTransfer::read(&table)?.green;
/// assert_eq!(curve.points().last(), Some((60.0, 0.3)));
/// # Ok::<(), onelight_film::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ModulationTransfer {
    cycles_per_mm: Vec<f64>,
    response: Vec<f64>,
}

impl ModulationTransfer {
    /// Reads `mtf.csv`: `cycles_per_mm`, and responses in `red`, `green` and `blue`, or in `all` where the sheet shows one curve for
    /// the three layers. Blank cells are not published.
    ///
    /// # Errors
    /// If a column is missing, frequencies are not above 0 or do not increase, a layer has fewer than two points, or a response lies
    /// outside 0 to 3.
    pub fn read(table: &NumberTable) -> Result<PerLayer<Self>, Error> {
        let column = |name: &str| {
            let points = table.points("cycles_per_mm", name)?;
            if points.x[0] <= 0.0 {
                return Err(
                    table.problem(1, format!("cycles_per_mm: found {}, expected frequencies above 0", points.x[0]))
                );
            }
            if let Some(found) = points.y.iter().find(|r| !(0.0..=MAX_RESPONSE).contains(*r)) {
                return Err(table.problem(1, format!("{name}: found response {found}, expected 0 to {MAX_RESPONSE}")));
            }
            Ok(Self { cycles_per_mm: points.x, response: points.y })
        };
        if table.names().iter().any(|name| name == ALL) {
            return Ok(PerLayer::all(column(ALL)?));
        }
        PerLayer::all(()).try_map(|(), layer| column(layer))
    }

    /// The published points: frequency in cycles per mm on the film, increasing, and response.
    pub fn points(&self) -> impl ExactSizeIterator<Item = (f64, f64)> {
        self.cycles_per_mm.iter().copied().zip(self.response.iter().copied())
    }
}
