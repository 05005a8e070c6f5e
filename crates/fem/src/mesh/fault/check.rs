//! Checks of the input for a fault mesh.

use super::error::Dip;
use super::{FaultMesh, FaultMeshError};
use crate::element::ElementKind;

/// Fraction of the box within which a tip counts as lying on its bottom or top, and of the fault within which a node counts as
/// lying on a vertex: rounding of decimal input.
pub(super) const ROUNDING: f64 = 1e-9;

/// Dip from which a fault lies in a column of the grid \[degrees\]: below it cells at the free surface would have a scaled
/// Jacobian under sin 10° = 0.17.
const STEEP: f64 = 10.0;
/// Largest dip of a fault that lies in a row of the grid \[degrees\]: cells then have a scaled Jacobian of cos 80° = 0.17.
const STEEPEST_FLAT: f64 = 80.0;
/// Smallest dip \[degrees\]. The minus side is that of smaller x, which rounding of coordinates with six digits must not decide;
/// claims of the suite reach down to it.
const LEAST_DIP: f64 = 1.0;

/// Course of a fault, which decides how cells follow it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Course {
    /// The fault lies in a column of the grid.
    Steep,
    /// The fault lies in a row.
    Flat,
}

/// Checks the input; returns the trace, with tips that reach the boundary placed exactly on it.
pub(super) fn trace(input: &FaultMesh) -> Result<Vec<[f64; 2]>, FaultMeshError> {
    values(input)?;
    let (min, max) = (input.min, input.max);
    for axis in 0..2 {
        if !((max[axis] - min[axis]).is_finite() && max[axis] > min[axis]) {
            return Err(FaultMeshError::EmptyBox { axis, min: min[axis], max: max[axis] });
        }
    }
    let mut trace = input.trace.clone();
    let bad = trace.iter().filter(|v| !v.iter().all(|c| c.is_finite())).count();
    if trace.len() < 2 || bad > 0 {
        return Err(FaultMeshError::Trace { vertices: trace.len(), bad });
    }
    distinct(&trace)?;
    let close = ROUNDING * (max[1] - min[1]);
    for (vertex, at) in trace.iter_mut().enumerate() {
        for end in [min[1], max[1]] {
            if (at[1] - end).abs() <= close {
                at[1] = end;
            }
        }
        let inside = min[0] < at[0] && at[0] < max[0] && min[1] <= at[1] && at[1] <= max[1];
        if !inside {
            return Err(FaultMeshError::Outside { vertex, at: *at, min, max });
        }
    }
    crossings(&trace)?;
    monotonic(&trace)?;
    Ok(trace)
}

/// Refuses neighbouring vertices at one position.
pub(super) fn distinct(trace: &[[f64; 2]]) -> Result<(), FaultMeshError> {
    match trace.windows(2).position(|w| w[0] == w[1]) {
        Some(first) => Err(FaultMeshError::Doubled { first, at: trace[first] }),
        None => Ok(()),
    }
}

fn values(input: &FaultMesh) -> Result<(), FaultMeshError> {
    if !matches!(input.kind, ElementKind::Quad4 | ElementKind::Quad8 | ElementKind::Quad9) {
        return Err(FaultMeshError::Element(input.kind.name()));
    }
    let positive = "a positive number of metres";
    let least_one = "at least 1 (1.05 to 1.5 are usual)";
    let mut asked = vec![("growth", input.growth, 1.0, least_one)];
    input.spacing.check()?;
    asked.extend(input.thickness.map(|t| ("thickness", t, f64::MIN_POSITIVE, positive)));
    for (name, value, least, admissible) in asked {
        if !(value.is_finite() && value >= least) {
            return Err(FaultMeshError::Value { name, value, admissible });
        }
    }
    Ok(())
}

/// Twice the signed area of a triangle: positive if it runs counter-clockwise.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Refuses segments that cross or touch, except neighbours at their common vertex.
fn crossings(trace: &[[f64; 2]]) -> Result<(), FaultMeshError> {
    let within = |a: [f64; 2], b: [f64; 2], p: [f64; 2]| {
        (0..2).all(|c| p[c] >= a[c].min(b[c]) && p[c] <= a[c].max(b[c]))
    };
    for second in 2..trace.len() - 1 {
        for first in 0..second - 1 {
            let [a, b, c, d] = [trace[first], trace[first + 1], trace[second], trace[second + 1]];
            let [s1, s2, s3, s4] = [turn(a, b, c), turn(a, b, d), turn(c, d, a), turn(c, d, b)];
            let cross = s1 * s2 < 0.0 && s3 * s4 < 0.0;
            let touch = (s1 == 0.0 && within(a, b, c))
                || (s2 == 0.0 && within(a, b, d))
                || (s3 == 0.0 && within(c, d, a))
                || (s4 == 0.0 && within(c, d, b));
            if cross || touch {
                return Err(FaultMeshError::SelfIntersection { first, second });
            }
        }
    }
    Ok(())
}

