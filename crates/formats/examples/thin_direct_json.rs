//! Makes a smaller `look.direct.json`: of each curve every third point stays, which are read linearly. The look in
//! `fixtures/direct` was made by it. `cargo run -p onelight-formats --example thin_direct_json -- FROM TO COMMENT...`

use std::error::Error;
use std::fs::File;
use std::process::ExitCode;

use onelight_formats::direct_json;
use onelight_lut::{Develop, DirectForm, DirectParts, DirectPrint, Lut1d};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [from, to, comments @ ..] = arguments.as_slice() else {
        eprintln!("found {} arguments, expected FROM TO COMMENT...", arguments.len());
        return ExitCode::FAILURE;
    };
    if let Err(error) = thin(from, to, comments) {
        eprintln!("{from} to {to}: {error}");
        return ExitCode::FAILURE;
    }
    ExitCode::SUCCESS
}

fn thin(from: &str, to: &str, comments: &[String]) -> Result<(), Box<dyn Error>> {
    let parts = direct_json::read(File::open(from)?)?.parts().clone();
    let print = parts.print.map(|DirectPrint { exposure, curves }| -> Result<_, Box<dyn Error>> {
        Ok(DirectPrint { exposure, curves: every_third(&curves)? })
    });
    let develop = Develop { curves: every_third(&parts.develop.curves)?, ..parts.develop };
    let form = DirectForm::new(DirectParts { develop, print: print.transpose()?, ..parts })?;
    Ok(direct_json::write(File::create(to)?, &form, comments)?)
}

fn every_third(curves: &Lut1d) -> Result<Lut1d, Box<dyn Error>> {
    if curves.size() % 3 != 1 {
        return Err(format!("points of a curve: found {}, expected a multiple of 3 and one more", curves.size()).into());
    }
    Ok(Lut1d::new(*curves.domain(), curves.entries().iter().step_by(3).copied().collect())?)
}
