use onelight::Process;

use super::{Met, OneIn, hard_colours, refused};

/// A description that is read is the same when written and read again, and either makes a film or errs; the film's
/// colours are finite. Films are made for one input in `compiled`.
pub fn check(bytes: &[u8], compiled: OneIn) -> Met {
    let Ok(text) = std::str::from_utf8(bytes) else { return Met::Refused };
    let process = match Process::from_toml("look.toml", text) {
        Ok(process) => process,
        Err(error) => return refused(&error),
    };
    let written = process.to_toml();
    let again = Process::from_toml("look.toml", &written);
    assert!(again.as_ref().is_ok_and(|again| *again == process), "{process:?} became {again:?} by\n{written}");
    let _ = process.name();
    if !compiled.holds(bytes) {
        return Met::Read;
    }
    let film = match process.look() {
        Ok(film) => film,
        Err(error) => return refused(&error),
    };
    for rgb in hard_colours() {
        let rgb = rgb.map(f64::from);
        for shown in [film.develop(rgb), film.develop_linear(rgb).0] {
            assert!(shown.iter().all(|v| v.is_finite()), "{rgb:?} became {shown:?}");
        }
    }
    Met::Read
}
