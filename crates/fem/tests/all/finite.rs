//! The updated-Lagrangian block: objectivity, simple shear, volume, rate tangents, limits, refusals.

use crate::lab::{
    AT, Noise, POISSON, SHEAR, YOUNG, elastic, field, j2, mesh, mises, model, newton, product, residual,
    size, standard_solid, swift_j2, tangent,
};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::constitutive::{ConstitutiveLaw, Moduli, Voigt};
use asperity_fem::material::hardening::Hardening;
use asperity_fem::mesh::{Mesh, nodes_of_sides};
use asperity_fem::nonlinear::{Block, Kinematics, Limits, Material, Model};
use asperity_fem::term::{ForwardTerm, Instant, Linearized, Restorable, Term};

const UL: Kinematics = Kinematics::UpdatedLagrangian;
const BULK: f64 = YOUNG / (3.0 * (1.0 - 2.0 * POISSON));

fn hypoelastic() -> Material {
    Material::Elastic(elastic())
}

fn block<const D: usize>(mesh: &Mesh<D>, options: Model) -> Block<D> {
    Block::new(mesh, 0, options).unwrap()
}

fn square(n: usize) -> Mesh<2> {
    mesh(ElementKind::Quad4, [0.0; 2], [1.0; 2], [n, n], 0.2)
}

/// Takes the block through a sequence of displacement fields.
fn follow<const D: usize>(block: &mut Block<D>, mesh: &Mesh<D>, steps: impl Iterator<Item = Vec<f64>>) {
    for u in steps {
        assert_eq!(u.len() % mesh.nodes.len(), 0);
        residual(block, &u);
        block.accept();
    }
}

/// Rotation by the vector w.
fn rotation(w: [f64; 3]) -> nalgebra::Rotation3<f64> {
    nalgebra::Rotation3::new(nalgebra::Vector3::from(w))
}

/// Displacement of a rotation.
fn turned(q: &nalgebra::Rotation3<f64>, x: [f64; 3]) -> [f64; 3] {
    let y = q * nalgebra::Vector3::from(x);
    [y.x - x[0], y.y - x[1], y.z - x[2]]
}

fn voigt(m: &nalgebra::Matrix3<f64>) -> [f64; 6] {
    [m[(0, 0)], m[(1, 1)], m[(2, 2)], m[(0, 1)], m[(1, 2)], m[(2, 0)]]
}

fn matrix(s: &[f64; 6]) -> nalgebra::Matrix3<f64> {
    nalgebra::Matrix3::new(s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2])
}

#[test]
fn prestress_rotates_with_the_body_to_rounding_in_steps_of_any_size() {
    let prestress = [0.3, -0.1, 0.2, 0.15, 0.0, 0.0];
    for degrees in [1.0, 7.5, 45.0, 120.0, 170.0] {
        let mesh = square(2);
        let mut block = block(&mesh, model(swift_stiff(), Idealisation::PlaneStrain, UL));
        block.prestress(|_, _| prestress).unwrap();
        let steps = (360.0 / degrees) as usize;
        for k in 1..=steps {
            let angle = (degrees * k as f64).to_radians();
            let q = rotation([0.0, 0.0, angle]);
            let u = field(&mesh, |x| {
                let d = turned(&q, [x[0], x[1], 0.0]);
                [d[0], d[1]]
            });
            follow(&mut block, &mesh, [u].into_iter());
            let exact = voigt(&(q.matrix() * matrix(&prestress) * q.matrix().transpose()));
            for s in block.stress_at_points() {
                // Near half a turn the midpoint configuration shrinks and amplifies rounding.
                let rounding = 2e-13 / (0.5 * degrees).to_radians().cos().powi(2);
                assert!((0..6).all(|i| (s[i] - exact[i]).abs() < rounding), "{degrees} {k}: {s:?} {exact:?}");
            }
        }
    }
    let mesh = mesh::<3>(ElementKind::Hex8, [0.0; 3], [1.0; 3], [2; 3], 0.1);
    let mut block = block(&mesh, model(hypoelastic(), Idealisation::ThreeD, UL));
    block.prestress(|_, _| [0.3, -0.1, 0.2, 0.15, 0.07, -0.2]).unwrap();
    let q = rotation([0.9, -1.1, 0.7]);
    follow(&mut block, &mesh, [field(&mesh, |x| turned(&q, x))].into_iter());
    let exact = voigt(&(q.matrix() * matrix(&[0.3, -0.1, 0.2, 0.15, 0.07, -0.2]) * q.matrix().transpose()));
    assert!(block.stress_at_points().iter().all(|s| (0..6).all(|i| (s[i] - exact[i]).abs() < 1e-14)));
}

