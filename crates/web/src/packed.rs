//! Direct forms as bytes: what threads of the page hand to each other, and the looks that it is shipped with.
//!
//! All numbers are little-endian, and forms are exactly those that were packed. Curves, which are most of a form, are there once however
//! many forms share them: those of a camera film are the same on every print.
//!
//! 1. `OLDF`, a version (u32), the number of curves (u32) and of forms (u32)
//! 2. for each curve: the number of entries (u32), both ends of its domain and its entries (triples of f32)
//! 3. for each form: its name (u32 bytes, UTF-8), then what [`DirectParts`] lists in the same order: matrices by rows, curves by their
//!    number, sums as their number of terms (u32) and rate and weight of each (f32), the coding's exponent and offset (f64)

use std::collections::HashMap;

use onelight::lut::{
    Coupling, Develop, DirectForm, DirectParts, DirectPrint, Domain, ExponentialSum, ExponentialTerm, Expose, Lut1d,
    NegativeLight, PowerCoding, Rows,
};

use crate::error::Error;

const MAGIC: &[u8; 4] = b"OLDF";
const VERSION: u32 = 1;
/// Most entries of a curve, and most curves and forms of a file.
const MOST_ENTRIES: usize = 4096;
const MOST_PARTS: usize = 1 << 16;

/// Packs forms with their names, for [`PackedLooks`].
#[must_use]
pub fn pack(forms: &[(&str, &DirectForm)]) -> Vec<u8> {
    let (mut curves, mut bodies) = (Curves::default(), Writer::default());
    for (name, form) in forms {
        bodies.count(name.len());
        bodies.0.extend_from_slice(name.as_bytes());
        bodies.form(form.parts(), &mut curves);
    }
    let mut file = Writer(MAGIC.to_vec());
    file.0.extend_from_slice(&VERSION.to_le_bytes());
    file.count(curves.numbers.len());
    file.count(forms.len());
    file.0.extend_from_slice(&curves.bytes);
    file.0.extend_from_slice(&bodies.0);
    file.0
}

/// Forms in a packed file, each of which is made when it is asked for.
///
/// ```
/// use onelight_web::{FilmLook, Keys, PackedLooks, pack};
/// let look = FilmLook::new(&Keys::from_json(r#"{ "camera": "fuji-velvia-50" }"#)?.fitting()?)?;
/// let looks = PackedLooks::new(&pack(&[("velvia", look.direct()?)]))?;
/// assert_eq!(looks.form("velvia")?.as_ref(), Some(look.direct()?));
/// assert!(looks.form("provia")?.is_none());
/// # Ok::<(), onelight_web::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct PackedLooks {
    curves: Vec<Lut1d>,
    /// The bytes of each form by its name.
    forms: HashMap<String, Vec<u8>>,
}

impl PackedLooks {
    /// Reads a packed file.
    ///
    /// # Errors
    /// If it is no such file.
    pub fn new(file: &[u8]) -> Result<Self, Error> {
        let mut reader = Reader { rest: file };
        if reader.take(4)? != MAGIC || reader.u32()? != VERSION {
            return Err(Error::packed("found other bytes at its start, expected a packed look of this version"));
        }
        let [curves, forms] = [reader.count(MOST_PARTS)?, reader.count(MOST_PARTS)?];
        let curves = (0..curves).map(|_| reader.curve()).collect::<Result<Vec<_>, _>>()?;
        let forms = (0..forms).map(|_| {
            let length = reader.count(MOST_ENTRIES)?;
            let name = String::from_utf8_lossy(reader.take(length)?).into_owned();
            let own = reader.rest;
            reader.parts(&curves)?;
            Ok((name, own[..own.len() - reader.rest.len()].to_vec()))
        });
        let forms = forms.collect::<Result<_, Error>>()?;
        let found = Self { curves, forms };
        if reader.rest.is_empty() { Ok(found) } else { Err(Error::packed("found bytes behind its end, expected none")) }
    }

    /// The form of a name, if it is there.
    ///
    /// # Errors
    /// If its numbers make no form.
    pub fn form(&self, name: &str) -> Result<Option<DirectForm>, Error> {
        let Some(bytes) = self.forms.get(name) else { return Ok(None) };
        Ok(Some(DirectForm::new(Reader { rest: bytes }.parts(&self.curves)?)?))
    }
}

