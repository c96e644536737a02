//! What is taken away: the picture whole, and the look as files for other programs.

use std::collections::VecDeque;
use std::io::Cursor;

use onelight::baked::{Baked, BakedFile, Target, ocio_config};
use onelight::certify::{Certifier, CertifySettings};
use onelight::lut::DirectForm;
use onelight::lut::PixelMap as _;
use onelight::spatial::Frame;
use onelight::{Coverage, EffectsRun, FilmSteps, Process, TransferCurve, Word as _, colour_tag};
use onelight_picture::{
    Band, BandSink, Channels, Description, Dither, JpegSettings, PngBits, PngSettings, TiffBits, TiffSettings,
    write_exr, write_jpeg, write_png, write_tiff,
};

use crate::error::Error;
use crate::film_look::FilmLook;
use crate::keys::Keys;
use crate::on_film::effects_of;
use crate::read::{PictureFile, Reading, background};

/// A kind of picture that is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PictureKind {
    /// 8 bits, dithered.
    Png8,
    /// 16 bits.
    Png16,
    /// 16 bits.
    Tiff16,
    /// Display-linear floats, not clipped.
    Exr,
    /// 8 bits, of quality 95.
    Jpeg,
}

impl PictureKind {
    /// The kind for the page's word: `png8`, `png16`, `tiff16`, `exr`, `jpeg`.
    ///
    /// # Errors
    /// If there is no such word.
    pub fn parse(word: &str) -> Result<Self, Error> {
        match word {
            "png8" => Ok(Self::Png8),
            "png16" => Ok(Self::Png16),
            "tiff16" => Ok(Self::Tiff16),
            "exr" => Ok(Self::Exr),
            "jpeg" => Ok(Self::Jpeg),
            _ => Err(Error::format(word)),
        }
    }
}

/// A picture that is developed from a file into another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FileOrder<'a> {
    /// The name of the file that comes in.
    pub name: &'a str,
    /// What lies behind a picture with alpha: `none`, `black`, or what `cargo xtask develop` does where nothing is named.
    pub behind: &'a str,
    /// Stops by which it is made brighter. The look's own exposure counts too, and is best 0.
    pub ev: f64,
    /// What is written.
    pub kind: PictureKind,
}

/// A picture that was developed into a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DevelopedFile {
    /// The file.
    pub bytes: Vec<u8>,
    /// Which effects of the film were run and which were not, and why; a sentence each.
    pub reasons: Vec<String>,
}

