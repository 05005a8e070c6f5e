//! Condition number of the system of all free degrees of freedom, from its singular values.

use crate::CaseError;
use asperity_contact::{
    Enforcement, Interface, InterfaceSpec, MeasureKind, Segment, SlavePoint, Sliding, SurfaceNode,
};
use asperity_fem::mesh::MeshFace;
use asperity_fem::term::{Instant, Linearized};
use asperity_friction::law::RateBounds;
use asperity_plan::bodies::{self, AnyPlan, Plan, PlannedInterface, interface_nodes};
use asperity_plan::reading::scene::model::{EnforcementKind, Measure};
use nalgebra::DMatrix;

/// Condition number, in the 2-norm, of the tangent in stick on the matching mesh. Uzawa's method has that of the penalty method.
pub fn number(kind: EnforcementKind, factor: f64) -> Result<f64, CaseError> {
    let (scene, _) = super::scene(kind, factor, Measure::NodeToPoint, 4)?;
    let AnyPlan::Two(plan) = bodies::plan(&scene).map_err(|e| e.to_string())? else {
        return Err("the scene is not plane".into());
    };
    let planned = &plan.problem.interfaces[0];
    let n = plan.problem.model.dofs();
    let mut interface = Interface::new(spec(&plan, planned, n)).map_err(|e| e.to_string())?;
    let total = n + planned.unknowns;
    let at = Instant { time: 1.0, dt: 1.0 };
    let mut matrix = DMatrix::<f64>::zeros(total, total);
    let mut blocks = plan.problem.model.blocks.clone();
    let mut terms: Vec<&mut dyn Linearized> = blocks.iter_mut().map(|b| b.linearized()).collect();
    terms.push(&mut interface);
    for term in terms {
        term.residual(&vec![0.0; total], at, &mut vec![0.0; total]).map_err(|e| e.to_string())?;
        let mut values = vec![0.0; term.pattern().values()];
        term.tangent(&mut values);
        let mut at = 0;
        for block in term.pattern().blocks() {
            for &i in block {
                for &j in block {
                    matrix[(i, j)] += values[at];
                    at += 1;
                }
            }
        }
    }
    let fixed = &plan.problem.stages[0].fixed;
    let free: Vec<usize> = (0..total).filter(|d| fixed.binary_search(d).is_err()).collect();
    let singular = matrix.select_rows(&free).select_columns(&free).singular_values();
    Ok(singular.max() / singular.min())
}

/// Specification of the planned interface on all degrees of freedom.
fn spec(plan: &Plan<2>, planned: &PlannedInterface, unknowns: usize) -> InterfaceSpec<2> {
    let labels = interface_nodes(planned);
    let local = |node: usize| labels.partition_point(|&n| n < node);
    let node = |&n: &usize| SurfaceNode { position: plan.problem.model.mesh.nodes[n], dof: 2 * n, label: n };
    let segment =
        |face: &MeshFace| Segment { kind: face.kind, nodes: face.nodes.iter().map(|&n| local(n)).collect() };
    InterfaceSpec {
        name: planned.name.clone(),
        nodes: labels.iter().map(node).collect(),
        slave: planned.slave.iter().map(|&(n, area)| SlavePoint { node: local(n), area }).collect(),
        master: planned.master_faces.iter().map(segment).collect(),
        measure: MeasureKind::NodeToPoint,
        sliding: Sliding::Small,
        smoothing: None,
        fixed_normal: None,
        enforcement: match planned.enforced.declared(unknowns) {
            Enforcement::Uzawa { .. } => Enforcement::Penalty,
            other => other,
        },
        normal_penalty: planned.normal_penalty,
        tangential_penalty: planned.tangential_penalty,
        young_per_size: planned.young_per_size,
        law: planned.law.clone(),
        scale: plan.problem.model.scale,
        rate_floor: 0.0,
        rate_bounds: RateBounds { zeta: f64::INFINITY, log_rate: f64::INFINITY },
        label_rate: None,
    }
}
