//! The command `compare`: a result with a benchmark or with reference values in a file, or two output directories.

use super::difference;
use super::end::End;
use asperity_output::figures;
use asperity_output::terminal::printing;
use asperity_plan::reading::scene::suggestions::suggest;
use asperity_reference::benchmark::{self, Judgement, Reference, Submission, overlay};
use clap::Args;
use miette::IntoDiagnostic;
use std::path::{Path, PathBuf};

/// Result and benchmark.
#[derive(Clone, Debug, Args)]
pub struct Comparison {
    /// Table of results (CSV) for a benchmark, or an output directory.
    #[arg(required_unless_present_any = ["list", "template"])]
    result: Option<PathBuf>,
    /// Output directory to compare with the first, or reference values (JSON) in the form of a benchmark.
    #[arg(conflicts_with_all = ["benchmark", "template", "list"])]
    other: Option<PathBuf>,
    /// Relative difference up to which two directories agree, over the largest value of a column; 1e-6 by default.
    #[arg(long, requires = "other", value_parser = tolerance)]
    tolerance: Option<f64>,
    /// Name of the benchmark, such as `sandwich/v1`.
    #[arg(long, value_name = "NAME", required_unless_present_any = ["list", "other"])]
    benchmark: Option<String>,
    /// Folder of the plots; `out/compare/<benchmark>` by default.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Draw no plots.
    #[arg(long)]
    no_plots: bool,
    /// Print an empty table of results.
    #[arg(long, conflicts_with = "result")]
    template: bool,
    /// List the benchmarks.
    #[arg(long, conflicts_with_all = ["result", "benchmark", "template"])]
    list: bool,
}

/// Judges a result, or prints what there is to judge.
pub(super) fn execute(asked: &Comparison) -> miette::Result<End> {
    if asked.list {
        list();
        return Ok(End::Done);
    }
    if let (Some(a), Some(b)) = (&asked.result, &asked.other) {
        if b.extension().is_some_and(|end| end == "json") {
            return match read(b) {
                Ok(reference) => judge(asked, reference, a),
                Err(why) => Ok(End::Unreadable(why)),
            };
        }
        return Ok(difference::directories(a, b, asked.tolerance.unwrap_or(difference::TOLERANCE)));
    }
    let name = asked.benchmark.as_deref().unwrap_or_default();
    let Some(reference) = benchmark::find(name) else {
        let known = benchmark::all().iter().map(|r| r.benchmark.as_str());
        let help = suggest(name, "benchmarks", known);
        return Ok(End::Unreadable(format!("there is no benchmark `{name}`; {help}")));
    };
    match &asked.result {
        None => {
            printing::out(format_args!("{}", reference.template()));
            Ok(End::Done)
        }
        Some(path) => judge(asked, reference, path),
    }
}

/// Parses a tolerance.
fn tolerance(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "it is a number such as 1e-6".to_string())?;
    if value >= 0.0 && value.is_finite() { Ok(value) } else { Err("it is a number from 0 on".into()) }
}

/// Names and titles of the benchmarks.
fn list() {
    let width = benchmark::all().iter().map(|r| r.benchmark.len()).max().unwrap_or(0);
    for reference in benchmark::all() {
        printing::out(format_args!("{:width$}  {}\n", reference.benchmark, reference.title));
    }
}

/// Reads reference values from a file.
fn read(path: &Path) -> Result<&'static Reference, String> {
    let name = path.display();
    let bytes = std::fs::read(path).map_err(|error| format!("cannot read {name}: {error}"))?;
    let reference: Reference = serde_json::from_slice(&bytes).map_err(|error| {
        format!("{name}: {error}; reference values have the form of a benchmark's reference.json")
    })?;
    let problems = reference.problems();
    // As those of benchmarks, they are needed to the end of the program, which this command is.
    if problems.is_empty() {
        Ok(Box::leak(Box::new(reference)))
    } else {
        Err(format!("{name}: {}", problems.join("; ")))
    }
}

fn judge(asked: &Comparison, reference: &'static Reference, path: &Path) -> miette::Result<End> {
    if path.is_dir() {
        let why = "is a directory, and a benchmark judges a table (CSV), whose form `--template` prints";
        return Ok(End::Unreadable(format!("{} {why}", path.display())));
    }
    let bytes = match std::fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) => return Ok(End::Unreadable(format!("cannot read {}: {error}", path.display()))),
    };
    let result = match Submission::read(&bytes, reference) {
        Ok(result) => result,
        Err(defect) => return Ok(End::Unreadable(format!("{}:{defect}", path.display()))),
    };
    let judgement = Judgement::new(reference, &result);
    printing::out(format_args!("{}: {}\n\n{judgement}", reference.benchmark, path.display()));
    if !asked.no_plots {
        draw(asked, reference, &result)?;
    }
    Ok(if judgement.agrees() { End::Done } else { End::Differs })
}

fn draw(asked: &Comparison, reference: &'static Reference, result: &Submission) -> miette::Result<()> {
    let charts = overlay::charts(reference, result);
    if charts.is_empty() {
        return Ok(());
    }
    let usual =
        || Path::new("out/compare").join(reference.benchmark.split('/').collect::<Vec<_>>().join("-"));
    let folder = asked.out.clone().unwrap_or_else(usual);
    figures::draw_charts(&folder, &charts).into_diagnostic()?;
    printing::out(format_args!("plots in {}\n", folder.display()));
    Ok(())
}