/// J2 plasticity that remains elastic under the stresses of the test.
fn swift_stiff() -> Material {
    j2(Hardening::swift(10.0, 0.01, 0.3).unwrap())
}

#[test]
fn a_superposed_rotation_turns_forces_and_changes_nothing_else() {
    let mesh = mesh::<3>(ElementKind::Hex8, [0.0; 3], [1.0; 3], [2, 2, 1], 0.1);
    for (material, formulation) in
        [(swift_j2(), Formulation::Standard), (standard_solid(), Formulation::BBar)]
    {
        let options = Model { formulation, ..model(material, Idealisation::ThreeD, UL) };
        let mut block = block(&mesh, options);
        let u: Vec<f64> = Noise::new(1).vector(mesh.nodes.len() * 3).iter().map(|x| 0.03 * x).collect();
        let forces = residual(&mut block, &u);
        block.accept();
        let q = rotation([0.4, 1.2, -0.8]);
        let mut at = 0;
        let turned: Vec<f64> = mesh
            .nodes
            .iter()
            .flat_map(|x| {
                let here: [f64; 3] = std::array::from_fn(|c| x[c] + u[at + c]);
                at += 3;
                let y = q * nalgebra::Vector3::from(here);
                [y.x - x[0], y.y - x[1], y.z - x[2]]
            })
            .collect();
        // No time passes: nothing relaxes.
        let mut after = vec![0.0; u.len()];
        block.residual(&turned, Instant { time: 1.0, dt: 0.0 }, &mut after).unwrap();
        for (f, g) in forces.chunks_exact(3).zip(after.chunks_exact(3)) {
            let exact = q * nalgebra::Vector3::new(f[0], f[1], f[2]);
            assert!((0..3).all(|c| (g[c] - exact[c]).abs() < 1e-14), "{g:?} {exact:?}");
        }
    }
}

/// Simple shear to γ in equal steps; stresses xx, xy over G.
fn shear(material: Material, gamma: f64, steps: usize) -> (f64, f64, f64) {
    let mesh = square(2);
    let mut block = block(&mesh, model(material, Idealisation::PlaneStrain, UL));
    follow(
        &mut block,
        &mesh,
        (1..=steps).map(|k| {
            let g = gamma * k as f64 / steps as f64;
            field(&mesh, |x| [g * x[1], 0.0])
        }),
    );
    let s = block.stress_at_points()[5];
    (s[0] / SHEAR, s[1] / SHEAR, s[3] / SHEAR)
}

#[test]
fn hypoelastic_simple_shear_oscillates_as_the_jaumann_rate_must() {
    // Exact: s_xy = G sin γ, s_xx = -s_yy = G (1 - cos γ).
    for (gamma, xy, xx) in [(1.0_f64, 0.841_471, 0.459_698), (4.0, -0.756_802, 1.653_644)] {
        assert!((gamma.sin() - xy).abs() < 1e-6 && (1.0 - gamma.cos() - xx).abs() < 1e-6);
        let errors = [50, 100, 200].map(|n| {
            let (s_xx, s_yy, s_xy) = shear(hypoelastic(), gamma, n);
            assert!((s_xx + s_yy).abs() < 1e-13);
            ((s_xy - gamma.sin()).powi(2) + (s_xx - 1.0 + gamma.cos()).powi(2)).sqrt()
        });
        let order = (errors[1] / errors[2]).log2();
        assert!((order - 2.0).abs() < 0.05, "γ = {gamma}: {errors:?}, order {order}");
        assert!(errors[2] < 2e-4, "{errors:?}");
    }
}

