//! Viscoelasticity compared with closed forms, which the update matches to rounding in steps of any size.

use crate::lab::{
    AT, Noise, POISSON, SHEAR, YOUNG, assert_derivative, elastic, field, mesh, model, product, residual,
    solved, standard_solid, tangent,
};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::constitutive::{ConstitutiveLaw, Moduli, Voigt};
use asperity_fem::material::maxwell::{Branch, Maxwell};
use asperity_fem::mesh::nodes_of_sides;
use asperity_fem::nonlinear::{Block, Kinematics, Material, Model};
use asperity_fem::term::{ForwardTerm, Instant, Linearized, Term};

const VISCOSITY: f64 = 1.7;
const TIME: f64 = VISCOSITY / SHEAR;

fn maxwell() -> Maxwell {
    Maxwell::new(&elastic(), VISCOSITY).unwrap()
}

fn shear(gamma: f64) -> Voigt {
    [0.0, 0.0, 0.0, gamma, 0.0, 0.0]
}

#[test]
fn held_shear_relaxes_exponentially_and_pressure_not_at_all() {
    let material = maxwell();
    for steps in [1, 3, 50] {
        let mut stress = [0.0; 6];
        material.update(0.0, &[0.01, 0.01, 0.01, 0.02, 0.0, 0.0], &mut stress, &mut [], None);
        let p = 0.03 * YOUNG / (3.0 * (1.0 - 2.0 * POISSON));
        let total = 2.5 * TIME;
        for _ in 0..steps {
            material.update(total / f64::from(steps), &[0.0; 6], &mut stress, &mut [], None);
        }
        assert!((stress[3] / (SHEAR * 0.02 * (-2.5_f64).exp()) - 1.0).abs() < 1e-13);
        assert!((stress[0] / p - 1.0).abs() < 1e-14);
    }
}

#[test]
fn a_constant_strain_rate_is_followed_exactly() {
    let material = maxwell();
    let rate = 0.3;
    for steps in [1, 7] {
        let (mut stress, mut t) = ([0.0; 6], 0.0);
        for _ in 0..steps {
            let dt = 3.0 * TIME / f64::from(steps);
            material.update(dt, &shear(rate * dt), &mut stress, &mut [], None);
            t += dt;
            let exact = VISCOSITY * rate * (1.0 - (-t / TIME).exp());
            assert!((stress[3] / exact - 1.0).abs() < 1e-13);
        }
    }
    // Far beyond the relaxation time it is a fluid, and a step of zero length is elastic.
    let mut stress = [0.0; 6];
    material.update(1e6 * TIME, &shear(rate * 1e6 * TIME), &mut stress, &mut [], None);
    assert!((stress[3] / (VISCOSITY * rate) - 1.0).abs() < 1e-13);
    let c = material.forward(0.0, &stress, &[]);
    assert!((c[3][3] / SHEAR - 1.0).abs() < 1e-15);
}

#[test]
fn a_standard_linear_solid_relaxes_to_its_spring() {
    let branch = Branch { share: 0.6, viscosity: 0.9 };
    let material = Maxwell::generalised(&elastic(), &[branch]).unwrap();
    assert_eq!(material.tensors(), 1);
    let time = 0.9 / (0.6 * SHEAR);
    let (mut stress, mut history) = ([0.0; 6], [0.0; 6]);
    material.update(0.0, &shear(0.02), &mut stress, &mut history, None);
    assert!((stress[3] / (SHEAR * 0.02) - 1.0).abs() < 1e-14);
    for x in [0.1_f64, 1.0, 5.0, 40.0] {
        let (mut s, mut h) = (stress, history);
        material.update(x * time, &[0.0; 6], &mut s, &mut h, None);
        let exact = SHEAR * 0.02 * (0.4 + 0.6 * (-x).exp());
        assert!((s[3] / exact - 1.0).abs() < 1e-13, "{} {exact}", s[3]);
    }
}

#[test]
fn viscoelastic_tangents_are_derivatives() {
    let Material::Maxwell(material) = standard_solid() else { unreachable!() };
    let strain: Voigt = std::array::from_fn(|i| 0.01 * (i as f64 - 2.0));
    let d = [0.4, -0.2, 0.9, 0.3, -0.7, 0.5];
    let update = |h: f64, c: Option<&mut Moduli>| {
        let (mut stress, mut history) = ([0.1; 6], [0.02; 12]);
        material.update(0.8, &std::array::from_fn(|i| strain[i] + h * d[i]), &mut stress, &mut history, c);
        stress
    };
    let mut c = [[0.0; 6]; 6];
    update(0.0, Some(&mut c));
    let derivative: Vec<f64> = c.iter().map(|r| r.iter().zip(&d).map(|(c, d)| c * d).sum()).collect();
    assert_derivative(|h| update(h, None).to_vec(), &derivative, 1e-3, "generalised Maxwell");
}

#[test]
fn parameters_out_of_range_are_named() {
    let error = |branches: &[Branch]| Maxwell::generalised(&elastic(), branches).unwrap_err().to_string();
    let branch = |share, viscosity| Branch { share, viscosity };
    assert!(error(&[branch(1.0, 0.0)]).contains("0 < eta"));
    assert!(error(&[branch(0.0, 1.0)]).contains("0 < share"));
    assert!(error(&[branch(0.7, 1.0), branch(0.4, 2.0)]).contains("at most 1"));
    assert!(error(&[branch(0.2, 1.0); 5]).contains("at most 4"));
    // Shares whose sum is 1 to rounding leave no spring.
    let three =
        Maxwell::generalised(&elastic(), &[branch(0.6, 1.0), branch(0.3, 1.0), branch(0.1, 1.0)]).unwrap();
    assert_eq!(three.tensors(), 2);
}

