//! Meshes of flat faults: rows of cells follow the fault, columns are vertical.
//!
//! A line y = Y(x) holds the fault, and its continuation from the tips to the sides of the box. Above and below it rows lie at
//! the same vertical distances from it, as far as there is room.
//!
//! The wedge above a fault that reaches the surface begins with one triangle. Every further column has one row more, with
//! another triangle at the surface, until all rows are there. All angles but those of the triangles differ from right ones by
//! the dip at most.

use super::check::ROUNDING;
use super::spine::Spine;
use super::{FaultMesh, FaultMeshError, MOST_CELLS, SpacingError};
use crate::mesh::spacing;

/// Positions from one end of a line to the other \[m\].
type Line = Vec<[f64; 2]>;

/// Number of halvings that exhaust the digits of a ratio.
const HALVINGS: usize = 54;

/// Nodes of a column: its place, and distances from the line to the boundary, which begin with 0.
#[derive(Debug)]
pub(super) struct Column {
    /// x \[m\].
    pub x: f64,
    /// Y(x) \[m\].
    pub line: f64,
    /// Vertical distances above the line, ascending; only 0 where the line lies on the top of the box \[m\].
    pub above: Vec<f64>,
    /// Distances below it \[m\].
    pub below: Vec<f64>,
}

/// Columns from left to right, and those of the fault.
#[derive(Debug)]
pub(super) struct Layers {
    pub columns: Vec<Column>,
    /// Column of the left tip.
    pub first: usize,
    /// True if the fault falls to the right.
    pub falls: bool,
}

impl Layers {
    /// `vertices` of the line that rows follow, the highest first; `places` of the nodes of the fault, ascending; smallest size
    /// along it.
    pub(super) fn new(
        input: &FaultMesh,
        vertices: &[[f64; 2]],
        places: &[[f64; 2]],
        smallest: f64,
    ) -> Result<Self, FaultMeshError> {
        let falls = places[0][0] > places[places.len() - 1][0];
        let ordered = |line: &[[f64; 2]], rises: bool| -> Line {
            let turned = |x: &[f64; 2]| [x[1], x[0]];
            if rises { line.iter().rev().map(turned).collect() } else { line.iter().map(turned).collect() }
        };
        // The spine is a line x = X(y) with descending y; here x and y change places.
        let spine = Spine::new(ordered(vertices, falls), [input.min[1], input.max[1]]);
        let fault = ordered(places, falls);
        let (lines, first) = lines(input, &spine, &fault)?;
        tips(input, places)?;
        let flattest = spine.slopes.iter().map(|p| 1.0 / p.hypot(1.0)).fold(0.0, f64::max);
        let thickness = input.thickness.unwrap_or(smallest) / flattest;
        let largest = lines.iter().map(|[_, y]| (input.max[1] - y).max(y - input.min[1])).fold(0.0, f64::max);
        if let Some(value) = input.thickness.filter(|&t| t > largest) {
            let admissible = "at most the distance from the fault to the top or the bottom of the box";
            return Err(FaultMeshError::Value { name: "thickness", value, admissible });
        }
        let [above, below] = rows(input, &lines, thickness)?;
        let columns = lines.iter().zip(above).zip(below);
        let columns = columns.map(|((&[x, line], above), below)| Column { x, line, above, below });
        Ok(Self { columns: columns.collect(), first, falls })
    }
}

/// Distances of rows above and below the places of columns, next to which cells have this thickness.
fn rows(input: &FaultMesh, lines: &[[f64; 2]], thickness: f64) -> Result<[Vec<Vec<f64>>; 2], FaultMeshError> {
    let side = |height: &dyn Fn(f64) -> f64| {
        let heights: Vec<f64> = lines.iter().map(|[_, y]| height(*y)).collect();
        distances(&heights, thickness, input.growth)
    };
    let (above, below) = (side(&|y| input.max[1] - y)?, side(&|y| y - input.min[1])?);
    let cells: usize = above.iter().chain(&below).map(|d| d.len() - 1).sum();
    if cells > MOST_CELLS {
        return Err(SpacingError::TooMany { most: MOST_CELLS }.into());
    }
    Ok([above, below])
}

