use std::collections::HashMap;
use std::error::Error;
use std::fs;
use std::path::Path;
use std::time::Instant;

use onelight::{Reference, TableCoding};
use onelight_benches::{Form, NEGATIVE, PLAIN_SIZE, SHAPER, film, natural, plain};
use onelight_lut::{Channels, Pixels, PixelsMut, Sample, SimdLevel};
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::form::{self, BakeMethod};

type Answer = Result<Vec<f64>, Box<dyn Error>>;

/// Samples of a piece that one task copies.
const COPY_BLOCK: usize = 1 << 16;

/// What earlier commands have left.
#[derive(Default)]
pub(crate) struct Session {
    pool: Option<ThreadPool>,
    /// The instructions that pictures are mapped by; the best ones where none were named.
    level: Option<SimdLevel>,
    film: Option<Reference>,
    /// The same without inter-image effects.
    uncoupled: Option<Reference>,
    forms: HashMap<String, Form>,
    table: Vec<[f32; 3]>,
    size: [usize; 2],
    picture: Vec<f32>,
    floats: Vec<f32>,
    bytes: Vec<u8>,
}

impl Session {
    /// Does one command of the table in `main.rs`; its numbers, or why it failed.
    pub(crate) fn obey(&mut self, words: &[&str]) -> Answer {
        match *words {
            ["make", folder, width, height] => make(Path::new(folder), [width.parse()?, height.parse()?]),
            ["threads", count] => {
                self.pool = Some(ThreadPoolBuilder::new().num_threads(count.parse()?).build()?);
                Ok(Vec::new())
            }
            ["level", name] => {
                let known = SimdLevel::available();
                let names = || known.iter().map(|level| level.name()).collect::<Vec<_>>().join(", ");
                let level = known.iter().find(|level| level.name() == name);
                self.level = Some(*level.ok_or_else(|| format!("found {name}, expected one of {}", names()))?);
                Ok(Vec::new())
            }
            ["read", folder, width, height] => self.read(Path::new(folder), [width.parse()?, height.parse()?]),
            ["build", form] => self.build(form),
            ["apply", form, "f32", runs] => {
                let form = self.forms.get(form).ok_or("build the form first")?;
                let level = self.level.unwrap_or_else(SimdLevel::best);
                apply((self.pool.as_ref(), level), form, &self.picture, &mut self.floats, self.size, runs.parse()?)
            }
            ["apply", form, "u8", runs] => {
                let form = self.forms.get(form).ok_or("build the form first")?;
                let level = self.level.unwrap_or_else(SimdLevel::best);
                apply((self.pool.as_ref(), level), form, &self.picture, &mut self.bytes, self.size, runs.parse()?)
            }
            ["copy", runs] => copy(self.pool.as_ref(), &self.picture, &mut self.floats, runs.parse()?),
            ["save", "f32", file] => write_floats(Path::new(file), self.floats.iter()),
            ["save", "u8", file] => {
                fs::write(file, &self.bytes)?;
                Ok(Vec::new())
            }
            ["compile", runs] => {
                let compiled = &mut self.film;
                times(self.pool.as_ref(), runs.parse()?, || {
                    *compiled = Some(film(NEGATIVE)?);
                    Ok(())
                })
            }
            ["bake", way, size, runs] => {
                let film = known(&mut self.film)?;
                let (method, size) = (BakeMethod::parse(way, film)?, size.parse()?);
                times(self.pool.as_ref(), runs.parse()?, || method.bake(film, size).map(drop))
            }
            ["misses", way, size] => {
                let film = known(&mut self.film)?;
                misses(film, &BakeMethod::parse(way, film)?, size.parse()?)
            }
            _ => Err("no such command".into()),
        }
    }

    fn read(&mut self, folder: &Path, size: [usize; 2]) -> Answer {
        self.size = size;
        self.picture = read_floats(&folder.join("picture.f32"))?;
        self.table = read_floats(&folder.join("table.f32"))?.chunks_exact(3).map(|v| [v[0], v[1], v[2]]).collect();
        // Not 0, which the system would only promise: no run meets memory for the first time.
        self.floats = vec![1.0; self.picture.len()];
        self.bytes = vec![1; self.picture.len()];
        Ok(Vec::new())
    }

