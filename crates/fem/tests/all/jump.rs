//! Jumps as degrees of freedom compared with the equivalent split body.

use asperity_fem::block::LinearBlock;
use asperity_fem::condense::{CondensedBody, Reduction, Stiffness};
use asperity_fem::dof::Channel;
use asperity_fem::element::ElementKind;
use asperity_fem::jump::{Jump, Jumps, ObliqueConstraint};
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::fault::{FaultMesh, Interpolation, Spacing, SplitMesh};
use asperity_fem::mesh::nodes_of_sides;
use asperity_fem::table::Table;
use asperity_fem::term::Linearized;
use nalgebra::{DMatrix, DVector};

fn body(dip: f64) -> (SplitMesh, Stiffness) {
    let (s, c) = dip.to_radians().sin_cos();
    let made = FaultMesh {
        trace: vec![[0.0, 0.0], [-2.0 * c, -2.0 * s]],
        interpolation: Interpolation::Spline,
        spacing: Spacing::Constant(0.5),
        thickness: None,
        min: [-4.0, -3.0],
        max: [4.0, 0.0],
        growth: 2.0,
        kind: ElementKind::Quad4,
    }
    .mesh()
    .unwrap();
    let rock = Elastic::new(3.0, 0.25).unwrap();
    let block =
        LinearBlock::new(&made.mesh, 0, &rock, Idealisation::PlaneStrain, Formulation::Standard).unwrap();
    let stiffness = Stiffness {
        pattern: block.pattern().clone(),
        values: block.stiffness().to_vec(),
        dofs: 2 * made.mesh.nodes.len(),
    };
    (made, stiffness)
}

fn jumps(made: &SplitMesh, dip: f64) -> Jumps<2> {
    let (s, c) = dip.to_radians().sin_cos();
    // Axes along the fault upwards, and from minus (smaller x) to plus.
    let frame = [[c, s], [s, -c]];
    Jumps::new(
        made.fault.pairs.iter().map(|p| Jump { minus: 2 * p.minus, plus: 2 * p.plus, frame }).collect(),
    )
}

fn dense(body: &Stiffness) -> DMatrix<f64> {
    let mut k = DMatrix::zeros(body.dofs, body.dofs);
    let mut offset = 0;
    for block in body.pattern.blocks() {
        for (i, &r) in block.iter().enumerate() {
            for (j, &c) in block.iter().enumerate() {
                k[(r, c)] += body.values[offset + i * block.len() + j];
            }
        }
        offset += block.len() * block.len();
    }
    k
}

/// A field that differs at every degree of freedom.
fn field(n: usize) -> DVector<f64> {
    DVector::from_fn(n, |i, _| ((i * i + 3 * i) % 17) as f64 / 17.0 - 0.4)
}

#[test]
fn energy_is_that_of_the_split_body() {
    for dip in [90.0, 60.0, 130.0] {
        let (made, split) = body(dip);
        let jumps = jumps(&made, dip);
        let v = field(split.dofs);
        let mut u = v.as_slice().to_vec();
        jumps.displacement(&mut u);
        let u = DVector::from_vec(u);
        let (k, t) = (dense(&split), dense(&jumps.stiffness(&split)));
        let (a, b) = ((&u.transpose() * &k * &u)[0], (&v.transpose() * &t * &v)[0]);
        approx::assert_relative_eq!(a, b, max_relative = 1e-13);
        assert!((&t - t.transpose()).amax() < 1e-14 * t.amax(), "symmetric");
    }
}

/// A linear combination of displacements, and its value.
type Constraint = (Vec<(usize, f64)>, f64);

/// Displacements of a body under forces with constraints, followed by their Lagrange multipliers.
fn constrained(body: &Stiffness, constraints: &[Constraint], forces: &[(usize, f64)]) -> DVector<f64> {
    let (n, m) = (body.dofs, constraints.len());
    let mut full = DMatrix::zeros(n + m, n + m);
    full.view_mut((0, 0), (n, n)).copy_from(&dense(body));
    let mut rhs = DVector::zeros(n + m);
    for &(d, f) in forces {
        rhs[d] += f;
    }
    for (r, (row, value)) in constraints.iter().enumerate() {
        rhs[n + r] = *value;
        for &(d, v) in row {
            full[(n + r, d)] += v;
            full[(d, n + r)] += v;
        }
    }
    full.lu().solve(&rhs).unwrap()
}

