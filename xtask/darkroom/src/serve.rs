//! A server for one folder and this machine alone.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow};
use tiny_http::{Header, Method, Request, Response, Server};

/// The port unless another is named.
pub(crate) const PORT: u16 = 8127;

/// Serves the files of a folder until the program ends.
///
/// # Errors
/// If the folder cannot be read, or something else has the port.
pub(crate) fn serve(folder: &Path, port: u16) -> Result<()> {
    let files = files(folder)?;
    let server = Server::http(("127.0.0.1", port))
        .map_err(|error| anyhow!("port {port}: {error}, expected a free one (--port NUMBER, 0 for any)"))?;
    println!("http://{}/ (Ctrl-C ends it)", server.server_addr());
    for request in server.incoming_requests() {
        // Whoever asked has gone: there is nobody to tell.
        let _ = answer(request, &files);
    }
    Ok(())
}

/// What may be asked for: a path of the address with its file. Nothing else is ever opened.
fn files(folder: &Path) -> Result<BTreeMap<String, PathBuf>> {
    let entries = fs::read_dir(folder).with_context(|| format!("{}: cannot be read", folder.display()))?;
    let mut files = BTreeMap::new();
    for entry in entries {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if name == "index.html" {
            files.insert("/".to_owned(), path.clone());
        }
        files.insert(format!("/{name}"), path);
    }
    Ok(files)
}

fn answer(request: Request, files: &BTreeMap<String, PathBuf>) -> std::io::Result<()> {
    let asked = request.url().split(['?', '#']).next().unwrap_or_default();
    if !matches!(request.method(), Method::Get | Method::Head) {
        return request.respond(Response::from_string("this server only gives files\n").with_status_code(405));
    }
    let Some(path) = files.get(asked) else {
        return request.respond(Response::from_string("there is no such file\n").with_status_code(404));
    };
    let mut response = Response::from_file(File::open(path)?);
    for (name, value) in [
        ("Content-Type", mime(path)),
        // A page that was built anew is seen at once.
        ("Cache-Control", "no-cache"),
        ("X-Content-Type-Options", "nosniff"),
    ] {
        if let Ok(header) = Header::from_bytes(name, value) {
            response.add_header(header);
        }
    }
    request.respond(response)
}

/// Browsers run scripts and WebAssembly of these types alone.
fn mime(path: &Path) -> &'static str {
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("html") => "text/html; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("js") => "text/javascript; charset=utf-8",
        Some("json") => "application/json",
        Some("wasm") => "application/wasm",
        Some("svg") => "image/svg+xml",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_files_of_the_folder_are_known() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("index.html"), "").unwrap();
        fs::write(folder.path().join("film.wasm"), "").unwrap();
        let files = files(folder.path()).unwrap();
        assert_eq!(files.keys().collect::<Vec<_>>(), ["/", "/film.wasm", "/index.html"]);
        assert_eq!(mime(&files["/"]), "text/html; charset=utf-8");
        assert_eq!(mime(&files["/film.wasm"]), "application/wasm");
    }
}
