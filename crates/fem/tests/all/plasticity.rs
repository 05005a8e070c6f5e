//! J2 plasticity at small strain: the return, its tangents, exact solutions, forward steps.

use crate::lab::{
    AT, Noise, POISSON, SHEAR, YIELD, YOUNG, assert_derivative, elastic, field, j2, linear_j2, mesh, mises,
    model, newton, product, residual, size, solved, swift_j2,
};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::constitutive::{ConstitutiveLaw, Moduli, Voigt, contract, deviator};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::material::hardening::Hardening;
use asperity_fem::material::j2::J2;
use asperity_fem::material::plane_stress;
use asperity_fem::mesh::nodes_of_sides;
use asperity_fem::nonlinear::{Block, Kinematics, Limits, Material, Model};
use asperity_fem::term::{ForwardTerm, Instant, Linearized, Restorable, Term};

fn hardenings() -> Vec<Hardening> {
    vec![
        Hardening::perfect(YIELD).unwrap(),
        Hardening::linear(YIELD, 0.3).unwrap(),
        Hardening::swift(YIELD, 0.002, 0.3).unwrap(),
        Hardening::table(&[[0.0, YIELD], [0.01, 0.03], [0.04, 0.035]]).unwrap(),
    ]
}

fn noise<const N: usize>(seed: u64, scale: f64) -> [f64; N] {
    let mut noise = Noise::new(seed);
    std::array::from_fn(|_| scale * noise.next())
}

/// J2 stress and plastic strain after a strain path from rest.
fn path(material: &J2, strains: &[Voigt]) -> (Voigt, [f64; 1]) {
    let (mut stress, mut history) = ([0.0; 6], [0.0]);
    for strain in strains {
        material.update(1.0, strain, &mut stress, &mut history, None);
    }
    (stress, history)
}

#[test]
fn a_returned_stress_lies_on_the_yield_surface_at_its_plastic_strain() {
    for hardening in hardenings() {
        let material = J2::new(elastic(), hardening.clone());
        for (seed, scale) in [(1, 0.02), (2, 0.03), (3, 0.2), (4, 3.0)] {
            let (stress, history) = path(&material, &[noise(seed, scale), noise(seed + 10, scale)]);
            assert!(history[0] > 0.0);
            let y = hardening.at(history[0]).stress;
            assert!(
                (mises(&stress) / y - 1.0).abs() < 1e-13,
                "{hardening:?} {scale}: {:e}",
                mises(&stress) / y
            );
        }
    }
}

#[test]
fn below_yield_nothing_flows() {
    let material = J2::new(elastic(), Hardening::perfect(YIELD).unwrap());
    let strain = noise(7, 1e-3);
    let (stress, history) = path(&material, &[strain]);
    let (mut exact, mut none) = ([0.0; 6], []);
    elastic().update(1.0, &strain, &mut exact, &mut none, None);
    assert_eq!((stress, history[0]), (exact, 0.0));
}

#[test]
fn algorithmic_tangents_are_the_derivatives_of_the_return() {
    for hardening in hardenings() {
        let material = J2::new(elastic(), hardening.clone());
        for plane in [false, true] {
            let update = |strain: &Voigt, c: Option<&mut Moduli>| {
                let mut first = noise::<6>(3, 0.02);
                let mut increment = *strain;
                let (mut stress, mut history) = ([0.0; 6], [0.0]);
                if plane {
                    (first[4], first[5], increment[4], increment[5]) = (0.0, 0.0, 0.0, 0.0);
                    plane_stress::update(&material, 1.0, &first, &mut stress, &mut history, None);
                    plane_stress::update(&material, 1.0, &increment, &mut stress, &mut history, c);
                } else {
                    material.update(1.0, &first, &mut stress, &mut history, None);
                    material.update(1.0, &increment, &mut stress, &mut history, c);
                }
                assert!(history[0] > 0.005);
                stress
            };
            for seed in 20..25 {
                let (strain, mut d) = (noise::<6>(seed, 0.02), noise::<6>(seed + 50, 1.0));
                if plane {
                    (d[2], d[4], d[5]) = (0.0, 0.0, 0.0);
                }
                let mut c = [[0.0; 6]; 6];
                update(&strain, Some(&mut c));
                let derivative: Vec<f64> =
                    c.iter().map(|row| row.iter().zip(&d).map(|(c, d)| c * d).sum()).collect();
                let f = |h: f64| update(&std::array::from_fn(|i| strain[i] + h * d[i]), None).to_vec();
                assert_derivative(f, &derivative, 2e-5, &format!("{hardening:?} plane stress {plane}"));
            }
        }
    }
}