#[test]
fn perfectly_plastic_simple_shear_tends_to_its_steady_direction() {
    // After yield, z = (s_xx - s_yy)/2 + i s_xy = k exp(i φ) with φ' = -1 + (G/k) cos φ and |z| = k = Y/√3: the stress stops
    // rotating at cos φ = k/G. Before yield z = G (1 - exp(-i γ)).
    let ratio = 0.2_f64;
    let material = || j2(Hardening::perfect(ratio * SHEAR * 3.0_f64.sqrt()).unwrap());
    let first = 2.0 * (0.5 * ratio).asin();
    let exact = |gamma: f64| -> (f64, f64) {
        let mut phi = (first.sin()).atan2(1.0 - first.cos());
        let n = 20_000;
        let h = (gamma - first) / f64::from(n);
        let rate = |phi: f64| -1.0 + phi.cos() / ratio;
        for _ in 0..n {
            let a = rate(phi);
            let b = rate(phi + 0.5 * h * a);
            let c = rate(phi + 0.5 * h * b);
            let d = rate(phi + h * c);
            phi += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
        }
        (ratio * phi.cos(), ratio * phi.sin())
    };
    for gamma in [0.5, 4.0] {
        let (xx, xy) = exact(gamma);
        let errors = [100, 200, 400].map(|n| {
            let s = shear(material(), gamma, n);
            ((s.0 - xx).powi(2) + (s.2 - xy).powi(2)).sqrt() / ratio
        });
        assert!(errors[2] < 6e-3 && errors[2] < errors[0], "γ = {gamma}: {errors:?}");
    }
    let steady = shear(material(), 4.0, 3200);
    assert!((steady.0 - ratio * ratio).abs() < 1e-3 * ratio, "{steady:?}");
    // The return mapping is of first order in the step: the bound is a quarter of Δγ/k over G.
    let exact = ratio * (1.0 - ratio * ratio).sqrt();
    assert!((steady.2 / exact - 1.0).abs() < 0.25 * 4.0 / 3200.0 / ratio, "{steady:?}");
}

#[test]
fn a_change_of_volume_tells_the_kirchhoff_rate_from_the_cauchy_rate() {
    // τ = J σ with τ' = K tr D 1 is τ = K ln J 1: σ = K ln J/J 1. The Jaumann rate of σ would give K ln J 1.
    let stretch = 1.3_f64;
    let mesh = mesh::<3>(ElementKind::Hex8, [0.0; 3], [1.0; 3], [2; 3], 0.1);
    let j = stretch.powi(3);
    let exact = BULK * j.ln() / j;
    let errors = [10, 20, 40].map(|n: usize| {
        let mut block = block(&mesh, model(swift_j2(), Idealisation::ThreeD, UL));
        follow(
            &mut block,
            &mesh,
            (1..=n).map(|k| {
                let s = 0.3 * k as f64 / n as f64;
                field(&mesh, |x| x.map(|c| s * c))
            }),
        );
        let s = block.stress_at_points()[3];
        assert!((s[0] - s[1]).abs() < 1e-13 && s[3].abs() < 1e-13);
        (s[0] - exact).abs()
    });
    let order = (errors[1] / errors[2]).log2();
    assert!((order - 2.0).abs() < 0.02 && errors[2] < 1e-4 * exact, "{errors:?}, order {order}");
    assert!((BULK * j.ln() - exact) > 0.5 * exact, "the two rates are far apart on this path");
    // Plane stress: the thickness follows, τ_xx = E/(1-ν) ln λ, and σ = τ/(λ² exp(-2ν/(1-ν) ln λ)).
    let mesh = square(2);
    let mut block = block(&mesh, model(hypoelastic(), Idealisation::PlaneStress, UL));
    follow(
        &mut block,
        &mesh,
        (1..=200).map(|k| {
            let s = 0.3 * f64::from(k) / 200.0;
            field(&mesh, |x| x.map(|c| s * c))
        }),
    );
    let thickness = -2.0 * POISSON / (1.0 - POISSON) * stretch.ln();
    let exact = YOUNG / (1.0 - POISSON) * stretch.ln() / (stretch * stretch * thickness.exp());
    let s = block.stress_at_points()[3];
    assert!((s[0] / exact - 1.0).abs() < 1e-5 && s[2] == 0.0, "{s:?} {exact}");
    assert!((block.thickness_strain_at_points().unwrap()[3] - thickness).abs() < 1e-5);
}

