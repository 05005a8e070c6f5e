//! Absorbing sides: dashpots that carry away plane waves of normal incidence.
//!
//! The traction `-ρ c_p v_n n - ρ c_s v_t` is that of a half-space into which plane waves leave (Lysmer, J. & Kuhlemeyer, R. L. 1969,
//! J. Eng. Mech. Div. ASCE 95, 859-877). Waves of oblique incidence are reflected in part.

use crate::Model;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::mesh::Side;
use asperity_fem::surface;
use std::collections::BTreeMap;

/// Dashpot of a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dashpot {
    /// Node.
    pub node: usize,
    /// Damping matrix of its components, row by row \[N s/m, or N s/m² in the plane\].
    pub damping: [[f64; 3]; 3],
}

/// Dashpots of all nodes of the given sides, by ascending nodes; `density` holds that of each block of cells \[kg/m³\].
#[must_use]
pub fn dashpots<const D: usize>(model: &Model<D>, density: &[f64], sides: &[Side]) -> Vec<Dashpot> {
    let components = model.idealisation.components();
    let mut all: BTreeMap<usize, [[f64; 3]; 3]> = BTreeMap::new();
    for side in sides {
        let [pressure, shear] = impedances(model, density, side.block);
        for column in 0..components {
            let forces = surface::integrate(&model.mesh, &[*side], model.idealisation, |point, value| {
                let area = surface::length(&point.normal);
                for (row, value) in value.iter_mut().enumerate() {
                    let normal = |c: usize| {
                        let axis = model.idealisation.axis(c);
                        point.normal.get(axis).map_or(0.0, |n| n / area)
                    };
                    let same = if row == column { shear } else { 0.0 };
                    *value = area * (same + (pressure - shear) * normal(row) * normal(column));
                }
            });
            for (dof, force) in forces {
                all.entry(dof / components).or_default()[dof % components][column] += force;
            }
        }
    }
    all.into_iter().map(|(node, damping)| Dashpot { node, damping }).collect()
}

/// ρ c_p and ρ c_s of a block \[Pa s/m\].
fn impedances<const D: usize>(model: &Model<D>, density: &[f64], block: usize) -> [f64; 2] {
    let body = model.bodies.iter().find(|b| b.blocks.contains(&block));
    let Some(elastic) = body.map(|b| b.elastic[block - b.blocks.start]) else { return [0.0; 2] };
    let dilatation = match model.idealisation {
        Idealisation::PlaneStress => elastic.plane_stress_lame(),
        _ => elastic.lame(),
    };
    let of = |modulus: f64| (modulus * density[block]).sqrt();
    [of(dilatation + 2.0 * elastic.shear()), of(elastic.shear())]
}