/// Develops the picture in a file into another, with the effects of the look's film format: what `cargo xtask develop` does. `progress`
/// gets the share that is done.
///
/// ```
/// use std::io::Cursor;
/// use onelight_picture::{Limits, Picture, Source};
/// use onelight_web::{FileOrder, FilmLook, Keys, PictureKind, develop_file};
/// # let mut grey = Cursor::new(Vec::new());
/// # Picture::opaque(3, 2, vec![[0.18; 3]; 6], Source::Exr).write_exr(&mut grey, &[])?;
/// # let grey = grey.into_inner();
/// let keys = Keys::from_json("{}")?;
/// let order = FileOrder { name: "grey.exr", behind: "", ev: 0.0, kind: PictureKind::Png16 };
/// let png = develop_file(grey, &order, &keys, &FilmLook::new(&keys)?, &mut |_| {})?.bytes;
/// let picture = Picture::read(Cursor::new(png), "grey.png", Limits::default())?;
/// assert!((picture.rgb[0][1] - 0.4845).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the file is no picture, the look cannot be made, or an effect was asked for whose figures the film's sheet does not have.
pub fn develop_file(
    file: Vec<u8>,
    order: &FileOrder<'_>,
    keys: &Keys,
    look: &FilmLook,
    progress: &mut dyn FnMut(f64),
) -> Result<DevelopedFile, Error> {
    let FileOrder { name, behind, ev, kind } = *order;
    let linear = match kind {
        PictureKind::Exr => Some(FilmLook::new(&keys.with_coding(TransferCurve::Linear))?),
        _ => None,
    };
    let look = linear.as_ref().unwrap_or(look);
    let file = PictureFile::new(file, name);
    let Reading { mut light, is_covered, .. } =
        file.reading(look.process().spaces().input_space, background(behind))?;
    let mut reader = file.open()?;
    let description = reader.description().clone();
    if kind == PictureKind::Jpeg && description.channels == Channels::Rgba && light.coverage == Coverage::Kept {
        // It has no alpha: the picture lies over black.
        light.coverage = Coverage::Over([0.0; 3]);
    }
    let height = description.height.max(1) as f64;
    let mut done_before = 0.0;
    let effects = effects_of(look)?;
    let mut film = FilmAtWork { direct: look.direct()?, run: None, waiting: VecDeque::new() };
    let mut reasons = Vec::new();
    if let Some(effects) = &effects {
        let windows = &description.windows;
        let pitch = effects.pitch(windows.display_size[0], f64::from(windows.pixel_aspect))?;
        let at = [0, 1].map(|axis| windows.data_origin[axis].saturating_sub(windows.display_origin[axis]));
        let frame = Frame::new([description.width, description.height], pitch)?.at(at);
        let mut first = effects.look_at(FilmSteps::direct(look.exact()?.film()?, film.direct)?, frame)?;
        if first.needs_picture() {
            while let Some(band) = reader.next_band()? {
                light.expose(band, ev, None, None);
                first.add(band.rgb())?;
                progress(0.5 * (band.top() + band.rows()) as f64 / height);
            }
            (reader, done_before) = (file.open()?, 0.5);
        }
        let run = first.finish()?;
        reasons.extend_from_slice(run.reasons());
        if run.runs_any() && !is_covered && light.coverage == Coverage::Kept {
            reasons.push(
                "the picture keeps its alpha: where it covers nothing, the light that is stored there meets the film"
                    .to_owned(),
            );
        }
        film.run = run.runs_any().then_some(run);
    }
    let written = Description {
        primaries: Some(colour_tag(look.process().spaces()).primaries),
        white_luminance: None,
        channels: light.coverage.channels(&description),
        ..description
    };
    let fill = |sink: &mut dyn BandSink| {
        loop {
            let mut band = Band::default();
            reader.next_into(&mut band)?;
            if band.rows() == 0 {
                return Ok::<(), Error>(());
            }
            let share = (band.top() + band.rows()) as f64 / height;
            light.expose(&mut band, ev, None, None);
            for band in film.develop(band)? {
                sink.write(band.view())?;
            }
            progress(done_before + (1.0 - done_before) * share);
        }
    };
    let toml = keys.with_ev(ev).to_toml();
    let bytes = write(kind, &written, look.process(), &toml, fill)?;
    Ok(DevelopedFile { bytes, reasons })
}

/// A film that develops bands, which wait for those below them where it has effects.
struct FilmAtWork<'a> {
    direct: &'a DirectForm,
    run: Option<EffectsRun<'a>>,
    waiting: VecDeque<Band>,
}

impl FilmAtWork<'_> {
    /// Takes the next band of scene light; those that are developed now.
    fn develop(&mut self, mut band: Band) -> Result<Vec<Band>, Error> {
        let Some(run) = &mut self.run else {
            self.direct.map_colours(band.rgb_mut());
            return Ok(vec![band]);
        };
        run.add(band.rgb())?;
        self.waiting.push_back(band);
        let (mut ready, mut done) = (run.ready(), Vec::new());
        while let Some(mut band) = self.waiting.pop_front_if(|band| band.rows() <= ready) {
            run.develop(band.rgb_mut())?;
            ready -= band.rows();
            done.push(band);
        }
        Ok(done)
    }
}

