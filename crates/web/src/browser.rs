//! What JavaScript calls: bytes, numbers and JSON.
#![expect(unreachable_pub, reason = "wasm-bindgen exports what is public; no Rust calls it")]

use onelight::certify::CertifySettings;
use onelight::lut::DirectForm;
use onelight::{Word as _, WorkingSpace};
use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsError, JsValue};

use crate::{
    DevelopedFile, FileOrder, FilmLook, FramePart, Keys, MovingLook, OnFilm, OpenedPicture, PackedLooks, PictureKind,
    Way, bake_for, choices, develop_codes, develop_file, develop_on_film, films, look_bytes, look_name, pack_one,
    quick_form, unpack_one,
};

type Result<T> = std::result::Result<T, JsError>;

#[wasm_bindgen]
extern "C" {
    /// A function of the page that takes the share that is done.
    pub type Progress;
    #[wasm_bindgen(method, structural, js_name = call)]
    fn tell(this: &Progress, own: &JsValue, share: f64);
}

/// All films, and the words of the controls: `{ films, choices }`.
#[wasm_bindgen(js_name = offered)]
pub fn offered() -> Result<String> {
    Ok(serde_json::json!({ "films": films()?, "choices": choices() }).to_string())
}

/// All keys for some, as far as they mean something to their films.
#[wasm_bindgen(js_name = fittingKeys)]
pub fn fitting_keys(json: &str) -> Result<String> {
    Ok(Keys::from_json(json)?.fitting()?.to_json()?)
}

/// All keys of a `look.toml`.
#[wasm_bindgen(js_name = keysOfToml)]
pub fn keys_of_toml(text: &str) -> Result<String> {
    Ok(Keys::from_toml(text)?.to_json()?)
}

/// The `look.toml` of all keys.
#[wasm_bindgen(js_name = tomlOfKeys)]
pub fn toml_of_keys(json: &str) -> Result<String> {
    let keys = Keys::from_json(json)?;
    keys.process()?;
    Ok(keys.to_toml())
}

/// The keys that decide colours, made to fit: the name that looks are known by.
#[wasm_bindgen(js_name = colourKeys)]
pub fn colour_keys(json: &str) -> Result<String> {
    Ok(Keys::from_json(json)?.fitting()?.colours().to_json()?)
}

/// What a graphics card reads of a look, from its packed form: see [`look_bytes`].
#[wasm_bindgen(js_name = lookBytes)]
pub fn look_bytes_of(packed: &[u8]) -> Result<Vec<u8>> {
    Ok(look_bytes(&unpack_one(packed)?)?)
}

/// The looks that the page is shipped with: see [`PackedLooks`].
#[wasm_bindgen(js_name = Shipped)]
#[derive(Debug)]
pub struct BrowserShipped(PackedLooks);

#[wasm_bindgen(js_class = Shipped)]
impl BrowserShipped {
    /// Of a packed file.
    #[wasm_bindgen(constructor)]
    pub fn new(file: &[u8]) -> Result<Self> {
        Ok(Self(PackedLooks::new(file)?))
    }

    /// The packed form of the usual look of these keys' films; `undefined` where it was not shipped.
    #[wasm_bindgen(js_name = usual)]
    pub fn usual(&self, keys: &str) -> Result<Option<Vec<u8>>> {
        let form = self.0.form(&look_name(&Keys::from_json(keys)?))?;
        Ok(form.as_ref().map(pack_one))
    }

    /// The packed form of these keys where numbers suffice to have it from a shipped one ([`quick_form`]), else `undefined`.
    #[wasm_bindgen(js_name = quick)]
    pub fn quick(&self, keys: &str) -> Result<Option<Vec<u8>>> {
        let keys = Keys::from_json(keys)?;
        let Some(usual) = self.0.form(&look_name(&keys))? else { return Ok(None) };
        Ok(quick_form(&keys, &usual)?.as_ref().map(pack_one))
    }
}

/// A packed form that develops pixels.
#[wasm_bindgen(js_name = Form)]
#[derive(Debug)]
pub struct BrowserForm(DirectForm);

#[wasm_bindgen(js_class = Form)]
impl BrowserForm {
    /// Of a packed look.
    #[wasm_bindgen(constructor)]
    pub fn new(packed: &[u8]) -> Result<Self> {
        Ok(Self(unpack_one(packed)?))
    }

    /// Display codes for light in half floats: see [`develop_codes`].
    pub fn develop(&self, light: &[u16], ev: f64) -> Result<Vec<u8>> {
        Ok(develop_codes(&self.0, light, ev)?)
    }
}

/// Films whose form follows the controls: see [`MovingLook`].
#[wasm_bindgen(js_name = Moving)]
#[derive(Debug)]
pub struct BrowserMoving(MovingLook);

#[wasm_bindgen(js_class = Moving)]
impl BrowserMoving {
    /// The films of these keys; with the packed form of their usual look where it was shipped.
    #[wasm_bindgen(constructor)]
    pub fn new(keys: &str, usual: Option<Vec<u8>>) -> Result<Self> {
        let usual = usual.map(|packed| unpack_one(&packed)).transpose()?;
        Ok(Self(MovingLook::new(&Keys::from_json(keys)?, usual)?))
    }

    /// The packed form of these keys.
    pub fn form(&mut self, keys: &str) -> Result<Vec<u8>> {
        Ok(pack_one(&self.0.form(&Keys::from_json(keys)?)?))
    }
}

