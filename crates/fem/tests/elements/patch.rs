//! Linear fields, with Standard and B-bar, on irregular meshes.

use super::common::{Field, Shape, formulations, idealisations, material, mesh, solve};
use asperity_fem::block::LinearBlock;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;

const GRADIENT: [[f64; 3]; 3] = [[0.02, 0.011, -0.007], [-0.004, 0.015, 0.006], [0.003, -0.009, 0.012]];

/// Scale of strains in [`GRADIENT`]; the displacement is of order 0.1.
const STRAIN: f64 = 0.02;

/// u = 0.1 + H x. About an axis u_r = a r, u_z = b z + c r + d, the linear fields without a singular hoop strain. The shear G c
/// is held by the body force -G c/r along z.
struct Linear {
    gradient: [[f64; 3]; 3],
    shift: [f64; 3],
    /// G c.
    shear: f64,
}

impl<const D: usize> Field<D> for Linear {
    fn value(&self, x: &[f64; D]) -> [f64; 3] {
        std::array::from_fn(|i| self.shift[i] + (0..D).map(|j| self.gradient[i][j] * x[j]).sum::<f64>())
    }

    fn gradient(&self, _x: &[f64; D]) -> [[f64; 3]; 3] {
        self.gradient
    }

    fn force(&self, x: &[f64; D]) -> [f64; 3] {
        [0.0, if self.shear == 0.0 { 0.0 } else { -self.shear / x[0] }, 0.0]
    }
}

fn linear(space: Idealisation, shear: f64) -> Linear {
    let mut field = Linear { gradient: GRADIENT, shift: [0.1; 3], shear: 0.0 };
    if space == Idealisation::Axisymmetric {
        field.gradient[0][1] = 0.0;
        field.shift[0] = 0.0;
        field.shear = shear * GRADIENT[1][0];
    }
    field
}

/// Displacement gradient in three dimensions.
fn full(space: Idealisation, poisson: f64) -> [[f64; 3]; 3] {
    let g = GRADIENT;
    match space {
        Idealisation::ThreeD => g,
        Idealisation::PlaneStrain => [[g[0][0], g[0][1], 0.0], [g[1][0], g[1][1], 0.0], [0.0; 3]],
        Idealisation::PlaneStress => {
            let zz = -poisson / (1.0 - poisson) * (g[0][0] + g[1][1]);
            [[g[0][0], g[0][1], 0.0], [g[1][0], g[1][1], 0.0], [0.0, 0.0, zz]]
        }
        Idealisation::Axisymmetric => [[g[0][0], 0.0, 0.0], [g[1][0], g[1][1], 0.0], [0.0, 0.0, g[0][0]]],
        Idealisation::Antiplane => [[0.0; 3], [0.0; 3], [g[0][0], g[0][1], 0.0]],
    }
}

fn patch<const D: usize>(kind: ElementKind, space: Idealisation, lower: [f64; D]) {
    for formulation in formulations(kind, space) {
        let name = format!("{} {} {}", kind.name(), space.name(), formulation.name());
        let material = material(0.3);
        let mesh = mesh::<D>(kind, lower, 3, Shape::Crooked);
        let block = LinearBlock::new(&mesh, 0, &material, space, formulation).unwrap();
        let field = linear(space, material.shear());
        let u = solve(&mesh, &block, &field);
        let components = space.components();
        for (n, x) in mesh.nodes.iter().enumerate() {
            for (c, value) in field.value(x).into_iter().enumerate().take(components) {
                assert!((u[n * components + c] - value).abs() < 1e-12 * 0.1, "{name} node {n}");
            }
        }
        let h = full(space, material.poisson());
        let (stress, strain) = (block.stress_at_points(&u), block.strain_at_points(&u));
        for (stress, strain) in stress.iter().zip(strain) {
            for (s, e) in stress.iter().zip(material.stress(&h)) {
                assert!((s - e).abs() < 1e-12 * STRAIN * 2.5, "{name}: {s} {e}");
            }
            for (s, (i, j)) in strain.iter().zip([(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)]) {
                let exact = 0.5 * (h[i][j] + h[j][i]);
                assert!((s - exact).abs() < 1e-12 * STRAIN, "{name}: {s} {exact}");
            }
        }
    }
}

#[test]
fn every_element_passes_the_patch_test_in_every_idealisation_and_formulation() {
    for kind in ElementKind::ALL {
        for space in idealisations(kind) {
            match kind.dimension() {
                2 => patch::<2>(kind, space, [0.5, -0.3]),
                _ => patch::<3>(kind, space, [0.5, -0.3, 0.1]),
            }
        }
    }
}

#[test]
fn the_patch_test_holds_at_the_axis_of_revolution() {
    for kind in ElementKind::ALL.into_iter().filter(|k| k.dimension() == 2) {
        patch::<2>(kind, Idealisation::Axisymmetric, [0.0, -0.3]);
    }
}
