//! Triangles at the border of scattered samples that bridge its bays.

use super::edges::{Edge, edges};
use std::collections::BTreeMap;

/// Cosine of the angle from which a triangle at the border is left out: 135 degrees. Borders that are straight on one map are curved on
/// another, and flat triangles between their samples join positions that are far from each other.
const FLAT: f64 = -0.707;

/// Triangles without those at the border whose angle opposite to it is flat, again and again until none is left.
pub(super) fn trimmed(
    samples: &[[f64; 3]],
    faces: BTreeMap<usize, [usize; 3]>,
) -> BTreeMap<usize, [usize; 3]> {
    let mut kept = faces;
    let mut beside: BTreeMap<Edge, Vec<usize>> = BTreeMap::new();
    for (&face, corners) in &kept {
        for edge in edges(corners) {
            beside.entry(edge).or_default().push(face);
        }
    }
    let mut border: Vec<Edge> =
        beside.iter().filter(|(_, faces)| faces.len() == 1).map(|(edge, _)| *edge).collect();
    while let Some(edge) = border.pop() {
        let Some(&[face]) = beside.get(&edge).map(Vec::as_slice) else { continue };
        let corners = kept[&face];
        let Some(&tip) = corners.iter().find(|n| !edge.contains(n)) else { continue };
        if cosine(samples, tip, edge) >= FLAT {
            continue;
        }
        kept.remove(&face);
        for edge in edges(&corners) {
            let faces = beside.entry(edge).or_default();
            faces.retain(|&other| other != face);
            border.push(edge);
        }
    }
    kept
}

/// Cosine of the angle at a corner between the ways to the ends of an edge, on the map.
fn cosine(samples: &[[f64; 3]], tip: usize, [a, b]: Edge) -> f64 {
    let way = |n: usize| [samples[n][0] - samples[tip][0], samples[n][1] - samples[tip][1]];
    let (u, v) = (way(a), way(b));
    (u[0] * v[0] + u[1] * v[1]) / (u[0].hypot(u[1]) * v[0].hypot(v[1]))
}
