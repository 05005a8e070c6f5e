//! Interfaces of a scene, checked and converted to those of a plan.

use super::enforcement::{enforced, in_pascal_per_metre};
use super::friction::Friction;
use super::penalty::{self, SofterCells};
use super::surfaces::FacingSurfaces;
use super::watch::{self, Resistance};
use super::{PlannedInterface, cohesive, damping, initial_tractions};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Interface as InterfaceSpec, Measure, Scene, Sliding};
use crate::shared::entry::Entry;
use crate::shared::model::Model;
use asperity_contact::{self as contact, Watch};
use asperity_fem::mesh::{Side, face_kind, nodes_of_sides};
use asperity_mechanics::{self as mechanics, coordinates};

/// Fraction of the largest tributary area of an interface below which an area is zero to within rounding.
const NO_AREA: f64 = 1e-12;

/// Plans an interface with its friction; `loading` is the largest rate that the stages prescribe \[m/s\].
///
/// # Errors
/// [`Diagnostic`] with the position in the scene.
pub fn plan<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    own: Entry<'_, InterfaceSpec>,
    loading: f64,
) -> Result<(PlannedInterface, Option<Friction>), Diagnostic> {
    let Entry { name, spec } = own;
    if model.idealisation.components() != D {
        return Err(Diagnostic::at(
            spec.slave.span(),
            format!("interface `{name}`: there are no interfaces between bodies in antiplane motion"),
            "interfaces exist with \"plane-strain\", \"plane-stress\", \"axisymmetric\" and \"3d\", and friction without \
             bodies as `kinematics = \"spring-slider\"`; in antiplane motion bodies have conditions on their sets",
        ));
    }
    let surfaces = FacingSurfaces::find(model, own)?;
    check_faces(model, spec, &surfaces)?;
    let slave = slave_points(model, own, &surfaces)?;
    if slave.is_empty() {
        return Err(Diagnostic::at(
            spec.master.span(),
            format!("the two sides of interface `{name}` are the same nodes"),
            "an interface lies between two sides that can separate; `split` in a mesh makes them",
        ));
    }
    let nodes: Vec<usize> = slave.iter().map(|point| point.0).collect();
    let damping = damping::radiation(scene, model, own, &surfaces)?;
    let friction = Friction::choose(scene, model, own, &nodes)?;
    let (law, watch) = match spec.law.as_ref().zip(friction.as_ref()) {
        Some((law, friction)) => {
            let resistance = Resistance { laws: friction.laws(), damping };
            let watch = watch::limits(scene, model, &surfaces, resistance, loading)?;
            (Some(friction.build(law)?), watch)
        }
        None => (None, Watch::default()),
    };
    let shortest = cohesive::shortest(model, &surfaces, &nodes, friction.as_ref());
    let resolved = shortest.and_then(|[zone, _]| cohesive::resolved(spec, &zone));
    let young_per_size = surfaces.slave.young_per_size(model);
    let enforced = enforced(&spec.enforcement, young_per_size, surfaces.slave.cell_size(model));
    let softer = SofterCells::from_sides(model, &surfaces);
    penalty::check(name, spec, &softer)?;
    let planned = PlannedInterface {
        name: name.to_string(),
        young_per_size: softer.young_per_size,
        enforced,
        unknowns: enforced.unknowns(slave.len(), if law.is_some() { D } else { 1 }),
        slave,
        slave_faces: surfaces.slave.faces(model),
        master_faces: surfaces.masters.iter().flat_map(|master| master.faces(model)).collect(),
        measure: match spec.measure.get_ref() {
            Measure::NodeToPoint => mechanics::Measure::NodeToPoint,
            Measure::Mortar => mechanics::Measure::Mortar,
        },
        sliding: match spec.sliding.get_ref() {
            Sliding::Small => contact::Sliding::Small,
            Sliding::Finite => contact::Sliding::Finite,
        },
        smoothed: spec.smoothing.is_some(),
        normal_penalty: in_pascal_per_metre(&spec.enforcement.normal, young_per_size),
        tangential_penalty: (spec.enforcement.tangential.as_ref())
            .map_or(0.0, |t| in_pascal_per_metre(t, young_per_size)),
        law,
        damping,
        blamed: penalty::blamed(name, &spec.enforcement, &softer),
        pressed: initial_tractions::initial_tractions(scene, model, own, &surfaces)?,
        shift: None,
        mirrors: Vec::new(),
        watch: Watch { coarse_beyond: resolved.as_ref().and_then(|r| r.refused_beyond), ..watch },
        resolved,
        probes: scene.output.probes.get(name).map_or(0, |p| *p.get_ref()),
    };
    Ok((planned, friction))
}

