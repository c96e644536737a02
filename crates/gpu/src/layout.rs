//! The uniform buffers are written as naga lays out the structs of the WGSL.

use naga::{Handle, Module, Type, TypeInner};
use onelight_lut::{
    Coupling, Decode, Develop, DirectForm, DirectParts, DirectPrint, ExponentialSum, ExponentialTerm, Expose, IDENTITY,
    Interpolation, Lut1d, Lut3d, Mix, PlainLut, PowerCoding, Shaper, StructuredLut, StructuredParts,
};

use crate::form::FormKind;
use crate::settings::LookSettings;
use crate::shader::wgsl;
use crate::target::TargetCoding::Stored;
use crate::translation::valid;
use crate::uniform::{self, UniformWords};

/// The struct that the WGSL declares `onelight_look` to be.
fn look(module: &Module) -> Handle<Type> {
    let named = |name: &Option<String>| name.as_deref() == Some("onelight_look");
    module.global_variables.iter().find(|(_, variable)| named(&variable.name)).unwrap().1.ty
}

/// Names and byte offsets of a struct's members, and after each those of the structs within it.
fn members(module: &Module, ty: Handle<Type>, base: u32, found: &mut Vec<(String, usize)>) {
    match &module.types[ty].inner {
        TypeInner::Struct { members: inner, .. } => {
            for member in inner {
                found.push((member.name.clone().unwrap(), (base + member.offset) as usize));
                members(module, member.ty, base + member.offset, found);
            }
        }
        TypeInner::Array { base: element, size: naga::ArraySize::Constant(count), stride } => {
            (0..count.get()).for_each(|i| members(module, *element, base + i * stride, found));
        }
        TypeInner::Matrix { columns, rows, scalar } => {
            // Three columns of four words, the fourth unused.
            assert_eq!((*columns as u8, *rows as u8, scalar.width), (3, 3, 4));
        }
        TypeInner::Scalar(scalar) | TypeInner::Vector { scalar, .. } => assert_eq!(scalar.width, 4),
        other => panic!("a uniform buffer holds {other:?}"),
    }
}

fn check(kind: FormKind, words: &UniformWords) {
    let (module, _) = valid(&wgsl(kind, &LookSettings::default()));
    let look = look(&module);
    let mut expected = Vec::new();
    members(&module, look, 0, &mut expected);
    let found: Vec<_> = words.members().iter().map(|&(name, offset)| (name.to_owned(), offset)).collect();
    assert_eq!(found, expected, "{kind}");
    let TypeInner::Struct { span, .. } = module.types[look].inner else { panic!("{kind}: not a struct") };
    assert_eq!(words.bytes().len(), kind.uniform_bytes());
    assert_eq!(kind.uniform_bytes(), span.next_multiple_of(16) as usize, "{kind}");
}

fn curves() -> Lut1d {
    Lut1d::sample(9, [-10.0, 10.0], |x| x).unwrap()
}

fn develop() -> Develop {
    Develop { coupling: Some(Coupling { curves: curves(), matrix: IDENTITY }), curves: curves() }
}

#[test]
fn plain_words_are_where_the_shader_reads_them() {
    let lut =
        PlainLut::new(Shaper::log2(0.02, 11.52).unwrap(), Lut3d::identity(5).unwrap(), Interpolation::Tetrahedral);
    check(FormKind::Plain, &uniform::plain(&lut, Stored).unwrap());
}

#[test]
fn structured_words_are_where_the_shader_reads_them() {
    let mix = Mix { matrix: IDENTITY, offset: [0.1; 3], curves: curves() };
    for mix in [None, Some(mix)] {
        for decode in [Decode::Coded, Decode::Density { matrix: IDENTITY, coding: PowerCoding::LINEAR }] {
            let parts = StructuredParts {
                expose: Expose::by(IDENTITY),
                develop: develop(),
                mix: mix.clone(),
                table: Lut3d::identity(5).unwrap(),
                decode,
                interpolation: Interpolation::Trilinear,
            };
            let lut = StructuredLut::new(parts).unwrap();
            check(FormKind::Structured, &uniform::structured(&lut, Stored).unwrap());
        }
    }
}

#[test]
fn direct_words_are_where_the_shader_reads_them() {
    for count in [1, 5, 128] {
        let term = ExponentialTerm { rate: [1.0; 3], weight: [1.0; 3] };
        let sum = || ExponentialSum::new(vec![term; count]).unwrap();
        for print in [None, Some(DirectPrint { exposure: sum(), curves: curves() })] {
            let parts = DirectParts {
                expose: Expose::by(IDENTITY),
                develop: develop(),
                print,
                projection: sum(),
                coding: PowerCoding::LINEAR,
            };
            check(FormKind::Direct, &uniform::direct(&DirectForm::new(parts).unwrap(), Stored).unwrap());
        }
    }
}
