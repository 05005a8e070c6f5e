use super::{Explicit, Fault, Problem, SplitPoint, Tie, dashpots};
use crate::{Body, CellBlock, Model, Stage};
use asperity_fem::block::LinearBlock;
use asperity_fem::dof::Channel;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::Mesh;
use asperity_fem::mesh::generate::Grid;
use asperity_fem::table::Table;
use asperity_friction::coulomb::Coulomb;
use asperity_friction::inertial::InertialPoints;
use asperity_friction::points::Components;
use asperity_friction::slip_weakening::SlipWeakening;

const DENSITY: f64 = 2700.0;

/// Bars along x between pairs of ends, `height` high, of square cells of size `h`, without lateral strain (ν = 0).
fn bars(ends: &[[f64; 2]], height: usize, h: f64, space: Idealisation) -> Model<2> {
    let mut mesh = Mesh::<2>::default();
    for (k, [from, to]) in ends.iter().enumerate() {
        let n = ((to - from) / h).round() as usize;
        let x = (0..=n).map(|i| from + (to - from) * i as f64 / n as f64).collect();
        let y = (0..=height).map(|j| j as f64 * h).collect();
        mesh.append(Grid { lines: [x, y], kind: ElementKind::Quad4 }.mesh().unwrap(), &format!("b{k}"));
    }
    model(mesh, Elastic::new(75e9, 0.0).unwrap(), space)
}

fn model<const D: usize>(mesh: Mesh<D>, rock: Elastic, idealisation: Idealisation) -> Model<D> {
    let block = |k| LinearBlock::new(&mesh, k, &rock, idealisation, Formulation::Standard).unwrap();
    let blocks: Vec<_> = (0..mesh.blocks.len()).map(|k| CellBlock::Linear(Box::new(block(k)))).collect();
    let bodies = (0..mesh.blocks.len()).map(|k| Body {
        name: format!("b{k}"),
        nodes: 0..mesh.nodes.len(),
        blocks: k..k + 1,
        elastic: vec![rock],
        size: None,
        parts: Vec::new(),
        nonlinear: None,
        dofs: 0..mesh.nodes.len() * idealisation.components(),
    });
    Model { bodies: bodies.collect(), mesh, blocks, idealisation, scale: 1.0 }
}

fn problem(model: Model<2>, stage: Stage) -> Problem<2> {
    let density = vec![DENSITY; model.blocks.len()];
    Problem {
        model,
        density,
        courant: 0.9,
        viscosity: 0.0,
        fault: None,
        absorbing: Vec::new(),
        stages: vec![stage],
        velocity: Vec::new(),
    }
}

fn speed() -> f64 {
    (75e9_f64 / DENSITY).sqrt()
}

