//! Fields in files of VTK.

use super::axes::{Axes, Lists};
use super::cells::{Cells, Rule, Simplex};
use super::field_request::{FieldRequest, Source, checked, coordinates_of};
use super::region::Region;
use super::samples::Samples;
use crate::reading::columns::unit::FilePart;
use crate::reading::columns::{Wrong, unit};
use crate::reading::scene::model::FieldInterpolation;
use crate::reading::scene::units::{self, Dimension};
use asperity_output::fields::vtu::Cell;
use asperity_output::fields::vtu::reading::{self, Grid, NamedArray, VtuError};
use asperity_scene::suggestions::suggest;

/// Help for a file that is not read.
const FORM: &str = "an unstructured grid of lines, triangles, quadrilaterals or points in a `.vtu` file, such as meshio, PyVista and ParaView write it, plain or with zlib";

/// Coordinates and values of a file of VTK.
pub(super) fn field<const D: usize>(
    region: &Region<'_, D>,
    bytes: &[u8],
    asked: &FieldRequest<'_>,
) -> Result<(Axes<D>, Source), Wrong> {
    let grid = reading::read(bytes, asked.name).map_err(|error| match &error {
        VtuError::NoArray { name, names } => {
            Wrong::new(error.to_string(), suggest(name, "arrays", names.iter().map(String::as_str)))
        }
        _ => Wrong::new(error.to_string(), FORM),
    })?;
    let (array, by_cell) = match (grid.at_points.first(), grid.in_cells.first()) {
        (Some(array), None) => (array, false),
        (None, Some(array)) => (array, true),
        _ => {
            let message = format!("its array `{}` is given at points and in cells", asked.name);
            return Err(Wrong::new(message, "one of them under another name"));
        }
    };
    let values = scaled(array, asked)?;
    let what = if by_cell { "cell" } else { "point" };
    checked(&values, asked, "array", &|k| format!("{what} {k}"))?;
    let simplices = simplices(&grid.cells)?;
    let (names, lists) = coordinates(&grid, asked, D)?;
    let point = |k: usize| format!("point {k}");
    if simplices.is_empty() {
        return scattered(region, (&names, lists), &values, (asked, by_cell));
    }
    let rule = match (by_cell, asked.interpolation) {
        (true, Some(FieldInterpolation::Linear)) => {
            return Err(Wrong::new(
                format!("its array `{}` has one value in each cell, which is not linear", asked.name),
                "leave `interpolation` out, or give values at points",
            ));
        }
        (true, _) => Rule::Whole,
        (false, Some(FieldInterpolation::Nearest)) => Rule::Corner,
        (false, _) => Rule::Linear,
    };
    let (axes, positions) = Axes::from_rows(region, &names, lists, &point)?;
    flat(&simplices, &positions)?;
    Ok((axes, Source::Cells(Cells::new(&positions, simplices, values, rule))))
}

