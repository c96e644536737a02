//! What a viewer shows: the display window.

use std::ops::Range;

use super::{BandView, Description};

/// The display window of a picture: what lies outside of it is cut off, what the data window does not have is left
/// empty.
#[derive(Debug, Clone)]
pub(super) struct Shown {
    columns: Overlap,
    rows: Overlap,
}

impl Shown {
    pub(super) fn new(picture: &Description) -> Self {
        Self { columns: Overlap::new(picture, 0, picture.width), rows: Overlap::new(picture, 1, picture.height) }
    }

    /// The rows of the display window that a band has pixels for.
    pub(super) fn rows_of(&self, band: BandView<'_>) -> Range<usize> {
        let height = band.rgb.len().checked_div(band.width).unwrap_or(0);
        let Overlap { from, to, count } = self.rows;
        // A display row is a data row less `from` and more `to`.
        let shown = |row: usize| row.clamp(from, from + count) - from + to;
        shown(band.top)..shown(band.top.saturating_add(height))
    }

    /// Where in the picture's pixels a row of the display window begins: columns of the display window, and the colours and
    /// coverage for them.
    pub(super) fn row<'a>(&self, row: usize, band: BandView<'a>) -> (Range<usize>, &'a [[f32; 3]], Option<&'a [f32]>) {
        let Overlap { from, to, count } = self.columns;
        let start = (row - self.rows.to + self.rows.from - band.top) * band.width + from;
        (to..to + count, &band.rgb[start..start + count], band.alpha.map(|alpha| &alpha[start..start + count]))
    }
}

/// Where the windows overlap along one axis: `count` pixels `from` the data window `to` the display window; all 0
/// where they do not.
#[derive(Debug, Clone, Copy)]
struct Overlap {
    from: usize,
    to: usize,
    count: usize,
}

impl Overlap {
    fn new(picture: &Description, axis: usize, size: usize) -> Self {
        let windows = &picture.windows;
        let data = i64::from(windows.data_origin[axis]);
        let display = i64::from(windows.display_origin[axis]);
        let start = data.max(display);
        let end = (data + size as i64).min(display + windows.display_size[axis] as i64);
        if end <= start {
            return Self { from: 0, to: 0, count: 0 };
        }
        Self { from: (start - data) as usize, to: (start - display) as usize, count: (end - start) as usize }
    }
}