/// Runs to the end of the only stage.
fn run<'a>(problem: &'a Problem<2>, mut watch: impl FnMut(&mut Explicit<'a, 2>)) -> Explicit<'a, 2> {
    let mut run = Explicit::new(problem).unwrap();
    run.begin_stage(0).unwrap();
    let steps = (problem.stages[0].end / run.dt()).round() as usize;
    for _ in 0..steps {
        run.step().unwrap();
        watch(&mut run);
    }
    run
}

/// Error of a standing wave in a free bar after a period and a quarter.
fn standing_wave(h: f64) -> (f64, f64) {
    let bar = bars(&[[0.0, 1.0]], 1, h, Idealisation::PlaneStress);
    let omega = std::f64::consts::PI * speed();
    let mut problem = problem(bar, Stage::free("go", 2.5 * std::f64::consts::PI / omega));
    let shape: Vec<f64> =
        problem.model.mesh.nodes.iter().map(|x| (std::f64::consts::PI * x[0]).cos()).collect();
    problem.velocity = shape.iter().flat_map(|s| [*s, 0.0]).collect();
    let mut worst: f64 = 0.0;
    let run = run(&problem, |run| {
        let budget = run.budget();
        worst = worst.max(budget.energies().imbalance());
    });
    let exact = |s: &f64| s * (omega * run.time()).sin() / omega;
    let error = shape.iter().enumerate().map(|(n, s)| (run.displacement()[2 * n] - exact(s)).abs());
    (error.fold(0.0, f64::max) * omega, worst)
}

#[test]
fn standing_waves_converge_with_order_two_and_keep_their_energy_to_rounding() {
    let results: Vec<(f64, f64)> = [10.0, 20.0, 40.0].map(|n| standing_wave(1.0 / n)).to_vec();
    for w in results.windows(2) {
        let order = (w[0].0 / w[1].0).log2();
        assert!((order - 2.0).abs() < 0.1, "{results:?}");
    }
    assert!(results.iter().all(|r| r.1 < 1e-12), "{results:?}");
}

#[test]
fn absorbing_ends_let_waves_of_normal_incidence_out() {
    let bar = bars(&[[0.0, 1.0]], 2, 0.01, Idealisation::PlaneStress);
    let mut problem = problem(bar, Stage::free("go", 2.0 / speed()));
    let pulse = |x: f64| (-((x - 0.5) / 0.08).powi(2)).exp();
    problem.velocity = problem.model.mesh.nodes.iter().flat_map(|x| [pulse(x[0]), 0.0]).collect();
    let sides = [&problem.model.mesh.side_sets["b0.left"][..], &problem.model.mesh.side_sets["b0.right"][..]]
        .concat();
    problem.absorbing = dashpots(&problem.model, &problem.density, &sides);
    let run = run(&problem, |_| ());
    let budget = run.budget();
    // The rest is dispersion: waves of short length travel slower.
    assert!(budget.kinetic + budget.elastic < 1e-5 * budget.initial, "{budget:?}");
    assert!((budget.absorbed / budget.initial - 1.0).abs() < 1e-5, "{budget:?}");
    assert!(budget.energies().imbalance() < 1e-12, "{budget:?}");
}

/// Two bars that meet at x = 1, the left one flying to the right at 1 m/s.
fn impact(h: f64, gap: f64) -> Problem<2> {
    let model = bars(&[[0.0, 1.0], [1.0 + gap, 2.0 + gap]], 1, h, Idealisation::PlaneStress);
    let n = ((1.0 / h).round() as usize) + 1;
    let half = model.mesh.nodes.len() / 2;
    let point = |j: usize| SplitPoint {
        minus: j * n + n - 1,
        plus: half + j * n,
        area: 0.5 * h,
        normal: [1.0, 0.0, 0.0],
        along: vec![[0.0, 1.0, 0.0]],
        gap,
    };
    let fault = Fault {
        points: vec![point(0), point(1)],
        law: Box::new(InertialPoints(vec![Coulomb::new(0.0, None).unwrap(); 2])),
        normal: vec![0.0; 2],
        shear: Components::new(vec![0.0; 2], 2),
        rate: Components::new(vec![0.0; 2], 2),
        opens: true,
        regularisation: None,
        pulses: Vec::new(),
        forced: Vec::new(),
        onset: None,
        ties: Vec::new(),
    };
    let velocity =
        (0..model.mesh.nodes.len()).flat_map(|n| [if n < half { 1.0 } else { 0.0 }, 0.0]).collect();
    Problem { fault: Some(fault), velocity, ..problem(model, Stage::free("go", 4.0 / speed() + gap)) }
}

#[test]
fn equal_bars_that_meet_exchange_their_velocities_after_the_wave_has_run_twice() {
    let problem = impact(0.005, 0.0);
    let (mut impulse, mut last, mut middle) = (0.0, 0.0, 0.0);
    let run = run(&problem, |run| {
        let pressed = run.fault().normal[0];
        impulse += pressed * run.dt();
        if pressed > 0.0 {
            last = run.time();
        }
        if (run.time() - 1.0 / speed()).abs() < run.dt() {
            middle = pressed;
        }
    });
    let half = run.velocity().len() / 2;
    let mean = |v: &[f64]| v.iter().step_by(2).sum::<f64>() / (v.len() / 2) as f64;
    let (left, right) = (mean(&run.velocity()[..half]), mean(&run.velocity()[half..]));
    // Contact: 2 l/c, pressure ρ c v/2; the front is spread over a few cells.
    let pressure = DENSITY * speed() * 0.5;
    assert!((last * speed() / 2.0 - 1.0).abs() < 0.02, "{last}");
    assert!((middle / pressure - 1.0).abs() < 0.02, "{middle} {pressure}");
    assert!((impulse / DENSITY - 1.0).abs() < 0.01, "{impulse}");
    assert!(left.abs() < 0.01 && (right - 1.0).abs() < 0.01, "{left} {right}");
    let budget = run.budget();
    // Displacements are a thousand times those of the elastic waves, so that forces lose three digits.
    assert!(budget.energies().imbalance() < 1e-10, "{budget:?}");
    assert!(budget.friction.abs() < 0.02 * budget.initial, "{budget:?}");
}

#[test]
fn bars_with_a_gap_between_them_meet_once_it_is_closed() {
    let gap = 1e-5;
    let problem = impact(0.02, gap);
    let mut first = None;
    run(&problem, |run| {
        if run.fault().normal[0] > 0.0 && first.is_none() {
            first = Some(run.time());
        }
    });
    assert!(
        (first.unwrap() - gap).abs()
            < 3.0 * problem.step_of(0, &super::stable(&problem.model, &problem.density, 0.0).unwrap())
    );
}

#[test]
fn restored_runs_continue_bit_for_bit_and_on_any_number_of_threads() {
    let problem = Problem { viscosity: 0.1, ..impact(0.02, 0.0) };
    let through = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| run(&problem, |_| ()).save())
    };
    let whole = through(1);
    assert_eq!(whole, through(2));
    let mut first = Explicit::new(&problem).unwrap();
    first.begin_stage(0).unwrap();
    for _ in 0..40 {
        first.step().unwrap();
    }
    let mut second = Explicit::new(&problem).unwrap();
    second.begin_stage(0).unwrap();
    assert!(second.restore(&first.save()));
    let steps = (problem.stages[0].end / second.dt()).round() as usize;
    for _ in 40..steps {
        second.step().unwrap();
    }
    assert_eq!(second.save(), whole);
}