/// Values at points without lines or triangles between them.
fn scattered<const D: usize>(
    region: &Region<'_, D>,
    (names, lists): (&[&'static str], Lists),
    values: &[f64],
    (asked, by_cell): (&FieldRequest<'_>, bool),
) -> Result<(Axes<D>, Source), Wrong> {
    if by_cell {
        return Err(Wrong::new("its cells are points or none", "values at points, or cells with an extent"));
    }
    let (axes, positions) = Axes::scattered(region, names, lists, &|k| format!("point {k}"))?;
    let nearest = asked.interpolation != Some(FieldInterpolation::Linear);
    let samples = Samples::new(&positions, values, nearest).map_err(|why| axes.explain(&why))?;
    Ok((axes, Source::Samples(samples)))
}

/// Values of an array in SI.
fn scaled(array: &NamedArray, asked: &FieldRequest<'_>) -> Result<Vec<f64>, Wrong> {
    if array.components != 1 {
        let message = format!("its array `{}` has {} components", asked.name, array.components);
        return Err(Wrong::new(message, "an array of one component"));
    }
    let factor = size_of(FilePart::new("array", asked.name), "unit", asked.unit, asked.dimension())?;
    Ok(asked.plain(array.values.iter().map(|v| v * factor).collect()))
}

/// Size of a unit that the scene states, in SI.
fn size_of(
    part: FilePart<'_>,
    key: &str,
    stated: Option<&str>,
    dimension: Option<Dimension>,
) -> Result<f64, Wrong> {
    let found = unit::chosen(part, None, stated, dimension).map_err(|wrong| {
        let si = dimension.map_or("1", Dimension::si);
        Wrong {
            help: format!("files of VTK have no units: such as `{key} = \"{si}\"` in the scene"),
            ..wrong
        }
    })?;
    let (Some(found), Some(dimension)) = (found, dimension) else { return Ok(1.0) };
    units::parse(&format!("1 {found}"), dimension).map_err(|why| Wrong::new(why.to_string(), FORM))
}

/// Names of the coordinates and their values: metres, and radians of longitude and latitude.
fn coordinates(
    grid: &Grid,
    asked: &FieldRequest<'_>,
    dimensions: usize,
) -> Result<(Vec<&'static str>, Lists), Wrong> {
    let flat = dimensions == 2 && grid.points.iter().all(|x| x[2] == 0.0);
    let own = if flat { &["x", "y"][..] } else { &["x", "y", "z"] };
    let factor = || {
        let points = FilePart::new("coordinate", "Points");
        size_of(points, "coordinate_unit", asked.coordinate_unit, Some(Dimension::Length))
    };
    let (mut names, mut lists) = (Vec::new(), Vec::new());
    for (name, in_file) in coordinates_of(asked, own) {
        let c = ["x", "y", "z"].iter().position(|axis| *axis == in_file).ok_or_else(|| {
            Wrong::new(format!("it has no coordinate `{in_file}`"), "points of VTK have `x`, `y` and `z`")
        })?;
        let size = match name {
            "longitude" | "latitude" => 1_f64.to_radians(),
            _ => factor()?,
        };
        names.push(name);
        lists.push(grid.points.iter().map(|x| x[c] * size).collect());
    }
    Ok((names, lists))
}

/// Lines and triangles of cells; none of points. Cells of second order are divided between their nodes.
fn simplices(cells: &[Cell]) -> Result<Vec<Simplex>, Wrong> {
    let mut all = Vec::new();
    for (k, cell) in cells.iter().enumerate() {
        let parts: Vec<Vec<usize>> = match (cell.kind, cell.points.len()) {
            (0..=2, _) => continue,
            (3, 2) | (4, 2..) => (1..cell.points.len()).map(|n| vec![n - 1, n]).collect(),
            (5, 3) => vec![vec![0, 1, 2]],
            (9, 4) => vec![vec![0, 1, 2], vec![0, 2, 3]],
            (8, 4) => vec![vec![0, 1, 3], vec![0, 3, 2]],
            (21, 3) => vec![vec![0, 2], vec![2, 1]],
            (22, 6) => vec![vec![0, 3, 5], vec![3, 1, 4], vec![5, 4, 2], vec![3, 4, 5]],
            (23, 8) => {
                [[0, 4, 7], [4, 1, 5], [5, 2, 6], [6, 3, 7], [4, 5, 6], [4, 6, 7]].map(Vec::from).into()
            }
            (28, 9) => {
                [[0, 4, 8], [0, 8, 7], [4, 1, 5], [4, 5, 8], [8, 5, 2], [8, 2, 6], [7, 8, 6], [7, 6, 3]]
                    .map(Vec::from)
                    .into()
            }
            (kind, n) => {
                let message = format!("its cell {k} is of type {kind} of VTK with {n} points");
                return Err(Wrong::new(message, FORM));
            }
        };
        let own =
            |part: Vec<usize>| Simplex { nodes: part.into_iter().map(|n| cell.points[n]).collect(), cell: k };
        all.extend(parts.into_iter().map(own));
    }
    Ok(all)
}

/// Refuses lines without length and triangles without area.
fn flat(simplices: &[Simplex], positions: &[Vec<f64>]) -> Result<(), Wrong> {
    let apart = |a: usize, b: usize| -> Vec<f64> {
        positions[a].iter().zip(&positions[b]).map(|(a, b)| b - a).collect()
    };
    let dot = |u: &[f64], v: &[f64]| u.iter().zip(v).map(|(u, v)| u * v).sum::<f64>();
    for Simplex { nodes, cell } in simplices {
        let u = apart(nodes[0], nodes[1]);
        let size = match nodes.get(2) {
            Some(c) => {
                let v = apart(nodes[0], *c);
                dot(&u, &u) * dot(&v, &v) - dot(&u, &v).powi(2)
            }
            None => dot(&u, &u),
        };
        if size <= 0.0 {
            return Err(Wrong::new(format!("its cell {cell} has no extent in its coordinates"), FORM));
        }
    }
    Ok(())
}
