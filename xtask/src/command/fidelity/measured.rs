use anyhow::Result;
use onelight_benches::fidelity;
use serde_json::json;

use super::Arguments;
use crate::atomic_file::AtomicFiles;
use crate::{Report, folders};

pub(crate) fn run(arguments: &Arguments) -> Result<Report> {
    let (docs, plots) = match &arguments.out {
        Some(folder) => (folders::make(folder)?, folders::make(folder)?),
        None => (folders::workspace()?.join("docs"), folders::output("")?),
    };
    let page = fidelity::measure()?;
    let mut text = AtomicFiles::in_folder(&docs);
    text.add("measured.md", page.markdown.into_bytes());
    let mut html = AtomicFiles::in_folder(&plots);
    html.add("fidelity.html", page.html.into_bytes());
    let mut files = text.write()?;
    files.extend(html.write()?);
    let shown: Vec<String> = files.iter().map(|file| folders::shown(file)).collect();
    Ok(Report { text: format!("{}\n", shown.join("\n")), json: json!({ "files": shown }), as_json: arguments.json })
}
