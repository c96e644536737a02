//! Films that several tests look at, compiled once.

use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex, OnceLock};

use onelight::lut::DirectForm;
use onelight::{FilmProcess, Process, Reference, StockKind, stock, stock_ids};

/// Made when it is first asked for; others wait for it.
type Slot<T> = Arc<OnceLock<Arc<T>>>;
type Slots<T> = LazyLock<Mutex<HashMap<String, Slot<T>>>>;

static FILMS: Slots<Reference> = LazyLock::new(Mutex::default);
static DIRECT: Slots<DirectForm> = LazyLock::new(Mutex::default);

fn once<T>(slots: &Slots<T>, process: &FilmProcess, make: impl FnOnce() -> T) -> Arc<T> {
    let key = Process::from(process.clone()).to_toml();
    let slot = Arc::clone(slots.lock().unwrap().entry(key).or_default());
    Arc::clone(slot.get_or_init(|| Arc::new(make())))
}

/// A process that compiles, compiled.
pub(crate) fn compiled(process: &FilmProcess) -> Arc<Reference> {
    once(&FILMS, process, || process.compile().unwrap_or_else(|error| panic!("{process:?}: {error}")))
}

/// The usual process of a camera film, compiled.
pub(crate) fn film(camera: &str) -> Arc<Reference> {
    compiled(&process(camera))
}

/// The usual direct form of a process.
pub(crate) fn direct(process: &FilmProcess) -> Arc<DirectForm> {
    once(&DIRECT, process, || compiled(process).direct(&Default::default()).unwrap())
}

/// The usual process of a camera film.
pub(crate) fn process(camera: &str) -> FilmProcess {
    FilmProcess::for_camera(camera).unwrap()
}

/// The usual process of a negative with its printing changed.
pub(crate) fn printed(camera: &str, turn: impl FnOnce(&mut onelight::Printing)) -> FilmProcess {
    let mut process = process(camera);
    turn(process.print.as_mut().unwrap());
    process
}

/// Every camera film once, negatives on the print films in turn, and every print film under the usual negative.
pub(crate) fn films_once() -> Vec<(&'static str, Option<&'static str>)> {
    let of_kind = |kind| stock_ids().filter(move |id| stock(id).unwrap().kind() == kind);
    let prints: Vec<&str> = of_kind(StockKind::Print).collect();
    let usual = prints.iter().map(|print| (onelight::DEFAULT_CAMERA, Some(*print)));
    let in_turn = of_kind(StockKind::Negative)
        .filter(|camera| *camera != onelight::DEFAULT_CAMERA)
        .zip(prints.iter().cycle())
        .map(|(camera, print)| (camera, Some(*print)));
    of_kind(StockKind::Reversal).map(|camera| (camera, None)).chain(usual).chain(in_turn).collect()
}
