//! What is measured, and where it is worst.

use onelight::baked::{Form as BakedAs, Recipe};
use onelight::lut::Sample;
use onelight::spectra::ciede2000;
use onelight::spectra::nalgebra::Vector3;
use onelight::{DisplayLinear, Look, Process, TransferCurve, Word};
use rayon::prelude::*;

use super::cases::{Case, Order, Strand, general};
use super::gpu::Card;
use super::hard_inputs;
use super::implementations::{Kind, Output, outputs};
use crate::described_look::DescribedLook;
use crate::error::Result;
use crate::form::Form;

/// What is measured of a case, and can go wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Quantity {
    /// Colours with a number that is not finite.
    NotFinite,
    /// From a grey to the next brighter one, luminance 1 at white.
    Fall,
    /// Difference between neighbouring colours, dE.
    Step,
    /// The same less the film's own at this place.
    Excess,
    /// From the form's own numbers in float64, sRGB-coded.
    Rounding,
    /// From one pixel at a time in float32, sRGB-coded.
    Vectors,
    /// The same in pictures of 8 bits, codes.
    Codes,
    /// Difference from the film, dE.
    Film,
    /// Difference between two forms, dE.
    Forms,
}

impl Quantity {
    pub(super) const ALL: [Self; 9] = [
        Self::NotFinite,
        Self::Fall,
        Self::Step,
        Self::Excess,
        Self::Rounding,
        Self::Vectors,
        Self::Codes,
        Self::Film,
        Self::Forms,
    ];
}

/// The largest of its kind, and the scene colour that it was found at.
#[derive(Debug, Clone, Copy)]
pub struct Worst {
    /// In the unit of its quantity.
    pub value: f64,
    /// Scene-linear RGB in the primaries of the process.
    pub at: [f32; 3],
}

/// A case computed by one implementation of one form.
#[derive(Debug, Clone)]
pub struct Row {
    /// The look's films and aim.
    pub process: String,
    /// `film`, the form's name, or two of them.
    pub form: String,
    /// The implementation: `float64`, `float32`, the name of instructions, or of a card.
    pub implementation: String,
    /// What kind of implementation that is.
    pub kind: Kind,
    /// The name of the hard inputs.
    pub case: &'static str,
    /// How many colours they are.
    pub colours: usize,
    /// The worst of every quantity that the case has.
    pub found: Vec<(Quantity, Worst)>,
    /// Mean dE from the film, or between two forms.
    pub mean: Option<f64>,
}

/// The forms measured, each as it usually is; the film itself comes before them.
const FORMS: [BakedAs; 3] = [BakedAs::Direct, BakedAs::Structured, BakedAs::Plain];

/// A process with its hard cases, and what the film makes of them.
struct Subject {
    name: String,
    look: Look,
    luminance: Vector3<f64>,
    cases: Vec<Case>,
    /// All of them, case by case.
    colours: Vec<[f32; 3]>,
    film: Seen,
}

/// Display-linear colours with what is seen of them.
struct Seen {
    linear: Vec<DisplayLinear>,
    /// As sRGB has them, whatever the look's own coding: one that begins with a power would make much of what is nothing.
    srgb: Vec<[f64; 3]>,
    lab: Vec<[f64; 3]>,
}

/// A form with the brightest scene value that it tells from brighter ones.
struct Measured {
    form: &'static str,
    end: Option<f64>,
    outputs: Vec<Output>,
    seen: Vec<Seen>,
}

/// A look measured in every implementation; a call of `progress` for each of [`STEPS`].
///
/// # Errors
/// If the look does not compile, or the card cannot develop.
pub fn rows(described: &DescribedLook, card: Option<&Card>, progress: impl Fn()) -> Result<Vec<Row>> {
    let (process, look) = (&described.process, described.look()?);
    let forms = FORMS.iter().map(|form| Form::baked(&look, &Recipe::of(*form))).collect::<Result<Vec<_>>>()?;
    progress();
    let subject = Subject::new(process, look, &forms)?;
    let mut rows = subject.of_film();
    progress();
    let mut measured = Vec::new();
    for form in &forms {
        let outputs = outputs(form, &subject.colours, card)?;
        let seen = outputs.par_iter().map(|output| subject.seen(&output.coded)).collect::<Result<Vec<_>>>()?;
        measured.push(Measured { form: form.word(), end: form.end(), outputs, seen });
        progress();
    }
    rows.extend(measured.iter().flat_map(|one| subject.of_form(one)));
    for (i, one) in measured.iter().enumerate() {
        rows.extend(measured[i + 1..].iter().flat_map(|other| subject.between(one, other)));
    }
    Ok(rows)
}

/// How often [`rows`] calls its `progress`.
pub const STEPS: usize = 2 + FORMS.len();

