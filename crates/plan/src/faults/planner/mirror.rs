//! Bodies that mirror each other across one plane fault.

use crate::shared::model::Model;
use asperity_cycles::medium::{Mirror, Point};
use std::collections::BTreeMap;

/// Distance between a node and the image of another below which both are the same, relative to the size of the model: the rounding of
/// coordinates in mesh files.
const SAME: f64 = 1e-9;

/// The mirror in the plane of the faults that maps the nodes of the bodies onto each other, if there is one. The plane is normal to
/// an axis, and the nodes on it are those of the faults. Whether rocks and loads are the same in the mirror remains to be seen.
pub(super) fn find<const D: usize>(model: &Model<D>, points: &[Point<D>]) -> Option<Mirror> {
    if model.idealisation.components() != 3 {
        return None;
    }
    let first = &points.first()?.place;
    let axis = first.normal.iter().position(|c| c.abs() == 1.0)?;
    let (side, plane) = (first.normal[axis], first.at[axis]);
    let close = SAME * model.scale;
    let nodes = &model.mesh.nodes;
    let mut images = vec![None; nodes.len()];
    let mut minus = vec![false; nodes.len()];
    for place in points.iter().map(|p| &p.place) {
        if place.normal != first.normal || (place.at[axis] - plane).abs() > close {
            return None;
        }
        images[place.minus] = Some(place.plus);
        images[place.plus] = Some(place.minus);
        minus[place.minus] = true;
    }
    let off = |node: usize| side * (nodes[node][axis] - plane);
    let beside: Vec<usize> = (0..nodes.len()).filter(|&k| images[k].is_none()).collect();
    // Distances from the plane are rounded in the same way on both sides of it.
    let key = |node: usize| -> [i64; D] {
        std::array::from_fn(|c| {
            let x = if c == axis { off(node).abs() } else { nodes[node][c] };
            (x / (2.0 * close)).round() as i64
        })
    };
    let mut left = BTreeMap::new();
    for &node in beside.iter().filter(|&&k| off(k) < -close) {
        minus[node] = true;
        if left.insert(key(node), node).is_some() {
            return None;
        }
    }
    for &node in beside.iter().filter(|&&k| off(k) > close) {
        let image = left.remove(&key(node))?;
        (images[node], images[image]) = (Some(image), Some(node));
    }
    let images: Option<Vec<usize>> = images.into_iter().collect();
    images.map(|images| Mirror { axis, images, minus })
}
