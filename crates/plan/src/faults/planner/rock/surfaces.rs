//! Faults in space, divided into rectangles and triangles.

use super::rectangles::FirstNumbers;
use super::tiling::Tiling;
use super::{rectangles, triangles};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Scene;
use crate::shared::entry::Entry;
use asperity_cycles::kernel::Space;
use asperity_cycles::medium::patches::Patches;

/// Cells of all faults.
///
/// # Errors
/// [`Diagnostic`] at a fault that cannot be divided, or that leaves the rock.
pub(super) fn tiling<const D: usize>(scene: &Scene, space: Space) -> Result<Tiling<D>, Diagnostic> {
    let (mut tiles, mut grids) = (Vec::new(), Vec::new());
    let (mut faults, mut notes) = (Vec::new(), Vec::new());
    for (name, spec) in &scene.faults {
        if let Some(rectangle) = &spec.rectangle {
            let first = FirstNumbers { cell: tiles.len(), grid: grids.len() };
            let found = rectangles::cells(Entry::new(name, spec), rectangle, space, first)?;
            tiles.extend(found.tiles);
            grids.push(found.grid);
            faults.push(found.cut);
            notes.push(found.note);
        }
        if let Some(surface) = &spec.triangles {
            let found = triangles::cells(scene, Entry::new(name, spec), surface, space, tiles.len())?;
            tiles.extend(found.tiles);
            faults.push(found.cut);
            notes.extend(found.notes);
        }
    }
    Ok(Tiling { patches: Patches::Space { tiles, grids }, faults, notes })
}