/// Refuses tips just below the top or above the bottom of the box; `places` ascend.
fn tips(input: &FaultMesh, places: &[[f64; 2]]) -> Result<(), FaultMeshError> {
    let n = places.len();
    let size = |k: usize| (places[k + 1][0] - places[k][0]).hypot(places[k + 1][1] - places[k][1]);
    let (below, above) = (places[0][1] - input.min[1], input.max[1] - places[n - 1][1]);
    for (place, length, size) in
        [("below the lower tip", below, size(0)), ("above the upper tip", above, size(n - 2))]
    {
        if length > 0.0 && length < 0.5 * size {
            return Err(SpacingError::Gap { place, length, size }.into());
        }
    }
    Ok(())
}

/// Places of the columns on the line from left to right, and the index of the left tip. `fault`: (y, x) of its nodes from left to
/// right.
fn lines(input: &FaultMesh, spine: &Spine, fault: &[[f64; 2]]) -> Result<(Line, usize), FaultMeshError> {
    let n = fault.len();
    let (left, right) = (fault[0][1], fault[n - 1][1]);
    let before = fault[1][1] - left;
    let outwards = spacing::geometric(
        before,
        left - input.min[0],
        input.growth,
        "between the left tip of the fault and the left side",
    )?;
    let mut all: Line = vec![[input.min[0], spine.x(input.min[0])]];
    let inner = outwards[1..outwards.len() - 1].iter().rev().map(|d| left - d);
    all.extend(inner.map(|x| [x, spine.x(x)]));
    let first = all.len();
    all.extend(fault.iter().map(|&[y, x]| [x, y]));
    let after = right - fault[n - 2][1];
    let outwards = spacing::geometric(
        after,
        input.max[0] - right,
        input.growth,
        "between the right tip of the fault and the right side",
    )?;
    let inner = outwards[1..outwards.len() - 1].iter().map(|d| right + d);
    all.extend(inner.map(|x| [x, spine.x(x)]));
    all.push([input.max[0], spine.x(input.max[0])]);
    Ok((all, first))
}

/// Distances of rows from the line in columns of these heights, all from 0 to the height.
fn distances(heights: &[f64], thickness: f64, growth: f64) -> Result<Vec<Vec<f64>>, FaultMeshError> {
    let largest = heights.iter().copied().fold(0.0, f64::max);
    let (mut most, mut size, mut total) = (1, thickness, thickness);
    while total < largest * (1.0 - ROUNDING) {
        size *= growth;
        total += size;
        most += 1;
        if most > MOST_CELLS {
            return Err(SpacingError::TooMany { most: MOST_CELLS }.into());
        }
    }
    let mut counts: Vec<usize> = heights.iter().map(|&h| if h > 0.0 { most } else { 0 }).collect();
    for k in 1..counts.len() {
        counts[k] = counts[k].min(counts[k - 1] + 1);
    }
    for k in (1..counts.len()).rev() {
        counts[k - 1] = counts[k - 1].min(counts[k] + 1);
    }
    if counts.iter().sum::<usize>() > MOST_CELLS {
        return Err(SpacingError::TooMany { most: MOST_CELLS }.into());
    }
    Ok(counts.iter().zip(heights).map(|(&rows, &height)| column(rows, height, thickness)).collect())
}

/// Distances of these rows, from 0 to the height. The first has the thickness and the others grow by one ratio; all are equal
/// where there is less room.
fn column(rows: usize, height: f64, thickness: f64) -> Vec<f64> {
    let sum = |ratio: f64| (0..rows).fold((0.0, thickness), |(sum, size), _| (sum + size, size * ratio)).0;
    let mut ratio = 1.0;
    let mut size = height / rows as f64;
    if size > thickness {
        size = thickness;
        // The last row alone is smaller than the height.
        let (mut low, mut high) = (1.0, height / thickness);
        for _ in 0..HALVINGS {
            ratio = 0.5 * (low + high);
            if sum(ratio) < height { low = ratio } else { high = ratio }
        }
    }
    let mut distances = vec![0.0];
    for row in 1..=rows {
        let distance = distances[row - 1] + size;
        distances.push(if row == rows { height } else { distance });
        size *= ratio;
    }
    distances
}
