//! Plots of a finished or stopped run, each as SVG and PNG under `plots/`: the Mises field at the ends of stages, histories at
//! the probes, and tractions along the interfaces, or maps over those in space.
//!
//! A plot is first built as a list of shapes (`figure::Figure`). One painter writes it as SVG, another as PNG.

mod axes;
mod ball;
mod chart;
mod colour;
mod contact_map;
mod curves;
mod cycles;
mod diagram;
mod diagram_figure;
mod energy;
mod faces;
mod field;
mod figure;
mod framed_figure;
mod ground;
mod legend;
mod mesh;
mod panel;
mod paper;
mod pdf;
mod png;
mod profile;
mod rupture;
mod sheet;
mod six_digits;
mod sketch;
mod springs;
mod stretched_axis;
mod style;
mod svg;
mod title;
mod width;

pub use chart::{Chart, Measure};
pub use contact_map::ContactMap;
pub use curves::Histories;
pub use cycles::{Line, MappedQuantity, Portrait};
pub use diagram::{Diagram, FailedSetting, Scale, Series, Slope};
pub use field::VisibleMesh;
pub use ground::{Coordinates, MapQuantity};
pub use mesh::{Mark, MarkedSet, MeshPicture};
pub use panel::{EventPanel, PanelEvent};
pub use profile::Tractions;
pub use rupture::{Line as RuptureLine, Shape as RuptureShape, Surface};
pub use sheet::{
    Curves, EventFault, EventOnset, Fault, FaultCycles, FigureRequest, Format, Ground, Mises, Plot, Points,
    Sheet, SheetError, Still, Stills, Velocities,
};
pub use six_digits::short;
pub use sketch::Sketch;
pub use springs::curves as springs_curves;
pub use style::STYLES;

use crate::bodies::Recorder;
use crate::bodies::view::MeshView;
use crate::names::stems;
use crate::{OutputError, atomic};
use contact_map::FlatSurface;
use figure::Figure;
use paper::Paper;
use std::path::{Path, PathBuf};

/// Draws all plots of a run of bodies into `folder` and returns the files in the order written. Mises fields are drawn only if the
/// recorder has kept the bodies ([`Recorder::with_bodies`]). Stages that a stopped run did not reach are omitted.
///
/// # Errors
/// If a file cannot be written or a drawing fails.
pub fn draw_all(folder: &Path, recorder: &Recorder) -> Result<Vec<PathBuf>, OutputError> {
    sheet(recorder).draw(folder, folder, &FigureRequest::default())
}

/// Draws curves of two quantities against each other into `folder` and returns the files in the order written.
///
/// # Errors
/// See [`draw_all`].
pub fn draw_charts(folder: &Path, charts: &[Chart]) -> Result<Vec<PathBuf>, OutputError> {
    write_all(
        folder,
        charts.iter().filter_map(|c| Some((c.file.clone(), c.figure(Paper::default(), 0.0)?))).collect(),
    )
}

/// The Mises field at the end of a stage as SVG, smaller than the plots of a run: for a page beside other figures. None where
/// the recorder kept no bodies of this stage.
#[must_use]
pub fn field(recorder: &Recorder, stage: &str) -> Option<String> {
    let setup = recorder.setup();
    let end = recorder.stage_ends().iter().find(|end| end.name == stage)?;
    let bodies = end.bodies.as_ref()?;
    let (seen, nodes) = VisibleMesh::from_mesh(&setup.mesh, &bodies.displacement)?;
    let values: Vec<f64> = nodes.iter().map(|&node| bodies.node_mises[node]).collect();
    Some(svg::paint(&field::mises(None, &seen, &values, field::SMALL)?))
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
        let drawn = png::paint(&figure, PIXELS);
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
        let bytes =
            png::paint(&figure, PIXELS).map_err(|reason| OutputError::Draw { path: png.clone(), reason })?;
        atomic::write(&png, &bytes)?;
        written.extend([svg, png]);
    }
    Ok(written)
}

/// Pixels per unit of figures that no resolution was asked for.
const PIXELS: f64 = 2.0;

/// Data that the figures of a run of bodies need.
#[must_use]
pub fn sheet(recorder: &Recorder) -> Sheet {
    let setup = recorder.setup();
    let span = [0.0, recorder.times().last().copied().unwrap_or(0.0)];
    let mut sheet = Sheet::new(&setup.title, span, false);
    let stage_names = stems(setup.stages.iter().map(|(name, _)| name.as_str()));
    for end in recorder.stage_ends() {
        let seen = end
            .bodies
            .as_ref()
            .and_then(|b| Some((b, VisibleMesh::from_mesh(&setup.mesh, &b.displacement)?)));
        if let (Some((bodies, (seen, nodes))), Some(stage)) = (seen, stage_names.get(end.stage)) {
            let mesh = sheet.mesh(seen);
            sheet.plots.push(Plot::Mises(Mises {
                file: format!("mises_{}_{stage}", end.stage + 1),
                stage: end.name.clone(),
                time: end.time,
                stopped: setup.stages.get(end.stage).is_some_and(|stage| end.time < stage.1),
                mesh,
                values: nodes.iter().map(|&node| short(bodies.node_mises[node])).collect(),
            }));
        }
    }
    let names = stems(setup.interfaces.iter().map(|mesh| mesh.name.as_str()));
    for (i, (stem, mesh)) in names.iter().zip(&setup.interfaces).enumerate() {
        sheet.plots.extend(Histories::from_recorder(recorder, stem, i).map(Plot::Histories));
        if mesh.in_space {
            maps(&mut sheet, recorder, stem, i);
        } else {
            let tractions = Tractions::from_ends(&setup.title, stem, mesh, i, recorder.stage_ends());
            sheet.plots.extend(tractions.map(Plot::Tractions));
        }
    }
    sheet.plots.extend(energy::budget(recorder).map(Plot::Curves));
    sheet.plots.push(Plot::Curves(springs::friction(recorder)));
    sheet
}

/// Adds the maps over an interface in space, of this number, at the ends of stages.
fn maps(sheet: &mut Sheet, recorder: &Recorder, stem: &str, number: usize) {
    let setup = recorder.setup();
    let Some(interface) = setup.interfaces.get(number) else { return };
    let Some(surface) = FlatSurface::from_interface(interface) else { return };
    let mesh = sheet.mesh(surface.mesh.clone());
    let stages = stems(setup.stages.iter().map(|(name, _)| name.as_str()));
    for end in recorder.stage_ends() {
        let Some(((_, time), stage)) = setup.stages.get(end.stage).zip(stages.get(end.stage)) else {
            continue;
        };
        let file = format!("{stem}_map_{}_{stage}", end.stage + 1);
        let map = ContactMap::new(file, &interface.name, end, number, (&surface, mesh), end.time < *time);
        sheet.plots.extend(map.map(Plot::Contact));
    }
}
