//! Every implementation that computes a form: float64, float32, vector instructions, graphics cards.

use onelight::lut::{Channels, PixelMap, Pixels, PixelsMut, SimdLevel};
use rayon::prelude::*;

use super::gpu::Card;
use crate::error::Result;
use crate::form::Form;

/// What computes a form: one pixel at a time in one of two precisions, vectors, or a card.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// One pixel at a time in float64.
    Float64,
    /// One pixel at a time in float32: the definition.
    Float32,
    /// Vector instructions of the processor, in float32.
    Vectors,
    /// A graphics card, in float32.
    Card,
}

impl Kind {
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Float64 => "float64",
            Self::Float32 => "float32",
            Self::Vectors => "vectors",
            Self::Card => "card",
        }
    }
}

/// What one implementation makes of all colours, display-coded.
pub(super) struct Output {
    pub(super) kind: Kind,
    /// `float64`, `float32`, the name of instructions, or of a card.
    pub(super) name: String,
    pub(super) coded: Vec<[f64; 3]>,
    /// Vectors write pictures of 8 bits too.
    pub(super) codes: Option<Vec<[u8; 3]>>,
}

/// Float64 first, then the definition in float32, one pixel at a time; then vectors and cards.
pub(super) fn outputs(form: &Form, colours: &[[f32; 3]], card: Option<&Card>) -> Result<Vec<Output>> {
    let mut outputs = match form {
        Form::Plain(lut) => on_processor(lut, colours)?,
        Form::Structured(lut) => on_processor(lut.as_ref(), colours)?,
        Form::Direct(direct) => on_processor(direct.as_ref(), colours)?,
    };
    if let Some(card) = card {
        let (kind, name, coded) = (Kind::Card, card.name().to_owned(), card.develop(form, colours)?);
        outputs.push(Output { kind, name, coded, codes: None });
    }
    Ok(outputs)
}

fn on_processor(form: &impl PixelMap, colours: &[[f32; 3]]) -> Result<Vec<Output>> {
    let exact = colours.par_iter().map(|rgb| form.apply_f64(rgb.map(f64::from))).collect();
    let single: Vec<[f32; 3]> = colours.par_iter().map(|rgb| form.apply(*rgb)).collect();
    let mut outputs = vec![
        Output { kind: Kind::Float64, name: Kind::Float64.word().to_owned(), coded: exact, codes: None },
        Output { kind: Kind::Float32, name: Kind::Float32.word().to_owned(), coded: widened(&single), codes: None },
    ];
    let size = [colours.len(), 1];
    let from = Pixels::new(colours.as_flattened(), Channels::Rgb, size)?;
    for vectors in SimdLevel::available() {
        let mut floats = vec![[0.0_f32; 3]; colours.len()];
        form.map_on(vectors, &from, &mut PixelsMut::new(floats.as_flattened_mut(), Channels::Rgb, size)?)?;
        let mut codes = vec![[0_u8; 3]; colours.len()];
        form.map_on(vectors, &from, &mut PixelsMut::new(codes.as_flattened_mut(), Channels::Rgb, size)?)?;
        let (kind, name) = (Kind::Vectors, vectors.name().to_owned());
        outputs.push(Output { kind, name, coded: widened(&floats), codes: Some(codes) });
    }
    Ok(outputs)
}

fn widened(coded: &[[f32; 3]]) -> Vec<[f64; 3]> {
    coded.iter().map(|rgb| rgb.map(f64::from)).collect()
}