/// A form by itself, without a name.
///
/// ```
/// use onelight_web::{FilmLook, Keys, pack, pack_one, unpack_one};
/// let look = FilmLook::new(&Keys::from_json(r#"{ "camera": "fuji-velvia-50" }"#)?.fitting()?)?;
/// assert_eq!(unpack_one(&pack_one(look.direct()?))?, *look.direct()?);
/// # Ok::<(), onelight_web::Error>(())
/// ```
#[must_use]
pub fn pack_one(form: &DirectForm) -> Vec<u8> {
    pack(&[("", form)])
}

/// The form of [`pack_one`].
///
/// # Errors
/// If it is no such file, or its numbers make no form.
pub fn unpack_one(file: &[u8]) -> Result<DirectForm, Error> {
    let form = PackedLooks::new(file)?.form("")?;
    form.ok_or_else(|| Error::packed("found no form without a name, expected one"))
}

/// Curves that were written, each with its number.
#[derive(Default)]
struct Curves {
    numbers: HashMap<Vec<u8>, u32>,
    bytes: Vec<u8>,
}

impl Curves {
    fn number_of(&mut self, curve: &Lut1d) -> u32 {
        let mut own = Writer::default();
        own.count(curve.size());
        own.floats(&[curve.domain().min(), curve.domain().max()]);
        own.floats(curve.entries());
        let next = self.numbers.len() as u32;
        let number = *self.numbers.entry(own.0.clone()).or_insert(next);
        if number == next {
            self.bytes.extend_from_slice(&own.0);
        }
        number
    }
}

#[derive(Default)]
struct Writer(Vec<u8>);

impl Writer {
    fn count(&mut self, count: usize) {
        self.0.extend_from_slice(&(count as u32).to_le_bytes());
    }

    fn floats(&mut self, triples: &[[f32; 3]]) {
        triples.iter().flatten().for_each(|v| self.0.extend_from_slice(&v.to_le_bytes()));
    }

    fn sum(&mut self, sum: &ExponentialSum) {
        self.count(sum.terms().len());
        sum.terms().iter().for_each(|term| self.floats(&[term.rate, term.weight]));
    }

    fn form(&mut self, parts: &DirectParts, curves: &mut Curves) {
        let DirectParts { expose, develop, print, projection, coding } = parts;
        self.floats(&expose.input);
        self.floats(&expose.matrix);
        self.0.push(u8::from(expose.negative == NegativeLight::Compress));
        self.0.push(u8::from(develop.coupling.is_some()));
        if let Some(Coupling { curves: acting, matrix }) = &develop.coupling {
            self.0.extend_from_slice(&curves.number_of(acting).to_le_bytes());
            self.floats(matrix);
        }
        self.0.extend_from_slice(&curves.number_of(&develop.curves).to_le_bytes());
        self.0.push(u8::from(print.is_some()));
        if let Some(DirectPrint { exposure, curves: own }) = print {
            self.sum(exposure);
            self.0.extend_from_slice(&curves.number_of(own).to_le_bytes());
        }
        self.sum(projection);
        self.0.extend_from_slice(&coding.exponent().to_le_bytes());
        self.0.extend_from_slice(&coding.offset().to_le_bytes());
    }
}

struct Reader<'a> {
    rest: &'a [u8],
}

