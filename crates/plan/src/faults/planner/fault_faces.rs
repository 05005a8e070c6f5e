//! Faces of faults between bodies.

use super::cells::Cells;
use super::placed_point::PlacedPoint;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Fault as Spec;
use crate::shared::model::{self, Model};
use asperity_fem::mesh::{Side, face_nodes};
use std::collections::BTreeMap;

/// Faces of the bodies at faults.
pub(crate) struct FaultFaces<'a, const D: usize> {
    pub model: &'a Model<D>,
}

impl<const D: usize> Cells<D> for FaultFaces<'_, D> {
    fn size(&self, spec: &Spec, point: &PlacedPoint<D>) -> Result<f64, Diagnostic> {
        let Self { model } = self;
        let mut size = 0.0_f64;
        for side in model::sides(model, &spec.minus)? {
            let nodes = face_nodes(&model.mesh, side);
            if !nodes.contains(&point.point.place.minus) {
                continue;
            }
            for (k, &a) in nodes.iter().enumerate() {
                for &b in &nodes[..k] {
                    let (a, b) = (&model.mesh.nodes[a], &model.mesh.nodes[b]);
                    size = size.max(a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt());
                }
            }
        }
        Ok(size)
    }

    fn faces(&self, _: usize, spec: &Spec, placed: &[PlacedPoint<D>]) -> Result<Vec<Vec<usize>>, Diagnostic> {
        let Self { model } = self;
        let points = placed.iter().enumerate().map(|(p, placed)| (placed.point.place.minus, p));
        let points: BTreeMap<usize, usize> = points.collect();
        let of = |side: &Side| {
            let nodes = face_nodes(&model.mesh, side);
            nodes.iter().map(|n| points.get(n).copied()).collect::<Option<Vec<usize>>>()
        };
        Ok(model::sides(model, &spec.minus)?.iter().filter_map(of).collect())
    }
}