#[test]
fn the_algorithmic_tangent_tends_to_the_continuum_one_with_the_step() {
    let material = J2::new(elastic(), Hardening::swift(YIELD, 0.01, 0.4).unwrap());
    let (stress, history) = path(&material, &[noise(3, 0.02)]);
    let continuum = material.forward(1.0, &stress, &history);
    let direction: Voigt = std::array::from_fn(|i| deviator(&stress)[i] * if i < 3 { 1.0 } else { 2.0 });
    let direction: Voigt = std::array::from_fn(|i| direction[i] + 0.3 * noise::<6>(9, YIELD)[i]);
    let distance = |h: f64| {
        let (mut s, mut e, mut c) = (stress, history, [[0.0; 6]; 6]);
        material.update(1.0, &direction.map(|d| h * d), &mut s, &mut e, Some(&mut c));
        size(&(0..36).map(|k| c[k / 6][k % 6] - continuum[k / 6][k % 6]).collect::<Vec<_>>())
    };
    let (coarse, fine) = (distance(1e-2), distance(1e-3));
    assert!((coarse / fine).log10() > 0.9 && fine < 1e-2, "{coarse:e} {fine:e}");
    // The plastic modulus of the continuum tangent is also exact: a stress rate along s raises q by 3GH/(3G + H) times the
    // deviatoric strain rate parallel to it.
    let s = deviator(&stress);
    let n: Voigt = s.map(|x| x / contract(&s, &s).sqrt());
    let engineering: Voigt = std::array::from_fn(|i| if i < 3 { n[i] } else { 2.0 * n[i] });
    let rate: Voigt =
        std::array::from_fn(|i| continuum[i].iter().zip(&engineering).map(|(c, e)| c * e).sum());
    let h = material.hardening().at(history[0]).slope;
    let exact = 2.0 * SHEAR * h / (3.0 * SHEAR + h);
    assert!((contract(&rate, &n) / exact - 1.0).abs() < 1e-12);
}

#[test]
fn equibiaxial_plane_stress_follows_its_closed_form() {
    // ε_p = e_p/2 in each in-plane direction, so Y0 + H e_p = E/(1-ν) (ε - e_p/2).
    let h = 0.3;
    let material = J2::new(elastic(), Hardening::linear(YIELD, h).unwrap());
    let (mut stress, mut history, mut thickness) = ([0.0; 6], [0.0], 0.0);
    let mut strain = 0.0;
    for step in [0.003, 0.004, 0.02, 0.1] {
        strain += step;
        let used = plane_stress::update(
            &material,
            1.0,
            &[step, step, 0.0, 0.0, 0.0, 0.0],
            &mut stress,
            &mut history,
            None,
        );
        thickness += used[2];
        let biaxial = YOUNG / (1.0 - POISSON);
        let plastic = ((biaxial * strain - YIELD) / (h + 0.5 * biaxial)).max(0.0);
        let exact = biaxial * (strain - 0.5 * plastic);
        assert!((history[0] - plastic).abs() < 1e-14 && (stress[0] / exact - 1.0).abs() < 1e-12);
        assert!((stress[1] / exact - 1.0).abs() < 1e-12 && stress[2] == 0.0);
        assert!((thickness + 2.0 * POISSON / YOUNG * exact + plastic).abs() < 1e-13);
    }
}

