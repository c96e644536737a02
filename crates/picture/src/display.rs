//! What a viewer shows: the display window.

use std::ops::Range;

use crate::{band::BandView, description::Description};

/// The display window of a picture: what lies outside of it is cut off, what the data window does not have is left
/// empty.
#[derive(Debug, Clone)]
pub(crate) struct Shown {
    columns: Overlap,
    rows: Overlap,
}

impl Shown {
    /// Of the windows that a picture is described by.
    pub(crate) fn new(picture: &Description) -> Self {
        Self { columns: Overlap::new(picture, 0, picture.width), rows: Overlap::new(picture, 1, picture.height) }
    }

    /// The rows of the display window that a band has pixels for.
    pub(crate) fn rows_of(&self, band: BandView<'_>) -> Range<usize> {
        let height = band.rgb.len().checked_div(band.width).unwrap_or(0);
        let Overlap { from, to, count } = self.rows;
        // A display row is a data row less `from` and more `to`.
        let shown = |row: usize| row.clamp(from, from + count) - from + to;
        shown(band.top)..shown(band.top.saturating_add(height))
    }

    /// Where in the picture's pixels a row of the display window begins: columns of the display window, and the colours and
    /// coverage for them.
    pub(crate) fn row<'a>(&self, row: usize, band: BandView<'a>) -> (Range<usize>, &'a [[f32; 3]], Option<&'a [f32]>) {
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
        let reach = |origin: i64, size: usize| origin.saturating_add(i64::try_from(size).unwrap_or(i64::MAX));
        let end = reach(data, size).min(reach(display, windows.display_size[axis]));
        if end <= start {
            return Self { from: 0, to: 0, count: 0 };
        }
        Self { from: (start - data) as usize, to: (start - display) as usize, count: (end - start) as usize }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Picture, Source, Windows};

    /// What is in the display window.
    struct Displayed {
        width: usize,
        height: usize,
        rgb: Vec<[f32; 3]>,
        alpha: Option<Vec<f32>>,
    }

    /// What a writer of display windows makes of bands of one row.
    fn displayed(picture: &Picture) -> Displayed {
        let shown = Shown::new(&picture.description());
        let [width, height] = picture.windows.display_size;
        let mut rgb = vec![[0.0; 3]; width * height];
        let mut alpha = picture.alpha.as_ref().map(|_| vec![0.0; width * height]);
        let mut next = 0;
        for top in 0..picture.height {
            let pixels = top * picture.width..(top + 1) * picture.width;
            let own = picture.alpha.as_ref().map(|alpha| &alpha[pixels.clone()]);
            let band = BandView { top, width: picture.width, rgb: &picture.rgb[pixels], alpha: own };
            for row in shown.rows_of(band) {
                assert!(row >= next && row < height, "row {row} after {next}");
                next = row + 1;
                let (columns, colours, coverage) = shown.row(row, band);
                let columns = row * width + columns.start..row * width + columns.end;
                rgb[columns.clone()].copy_from_slice(colours);
                if let (Some(alpha), Some(coverage)) = (&mut alpha, coverage) {
                    alpha[columns].copy_from_slice(coverage);
                }
            }
        }
        Displayed { width, height, rgb, alpha }
    }

    #[test]
    fn the_display_window_is_shown() {
        let rgb = (0..12).map(|index| [index as f32; 3]).collect();
        let picture = Picture::opaque(4, 3, rgb, Source::Exr);
        let window = |data_origin, display_origin, display_size| Windows {
            data_origin,
            display_origin,
            display_size,
            pixel_aspect: 1.0,
        };
        let shown = |windows: Windows, alpha: Option<Vec<f32>>| {
            let shown = displayed(&Picture { windows, alpha, ..picture.clone() });
            assert_eq!(shown.rgb.len(), shown.width * shown.height);
            (shown.rgb.iter().map(|colour| colour[0] as i32).collect::<Vec<_>>(), shown.alpha)
        };
        // Cut on two sides, padded on the other two.
        let (red, alpha) = shown(window([-1, -1], [0, 0], [4, 3]), Some(vec![1.0; 12]));
        assert_eq!(red, [5, 6, 7, 0, 9, 10, 11, 0, 0, 0, 0, 0]);
        assert_eq!(alpha.unwrap(), [1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(shown(window([10, 10], [9, 11], [3, 1]), None).0, [0, 4, 5]);
        assert_eq!(shown(window([5, 0], [5, 0], [4, 3]), None).0, (0..12).collect::<Vec<_>>());
        assert_eq!(shown(window([100, 0], [0, 0], [2, 2]), None).0, [0; 4]);
        assert_eq!(shown(window([i32::MIN, i32::MAX], [i32::MAX, i32::MIN], [1, 1]), None).0, [0]);
    }
}
