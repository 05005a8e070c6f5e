//! Plots of a finished (or stopped) run, each as SVG and PNG under `plots/`: the Mises field at stage ends, histories at
//! the probes, tractions along the interfaces.
//!
//! A plot is first a list of shapes (`figure::Figure`); one painter writes it as SVG, another as PNG.

mod axes;
mod chart;
mod colour;
mod curves;
mod cycles;
mod faces;
mod field;
mod figure;
mod png;
mod profile;
mod svg;
mod title;
mod units;

pub use chart::{Chart, Measure};
pub use cycles::{Cycles, Line, Rows, Table};

use super::files::stems;
use super::{ObserveError, Recorder, atomic};
use figure::Figure;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Draws all plots of a run into `folder` and returns the files, in the order written. The recorder must have kept
/// the bodies ([`Recorder::with_bodies`]) for the Mises fields to be drawn; what a stopped run did not reach is left out.
///
/// # Errors
/// When a file cannot be written or a drawing fails.
pub fn draw_all(folder: &Path, recorder: &Recorder) -> Result<Vec<PathBuf>, ObserveError> {
    write_all(folder, figures(recorder))
}

/// Draws the plots of faults through cycles into `folder` and returns the files, in the order written.
///
/// # Errors
/// See [`draw_all`].
pub fn draw_cycles(folder: &Path, cycles: &Cycles) -> Result<Vec<PathBuf>, ObserveError> {
    write_all(folder, cycles.figures()?)
}

/// Draws curves of two quantities against each other into `folder` and returns the files, in the order written.
///
/// # Errors
/// See [`draw_all`].
pub fn draw_charts(folder: &Path, charts: &[Chart]) -> Result<Vec<PathBuf>, ObserveError> {
    write_all(folder, charts.iter().filter_map(|c| Some((c.file.clone(), c.figure()?))).collect())
}

fn write_all(folder: &Path, figures: Vec<(String, Figure)>) -> Result<Vec<PathBuf>, ObserveError> {
    atomic::create_dir(folder)?;
    let mut written = Vec::new();
    for (name, figure) in figures {
        let (svg, png) = (folder.join(format!("{name}.svg")), folder.join(format!("{name}.png")));
        atomic::write(&svg, svg::paint(&figure).as_bytes())?;
        let bytes = png::paint(&figure).map_err(|reason| ObserveError::Draw { path: png.clone(), reason })?;
        atomic::write(&png, &bytes)?;
        written.extend([svg, png]);
    }
    Ok(written)
}

/// All figures of a run with the names of their files.
fn figures(recorder: &Recorder) -> Vec<(String, Figure)> {
    let setup = recorder.setup();
    let mut figures = Vec::new();
    let stage_names = stems(setup.stages.iter().map(|(name, _)| name.as_str()));
    for end in recorder.stage_ends() {
        let figure =
            end.bodies.as_ref().and_then(|fields| field::mises(&setup.title, &setup.mesh, end, fields));
        if let (Some(figure), Some(stage)) = (figure, stage_names.get(end.stage)) {
            figures.push((format!("mises_{}_{stage}", end.stage + 1), figure));
        }
    }
    let names = stems(setup.interfaces.iter().map(|mesh| mesh.name.as_str()));
    for (i, (stem, mesh)) in names.iter().zip(&setup.interfaces).enumerate() {
        for quantity in curves::QUANTITIES {
            if let Some(figure) = curves::history(recorder, i, &quantity) {
                figures.push((format!("{stem}_{}", quantity.file), figure));
            }
        }
        if let Some(figure) = profile::tractions(&setup.title, mesh, i, recorder.stage_ends()) {
            figures.push((format!("{stem}_tractions"), figure));
        }
    }
    figures
}

/// Labels that tell positions apart: the coordinates that differ among them, in one unit.
pub(super) fn position_labels(positions: impl Iterator<Item = [f64; 3]>) -> Vec<String> {
    let positions: Vec<[f64; 3]> = positions.collect();
    let bounds = |axis: usize| {
        let values = positions.iter().map(|p| p[axis]);
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), x| (lo.min(x), hi.max(x)))
    };
    let largest = positions.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
    let mut axes: Vec<usize> = (0..3)
        .filter(|&axis| {
            let (lo, hi) = bounds(axis);
            hi - lo > SAME_PLACE * largest
        })
        .collect();
    if axes.is_empty() {
        axes = vec![0, 1];
    }
    let unit = units::LENGTH.of(largest);
    let label = |p: &[f64; 3], digits: i32| {
        // Rounds to this many digits of the largest coordinate.
        let fine = 10.0_f64.powi(digits - 1 - (largest / unit.factor).max(1.0).log10() as i32);
        let parts = axes.iter().map(|&axis| {
            let value = (p[axis] / unit.factor * fine).round() / fine + 0.0;
            format!("{} = {value}", ["x", "y", "z"][axis])
        });
        format!("{} {}", parts.collect::<Vec<_>>().join("; "), unit.name)
    };
    let labels = |digits: i32| positions.iter().map(|p| label(p, digits)).collect::<Vec<_>>();
    let different = |labels: &[String]| labels.iter().collect::<BTreeSet<_>>().len() == labels.len();
    // Four digits read well; positions that need more get them.
    (4..9).map(labels).find(|labels| different(labels)).unwrap_or_else(|| labels(9))
}

/// Coordinates closer than this fraction of the largest one count as equal: generated meshes place nodes to rounding.
const SAME_PLACE: f64 = 1e-9;
