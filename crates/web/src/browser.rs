//! What JavaScript calls: bytes, numbers and JSON.
#![expect(unreachable_pub, reason = "wasm-bindgen exports what is public; no Rust calls it")]

use onelight::certify::CertifySettings;
use onelight::{Word as _, WorkingSpace};
use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsError, JsValue};

use crate::{FilmLook, Keys, OpenedPicture, PictureKind, Way, bake_for, choices, develop_file, films, look_bytes};

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

/// What a graphics card reads of a look, from its direct form: see [`look_bytes`].
#[wasm_bindgen(js_name = lookBytes)]
pub fn look_bytes_of(direct_json: &str) -> Result<Vec<u8>> {
    Ok(look_bytes(direct_json)?)
}

/// A look that develops pixels.
#[wasm_bindgen(js_name = Look)]
#[derive(Debug)]
pub struct BrowserLook {
    keys: Keys,
    look: FilmLook,
}

#[wasm_bindgen(js_class = Look)]
impl BrowserLook {
    /// Of these keys; with its direct form where it was made before.
    #[wasm_bindgen(constructor)]
    pub fn new(keys: &str, direct_json: Option<String>) -> Result<Self> {
        let keys = Keys::from_json(keys)?;
        let look = FilmLook::new(&keys)?;
        let look = match direct_json {
            Some(json) => look.with_direct(&json)?,
            None => look,
        };
        look.direct()?;
        Ok(Self { keys, look })
    }

    /// Display codes for light in half floats: see [`FilmLook::develop`].
    pub fn develop(&self, light: &[u16], ev: f64) -> Result<Vec<u8>> {
        Ok(self.look.develop(light, ev)?)
    }

    /// The direct form as a file.
    #[wasm_bindgen(js_name = directJson)]
    pub fn direct_json(&self) -> Result<String> {
        Ok(String::from_utf8_lossy(&self.look.direct_json()?).into_owned())
    }

    /// Where a scene-linear colour comes from, as the JSON of [`Way`].
    pub fn way(&self, red: f64, green: f64, blue: f64) -> Result<String> {
        Ok(serde_json::to_string(&Way::of(&self.look, [red, green, blue])?)?)
    }

    /// Develops a whole file into another.
    #[wasm_bindgen(js_name = developFile)]
    pub fn develop_file(&self, file: Vec<u8>, name: &str, ev: f64, kind: &str) -> Result<Vec<u8>> {
        Ok(develop_file(file, name, &self.keys, &self.look, ev, PictureKind::parse(kind)?, &mut |_| {})?)
    }
}

/// A picture file that is read band after band.
#[wasm_bindgen(js_name = Picture)]
#[derive(Debug)]
pub struct BrowserPicture(OpenedPicture);

#[wasm_bindgen(js_class = Picture)]
impl BrowserPicture {
    /// Opens a file; `space` is the look's input space.
    #[wasm_bindgen(constructor)]
    pub fn new(file: Vec<u8>, name: &str, space: &str) -> Result<Self> {
        Ok(Self(OpenedPicture::new(file, name, WorkingSpace::parse(space)?)?))
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
