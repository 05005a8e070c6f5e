//! The command `compare`.

use super::end::End;
use crate::benchmark::{self, Judgement, Reference, Submission, overlay};
use crate::scene::near::suggest;
use asperity_output::{plots, printing};
use clap::Args;
use miette::IntoDiagnostic;
use std::path::{Path, PathBuf};

/// Result and benchmark.
#[derive(Clone, Debug, Args)]
pub struct Comparison {
    /// Table of results (CSV).
    #[arg(required_unless_present_any = ["list", "template"])]
    result: Option<PathBuf>,
    /// Name of the benchmark, such as `sandwich/v1`.
    #[arg(long, value_name = "NAME", required_unless_present = "list")]
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

/// Names and titles of the benchmarks.
fn list() {
    let width = benchmark::all().iter().map(|r| r.benchmark.len()).max().unwrap_or(0);
    for reference in benchmark::all() {
        printing::out(format_args!("{:width$}  {}\n", reference.benchmark, reference.title));
    }
}

fn judge(asked: &Comparison, reference: &'static Reference, path: &Path) -> miette::Result<End> {
    let bytes = match std::fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) => return Ok(End::Unreadable(format!("cannot read {}: {error}", path.display()))),
    };
    let result = match Submission::read(&bytes, reference) {
        Ok(result) => result,
        Err(defect) => return Ok(End::Unreadable(format!("{}:{defect}", path.display()))),
    };
    let judgement = Judgement::of(reference, &result);
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
    plots::draw_charts(&folder, &charts).into_diagnostic()?;
    printing::out(format_args!("plots in {}\n", folder.display()));
    Ok(())
}
