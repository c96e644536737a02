//! Data sheets of one's own: folders in the form of `stocks/<id>`.

use std::fs::{self, File};
use std::io::Read as _;
use std::path::{Component, Path, PathBuf};

use anyhow::{Context, Result, bail};
use onelight::{OwnSheet, SheetText, Stock};

/// The files of a sheet.
const FILES: [&str; 4] = ["stock.toml", "sensitivity.csv", "characteristic.csv", "dye_density.csv"];
/// Those that not every sheet has: for sharpness and grain.
const FIGURES: [&str; 2] = ["mtf.csv", "granularity.csv"];
/// More bytes than any of them may have; the library has limits of its own.
const MAX_BYTES: u64 = 4 << 20;

/// A stock read from a folder.
#[derive(Debug)]
pub(crate) struct OwnStock {
    pub(crate) stock: Stock,
    /// Where it was, in full, and the digest of what was read.
    pub(crate) sheet: OwnSheet,
}

/// Whether a word of the command line is a folder, not the id of a stock.
pub(crate) fn is_folder(word: &str) -> bool {
    onelight::stock_ids().all(|id| id != word) && (word.contains(['/', '\\']) || Path::new(word).is_dir())
}

/// Reads the data sheet in a folder; after an `@` stands the variant that is meant.
pub(crate) fn read(folder: &Path) -> Result<OwnStock> {
    let shown = folder.display();
    let whole = folder.to_str().filter(|_| !folder.is_dir());
    let (folder, variant) = match whole.and_then(|whole| whole.rsplit_once('@')) {
        Some((folder, variant)) => (Path::new(folder), Some(variant)),
        None => (folder, None),
    };
    if !folder.is_dir() {
        bail!("{shown}: no such folder, expected one in the form of stocks/kodak-5207");
    }
    if !folder.join(FILES[0]).exists() {
        bail!("{shown}: no stock.toml in it, expected a folder in the form of stocks/kodak-5207");
    }
    let folder = folder.canonicalize().with_context(|| format!("{shown}: cannot be read"))?;
    let (Some(path), Some(id)) = (folder.to_str(), folder.file_name().and_then(|name| name.to_str())) else {
        bail!("{shown}: its name is no text, expected a folder named as the stock's id");
    };
    let [stock_toml, sensitivity_csv, characteristic_csv] =
        [text(&folder, FILES[0])?, text(&folder, FILES[1])?, text(&folder, FILES[2])?];
    // Black and white has no dyes.
    let silver = stock_toml.contains("silver") && !folder.join(FILES[3]).exists();
    let dye_density_csv = if silver { String::new() } else { text(&folder, FILES[3])? };
    let id = variant.map_or_else(|| id.to_owned(), |variant| format!("{id}@{variant}"));
    let text = SheetText {
        id: &id,
        stock_toml: &stock_toml,
        sensitivity_csv: &sensitivity_csv,
        characteristic_csv: &characteristic_csv,
        dye_density_csv: &dye_density_csv,
    };
    let figure = |name| if folder.join(name).exists() { self::text(&folder, name).map(Some) } else { Ok(None) };
    let [mtf, granularity] = [figure(FIGURES[0])?, figure(FIGURES[1])?];
    let stock = Stock::parse(&text)?;
    // Without either, colour is all that the folder is for.
    let stock = match (&mtf, &granularity) {
        (None, None) => stock,
        _ => stock.with_figures(mtf.as_deref(), granularity.as_deref())?,
    };
    let sheet = OwnSheet::with_figures(path, &text, mtf.as_deref(), granularity.as_deref());
    let sheet = OwnSheet { id: stock.id().to_owned(), ..sheet };
    Ok(OwnStock { stock, sheet })
}

fn text(folder: &Path, name: &str) -> Result<String> {
    let path = folder.join(name);
    let shown = path.display();
    let file = File::open(&path).with_context(|| format!("{shown}: cannot be read"))?;
    let mut text = String::new();
    file.take(MAX_BYTES + 1).read_to_string(&mut text).with_context(|| format!("{shown}: is no text"))?;
    if text.len() as u64 > MAX_BYTES {
        bail!("{shown}: more than {MAX_BYTES} bytes, expected a data sheet");
    }
    Ok(text)
}

/// Bytes as hexadecimal digits.
pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// A path in full as seen from a folder, with `/` between names; as it is where there is no way, as on another drive.
pub(crate) fn seen_from(folder: &Path, path: &str) -> String {
    let Ok(folder) = fs::canonicalize(folder) else { return path.to_owned() };
    let target = PathBuf::from(path);
    let same = folder.components().zip(target.components()).take_while(|(a, b)| a == b).count();
    let rest = || target.components().skip(same);
    if same == 0 || rest().any(|part| !matches!(part, Component::Normal(_))) {
        return path.to_owned();
    }
    let up = folder.components().skip(same).map(|_| "..".to_owned());
    let parts: Vec<String> = up.chain(rest().map(|part| part.as_os_str().to_string_lossy().into_owned())).collect();
    if parts.is_empty() { ".".to_owned() } else { parts.join("/") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet(id: &str) -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../stocks").join(id)
    }

    #[test]
    fn a_folder_is_its_stock() {
        let own = read(&sheet("kodak-5207")).unwrap();
        assert_eq!((own.stock.id(), own.sheet.id.as_str()), ("kodak-5207", "kodak-5207"));
        assert!(Path::new(&own.sheet.path).is_absolute() && own.sheet.sha256.len() == 64);
        assert_ne!(own.sheet.sha256, read(&sheet("kodak-2383")).unwrap().sheet.sha256);
    }

    #[test]
    fn what_is_no_sheet_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let message = |path: &Path| format!("{:#}", read(path).unwrap_err());
        assert!(message(&folder.path().join("gone")).contains("no such folder"));
        assert!(message(folder.path()).contains("no stock.toml in it"));
        let own = folder.path().join("mine");
        fs::create_dir(&own).unwrap();
        fs::copy(sheet("kodak-5207").join("stock.toml"), own.join("stock.toml")).unwrap();
        assert!(message(&own).contains("sensitivity.csv: cannot be read"));
        for name in &FILES[1..] {
            fs::copy(sheet("kodak-5207").join(name), own.join(name)).unwrap();
        }
        assert!(message(&own).contains("has id \"kodak-5207\""));
        fs::write(own.join("dye_density.csv"), [0xff, 0xfe]).unwrap();
        assert!(message(&own).contains("dye_density.csv: is no text"));
    }

    #[test]
    fn ids_and_folders_are_told_apart() {
        assert!(!is_folder("kodak-5207") && !is_folder("kodak-52007") && is_folder("../mine") && is_folder("./mine"));
    }

    #[test]
    fn paths_are_seen_from_the_folder_of_the_look() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path().canonicalize().unwrap();
        for name in ["looks/a", "mine"] {
            fs::create_dir_all(root.join(name)).unwrap();
        }
        let mine = root.join("mine");
        let mine = mine.to_str().unwrap();
        assert_eq!(seen_from(&root.join("looks/a"), mine), "../../mine");
        assert_eq!(seen_from(&root, mine), "mine");
        assert_eq!(seen_from(&root.join("mine"), mine), ".");
        assert_eq!(seen_from(&root.join("gone"), mine), mine);
    }
}
