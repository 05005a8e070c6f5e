//! Faults in the plane, divided into straight cells.

use super::super::bends::{self, Bend};
use super::super::place::directions;
use super::tiling::{Cut, Tiling, buried, in_dimension};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Fault as Spec, FaultLine, Scene};
use crate::shared::entry::Entry;
use crate::shared::idealisation;
use crate::shared::model::meshes;
use asperity_cycles::kernel::{Segment, Space};
use asperity_cycles::medium::patches::Patches;
use asperity_cycles::medium::{Place, unit};
use asperity_fem::mesh::fault::{Departure, DividedLine, FaultMeshError, divided};

/// Cells of all faults.
///
/// # Errors
/// [`Diagnostic`] at the line that cannot be divided, or that leaves the rock.
pub(super) fn tiling<const D: usize>(scene: &Scene, space: Space) -> Result<Tiling<D>, Diagnostic> {
    let antiplane = idealisation::from_kinematics(*scene.kinematics.get_ref()).components() == 1;
    let (mut all, mut faults, mut notes) = (Vec::new(), Vec::new(), Vec::new());
    for (name, spec) in &scene.faults {
        let Some(line) = &spec.line else { continue };
        let (cells, departure) = cells(name, line)?;
        let vertices = line.trace.get_ref().len();
        notes.extend(departure.map(|d| meshes::smooth(&format!("fault `{name}`"), vertices, d)));
        let mut segments = Vec::with_capacity(cells.len());
        for cell in &cells {
            let segment = Segment::new(space, cell.ends)
                .map_err(|e| Diagnostic::at(line.trace.span(), format!("fault `{name}`: {e}"), INSIDE))?;
            buried(space, name, [segment.middle()[1], cell.length()], line.trace.span())?;
            segments.push(segment);
        }
        let fault = Entry::new(name, spec);
        let places = cells.iter().zip(&segments).enumerate();
        let places = places.map(|(k, (cell, segment))| place(fault, all.len() + k, cell, segment));
        let sizes: Vec<f64> = cells.iter().map(Cell::length).collect();
        faults.push(Cut {
            places: places.collect::<Result<_, _>>()?,
            widths: sizes.clone(),
            sizes,
            faces: (1..cells.len()).map(|k| vec![k - 1, k]).collect(),
            outline: None,
            grid: None,
            ends: cells.iter().map(|cell| cell.ends).collect(),
        });
        if !antiplane {
            let turns = segments.windows(2).zip(&cells).map(|(w, cell)| Bend {
                normals: [&w[0], &w[1]].map(|s| in_dimension(&s.normal())),
                at: cell.ends[0],
            });
            notes.extend(bends::sharpest(name, turns));
        }
        all.extend(segments);
    }
    let patches = if antiplane { Patches::Antiplane(all) } else { Patches::Plane(all) };
    Ok(Tiling { patches, faults, notes })
}

/// Advice if a cell has no extent or leaves the rock.
const INSIDE: &str = "y points up; in a half-space the whole line lies in y <= 0, also where a spline swings between its vertices";

/// A cell of a line.
struct Cell {
    /// Lower and upper end: slip along it moves the plus side upwards.
    ends: [[f64; 2]; 2],
    /// Distance of its centre from the upper end of the fault, along it \[m\].
    along: f64,
}

impl Cell {
    fn length(&self) -> f64 {
        let [[x0, y0], [x1, y1]] = self.ends;
        (x1 - x0).hypot(y1 - y0)
    }
}

/// Cells of a line in order from its upper end; from the left one, if both are at the same height.
fn cells(name: &str, line: &FaultLine) -> Result<(Vec<Cell>, Option<Departure>), Diagnostic> {
    let trace: Vec<[f64; 2]> = line.trace.get_ref().iter().map(|x| x.map(|c| c.0)).collect();
    let found =
        divided(&trace, meshes::interpolation(line.interpolation), &meshes::spacing(line.spacing.get_ref()));
    let DividedLine { mut places, mut along, departure } = found.map_err(|e| {
        let doubled = matches!(e, FaultMeshError::Doubled { .. });
        let help = if doubled { "remove one of the two" } else { "see `line` of faults" };
        Diagnostic::at(line.trace.span(), format!("fault `{name}`: {e}"), help)
    })?;
    let (first, last) = (places[0], places[places.len() - 1]);
    if last[1] > first[1] || (last[1] == first[1] && last[0] < first[0]) {
        let length = along[along.len() - 1];
        places.reverse();
        along.reverse();
        along.iter_mut().for_each(|s| *s = length - *s);
    }
    let cells = places.windows(2).zip(along.windows(2));
    let cell = |(x, s): (&[[f64; 2]], &[f64])| Cell { ends: [x[1], x[0]], along: 0.5 * (s[0] + s[1]) };
    Ok((cells.map(cell).collect(), departure))
}

/// Point at the centre of a cell.
fn place<const D: usize>(
    fault: Entry<'_, Spec>,
    number: usize,
    cell: &Cell,
    segment: &Segment,
) -> Result<Place<D>, Diagnostic> {
    let at = in_dimension(&segment.middle());
    let normal = unit(in_dimension(&segment.normal()));
    let [rake, creeps] = directions(fault, &at, &normal)?;
    let area = cell.length();
    Ok(Place { minus: number, plus: number, at, area, normal, rake, creeps, along: cell.along })
}
