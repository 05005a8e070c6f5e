//! Pieces of an unstructured grid, joined.

use super::array::Arrays;
use super::error::{ArrayError, VtuError};
use super::grid::{Grid, NamedArray};
use super::xml::{Document, Element};
use crate::fields::vtu::cell::Cell;

pub(super) fn grid(document: &Document<'_>, name: &str) -> Result<Grid, VtuError> {
    let root = &document.root;
    if root.name != "VTKFile" {
        return Err(VtuError::Foreign { found: root.name.clone() });
    }
    let found = root.attribute("type").unwrap_or_default();
    if found != "UnstructuredGrid" {
        return Err(VtuError::DataSet { found: found.into() });
    }
    let arrays = Arrays::read(document)?;
    let data = root.first("UnstructuredGrid").ok_or_else(|| missing("`UnstructuredGrid`"))?;
    let pieces: Vec<&Element> = data.all("Piece").collect();
    if pieces.is_empty() {
        return Err(missing("`Piece`"));
    }
    let mut whole = Grid::default();
    for piece in pieces {
        let [points, cells] = ["NumberOfPoints", "NumberOfCells"]
            .map(|key| piece.attribute(key).and_then(|n| n.trim().parse().ok()));
        let points: usize = points.ok_or_else(|| missing("`NumberOfPoints`"))?;
        let cells: usize = cells.ok_or_else(|| missing("`NumberOfCells`"))?;
        join(&mut whole.at_points, named(&arrays, piece, ("PointData", name, points))?)?;
        join(&mut whole.in_cells, named(&arrays, piece, ("CellData", name, cells))?)?;
        let own = cells_of(&arrays, piece, cells, points)?;
        let first = whole.points.len();
        whole.points.extend(points_of(&arrays, piece, points)?);
        whole.cells.extend(own.into_iter().map(|Cell { kind, points }| Cell {
            kind,
            points: points.into_iter().map(|n| first + n).collect(),
        }));
    }
    if whole.at_points.is_empty() && whole.in_cells.is_empty() {
        return Err(VtuError::NoArray { name: name.into(), names: names(data) });
    }
    complete(&whole)?;
    Ok(whole)
}

fn missing(part: &str) -> VtuError {
    VtuError::Missing { part: part.into() }
}

/// Product of two counts, beyond which no array is read.
fn product(a: usize, b: usize) -> Result<usize, VtuError> {
    a.checked_mul(b).ok_or_else(|| missing("file of that size"))
}

/// Names of the arrays of all pieces.
fn names(data: &Element) -> Vec<String> {
    let holders = data.all("Piece").flat_map(|piece| &piece.inner);
    let holders = holders.filter(|inner| matches!(inner.name.as_str(), "PointData" | "CellData"));
    let mut all: Vec<String> = holders
        .flat_map(|holder| holder.all("DataArray"))
        .filter_map(|array| array.attribute("Name").map(str::to_string))
        .collect();
    all.sort();
    all.dedup();
    all
}

/// The array of a name in a part of a piece, with this number of points or cells.
fn named(
    arrays: &Arrays<'_>,
    piece: &Element,
    (holder, name, count): (&str, &str, usize),
) -> Result<Option<NamedArray>, VtuError> {
    let found = piece
        .first(holder)
        .and_then(|holder| holder.all("DataArray").find(|array| array.attribute("Name") == Some(name)));
    let Some(array) = found else { return Ok(None) };
    let components = array.attribute("NumberOfComponents").and_then(|n| n.trim().parse().ok()).unwrap_or(1);
    let values = arrays.numbers(array, product(count, components)?)?;
    Ok(Some(NamedArray { name: name.into(), components, values }))
}

/// Adds the array of a piece to that of the pieces before.
fn join(all: &mut Vec<NamedArray>, own: Option<NamedArray>) -> Result<(), VtuError> {
    match (all.first_mut(), own) {
        (Some(before), Some(own)) if before.components != own.components => Err(VtuError::Array {
            name: own.name,
            why: ArrayError::Components { first: before.components, other: own.components },
        }),
        (Some(before), Some(own)) => {
            before.values.extend(own.values);
            Ok(())
        }
        (None, Some(own)) => {
            all.push(own);
            Ok(())
        }
        (_, None) => Ok(()),
    }
}

/// Refuses an array that some pieces have and others lack.
fn complete(whole: &Grid) -> Result<(), VtuError> {
    let rows = [(&whole.at_points, whole.points.len()), (&whole.in_cells, whole.cells.len())];
    for (arrays, count) in rows {
        if let Some(array) = arrays.iter().find(|a| Some(a.values.len()) != count.checked_mul(a.components)) {
            return Err(VtuError::Array { name: array.name.clone(), why: ArrayError::Lacking });
        }
    }
    Ok(())
}

fn points_of(arrays: &Arrays<'_>, piece: &Element, count: usize) -> Result<Vec<[f64; 3]>, VtuError> {
    let array = piece.first("Points").and_then(|points| points.first("DataArray"));
    let array = array.ok_or_else(|| missing("`Points`"))?;
    let values = arrays.numbers(array, product(count, 3)?)?;
    let points: Vec<[f64; 3]> = values.as_chunks::<3>().0.to_vec();
    match points.iter().position(|x| x.iter().any(|c| !c.is_finite())) {
        Some(k) => Err(VtuError::Array { name: "Points".into(), why: ArrayError::Coordinate(k) }),
        None => Ok(points),
    }
}

fn cells_of(
    arrays: &Arrays<'_>,
    piece: &Element,
    count: usize,
    points: usize,
) -> Result<Vec<Cell>, VtuError> {
    if count == 0 {
        return Ok(Vec::new());
    }
    let cells = piece.first("Cells").ok_or_else(|| missing("`Cells`"))?;
    let array = |name: &'static str| {
        let found = cells.all("DataArray").find(|array| array.attribute("Name") == Some(name));
        found.ok_or_else(|| missing(&format!("`{name}` of cells")))
    };
    let offsets = arrays.numbers(array("offsets")?, count)?;
    let kinds = arrays.numbers(array("types")?, count)?;
    let length = offsets.last().copied().unwrap_or_default();
    let wrong = |name: &str, why| VtuError::Array { name: name.into(), why };
    let mut ends = Vec::with_capacity(offsets.len());
    for &end in &offsets {
        let before = ends.last().copied().unwrap_or(0);
        let whole = (end >= before as f64 && end.fract() == 0.0 && end <= length).then_some(end as usize);
        ends.push(whole.ok_or_else(|| wrong("offsets", ArrayError::CellEnd { end, before }))?);
    }
    let nodes = arrays.numbers(array("connectivity")?, ends.last().copied().unwrap_or(0))?;
    let number = |&n: &f64| {
        let whole = (n >= 0.0 && n.fract() == 0.0 && n < points as f64).then_some(n as usize);
        whole.ok_or_else(|| wrong("connectivity", ArrayError::Point { number: n, points }))
    };
    let nodes: Vec<usize> = nodes.iter().map(number).collect::<Result<_, _>>()?;
    let mut from = 0;
    let mut all = Vec::with_capacity(ends.len());
    for (end, kind) in ends.into_iter().zip(kinds) {
        let kind = (kind.fract() == 0.0 && (0.0..=255.0).contains(&kind)).then_some(kind as u8);
        let kind = kind.ok_or_else(|| wrong("types", ArrayError::CellType))?;
        all.push(Cell { kind, points: nodes[from..end].to_vec() });
        from = end;
    }
    Ok(all)
}
