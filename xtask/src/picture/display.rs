//! What a viewer shows: the display window.

use anyhow::Result;

use super::{Picture, Windows, limits::allocate};

/// A display-coded picture: 0 is black, 1 the display's white.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct DisplayPicture {
    /// Width in pixels.
    pub(crate) width: usize,
    /// Height in pixels.
    pub(crate) height: usize,
    /// `width * height` straight colours, top row first.
    pub(crate) rgb: Vec<[f32; 3]>,
    /// Coverage, as many as there are colours.
    pub(crate) alpha: Option<Vec<f32>>,
}

impl Picture {
    /// The display window of a picture whose colours are display-coded already: what lies outside is cut off, and what
    /// is missing is black, transparent where there is alpha.
    ///
    /// # Errors
    /// If there is no memory for it.
    pub(crate) fn into_display(self) -> Result<DisplayPicture> {
        let Self { width, height, rgb, alpha, windows, .. } = self;
        let [shown_width, shown_height] = windows.display_size;
        if windows.data_origin == windows.display_origin && [width, height] == windows.display_size {
            return Ok(DisplayPicture { width, height, rgb, alpha });
        }
        Ok(DisplayPicture {
            width: shown_width,
            height: shown_height,
            rgb: shown(&rgb, [width, height], &windows)?,
            alpha: alpha.map(|alpha| shown(&alpha, [width, height], &windows)).transpose()?,
        })
    }
}

/// The values in the display window, those outside the data window being the default.
fn shown<T: Copy + Default>(values: &[T], size: [usize; 2], windows: &Windows) -> Result<Vec<T>> {
    let [width, height] = windows.display_size;
    let columns = Overlap::new(windows, size, 0);
    let rows = Overlap::new(windows, size, 1);
    let mut out = allocate(width * height, T::default())?;
    if columns.count > 0 {
        for row in 0..rows.count {
            let to = (rows.to + row) * width + columns.to;
            let from = (rows.from + row) * size[0] + columns.from;
            out[to..to + columns.count].copy_from_slice(&values[from..from + columns.count]);
        }
    }
    Ok(out)
}

/// Where the windows overlap along one axis: `count` pixels `from` the data window `to` the display window.
struct Overlap {
    from: usize,
    to: usize,
    count: usize,
}

impl Overlap {
    fn new(windows: &Windows, size: [usize; 2], axis: usize) -> Self {
        let data = i64::from(windows.data_origin[axis]);
        let display = i64::from(windows.display_origin[axis]);
        let start = data.max(display);
        let end = (data + size[axis] as i64).min(display + windows.display_size[axis] as i64);
        Self { from: (start - data) as usize, to: (start - display) as usize, count: (end - start).max(0) as usize }
    }
}
