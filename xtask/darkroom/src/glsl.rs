//! The page's shader in GLSL ES 3.00, for browsers that have WebGL2 alone.

use anyhow::{Context, Result, anyhow};
use naga::back::glsl;
use naga::proc::BoundsCheckPolicies;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{Handle, Module, ShaderStage};
use serde_json::{Map, Value, json};

/// The fragment shader of a WGSL text as JSON: `fragment` is its GLSL, `uniforms` and `textures` tell what its resources are called
/// there, by their names in WGSL.
///
/// # Errors
/// If the text is no WGSL, or GLSL ES cannot say it.
pub(crate) fn translated(wgsl: &str) -> Result<Vec<u8>> {
    let module = naga::front::wgsl::parse_str(wgsl).map_err(|error| anyhow!("{}", error.emit_to_string(wgsl)))?;
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
    let info = validator.validate(&module).map_err(|error| anyhow!("{}", error.emit_to_string(wgsl)))?;
    let options = glsl::Options {
        version: glsl::Version::new_gles(300),
        writer_flags: glsl::WriterFlags::empty(),
        ..Default::default()
    };
    let entry_point = "draw_fragment".to_owned();
    let pipeline = glsl::PipelineOptions { shader_stage: ShaderStage::Fragment, entry_point, multiview: None };
    let mut fragment = String::new();
    let policies = BoundsCheckPolicies::default();
    let reflection = glsl::Writer::new(&mut fragment, &module, &info, &options, &pipeline, policies)
        .and_then(|mut writer| writer.write())
        .context("the film's shader in GLSL ES 3.00")?;
    let uniforms: Map<String, Value> =
        reflection.uniforms.iter().map(|(global, name)| (named(&module, *global), json!(name))).collect();
    let textures: Map<String, Value> = reflection
        .texture_mapping
        .iter()
        .map(|(name, mapping)| (named(&module, mapping.texture), json!(name)))
        .collect();
    Ok(serde_json::to_vec(&json!({ "fragment": fragment, "uniforms": uniforms, "textures": textures }))?)
}

fn named(module: &Module, global: Handle<naga::GlobalVariable>) -> String {
    module.global_variables[global].name.clone().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_resource_has_its_name() {
        let found: Value = serde_json::from_slice(&translated(&onelight_web::film_shader()).unwrap()).unwrap();
        let text = found["fragment"].as_str().unwrap();
        assert!(text.starts_with("#version 300 es"));
        for (kind, name) in [
            ("uniforms", "onelight_look"),
            ("uniforms", "frame"),
            ("textures", "onelight_points"),
            ("textures", "light"),
        ] {
            assert!(text.contains(found[kind][name].as_str().unwrap()), "{kind} {name}: {found}");
        }
    }
}