/// Modulus Σ_ijkl of the virtual velocity form, from the moduli of the material and the stress.
fn velocity_modulus(c: &Moduli, tau: &Voigt, [i, j, k, l]: [usize; 4]) -> f64 {
    let t = matrix(tau);
    let delta = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
    let place = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];
    c[place[i][j]][place[k][l]]
        + 0.5
            * (t[(j, l)] * delta(i, k)
                - t[(i, k)] * delta(j, l)
                - t[(i, l)] * delta(j, k)
                - t[(j, k)] * delta(i, l))
}

/// Velocities L x of all nodes at their displaced positions.
fn affine(mesh: &Mesh<3>, u: &[f64], l: &nalgebra::Matrix3<f64>) -> Vec<f64> {
    let velocity = |(n, x): (usize, &[f64; 3])| {
        let v = l * nalgebra::Vector3::from_fn(|c, _| x[c] + u[3 * n + c]);
        [v.x, v.y, v.z]
    };
    mesh.nodes.iter().enumerate().flat_map(velocity).collect()
}

#[test]
fn the_rate_tangent_is_the_one_of_the_virtual_velocity_form() {
    // One cell, uniform stress and plastic flow: K_ai,bk = V ∂N_a/∂x_j Σ_ijkl ∂N_b/∂x_l. It is probed by affine velocities L:
    // the work of K(Lx) on Mx is V M_ij Σ_ijkl L_kl.
    let mesh = mesh::<3>(ElementKind::Hex8, [0.0; 3], [1.0; 3], [1; 3], 0.0);
    let material = swift_j2();
    let mut block = block(&mesh, model(material.clone(), Idealisation::ThreeD, UL));
    let path = [0.02, -0.01, 0.015];
    follow(
        &mut block,
        &mesh,
        [field(&mesh, |x| [path[0] * x[1], path[1] * x[2] + 0.01 * x[1], path[2] * x[0]])].into_iter(),
    );
    let u = field(&mesh, |x| [path[0] * x[1], path[1] * x[2] + 0.01 * x[1], path[2] * x[0]]);
    let mut values = vec![0.0; block.pattern().values()];
    let mut constant = vec![0.0; 24];
    block.rate(AT, &mut values, &mut constant).unwrap();
    assert!(constant.iter().all(|c| *c == 0.0));
    let largest = values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    assert!(
        (0..24).all(|i| (0..24).all(|j| (values[24 * i + j] - values[24 * j + i]).abs() < 1e-14 * largest))
    );
    let state = block.save()[24..].to_vec();
    let tau: [f64; 6] = std::array::from_fn(|i| state[i]);
    let Material::J2(j2) = material else { unreachable!() };
    let c = ConstitutiveLaw::forward(&j2, 1.0, &tau, &state[6..7]);
    let mut noise = Noise::new(8);
    for _ in 0..5 {
        let mut gradient = || nalgebra::Matrix3::from_fn(|_, _| noise.next());
        let (l, m) = (gradient(), gradient());
        let force = product(&block.pattern().clone(), &values, &affine(&mesh, &u, &l));
        let work: f64 = force.iter().zip(affine(&mesh, &u, &m)).map(|(f, v)| f * v).sum();
        let mut exact = 0.0;
        for (i, j) in (0..9).map(|k| (k / 3, k % 3)) {
            for (k, n) in (0..9).map(|k| (k / 3, k % 3)) {
                exact += m[(i, j)] * velocity_modulus(&c, &tau, [i, j, k, n]) * l[(k, n)];
            }
        }
        assert!((work - exact).abs() < 1e-13 * largest, "{work} {exact}");
    }
}

