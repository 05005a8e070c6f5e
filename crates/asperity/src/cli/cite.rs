//! The command `cite`.

use super::end::End;
use super::read::Source;
use asperity_output::terminal::printing;
use asperity_plan::reading::scene::suggestions::nearest;
use asperity_reference::benchmark;
use asperity_reference::cite::{self, Citations};
use miette::miette;
use std::path::Path;

/// Prints what to cite for a scene file, a case or a benchmark.
pub(super) fn print(of: Option<&str>) -> miette::Result<End> {
    let citations = match of {
        None => Citations::default(),
        Some(name) if Path::new(name).is_file() => Source::read(Path::new(name), &[])?.citations()?,
        Some(name) => {
            let known = Citations::from_case(name).or_else(|| Citations::from_benchmark(name));
            known.ok_or_else(|| unknown(name))?
        }
    };
    printing::out(format_args!("{}", citations.bibtex()));
    Ok(End::Done)
}

fn unknown(name: &str) -> miette::Report {
    let names = cite::names().chain(benchmark::all().iter().map(|r| r.benchmark.as_str()));
    let meant = nearest(name, names).map_or(String::new(), |near| format!("; did you mean `{near}`?"));
    miette!("there is no scene file, verification case or benchmark `{name}`{meant}")
}