#[test]
fn dissipation_is_never_negative() {
    // In every Maxwell element, the work minus the change of stored energy is the dissipation of its dashpot. For one element
    // and steps of constant rate, the total work over a closed cycle of strain from rest is the dissipated energy plus the
    // energy still stored.
    let Material::Maxwell(material) = standard_solid() else { unreachable!() };
    for seed in 0..20 {
        let mut noise = Noise::new(seed + 1);
        let (mut stress, mut history) = ([0.0; 6], [0.0; 12]);
        let mut work = 0.0;
        let mut sum = [0.0; 6];
        let mut advance = |strain: Voigt, work: &mut f64| {
            // The work is measured over many small parts of the step.
            for _ in 0..200 {
                let part = strain.map(|e| e / 200.0);
                let before = stress;
                material.update(0.3 / 200.0, &part, &mut stress, &mut history, None);
                *work += (0..6).map(|i| 0.5 * (before[i] + stress[i]) * part[i]).sum::<f64>();
            }
        };
        for _ in 0..8 {
            let strain: Voigt = std::array::from_fn(|_| 0.02 * noise.next());
            (0..6).for_each(|i| sum[i] += strain[i]);
            advance(strain, &mut work);
        }
        advance(sum.map(|s| -s), &mut work);
        assert!(work > 1e-5, "cycle {seed}: work {work:e}");
    }
}

/// A square in simple shear under constant traction: the displacement of the top is γ = τ/G + τ t/η.
fn creep(steps: usize, forward: bool) -> f64 {
    let mesh = mesh::<2>(ElementKind::Quad4, [0.0; 2], [1.0; 2], [2, 2], 0.2);
    let options = model(Material::Maxwell(maxwell()), Idealisation::Antiplane, Kinematics::Small);
    let mut block = Block::new(&mesh, 0, options).unwrap();
    let (traction, total) = (0.05, 3.0 * TIME);
    let bottom = nodes_of_sides(&mesh, &mesh.side_sets["bottom"]);
    let top = nodes_of_sides(&mesh, &mesh.side_sets["top"]);
    let free: Vec<usize> = (0..9).filter(|n| !bottom.contains(n)).collect();
    let mut load = vec![0.0; 9];
    for &n in &top {
        load[n] = traction * if (mesh.nodes[n][0] - 0.5).abs() < 1e-9 { 0.5 } else { 0.25 };
    }
    let mut u = vec![0.0; 9];
    for k in 0..=steps {
        // The traction jumps at the start, in a step of zero length.
        let at = Instant { time: 0.0, dt: if k == 0 { 0.0 } else { total / steps as f64 } };
        let mut r = vec![0.0; 9];
        let mut values = vec![0.0; block.pattern().values()];
        if forward {
            block.rate(at, &mut values, &mut r).unwrap();
            if k == 0 {
                r.iter_mut().zip(&load).for_each(|(r, f)| *r -= f);
            }
        } else {
            block.residual(&u, at, &mut r).unwrap();
            block.tangent(&mut values);
            r.iter_mut().zip(&load).for_each(|(r, f)| *r -= f);
        }
        let rhs = nalgebra::DVector::from_iterator(free.len(), free.iter().map(|&d| -r[d]));
        let x = solved(block.pattern(), &values, (9, &free), &rhs);
        free.iter().zip(x.iter()).for_each(|(&d, x)| u[d] += x);
        block.residual(&u, at, &mut [0.0; 9]).unwrap();
        block.accept();
    }
    let exact = traction / SHEAR + traction * total / VISCOSITY;
    u[top[0]] / exact - 1.0
}

#[test]
fn creep_under_constant_stress_is_linear_in_time() {
    // Constant stress means constant strain rate after the jump. The update is exact in any number of steps, and so is the
    // forward step with its relaxation as the constant part.
    for steps in [1, 2, 9] {
        assert!(creep(steps, false).abs() < 1e-12, "{:e}", creep(steps, false));
        assert!(creep(steps, true).abs() < 1e-12, "{:e}", creep(steps, true));
    }
}

#[test]
fn forward_and_implicit_steps_agree_on_a_linear_material() {
    let mesh = mesh::<2>(ElementKind::Quad9, [0.0; 2], [1.0; 2], [2, 2], 0.2);
    let options = Model {
        formulation: Formulation::BBar,
        ..model(standard_solid(), Idealisation::PlaneStrain, Kinematics::Small)
    };
    let mut block = Block::new(&mesh, 0, options).unwrap();
    let u = field(&mesh, |x| [0.02 * x[1] * x[0], 0.01 * x[0]]);
    let before = residual(&mut block, &u);
    block.accept();
    let n = u.len();
    let du: Vec<f64> = Noise::new(3).vector(n).iter().map(|x| 0.01 * x).collect();
    let (mut values, mut constant) = (vec![0.0; block.pattern().values()], vec![0.0; n]);
    block.rate(AT, &mut values, &mut constant).unwrap();
    let change = product(&block.pattern().clone(), &values, &du);
    assert_eq!(block.limit(&du, AT), None);
    let after = residual(&mut block, &u.iter().zip(&du).map(|(a, b)| a + b).collect::<Vec<_>>());
    for i in 0..n {
        assert!((after[i] - before[i] - constant[i] - change[i]).abs() < 1e-14);
    }
    assert!(tangent(&mut block).iter().zip(&values).all(|(a, b)| (a - b).abs() < 1e-14));
}