#[test]
fn the_rate_tangent_is_the_derivative_of_forces_along_a_continuing_path() {
    for formulation in [Formulation::Standard, Formulation::BBar] {
        let mesh = square(2);
        let options = Model { formulation, ..model(swift_j2(), Idealisation::PlaneStrain, UL) };
        let mut start = block(&mesh, options);
        // Shear with some noise keeps every point in plastic flow if continued.
        let v: Vec<f64> = field(&mesh, |x| [x[1], 0.2 * x[0]])
            .iter()
            .zip(Noise::new(3).vector(18))
            .map(|(a, b)| a + 0.05 * b)
            .collect();
        let path = |t: f64| -> Vec<f64> { v.iter().map(|v| t * v).collect() };
        follow(&mut start, &mesh, (1..=20).map(|k| path(0.005 * f64::from(k))));
        assert!(start.plastic_strain_at_points().unwrap().iter().all(|e| *e > 0.01));
        let base = residual(&mut start, &path(0.1));
        let mut values = vec![0.0; start.pattern().values()];
        start.rate(AT, &mut values, &mut [0.0; 18]).unwrap();
        let rate = product(&start.pattern().clone(), &values, &v);
        let errors = [1e-3, 1e-4].map(|h| {
            let after = residual(&mut start.clone(), &path(0.1 + h));
            let e: Vec<f64> = (0..18).map(|i| (after[i] - base[i]) / h - rate[i]).collect();
            size(&e) / size(&rate)
        });
        let order = (errors[0] / errors[1]).log10();
        assert!((order - 1.0).abs() < 0.1 && errors[1] < 1e-2, "{formulation:?}: {errors:?}, order {order}");
    }
}

#[test]
fn strain_and_rotation_limit_forward_steps() {
    let mesh = square(2);
    let mut block = block(&mesh, model(hypoelastic(), Idealisation::PlaneStrain, UL));
    let stretch = block.limit(&field(&mesh, |x| [0.01 * x[0], 0.0]), AT).unwrap();
    // √(Δε:Δε) = 0.01/(1 + 0.005) at the midpoint.
    assert_eq!(stretch.limit, "r2");
    assert!((stretch.value - 0.002 / (0.01 / 1.005)).abs() < 1e-12, "{stretch:?}");
    let angle = 2.0_f64.to_radians();
    let turn = field(&mesh, |x| {
        [angle.cos() * x[0] - angle.sin() * x[1] - x[0], angle.sin() * x[0] + angle.cos() * x[1] - x[1]]
    });
    let rotation = block.limit(&turn, AT).unwrap();
    assert_eq!(rotation.limit, "r3");
    assert!((rotation.value - 0.25).abs() < 1e-12 && rotation.cause.contains("point"), "{rotation:?}");
    assert_eq!(block.limit(&turn.iter().map(|u| 0.2 * u).collect::<Vec<_>>(), AT), None);
    let wide = Limits { strain: 0.1, rotation: 0.1, ..Limits::default() };
    let mut free =
        Block::new(&mesh, 0, Model { limits: wide, ..model(hypoelastic(), Idealisation::PlaneStrain, UL) })
            .unwrap();
    assert_eq!(free.limit(&turn, AT), None);
}

#[test]
fn a_step_that_turns_a_cell_inside_out_or_strains_too_much_is_refused() {
    let mesh = square(2);
    let mut block = block(&mesh, model(hypoelastic(), Idealisation::PlaneStrain, UL));
    let mut r = vec![0.0; 18];
    let mut refused = |u: &[f64], words: &[&str]| {
        let refusal = block.residual(u, AT, &mut r).unwrap_err().to_string();
        assert!(words.iter().all(|w| refusal.contains(w)), "{refusal}");
    };
    let mut inside_out = vec![0.0; 18];
    inside_out[8] = -0.9;
    refused(&inside_out, &["cells 0: cell", "turns inside out"]);
    refused(&field(&mesh, |x| [0.9 * x[0], 0.0]), &["cell 0: strain increment 0.62", "at most 0.5"]);
    refused(&[f64::NAN; 18], &["cell 0"]);
    assert!(r.iter().all(|r| *r == 0.0), "a refused residual adds nothing");
    // The block is unchanged.
    block.reject();
    assert_eq!(residual(&mut block, &[0.0; 18]), vec![0.0; 18]);
}