/// Slave points of an interface, ascending, with their tributary areas.
fn slave_points<const D: usize>(
    model: &Model<D>,
    Entry { name, spec }: Entry<'_, InterfaceSpec>,
    surfaces: &FacingSurfaces<'_, D>,
) -> Result<Vec<(usize, f64)>, Diagnostic> {
    let slave = surfaces.slave.sides;
    // The tip of a split surface lies on both sides, which cannot separate there.
    let master_nodes = nodes_of_sides(&model.mesh, &surfaces.master_sides());
    let nodes =
        nodes_of_sides(&model.mesh, slave).into_iter().filter(|n| master_nodes.binary_search(n).is_err());
    if *spec.measure.get_ref() == Measure::Mortar {
        return Ok(nodes.map(|n| (n, 1.0)).collect());
    }
    let areas = model.tributary_areas(slave).map_err(|e| {
        let help = format!("{} first order or hex27 there", instead(spec, "use elements of"));
        Diagnostic::at(spec.slave.span(), e.to_string(), help)
    })?;
    let slave: Vec<(usize, f64)> = nodes.map(|n| (n, areas[&n])).collect();
    let largest = slave.iter().map(|s| s.1).fold(0.0, f64::max);
    if let Some((node, _)) = slave.iter().find(|s| s.1 <= NO_AREA * largest) {
        return Err(Diagnostic::at(
            spec.slave.span(),
            format!(
                "the slave node at {} of interface `{name}` has no tributary area",
                coordinates::in_words(&model.mesh.nodes[*node])
            ),
            format!(
                "elements of second order have none on the axis of revolution: {} quad4 or tri3",
                instead(spec, "use")
            ),
        ));
    }
    Ok(slave)
}

/// Mortar in the place of node-to-point where slave nodes need areas, and the beginning of the alternative to it.
fn instead(spec: &InterfaceSpec, other: &str) -> String {
    let flat = if spec.smoothing.is_some() { " without `smoothing`" } else { "" };
    format!("use `measure = \"mortar\"`{flat}, or {other}")
}

/// Checks that the contact measure supports the faces of both sides.
fn check_faces<const D: usize>(
    model: &Model<D>,
    spec: &InterfaceSpec,
    surfaces: &FacingSurfaces<'_, D>,
) -> Result<(), Diagnostic> {
    let (slave, master) = (surfaces.slave.sides, surfaces.master_sides());
    let linear = |side: &Side| face_kind(&model.mesh, side).first_order();
    if let Some(smoothing) = &spec.smoothing
        && let Some(side) = master.iter().find(|s| !linear(s))
    {
        let element = model.mesh.blocks[side.block].kind.name();
        return Err(Diagnostic::at(
            smoothing.span(),
            format!("smoothing needs master faces of first order, but the master has faces of {element}"),
            "faces of second order are curved already: leave `smoothing` out",
        ));
    }
    if let Some(smoothing) = &spec.smoothing
        && *spec.measure.get_ref() == Measure::Mortar
    {
        return Err(Diagnostic::at(
            smoothing.span(),
            "smoothing is a property of node-to-point; mortar integrates over the facets themselves",
            "leave `smoothing` out",
        ));
    }
    let both = slave.iter().filter(|s| master.contains(s)).count();
    if both > 0 {
        return Err(Diagnostic::at(
            spec.master.span(),
            format!(
                "{both} faces are slave and master at once: a surface in contact with itself is not supported"
            ),
            "declare the parts that meet as two sets without common faces",
        ));
    }
    Ok(())
}