#[test]
fn dissipation_is_never_negative() {
    // Work minus the change of elastic energy, over each step of a path of random strains: Y Δe_p in the exact return.
    let elastic_energy = |s: &Voigt| {
        let p = (s[0] + s[1] + s[2]) / 3.0;
        let k = YOUNG / (3.0 * (1.0 - 2.0 * POISSON));
        contract(&deviator(s), &deviator(s)) / (4.0 * SHEAR) + p * p / (2.0 * k)
    };
    for hardening in hardenings() {
        let material = J2::new(elastic(), hardening);
        let (mut stress, mut history) = ([0.0; 6], [0.0]);
        let mut total = 0.0;
        for step in 0..200 {
            let strain = noise::<6>(step + 100, 0.02);
            let (old, plastic) = (stress, history[0]);
            material.update(1.0, &strain, &mut stress, &mut history, None);
            // With the stress at the end, the work of the plastic strain is q Δe_p.
            let work: f64 = stress.iter().zip(&strain).map(|(s, e)| s * e).sum();
            let difference: Voigt = std::array::from_fn(|i| stress[i] - old[i]);
            let stored = elastic_energy(&stress) - elastic_energy(&old) + elastic_energy(&difference);
            let flow = mises(&stress) * (history[0] - plastic);
            assert!((work - stored - flow).abs() < 1e-14, "{work:e} {stored:e} {flow:e}");
            assert!(flow >= 0.0);
            total += flow;
        }
        assert!(total > 0.03);
    }
}

/// Holds the faces of a unit cube or square so that only uniaxial stress along the first or second axis is possible.
fn uniaxial<const D: usize>(kind: ElementKind, options: Model, axis: usize) {
    // Second-order rings with moved mid-nodes are not integrated exactly.
    let straight = options.idealisation == Idealisation::Axisymmetric && kind.nodes() > 4;
    let mesh = mesh::<D>(kind, [0.0; D], [1.0; D], [2; D], if straight { 0.0 } else { 0.2 });
    let mut block = Block::new(&mesh, 0, options).unwrap();
    let planes: &[&str] = &["left", "bottom", "back"][..D];
    let end = ["right", "top"][axis];
    let mut u = vec![0.0; mesh.nodes.len() * D];
    let h = 0.3;
    for strain in [0.005, 0.012, 0.03, 0.08] {
        let mut held = Vec::new();
        for (c, name) in planes.iter().enumerate() {
            held.extend(nodes_of_sides(&mesh, &mesh.side_sets[*name]).iter().map(|n| (n * D + c, 0.0)));
        }
        held.extend(nodes_of_sides(&mesh, &mesh.side_sets[end]).iter().map(|n| (n * D + axis, strain)));
        newton(&mut block, &mut u, &held, &vec![0.0; mesh.nodes.len() * D], 1e-15);
        block.accept();
        let first = YIELD / YOUNG;
        let exact =
            if strain > first { YIELD + YOUNG * h / (YOUNG + h) * (strain - first) } else { YOUNG * strain };
        for (stress, plastic) in
            block.stress_at_points().iter().zip(block.plastic_strain_at_points().unwrap())
        {
            for (i, s) in stress.iter().enumerate() {
                let expected = if i == axis { exact } else { 0.0 };
                assert!((s - expected).abs() < 1e-13, "{} {strain}: {stress:?} {exact}", kind.name());
            }
            assert!((plastic - (exact - YIELD).max(0.0) / h).abs() < 1e-12);
        }
    }
}