impl<'a> Reader<'a> {
    fn take(&mut self, bytes: usize) -> Result<&'a [u8], Error> {
        let (taken, rest) = self
            .rest
            .split_at_checked(bytes)
            .ok_or_else(|| Error::packed("found its end too early, expected the rest of a look"))?;
        self.rest = rest;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], Error> {
        let mut array = [0; N];
        array.copy_from_slice(self.take(N)?);
        Ok(array)
    }

    fn u32(&mut self) -> Result<u32, Error> {
        Ok(u32::from_le_bytes(self.array()?))
    }

    fn count(&mut self, most: usize) -> Result<usize, Error> {
        let found = self.u32()? as usize;
        if found > most {
            return Err(Error::packed("found a count that is too large, expected a packed look"));
        }
        Ok(found)
    }

    fn is(&mut self) -> Result<bool, Error> {
        match self.array()? {
            [0] => Ok(false),
            [1] => Ok(true),
            _ => Err(Error::packed("found a byte that is neither 0 nor 1, expected a packed look")),
        }
    }

    fn triple(&mut self) -> Result<[f32; 3], Error> {
        let bytes: [u8; 12] = self.array()?;
        let float = |i: usize| f32::from_le_bytes([bytes[i], bytes[i + 1], bytes[i + 2], bytes[i + 3]]);
        Ok([float(0), float(4), float(8)])
    }

    fn rows(&mut self) -> Result<Rows, Error> {
        Ok([self.triple()?, self.triple()?, self.triple()?])
    }

    fn f64(&mut self) -> Result<f64, Error> {
        Ok(f64::from_le_bytes(self.array()?))
    }

    fn curve(&mut self) -> Result<Lut1d, Error> {
        let entries = self.count(MOST_ENTRIES)?;
        let domain = Domain::new(self.triple()?, self.triple()?)?;
        let entries = (0..entries).map(|_| self.triple()).collect::<Result<_, _>>()?;
        Ok(Lut1d::new(domain, entries)?)
    }

    fn sum(&mut self) -> Result<ExponentialSum, Error> {
        let terms = self.count(ExponentialSum::MAX_TERMS)?;
        let term = |_| Ok::<_, Error>(ExponentialTerm { rate: self.triple()?, weight: self.triple()? });
        Ok(ExponentialSum::new((0..terms).map(term).collect::<Result<_, _>>()?)?)
    }

    fn chosen(&mut self, curves: &[Lut1d]) -> Result<Lut1d, Error> {
        let chosen = curves.get(self.u32()? as usize).cloned();
        chosen.ok_or_else(|| Error::packed("found the number of no curve, expected one of its curves"))
    }

    fn parts(&mut self, curves: &[Lut1d]) -> Result<DirectParts, Error> {
        let (input, matrix) = (self.rows()?, self.rows()?);
        let negative = if self.is()? { NegativeLight::Compress } else { NegativeLight::Clip };
        let coupling = match self.is()? {
            true => Some(Coupling { curves: self.chosen(curves)?, matrix: self.rows()? }),
            false => None,
        };
        let develop = Develop { coupling, curves: self.chosen(curves)? };
        let print = match self.is()? {
            true => Some(DirectPrint { exposure: self.sum()?, curves: self.chosen(curves)? }),
            false => None,
        };
        let (projection, coding) = (self.sum()?, PowerCoding::new(self.f64()?, self.f64()?)?);
        Ok(DirectParts { expose: Expose { input, matrix, negative }, develop, print, projection, coding })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FilmLook, Keys};

    fn form(keys: &str) -> DirectForm {
        FilmLook::new(&Keys::from_json(keys).unwrap().fitting().unwrap()).unwrap().direct().unwrap().clone()
    }

    #[test]
    fn forms_come_back_and_share_their_curves() {
        let all = [form("{}"), form(r#"{ "print": "kodak-2393" }"#), form(r#"{ "camera": "kodak-tri-x-400" }"#)];
        let named: Vec<(&str, &DirectForm)> = ["a", "b", "c"].into_iter().zip(&all).collect();
        let bytes = pack(&named);
        let back = PackedLooks::new(&bytes).unwrap();
        assert!(named.iter().all(|(name, form)| back.form(name).unwrap().as_ref() == Some(*form)));
        // Both prints of one negative: its curves once.
        let (one, two) = (pack(&named[..1]).len(), pack(&named[..2]).len());
        assert!(two - one < one / 2, "{one} {two}");
        for end in (0..bytes.len()).step_by(bytes.len() / 97) {
            assert!(PackedLooks::new(&bytes[..end]).is_err(), "{end}");
        }
        assert!(PackedLooks::new(&[&bytes[..], &[0]].concat()).is_err());
    }

    #[test]
    fn no_bytes_make_it_panic() {
        let bytes = pack_one(&form(r#"{ "camera": "fuji-velvia-50" }"#));
        for place in 0..400 {
            for value in [0, 1, 0x7f, 0xff] {
                let mut changed = bytes.clone();
                changed[place] = value;
                let _ = unpack_one(&changed);
            }
        }
    }
}
