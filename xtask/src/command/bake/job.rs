//! The tables that a bake makes.

use anyhow::{Context, Result, bail};
use onelight::baked::{Baked, EntryRange, FileFormat, Form, Recipe, ShaperChoice, Target, smallest_under};
use onelight::{Look, Nodes, TableCoding, TransferCurve, Word as _};

use super::arguments::Arguments;
use crate::progress::bar;

/// One table or form with its files.
pub(super) struct Job {
    pub(super) recipe: Recipe,
    pub(super) formats: Vec<FileFormat>,
    /// The display coding, where it is not the look's own.
    pub(super) coding: Option<TransferCurve>,
    /// Programs that load the files, each with the way to do it.
    pub(super) loads: Vec<(Target, &'static str)>,
}

/// The tables that the arguments ask for, at least one.
pub(super) fn jobs(arguments: &Arguments, film: &Look) -> Result<Vec<Job>> {
    let is_print = matches!(film, Look::Print(_));
    if !arguments.targets.is_empty() {
        return if is_print { for_resolve_alone(arguments) } else { for_programs(arguments) };
    }
    if is_print && !arguments.scene.is_empty() {
        bail!("--scene takes light, which --camera none does not print: it changes nothing, expected it left out");
    }
    let usual = if is_print { ShaperChoice::Cineon } else { ShaperChoice::Log2 };
    arguments.refuse_idle_options(usual)?;
    let job = |recipe: Recipe, formats| Job { recipe, formats, coding: None, loads: Vec::new() };
    if arguments.leaves_the_table_open() {
        let usual = if is_print { vec![usual] } else { vec![usual, ShaperChoice::Srgb] };
        let sized = usual.into_iter().map(Recipe::taking).map(|recipe| Recipe {
            size: arguments.size.map_or(recipe.size, usize::from),
            storage: arguments.storage.unwrap_or(recipe.storage),
            ..recipe
        });
        return Ok(sized.map(|recipe| job(recipe, vec![FileFormat::Cube])).collect());
    }
    let recipe = recipe(arguments, film)?;
    let mut job = job(recipe, formats(arguments, &recipe)?);
    if recipe.shaper == ShaperChoice::Bevy {
        job.coding = Some(TransferCurve::Linear);
    }
    Ok(vec![job])
}

/// The table of a scan's print for the one program that has a use for it.
fn for_resolve_alone(arguments: &Arguments) -> Result<Vec<Job>> {
    if arguments.programs() != [Target::Resolve]
        || arguments.shaper.is_some_and(|shaper| shaper != ShaperChoice::Cineon)
    {
        bail!("--for bakes for a scene's light, but for resolve: expected --for resolve, or none, with --camera none");
    }
    let coding = Target::Resolve.usual_coding().filter(|_| !arguments.look.names_output_coding());
    let load = "a LUT on a node whose picture is Cineon Film Log, as a scan is or a Color Space Transform makes it";
    Ok(vec![Job {
        recipe: Recipe::taking(ShaperChoice::Cineon),
        formats: vec![FileFormat::Cube],
        coding,
        loads: vec![(Target::Resolve, load)],
    }])
}

/// The tables that programs load, each once.
fn for_programs(arguments: &Arguments) -> Result<Vec<Job>> {
    let mut jobs: Vec<Job> = Vec::new();
    let programs = arguments.programs();
    if let Some(shaper) = arguments.shaper
        && (programs != [Target::Camera] || !shaper.is_coding())
    {
        bail!(
            "--shaper {} beside --for changes nothing, expected a coding with --for camera, or --shaper without --for",
            shaper.word()
        );
    }
    for target in programs {
        for mut table in target.tables() {
            table.recipe.shaper = arguments.shaper.unwrap_or(table.recipe.shaper);
            // Who takes light takes it whatever the display is.
            let named = arguments.look.names_output_coding();
            let coding = target.usual_coding().filter(|coding| *coding == TransferCurve::Linear || !named);
            let same = |job: &&mut Job| job.recipe == table.recipe && job.coding == coding;
            match jobs.iter_mut().find(same) {
                Some(job) => {
                    if !job.formats.contains(&table.format) {
                        job.formats.push(table.format);
                    }
                    job.loads.push((target, table.load));
                }
                None => jobs.push(Job {
                    recipe: table.recipe,
                    formats: vec![table.format],
                    coding,
                    loads: vec![(target, table.load)],
                }),
            }
        }
    }
    Ok(jobs)
}

fn recipe(arguments: &Arguments, film: &Look) -> Result<Recipe> {
    let form = arguments.form.unwrap_or_default();
    match arguments.max_de {
        Some(limit) if form == Form::Direct => {
            return Ok(Recipe { nodes: Nodes::UnderMaxDe(limit), ..Recipe::of(form) });
        }
        Some(limit) => {
            let progress = bar("choosing", 0);
            let found = smallest_under(film, limit, |tried, all| {
                progress.set_length(all as u64);
                progress.set_position(tried as u64);
            });
            progress.finish_and_clear();
            return found.with_context(|| format!("--max-de {limit}"));
        }
        None => {}
    }
    let coding = if film.coding().curve.is_hdr() { TableCoding::Display } else { TableCoding::Density };
    let usual = match (arguments.shaper, film) {
        (Some(shaper), _) => Recipe::taking(shaper),
        (None, Look::Print(_)) if form == Form::Plain => Recipe::taking(ShaperChoice::Cineon),
        (None, _) => Recipe::of(form),
    };
    // The size that a format's programs expect, where it is the only one.
    let expected = match arguments.format.as_slice() {
        [format] => format.usual_size(),
        _ => None,
    };
    Ok(Recipe {
        size: arguments.size.map_or_else(|| expected.unwrap_or(usual.size), usize::from),
        stops: arguments.stops,
        entries: arguments.entries.unwrap_or(usual.entries),
        storage: arguments.storage.unwrap_or(usual.storage),
        range: if arguments.unclamped { EntryRange::Any } else { EntryRange::Unit },
        coding: arguments.coding.unwrap_or(coding),
        nodes: arguments.nodes.unwrap_or(usual.nodes),
        ..usual
    })
}

fn formats(arguments: &Arguments, recipe: &Recipe) -> Result<Vec<FileFormat>> {
    let form = recipe.form;
    let mut formats = arguments.format.clone();
    if formats.is_empty() {
        formats.push(FileFormat::usual(form));
    }
    formats.dedup();
    if let Some(format) = formats.iter().find(|format| !format.holds(form)) {
        let other = if format.holds(Form::Direct) { Form::Direct } else { Form::Plain };
        bail!(
            "--format {} cannot hold the {} form, expected {}, or --form {}",
            format.word(),
            form.word(),
            FileFormat::usual(form).word(),
            other.word()
        );
    }
    let coded = recipe.shaper.is_coding();
    if let Some(format) = formats.iter().find(|format| format.needs_coding() && !coded) {
        bail!(
            "--format {} holds no shaper for scene-linear light, expected a coding such as --shaper srgb",
            format.word()
        );
    }
    Ok(formats)
}

/// The table of a look, its range fitted to the colours of a scene where there are some.
pub(super) fn baked(film: &Look, recipe: &Recipe, scene: Option<&[[f64; 3]]>) -> Result<Baked> {
    Ok(scene.map_or_else(|| film.baked(recipe), |colours| film.baked_for_scene(recipe, colours))?)
}
