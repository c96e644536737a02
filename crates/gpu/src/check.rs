//! What the textures of a pass have to be, found out before anything is encoded: wgpu itself would panic, or spoil the user's
//! encoder.

use wgpu::{Device, Texture, TextureDimension, TextureFormat, TextureSampleType, TextureUsages, TextureView};

use crate::error::{Error, ErrorKind, Refused, Role};

/// The most pixels a side of a picture: what every WebGPU device takes.
pub const MAX_SIDE: u32 = 8192;

/// That `view`'s texture can be read by a pass.
pub(crate) fn check_source(view: &TextureView) -> Result<(), Error> {
    let texture = view.texture();
    check_texture(Role::Source, texture, TextureUsages::TEXTURE_BINDING)?;
    let found = texture.format();
    match found.sample_type(None, None) {
        Some(TextureSampleType::Float { .. }) => Ok(()),
        _ => Err(ErrorKind::SourceFormat { found }.into()),
    }
}

/// That `view`'s texture can be written by a pass for `format`, which needs `usage`.
fn check_target(view: &TextureView, format: TextureFormat, usage: TextureUsages) -> Result<(), Error> {
    let texture = view.texture();
    // Views may add or take away the sRGB curve; whether this one does is for wgpu to say.
    if texture.format().remove_srgb_suffix() != format.remove_srgb_suffix() {
        return Err(ErrorKind::OtherTarget { found: texture.format(), expected: format }.into());
    }
    check_texture(Role::Target, texture, usage)?;
    // A view does not tell which level it is of, and by the size of the first a smaller one would be filled in part.
    match texture.mip_level_count() {
        1 => Ok(()),
        found => Err(ErrorKind::MipLevels { found }.into()),
    }
}

/// That a pass can read `source` and write `target`, as [`check_target`] takes it, and that the two go together.
pub(crate) fn check_pair(
    source: &TextureView,
    target: &TextureView,
    format: TextureFormat,
    usage: TextureUsages,
) -> Result<(), Error> {
    check_source(source)?;
    check_target(target, format, usage)?;
    let [from, to] = [source, target].map(|view| [view.texture().width(), view.texture().height()]);
    if source.texture() == target.texture() {
        return Err(ErrorKind::SameTexture.into());
    }
    if from == to { Ok(()) } else { Err(ErrorKind::Sizes { from, to }.into()) }
}

fn check_texture(role: Role, texture: &Texture, usage: TextureUsages) -> Result<(), Error> {
    let (width, height) = (texture.width(), texture.height());
    if texture.dimension() != TextureDimension::D2 {
        return Err(ErrorKind::Dimension { role, found: texture.dimension() }.into());
    }
    if width.max(height) > MAX_SIDE {
        return Err(ErrorKind::Side { width, height, max: MAX_SIDE }.into());
    }
    if texture.sample_count() != 1 {
        return Err(ErrorKind::SampleCount { role, found: texture.sample_count() }.into());
    }
    if !texture.usage().contains(usage) {
        return Err(ErrorKind::Usage { role, found: texture.usage(), expected: usage }.into());
    }
    Ok(())
}

/// What `make` makes, or what wgpu has against it: a view hides its format, levels, layers and usages, and only wgpu compares them.
#[cfg(not(target_family = "wasm"))]
pub(crate) fn checked<T>(device: &Device, what: Refused, make: impl FnOnce() -> T) -> Result<T, Error> {
    use std::pin::pin;
    use std::task::{Context, Poll, Waker};

    let scope = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let made = make();
    // Outside browsers the answer is there at once.
    match pin!(scope.pop()).poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(Some(error)) => Err(ErrorKind::Refused { what, found: innermost(&error) }.into()),
        Poll::Ready(None) | Poll::Pending => Ok(made),
    }
}

/// What `make` makes. A browser answers too late to be asked; it writes what it has against it to the page's console.
#[cfg(target_family = "wasm")]
pub(crate) fn checked<T>(_: &Device, _: Refused, make: impl FnOnce() -> T) -> Result<T, Error> {
    Ok(make())
}

/// The cause at the end of the chain, on one line: those before it only say which call failed.
#[cfg(not(target_family = "wasm"))]
fn innermost(error: &dyn std::error::Error) -> String {
    let mut cause = error;
    while let Some(next) = cause.source() {
        cause = next;
    }
    let words: Vec<_> = cause.to_string().split_whitespace().map(str::to_owned).collect();
    words.join(" ")
}
