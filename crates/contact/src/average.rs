//! Tractions averaged to slave points.
//!
//! The tractions f_A conjugate to the averaged gaps of a mortar interface are coefficients of the field `p = Σ_A ψ_A f_A`. If
//! the field is a square root at the edge of contact, its coefficients oscillate there, as in any projection onto continuous
//! functions. The value transmitted around a point is `p_A = ∫ψ_A p / ∫ψ_A`. On first-order facets it is the force on the slave
//! node over its area, which is the traction of a method with dual multipliers. With the shares `D_AC/a_A` of the slave nodes C
//! in the averaged gap, `p_A = Σ_C (D_AC/a_A) p(x_C)`: tractions and gaps are averaged by the same operation. For the square
//! root at the edge of a Hertz contact the averages lie on the curve within (h/d)²/48 at the distance d from the edge.

use crate::measure::mortar::node_values;
use crate::measure::{Attachment, Measure};
use crate::spec::{MeasureKind, SlavePoint};
use crate::vector::axpy;

/// Relation of nodal values of the traction field to the tractions of the points.
#[derive(Clone, Debug)]
pub(crate) struct Averaging {
    /// Points and coefficients for each node of the interface; `None` if tractions are point values and need no averaging.
    values: Option<Vec<Vec<(usize, f64)>>>,
    attachments: Vec<Attachment>,
}

impl Averaging {
    pub(crate) fn new(kind: &MeasureKind, slave: &[SlavePoint], nodes: usize) -> Self {
        let values = match kind {
            MeasureKind::NodeToPoint => None,
            MeasureKind::Mortar { faces, .. } => Some(node_values(faces, slave, nodes)),
        };
        Self { values, attachments: Vec::new() }
    }

    /// Computes the averages of the normal and tangential tractions of all points.
    pub(crate) fn apply<const D: usize>(
        &mut self,
        measure: &dyn Measure<D>,
        normal: &[f64],
        shear: &[[f64; D]],
        mean_normal: &mut [f64],
        mean_shear: &mut [[f64; D]],
    ) {
        mean_normal.copy_from_slice(normal);
        mean_shear.copy_from_slice(shear);
        let Some(values) = &self.values else { return };
        for p in 0..normal.len() {
            measure.attachments(p, &mut self.attachments);
            if self.attachments.is_empty() {
                continue;
            }
            let (mut f, mut t) = (0.0, [0.0; D]);
            for a in self.attachments.iter().filter(|a| a.slave) {
                for &(q, c) in &values[a.node] {
                    f += a.weight * c * normal[q];
                    axpy(&mut t, a.weight * c, &shear[q]);
                }
            }
            mean_normal[p] = f;
            mean_shear[p] = t;
        }
    }
}