#[test]
fn uniaxial_stress_hardens_with_eh_over_e_plus_h() {
    for (kind, formulation) in [
        (ElementKind::Hex8, Formulation::Standard),
        (ElementKind::Hex8, Formulation::BBar),
        (ElementKind::Tet4, Formulation::Standard),
    ] {
        let options = Model { formulation, ..model(linear_j2(), Idealisation::ThreeD, Kinematics::Small) };
        uniaxial::<3>(kind, options, 0);
    }
    for kind in [ElementKind::Tri3, ElementKind::Tri6, ElementKind::Quad4, ElementKind::Quad9] {
        uniaxial::<2>(kind, model(linear_j2(), Idealisation::PlaneStress, Kinematics::Small), 0);
        uniaxial::<2>(kind, model(linear_j2(), Idealisation::Axisymmetric, Kinematics::Small), 1);
    }
    let bbar = Model {
        formulation: Formulation::BBar,
        ..model(linear_j2(), Idealisation::Axisymmetric, Kinematics::Small)
    };
    uniaxial::<2>(ElementKind::Quad9, bbar, 1);
}

/// Outer displacement of the thick cylinder (a = 100, b = 200 mm, Y = 0.24, E = 210, ν = 0.3; perfect) at the pressures.
fn cylinder(divisions: usize, pressures: &[f64]) -> Vec<f64> {
    let (a, b, height) = (100.0, 200.0, 5.0);
    let material = J2::new(Elastic::new(210.0, 0.3).unwrap(), Hardening::perfect(0.24).unwrap());
    let options = Model {
        formulation: Formulation::BBar,
        ..model(Material::J2(material), Idealisation::Axisymmetric, Kinematics::Small)
    };
    let mesh = mesh::<2>(ElementKind::Quad9, [a, 0.0], [b, height], [divisions, 1], 0.0);
    let mut block = Block::new(&mesh, 0, options).unwrap();
    let mut u = vec![0.0; mesh.nodes.len() * 2];
    let held: Vec<(usize, f64)> = (0..mesh.nodes.len()).map(|n| (2 * n + 1, 0.0)).collect();
    let inner = nodes_of_sides(&mesh, &mesh.side_sets["left"]);
    let outer = nodes_of_sides(&mesh, &mesh.side_sets["right"]);
    pressures
        .iter()
        .map(|p| {
            let mut load = vec![0.0; u.len()];
            for &n in &inner {
                let weight =
                    if (mesh.nodes[n][1] - 0.5 * height).abs() < 1e-9 { 4.0 / 6.0 } else { 1.0 / 6.0 };
                load[2 * n] = weight * p * std::f64::consts::TAU * a * height;
            }
            newton(&mut block, &mut u, &held, &load, 1e-9);
            block.accept();
            u[2 * outer[0]]
        })
        .collect()
}

#[test]
fn a_thick_cylinder_yields_as_its_reference_says() {
    // Radial finite-element reference accurate to 1e-5 relative; below yield, the closed form of Lamé.
    let found = cylinder(40, &[0.10, 0.12, 0.14, 0.16, 0.18]);
    let (p, a, b, nu) = (0.10, 100.0_f64, 200.0_f64, 0.3);
    let lame = 2.0 * p * b * (1.0 - nu * nu) / (210.0 * (b * b / (a * a) - 1.0));
    assert!((found[0] / lame - 1.0).abs() < 1e-7, "{} {lame}", found[0]);
    for (u, reference) in found[1..].iter().zip([0.070_420_4, 0.087_287_2, 0.111_644_7, 0.154_017]) {
        assert!((u / reference - 1.0).abs() < 2e-4, "{u} {reference}");
    }
}

