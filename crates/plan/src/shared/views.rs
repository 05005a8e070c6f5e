//! Models, points, sets, springs and energies in the form passed to observers.

use asperity_fem::kinematics::Idealisation;
use asperity_mechanics as mechanics;
use asperity_mechanics::{ForceSet, Model, Point, Spring, SpringState, Stage};
use asperity_output::bodies::view::{
    ForceMark, MeshView, PointMark, PointValues, Samples, SpringMark, SpringValues,
};
use asperity_output::fields::vtu::Cell;

/// Pads a vector to three components.
pub fn padded<const D: usize>(v: &[f64; D]) -> [f64; 3] {
    std::array::from_fn(|c| if c < D { v[c] } else { 0.0 })
}

/// The mesh of a model; `moves` as in [`MeshView::moves`].
#[must_use]
pub fn mesh_view<const D: usize>(model: &Model<D>, moves: bool) -> MeshView {
    let mesh = &model.mesh;
    let mut cells = Vec::new();
    let mut cell_body = Vec::new();
    for (index, body) in model.bodies.iter().enumerate() {
        for block in &mesh.blocks[body.blocks.clone()] {
            for cell in block.connectivity.chunks_exact(block.kind.nodes()) {
                cells.push(Cell::new(block.kind.vtk_type(), cell.to_vec()));
                cell_body.push(index);
            }
        }
    }
    MeshView {
        nodes: mesh.nodes.iter().map(padded).collect(),
        cells,
        cell_body,
        bodies: model.bodies.iter().map(|b| b.name.clone()).collect(),
        dimension: D,
        moves,
    }
}

/// A point in the form passed to observers.
#[must_use]
pub fn point_mark(point: &Point) -> PointMark {
    let mut position = [0.0; 3];
    position.iter_mut().zip(&point.position).for_each(|(p, x)| *p = *x);
    PointMark { name: point.name.clone(), body: point.body.clone(), position }
}

/// A set in the form passed to observers.
#[must_use]
pub fn force_mark(force: &ForceSet) -> ForceMark {
    ForceMark { name: force.name.clone(), set: force.set.clone() }
}

/// A spring in the form passed to observers.
#[must_use]
pub fn spring_mark(spring: &Spring) -> SpringMark {
    SpringMark { set: spring.set.clone(), axis: ["x", "y", "z"][spring.axis].to_string() }
}

/// Springs of all stages, each set and axis once.
#[must_use]
pub fn spring_marks(stages: &[Stage]) -> Vec<SpringMark> {
    let mut marks = Vec::new();
    for mark in stages.iter().flat_map(|s| &s.springs).map(spring_mark) {
        if !marks.contains(&mark) {
            marks.push(mark);
        }
    }
    marks
}

/// Springs of a stage in the order of [`spring_marks`]; `normal` is the sum of the normal forces on all interfaces \[N; N/m\].
#[must_use]
pub fn springs(
    stages: &[Stage],
    stage: &Stage,
    now: &[SpringState],
    normal: f64,
) -> Vec<Option<SpringValues>> {
    let here: Vec<SpringMark> = stage.springs.iter().map(spring_mark).collect();
    let values = |s: &SpringState| SpringValues {
        load_point: s.load_point,
        displacement: s.displacement,
        force: s.force,
        friction: if normal > 0.0 { s.force.abs() / normal } else { 0.0 },
    };
    let of = |mark: SpringMark| here.iter().position(|m| *m == mark).and_then(|k| now.get(k)).map(values);
    spring_marks(stages).into_iter().map(of).collect()
}

/// Unit of energies.
#[must_use]
pub fn energy_unit(idealisation: Idealisation) -> &'static str {
    if per_length(idealisation) { "J/m" } else { "J" }
}

/// Unit of forces; bodies in plane strain and antiplane motion have forces per metre of thickness.
#[must_use]
pub fn force_unit(idealisation: Idealisation) -> &'static str {
    if per_length(idealisation) { "N/m" } else { "N" }
}

/// True if forces and energies are per length out of the plane.
#[must_use]
pub fn per_length(idealisation: Idealisation) -> bool {
    match idealisation {
        Idealisation::PlaneStrain | Idealisation::Antiplane => true,
        Idealisation::PlaneStress | Idealisation::Axisymmetric | Idealisation::ThreeD => false,
    }
}

/// Values at points, forces on sets and springs.
#[must_use]
pub fn samples(samples: mechanics::Samples, springs: Vec<Option<SpringValues>>) -> Samples {
    let point = |p: mechanics::PointValues| PointValues {
        displacement: p.displacement,
        stress: p.stress,
        mises: p.mises,
    };
    Samples { points: samples.points.into_iter().map(point).collect(), forces: samples.forces, springs }
}
