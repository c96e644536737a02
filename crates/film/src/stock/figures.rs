//! The figures of a sheet that not every sheet has: modulation transfer and granularity.

use super::Stock;
use super::sheet::FigureSection;
use crate::error::Error;
use crate::granularity::Granularity;
use crate::layer::PerLayer;
use crate::modulation_transfer::ModulationTransfer;
use crate::printable::printable;
use crate::table::NumberTable;

/// Most characters of an owner's name that a message repeats.
const OWNER_CHARACTERS: usize = 120;

impl Stock {
    /// The stock with what its folder holds of sharpness and grain: the texts of `mtf.csv` and `granularity.csv`, `None` where there is
    /// no such file. `stock.toml` announces each by a section `[mtf]` or `[granularity]`.
    ///
    /// ```
    /// use onelight_film::{SheetText, Stock};
    /// let f = onelight_stocks::find("kodak-5219").ok_or("no such stock")?;
    /// let stock = Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
    ///     characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?
    ///     .with_figures(f.mtf_csv, f.granularity_csv)?;
    /// assert!(stock.modulation_transfer()?.green.points().any(|(_, response)| response > 1.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If a text cannot be read, or the section in `stock.toml` and the file are not both there.
    pub fn with_figures(self, mtf_csv: Option<&str>, granularity_csv: Option<&str>) -> Result<Self, Error> {
        let table = |name: &str, text: &str| NumberTable::parse(&format!("{}/{name}", self.sheet.id), text);
        let mtf = self.figure("mtf", self.sheet.mtf.as_ref(), mtf_csv)?;
        let mtf = mtf.map(|(_, text)| ModulationTransfer::read(&table("mtf.csv", text)?)).transpose()?;
        let granularity = self.figure("granularity", self.sheet.granularity.as_ref(), granularity_csv)?;
        let granularity = granularity.map(|(section, text)| {
            let d_min = section.d_min.ok_or_else(|| {
                Error::stock(self.id(), "[granularity] of stock.toml has no d_min, expected three densities")
            })?;
            Granularity::read(&table("granularity.csv", text)?, PerLayer::from(d_min))
        });
        Ok(Self { mtf, granularity: granularity.transpose()?, ..self })
    }

    /// A section and its file, which go together.
    fn figure<'a>(
        &self,
        name: &str,
        section: Option<&'a FigureSection>,
        csv: Option<&'a str>,
    ) -> Result<Option<(&'a FigureSection, &'a str)>, Error> {
        let copied = section.is_some_and(|section| section.copied_from.is_some());
        let problem = match (section, csv) {
            (Some(section), Some(text)) if !copied => return Ok(Some((section, text))),
            (None, None) => return Ok(None),
            (Some(_), None) if copied => return Ok(None),
            (Some(_), Some(_)) => {
                format!("{name}.csv is there, expected none where [{name}] of stock.toml has copied_from")
            }
            (Some(_), None) => format!("stock.toml has [{name}], expected a file {name}.csv beside it"),
            (None, Some(_)) => format!("{name}.csv is there, expected a section [{name}] in stock.toml"),
        };
        Err(Error::stock(self.id(), problem))
    }

    /// Modulation transfer of each layer.
    ///
    /// # Errors
    /// If the stock has none of its own; the message names the owner of points that the digitisation repeats.
    pub fn modulation_transfer(&self) -> Result<PerLayer<&ModulationTransfer>, Error> {
        let missing = || self.no_figure("modulation transfer", self.sheet.mtf.as_ref());
        Ok(self.mtf.as_ref().ok_or_else(missing)?.as_ref())
    }

    /// Granularity of each layer.
    ///
    /// # Errors
    /// As [`Stock::modulation_transfer`].
    pub fn granularity(&self) -> Result<PerLayer<&Granularity>, Error> {
        let missing = || self.no_figure("granularity", self.sheet.granularity.as_ref());
        Ok(self.granularity.as_ref().ok_or_else(missing)?.as_ref())
    }

    fn no_figure(&self, what: &str, section: Option<&FigureSection>) -> Error {
        let owner = section.and_then(|section| section.copied_from.as_deref());
        let problem = match owner {
            Some(owner) => format!(
                "the digitised figure of {what} repeats {}, expected points of this film's own",
                printable(owner, OWNER_CHARACTERS)
            ),
            None => format!("no figure of {what} was given, expected one digitised from this film's sheet"),
        };
        Error::stock(self.id(), problem)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stock::SheetText;

    fn stock(id: &str) -> (Stock, &'static onelight_stocks::DataSheet) {
        let f = onelight_stocks::find(id).unwrap();
        let text = SheetText {
            id: f.id,
            stock_toml: f.stock_toml,
            sensitivity_csv: f.sensitivity_csv,
            characteristic_csv: f.characteristic_csv,
            dye_density_csv: f.dye_density_csv,
        };
        (Stock::parse(&text).unwrap(), f)
    }

    #[test]
    fn every_folder_has_what_it_announces() {
        let mut counts = [0, 0];
        for f in onelight_stocks::ALL {
            let (stock, f) = stock(f.id);
            let stock = stock.with_figures(f.mtf_csv, f.granularity_csv).unwrap();
            assert_eq!(stock.modulation_transfer().is_ok(), f.mtf_csv.is_some(), "{}", f.id);
            assert_eq!(stock.granularity().is_ok(), f.granularity_csv.is_some(), "{}", f.id);
            counts[0] += usize::from(f.mtf_csv.is_some());
            counts[1] += usize::from(f.granularity_csv.is_some());
        }
        assert_eq!(counts, [27, 7]);
    }

    #[test]
    fn copied_figures_are_refused_with_their_owner() {
        let message = |id: &str| {
            let (stock, f) = stock(id);
            let stock = stock.with_figures(f.mtf_csv, f.granularity_csv).unwrap();
            let error = stock.granularity().map(|_| ()).unwrap_err();
            assert!(error.is_not_published());
            error.to_string()
        };
        assert_eq!(
            message("kodak-portra-400"),
            "kodak-portra-400: the digitised figure of granularity repeats the points of Kodak Vision3 250D 5207, \
             expected points of this film's own"
        );
        assert!(message("kodak-2383").contains("expected one digitised from this film's sheet"));
    }

    #[test]
    fn file_and_section_go_together() {
        let message = |id: &str, mtf: Option<&str>, granularity: Option<&str>| {
            stock(id).0.with_figures(mtf, granularity).unwrap_err().to_string()
        };
        let mtf = "cycles_per_mm,all\n5,1\n20,0.9\n";
        assert!(message("kodak-2383", Some(mtf), None).contains("expected a section [mtf]"));
        assert!(message("kodak-5207", None, None).contains("expected a file mtf.csv"));
        assert!(message("fuji-velvia-50", Some(mtf), None).contains("copied_from"));
        let no_sense = message("kodak-5207", Some("cycles_per_mm,all\n5,7\n20,0.9\n"), None);
        assert_eq!(no_sense, "kodak-5207/mtf.csv:1: all: found response 7, expected 0 to 3");
    }
}
