//! The WGSL files and which of them make a shader.

use wgpu::TextureFormat;

use crate::form::FormKind;
use crate::settings::{Bindings, Fetch, LookSettings};
use crate::target::Target;

const FINITE: &str = include_str!("shader/finite.wgsl");
const EXPOSURE: &str = include_str!("shader/exposure.wgsl");
const CURVES: &str = include_str!("shader/curves.wgsl");
const CODING: &str = include_str!("shader/coding.wgsl");
const PIXEL: &str = include_str!("shader/entry/pixel.wgsl");

/// The text of `onelight_develop(rgb: vec3f) -> vec3f` for one form, to be put into an engine's own shader.
///
/// Scene-linear RGB in, what the form yields out. It reads the resources that
/// [`BoundLook::bind_group`](crate::BoundLook::bind_group) made with the same settings holds, at the numbers of
/// [`Bindings`]; all names begin with `onelight` or `ONELIGHT`.
///
/// ```
/// use onelight_gpu::{FormKind, LookSettings, wgsl};
///
/// let text = wgsl(FormKind::Direct, &LookSettings::default());
/// assert!(text.contains("fn onelight_develop(rgb: vec3f) -> vec3f"));
/// ```
pub fn wgsl(kind: FormKind, settings: &LookSettings) -> String {
    let text = develop(kind, settings.fetch).join("\n");
    bound_at(text, settings.bindings)
}

/// The text with its four bindings elsewhere; the last one first, so that none is moved twice.
fn bound_at(text: String, Bindings { group, first }: Bindings) -> String {
    (0..4).rev().fold(text, |text, offset| {
        let binding = u64::from(first) + offset;
        text.replace(&format!("@group(0) @binding({offset})"), &format!("@group({group}) @binding({binding})"))
    })
}

/// The files of `onelight_develop`, in an order that any compiler takes.
fn develop(kind: FormKind, fetch: Fetch) -> Vec<&'static str> {
    let table = match fetch {
        Fetch::Texels => include_str!("shader/fetch/texels.wgsl"),
        Fetch::Filtered => include_str!("shader/fetch/filtered.wgsl"),
    };
    match (kind, fetch) {
        (FormKind::Plain, Fetch::Texels) => {
            vec![FINITE, table, include_str!("shader/plain.wgsl"), include_str!("shader/look/plain.wgsl")]
        }
        (FormKind::Plain, Fetch::Filtered) => {
            vec![FINITE, table, include_str!("shader/plain.wgsl"), include_str!("shader/look/plain_filtered.wgsl")]
        }
        (FormKind::Structured, fetch) => {
            let look = match fetch {
                Fetch::Texels => include_str!("shader/look/structured.wgsl"),
                Fetch::Filtered => include_str!("shader/look/structured_filtered.wgsl"),
            };
            vec![FINITE, EXPOSURE, CURVES, CODING, table, include_str!("shader/structured.wgsl"), look]
        }
        (FormKind::Direct, _) => vec![
            FINITE,
            EXPOSURE,
            CURVES,
            CODING,
            include_str!("shader/direct.wgsl"),
            include_str!("shader/look/direct.wgsl"),
        ],
    }
}

/// Vertex and fragment entry for a full-screen draw.
pub(crate) fn draw(kind: FormKind, fetch: Fetch, target: Target) -> String {
    let mut files = develop(kind, fetch);
    files.extend([stored(target), PIXEL, include_str!("shader/entry/draw.wgsl")]);
    files.join("\n")
}

/// Compute entry, where the format can be written by one.
pub(crate) fn compute(kind: FormKind, fetch: Fetch, target: Target) -> Option<String> {
    let mut files = develop(kind, fetch);
    let declaration = match target.format() {
        TextureFormat::Rgba8Unorm => include_str!("shader/target/rgba8unorm.wgsl"),
        TextureFormat::Rgba16Float => include_str!("shader/target/rgba16float.wgsl"),
        TextureFormat::Rgba32Float => include_str!("shader/target/rgba32float.wgsl"),
        _ => return None,
    };
    files.extend([stored(target), PIXEL, declaration, include_str!("shader/entry/compute.wgsl")]);
    Some(files.join("\n"))
}

/// Compute entry that fills a table of half (or single) floats from the direct form.
pub(crate) fn bake(table: TextureFormat) -> String {
    let mut files = develop(FormKind::Direct, Fetch::Texels);
    files.extend(match table {
        TextureFormat::Rgba16Float => {
            [include_str!("shader/target/half.wgsl"), include_str!("shader/target/table_rgba16float.wgsl")]
        }
        _ => [include_str!("shader/target/single.wgsl"), include_str!("shader/target/table_rgba32float.wgsl")],
    });
    files.extend([include_str!("shader/plain.wgsl"), include_str!("shader/entry/bake.wgsl")]);
    files.join("\n")
}

/// A linear map along an axis, for the steps of a stage.
#[cfg(feature = "spatial")]
pub(crate) const SPATIAL_AXIS: &str = include_str!("shader/spatial/axis.wgsl");
/// The field of halation in cells.
#[cfg(feature = "spatial")]
pub(crate) const SPATIAL_HOLE: &str = include_str!("shader/spatial/hole.wgsl");
/// Noise, correlated along x.
#[cfg(feature = "spatial")]
pub(crate) const SPATIAL_NOISE: &str = include_str!("shader/spatial/noise.wgsl");

/// Scene light to exposures, by a direct form.
#[cfg(feature = "spatial")]
pub(crate) fn spatial_expose() -> String {
    with_direct(&[include_str!("shader/spatial/expose.wgsl")])
}

/// Exposures to amounts, by a direct form.
#[cfg(feature = "spatial")]
pub(crate) fn spatial_develop() -> String {
    with_direct(&[include_str!("shader/spatial/develop.wgsl")])
}

/// Amounts to a target that a compute shader can write, by a direct form.
#[cfg(feature = "spatial")]
pub(crate) fn spatial_finish(target: Target) -> String {
    // Whatever else was asked for is refused before.
    let declaration = match target.format() {
        TextureFormat::Rgba8Unorm => include_str!("shader/spatial/target_rgba8unorm.wgsl"),
        TextureFormat::Rgba16Float => include_str!("shader/spatial/target_rgba16float.wgsl"),
        _ => include_str!("shader/spatial/target_rgba32float.wgsl"),
    };
    with_direct(&[stored(target), declaration, include_str!("shader/spatial/finish.wgsl")])
}

#[cfg(feature = "spatial")]
fn with_direct(files: &[&'static str]) -> String {
    let mut all = develop(FormKind::Direct, Fetch::Texels);
    all.extend(files);
    all.join("\n")
}

fn stored(target: Target) -> &'static str {
    match target {
        Target::Unorm(TextureFormat::Rgb10a2Unorm) => include_str!("shader/target/unorm10.wgsl"),
        Target::Unorm(_) => include_str!("shader/target/unorm.wgsl"),
        Target::Srgb(_) => include_str!("shader/target/srgb.wgsl"),
        Target::Half => include_str!("shader/target/half.wgsl"),
        Target::Single => include_str!("shader/target/single.wgsl"),
    }
}