/// Dips of segments \[degrees\], from the x axis downwards in the direction of the trace as a whole: above 90 to the left.
fn dips(line: &[[f64; 2]]) -> impl Iterator<Item = f64> {
    let down = (line[0][1] - line[line.len() - 1][1]).signum();
    line.windows(2).map(move |w| {
        let (dx, dy) = (down * (w[1][0] - w[0][0]), down * (w[0][1] - w[1][1]));
        dy.atan2(dx).to_degrees()
    })
}

/// The first segment that is too flat or runs the opposite way, with its dip.
fn refused(line: &[[f64; 2]]) -> Option<(usize, f64)> {
    // Rounding must not refuse a dip equal to the smallest one.
    let admissible = LEAST_DIP - ROUNDING..=180.0 - LEAST_DIP + ROUNDING;
    dips(line).enumerate().find(|(_, dip)| !admissible.contains(dip))
}

/// Refuses segments that are too flat, and those that run opposite to the trace as a whole.
fn monotonic(trace: &[[f64; 2]]) -> Result<(), FaultMeshError> {
    match refused(trace) {
        Some((segment, dip)) if (0.0..=180.0).contains(&dip) && trace[segment] != trace[segment + 1] => {
            Err(FaultMeshError::Flat { segment, dip: Dip(dip), least: LEAST_DIP })
        }
        Some((segment, _)) => Err(FaultMeshError::Turned { segment }),
        None => Ok(()),
    }
}

/// Course of the line through `places`; an error names segments of the trace.
pub(super) fn course(trace: &[[f64; 2]], places: &[[f64; 2]]) -> Result<Course, FaultMeshError> {
    let within = |least: f64, most: f64| {
        let admissible = least - ROUNDING..=most + ROUNDING;
        dips(places).all(|dip| admissible.contains(&dip))
    };
    if within(STEEP, 180.0 - STEEP) {
        return Ok(Course::Steep);
    }
    if within(LEAST_DIP, STEEPEST_FLAT) || within(180.0 - STEEPEST_FLAT, 180.0 - LEAST_DIP) {
        return Ok(Course::Flat);
    }
    let angle = |dip: f64| dip.min(180.0 - dip);
    let flattest = dips(trace).enumerate().min_by(|a, b| angle(a.1).total_cmp(&angle(b.1)));
    let (flat, dip) = flattest.unwrap_or((0, 0.0));
    // The segment whose direction differs most from the flattest one.
    let other = dips(trace).enumerate().max_by(|a, b| (a.1 - dip).abs().total_cmp(&(b.1 - dip).abs()));
    let (steep, other) = other.unwrap_or((0, 0.0));
    Err(FaultMeshError::Bent {
        flat,
        dip: Dip(dip),
        steep,
        other: Dip(other),
        limit: STEEP,
        most: STEEPEST_FLAT,
    })
}

/// Refuses a curve through the vertices of a trace that becomes flat or leaves the box between them; `places` lie on it.
pub(super) fn curved(
    input: &FaultMesh,
    trace: &[[f64; 2]],
    places: &[[f64; 2]],
) -> Result<(), FaultMeshError> {
    let outside = |x: &[f64; 2]| {
        !(input.min[0] < x[0] && x[0] < input.max[0] && input.min[1] <= x[1] && x[1] <= input.max[1])
    };
    let Some(k) = refused(places).map(|f| f.0).or_else(|| places.iter().position(outside)) else {
        return Ok(());
    };
    let at = places[k];
    let down = (trace[0][1] - trace[trace.len() - 1][1]).signum();
    let passed = trace.iter().take_while(|v| down * (v[1] - at[1]) >= 0.0).count();
    Err(FaultMeshError::Curve { at, segment: passed.clamp(1, trace.len() - 1) - 1 })
}

/// Distances of the vertices from the first, along the trace.
pub(super) fn distances(trace: &[[f64; 2]]) -> Vec<f64> {
    let mut total = 0.0;
    let steps = trace.windows(2).map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1]));
    [0.0]
        .into_iter()
        .chain(steps.map(|s| {
            total += s;
            total
        }))
        .collect()
}

/// Positions at ascending distances `along`; exact at vertices.
pub(super) fn places(trace: &[[f64; 2]], along: &[f64]) -> Vec<[f64; 2]> {
    let at = distances(trace);
    let close = ROUNDING * at[at.len() - 1];
    let mut k = 0;
    along
        .iter()
        .map(|&s| {
            while k + 2 < at.len() && s > at[k + 1] + close {
                k += 1;
            }
            let ends = [(at[k], trace[k]), (at[k + 1], trace[k + 1])];
            if let Some((_, vertex)) = ends.into_iter().find(|(d, _)| (s - d).abs() <= close) {
                return vertex;
            }
            let t = (s - at[k]) / (at[k + 1] - at[k]);
            std::array::from_fn(|c| (1.0 - t) * trace[k][c] + t * trace[k + 1][c])
        })
        .collect()
}