/// Tip displacement of Cook's membrane (plane strain, E = 250, ν = .4999, F = 100) on n x n cells.
fn cook(n: usize, formulation: Formulation, kinematics: Kinematics, load: f64) -> f64 {
    let mut mesh = mesh::<2>(ElementKind::Quad4, [0.0; 2], [1.0; 2], [n, n], 0.0);
    for x in &mut mesh.nodes {
        let [s, t] = *x;
        *x = [48.0 * s, 44.0 * s + t * (44.0 - 28.0 * s)];
    }
    let material = Material::Elastic(asperity_fem::material::elastic::Elastic::new(250.0, 0.4999).unwrap());
    let options = Model { formulation, ..model(material, Idealisation::PlaneStrain, kinematics) };
    let mut block = block(&mesh, options);
    let mut u = vec![0.0; mesh.nodes.len() * 2];
    let left = nodes_of_sides(&mesh, &mesh.side_sets["left"]);
    let held: Vec<(usize, f64)> = left.iter().flat_map(|n| [(2 * n, 0.0), (2 * n + 1, 0.0)]).collect();
    let mut f = vec![0.0; u.len()];
    let right = nodes_of_sides(&mesh, &mesh.side_sets["right"]);
    for &node in &right {
        let y = mesh.nodes[node][1];
        let end = (y - 44.0).abs() < 1e-9 || (y - 60.0).abs() < 1e-9;
        f[2 * node + 1] = load / n as f64 * if end { 0.5 } else { 1.0 };
    }
    newton(&mut block, &mut u, &held, &f, 1e-7 * load);
    u[2 * right[right.len() - 1] + 1]
}

#[test]
fn averaged_dilatation_does_not_lock() {
    let locked = cook(16, Formulation::Standard, Kinematics::Small, 100.0);
    let free = cook(16, Formulation::BBar, Kinematics::Small, 100.0);
    assert!(locked < 4.0 && free > 7.3 && free < 7.7713, "{locked} {free}");
    // A small load in the current configuration gives the same result, scaled.
    let finite = cook(16, Formulation::BBar, UL, 1e-2) * 1e4;
    assert!((finite / free - 1.0).abs() < 1e-4, "{finite} {free}");
}

#[test]
fn plastic_flow_in_large_deformation_does_not_lock() {
    // Plane-strain compression between rough plates far beyond yield: the limit force is about that of slip lines, while the
    // force of the standard element keeps increasing. With averaged dilatation, the mean pressure remains bounded.
    let run = |formulation| {
        let mesh = mesh::<2>(ElementKind::Quad4, [0.0; 2], [1.0; 2], [4, 4], 0.0);
        let material = j2(Hardening::perfect(0.02).unwrap());
        let options = Model { formulation, ..model(material, Idealisation::PlaneStrain, UL) };
        let mut block = block(&mesh, options);
        let mut u = vec![0.0; 50];
        let bottom = nodes_of_sides(&mesh, &mesh.side_sets["bottom"]);
        let top = nodes_of_sides(&mesh, &mesh.side_sets["top"]);
        for k in 1..=20 {
            let mut held: Vec<(usize, f64)> =
                bottom.iter().flat_map(|n| [(2 * n, 0.0), (2 * n + 1, 0.0)]).collect();
            held.extend(top.iter().flat_map(|n| [(2 * n, 0.0), (2 * n + 1, -0.005 * f64::from(k))]));
            newton(&mut block, &mut u, &held, &[0.0; 50], 1e-12);
            block.accept();
        }
        assert!(block.stress_at_points().iter().map(mises).fold(0.0, f64::max) < 0.03);
        let r = residual(&mut block, &u);
        -top.iter().map(|n| r[2 * n + 1]).sum::<f64>()
    };
    let (standard, averaged) = (run(Formulation::Standard), run(Formulation::BBar));
    // Rough platens on a square: between 2k and about 1.2 x 2k times the current width.
    let frictionless = 2.0 * 0.02 / 3.0_f64.sqrt();
    assert!(
        averaged > frictionless && averaged < 1.35 * frictionless,
        "{averaged} {standard} {frictionless}"
    );
    assert!(standard > 1.1 * averaged, "{averaged} {standard}");
}

