//! Cells of faults in homogeneous rock.

use super::super::cells::Cells;
use super::super::placed::Placed;
use crate::diagnostic::Diagnostic;
use crate::scene::model::Fault as Spec;
use asperity_cycles::medium::Place;
use asperity_cycles::medium::patches::Patches;

/// Cells of the faults of a scene, in the order of their points.
pub(super) struct Tiling<const D: usize> {
    pub patches: Patches,
    /// Points at the centres, fault by fault.
    pub places: Vec<Vec<Place<D>>>,
    /// Largest extent of each cell \[m\], fault by fault.
    pub sizes: Vec<Vec<f64>>,
    /// Faces between centres of neighbouring cells, by the numbers of their points within the fault.
    pub faces: Vec<Vec<Vec<usize>>>,
    pub notes: Vec<String>,
}

/// A dimension that the caller has established.
pub(super) fn in_dimension<const A: usize, const B: usize>(v: &[f64; A]) -> [f64; B] {
    std::array::from_fn(|c| v.get(c).copied().unwrap_or(0.0))
}

impl<const D: usize> Cells<D> for Tiling<D> {
    fn size(&self, _: &Spec, point: &Placed<D>) -> Result<f64, Diagnostic> {
        Ok(point.spacing)
    }

    fn faces(&self, (fault, _): (usize, &Spec), _: &[Placed<D>]) -> Result<Vec<Vec<usize>>, Diagnostic> {
        Ok(self.faces[fault].clone())
    }
}
