//! Pictures that cases draw of their own bodies and runs, by the product's plots.

use super::programs;
use super::run_files::Folder;
use crate::{CaseError, Ledger};
use asperity::kinds;
use asperity_fem::mesh::Mesh;
use asperity_output::bodies::Recorder;
use asperity_output::bodies::view::MeshView;
use asperity_output::fields::vtu::Cell;
use asperity_output::figures;
use asperity_plan::bodies;
use asperity_plan::reading::scene::model::Scene;
use std::path::Path;

/// Every so many of these points that single markers can be distinguished.
pub fn apart(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    const MARKERS: usize = 30;
    points.iter().step_by(points.len().div_ceil(MARKERS).max(1)).copied().collect()
}

/// Draws the magnitude of nodal displacements \[m\] of a body built without a scene. A `moved` body is drawn in its current
/// configuration.
///
/// # Errors
/// If there is nothing to draw.
pub fn displacement<const D: usize>(
    ledger: &mut Ledger,
    title: &str,
    mesh: &Mesh<D>,
    u: &[f64],
    moved: bool,
) -> Result<(), CaseError> {
    let mut cells = Vec::new();
    for block in &mesh.blocks {
        let nodes = block.connectivity.chunks_exact(block.kind.nodes());
        cells.extend(nodes.map(|cell| Cell::new(block.kind.vtk_type(), cell.to_vec())));
    }
    let view = MeshView {
        nodes: mesh.nodes.iter().map(|x| std::array::from_fn(|c| x.get(c).copied().unwrap_or(0.0))).collect(),
        cell_body: vec![0; cells.len()],
        cells,
        bodies: vec!["body".into()],
        dimension: D,
        moves: moved,
    };
    let components = u.len() / mesh.nodes.len();
    // The only component of antiplane motion is that along z.
    let first = if components == 1 { 2 } else { 0 };
    let vector =
        |u: &[f64]| std::array::from_fn(|c| c.checked_sub(first).and_then(|c| u.get(c)).map_or(0.0, |u| *u));
    let vectors: Vec<[f64; 3]> = u.chunks_exact(components).map(vector).collect();
    let svg = figures::displacement(&view, &vectors).ok_or("the body has no face to draw")?;
    let caption =
        if moved { "Current configuration, computed by the case." } else { "Computed by the case." };
    ledger.picture(title, svg, caption);
    Ok(())
}

/// The Mises stress at the end of a stage as SVG; of the first stage if it has no name.
///
/// # Errors
/// If the scene is refused, the stage is not reached, or the scene has no bodies.
pub fn mises(scene: &Scene, stage: &str) -> Result<String, CaseError> {
    let plan = bodies::plan(scene).map_err(|error| error.to_string())?;
    let mut record = Recorder::new().with_bodies();
    kinds::bodies::run(&plan, &mut record)?;
    recorded(&record, stage)
}

/// The Mises stress of a run that kept its bodies, at the end of a stage, as SVG; of the first stage if it has no name.
///
/// # Errors
/// If the stage was not reached or no bodies were kept.
pub fn recorded(record: &Recorder, stage: &str) -> Result<String, CaseError> {
    let named = record.stage_ends().iter().find(|end| stage.is_empty() || end.name == stage);
    let stage = &named.ok_or("the stage was not reached")?.name;
    figures::field(record, stage).ok_or_else(|| "it has no bodies".into())
}

/// Draws the Mises stress at the end of a stage of a scene.
///
/// # Errors
/// See [`mises`].
pub fn stage(ledger: &mut Ledger, title: &str, scene: &Scene, stage: &str) -> Result<(), CaseError> {
    ledger.picture(title, mises(scene, stage)?, format!("Mises stress at the end of stage “{stage}”."));
    Ok(())
}

/// Plot of a scene's file that a run of the program writes, as SVG.
///
/// # Errors
/// If the run fails or writes no such plot.
pub fn plot_of(file: &Path, plot: &str) -> Result<String, CaseError> {
    let folder = Folder::new()?;
    let mut command = programs::asperity(&[])?;
    command.arg("run").arg(file).arg("--out").arg(folder.path().join("out"));
    programs::finished(&mut command, &[0])?;
    Ok(std::fs::read_to_string(folder.path().join("out/plots").join(plot).with_extension("svg"))?)
}

/// Draws a plot that a run of the program writes for the text of a scene.
///
/// # Errors
/// See [`plot_of`].
pub fn plot(
    ledger: &mut Ledger,
    title: &str,
    text: &str,
    plot: &str,
    caption: &str,
) -> Result<(), CaseError> {
    let folder = Folder::new()?;
    let file = folder.path().join("scene.toml");
    std::fs::write(&file, text)?;
    ledger.picture(title, plot_of(&file, plot)?, caption);
    Ok(())
}
