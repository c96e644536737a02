//! Writing OpenEXR.

use std::{
    io::{Seek, Write},
    path::Path,
};

use anyhow::{Result, anyhow, bail};
use exr::{
    image::{Encoding, Image, Layer, SpecificChannels, write::WritableImage},
    math::Vec2,
    meta::{
        attribute::{AttributeValue, Chromaticities as Primaries, IntegerBounds, Text},
        header::{ImageAttributes, LayerAttributes},
    },
};

use super::{Picture, alpha::premultiplied};
use crate::whole::write_whole;

/// Writes `picture` as a linear OpenEXR file of `f32` RGB or premultiplied RGBA, ZIP-compressed, with its windows and
/// primaries.
///
/// Nothing is clipped. `texts` become string attributes; `Software` is the standard one of that name. The order of the
/// others in the file is not fixed.
///
/// # Errors
/// One sentence that starts with `path`: see [`write_whole`]; or a picture whose sizes do not fit each other or the
/// format.
pub(crate) fn write_exr(path: &Path, picture: &Picture, texts: &[(&str, &str)]) -> Result<()> {
    write_whole(path, |file| write_to(file, picture, texts))
}

/// The same to any writer.
pub(super) fn write_to(writer: impl Write + Seek, picture: &Picture, texts: &[(&str, &str)]) -> Result<()> {
    let Picture { width, height, rgb, alpha, .. } = picture;
    let (width, count) = (*width, width * height);
    if count == 0 || rgb.len() != count || alpha.as_ref().is_some_and(|alpha| alpha.len() != count) {
        bail!("a picture of {width} x {height} pixels with {} colours cannot be written", rgb.len());
    }
    let encoding = Encoding::SMALL_LOSSLESS;
    let own = own_attributes(picture, texts)?;
    let shared = shared_attributes(picture);
    let written = match alpha {
        Some(alpha) => {
            let pixel = |Vec2(x, y): Vec2<usize>| {
                let at = y * width + x;
                let [r, g, b] = premultiplied(rgb[at], alpha[at]);
                (r, g, b, alpha[at])
            };
            let layer = Layer::new((width, *height), own, encoding, SpecificChannels::rgba(pixel));
            Image::new(shared, layer).write().to_buffered(writer)
        }
        None => {
            let pixel = |Vec2(x, y): Vec2<usize>| <(f32, f32, f32)>::from(rgb[y * width + x]);
            let layer = Layer::new((width, *height), own, encoding, SpecificChannels::rgb(pixel));
            Image::new(shared, layer).write().to_buffered(writer)
        }
    };
    written.map_err(|error| anyhow!("cannot be written: {error}"))
}

fn own_attributes(picture: &Picture, texts: &[(&str, &str)]) -> Result<LayerAttributes> {
    let [x, y] = picture.windows.data_origin;
    let mut attributes = LayerAttributes::default().with_position(Vec2(x, y));
    for (key, value) in texts {
        let text = |string: &str| {
            Text::new_or_none(string)
                .ok_or_else(|| anyhow!("the text `{key}` cannot be written, as it has characters beyond Latin-1"))
        };
        if key.is_empty() || key.len() > 255 {
            bail!("a text's key has {} bytes, expected 1 to 255", key.len());
        }
        if *key == "Software" {
            attributes.software_name = Some(text(value)?);
        } else {
            attributes.other.insert(text(key)?, AttributeValue::Text(text(value)?));
        }
    }
    Ok(attributes)
}

fn shared_attributes(picture: &Picture) -> ImageAttributes {
    let windows = &picture.windows;
    let ([x, y], [width, height]) = (windows.display_origin, windows.display_size);
    let mut attributes = ImageAttributes::new(IntegerBounds::new((x, y), (width, height)));
    attributes.pixel_aspect = windows.pixel_aspect;
    let point = |[x, y]: [f32; 2]| Vec2(x, y);
    attributes.chromaticities = picture.primaries.map(|xy| Primaries {
        red: point(xy.red),
        green: point(xy.green),
        blue: point(xy.blue),
        white: point(xy.white),
    });
    attributes
}