#[test]
fn runs_of_many_pieces_have_the_same_bits_on_any_number_of_threads() {
    // Some ten thousand nodes: several tasks of each kind.
    let bar = bars(&[[0.0, 1.0]], 50, 0.005, Idealisation::PlaneStrain);
    let mut problem = Problem { viscosity: 0.1, ..problem(bar, Stage::free("go", 0.1 / speed())) };
    let wave = |x: &[f64; 2]| [(9.0 * x[0]).sin(), (7.0 * x[0] * x[1]).cos()];
    problem.velocity = problem.model.mesh.nodes.iter().flat_map(wave).collect();
    problem.absorbing = dashpots(&problem.model, &problem.density, &problem.model.mesh.side_sets["b0.right"]);
    let through = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| run(&problem, |_| ()).save())
    };
    assert_eq!(through(1), through(2));
}

#[test]
fn works_of_loads_prescribed_motions_and_damping_close_the_balance() {
    let bar = bars(&[[0.0, 1.0]], 2, 0.05, Idealisation::PlaneStrain);
    let mut stage = Stage::free("go", 1.5 / speed());
    let left: Vec<usize> = (0..3).map(|j| 21 * j * 2).collect();
    stage.fixed.clone_from(&left);
    stage.motions.push((left, crate::Motion::To(1e-4)));
    let forces = (0..3).map(|j| ((21 * j + 20) * 2 + 1, 1e5)).collect();
    stage.loads.push((None, Channel { prescribed: Vec::new(), forces, amplitude: Table::constant(1.0) }));
    let problem = Problem { viscosity: 0.2, ..problem(bar, stage) };
    let run = run(&problem, |_| ());
    let budget = run.budget();
    assert!(budget.loads > 0.0 && budget.motions > 0.0 && budget.viscous > 0.0, "{budget:?}");
    assert!(budget.energies().imbalance() < 1e-12, "{budget:?}");
    assert!((run.displacement()[0] - 1e-4).abs() < 1e-17);
}

