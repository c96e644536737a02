//! The page's files: the film as WebAssembly, its JavaScript, the page, looks that were made before.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use anyhow::{Context, Result, bail, ensure};
use flate2::Compression;
use flate2::write::GzEncoder;
use onelight_web::film_shader;
use wasm_bindgen_cli_support::Bindgen;

use crate::{glsl, looks};

/// What the film is compiled for.
const TARGET: &str = "wasm32-unknown-unknown";
/// Vectors of 128 bits: every browser of the last years has them.
const FLAGS: &str = "-C target-feature=+simd128";
/// The name that JavaScript imports.
const NAME: &str = "onelight_web";

/// Puts the page into `folder`, which has what it had until all of it is there; what it holds, in words.
///
/// # Errors
/// If the compiler lacks the target, something does not compile, or a file cannot be written.
pub(crate) fn build(top: &Path, folder: &Path) -> Result<String> {
    has_target()?;
    eprintln!("darkroom: the film as WebAssembly (minutes the first time)");
    let wasm = compile(top)?;
    let unfinished = folder.with_file_name(format!("darkroom.{}", std::process::id()));
    let made = fill(top, &wasm, &unfinished).and_then(|()| {
        if folder.exists() {
            fs::remove_dir_all(folder).with_context(|| format!("{}: cannot be replaced", folder.display()))?;
        }
        fs::rename(&unfinished, folder).with_context(|| format!("{}: cannot be made", folder.display()))
    });
    if made.is_err() {
        // The first error is the one to tell.
        let _ = fs::remove_dir_all(&unfinished);
    }
    made?;
    let shown = folder.strip_prefix(top).unwrap_or(folder);
    Ok(format!("{}: any server of static files serves it\n{}", shown.display(), sizes(folder)?))
}

/// Whether the compiler has the standard library for [`TARGET`].
fn has_target() -> Result<()> {
    let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let found = Command::new(rustc).args(["--print", "target-libdir", "--target", TARGET]).output();
    let found = found.context("rustc cannot be run")?;
    let folder = PathBuf::from(String::from_utf8_lossy(&found.stdout).trim());
    ensure!(
        found.status.success() && folder.is_dir(),
        "the compiler has no {TARGET}, expected it beside the machine's own: rustup target add {TARGET}"
    );
    Ok(())
}

/// Compiles the crate; where the result is.
fn compile(top: &Path) -> Result<PathBuf> {
    let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.args(["build", "--package", "onelight-web", "--lib", "--profile", "darkroom", "--target", TARGET]);
    cargo.env(format!("CARGO_TARGET_{}_RUSTFLAGS", TARGET.to_uppercase().replace('-', "_")), FLAGS);
    let status = cargo.current_dir(top).status().context("cargo cannot be run")?;
    ensure!(status.success(), "onelight-web for {TARGET}: found {status}, expected success");
    let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| top.join("target"), |folder| top.join(folder));
    Ok(target.join(TARGET).join("darkroom").join(format!("{NAME}.wasm")))
}

fn fill(top: &Path, wasm: &Path, folder: &Path) -> Result<()> {
    fs::create_dir_all(folder).with_context(|| format!("{}: the folder cannot be made", folder.display()))?;
    let mut bindgen = Bindgen::new();
    bindgen.input_path(wasm).typescript(false).remove_name_section(true).remove_producers_section(true);
    // A worker whose film trapped begins again with a new memory.
    bindgen.reset_state_function(true).web(true)?;
    bindgen.generate(folder).context("the JavaScript around the film")?;
    let page = top.join("crates/web/page");
    let entries = fs::read_dir(&page).with_context(|| format!("{}: cannot be read", page.display()))?;
    for entry in entries {
        let from = entry?.path();
        let Some(name) = from.file_name().filter(|_| from.is_file()) else { continue };
        fs::copy(&from, folder.join(name)).with_context(|| format!("{}: cannot be copied", from.display()))?;
    }
    write(&folder.join("film.wgsl"), film_shader().as_bytes())?;
    write(&folder.join("film.glsl.json"), &glsl::translated(&film_shader())?)?;
    eprintln!("darkroom: the looks of all camera films on all that they are printed on, and the scene to begin with");
    write(&folder.join("looks.bin"), &looks::looks()?)?;
    write(&folder.join("scene.exr"), &looks::scene()?)
}

fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    fs::write(path, bytes).with_context(|| format!("{}: cannot be written", path.display()))
}

/// Each file with its bytes, and those that a server sends where it compresses.
fn sizes(folder: &Path) -> Result<String> {
    let mut files = fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<Result<Vec<_>>>()?;
    files.sort();
    let (mut text, mut all, mut packed) = (String::new(), 0, 0);
    for file in files {
        let bytes = fs::read(&file)?;
        let mut gzip = GzEncoder::new(Vec::new(), Compression::best());
        gzip.write_all(&bytes)?;
        let small = gzip.finish()?.len();
        (all, packed) = (all + bytes.len(), packed + small);
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        let _ = writeln!(text, "  {name:24} {:>9} bytes, {small:>8} with gzip", bytes.len());
    }
    if all == 0 {
        bail!("{}: is empty, expected the page", folder.display());
    }
    let _ = write!(text, "  {:24} {all:>9} bytes, {packed:>8} with gzip", "all");
    Ok(text)
}