#[test]
fn newton_converges_quadratically_in_large_steps() {
    let mesh = square(4);
    let options =
        Model { formulation: Formulation::BBar, ..model(swift_j2(), Idealisation::PlaneStrain, UL) };
    let mut block = block(&mesh, options);
    let mut u = vec![0.0; 50];
    let bottom = nodes_of_sides(&mesh, &mesh.side_sets["bottom"]);
    let top = nodes_of_sides(&mesh, &mesh.side_sets["top"]);
    for k in 1..=5 {
        let mut held: Vec<(usize, f64)> =
            bottom.iter().flat_map(|n| [(2 * n, 0.0), (2 * n + 1, 0.0)]).collect();
        held.extend(top.iter().flat_map(|n| [(2 * n, 0.02 * f64::from(k)), (2 * n + 1, 0.0)]));
        let norms = newton(&mut block, &mut u, &held, &[0.0; 50], 1e-14);
        block.accept();
        let tail: Vec<f64> = norms.iter().copied().filter(|n| *n < 1e-4).collect();
        assert!(
            norms.len() < 12 && tail.windows(2).all(|w| w[1] < 1e4 * w[0] * w[0] || w[1] < 1e-13),
            "{norms:?}"
        );
    }
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let mesh = mesh::<2>(ElementKind::Quad4, [0.0; 2], [1.0; 2], [25, 25], 0.2);
    let n = mesh.nodes.len() * 2;
    let u: Vec<f64> = Noise::new(1).vector(n).iter().map(|x| 2e-3 * x).collect();
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let options =
                Model { formulation: Formulation::BBar, ..model(swift_j2(), Idealisation::PlaneStrain, UL) };
            let mut block = block(&mesh, options);
            let mut out = residual(&mut block, &u);
            out.extend(tangent(&mut block));
            block.reject();
            let limit = block.limit(&u, AT).unwrap();
            out.push(limit.value);
            residual(&mut block, &u);
            block.accept();
            let (mut values, mut constant) = (vec![0.0; block.pattern().values()], vec![0.0; n]);
            block.rate(AT, &mut values, &mut constant).unwrap();
            out.extend(block.save().iter().chain(&values).chain(&constant));
            (out.iter().map(|x| x.to_bits()).collect::<Vec<_>>(), limit.cause)
        })
    };
    assert_eq!(run(1), run(2));
}

#[test]
fn saved_history_continues_the_path() {
    let mesh = square(3);
    let options = model(standard_solid(), Idealisation::PlaneStrain, UL);
    let mut one = block(&mesh, options.clone());
    let path =
        |k: i32| -> Vec<f64> { Noise::new(1).vector(32).iter().map(|x| 0.02 * f64::from(k) * x).collect() };
    follow(&mut one, &mesh, (1..4).map(path));
    let saved = one.save();
    let mut other = block(&mesh, options);
    assert!(other.restore(&saved) && !other.restore(&saved[..5].to_vec()));
    assert_eq!(residual(&mut one, &path(5)), residual(&mut other, &path(5)));
    assert_eq!(one.stress_at_points(), other.stress_at_points());
    other.reject();
    assert_eq!(other.save(), saved);
}

#[test]
fn cell_stress_is_the_mean_over_the_present_volume() {
    let mesh = square(2);
    let mut block = block(&mesh, model(hypoelastic(), Idealisation::PlaneStrain, UL));
    follow(&mut block, &mesh, [field(&mesh, |x| [0.1 * x[0], 0.05 * x[0]])].into_iter());
    let points = block.stress_at_points();
    for (cell, mean) in block.cell_stress().iter().enumerate() {
        assert!((0..6).all(|i| (mean[i] - points[4 * cell][i]).abs() < 1e-14), "uniform in each cell");
    }
}