#[test]
fn steps_beyond_the_stable_one_stop_the_run() {
    let mut problem = impact(0.02, 0.0);
    problem.courant = 1.05;
    problem.stages[0].end *= 20.0;
    let mut run = Explicit::new(&problem).unwrap();
    run.begin_stage(0).unwrap();
    let halt = (0..20_000).find_map(|_| run.step().err());
    assert!(matches!(halt, Some(super::Halt::Growth { .. })), "{halt:?}");
}

#[test]
fn absorbing_dashpots_are_the_impedances_times_the_area() {
    let model = bars(&[[0.0, 1.0]], 1, 0.5, Idealisation::PlaneStrain);
    let all = dashpots(&model, &[DENSITY], &model.mesh.side_sets["b0.right"]);
    let shear = (37.5e9_f64 * DENSITY).sqrt();
    assert_eq!(all.len(), 2);
    for dashpot in all {
        assert!((dashpot.damping[0][0] / (0.25 * DENSITY * speed()) - 1.0).abs() < 1e-12);
        assert!((dashpot.damping[1][1] / (0.25 * shear) - 1.0).abs() < 1e-12);
        assert_eq!(dashpot.damping[0][1], 0.0);
    }
}

#[test]
fn tied_bars_move_as_one() {
    let pulse = |x: f64| (-((x - 0.6) / 0.1).powi(2)).exp();
    let moving =
        |model: &Model<2>| -> Vec<f64> { model.mesh.nodes.iter().flat_map(|x| [pulse(x[0]), 0.0]).collect() };
    let whole = bars(&[[0.0, 2.0]], 1, 0.05, Idealisation::PlaneStress);
    let parts = bars(&[[0.0, 1.0], [1.0, 2.0]], 1, 0.05, Idealisation::PlaneStress);
    let (n, half) = (21, parts.mesh.nodes.len() / 2);
    let tie = |j: usize| Tie { minus: j * n + n - 1, plus: half + j * n };
    let fault = Fault {
        points: Vec::new(),
        law: Box::new(InertialPoints(Vec::<Coulomb>::new())),
        normal: Vec::new(),
        shear: Components::default(),
        rate: Components::default(),
        opens: false,
        regularisation: None,
        pulses: Vec::new(),
        forced: Vec::new(),
        onset: None,
        ties: vec![tie(0), tie(1)],
    };
    let end = Stage::free("go", 1.0 / speed());
    let velocity = moving(&whole);
    let one = Problem { velocity, ..problem(whole, end.clone()) };
    let velocity = moving(&parts);
    let two = Problem { velocity, fault: Some(fault), ..problem(parts, end) };
    let [one, two] = [&one, &two].map(|p| run(p, |_| ()).displacement().to_vec());
    let at = |x: usize| if x < n { two[2 * x] } else { two[2 * (half + x + 1 - n)] };
    for x in 0..2 * n - 1 {
        assert!((one[2 * x] - at(x)).abs() < 1e-12 / speed(), "{x}: {} {}", one[2 * x], at(x));
    }
}

#[test]
fn bodies_on_soft_springs_swing_with_their_mass_and_keep_their_energy() {
    let bar = bars(&[[0.0, 1.0]], 1, 0.25, Idealisation::PlaneStress);
    // Mass over stiffness gives a quarter period of a hundred travel times of waves.
    let mass = 0.25 * DENSITY;
    let omega = 0.5 * std::f64::consts::PI * speed() / 100.0;
    let mut stage = Stage::free("go", 100.0 / speed());
    stage.springs.push(crate::Spring {
        set: "b0.right".into(),
        axis: 0,
        dofs: vec![2 * 4, 2 * 9],
        stiffness: mass * omega * omega,
        rate: crate::Pace::Steady(0.0),
    });
    let velocity = bar.mesh.nodes.iter().flat_map(|_| [1.0, 0.0]).collect();
    let problem = Problem { velocity, ..problem(bar, stage) };
    let run = run(&problem, |_| ());
    assert!((run.displacement()[0] * omega - 1.0).abs() < 1e-3, "{}", run.displacement()[0] * omega);
    let budget = run.budget();
    // The bar moves 1/ω, and forces err by an ulp of E times that: their work is up to ε E/(2 ω²), 4e-12 of the energy m/2 put in.
    assert!(budget.energies().imbalance() < 1e-11, "{budget:?}");
    assert!((budget.loads / budget.initial + 1.0).abs() < 1e-3, "{budget:?}");
}