#[test]
fn newton_converges_quadratically_through_plastic_flow() {
    let mesh = mesh::<2>(ElementKind::Quad4, [0.0; 2], [1.0; 2], [4, 4], 0.2);
    let options = Model {
        formulation: Formulation::BBar,
        ..model(swift_j2(), Idealisation::PlaneStrain, Kinematics::Small)
    };
    let mut block = Block::new(&mesh, 0, options).unwrap();
    let mut u = vec![0.0; mesh.nodes.len() * 2];
    let mut held = Vec::new();
    for &n in &nodes_of_sides(&mesh, &mesh.side_sets["bottom"]) {
        held.extend([(2 * n, 0.0), (2 * n + 1, 0.0)]);
    }
    let mut norms = Vec::new();
    for shear in [0.02, 0.04, 0.06] {
        let mut held = held.clone();
        held.extend(nodes_of_sides(&mesh, &mesh.side_sets["top"]).iter().map(|n| (2 * n, shear)));
        norms = newton(&mut block, &mut u, &held, &vec![0.0; 50], 1e-15);
        block.accept();
    }
    let tail: Vec<f64> = norms.iter().copied().filter(|n| *n < 1e-4 && *n > 1e-13).collect();
    assert!(tail.windows(2).all(|w| w[1] < 50.0 * w[0] * w[0] / 1e-2 || w[1] < 1e-12), "{norms:?}");
}

#[test]
fn a_forward_step_scaled_by_r1_ends_on_the_yield_surface() {
    for (idealisation, kinematics) in [
        (Idealisation::PlaneStrain, Kinematics::Small),
        (Idealisation::PlaneStress, Kinematics::Small),
        (Idealisation::Axisymmetric, Kinematics::Small),
        (Idealisation::Antiplane, Kinematics::Small),
        (Idealisation::PlaneStrain, Kinematics::UpdatedLagrangian),
        (Idealisation::PlaneStress, Kinematics::UpdatedLagrangian),
    ] {
        let mesh = mesh::<2>(ElementKind::Quad4, [0.0; 2], [1.0; 2], [3, 3], 0.2);
        let limits = Limits { strain: 1.0, rotation: 1.0, refused: 1.0 };
        let options = Model { limits, ..model(linear_j2(), idealisation, kinematics) };
        let mut block = Block::new(&mesh, 0, options).unwrap();
        let n = mesh.nodes.len() * idealisation.components();
        // A first elastic step, so that the increment is not parallel to the stress.
        let first: Vec<f64> = Noise::new(4).vector(n).iter().map(|x| 5e-5 * x).collect();
        assert_eq!(block.limit(&first, AT), None);
        residual(&mut block, &first);
        block.accept();
        let du: Vec<f64> = Noise::new(5).vector(n).iter().map(|x| 0.01 * x).collect();
        let limit = block.limit(&du, AT).unwrap();
        assert_eq!(limit.limit, "r1");
        assert!(limit.cause.contains("cell") && limit.cause.contains("point"), "{}", limit.cause);
        let scaled: Vec<f64> = du.iter().map(|d| limit.value * d).collect();
        residual(&mut block, &first.iter().zip(&scaled).map(|(a, b)| a + b).collect::<Vec<_>>());
        block.accept();
        // Yield is determined by the Kirchhoff stress, which is the kept one.
        let saved = block.save();
        let kept = saved[n..].chunks_exact(block.kept_per_point());
        let largest = kept.map(|s| mises(s.first_chunk().unwrap())).fold(0.0, f64::max);
        assert!((largest / YIELD - 1.0).abs() < 1e-12, "{idealisation:?}: {:e}", largest / YIELD - 1.0);
        assert!(block.plastic_strain_at_points().unwrap().iter().all(|e| e.abs() < 1e-14));
        // The point on the surface no longer limits the step; another one does.
        if let Some(next) = block.limit(&du, AT) {
            assert_ne!(next.cause, limit.cause);
        }
    }
}