impl Subject {
    fn new(process: &Process, look: Look, forms: &[Form]) -> Result<Self> {
        let film = look.film()?;
        let mut cases = general(process.spaces().input_space)?;
        cases.extend([hard_inputs::steepest(film), hard_inputs::dense(film)]);
        for form in forms {
            match form {
                Form::Plain(lut) => cases.push(hard_inputs::plain_nodes(lut)),
                Form::Structured(lut) => {
                    cases.extend([hard_inputs::curve_nodes(film, lut), hard_inputs::table_nodes(lut)]);
                }
                Form::Direct(_) => {}
            }
        }
        let luminance = process.spaces().output_space.space().to_xyz()?.row(1).transpose();
        let name = format!("{}, {} aim", process.name(), process.aim().word());
        let strands = cases.iter().flat_map(|case| &case.strands);
        let colours: Vec<[f32; 3]> = strands.flat_map(|strand| &strand.colours).copied().collect();
        let linear = colours.par_iter().map(|rgb| look.develop_linear(rgb.map(f64::from))).collect();
        let film = Seen::new(&look, linear)?;
        Ok(Self { name, look, luminance, cases, colours, film })
    }

    fn seen(&self, coded: &[[f64; 3]]) -> Result<Seen> {
        let coding = self.look.coding();
        Seen::new(&self.look, coded.iter().map(|rgb| coding.decode_rgb(*rgb)).collect())
    }

    /// Whether a form that ends there tells all of a colour.
    fn is_within(&self, end: Option<f64>, i: usize) -> bool {
        end.is_none_or(|end| self.colours[i].iter().all(|v| v.is_nan() || f64::from(*v) <= end))
    }

    /// Every case with the number of its first colour.
    fn placed(&self) -> impl Iterator<Item = (&Case, usize)> {
        let mut next = 0;
        self.cases.iter().map(move |case| {
            let first = next;
            next += case.len();
            (case, first)
        })
    }

    fn of_film(&self) -> Vec<Row> {
        let row = |(case, first)| {
            let found = [
                (Quantity::NotFinite, Some(not_finite(case, first, |i| self.film.linear[i].0))),
                (Quantity::Fall, self.fall(case, first, &self.film)),
                (Quantity::Step, largest(case, first, |a, b| self.film.step(a, b))),
            ];
            self.row(("film", "float64", Kind::Float64), case, found, None)
        };
        self.placed().map(row).collect()
    }

    fn of_form(&self, measured: &Measured) -> Vec<Row> {
        let outputs = measured.outputs.iter().zip(&measured.seen);
        outputs.flat_map(|(output, seen)| self.of_output(measured, output, seen)).collect()
    }

    fn of_output(&self, measured: &Measured, output: &Output, seen: &Seen) -> Vec<Row> {
        let ([exact, single, ..], [_, written, ..]) = (&measured.seen[..], &measured.outputs[..]) else {
            return Vec::new();
        };
        let form = measured.form;
        let within = |i: usize| self.is_within(measured.end, i);
        let codes = |i: usize| {
            let codes = output.codes.as_ref().map_or([0; 3], |codes| codes[i]);
            let expected = written.coded[i].map(|v| u8::from_f32(v as f32));
            f64::from((0..3).map(|c| codes[c].abs_diff(expected[c])).max().unwrap_or(0))
        };
        let beyond_film = |a, b| (seen.step(a, b) - self.film.step(a, b)).max(0.0);
        let from_film = |i: usize| ciede2000(self.film.lab[i], seen.lab[i]);
        let row = |(case, first): (&Case, usize)| {
            let excess = |a, b| if within(a) && within(b) { beyond_film(a, b) } else { 0.0 };
            let from_film = |i| if within(i) { from_film(i) } else { 0.0 };
            let apart = |other: &Seen| each(case, first, |i| apart(seen.srgb[i], other.srgb[i]));
            let found = [
                (Quantity::NotFinite, Some(not_finite(case, first, |i| output.coded[i]))),
                (Quantity::Fall, self.fall(case, first, seen)),
                (Quantity::Step, largest(case, first, |a, b| seen.step(a, b))),
                (Quantity::Excess, largest(case, first, excess)),
                (Quantity::Rounding, (output.kind != Kind::Float64).then(|| apart(exact))),
                (Quantity::Vectors, matches!(output.kind, Kind::Vectors | Kind::Card).then(|| apart(single))),
                (Quantity::Codes, output.codes.is_some().then(|| each(case, first, codes))),
                (Quantity::Film, Some(each(case, first, from_film))),
            ];
            let mean = mean((first..first + case.len()).filter(|i| within(*i)).map(from_film));
            self.row((form, &output.name, output.kind), case, found, mean)
        };
        let beyond = |(case, first): (&Case, usize)| {
            let excess = |a, b| if within(a) && within(b) { 0.0 } else { beyond_film(a, b) };
            let beyond = |i| if within(i) { 0.0 } else { from_film(i) };
            let mean = mean((first..first + case.len()).filter(|i| !within(*i)).map(from_film))?;
            let found =
                [(Quantity::Excess, largest(case, first, excess)), (Quantity::Film, Some(each(case, first, beyond)))];
            Some(self.row((&format!("{form} past its end"), &output.name, output.kind), case, found, Some(mean)))
        };
        self.placed().map(row).chain(self.placed().filter_map(beyond)).collect()
    }