/// Writes what `fill` hands over as a process's display sees it.
fn write(
    kind: PictureKind,
    written: &Description,
    process: &Process,
    toml: &str,
    fill: impl FnOnce(&mut dyn BandSink) -> Result<(), Error>,
) -> Result<Vec<u8>, Error> {
    let software = format!("onelight {}", env!("CARGO_PKG_VERSION"));
    let texts = [("Software", software.as_str()), ("onelight look", toml)];
    let tag = Some(colour_tag(process.spaces()));
    let (mut to, dither) = (Cursor::new(Vec::new()), Dither::Pattern);
    match kind {
        PictureKind::Exr => write_exr(&mut to, written, &texts, fill)?,
        PictureKind::Png8 => {
            write_png(&mut to, written, PngSettings { bits: PngBits::Eight, tag, dither }, &texts, fill)?;
        }
        PictureKind::Png16 => {
            write_png(&mut to, written, PngSettings { bits: PngBits::Sixteen, tag, dither }, &texts, fill)?;
        }
        PictureKind::Tiff16 => {
            write_tiff(&mut to, written, TiffSettings { bits: TiffBits::Sixteen, tag, dither }, &texts, fill)?;
        }
        PictureKind::Jpeg => {
            write_jpeg(&mut to, written, JpegSettings { tag, dither, ..JpegSettings::default() }, &texts, fill)?;
        }
    }
    Ok(to.into_inner())
}

/// Files of a look for one program, with what is to be known of them.
#[derive(Debug, Clone)]
pub struct ForProgram {
    /// The files, each with its name: tables, the description, the certificate, and a configuration where the program wants one.
    pub files: Vec<BakedFile>,
    /// How the program loads them, a line for each table.
    pub load: Vec<&'static str>,
}

/// Bakes a look for a program, as `cargo xtask bake --for` does, and certifies each table. `progress` gets the share that is done.
///
/// # Errors
/// If there is no such program (`for` of [`choices`](crate::choices)), or the look cannot be baked for it.
pub fn bake_for(
    keys: &Keys,
    program: &str,
    settings: &CertifySettings,
    progress: &mut dyn FnMut(f64),
) -> Result<ForProgram, Error> {
    let target = Target::parse(program)?;
    let tables = target.tables();
    let mut found = ForProgram { files: Vec::new(), load: Vec::new() };
    let mut certificate = String::new();
    let steps = 2.0 * tables.len() as f64;
    for (place, table) in tables.iter().enumerate() {
        let keys = target.usual_coding().map_or_else(|| keys.clone(), |coding| keys.with_coding(coding));
        let look = keys.process()?.look()?;
        let baked = look.baked(&table.recipe)?;
        progress((2 * place + 1) as f64 / steps);
        let certifier = Certifier::new(&look)?.within_coding(baked.coordinate());
        let written = baked.as_written(table.format)?;
        let report = certifier.report(|rgb| written.apply(rgb), baked.gamut(), settings)?;
        let comments = baked.comments(Some(&report.summary()));
        let files = baked.files(table.format, &comments)?;
        if target.takes_ocio_config()
            && let Some(file) = files.first()
        {
            let bytes = config(&baked, &file.name)?;
            found.files.push(BakedFile { name: "look.ocio".to_owned(), bytes });
        }
        let names: Vec<&str> = files.iter().map(|file| file.name.as_str()).collect();
        certificate += &format!("{}: {}\n  {}\n{report}\n", names.join(", "), baked.describe(), table.load);
        found.files.extend(files);
        found.load.push(table.load);
        progress((2 * place + 2) as f64 / steps);
    }
    found.files.push(BakedFile { name: "look.toml".to_owned(), bytes: keys.to_toml().into_bytes() });
    found.files.push(BakedFile { name: "certificate.txt".to_owned(), bytes: certificate.into_bytes() });
    Ok(found)
}

fn config(baked: &Baked, file: &str) -> Result<Vec<u8>, Error> {
    let comments = [format!("{}: {file}", baked.title()), format!("  {}", baked.output_in_words())];
    Ok(ocio_config(&[(baked, file)], &comments)?)
}

#[cfg(test)]
mod tests {
    use onelight::formats::CubeFile;
    use onelight::lut::{SamplingLaw, Search};
    use onelight_picture::{Limits, Picture, Source};

    use super::*;