/// Drives the top of a square by forward steps of equal size; returns the largest unbalanced force at the end.
fn forward(steps: usize, carry: bool) -> f64 {
    let mesh = mesh::<2>(ElementKind::Quad4, [0.0; 2], [1.0; 2], [3, 3], 0.2);
    let mut block =
        Block::new(&mesh, 0, model(swift_j2(), Idealisation::PlaneStrain, Kinematics::Small)).unwrap();
    let n = mesh.nodes.len() * 2;
    let top = nodes_of_sides(&mesh, &mesh.side_sets["top"]);
    let bottom = nodes_of_sides(&mesh, &mesh.side_sets["bottom"]);
    let mut held: Vec<(usize, f64)> = bottom.iter().flat_map(|n| [(2 * n, 0.0), (2 * n + 1, 0.0)]).collect();
    held.extend(top.iter().flat_map(|n| [(2 * n, 1.0), (2 * n + 1, 0.2)]));
    let free: Vec<usize> = (0..n).filter(|d| held.iter().all(|h| h.0 != *d)).collect();
    // Plastic throughout before the counted steps start, in equilibrium.
    let mut u = vec![0.0; n];
    let start: Vec<(usize, f64)> = held.iter().map(|(d, v)| (*d, 0.06 * v)).collect();
    newton(&mut block, &mut u, &start, &vec![0.0; n], 1e-15);
    block.accept();
    let at = Instant { time: 1.0, dt: 0.04 / steps as f64 };
    let mut left = vec![0.0; n];
    for _ in 0..steps {
        let mut values = vec![0.0; block.pattern().values()];
        let mut constant = vec![0.0; n];
        block.rate(at, &mut values, &mut constant).unwrap();
        let mut du = vec![0.0; n];
        held.iter().for_each(|(d, v)| du[*d] = v * at.dt);
        let known = product(block.pattern(), &values, &du);
        let rhs = free.iter().map(|&d| -constant[d] - known[d] - left[d]).collect::<Vec<_>>();
        let x = solved(block.pattern(), &values, (n, &free), &rhs.into());
        free.iter().zip(x.iter()).for_each(|(&d, x)| du[d] = *x);
        u.iter_mut().zip(&du).for_each(|(u, d)| *u += d);
        let r = residual(&mut block, &u);
        block.accept();
        if carry {
            left = r;
        }
    }
    let r = residual(&mut block, &u);
    free.iter().map(|&d| r[d].abs()).fold(0.0, f64::max)
}

#[test]
fn drift_of_forward_steps_is_of_first_order_and_of_second_when_it_is_carried() {
    for (carry, expected) in [(false, 1.0), (true, 2.0)] {
        let errors = [20, 40, 80].map(|n| forward(n, carry));
        let order = (errors[1] / errors[2]).log2();
        assert!((order - expected).abs() < 0.2, "carry {carry}: {errors:?}, order {order}");
    }
}

#[test]
fn a_saved_block_continues_as_if_nothing_had_happened() {
    let mesh = mesh::<2>(ElementKind::Quad4, [0.0; 2], [1.0; 2], [3, 3], 0.2);
    let options = model(swift_j2(), Idealisation::PlaneStrain, Kinematics::Small);
    let mut block = Block::new(&mesh, 0, options.clone()).unwrap();
    let u: Vec<f64> = Noise::new(4).vector(32).iter().map(|x| 0.02 * x).collect();
    residual(&mut block, &u);
    block.accept();
    let saved = block.save();
    let mut other = Block::new(&mesh, 0, options).unwrap();
    assert!(!other.restore(&saved[1..].to_vec()));
    assert!(other.restore(&saved));
    let w: Vec<f64> = u.iter().map(|x| 1.3 * x).collect();
    assert_eq!(residual(&mut block, &w), residual(&mut other, &w));
    let mut rates = [(); 2].map(|()| (vec![0.0; block.pattern().values()], vec![0.0; 32]));
    block.rate(AT, &mut rates[0].0, &mut rates[0].1).unwrap();
    other.rate(AT, &mut rates[1].0, &mut rates[1].1).unwrap();
    assert_eq!(rates[0], rates[1]);
    // A rejected trial has no effect.
    block.reject();
    assert_eq!(block.save(), saved);
}

