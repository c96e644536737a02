//! Films that several tests look at, compiled once.

use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex, OnceLock};

use onelight::lut::DirectForm;
use onelight::{FilmProcess, Process, Reference, Stock, StockKind, stock, stock_ids};

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

/// Every camera film once, those that are printed on what they are printed on in turn, and all that is printed on at least once.
pub(crate) fn films_once() -> Vec<(&'static str, Option<&'static str>)> {
    let all: Vec<(&str, Stock)> = stock_ids().map(|id| (id, stock(id).unwrap())).collect();
    let mut pairs = Vec::new();
    let mut printed_on = vec![0; all.len()];
    let mut print = |pairs: &mut Vec<_>, camera: usize, print: usize| {
        printed_on[print] += 1;
        pairs.push((all[camera].0, Some(all[print].0)));
    };
    for (i, (id, camera)) in all.iter().enumerate() {
        if matches!(camera.kind(), StockKind::Reversal | StockKind::Instant) {
            pairs.push((*id, None));
        }
        let fits: Vec<usize> = (0..all.len()).filter(|&print| camera.is_printed_on(&all[print].1)).collect();
        // The usual negative is printed on everything.
        match *id {
            onelight::DEFAULT_CAMERA | "kodak-5222" | "fuji-velvia-50" => {
                fits.into_iter().for_each(|on| print(&mut pairs, i, on));
            }
            _ if fits.is_empty() => {}
            _ => print(&mut pairs, i, fits[i % fits.len()]),
        }
    }
    let missed = all.iter().zip(&printed_on).find(|((_, stock), count)| !stock.kind().is_camera_film() && **count == 0);
    assert!(missed.is_none(), "nothing is printed on {missed:?}");
    pairs
}

/// The same as the talk has them: what was published of its figures, and what is computed a second time by hand, is of film by its
/// sheet alone.
pub(crate) mod talk {
    use std::sync::Arc;

    use onelight::{FilmProcess, Printing, Reference};

    /// The usual process of a camera film.
    pub(crate) fn process(camera: &str) -> FilmProcess {
        super::process(camera).as_in_the_talk()
    }

    /// The same, compiled.
    pub(crate) fn film(camera: &str) -> Arc<Reference> {
        super::compiled(&process(camera))
    }

    /// The usual process of a negative with its printing changed.
    pub(crate) fn printed(camera: &str, turn: impl FnOnce(&mut Printing)) -> FilmProcess {
        super::printed(camera, turn).as_in_the_talk()
    }
}
