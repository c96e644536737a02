//! Writes the valid files of `fixtures/corpus`: `cargo run --example seeds`, in `fuzz/`.

mod exr;
mod lut;
mod png;
mod text;
mod tiff;

use std::error::Error;
use std::fs;
use std::path::Path;

/// Why a file could not be made.
type Fault = Box<dyn Error>;
/// A file's name and contents.
type Seed = (String, Vec<u8>);

fn main() -> Result<(), Fault> {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures/corpus");
    let targets: [(&str, Vec<Seed>); 10] = [
        ("stock", text::stocks()?),
        ("look", text::looks()),
        ("cube", lut::cube()?),
        ("clf", lut::clf()?),
        ("spi3d", lut::spi3d()?),
        ("direct_json", lut::direct_json()?),
        ("ktx2", lut::ktx2()),
        ("exr", exr::files()?),
        ("tiff", tiff::files()?),
        ("png", png::files()?),
    ];
    for (target, seeds) in targets {
        let folder = corpus.join(target);
        fs::create_dir_all(&folder)?;
        let bytes: usize = seeds.iter().map(|(_, contents)| contents.len()).sum();
        println!("{target}: {} files, {bytes} bytes", seeds.len());
        for (name, contents) in seeds {
            fs::write(folder.join(name), contents)?;
        }
    }
    Ok(())
}