#[test]
fn elastic_energy_of_damped_bodies_is_that_of_their_displacements() {
    let bar = bars(&[[0.0, 1.0]], 3, 0.05, Idealisation::PlaneStrain);
    let velocity = (0..2 * bar.mesh.nodes.len()).map(|k| (0.37 * k as f64).sin()).collect();
    let long = Problem { viscosity: 0.1, velocity, ..problem(bar, Stage::free("go", 1e-3)) };
    let mut most: f64 = 0.0;
    run(&long, |run| {
        let before = run.displacement().iter().zip(run.velocity()).map(|(u, v)| u - run.dt() * v);
        let before: Vec<f64> = before.collect();
        let exact = long.model.blocks[0].linear().unwrap().strain_energy(&before);
        let found = run.budget();
        most = most.max(found.elastic);
        assert!((found.elastic - exact).abs() <= 1e-12 * most.max(exact), "{} {exact}", found.elastic);
        assert!(found.viscous >= 0.0 && found.energies().imbalance() <= 1e-12, "{found:?}");
    });
    assert!(most > 0.0);
}

#[test]
fn points_of_a_large_fault_slip_by_their_own_friction_in_the_first_step() {
    // 601 points, which no task takes alone. No wave has run from one to another yet.
    let (h, rows, normal, shear) = (0.01, 600, 10e6, 6e6);
    let model = bars(&[[0.0, 0.02], [0.02, 0.04]], rows, h, Idealisation::PlaneStress);
    let (points, half) = (rows + 1, model.mesh.nodes.len() / 2);
    let area = |j: usize| if j == 0 || j == rows { 0.5 * h } else { h };
    let point = |j: usize| SplitPoint {
        minus: 3 * j + 2,
        plus: half + 3 * j,
        area: area(j),
        normal: [1.0, 0.0, 0.0],
        along: vec![[0.0, 1.0, 0.0]],
        gap: 0.0,
    };
    let friction = |j: usize| 0.3 + 0.4 * j as f64 / points as f64;
    let law = |j: usize| SlipWeakening::new(friction(j), 0.1, 1.0, None).unwrap();
    let fault = Fault {
        points: (0..points).map(point).collect(),
        law: Box::new(InertialPoints((0..points).map(law).collect())),
        normal: vec![normal; points],
        shear: Components::new(vec![shear; points], points),
        rate: Components::new(vec![0.0; points], points),
        opens: false,
        regularisation: None,
        pulses: Vec::new(),
        forced: Vec::new(),
        onset: None,
        ties: Vec::new(),
    };
    let problem = Problem { fault: Some(fault), ..problem(model, Stage::free("go", 1e-3)) };
    let mut explicit = Explicit::new(&problem).unwrap();
    explicit.begin_stage(0).unwrap();
    explicit.step().unwrap();
    let (dt, state) = (explicit.dt(), explicit.fault());
    for j in 0..points {
        // The first half step moves a column of ρ h/2 on each side.
        let strength = friction(j) * normal;
        let after = 0.5 * dt * (shear - strength).max(0.0) * 4.0 / (DENSITY * h);
        let close = |found: f64, expected: f64| (found - expected).abs() <= 1e-12 * expected.abs();
        assert!(close(state.shear.component(0)[j], strength.min(shear)), "{j}");
        assert!(close(state.rate.component(0)[j], 0.5 * after), "{j}");
        assert!(close(state.states.view().at(j)[0], after * dt), "{j}");
    }
}
