use onelight_lut::{Lut3d, bake_form};
use onelight_spectra::DisplayLinear;

use crate::direct::{DirectSettings, Nodes};
use crate::error::Error;
use crate::reference::Reference;

impl DirectSettings {
    /// What plain tables are baked with: 5 nm for most films, 10 nm for some, so that entries lie within 0.05 dE of the exact
    /// film's, a fraction of what reading between them costs.
    pub const BAKING: Self = Self { nodes: Nodes::GridUnderMaxDe(0.05) };
}

impl Reference {
    /// A table of display-coded entries for a plain form: milliseconds. `at` gives the scene-linear colour for coordinates from
    /// 0 to 1.
    ///
    /// Entries are those of the direct form [`DirectSettings::BAKING`], in float32. For more tables of one film, make that form
    /// once and call [`bake_form`].
    ///
    /// ```
    /// let film = onelight::Process::default().compile()?;
    /// let shaper = onelight::lut::Shaper::log2(0.02, 8.0)?;
    /// let table = film.bake(33, |t| t.map(|t| shaper.decode(t)))?;
    /// let white = film.develop([8.0; 3]);
    /// assert!(table.apply([1.0; 3], Default::default()).iter().zip(white).all(|(a, b)| (f64::from(*a) - b).abs() < 1e-3));
    /// # Ok::<(), onelight::Error>(())
    /// ```
    ///
    /// # Errors
    /// If the size is out of bounds.
    pub fn bake(&self, size: usize, at: impl Fn([f64; 3]) -> [f64; 3] + Sync) -> Result<Lut3d, Error> {
        if !self.coding().curve.is_hdr() {
            return Ok(bake_form(size, at, &self.direct(&DirectSettings::BAKING)?)?);
        }
        // Forms code by powers alone.
        let table = bake_form(size, at, &self.in_linear_light().direct(&DirectSettings::BAKING)?)?;
        let coding = self.coding();
        let coded = |entry: [f32; 3]| coding.encode_rgb(DisplayLinear(entry.map(f64::from))).map(|v| v as f32);
        Ok(Lut3d::new(size, table.entries().map(coded).collect())?)
    }
}
