//! Patch test and zero-energy modes of every element, idealisation and formulation.

use super::bodies::{self, Body, Field, Shape};
use crate::cases::body_plots;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity_fem::block::{FieldValue, LinearBlock};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::Mesh;
use asperity_fem::term::Linearized;
use nalgebra::{DMatrix, DVector};

/// See the README.
pub const CASE: Case = Case {
    name: "bodies_patch",
    readme: include_str!("README.md"),
    covers: &[
        Capability::PlaneStrain,
        Capability::PlaneStress,
        Capability::Axisymmetric,
        Capability::Antiplane,
        Capability::Solid3d,
    ],
    quick: true,
    run,
};

/// Capability that an element covers.
pub fn capability(kind: ElementKind) -> Capability {
    match kind {
        ElementKind::Tri3 | ElementKind::Tri6 => Capability::Triangles,
        ElementKind::Quad4 | ElementKind::Quad9 => Capability::Quadrilaterals,
        ElementKind::Quad8 | ElementKind::Hex20 => Capability::Serendipity,
        ElementKind::Tet4 | ElementKind::Hex8 => Capability::Solids,
        ElementKind::Tet10 | ElementKind::Hex27 => Capability::QuadraticSolids,
        ElementKind::Wedge6 | ElementKind::Wedge15 => Capability::Wedges,
    }
}

/// Idealisations and formulations of an element.
pub fn variants(kind: ElementKind) -> impl Iterator<Item = (Idealisation, Formulation)> {
    Idealisation::ALL
        .into_iter()
        .filter(move |space| space.dimension() == kind.dimension())
        .flat_map(|space| Formulation::ALL.map(|formulation| (space, formulation)))
        .filter(move |(space, formulation)| formulation.dilatation(kind, *space).is_ok())
}

const GRADIENT: [[f64; 3]; 3] = [[0.02, 0.011, -0.007], [-0.004, 0.015, 0.006], [0.003, -0.009, 0.012]];

/// Approximate largest displacement of the patch \[m\] and strain of [`GRADIENT`].
const SCALES: [f64; 2] = [0.1, 0.02];

/// u = s + H x.
struct Linear {
    gradient: [[f64; 3]; 3],
    shift: [f64; 3],
    /// G times the shear ∂u_z/∂r about an axis, 0 elsewhere.
    shear: f64,
}

impl Linear {
    fn new(space: Idealisation, material: &Elastic) -> Self {
        let mut field = Self { gradient: GRADIENT, shift: [0.1; 3], shear: 0.0 };
        if space == Idealisation::Axisymmetric {
            field.gradient[0][1] = 0.0;
            field.shift[0] = 0.0;
            field.shear = material.shear() * GRADIENT[1][0];
        }
        field
    }
}

impl<const D: usize> Field<D> for Linear {
    fn at(&self, x: &[f64; D]) -> FieldValue {
        let value = |i: usize| (0..D).map(|j| self.gradient[i][j] * x[j]).sum::<f64>();
        (std::array::from_fn(|i| self.shift[i] + value(i)), self.gradient)
    }

    fn force(&self, x: &[f64; D]) -> [f64; 3] {
        [0.0, if self.shear == 0.0 { 0.0 } else { -self.shear / x[0] }, 0.0]
    }
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for kind in ElementKind::ALL {
        if kind.dimension() == 2 {
            element::<2>(ledger, kind, [0.5, -0.3])?;
        } else {
            element::<3>(ledger, kind, [0.5, -0.3, 0.1])?;
        }
    }
    let material = Elastic::new(2.5, 0.3)?;
    let field = Linear::new(Idealisation::PlaneStrain, &material);
    let mesh = bodies::distorted(ElementKind::Quad9, 3, Shape::Crooked, [0.5, -0.3])?;
    let body = Body::new(mesh, &material, Idealisation::PlaneStrain, Formulation::Standard)?.hold_all(&field);
    body_plots::displacement(ledger, "Linear field, quad9", &body.mesh, &body.solve()?.u, false)
}

