//! Plots of a finished or stopped run, each as SVG and PNG under `plots/`: the Mises field at the ends of stages, histories at
//! the probes, and tractions along the interfaces.
//!
//! A plot is first built as a list of shapes (`figure::Figure`). One painter writes it as SVG, another as PNG.

mod axes;
mod ball;
mod chart;
mod colour;
mod curves;
mod cycles;
mod diagram;
mod drawn;
mod energy;
mod faces;
mod field;
mod figure;
mod ground;
pub(crate) mod labels;
mod mesh;
mod panel;
mod png;
mod profile;
mod rupture;
mod sketch;
mod springs;
mod stretched;
mod style;
mod svg;
mod title;
mod units;
mod width;

pub use chart::{Chart, Measure};
pub use cycles::{Cycles, Line, Rows, Table};
pub use diagram::{Diagram, Failed, Scale, Series, Slope};
pub use ground::{Coordinates, GroundMap};
pub use mesh::{Mark, MarkedSet, MeshPicture};
pub use panel::{EventPanel, PanelEvent};
pub use rupture::{
    EventOnFault, Line as RuptureLine, Profiles, RupturedFault, Ruptures, Shape as RuptureShape, Surface,
};
pub use sketch::Sketch;
pub use springs::chart as springs_chart;
pub use style::STYLES;

use super::view::MeshView;
use super::{OutputError, Recorder, atomic};
use crate::names::stems;
use figure::Figure;
use std::path::{Path, PathBuf};

/// Draws all plots of a run into `folder` and returns the files in the order written. Mises fields are drawn only if the recorder
/// has kept the bodies ([`Recorder::with_bodies`]). Stages that a stopped run did not reach are omitted.
///
/// # Errors
/// If a file cannot be written or a drawing fails.
pub fn draw_all(folder: &Path, recorder: &Recorder) -> Result<Vec<PathBuf>, OutputError> {
    write_all(folder, figures(recorder))
}

/// Draws the plots of faults in earthquake cycles into `folder` and returns the files in the order written.
///
/// # Errors
/// See [`draw_all`].
pub fn draw_cycles(folder: &Path, cycles: &Cycles) -> Result<Vec<PathBuf>, OutputError> {
    write_all(folder, cycles.figures()?)
}

/// Draws the plots of dynamic rupture into `folder` and returns the files in the order written.
///
/// # Errors
/// See [`draw_all`].
pub fn draw_ruptures(folder: &Path, ruptures: &Ruptures<'_>) -> Result<Vec<PathBuf>, OutputError> {
    write_all(folder, ruptures.figures()?)
}

/// Draws maps of the displacement of the ground into `folder` and returns the files in the order written.
///
/// # Errors
/// See [`draw_all`].
pub fn draw_ground(folder: &Path, maps: &[GroundMap]) -> Result<Vec<PathBuf>, OutputError> {
    write_all(folder, maps.iter().filter_map(|map| Some((map.file.clone(), map.figure()?))).collect())
}

/// Draws rupture times and slip of events into `folder` and returns the files in the order written.
///
/// # Errors
/// See [`draw_all`].
pub fn draw_events(folder: &Path, events: &[EventOnFault]) -> Result<Vec<PathBuf>, OutputError> {
    write_all(folder, events.iter().flat_map(EventOnFault::figures).collect())
}

/// Draws the magnitudes of events over time into `folder` and returns the files in the order written.
///
/// # Errors
/// See [`draw_all`].
pub fn draw_panel(folder: &Path, panel: &EventPanel) -> Result<Vec<PathBuf>, OutputError> {
    write_all(folder, panel.figure().map(|figure| ("events".to_string(), figure)).into_iter().collect())
}

