use super::compared::Compared;

/// Places where a map turns space inside out: two colours of the scene swap sides there.
///
/// At every place the 3x3 of local contrast is taken, change of the picture over change of the scene, both in
/// stops, by central differences in each channel. Where the sign of its determinant is not the reference's, the
/// candidate has a fold.
///
/// ```
/// # use onelight_lut::{ColourSet, Maps, Samples, SamplingLaw, Search, certify};
/// # let film = |rgb: [f64; 3]| rgb.map(|u| u / (u + 0.18));
/// # let skin = ColourSet::new("skin", [("light", [0.56, 0.39, 0.31])])?;
/// # let samples = Samples::new(&SamplingLaw { count: 1 << 8, ..SamplingLaw::default() }, &[skin], film, |_| {})?;
/// # let maps = Maps {
/// #     reference: film,
/// #     candidate: |rgb| film(rgb).map(|v| (v * 255.0).round() / 255.0),
/// #     difference: |a: &[f64; 3], b: &[f64; 3]| (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max),
/// #     luminance: |v: &[f64; 3]| (v[0] + v[1] + v[2]) / 3.0,
/// # };
/// # let certificate = certify(&samples, &maps, Search::SamplesOnly, |_| {})?;
/// // Rounded colours stand still between codes and then jump, but no two change places.
/// let folds = certificate.folds;
/// assert!(folds.folds <= folds.places - folds.clipped - folds.flat);
/// assert_eq!(folds.first.is_some(), folds.folds > 0);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Folds {
    /// How many places were looked at: the greys and the law's first colours.
    pub places: usize,
    /// Those left out because the reference leaves the display's range there.
    pub clipped: usize,
    /// Those left out because the reference hardly changes there in some direction.
    pub flat: usize,
    /// Those of the others where the candidate has a fold.
    pub folds: usize,
    /// The first of them, scene-linear RGB.
    pub first: Option<[f64; 3]>,
}

/// Half the distance of the two values of a difference, in stops. Table cells are 0.3 to 0.6 stops wide, so the
/// stencil sees one or two of them; the change over it, 0.4 % and more where a place is not flat, is ten thousand
/// times the rounding of float32.
const STEP: f64 = 1.0 / 16.0;

/// Light that the screen reflects anyway, of 1 at white: keeps the contrast of near-black within what can be seen.
const FLARE: f64 = 0.01;

/// How near to 0 and 1 the reference may come: a candidate stored in that range is clipped a little earlier or
/// later than the reference.
const MARGIN: f64 = 1e-3;

/// The least contrast, in stops for each stop, that a place must have in every direction. A difference of 0.5
/// CIEDE2000 within a table cell is an error of contrast of about that size, and no fold.
const LEAST_CONTRAST: f64 = 0.05;

/// How many colours each place takes.
const STENCIL: usize = 6;

/// Scene-linear colours around a place: each channel in turn with more and with less light.
pub(super) fn stencil(centre: [f64; 3]) -> [[f64; 3]; STENCIL] {
    [0, 1, 2, 3, 4, 5].map(|index| {
        let mut colour = centre;
        colour[index / 2] *= if index % 2 == 0 { STEP.exp2() } else { (-STEP).exp2() };
        colour
    })
}

pub(super) fn count(stencils: &Compared<'_>) -> Folds {
    let mut found = Folds { places: 0, clipped: 0, flat: 0, folds: 0, first: None };
    let centres = stencils.colours.chunks_exact(STENCIL);
    let reference = stencils.reference.chunks_exact(STENCIL);
    for ((colours, reference), candidate) in centres.zip(reference).zip(stencils.candidate.chunks_exact(STENCIL)) {
        found.places += 1;
        let want = Contrast::of(reference);
        if reference.iter().flatten().any(|v| !(MARGIN..=1.0 - MARGIN).contains(v)) {
            found.clipped += 1;
        } else if want.distance_to_singular() < LEAST_CONTRAST {
            found.flat += 1;
        } else {
            let same = Contrast::of(candidate).determinant() * want.determinant() > 0.0;
            if !same {
                found.folds += 1;
                // Red is moved in the first two only, green in the next two.
                found.first = found.first.or(Some([colours[2][0], colours[0][1], colours[0][2]]));
            }
        }
    }
    found
}

/// Local contrast: stops of each display channel (rows) for each stop of a scene channel (columns).
struct Contrast([[f64; 3]; 3]);

impl Contrast {
    /// From the values of a map at a [`stencil`].
    fn of(values: &[[f64; 3]]) -> Self {
        let column = |channel: usize| {
            let (more, less) = (values[2 * channel], values[2 * channel + 1]);
            [0, 1, 2].map(|row| (stops_above_flare(more[row]) - stops_above_flare(less[row])) / (2.0 * STEP))
        };
        let columns = [column(0), column(1), column(2)];
        Self([0, 1, 2].map(|row| columns.map(|column| column[row])))
    }

    fn determinant(&self) -> f64 {
        let Self([a, b, c]) = self;
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    }

    /// A lower bound of the smallest singular value, which is the distance to the nearest matrix without a sign:
    /// it is the determinant over the product of the two others, which is at most half the sum of all squares.
    fn distance_to_singular(&self) -> f64 {
        let squares: f64 = self.0.iter().flatten().map(|v| v * v).sum();
        if squares > 0.0 { 2.0 * self.determinant().abs() / squares } else { 0.0 }
    }
}

/// Rising and smooth everywhere, so that no sign changes: a logarithm, continued by its tangent below 0.
fn stops_above_flare(value: f64) -> f64 {
    let ratio = value / FLARE;
    (if ratio > 0.0 { ratio.ln_1p() } else { ratio }) / std::f64::consts::LN_2
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contrast(matrix: [[f64; 3]; 3], scale: f64) -> Contrast {
        // A map that is this matrix between stops of the scene and stops above flare.
        let map = |rgb: [f64; 3]| {
            let stops = rgb.map(f64::log2);
            matrix.map(|row| FLARE * ((0..3).map(|i| scale * row[i] * stops[i]).sum::<f64>().exp2() - 1.0))
        };
        Contrast::of(&stencil([8.0, 4.0, 2.0]).map(map))
    }

    #[test]
    fn contrast_is_the_matrix_of_the_map() {
        let matrix = [[1.5, 0.1, -0.2], [0.3, 1.2, 0.1], [0.0, 0.4, 1.1]];
        let found = contrast(matrix, 1.0);
        for (found, want) in found.0.iter().flatten().zip(matrix.iter().flatten()) {
            assert!((found - want).abs() < 1e-9, "{found} {want}");
        }
        assert!((found.determinant() - 1.863).abs() < 1e-9, "{}", found.determinant());
    }

    #[test]
    fn the_bound_is_a_bound_and_scales() {
        // Diagonal: the smallest singular value is known.
        let diagonal = [[2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.1]];
        let found = contrast(diagonal, 1.0).distance_to_singular();
        assert!(found <= 0.1 && found > 0.07, "{found}");
        assert!((contrast(diagonal, 0.5).distance_to_singular() - 0.5 * found).abs() < 1e-9);
        assert_eq!(Contrast([[0.0; 3]; 3]).distance_to_singular(), 0.0);
    }
}
