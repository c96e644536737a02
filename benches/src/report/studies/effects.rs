use onelight::film::InterImage;
use onelight::{DirectSettings, FilmProcess, InterImageChoice, Process, Reference, StructuredSettings, White};
use serde::Serialize;

use crate::error::Result;
use crate::form::Form;
use crate::report::frame::Frame;
use crate::report::measure::Prepared;
use crate::report::scope::Scope;
use crate::report::stopwatch::{Pass, Timing, interleaved, mapping};

/// What effects of the film add to a pixel's time.
#[derive(Debug, Clone, Serialize)]
pub(in crate::report) struct EffectRow {
    pub(in crate::report) effects: &'static str,
    pub(in crate::report) structured: Timing,
    pub(in crate::report) direct: Timing,
}

/// The look with and without each effect that a form may have, in its usual structured and direct form, on one thread. A film without
/// an inter-image effect takes the same time with it.
pub(super) fn effects(prepared: &Prepared, frame: &Frame, scope: Scope) -> Result<Vec<EffectRow>> {
    let none = InterImageChoice::Fixed(InterImage::NONE);
    let cases = [
        ("none", none, White::Lamp),
        ("inter-image", InterImageChoice::Film, White::Lamp),
        ("white of the film", none, White::Film),
        ("both", InterImageChoice::Film, White::Film),
    ];
    let usual = prepared.process.film()?;
    let mut forms = Vec::new();
    for (_, inter_image, white) in cases {
        let process = Process::Film(FilmProcess { inter_image, white, ..usual.clone() });
        forms.extend(both(&process.compile_with(&prepared.films)?)?);
    }
    let passes: Vec<Pass> = forms.iter().map(|form| mapping(form, frame)).collect();
    let times = interleaved(&passes, frame, 1, scope.rounds(), || {})?;
    let rows = cases.iter().zip(times.chunks_exact(2));
    Ok(rows.map(|((effects, ..), time)| EffectRow { effects, structured: time[0], direct: time[1] }).collect())
}

fn both(film: &Reference) -> Result<[Form; 2]> {
    let structured = Form::Structured(Box::new(film.structured(&StructuredSettings::default())?));
    Ok([structured, Form::Direct(Box::new(film.direct(&DirectSettings::default())?))])
}
