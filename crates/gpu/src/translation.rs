//! Every shader is valid WGSL and can be said in SPIR-V, MSL, HLSL and GLSL ES.

use naga::back::{glsl, hlsl, msl, spv};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Module, ShaderStage};
use wgpu::TextureFormat;

use crate::form::FormKind;
use crate::settings::{Bindings, Fetch, LookSettings};
use crate::shader::{bake, compute, draw, wgsl};
use crate::target::Target;

pub(crate) fn valid(text: &str) -> (Module, ModuleInfo) {
    let module = naga::front::wgsl::parse_str(text).unwrap_or_else(|error| panic!("{}", error.emit_to_string(text)));
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(&module);
    let info = info.unwrap_or_else(|error| panic!("{}", error.emit_to_string(text)));
    (module, info)
}

fn native(module: &Module, info: &ModuleInfo) {
    assert!(!spv::write_vec(module, info, &spv::Options::default(), None).unwrap().is_empty());
    let metal = msl::Options { fake_missing_bindings: true, lang_version: (2, 0), ..Default::default() };
    assert!(!msl::write_string(module, info, &metal, &Default::default()).unwrap().0.is_empty());
    let mut text = String::new();
    let options = hlsl::Options { fake_missing_bindings: true, ..Default::default() };
    hlsl::Writer::new(&mut text, &options, &Default::default()).write(module, info, None).unwrap();
    assert!(!text.is_empty());
}

fn glsl_es(module: &Module, info: &ModuleInfo, version: u16, stage: ShaderStage, entry: &str) -> String {
    let options = glsl::Options { version: glsl::Version::new_gles(version), ..Default::default() };
    let pipeline = glsl::PipelineOptions { shader_stage: stage, entry_point: entry.to_owned(), multiview: None };
    let mut text = String::new();
    glsl::Writer::new(&mut text, module, info, &options, &pipeline, naga::proc::BoundsCheckPolicies::default())
        .unwrap()
        .write()
        .unwrap();
    text
}

/// All shaders of passes and bakes; whether they compute.
fn texts() -> Vec<(String, bool)> {
    let formats = [
        TextureFormat::Rgba8Unorm,
        TextureFormat::Rgba8UnormSrgb,
        TextureFormat::Rgb10a2Unorm,
        TextureFormat::Rgba16Float,
        TextureFormat::Rgba32Float,
    ];
    let mut texts = vec![(bake(TextureFormat::Rgba16Float), true), (bake(TextureFormat::Rgba32Float), true)];
    for (kind, fetch) in FormKind::ALL.into_iter().flat_map(|kind| [Fetch::Texels, Fetch::Filtered].map(|f| (kind, f)))
    {
        for target in formats.map(|format| Target::new(format).unwrap()) {
            texts.push((draw(kind, fetch, target), false));
            texts.extend(compute(kind, fetch, target).map(|text| (text, true)));
        }
    }
    texts
}

#[test]
fn every_shader_is_translated() {
    let mut entries = 0;
    for (text, compute) in texts() {
        let (module, info) = valid(&text);
        native(&module, &info);
        entries += module.entry_points.len();
        if compute {
            // GLSL ES 3.00 has no compute shaders.
            glsl_es(&module, &info, 310, ShaderStage::Compute, &module.entry_points[0].name);
        } else {
            glsl_es(&module, &info, 300, ShaderStage::Vertex, "onelight_vertex");
            let fragment = glsl_es(&module, &info, 300, ShaderStage::Fragment, "onelight_fragment");
            assert!(fragment.starts_with("#version 300 es"));
        }
    }
    assert_eq!(entries, 2 + 6 * (5 * 2 + 3));
}

#[cfg(feature = "spatial")]
#[test]
fn every_step_of_a_stage_is_translated() {
    use crate::shader::{SPATIAL_AXIS, SPATIAL_HOLE, SPATIAL_NOISE, spatial_develop, spatial_expose, spatial_finish};
    let mut texts = vec![spatial_expose(), spatial_develop()];
    texts.extend([SPATIAL_AXIS, SPATIAL_HOLE, SPATIAL_NOISE].map(str::to_owned));
    for format in [TextureFormat::Rgba8Unorm, TextureFormat::Rgba16Float, TextureFormat::Rgba32Float] {
        texts.push(spatial_finish(Target::new(format).unwrap()));
    }
    for text in texts {
        let (module, info) = valid(&text);
        native(&module, &info);
        glsl_es(&module, &info, 310, ShaderStage::Compute, &module.entry_points[0].name);
    }
}

#[test]
fn texts_to_paste_are_whole_and_keep_to_their_names() {
    for (kind, fetch) in FormKind::ALL.into_iter().flat_map(|kind| [Fetch::Texels, Fetch::Filtered].map(|f| (kind, f)))
    {
        let text = wgsl(kind, &LookSettings { fetch, ..Default::default() });
        // An engine's own shader around it.
        let engine = "@fragment fn tone(@location(0) hdr: vec3f) -> @location(0) vec4f { return vec4f(onelight_develop(hdr), 1.0); }";
        let (module, info) = valid(&format!("{text}\n{engine}"));
        native(&module, &info);
        glsl_es(&module, &info, 300, ShaderStage::Fragment, "tone");
        let ours = module.functions.iter().filter_map(|(_, function)| function.name.as_deref());
        let globals = module.global_variables.iter().filter_map(|(_, variable)| variable.name.as_deref());
        let constants = module.constants.iter().filter_map(|(_, constant)| constant.name.as_deref());
        for name in ours.chain(globals).chain(constants) {
            assert!(name.to_lowercase().starts_with("onelight"), "{name}");
        }
    }
}

#[test]
fn bindings_are_where_they_are_asked_for() {
    for (kind, fetch) in FormKind::ALL.into_iter().flat_map(|kind| [Fetch::Texels, Fetch::Filtered].map(|f| (kind, f)))
    {
        // A first binding below 4 would meet numbers that are still to be moved.
        for bindings in
            [Bindings { group: 0, first: 1 }, Bindings { group: 3, first: 2 }, Bindings { group: 1, first: 40 }]
        {
            let (module, _) = valid(&wgsl(kind, &LookSettings { fetch, bindings, ..Default::default() }));
            let mut found: Vec<_> = module
                .global_variables
                .iter()
                .map(|(_, variable)| {
                    let binding = variable.binding.unwrap();
                    assert_eq!(binding.group, bindings.group, "{kind} {fetch:?}");
                    (binding.binding - bindings.first, variable.name.clone().unwrap())
                })
                .collect();
            found.sort();
            let names = ["onelight_look", "onelight_table", "onelight_points", "onelight_filter"];
            for (offset, name) in found {
                assert_eq!(names[offset as usize], name, "{kind} {fetch:?} {bindings:?}");
            }
        }
    }
}
