/// One value for each of the three emulsion layers, named by the light a layer records: red makes cyan dye, green
/// magenta, blue yellow.
///
/// ```
/// use onelight_film::PerLayer;
/// let aim = PerLayer { red: 1.09, green: 1.06, blue: 1.03 };
/// assert_eq!(aim.map(|d| d - 1.0).to_array()[1], 1.06 - 1.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PerLayer<T> {
    /// Of the layer that red light exposes; its dye is cyan.
    pub red: T,
    /// Of the layer that green light exposes; its dye is magenta.
    pub green: T,
    /// Of the layer that blue light exposes; its dye is yellow.
    pub blue: T,
}

/// Names of the layers, in the order of [`PerLayer::to_array`].
pub const LAYER_NAMES: [&str; 3] = ["red", "green", "blue"];

impl<T> PerLayer<T> {
    /// The same value in all three layers.
    pub fn all(value: T) -> Self
    where
        T: Clone,
    {
        Self { red: value.clone(), green: value.clone(), blue: value }
    }

    /// The values in the order red, green, blue.
    pub fn to_array(self) -> [T; 3] {
        [self.red, self.green, self.blue]
    }

    /// The three values by reference, to map or zip them without moving.
    pub fn as_ref(&self) -> PerLayer<&T> {
        PerLayer { red: &self.red, green: &self.green, blue: &self.blue }
    }

    /// What `f` makes of each layer's value.
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> PerLayer<U> {
        PerLayer { red: f(self.red), green: f(self.green), blue: f(self.blue) }
    }

    /// What `f` makes of the two values of each layer.
    pub fn zip_map<U, V>(self, other: PerLayer<U>, mut f: impl FnMut(T, U) -> V) -> PerLayer<V> {
        PerLayer { red: f(self.red, other.red), green: f(self.green, other.green), blue: f(self.blue, other.blue) }
    }

    /// What `f` makes of each layer's value and name, or the first error.
    ///
    /// # Errors
    /// The first error that `f` returns; the layers after it are not tried.
    pub fn try_map<U, E>(self, mut f: impl FnMut(T, &'static str) -> Result<U, E>) -> Result<PerLayer<U>, E> {
        let [red, green, blue] = LAYER_NAMES;
        Ok(PerLayer { red: f(self.red, red)?, green: f(self.green, green)?, blue: f(self.blue, blue)? })
    }
}

impl<T> From<[T; 3]> for PerLayer<T> {
    fn from([red, green, blue]: [T; 3]) -> Self {
        Self { red, green, blue }
    }
}
