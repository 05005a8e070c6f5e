//! Plane rectangular faults in space, divided into equal cells.

use super::super::super::plan::CellGrid;
use super::super::place::directions;
use super::super::placed_point::in_space;
use super::tiling::{Cut, buried, in_dimension};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Fault as Spec, FaultRectangle};
use crate::shared::entry::Entry;
use asperity_cycles::kernel::{Placement, Rectangle, Space};
use asperity_cycles::medium::patches::{Shape, Tile, from_kernel, to_kernel};
use asperity_cycles::medium::{Place, across, unit};
use asperity_cycles::operator::Lattice;
use asperity_scene::defaults;
use std::f64::consts::FRAC_PI_2;

/// Numbers from which those of a fault count.
#[derive(Clone, Copy)]
pub(super) struct FirstNumbers {
    pub cell: usize,
    pub grid: usize,
}

/// Cells of a fault, with their grid.
///
/// # Errors
/// [`Diagnostic`] at a rectangle that leaves the rock.
pub(super) fn cells<const D: usize>(
    Entry { name, spec }: Entry<'_, Spec>,
    rectangle: &FaultRectangle,
    space: Space,
    first: FirstNumbers,
) -> Result<DividedRectangle<D>, Diagnostic> {
    let grid = Grid::from_rectangle(rectangle);
    let mut tiles = Vec::with_capacity(grid.count());
    let mut places = Vec::with_capacity(grid.count());
    for k in 0..grid.count() {
        let cell = [k % grid.columns, k / grid.columns];
        let patch = Rectangle::new(space, &grid.placement(cell)).map_err(|e| {
            let help = "y points up: depths are negative";
            Diagnostic::at(rectangle.from.span(), format!("fault `{name}`: {e}"), help)
        })?;
        buried(space, name, [grid.centre(cell)[1], grid.cell[1]], rectangle.from.span())?;
        let place = place::<D>(Entry::new(name, spec), first.cell + k, &grid, (cell, &patch))?;
        tiles.push(tile(&place, patch, (first.grid, cell)));
        places.push(place);
    }
    let sizes = vec![grid.cell[0].max(grid.cell[1]); grid.count()];
    let points = (first.cell..first.cell + tiles.len()).collect();
    Ok(DividedRectangle {
        tiles,
        grid: Lattice { columns: grid.columns, rows: grid.rows, points },
        cut: Cut {
            places,
            widths: sizes.clone(),
            sizes,
            faces: grid.faces(),
            outline: None,
            grid: Some(grid.view()),
            ends: Vec::new(),
        },
        note: grid.words(name),
    })
}

/// A rectangle divided into cells.
pub(super) struct DividedRectangle<const D: usize> {
    pub tiles: Vec<Tile>,
    pub grid: Lattice,
    pub cut: Cut<D>,
    pub note: String,
}

/// Grid of cells of a rectangle.
struct Grid {
    columns: usize,
    rows: usize,
    /// Size of a cell along strike and down dip \[m\].
    cell: [f64; 2],
    /// First end of the upper edge.
    from: [f64; 3],
    /// Unit vectors along strike and down dip.
    axes: [[f64; 3]; 2],
    /// Strike in the axes of kernels \[rad\].
    strike: f64,
    dip: f64,
}

impl Grid {
    fn from_rectangle(spec: &FaultRectangle) -> Self {
        let [from, to] = [&spec.from, &spec.to].map(|end| end.get_ref().map(|x| x.0));
        let (x, z) = (to[0] - from[0], to[2] - from[2]);
        let length = x.hypot(z);
        let (width, size) = (spec.width.get_ref().0, spec.size.get_ref().0);
        // The scene check admits no dip above a right angle beyond rounding.
        let dip = spec.dip.as_ref().map_or(defaults::DIP, |d| d.get_ref().0.min(FRAC_PI_2));
        let [columns, rows] = [length, width].map(|extent| ((extent / size).round() as usize).max(1));
        let [sx, sz] = [x / length, z / length];
        // To the right of strike, seen from above: y up, and z towards the viewer of the (x, y) plane.
        let (sin, cos) = dip.sin_cos();
        let cos = if dip == FRAC_PI_2 { 0.0 } else { cos };
        let down = [-sz * cos, -sin, sx * cos];
        Self {
            columns,
            rows,
            cell: [length / columns as f64, width / rows as f64],
            from,
            axes: [[sx, 0.0, sz], down],
            strike: x.atan2(z),
            dip,
        }
    }

    fn count(&self) -> usize {
        self.columns * self.rows
    }

    /// Centre of a cell \[m\].
    fn centre(&self, [column, row]: [usize; 2]) -> [f64; 3] {
        let along = (column as f64 + 0.5) * self.cell[0];
        let down = (row as f64 + 0.5) * self.cell[1];
        std::array::from_fn(|c| self.from[c] + along * self.axes[0][c] + down * self.axes[1][c])
    }

    fn placement(&self, cell: [usize; 2]) -> Placement {
        let centre = to_kernel(&self.centre(cell)).into();
        let [length, width] = self.cell;
        Placement { centre, strike: self.strike, dip: self.dip, length, width }
    }

    /// Quadrilaterals between the centres of neighbouring cells; lines in a grid of one row or column.
    fn faces(&self) -> Vec<Vec<usize>> {
        let (columns, rows) = (self.columns, self.rows);
        if columns == 1 || rows == 1 {
            return (1..self.count()).map(|k| vec![k - 1, k]).collect();
        }
        let corners = |row: usize, column: usize| {
            let k = row * columns + column;
            vec![k, k + 1, k + columns + 1, k + columns]
        };
        (0..rows - 1).flat_map(|row| (0..columns - 1).map(move |column| corners(row, column))).collect()
    }

    fn view(&self) -> CellGrid {
        let Self { columns, rows, cell, from, axes: [along, down], .. } = *self;
        CellGrid { columns, rows, cell, from, along, down }
    }

    fn words(&self, name: &str) -> String {
        let [length, width] = self.cell;
        format!(
            "fault `{name}` has {} x {} cells along strike and down dip, of {length} m x {width} m",
            self.columns, self.rows
        )
    }
}

/// Point at the centre of a cell.
fn place<const D: usize>(
    fault: Entry<'_, Spec>,
    number: usize,
    grid: &Grid,
    (cell, patch): ([usize; 2], &Rectangle),
) -> Result<Place<D>, Diagnostic> {
    let at = in_dimension(&grid.centre(cell));
    let frame = patch.frame();
    let normal = unit(in_dimension(&from_kernel(&frame.column(2).into())));
    let [rake, creeps] = directions(fault, &at, &normal)?;
    let area = grid.cell[0] * grid.cell[1];
    Ok(Place { minus: number, plus: number, at, area, normal, rake, creeps, along: 0.0 })
}

fn tile<const D: usize>(place: &Place<D>, rectangle: Rectangle, cell: (usize, [usize; 2])) -> Tile {
    let (normal, rake, at) = (in_space(&place.normal), in_space(&place.rake), in_space(&place.at));
    let shape = Shape::Rectangle(rectangle);
    Tile { shape, rake, across: across(&normal, &rake), normal, at, cell: Some(cell) }
}