#[test]
fn a_point_keeps_only_what_its_material_needs() {
    let mesh = mesh::<2>(ElementKind::Quad4, [0.0; 2], [1.0; 2], [2, 2], 0.0);
    let kept = |material: Material, idealisation, kinematics| {
        Block::new(&mesh, 0, model(material, idealisation, kinematics)).unwrap().kept_per_point()
    };
    let elastic = || Material::Elastic(elastic());
    let solid = crate::lab::standard_solid;
    assert_eq!(kept(elastic(), Idealisation::PlaneStrain, Kinematics::Small), 0);
    assert_eq!(kept(elastic(), Idealisation::PlaneStrain, Kinematics::UpdatedLagrangian), 6);
    assert_eq!(kept(linear_j2(), Idealisation::PlaneStrain, Kinematics::Small), 7);
    assert_eq!(kept(linear_j2(), Idealisation::PlaneStress, Kinematics::Small), 8);
    assert_eq!(kept(solid(), Idealisation::PlaneStrain, Kinematics::Small), 18);
    let block = Block::new(&mesh, 0, model(elastic(), Idealisation::PlaneStrain, Kinematics::Small)).unwrap();
    assert!(block.cell_plastic_strain().is_none());
}

#[test]
fn combinations_that_do_not_exist_are_refused_with_a_reason() {
    let mesh = mesh::<2>(ElementKind::Tri3, [0.0; 2], [1.0; 2], [2, 2], 0.0);
    let refused = |options: Model, words: &str| {
        let error = Block::new(&mesh, 0, options).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    };
    let base = |i| model(linear_j2(), i, Kinematics::Small);
    let bbar = |i| Model { formulation: Formulation::BBar, ..base(i) };
    refused(bbar(Idealisation::PlaneStrain), "tri3");
    refused(bbar(Idealisation::PlaneStress), "thickness follows");
    refused(bbar(Idealisation::Antiplane), "antiplane motion");
    refused(base(Idealisation::ThreeD), "dimension of the mesh");
    refused(model(linear_j2(), Idealisation::Antiplane, Kinematics::UpdatedLagrangian), "three dimensions");
    let mut shifted = mesh.clone();
    shifted.nodes.iter_mut().for_each(|x| x[0] -= 0.1);
    let error = Block::new(&shifted, 0, base(Idealisation::Axisymmetric)).unwrap_err().to_string();
    assert!(error.contains("node 0 has the radius"), "{error}");
    let mut inside_out = mesh.clone();
    inside_out.blocks[0].connectivity[3..6].reverse();
    let error = Block::new(&inside_out, 0, base(Idealisation::PlaneStrain)).unwrap_err().to_string();
    assert!(error.contains("cell 1 of block 0"), "{error}");
}

#[test]
fn small_strain_elasticity_agrees_with_the_linear_block() {
    let mesh = mesh::<2>(ElementKind::Quad9, [0.0; 2], [1.0; 2], [3, 3], 0.2);
    let linear = asperity_fem::block::LinearBlock::new(
        &mesh,
        0,
        &elastic(),
        Idealisation::PlaneStrain,
        Formulation::Standard,
    )
    .unwrap();
    let options = model(Material::Elastic(elastic()), Idealisation::PlaneStrain, Kinematics::Small);
    let mut block = Block::new(&mesh, 0, options).unwrap();
    let u = field(&mesh, |x| [x[0] * x[1], x[1] * x[1] - x[0]]);
    residual(&mut block, &u);
    let k = crate::lab::tangent(&mut block);
    let scale = linear.stiffness().iter().fold(0.0, |m: f64, k| m.max(k.abs()));
    assert!(k.iter().zip(linear.stiffness()).all(|(a, b)| (a - b).abs() < 1e-13 * scale));
    block.accept();
    for (a, b) in block.stress_at_points().iter().zip(linear.stress_at_points(&u)) {
        assert!((0..6).all(|i| (a[i] - b[i]).abs() < 1e-12));
    }
    let _ = j2;
}
