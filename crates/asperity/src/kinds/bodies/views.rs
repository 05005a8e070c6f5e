//! The plan and the state of a run of bodies in the form passed to observers.

use asperity_contact::{Interface, PointFields, Status};
use asperity_fem::block::von_mises;
use asperity_fem::mesh::MeshFace;
use asperity_laws::Theta;
use asperity_mechanics::{CellBlock, InterfaceEnergy, PlannedInterface};
use asperity_output::bodies::view::{BodyFields, InterfaceFields, InterfaceMesh, LogTheta, Setup};
use asperity_plan::bodies::Plan;
use asperity_plan::shared::views::{self, padded};
use std::collections::BTreeMap;

/// Part of the model that does not change during a run.
#[must_use]
pub fn setup<const D: usize>(plan: &Plan<D>, areas: &[Vec<f64>]) -> Setup {
    Setup {
        title: plan.title.clone(),
        mesh: views::mesh_view(&plan.problem.model, plan.problem.moves()),
        interfaces: plan
            .problem
            .interfaces
            .iter()
            .zip(areas)
            .zip(&plan.thetas)
            .map(|((i, areas), thetas)| interface_mesh(plan, i, areas, thetas))
            .collect(),
        stages: plan.problem.stages.iter().map(|s| (s.name.clone(), s.end)).collect(),
        points: plan.problem.samples.points.iter().map(views::point_mark).collect(),
        forces: plan.problem.samples.forces.iter().map(views::force_mark).collect(),
        springs: views::spring_marks(&plan.problem.stages),
        force_unit: views::force_unit(plan.problem.model.idealisation),
        energy_unit: Some(views::energy_unit(plan.problem.model.idealisation)),
        eventful: plan.events.as_ref().map_or_else(Vec::new, |events| events.interfaces.clone()),
    }
}

fn interface_mesh<const D: usize>(
    plan: &Plan<D>,
    planned: &PlannedInterface,
    areas: &[f64],
    thetas: &[Theta],
) -> InterfaceMesh {
    let nodes: Vec<usize> = planned.slave.iter().map(|s| s.0).collect();
    let local = |n: &usize| nodes.partition_point(|m| m < n);
    let positions: Vec<[f64; 3]> = nodes.iter().map(|&n| padded(&plan.problem.model.mesh.nodes[n])).collect();
    let mut master_nodes: Vec<usize> =
        planned.master_faces.iter().flat_map(|face| &face.nodes).copied().collect();
    master_nodes.sort_unstable();
    master_nodes.dedup();
    let own = |face: &MeshFace| face.nodes.iter().map(|n| master_nodes.partition_point(|m| m < n)).collect();
    InterfaceMesh {
        name: planned.name.clone(),
        master_faces: planned.master_faces.iter().map(own).collect(),
        master_nodes,
        labels: Vec::new(),
        areas: areas.to_vec(),
        // The face at a tip has a node that is not a point of the interface.
        faces: planned
            .slave_faces
            .iter()
            .map(|face| &face.nodes)
            .filter(|f| f.iter().all(|n| nodes.binary_search(n).is_ok()))
            .map(|f| f.iter().map(local).collect())
            .collect(),
        probes: probes(&positions, planned.probes),
        states: planned.law.as_ref().map_or(0, |law| law.states()),
        theta: thetas.iter().map(log_theta).collect(),
        in_space: D == 3,
        positions,
        nodes,
    }
}

fn log_theta(theta: &Theta) -> LogTheta {
    let (at_zero, per_state) = theta.linear();
    LogTheta { at_zero, per_state, steady: theta.steady() }
}

/// Slave nodes nearest to `count` equally spaced positions along the diagonal of the slave side's bounding box.
fn probes(positions: &[[f64; 3]], count: usize) -> Vec<usize> {
    let (min, max) = asperity_mechanics::bounds(positions);
    let mut probes: Vec<usize> = (0..count)
        .map(|k| {
            let s = if count == 1 { 0.5 } else { k as f64 / (count - 1) as f64 };
            let target: [f64; 3] = std::array::from_fn(|c| min[c] + s * (max[c] - min[c]));
            nearest(positions, target)
        })
        .collect();
    probes.dedup();
    probes
}

fn nearest(positions: &[[f64; 3]], target: [f64; 3]) -> usize {
    let distance = |p: &[f64; 3]| (0..3).map(|c| (p[c] - target[c]).powi(2)).sum::<f64>();
    (0..positions.len())
        .min_by(|&a, &b| distance(&positions[a]).total_cmp(&distance(&positions[b])))
        .unwrap_or_default()
}

/// Averaged shear traction, with the sign convention of [`interface_fields`].
fn mean_shear<const D: usize>(p: &PointFields<D>) -> Vec<f64> {
    let inner = |a: &[f64; D], b: &[f64; D]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let each = p.mean_shear.iter().zip(&p.tangent);
    each.map(|(t, e)| if D == 2 { inner(t, e) } else { inner(t, t).sqrt() }).collect()
}

