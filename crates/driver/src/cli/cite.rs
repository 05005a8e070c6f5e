//! The command `cite`.

use super::end::End;
use super::read::Source;
use crate::cite::{self, Citations};
use crate::scene::near::nearest;
use asperity_output::printing;
use miette::miette;
use std::path::Path;

/// Prints what to cite for a scene file or a case.
pub(super) fn print(of: Option<&str>) -> miette::Result<End> {
    let citations = match of {
        None => Citations::default(),
        Some(name) if Path::new(name).is_file() => Source::read(Path::new(name))?.citations()?,
        Some(name) => Citations::of_case(name).ok_or_else(|| unknown(name))?,
    };
    printing::out(format_args!("{}", citations.bibtex()));
    Ok(End::Done)
}

fn unknown(name: &str) -> miette::Report {
    let meant =
        nearest(name, cite::names()).map_or(String::new(), |near| format!("; did you mean `{near}`?"));
    miette!("there is no scene file and no verification case `{name}`{meant}")
}
