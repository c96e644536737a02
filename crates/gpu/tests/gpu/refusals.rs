//! What does not fit is refused in one sentence, and changes nothing.

use onelight_gpu::{Bindings, BoundLook, FilmPass, Form, LookSettings};
use onelight_lut::{
    Develop, DirectForm, DirectParts, ExponentialSum, ExponentialTerm, Lut1d, Lut3d, PlainLut, Storage,
};
use wgpu::TextureFormat::{R8Unorm, Rgba8Unorm, Rgba16Float};

use crate::adapter::gpu;
use crate::looks::{colours, looks};
use crate::picture::{Verb, develop, source};

fn with_curves(form: &DirectForm, size: usize) -> DirectForm {
    let curves = Lut1d::sample(size, [-10.0, 10.0], |x| x).unwrap();
    DirectForm::new(DirectParts { develop: Develop { coupling: None, curves }, ..form.parts().clone() }).unwrap()
}

fn with_terms(form: &DirectForm, count: usize) -> DirectForm {
    let term = ExponentialTerm { rate: [1.0; 3], weight: [1.0; 3] };
    let projection = ExponentialSum::new(vec![term; count]).unwrap();
    DirectForm::new(DirectParts { projection, print: None, ..form.parts().clone() }).unwrap()
}

#[test]
fn looks_that_do_not_fit_change_nothing() {
    let Some(gpu) = gpu() else { return };
    let look = &looks()[0];
    let source = source(gpu, [16, 16], Rgba16Float, &colours(256));
    let small = PlainLut::new(*look.plain.shaper(), Lut3d::identity(5).unwrap(), look.plain.interpolation());
    let bright = Lut3d::new(17, vec![[7e4; 3]; 17 * 17 * 17]).unwrap();
    let bright = PlainLut::new(*look.plain.shaper(), bright, look.plain.interpolation());
    let [long, many] = [with_curves(&look.direct, 2049), with_terms(&look.direct, 129)];
    let cases: [(Form<'_>, Form<'_>, &str); 5] = [
        (
            (&look.plain).into(),
            (&small).into(),
            "table of the new look: found 5 nodes a side, expected 17 as in these resources",
        ),
        (
            (&look.plain).into(),
            (&look.direct).into(),
            "form of the new look: found direct, expected plain as in these resources",
        ),
        (
            (&look.plain).into(),
            (&bright).into(),
            "entry of a table kept in half floats: found 70000, expected a number within ±65504",
        ),
        ((&look.direct).into(), (&long).into(), "points of the form's curves: found 2049, expected at most 2048"),
        ((&look.direct).into(), (&many).into(), "terms of a sum of the form: found 129, expected at most 128"),
    ];
    for (first, second, sentence) in cases {
        let pass = FilmPass::new(&gpu.device, &gpu.queue, first, Rgba8Unorm).unwrap();
        let before = develop(gpu, &pass, &source, Verb::Encode);
        let error = pass.upload(&gpu.queue, second).unwrap_err();
        assert_eq!(error.to_string(), sentence);
        assert!(before == develop(gpu, &pass, &source, Verb::Encode));
    }
    // The most that fits.
    let pass = FilmPass::new(&gpu.device, &gpu.queue, &look.direct, Rgba8Unorm).unwrap();
    pass.upload(&gpu.queue, &with_curves(&look.direct, 2048)).unwrap();
    pass.upload(&gpu.queue, &with_terms(&look.direct, 128)).unwrap();
}

#[test]
fn formats_and_settings_are_checked() {
    let Some(gpu) = gpu() else { return };
    let look = &looks()[0];
    let error = FilmPass::new(&gpu.device, &gpu.queue, &look.direct, R8Unorm).unwrap_err().to_string();
    assert!(error.starts_with("format of the target: found R8Unorm, expected Rgba8Unorm"), "{error}");
    let settings = LookSettings { storage: Storage::Unorm8, ..Default::default() };
    let error = BoundLook::new(&gpu.device, &gpu.queue, &look.plain, &settings).unwrap_err().to_string();
    assert_eq!(error, "storage of the table on the GPU: found Unorm8, expected F16 or F32");

    let settings = LookSettings { bindings: Bindings { group: 0, first: u32::MAX }, ..Default::default() };
    let error = BoundLook::new(&gpu.device, &gpu.queue, &look.plain, &settings).unwrap_err().to_string();
    assert!(error.starts_with("first binding of a look: found 4294967295, expected at most "), "{error}");
    let max = gpu.device.limits().max_bindings_per_bind_group - 4;
    let settings = LookSettings { bindings: Bindings { group: 0, first: max }, ..Default::default() };
    BoundLook::new(&gpu.device, &gpu.queue, &look.plain, &settings).unwrap();
}