/// State of an interface, with its energies once the run has begun. In two dimensions tangential quantities are measured along the first tangent (-n_y, n_x), with n the outward normal of the
/// master. In three dimensions they are magnitudes, given in addition to vectors, because the tangents to which components refer depend on the
/// contact measure.
#[must_use]
pub fn interface_fields<const D: usize>(
    interface: &Interface<D>,
    energy: Option<&InterfaceEnergy>,
) -> InterfaceFields {
    let p = interface.points();
    let length = |v: &[f64; D]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
    let tangential = |vectors: &[[f64; D]], along: &[f64]| -> Vec<f64> {
        if D == 2 { along.to_vec() } else { vectors.iter().map(length).collect() }
    };
    let in_space =
        |vectors: &[[f64; D]]| if D == 3 { vectors.iter().map(padded).collect() } else { Vec::new() };
    InterfaceFields {
        gap: p.gap.clone(),
        normal_traction: p.normal_traction.clone(),
        shear_traction: p.shear_measure.clone(),
        mean_normal_traction: p.mean_normal.clone(),
        mean_shear_traction: mean_shear(p),
        relative_displacement: tangential(&p.relative, &p.relative_measure),
        slip: tangential(&p.slip, &p.slip_measure),
        slip_vector: in_space(&p.slip),
        shear_vector: in_space(&p.shear),
        slip_rate: p.slip_rate.clone(),
        friction: p.friction.clone(),
        status: p
            .status
            .iter()
            .map(|s| match s {
                Status::Open => 0,
                Status::Stick => 1,
                Status::Slip => 2,
            })
            .collect(),
        area: p.area.clone(),
        friction_work: energy.map_or_else(|| vec![0.0; p.area.len()], |energy| energy.per_area.clone()),
        dissipated: energy.map_or(0.0, |energy| energy.friction),
        states: (0..p.states_per_point)
            .map(|k| p.states.iter().skip(k).step_by(p.states_per_point).copied().collect())
            .collect(),
    }
}

/// Fields of the bodies for the displacement `u` of the common mesh; `blocks` are the blocks of the mesh in their current state.
#[must_use]
pub fn body_fields<const D: usize>(plan: &Plan<D>, blocks: &[CellBlock<D>], u: &[f64]) -> BodyFields {
    let nodes = plan.problem.model.mesh.nodes.len();
    let displacement = (0..nodes).map(|n| plan.problem.model.displacement(n, u)).collect();
    let mut fields = BodyFields { displacement, node_mises: vec![0.0; nodes], ..BodyFields::default() };
    let plastic = blocks.iter().any(|b| plastic_strain(b).is_some());
    // Sum and number of the nodal stresses of the blocks; a node between blocks of a body takes their mean.
    let mut sums = vec![([0.0; 6], 0.0); nodes];
    for (body, initial) in plan.problem.model.bodies.iter().zip(&plan.problem.initial_stress) {
        for index in body.blocks.clone() {
            let block = &blocks[index];
            // Nonlinear blocks include the initial stress in their own state.
            let add = |s: [f64; 6], x: &[f64; D]| match initial {
                Some(initial) if block.linear().is_some() => {
                    let initial = initial.at(x);
                    std::array::from_fn(|i| s[i] + initial[i])
                }
                _ => s,
            };
            let cells: Vec<[f64; 6]> = match block {
                CellBlock::Linear(block) => {
                    let middles = block.cell_middles();
                    block.cell_stress(u).into_iter().zip(&middles).map(|(s, x)| add(s, x)).collect()
                }
                CellBlock::Nonlinear(block) => block.cell_stress(),
            };
            if plastic {
                let zero = || vec![0.0; cells.len()];
                fields.cell_plastic_strain.extend(plastic_strain(block).unwrap_or_else(zero));
            }
            for (node, stress) in nodal_stress(plan, block, (index, &cells), u) {
                let (sum, count) = &mut sums[node];
                *count += 1.0;
                let stress = add(stress, &plan.problem.model.mesh.nodes[node]);
                sum.iter_mut().zip(stress).for_each(|(a, b)| *a += b);
            }
            fields.cell_mises.extend(cells.iter().map(von_mises));
            fields.cell_stress.extend(cells);
        }
    }
    for (mises, (sum, count)) in fields.node_mises.iter_mut().zip(sums).filter(|(_, s)| s.1 > 0.0) {
        *mises = von_mises(&sum.map(|s| s / count));
    }
    fields
}

fn plastic_strain<const D: usize>(block: &CellBlock<D>) -> Option<Vec<f64>> {
    match block {
        CellBlock::Linear(_) => None,
        CellBlock::Nonlinear(block) => block.cell_plastic_strain(),
    }
}

/// Stress at the nodes of a block: mean of the adjacent cells, weighted by volume if the block is linear.
fn nodal_stress<const D: usize>(
    plan: &Plan<D>,
    block: &CellBlock<D>,
    (index, stresses): (usize, &[[f64; 6]]),
    u: &[f64],
) -> Vec<(usize, [f64; 6])> {
    if let CellBlock::Linear(block) = block {
        return block.nodal_stress(&plan.problem.model.mesh, u);
    }
    let cells = &plan.problem.model.mesh.blocks[index];
    let mut sums: BTreeMap<usize, ([f64; 6], f64)> = BTreeMap::new();
    for (cell, stress) in stresses.iter().enumerate() {
        for &node in cells.cell(cell) {
            let (sum, count) = sums.entry(node).or_default();
            sum.iter_mut().zip(stress).for_each(|(a, b)| *a += b);
            *count += 1.0;
        }
    }
    sums.into_iter().map(|(node, (sum, count))| (node, sum.map(|s| s / count))).collect()
}
