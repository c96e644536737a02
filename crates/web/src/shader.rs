//! The film in the language of graphics cards.

use onelight::gpu::{CURVE_ROWS, FormKind, LookBytes, LookSettings, MAX_POINTS, wgsl};
use onelight::lut::DirectForm;

use crate::error::Error;

/// The page's whole shader in WGSL: `onelight_develop` of `onelight-gpu`, then the page's own entries `draw_vertex` and
/// `draw_fragment`.
///
/// Group 0 holds the look ([`look_bytes`]): its uniform buffer at 0, its points at 2. Group 1 holds the picture's light at 0, and at 1 two
/// floats: what light is multiplied by, and the canvas's rows where they are counted from below (0 where they are not).
///
/// ```
/// assert!(onelight_web::film_shader().contains("fn draw_fragment"));
/// ```
#[must_use]
pub fn film_shader() -> String {
    [wgsl(FormKind::Direct, &LookSettings::default()).as_str(), include_str!("shader/draw.wgsl")].join("\n")
}

/// Bytes of a point of a curve: two 32-bit floats.
const POINT_BYTES: usize = 8;

/// What the shader reads of a look, from its direct form: the uniform buffer, then the texture of points, 2048 by 9 pairs of
/// 32-bit floats.
///
/// ```
/// use onelight_web::{FilmLook, Keys, look_bytes};
/// let look = FilmLook::new(&Keys::from_json("{}")?)?;
/// let bytes = look_bytes(look.direct()?)?;
/// assert_eq!(bytes.len(), onelight::gpu::FormKind::Direct.uniform_bytes() + 2048 * 9 * 8);
/// # Ok::<(), onelight_web::Error>(())
/// ```
///
/// # Errors
/// If its curves or sums are longer than shaders take.
pub fn look_bytes(direct: &DirectForm) -> Result<Vec<u8>, Error> {
    let look = LookBytes::new(direct, LookSettings::default().storage)?;
    let row_bytes = MAX_POINTS * POINT_BYTES;
    let (mut bytes, uniform) = (look.uniform, FormKind::Direct.uniform_bytes());
    bytes.resize(uniform + CURVE_ROWS as usize * row_bytes, 0);
    for curves in look.curves {
        let own = curves.points * POINT_BYTES;
        for (row, points) in (curves.row as usize..).zip(curves.bytes.chunks(own)) {
            let start = uniform + row * row_bytes;
            bytes[start..start + own].copy_from_slice(points);
        }
    }
    Ok(bytes)
}
