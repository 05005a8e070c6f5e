//! Faults that share nodes. Segments of one surface that meet end to end are joined; other contacts are refused.
//!
//! The point at which two segments meet belongs to the first of them by name, with its law and initial state. Its area is the sum of both parts and
//! its normal their mean, as if the segments were one fault.

use super::place::{branches, directions};
use super::placed_point::PlacedPoint;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Fault as Spec, Scene};
use crate::shared::entry::Entry;
use crate::shared::model::{self, Model};
use asperity_cycles::medium::unit;
use asperity_fem::mesh::face_nodes;
use asperity_mechanics::coordinates;
use std::collections::BTreeMap;

/// Joins the points that faults share. Returns notes on their positions.
///
/// # Errors
/// [`Diagnostic`] if two faults have a face in common, or branch.
pub(super) fn join<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    placed: &mut Vec<PlacedPoint<D>>,
) -> Result<Vec<String>, Diagnostic> {
    let faults = Entry::all(&scene.faults);
    distinct(model, &faults, placed)?;
    let mut owner: BTreeMap<usize, usize> = BTreeMap::new();
    let mut shared: Vec<(usize, usize)> = Vec::new();
    for (k, p) in placed.iter().enumerate() {
        let nodes = [p.point.place.minus, p.point.place.plus];
        match nodes.map(|n| owner.get(&n).copied()) {
            [None, None] => owner.extend(nodes.map(|n| (n, k))),
            [Some(a), Some(b)] if a == b => shared.push((a, k)),
            [a, b] => {
                let other = a.or(b).map_or(p.fault, |o| placed[o].fault);
                let (this, other) = (faults[p.fault], faults[other]);
                let what = if this.name == other.name {
                    format!("fault `{}` branches", this.name)
                } else {
                    format!("faults `{}` and `{}` branch", other.name, this.name)
                };
                return Err(branches(&what, &p.point.place.at, this.spec));
            }
        }
    }
    let mut notes: BTreeMap<(usize, usize), (usize, String)> = BTreeMap::new();
    for &(a, b) in &shared {
        absorb(&faults, placed, a, b)?;
        let place = &placed[a].point.place;
        let at = || (0, coordinates::in_words(&place.at));
        notes.entry((placed[a].fault, placed[b].fault)).or_insert_with(at).0 += 1;
    }
    let mut k = 0;
    placed.retain(|_| {
        k += 1;
        shared.binary_search_by_key(&(k - 1), |s| s.1).is_err()
    });
    let words = |((a, b), (count, at)): ((usize, usize), (usize, String))| {
        let (a, b) = (faults[a].name, faults[b].name);
        let points = if count == 1 { "the point".to_string() } else { format!("{count} points, the first") };
        format!("faults `{a}` and `{b}` meet: {points} at {at} belong to `{a}`, with its law and start")
    };
    Ok(notes.into_iter().map(words).collect())
}

/// Adds the area of point `b` of another fault, at the same two nodes, to point `a`.
fn absorb<const D: usize>(
    faults: &[Entry<'_, Spec>],
    placed: &mut [PlacedPoint<D>],
    a: usize,
    b: usize,
) -> Result<(), Diagnostic> {
    let other = placed[b].point.place.clone();
    let owner = &mut placed[a];
    let place = &mut owner.point.place;
    // If the sides are swapped, the normal is reversed.
    let sense = if other.minus == place.minus { 1.0 } else { -1.0 };
    let sum: [f64; D] =
        std::array::from_fn(|c| place.area * place.normal[c] + sense * other.area * other.normal[c]);
    place.area += other.area;
    place.normal = unit(sum);
    [place.rake, place.creeps] = directions(faults[owner.fault], &place.at, &place.normal)?;
    owner.redirect();
    Ok(())
}

/// Refuses faults with a face in common, because friction there would be ambiguous.
fn distinct<const D: usize>(
    model: &Model<D>,
    faults: &[Entry<'_, Spec>],
    placed: &[PlacedPoint<D>],
) -> Result<(), Diagnostic> {
    let mut owner: BTreeMap<Vec<[usize; 2]>, usize> = BTreeMap::new();
    for (k, &Entry { name, spec }) in faults.iter().enumerate() {
        let own = placed.iter().filter(|p| p.fault == k).map(|p| &p.point.place);
        let plus: BTreeMap<usize, usize> = own.map(|p| (p.minus, p.plus)).collect();
        for side in model::sides(model, &spec.minus)? {
            // Independent of which side is called minus; at a tip, both sides are one node.
            let pair = |n: usize| {
                let other = plus.get(&n).copied().unwrap_or(n);
                [n.min(other), n.max(other)]
            };
            let nodes = face_nodes(&model.mesh, side);
            let at = coordinates::in_words(&model.mesh.nodes[nodes[0]]);
            let mut key: Vec<[usize; 2]> = nodes.into_iter().map(pair).collect();
            key.sort_unstable();
            let Some(before) = owner.insert(key, k).filter(|&before| before != k) else { continue };
            let other = faults[before].name;
            return Err(Diagnostic::at(
                spec.minus.span(),
                format!("faults `{other}` and `{name}` both have the face at {at}"),
                format!(
                    "a face belongs to one fault: take the faces of one of `{other}` and `{name}` out of the other's sets. Parameters that vary \
                     along a fault are `profiles`; other laws need surfaces of their own, which may meet at their borders"
                ),
            ));
        }
    }
    Ok(())
}
