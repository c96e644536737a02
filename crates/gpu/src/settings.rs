use onelight_lut::Storage;

/// How a form's table is read.
///
/// The direct form has no table, so this makes no difference to it.
///
/// ```
/// use onelight_gpu::{Fetch, LookSettings};
///
/// assert_eq!(LookSettings::default().fetch, Fetch::Texels);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Fetch {
    /// As the form says, from single texels in full precision: the CPU's result.
    #[default]
    Texels,
    /// Trilinearly by the texture unit, whatever the form says: the fastest. Its weights have 8 bits on most cards, so that
    /// what is read lies up to 1/512 of the difference between neighbouring nodes away, for each axis.
    Filtered,
}

/// The numbers at which a shader finds a look's resources: `@group(group) @binding(first)` is the uniform buffer,
/// `first + 1` the table, `first + 2` the points of curves, `first + 3` the sampler, as far as the form has them.
///
/// ```
/// use onelight_gpu::{Bindings, FormKind, LookSettings, wgsl};
///
/// let settings = LookSettings { bindings: Bindings { group: 2, first: 5 }, ..Default::default() };
/// let text = wgsl(FormKind::Direct, &settings);
/// assert!(text.contains("@group(2) @binding(5) var<uniform> onelight_look"));
/// assert!(text.contains("@group(2) @binding(7) var onelight_points"));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Bindings {
    /// The bind group's index, by default 0.
    pub group: u32,
    /// The first of up to four consecutive binding numbers, by default 0.
    pub first: u32,
}

/// How a look's table is stored and read, and where a shader finds it.
///
/// ```
/// use onelight_gpu::{Fetch, LookSettings};
/// use onelight_lut::Storage;
///
/// // Entries in 32-bit floats: twice the memory, and no rounding.
/// let precise = LookSettings { storage: Storage::F32, ..Default::default() };
/// assert_eq!(precise.fetch, Fetch::Texels);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LookSettings {
    /// How the table is read; a direct form has none.
    pub fetch: Fetch,
    /// What the entries of its texture are: [`Storage::F16`] or [`Storage::F32`]. The CPU's twin of a stored table is
    /// [`Storage::stored`].
    pub storage: Storage,
    /// Where the user's own shader finds the look. A [`FilmPass`](crate::FilmPass) has shaders of its own and keeps to the
    /// default.
    pub bindings: Bindings,
}

impl Default for LookSettings {
    /// Single texels of half floats, bound from group 0, binding 0 on.
    fn default() -> Self {
        Self { fetch: Fetch::Texels, storage: Storage::F16, bindings: Bindings::default() }
    }
}
