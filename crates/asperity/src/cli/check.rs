//! `asperity check`: the plan of a scene and its checks.

use super::arguments::Checking;
use super::end::End;
use super::read::{Ready, RunPlan, Source};
use super::{json, lines, print};
use asperity_output::figures::{MeshPicture, draw_mesh};
use asperity_output::terminal::printing::{err, out};
use asperity_plan::shared::checks::Checks;
use asperity_plan::shared::setup::Setups;
use asperity_run::Warning;
use asperity_run::report::Kind;
use miette::{IntoDiagnostic, miette};
use serde::Serialize;
use std::path::Path;

/// Checks as printed by `--json`, in SI units.
#[derive(Serialize)]
struct CheckReport<'a> {
    /// Kind of run.
    kind: Kind,
    /// SHA-256 of the scene file.
    scene_sha256: &'a str,
    /// Version of the program.
    version: &'static str,
    /// Extents, counts of points and lengths of friction.
    checks: &'a Checks,
    /// Notes.
    notes: Vec<String>,
    /// Warnings.
    warnings: &'a [Warning],
}

/// Plans a scene and prints the plan with its checks.
///
/// # Errors
/// Diagnostics that point into the scene.
pub(super) fn execute(asked: &Checking) -> miette::Result<End> {
    if let Some(file) = &asked.plot {
        admit(file)?;
    }
    let source = Source::read(&asked.scene, &asked.set.values)?;
    let picture = if asked.plot.is_some() { source.picture()? } else { None };
    let ready = source.plan(&Setups::none())?;
    if asked.json {
        // Text would not be JSON.
        print_json(&ready)?
    } else {
        lines::settings(&asked.set);
        print::plan(&ready.plan)
    }
    if let Some(file) = &asked.plot {
        draw(file, picture, &ready)?;
    }
    let warned = ready.plan.warnings().len();
    Ok(if asked.strict && warned > 0 { End::Doubtful(warned) } else { End::Done })
}

/// Refuses a file of another kind before anything is planned.
fn admit(file: &Path) -> miette::Result<()> {
    let known = file.extension().is_some_and(|e| e == "png" || e == "svg");
    if known { Ok(()) } else { Err(miette!("--plot {}: the name ends in .png or .svg", file.display())) }
}

/// Draws the mesh, with the stations that the plan has found.
fn draw(file: &Path, picture: Option<MeshPicture>, ready: &Ready) -> miette::Result<()> {
    let Some(mut picture) = picture else {
        return Err(miette!("--plot: spring-sliders have no mesh to draw"));
    };
    let plan = &ready.plan;
    picture.stations = plan.checks().faults.iter().flat_map(|f| &f.stations).map(|s| s.at).collect();
    if let RunPlan::Faults(plan) = plan
        && picture.faces.is_empty()
    {
        picture.points = plan.points.iter().map(|p| p.at).collect();
    }
    if !draw_mesh(file, &picture).into_diagnostic()? {
        return Err(miette!("--plot: there is nothing to draw"));
    }
    err(format_args!("drawn in {}\n", file.display()));
    Ok(())
}

fn print_json(ready: &Ready) -> miette::Result<()> {
    let plan = &ready.plan;
    let checked = CheckReport {
        kind: plan.kind(),
        scene_sha256: &ready.hash,
        version: env!("CARGO_PKG_VERSION"),
        checks: plan.checks(),
        notes: plan.notes(),
        warnings: plan.warnings(),
    };
    out(format_args!("{}\n", json::pretty(&checked).into_diagnostic()?));
    Ok(())
}