    fn build(&mut self, name: &str) -> Answer {
        let begin;
        let form = match name {
            "plain" => {
                let entries = self.table.clone();
                begin = Instant::now();
                form::plain(entries)
            }
            "structured" | "display" | "direct" => {
                let film = known(&mut self.film)?;
                begin = Instant::now();
                match name {
                    "structured" => form::structured(film, TableCoding::Density),
                    "display" => form::structured(film, TableCoding::Display),
                    _ => form::direct(film),
                }
            }
            "structured-uncoupled" | "direct-uncoupled" => {
                if self.uncoupled.is_none() {
                    self.uncoupled = Some(form::uncoupled_film()?);
                }
                let film = self.uncoupled.as_ref().ok_or("no film")?;
                begin = Instant::now();
                match name {
                    "structured-uncoupled" => form::structured(film, TableCoding::Density),
                    _ => form::direct(film),
                }
            }
            _ => {
                let expected = "plain, structured, display or direct, or structured-uncoupled or direct-uncoupled";
                return Err(format!("found form {name}, expected {expected}").into());
            }
        }?;
        let time = begin.elapsed().as_nanos() as f64;
        self.forms.insert(name.to_owned(), form);
        Ok(vec![time])
    }
}

/// Writes what all programs are given.
fn make(folder: &Path, size: [usize; 2]) -> Answer {
    let lut = plain(&film(NEGATIVE)?)?;
    write_floats(&folder.join("table.f32"), lut.table().entries().flatten().collect::<Vec<_>>().iter())?;
    write_floats(&folder.join("picture.f32"), natural(size).iter())?;
    Ok(vec![PLAIN_SIZE as f64, SHAPER[0], SHAPER[1]])
}

fn apply<T: Sample>(
    (pool, level): (Option<&ThreadPool>, SimdLevel),
    form: &Form,
    from: &[f32],
    to: &mut [T],
    size: [usize; 2],
    runs: usize,
) -> Answer {
    let from = Pixels::new(from, Channels::Rgba, size)?;
    let mut to = PixelsMut::new(to, Channels::Rgba, size)?;
    times(pool, runs, || Ok(form.map_on(level, &from, &mut to)?))
}

fn copy(pool: Option<&ThreadPool>, from: &[f32], to: &mut [f32], runs: usize) -> Answer {
    times(pool, runs, || {
        let pieces = to.par_chunks_mut(COPY_BLOCK).zip(from.par_chunks(COPY_BLOCK));
        pieces.for_each(|(to, from)| to.copy_from_slice(from));
        Ok(())
    })
}

/// How far a table's nodes are from the exact film.
fn misses(film: &Reference, method: &BakeMethod, size: usize) -> Answer {
    let (table, exact) = (method.bake(film, size)?, BakeMethod::Reference.bake(film, size)?);
    let (difference, coding) = (film.difference()?, film.coding());
    let linear = |rgb: &[f32; 3]| coding.decode_rgb(rgb.map(f64::from));
    let pairs: Vec<_> = table.entries().zip(exact.entries()).collect();
    Ok(vec![pairs.par_iter().map(|(a, b)| difference.between(linear(a), linear(b))).reduce(|| 0.0, f64::max)])
}

/// The film, compiled at its first use.
fn known(film: &mut Option<Reference>) -> Result<&Reference, Box<dyn Error>> {
    if film.is_none() {
        *film = Some(onelight_benches::film(NEGATIVE)?);
    }
    film.as_ref().ok_or_else(|| "no film".into())
}

/// Nanoseconds that each of the runs took.
fn times(
    pool: Option<&ThreadPool>,
    runs: usize,
    mut work: impl FnMut() -> Result<(), Box<dyn Error>> + Send,
) -> Answer {
    let pool = pool.ok_or("name the threads first")?;
    let mut run = || -> Result<f64, String> {
        let begin = Instant::now();
        pool.install(|| work().map_err(|error| error.to_string()))?;
        Ok(begin.elapsed().as_nanos() as f64)
    };
    Ok((0..runs).map(|_| run()).collect::<Result<_, _>>()?)
}

fn read_floats(file: &Path) -> Result<Vec<f32>, Box<dyn Error>> {
    let bytes = fs::read(file).map_err(|error| format!("{}: {error}", file.display()))?;
    Ok(bytes.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect())
}

fn write_floats<'a>(file: &Path, numbers: impl Iterator<Item = &'a f32>) -> Answer {
    let bytes: Vec<u8> = numbers.flat_map(|v| v.to_le_bytes()).collect();
    fs::write(file, bytes).map_err(|error| format!("{}: {error}", file.display()))?;
    Ok(Vec::new())
}