    /// Two forms, both by one pixel at a time in float32, where both know the light.
    fn between(&self, one: &Measured, other: &Measured) -> Vec<Row> {
        let ([_, a, ..], [_, b, ..]) = (&one.seen[..], &other.seen[..]) else { return Vec::new() };
        let forms = format!("{} and {}", one.form, other.form);
        let within = |i: usize| self.is_within(one.end, i) && self.is_within(other.end, i);
        let row = |(case, first): (&Case, usize)| {
            let between = |i: usize| if within(i) { ciede2000(a.lab[i], b.lab[i]) } else { 0.0 };
            let found = [(Quantity::Forms, Some(each(case, first, between)))];
            let mean = mean((first..first + case.len()).filter(|i| within(*i)).map(between));
            self.row((&forms, "float32", Kind::Float32), case, found, mean)
        };
        self.placed().map(row).collect()
    }

    fn row(
        &self,
        (form, implementation, kind): (&str, &str, Kind),
        case: &Case,
        found: impl IntoIterator<Item = (Quantity, Option<Worst>)>,
        mean: Option<f64>,
    ) -> Row {
        let found = found.into_iter().filter_map(|(quantity, worst)| Some((quantity, worst?))).collect();
        let (process, form, implementation) = (self.name.clone(), form.to_owned(), implementation.to_owned());
        Row { process, form, implementation, kind, case: case.name, colours: case.len(), found, mean }
    }

    /// By how much luminance falls on the greys of a case, if it has any.
    fn fall(&self, case: &Case, first: usize, seen: &Seen) -> Option<Worst> {
        let luminance = |i: usize| self.luminance.dot(&Vector3::from(*seen.linear[i]));
        neighbours(case, first, |strand| strand.order == Order::Greys, |a, b| (luminance(a) - luminance(b)).max(0.0))
    }
}

impl Seen {
    fn new(look: &Look, linear: Vec<DisplayLinear>) -> Result<Self> {
        let difference = look.difference()?;
        let lab = linear.par_iter().map(|rgb| difference.lab(*rgb)).collect();
        let srgb = linear.par_iter().map(|rgb| TransferCurve::Srgb.encode_rgb(*rgb)).collect();
        Ok(Self { linear, srgb, lab })
    }

    fn step(&self, a: usize, b: usize) -> f64 {
        ciede2000(self.lab[a], self.lab[b])
    }
}

/// How many colours are not finite, and the first of them.
pub(super) fn not_finite(case: &Case, first: usize, colour: impl Fn(usize) -> [f64; 3]) -> Worst {
    let bad = |i: &usize| !colour(*i).iter().all(|v| v.is_finite());
    let value = (first..first + case.len()).filter(bad).count() as f64;
    Worst { value, ..each(case, first, |i| f64::from(u8::from(bad(&i)))) }
}

/// The largest distance of two channels; what is not finite is counted elsewhere.
fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|c| (a[c] - b[c]).abs()).fold(0.0, f64::max)
}

/// The largest of all colours.
pub(super) fn each(case: &Case, first: usize, of: impl Fn(usize) -> f64) -> Worst {
    let colours = case.strands.iter().flat_map(|strand| &strand.colours);
    colours.zip(first..).map(|(at, i)| Worst { value: of(i), at: *at }).fold(NONE, larger)
}

/// The largest between neighbours, if there are any.
pub(super) fn largest(case: &Case, first: usize, of: impl Fn(usize, usize) -> f64) -> Option<Worst> {
    neighbours(case, first, |strand| strand.order != Order::Loose, of)
}

pub(super) fn neighbours(
    case: &Case,
    first: usize,
    counts: impl Fn(&Strand) -> bool,
    of: impl Fn(usize, usize) -> f64,
) -> Option<Worst> {
    let mut next = first;
    let mut worst = None;
    for strand in &case.strands {
        let (start, n) = (next, strand.colours.len());
        next += n;
        if !counts(strand) {
            continue;
        }
        let pairs = if strand.order == Order::Circle { n } else { n.saturating_sub(1) };
        let found = (0..pairs).map(|k| Worst { value: of(start + k, start + (k + 1) % n), at: strand.colours[k] });
        worst = Some(found.fold(worst.unwrap_or(NONE), larger));
    }
    worst
}

const NONE: Worst = Worst { value: 0.0, at: [0.0; 3] };

/// The first of equal ones.
fn larger(a: Worst, b: Worst) -> Worst {
    if b.value > a.value { b } else { a }
}

fn mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let (sum, count) = values.fold((0.0, 0_usize), |(sum, count), value| (sum + value, count + 1));
    (count > 0).then(|| sum / count as f64)
}