/// Draws the magnitudes of velocities of the nodes of a mesh, each with its time \[s\] \[m/s\], and a strip of them, into `folder`; returns
/// the files in the order written.
///
/// # Errors
/// See [`draw_all`].
pub fn draw_velocities(
    folder: &Path,
    scene: &str,
    mesh: &MeshView,
    frames: &[(f64, Vec<f64>)],
) -> Result<Vec<PathBuf>, OutputError> {
    let last = frames.last().map_or(1.0, |frame| frame.0);
    let one = |(k, (time, values)): (usize, &(f64, Vec<f64>))| {
        let when = format!("t = {}", rupture::moment(*time, last));
        Some((format!("velocity_{k}"), field::velocity(scene, &when, mesh, values, field::LARGE)?))
    };
    let mut figures: Vec<(String, Figure)> = frames.iter().enumerate().filter_map(one).collect();
    let strip = field::Shown::new(mesh).and_then(|shown| rupture::velocities(scene, &shown, frames));
    figures.extend(strip.map(|figure| ("velocity_film".to_string(), figure)));
    write_all(folder, figures)
}

/// Draws curves of two quantities against each other into `folder` and returns the files in the order written.
///
/// # Errors
/// See [`draw_all`].
pub fn draw_charts(folder: &Path, charts: &[Chart]) -> Result<Vec<PathBuf>, OutputError> {
    write_all(folder, charts.iter().filter_map(|c| Some((c.file.clone(), c.figure()?))).collect())
}

/// The Mises field at the end of a stage as SVG, smaller than the plots of a run: for a page beside other figures. None where
/// the recorder kept no bodies of this stage.
#[must_use]
pub fn field(recorder: &Recorder, stage: &str) -> Option<String> {
    let setup = recorder.setup();
    let end = recorder.stage_ends().iter().find(|end| end.name == stage)?;
    let figure = field::mises("", &setup.mesh, end, end.bodies.as_ref()?, field::SMALL)?;
    Some(svg::paint(&figure))
}

/// The magnitude of displacements \[m\] over a mesh as SVG, of the size of [`field`]. None where there is no face to draw.
#[must_use]
pub fn displacement(mesh: &MeshView, displacement: &[[f64; 3]]) -> Option<String> {
    Some(svg::paint(&field::displacement(mesh, displacement, field::SMALL)?))
}

/// Draws a mesh into a file, as SVG if its name ends so and otherwise as PNG; false if there is nothing to draw.
///
/// # Errors
/// See [`draw_all`].
pub fn draw_mesh(file: &Path, picture: &MeshPicture) -> Result<bool, OutputError> {
    let Some(figure) = picture.figure() else { return Ok(false) };
    if file.extension().is_some_and(|e| e == "svg") {
        atomic::write(file, svg::paint(&figure).as_bytes())?;
    } else {
        let drawn = png::paint(&figure);
        let bytes = drawn.map_err(|reason| OutputError::Draw { path: file.to_path_buf(), reason })?;
        atomic::write(file, &bytes)?;
    }
    Ok(true)
}

fn write_all(folder: &Path, figures: Vec<(String, Figure)>) -> Result<Vec<PathBuf>, OutputError> {
    atomic::create_dir(folder)?;
    let mut written = Vec::new();
    for (name, figure) in figures {
        let (svg, png) = (folder.join(format!("{name}.svg")), folder.join(format!("{name}.png")));
        atomic::write(&svg, svg::paint(&figure).as_bytes())?;
        let bytes = png::paint(&figure).map_err(|reason| OutputError::Draw { path: png.clone(), reason })?;
        atomic::write(&png, &bytes)?;
        written.extend([svg, png]);
    }
    Ok(written)
}

/// All figures of a run with their file names.
fn figures(recorder: &Recorder) -> Vec<(String, Figure)> {
    let setup = recorder.setup();
    let mut figures = Vec::new();
    let stage_names = stems(setup.stages.iter().map(|(name, _)| name.as_str()));
    for end in recorder.stage_ends() {
        let figure = end
            .bodies
            .as_ref()
            .and_then(|fields| field::mises(&setup.title, &setup.mesh, end, fields, field::LARGE));
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
    figures.extend(energy::budget(recorder));
    figures.extend(springs::friction(recorder).map(|figure| ("springs_friction".to_string(), figure)));
    figures
}