/// A look with its film: where colours come from, and whole pictures.
#[wasm_bindgen(js_name = Look)]
#[derive(Debug)]
pub struct BrowserLook {
    keys: Keys,
    look: FilmLook,
}

#[wasm_bindgen(js_class = Look)]
impl BrowserLook {
    /// Of these keys, with the packed form of its colours.
    #[wasm_bindgen(constructor)]
    pub fn new(keys: &str, packed: &[u8]) -> Result<Self> {
        let keys = Keys::from_json(keys)?;
        let look = FilmLook::new(&keys)?.with_direct(unpack_one(packed)?);
        Ok(Self { keys, look })
    }

    /// Where a scene-linear colour comes from, as the JSON of [`Way`].
    pub fn way(&self, red: f64, green: f64, blue: f64) -> Result<String> {
        Ok(serde_json::to_string(&Way::of(&self.look, [red, green, blue])?)?)
    }

    /// Develops a rectangle of light with the effects of the film format: see [`develop_on_film`].
    #[wasm_bindgen(js_name = onFilm)]
    #[expect(clippy::too_many_arguments, reason = "JavaScript hands numbers over one by one")]
    pub fn on_film(
        &self,
        light: &[u16],
        width: usize,
        height: usize,
        left: i32,
        top: i32,
        frame_width: usize,
        pixel_aspect: f64,
        ev: f64,
    ) -> Result<BrowserOnFilm> {
        let part = FramePart { size: [width, height], at: [left, top], frame_width, pixel_aspect };
        Ok(BrowserOnFilm(develop_on_film(&self.look, light, &part, ev)?))
    }

    /// Develops a whole file into another.
    #[wasm_bindgen(js_name = developFile)]
    pub fn develop_file(
        &self,
        file: Vec<u8>,
        name: &str,
        behind: &str,
        ev: f64,
        kind: &str,
        progress: &Progress,
    ) -> Result<BrowserOnFilm> {
        let order = FileOrder { name, behind, ev, kind: PictureKind::parse(kind)? };
        let mut tell = |share| progress.tell(&JsValue::UNDEFINED, share);
        let DevelopedFile { bytes, reasons } = develop_file(file, &order, &self.keys, &self.look, &mut tell)?;
        Ok(BrowserOnFilm(OnFilm { codes: Some(bytes), reasons }))
    }
}

/// Bytes, and what was done to the picture in them.
#[wasm_bindgen(js_name = OnFilm)]
#[derive(Debug)]
pub struct BrowserOnFilm(OnFilm);

#[wasm_bindgen(js_class = OnFilm)]
impl BrowserOnFilm {
    /// Codes or the file, once; `undefined` where no effect is run.
    pub fn bytes(&mut self) -> Option<Vec<u8>> {
        self.0.codes.take()
    }

    /// Which effects are run and which are not, and why, a line each.
    pub fn reasons(&self) -> String {
        self.0.reasons.join("\n")
    }
}

/// A picture file that is read band after band.
#[wasm_bindgen(js_name = Picture)]
#[derive(Debug)]
pub struct BrowserPicture(OpenedPicture);

#[wasm_bindgen(js_class = Picture)]
impl BrowserPicture {
    /// Opens a file; `space` is the look's input space, `behind` what lies behind a picture with alpha.
    #[wasm_bindgen(constructor)]
    pub fn new(file: Vec<u8>, name: &str, space: &str, behind: &str) -> Result<Self> {
        Ok(Self(OpenedPicture::new(file, name, WorkingSpace::parse(space)?, behind)?))
    }

    /// The JSON of [`Described`](crate::Described).
    pub fn described(&self) -> Result<String> {
        Ok(serde_json::to_string(&self.0.described())?)
    }

    /// The next rows, light in half floats; `undefined` after the last.
    #[wasm_bindgen(js_name = nextRows)]
    pub fn next_rows(&mut self) -> Result<Option<Vec<u16>>> {
        Ok(self.0.next_rows()?)
    }

    /// The smaller copy.
    pub fn preview(&self) -> Vec<u16> {
        self.0.preview()
    }

    /// The smallest copy.
    pub fn thumbnail(&self) -> Vec<u16> {
        self.0.thumbnail()
    }

    /// The JSON of [`Seen`](crate::Seen).
    pub fn seen(&self) -> Result<String> {
        Ok(serde_json::to_string(&self.0.seen())?)
    }
}

/// The files of a look for a program.
#[wasm_bindgen(js_name = Files)]
#[derive(Debug)]
pub struct BrowserFiles(crate::ForProgram);

#[wasm_bindgen(js_class = Files)]
impl BrowserFiles {
    /// Bakes and certifies; `progress` is called with the share that is done.
    #[wasm_bindgen(constructor)]
    pub fn new(keys: &str, program: &str, progress: &Progress) -> Result<Self> {
        let mut tell = |share| progress.tell(&JsValue::UNDEFINED, share);
        Ok(Self(bake_for(&Keys::from_json(keys)?, program, &CertifySettings::default(), &mut tell)?))
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.0.files.len()
    }

    /// The name of one.
    pub fn name(&self, place: usize) -> Option<String> {
        self.0.files.get(place).map(|file| file.name.clone())
    }

    /// The bytes of one.
    pub fn bytes(&self, place: usize) -> Option<Vec<u8>> {
        self.0.files.get(place).map(|file| file.bytes.clone())
    }

    /// How the program loads them, a line for each.
    pub fn load(&self) -> String {
        self.0.load.join("\n")
    }
}