/// Condensed jumps: the forces on them and the displacement of the whole body, for given jumps without opening, must be those
/// of the split body with the same jumps by Lagrange multipliers.
#[test]
fn condensed_jumps_answer_as_the_split_body_does() {
    let (made, split) = body(60.0);
    let jumps = jumps(&made, 60.0);
    let bottom = nodes_of_sides(&made.mesh, &made.mesh.side_sets["bottom"]);
    let held: Vec<usize> = bottom.iter().flat_map(|&n| [2 * n, 2 * n + 1]).collect();
    let mut retained: Vec<usize> = jumps.list().iter().map(|j| j.plus).collect();
    retained.sort_unstable();
    let mut fixed: Vec<usize> = jumps.fixed(&held).unwrap();
    fixed.extend(jumps.list().iter().map(|j| j.plus + 1));
    fixed.sort_unstable();
    let reduction = Reduction::new(&jumps.stiffness(&split), &retained, &fixed).unwrap();
    let mut condensed =
        CondensedBody::new("body".into(), reduction, &(0..retained.len()).collect::<Vec<_>>());
    let load = Channel {
        prescribed: held.iter().map(|&d| (d, 0.1 + d as f64 * 1e-3)).collect(),
        forces: vec![(2 * made.fault.pairs[1].plus, 0.3), (5, -0.2)],
        amplitude: Table::constant(1.0),
    };
    condensed.set_channels(vec![jumps.channel(&load, &held).unwrap()]);
    let s: Vec<f64> = field(retained.len()).as_slice().to_vec();
    let mut u = condensed.recover(&s, 0.0);
    jumps.displacement(&mut u);
    // The split body with multipliers on the jumps and on the supports.
    let n = split.dofs;
    let rows: Vec<Constraint> = held
        .iter()
        .zip(&load.prescribed)
        .map(|(&d, p)| (vec![(d, 1.0)], p.1))
        .chain(jumps.list().iter().flat_map(|j| {
            (0..2).map(|k| {
                let value = if k == 0 { s[retained.binary_search(&j.plus).unwrap()] } else { 0.0 };
                let row = (0..2).flat_map(|c| [(j.plus + c, j.frame[k][c]), (j.minus + c, -j.frame[k][c])]);
                (row.collect(), value)
            })
        }))
        .collect();
    let exact = constrained(&split, &rows, &load.forces);
    for d in 0..n {
        approx::assert_relative_eq!(u[d], exact[d], epsilon = 1e-12 * exact.amax());
    }
    // The multiplier of a jump is minus the force that holds it.
    let schur = condensed.reduction().schur();
    let (_, offset) = condensed.channels().next().unwrap();
    for (r, j) in jumps.list().iter().enumerate() {
        let row = retained.binary_search(&j.plus).unwrap();
        let force: f64 = (0..s.len()).map(|c| schur[row * s.len() + c] * s[c]).sum::<f64>() + offset[row];
        approx::assert_relative_eq!(force, -exact[n + held.len() + 2 * r], epsilon = 1e-12 * exact.amax());
    }
}

#[test]
fn supports_that_no_jump_can_express_are_refused() {
    let (made, _) = body(60.0);
    let (oblique, upright) = (jumps(&made, 60.0), jumps(&made, 90.0));
    let (minus, plus) = (2 * made.fault.pairs[2].minus, 2 * made.fault.pairs[2].plus);
    let sorted = |mut list: Vec<usize>| {
        list.sort_unstable();
        list
    };
    // A component held on both sides is the opening of an upright fault, but not an axis of an oblique one.
    assert_eq!(upright.fixed(&sorted(vec![minus, plus])).unwrap(), sorted(vec![minus, plus + 1]));
    assert_eq!(oblique.fixed(&sorted(vec![minus, plus])).unwrap_err(), ObliqueConstraint { plus });
    assert_eq!(upright.fixed(&[plus]).unwrap_err(), ObliqueConstraint { plus });
    let all = sorted(vec![minus, minus + 1, plus, plus + 1]);
    assert_eq!(oblique.fixed(&all).unwrap(), all);
}

#[test]
fn components_that_span_axes_of_an_oblique_surface_in_space_hold_its_jump() {
    let (s, c) = 0.7f64.sin_cos();
    let frame = [[s, c, 0.0], [c, -s, 0.0], [0.0, 0.0, 1.0]];
    let jumps = Jumps::<3>::new(vec![Jump { minus: 0, plus: 3, frame }]);
    // x and y on both sides hold opening and slip along the dip; the jump along z stays free.
    assert_eq!(jumps.fixed(&[0, 1, 3, 4]).unwrap(), [0, 1, 3, 4]);
    assert_eq!(jumps.fixed(&[2, 5]).unwrap(), [2, 5]);
    assert_eq!(jumps.fixed(&[0, 3]).unwrap_err(), ObliqueConstraint { plus: 3 });
    // Here one of the held components is oblique to the axes.
    assert_eq!(jumps.fixed(&[0, 2, 3, 5]).unwrap_err(), ObliqueConstraint { plus: 3 });
}