fn element<const D: usize>(ledger: &mut Ledger, kind: ElementKind, lower: [f64; D]) -> Result<(), CaseError> {
    let material = Elastic::new(2.5, 0.3)?;
    let mut covers: Vec<Capability> = vec![capability(kind)];
    covers.extend(if D == 2 { &CASE.covers[..4] } else { &CASE.covers[4..] });
    let count = variants(kind).count();
    let (worst, cost) = Cost::measure(|| {
        variants(kind).try_fold(0.0_f64, |worst, variant| {
            Ok::<_, CaseError>(worst.max(patch(kind, &material, variant, lower)?))
        })
    });
    ledger
        .claim(format!("patch test, {}, {count} idealisations and formulations", kind.name()))
        .norm("largest error of a nodal displacement and of a stress at a quadrature point, relative")
        .value(worst?)
        .at_most(1e-12)
        .evidence(Evidence::Exact, "linear field")
        .because("the field lies in every space: rounding of some hundred unknowns, conditioned like (1/h)^2")
        .why_not_tighter("one bound serves all elements; that of 1e-12 is the suite's for patch tests")
        .covers(&covers)
        .cost(&cost.count("patches", count as f64))
        .record();
    for (n, patch) in [(1, "a single element"), (2, "two elements an axis")] {
        let (found, cost) = Cost::measure(|| {
            variants(kind).map(|v| spectrum(kind, &material, v, n, lower)).collect::<Result<Vec<_>, _>>()
        });
        let found = found?;
        let expected: Vec<f64> = variants(kind).map(|(space, _)| space.rigid_motions() as f64).collect();
        let motions: Vec<f64> = found.iter().map(|f| f.0 as f64).collect();
        ledger
            .claim(format!("motions without energy of {patch}, {}", kind.name()))
            .norm("each idealisation and formulation")
            .values(&motions)
            .equals_each(&expected)
            .absolute(0.5)
            .evidence(Evidence::Exact, "rigid motions of a connected body")
            .because("whole numbers; an eigenvalue below 1e-9 of the largest counts as none")
            .why_not_tighter("the numbers agree exactly")
            .covers(&covers)
            .cost(&cost)
            .record();
        ledger
            .claim(format!("forces of rigid motions of {patch}, {}", kind.name()))
            .norm("largest, relative to the largest eigenvalue")
            .value(found.iter().map(|f| f.1).fold(0.0, f64::max))
            .at_most(1e-13)
            .evidence(Evidence::Exact, "rigid motions have no strain")
            .because(
                "sums over at most 81 products of entries and positions of order one: 81 * 2.2e-16 = 2e-14",
            )
            .why_not_tighter("signs of rounding differ, so that sums stay below their bound")
            .covers(&covers)
            .cost(&cost)
            .record();
    }
    Ok(())
}

/// Largest relative error of displacement and stress.
fn patch<const D: usize>(
    kind: ElementKind,
    material: &Elastic,
    (space, formulation): (Idealisation, Formulation),
    lower: [f64; D],
) -> Result<f64, CaseError> {
    let field = Linear::new(space, material);
    let mesh = bodies::distorted(kind, 3, Shape::Crooked, lower)?;
    let body = Body::new(mesh, material, space, formulation)?.hold_all(&field).weigh(&field);
    let solved = body.solve()?;
    let displacement =
        solved.u.iter().zip(body.nodal(&field)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    // The stress is uniform: any point will do.
    let exact = bodies::stress(material, space, &lower, Field::<D>::at(&field, &lower));
    let stress = body.block.stress_at_points(&solved.u).into_iter().flat_map(|s| {
        let differences: [f64; 6] = std::array::from_fn(|k| (s[k] - exact[k]).abs());
        differences
    });
    let stress = stress.fold(0.0, f64::max);
    Ok((displacement / SCALES[0]).max(stress / (material.young() * SCALES[1])))
}

/// Number of eigenvalues that are zero, and the largest force of a rigid motion over the largest eigenvalue.
fn spectrum<const D: usize>(
    kind: ElementKind,
    material: &Elastic,
    (space, formulation): (Idealisation, Formulation),
    n: usize,
    lower: [f64; D],
) -> Result<(usize, f64), CaseError> {
    let mut mesh = bodies::distorted(kind, 2, Shape::Crooked, lower)?;
    if n == 1 {
        mesh = single(&mesh);
    }
    let block = LinearBlock::new(&mesh, 0, material, space, formulation)?;
    let dofs = mesh.nodes.len() * space.components();
    let mut k = DMatrix::<f64>::zeros(dofs, dofs);
    let mut values = block.stiffness().iter();
    for cell in block.pattern().blocks() {
        for (&i, &j) in cell.iter().flat_map(|i| cell.iter().map(move |j| (i, j))) {
            k[(i, j)] += values.next().ok_or("the stiffness has fewer values than its pattern")?;
        }
    }
    let eigen = k.clone().symmetric_eigenvalues();
    let largest = eigen.max();
    let zero = eigen.iter().filter(|e| e.abs() < 1e-9 * largest).count();
    let forces = (0..space.rigid_motions()).map(|mode| {
        let u = mesh.nodes.iter().flat_map(|x| rigid(space, x, mode)[..space.components()].to_vec());
        (&k * DVector::from_iterator(dofs, u)).amax() / largest
    });
    Ok((zero, forces.fold(0.0, f64::max)))
}

/// Mesh of the first cell only.
fn single<const D: usize>(mesh: &Mesh<D>) -> Mesh<D> {
    let mut cells = mesh.blocks[0].clone();
    let nodes = cells.cell(0).iter().map(|&n| mesh.nodes[n]).collect();
    cells.connectivity = (0..cells.kind.nodes()).collect();
    Mesh { nodes, blocks: vec![cells], ..Mesh::default() }
}

/// Rigid motion number `mode`.
fn rigid<const D: usize>(space: Idealisation, x: &[f64; D], mode: usize) -> [f64; 3] {
    let unit = |c: usize| std::array::from_fn(|k| if k == c { 1.0 } else { 0.0 });
    match (space, mode) {
        (Idealisation::Antiplane, _) => unit(0),
        (Idealisation::Axisymmetric, _) => unit(1),
        (Idealisation::ThreeD, 0..3) => unit(mode),
        (Idealisation::ThreeD, _) => {
            let mut u = [0.0; 3];
            let (i, j) = ((mode + 1) % 3, (mode + 2) % 3);
            (u[i], u[j]) = (-x[j], x[i]);
            u
        }
        (_, 0..2) => unit(mode),
        _ => [-x[1], x[0], 0.0],
    }
}
