//! The WGSL files and which of them make a shader.

use wgpu::TextureFormat;

use crate::form::FormKind;
use crate::target::Target;

/// How a form's table is read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Fetch {
    /// As the form says, from single texels in full precision: the CPU's result.
    #[default]
    Texels,
    /// Trilinearly by the texture unit, whatever the form says: the fastest. Its weights have 8 bits on most cards, so that
    /// what is read lies up to 1/512 of the difference between neighbouring nodes away, for each axis.
    Filtered,
}

const FINITE: &str = include_str!("shader/finite.wgsl");
const EXPOSURE: &str = include_str!("shader/exposure.wgsl");
const CURVES: &str = include_str!("shader/curves.wgsl");
const CODING: &str = include_str!("shader/coding.wgsl");
const PIXEL: &str = include_str!("shader/entry/pixel.wgsl");

/// The text of `onelight_develop(rgb: vec3f) -> vec3f` for one form, to be put into an engine's own shader.
///
/// Scene-linear RGB in, what the form yields out. It reads the bindings 0 to 3 of group 0, which
/// [`BoundLook::bind_group`](crate::BoundLook::bind_group) fills; all names begin with `onelight` or `ONELIGHT`. The direct
/// form has no table, so `fetch` makes no difference to it.
///
/// ```
/// let wgsl = onelight_gpu::wgsl(onelight_gpu::FormKind::Direct, Default::default());
/// assert!(wgsl.contains("fn onelight_develop(rgb: vec3f) -> vec3f"));
/// ```
pub fn wgsl(kind: FormKind, fetch: Fetch) -> String {
    develop(kind, fetch).join("\n")
}

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

fn stored(target: Target) -> &'static str {
    match target {
        Target::Unorm(TextureFormat::Rgb10a2Unorm) => include_str!("shader/target/unorm10.wgsl"),
        Target::Unorm(_) => include_str!("shader/target/unorm.wgsl"),
        Target::Srgb(_) => include_str!("shader/target/srgb.wgsl"),
        Target::Half => include_str!("shader/target/half.wgsl"),
        Target::Single => include_str!("shader/target/single.wgsl"),
    }
}

#[cfg(test)]
mod translation;
