//! Surfaces that are given by depths on a map, such as the interfaces of plates, divided into triangles of one size.
//!
//! Contours at depths that are a height of a triangle apart down dip are divided evenly, and strips between them are
//! filled with triangles.

mod border;
mod contour;
mod depths;
mod edges;
mod error;
mod scattered_samples;
mod slopes;
mod text;

pub use depths::Depths;
pub use error::SheetError;
pub use scattered_samples::{ScatterError, ScatteredSamples};
pub use text::rows;

use contour::{Spot, Stop, Tracer, distance, lengths, middle, on};

/// Height of an equilateral triangle over its side.
const HEIGHT: f64 = 0.866_025_403_784_438_6;

/// Most triangles that are made; no operator of as many fits into memory.
const MOST: f64 = 1e6;

/// Triangles of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// Positions: east, north, up \[m\].
    pub nodes: Vec<[f64; 3]>,
    /// Corners, anticlockwise from above.
    pub corners: Vec<[usize; 3]>,
    /// Number of nodes on each contour, from the shallowest.
    pub rows: Vec<usize>,
}

/// Divides the part of a surface between two depths into triangles with sides of about `size` \[m\].
///
/// # Errors
/// [`SheetError`] if the surface is not one sheet with open contours between these depths.
///
/// # Panics
/// If `top` is not above `bottom`, or `size` is not positive.
pub fn triangles(depths: &Depths, [top, bottom]: [f64; 2], size: f64) -> Result<Sheet, SheetError> {
    assert!(top < bottom && size > 0.0, "depths increase and triangles have a size");
    let range = depths.range();
    if let Some(depth) = [top, bottom].into_iter().find(|d| !(*d > range[0] && *d < range[1])) {
        return Err(SheetError::Outside { depth, range });
    }
    let tracer = Tracer::new(depths, size);
    let first = tracer.contour(top)?;
    let last = tracer.contour(bottom)?;
    let across = distance(&middle(&first), &middle(&last)).hypot(bottom - top);
    let triangles = 2.0 * lengths(&first)[first.len() - 1] * across / (HEIGHT * size * size);
    if triangles > MOST {
        return Err(SheetError::Many { triangles });
    }
    let start = tracer.settle(&middle(&first), top).unwrap_or(middle(&first));
    let way = tracer.down(&start, bottom)?;
    let mut sheet = Sheet { nodes: Vec::new(), corners: Vec::new(), rows: Vec::new() };
    let mut last = sheet.add(&divided(&tracer, &first, top, size)?, top);
    for depth in levels(&way, bottom, size) {
        let row = sheet.add(&divided(&tracer, &tracer.contour(depth)?, depth, size)?, depth);
        sheet.strip(&last, &row);
        last = row;
    }
    Ok(sheet)
}

/// Evenly spaced positions on a contour, about `size` apart.
fn divided(tracer: &Tracer<'_>, line: &[Spot], depth: f64, size: f64) -> Result<Vec<Spot>, SheetError> {
    let length = |line: &[Spot]| lengths(line)[line.len() - 1];
    if length(line) < size {
        return Err(SheetError::Short { depth, length: length(line) });
    }
    // From the straight lines between samples to the smooth surface, which moves positions a little along the contour:
    // twice evens them out.
    let mut even = line.to_vec();
    for _ in 0..2 {
        let along = lengths(&even);
        let length = along[along.len() - 1];
        let count = (length / size).round().max(1.0);
        let settled = |k: usize| {
            let near = on(&even, &along, length * k as f64 / count);
            // At the border the smooth contour may lie outside the samples: the straight one ends there.
            tracer.settle(&near, depth).unwrap_or(near)
        };
        even = (0..=count as usize).map(settled).collect();
    }
    Ok(even)
}

/// Depths below the first one, in even steps of the way down dip.
fn levels(way: &[Stop], bottom: f64, size: f64) -> Vec<f64> {
    let within = |from: f64, to: f64, at: f64| if to > from { (at - from) / (to - from) } else { 0.0 };
    let k = way.partition_point(|stop| stop.depth < bottom).clamp(1, way.len() - 1);
    let (a, b) = (&way[k - 1], &way[k]);
    let length = a.length + within(a.depth, b.depth, bottom) * (b.length - a.length);
    let count = (length / (HEIGHT * size)).round().max(1.0) as usize;
    let depth = |k: usize| {
        let at = length * k as f64 / count as f64;
        let i = way.partition_point(|stop| stop.length <= at).clamp(1, way.len() - 1);
        let (a, b) = (&way[i - 1], &way[i]);
        a.depth + within(a.length, b.length, at) * (b.depth - a.depth)
    };
    (1..count).map(depth).chain([bottom]).collect()
}

impl Sheet {
    /// Least angle of the triangles \[rad\].
    #[must_use]
    pub fn least_angle(&self) -> f64 {
        let corner = |corners: &[usize; 3], k: usize| {
            let [a, b, c] = [0, 1, 2].map(|i| self.nodes[corners[(k + i) % 3]]);
            let way = |x: [f64; 3]| std::array::from_fn::<f64, 3, _>(|i| x[i] - a[i]);
            let (u, v) = (way(b), way(c));
            let dot: f64 = u.iter().zip(&v).map(|(u, v)| u * v).sum();
            let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            cross.iter().map(|c| c * c).sum::<f64>().sqrt().atan2(dot)
        };
        let angles = self.corners.iter().flat_map(|corners| (0..3).map(move |k| corner(corners, k)));
        angles.fold(f64::INFINITY, f64::min)
    }

    /// Adds the nodes of a contour.
    fn add(&mut self, line: &[Spot], depth: f64) -> Vec<usize> {
        let first = self.nodes.len();
        self.nodes.extend(line.iter().map(|x| [x[0], x[1], -depth]));
        self.rows.push(line.len());
        (first..self.nodes.len()).collect()
    }

    /// Fills the strip between two contours, each time across the shorter diagonal.
    fn strip(&mut self, upper: &[usize], lower: &[usize]) {
        let apart = |a: usize, b: usize| {
            let (a, b) = (&self.nodes[a], &self.nodes[b]);
            a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>()
        };
        let (mut i, mut j, mut found) = (0, 0, Vec::new());
        while i + 1 < upper.len() || j + 1 < lower.len() {
            let above = (i + 1 < upper.len()).then(|| apart(upper[i + 1], lower[j]));
            let below = (j + 1 < lower.len()).then(|| apart(upper[i], lower[j + 1]));
            let advance_upper = match (above, below) {
                (Some(above), Some(below)) => above <= below,
                (above, _) => above.is_some(),
            };
            if advance_upper {
                found.push([upper[i], lower[j], upper[i + 1]]);
                i += 1;
            } else {
                found.push([upper[i], lower[j], lower[j + 1]]);
                j += 1;
            }
        }
        self.corners.extend(found);
    }
}
