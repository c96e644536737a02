//! Our side of `peers/run.py`: does one command per line of the standard input and answers each with one line, `ok` and
//! numbers, or `error` and a sentence. Times are nanoseconds, taken around the work alone.
//!
//! | command | does | answers |
//! |---|---|---|
//! | `make FOLDER WIDTH HEIGHT` | writes the picture and the plain table as bare little-endian float32 | nodes a side, the shaper's offset and maximum |
//! | `threads N` | starts a pool of that many | |
//! | `level NAME` | maps pictures by these vector instructions (`AVX2`), not by the best there are | |
//! | `read FOLDER WIDTH HEIGHT` | loads what `make` wrote | |
//! | `build FORM` | `plain` from the table that was read, `structured`, `display` (that of display entries) and `direct` from the film, `structured-uncoupled` and `direct-uncoupled` from the film without inter-image effects | time |
//! | `apply FORM TYPE RUNS` | the whole picture through a form to `f32` or `u8` RGBA | time of each run |
//! | `copy RUNS` | copies the picture | time of each run |
//! | `save TYPE FILE` | writes the last result of that type | |
//! | `compile RUNS` | compiles the film | time of each run |
//! | `bake WAY SIZE RUNS` | a plain table by the `reference`, as `usual`, or through the usual `form` made before | time of each run |
//! | `misses WAY SIZE` | the same | largest CIEDE2000 from the reference at a node |

mod form;
mod session;

use std::error::Error;
use std::io::{BufRead, Write, stdin, stdout};

use session::Session;

fn main() -> Result<(), Box<dyn Error>> {
    let mut session = Session::default();
    for line in stdin().lock().lines() {
        let line = line?;
        let answer = match session.obey(&line.split_whitespace().collect::<Vec<_>>()) {
            Ok(numbers) => numbers.iter().fold("ok".to_owned(), |text, v| format!("{text} {v}")),
            Err(error) => format!("error {line:?}: {error}"),
        };
        let mut out = stdout().lock();
        writeln!(out, "{answer}")?;
        out.flush()?;
    }
    Ok(())
}