    fn scene() -> Vec<u8> {
        let rgb = (0..64).map(|i| [0.02 * i as f32, 0.01 * (64 - i) as f32, 0.3]).collect();
        let picture = Picture { alpha: Some(vec![1.0; 64]), ..Picture::opaque(8, 8, rgb, Source::Exr) };
        let mut file = Cursor::new(Vec::new());
        picture.write_exr(&mut file, &[]).unwrap();
        file.into_inner()
    }

    #[test]
    fn every_kind_of_picture_holds_the_film() {
        let keys = Keys::from_json("{}").unwrap();
        let look = FilmLook::new(&keys).unwrap();
        let exact = look.exact().unwrap().develop([0.02 * 9.0 * 2.0, 0.01 * 55.0 * 2.0, 0.6]);
        for (word, tolerance) in
            [("png8", 1.1 / 255.0), ("png16", 5e-4), ("tiff16", 5e-4), ("exr", 5e-4), ("jpeg", 8.0 / 255.0)]
        {
            let mut shares = Vec::new();
            let kind = PictureKind::parse(word).unwrap();
            let order = FileOrder { name: "a.exr", behind: "", ev: 1.0, kind };
            let file = develop_file(scene(), &order, &keys, &look, &mut |done| shares.push(done)).unwrap().bytes;
            assert_eq!(shares, [1.0], "{word}");
            let picture = Picture::read(Cursor::new(file), word, Limits::default()).unwrap();
            assert_eq!((picture.width, picture.height, picture.alpha.is_some()), (8, 8, word != "jpeg"), "{word}");
            for (found, expected) in picture.rgb[9].iter().zip(exact) {
                let expected = if word == "exr" { TransferCurve::Srgb.decode(expected) } else { expected };
                assert!((f64::from(*found) - expected).abs() < tolerance, "{word}: {:?} {exact:?}", picture.rgb[9]);
            }
        }
        assert!(PictureKind::parse("gif").is_err());
    }

    #[test]
    fn a_film_format_brings_grain_and_says_so() {
        let keys = Keys::from_json(r#"{ "film_format": "super8", "grain": "on", "halation": "on" }"#).unwrap();
        let look = FilmLook::new(&keys).unwrap();
        let order = FileOrder { name: "a.exr", behind: "", ev: 0.0, kind: PictureKind::Png8 };
        let mut shares = Vec::new();
        let grainy = develop_file(scene(), &order, &keys, &look, &mut |done| shares.push(done)).unwrap();
        assert!(grainy.reasons.iter().any(|reason| reason.starts_with("grain")), "{:?}", grainy.reasons);
        assert_eq!(shares, [0.5, 1.0]);
        let plain = Keys::from_json("{}").unwrap();
        let look = FilmLook::new(&plain).unwrap();
        let plain = develop_file(scene(), &order, &plain, &look, &mut |_| {}).unwrap();
        assert!(plain.reasons.is_empty() && plain.bytes != grainy.bytes);
    }

    #[test]
    fn what_is_baked_is_certified_and_read_back() {
        let keys = Keys::from_json(r#"{ "camera": "fuji-velvia-50" }"#).unwrap().fitting().unwrap();
        let law = SamplingLaw { count: 1 << 8, ..SamplingLaw::default() };
        let settings = CertifySettings { law, search: Search::SamplesOnly };
        let mut done = Vec::new();
        let found = bake_for(&keys, "ffmpeg", &settings, &mut |share| done.push(share)).unwrap();
        assert_eq!(done, [0.5, 1.0]);
        let names: Vec<&str> = found.files.iter().map(|file| file.name.as_str()).collect();
        assert_eq!(names, ["look.srgb.cube", "look.toml", "certificate.txt"]);
        let cube = CubeFile::read(&found.files[0].bytes[..]).unwrap();
        let grey = cube.apply([0.461; 3], onelight::lut::Interpolation::Tetrahedral);
        assert!(grey.iter().all(|v| (v - 0.4845).abs() < 0.02), "{grey:?}");
        let certificate = String::from_utf8(found.files[2].bytes.clone()).unwrap();
        assert!(certificate.contains("certificate: CIEDE2000"), "{certificate}");
        assert!(bake_for(&keys, "photoshop", &settings, &mut |_| {}).is_err());
    }
}
