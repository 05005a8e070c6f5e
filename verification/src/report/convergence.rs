//! Convergence figures of claims on orders: errors against the refined size, with the expected slope as a triangle.

use super::page::number;
use crate::claim::Claim;
use crate::order::OrderTest;
use asperity_output::figures::{Diagram, Series, Slope};

/// Distance of the triangle from the errors in decades: a fixed part and a fraction of their range.
const APART: (f64, f64) = (0.08, 0.10);

/// Fraction of the range of fitted levels below which the triangle is drawn.
const SPAN: (f64, f64) = (0.35, 0.85);

/// The figure of a claim on an order.
pub fn diagram(claim: &Claim, order: &OrderTest) -> Diagram {
    let points: Vec<(f64, f64)> = order.levels.iter().map(|l| (l.size, l.error)).collect();
    let unit = if claim.unit.is_empty() { "–" } else { &claim.unit };
    let mut diagram = Diagram::xy("", "refined size", format!("error [{unit}]")).log_log();
    diagram.caption = caption(order);
    let name = if order.plateau.is_some() { "error" } else { "" };
    diagram = diagram.series(Series::marked(name, &points));
    if let (Some(plateau), Some(first), Some(last)) = (&order.plateau, points.first(), points.last()) {
        let line = [(last.0, plateau.level), (first.0, plateau.level)];
        diagram = diagram.series(Series::line(format!("floor of {}", plateau.floor.name()), &line));
    }
    match slope(order) {
        Some(slope) => diagram.slope(slope),
        None => diagram,
    }
}

/// The triangle below the fitted levels; none if they have no logarithms.
pub fn slope(order: &OrderTest) -> Option<Slope> {
    let fitted = order.fitted();
    let (coarse, fine) = (fitted.first()?, fitted.last()?);
    let usable = |l: &&crate::order::Level| l.size > 0.0 && l.error > 0.0 && l.error.is_finite();
    if !fitted.iter().all(usable) || coarse.size <= fine.size {
        return None;
    }
    let reduced = |l: &&crate::order::Level| l.error / (l.size / fine.size).powf(order.expected);
    let lowest = fitted.iter().map(reduced).fold(f64::INFINITY, f64::min);
    let decades = (coarse.error / fine.error).log10().abs();
    let y = lowest * 10.0_f64.powf(-APART.0 - APART.1 * decades);
    let at = |part: f64| fine.size * (coarse.size / fine.size).powf(part);
    let (from, to) = (at(SPAN.0), at(SPAN.1));
    Some(Slope { order: order.expected, x: (from, to), y: y * (from / fine.size).powf(order.expected) })
}

fn caption(order: &OrderTest) -> String {
    let observed = order.observed().map_or_else(|why| why, number);
    let better = if order.or_better { " or better" } else { "" };
    format!(
        "Observed {observed} over the finest {} levels; expected {} ± {}{better}.",
        order.fitted().len(),
        number(order.expected),
        number(order.tolerance)
    )
}
