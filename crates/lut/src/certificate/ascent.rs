use rayon::prelude::*;

use super::compared::OnProgress;
use super::sampling_law::SamplingLaw;
use super::scene_coordinates::SceneCoordinates;
use crate::error::{Error, ErrorKind};

/// The first step along stops, saturation and sixths of hue: about half the distance of 2^14 colours along each,
/// and less than a cell of a table of 32 nodes a side, so that a climb seldom jumps over the hill it stands on.
const FIRST_STEP: [f64; 3] = [0.4, 0.02, 0.12];

/// What is left of the first step when a climb has arrived: 0.0004 stops.
const LAST_SCALE: f64 = 1.0 / 1024.0;

/// Each round keeps one climb of so many and spends as much as the round before.
const ROUNDS: usize = 3;
const KEPT_OF: usize = 4;

/// The difference at a colour of the scene, called from all threads.
type Measure<'a> = &'a (dyn Fn([f64; 3]) -> f64 + Sync);

/// The largest difference that climbs from the worst colours meet, and its colour.
///
/// The budget goes by rounds: all climb a little, then the best quarter of them, then the best quarter of those.
/// Most climbs end on the same few hills, and only the highest matters.
pub(super) fn largest(
    law: &SamplingLaw,
    colours: &[[f64; 3]],
    differences: &[f64],
    measure: Measure<'_>,
    count_more: OnProgress<'_>,
) -> Result<(f64, [f64; 3]), Error> {
    let worst = worst(differences, law.ascents.max(1));
    let mut climbs: Vec<Climb> = worst.into_iter().map(|i| Climb::new(i, colours[i], differences[i])).collect();
    let budget = law.ascents.min(climbs.len()) * law.ascent_steps;
    for round in 0..ROUNDS {
        if round > 0 {
            climbs.truncate(climbs.len().div_ceil(KEPT_OF));
        }
        let each = budget / ROUNDS / climbs.len().max(1);
        climbs.par_iter_mut().try_for_each(|climb| -> Result<(), Error> {
            let spent = climb.run(law, each, measure)?;
            count_more(spent);
            Ok(())
        })?;
        climbs.sort_by(|a, b| b.value.total_cmp(&a.value).then(a.start.cmp(&b.start)));
    }
    climbs.first().map(|climb| (climb.value, climb.colour)).ok_or_else(|| ErrorKind::NoSamples.into())
}

/// Indices of the largest differences, largest first; equal ones in their order.
fn worst(differences: &[f64], count: usize) -> Vec<usize> {
    let order = |a: &usize, b: &usize| differences[*b].total_cmp(&differences[*a]).then(a.cmp(b));
    let mut indices: Vec<usize> = (0..differences.len()).collect();
    if count < indices.len() {
        indices.select_nth_unstable_by(count, order);
        indices.truncate(count);
    }
    indices.sort_unstable_by(order);
    indices
}

/// A pattern search \[HookeJeeves1961\]: one coordinate at a time, then once more the way the whole round went;
/// half the step where nothing helped. It needs no derivative, which interpolated tables do not have.
struct Climb {
    /// Which of the samples it came from.
    start: usize,
    at: [f64; 3],
    colour: [f64; 3],
    value: f64,
    /// The present step over [`FIRST_STEP`], and along each coordinate the sign that helped last.
    scale: f64,
    signs: [f64; 3],
}

impl Climb {
    fn new(start: usize, colour: [f64; 3], value: f64) -> Self {
        let SceneCoordinates { stops, saturation, hue } = SceneCoordinates::of(colour);
        Self { start, at: [stops, saturation, hue], colour, value, scale: 1.0, signs: [1.0; 3] }
    }

    /// Climbs for at most so many evaluations; says how many it made.
    fn run(&mut self, law: &SamplingLaw, budget: usize, measure: Measure<'_>) -> Result<usize, Error> {
        let mut left = budget;
        while left > 0 && self.scale >= LAST_SCALE {
            let base = self.at;
            for axis in 0..3 {
                for _ in 0..2 {
                    let mut trial = self.at;
                    trial[axis] += self.signs[axis] * self.scale * FIRST_STEP[axis];
                    if self.attempt(trial, law, &mut left, measure)? {
                        break;
                    }
                    self.signs[axis] = -self.signs[axis];
                }
            }
            if self.at == base {
                self.scale *= 0.5;
            } else {
                let further = [0, 1, 2].map(|i| 2.0 * self.at[i] - base[i]);
                self.attempt(further, law, &mut left, measure)?;
            }
        }
        Ok(budget - left)
    }

    /// Moves to `trial`, held to the law's domain, if the difference is larger there.
    fn attempt(
        &mut self,
        [stops, saturation, hue]: [f64; 3],
        law: &SamplingLaw,
        left: &mut usize,
        measure: Measure<'_>,
    ) -> Result<bool, Error> {
        let trial = [
            stops.max(law.stops[0]).min(law.stops[1]),
            saturation.clamp(0.0, 1.0),
            // One turn is enough: further out would only lose digits.
            hue.rem_euclid(6.0),
        ];
        if *left == 0 || trial == self.at {
            return Ok(false);
        }
        *left -= 1;
        let [stops, saturation, hue] = trial;
        let colour = SceneCoordinates { stops, saturation, hue }.rgb();
        let value = measure(colour);
        if !value.is_finite() {
            return Err(ErrorKind::Difference { index: self.start, sample: colour, found: value }.into());
        }
        let better = value > self.value;
        if better {
            (self.at, self.colour, self.value) = (trial, colour, value);
        }
        Ok(better)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn worst_first_and_equal_ones_in_order() {
        let differences = [0.5, 3.0, 1.0, 3.0, 0.0, 1.0, 2.0];
        assert_eq!(worst(&differences, 4), [1, 3, 6, 2]);
        assert_eq!(worst(&differences, 99), [1, 3, 6, 2, 5, 0, 4]);
    }

    #[test]
    fn a_climb_stays_in_the_domain_and_in_its_budget() {
        let law = SamplingLaw { stops: [-1.0, 1.0], ..SamplingLaw::default() };
        // Uphill to more light and more saturation, for ever.
        let measure = |[r, g, b]: [f64; 3]| r + g - 3.0 * b;
        let start = [0.2, 0.1, 0.1];
        let mut climb = Climb::new(0, start, measure(start));
        let spent = climb.run(&law, 500, &measure).unwrap();
        assert!(spent <= 500);
        assert!((climb.value - 0.72).abs() < 1e-3, "{}", climb.value);
        assert!(climb.colour.iter().all(|u| (0.0..=0.36 + 1e-12).contains(u)));
        let mut short = Climb::new(0, start, measure(start));
        assert_eq!(short.run(&law, 7, &measure).unwrap(), 7);
    }
}
