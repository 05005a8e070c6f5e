//! A bar of rubber that spins freely, at finite strain.

use super::problem;
use crate::cases::waves::run;
use crate::{Capability, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_mechanics::dynamics::Explicit;
use asperity_vary::SceneText;
use std::f64::consts::TAU;

const SCENE: &str = include_str!("spinning.toml");

/// Half length and half width \[m\].
const HALF: [f64; 2] = [0.5, 0.125];

/// Angular velocity \[rad/s\].
const SPIN: f64 = 2.0;
const DENSITY: f64 = 1000.0;
const YOUNG: f64 = 10e6;

const COVERS: [Capability; 2] = [Capability::FiniteStrain, Capability::Waves];

/// Σ x × m v per mass of a node, of velocities half a step before the positions \[m²/s\].
fn momentum(nodes: &[[f64; 2]], mass: &[f64], run: &Explicit<'_, 2>) -> f64 {
    let (u, v, dt) = (run.displacement(), run.velocity(), run.dt());
    let of = |(n, (x, m)): (usize, (&[f64; 2], &f64))| {
        // Positions at the start of the step that these velocities make.
        let [px, py] = [0, 1].map(|c| x[c] + u[2 * n + c] - dt * v[2 * n + c]);
        m * (px * v[2 * n + 1] - py * v[2 * n])
    };
    nodes.iter().zip(mass).enumerate().map(of).sum()
}

/// Measures of a bar that spins.
struct Spin {
    /// Positions of the nodes at the start \[m\].
    nodes: Vec<[f64; 2]>,
    /// Lumped masses over that of a cell.
    mass: Vec<f64>,
    /// Nodes at the lower left, the lower right and the upper left corner.
    corners: [usize; 3],
    /// Angular momentum in the first step.
    initial: Option<f64>,
    /// Largest relative change of the angular momentum.
    drift: f64,
    /// Direction of the lower side in the last step \[rad\].
    direction: Option<f64>,
    /// Angle through which the lower side has turned \[rad\].
    angle: f64,
    /// Largest change of the right angle between two sides \[rad\].
    shear: f64,
    energies: Vec<Energies>,
}

impl Spin {
    fn new(nodes: Vec<[f64; 2]>) -> Result<Self, CaseError> {
        // Lumped masses of quad4: a quarter of each cell.
        let share = |x: f64, end: f64| if x.abs() == end { 0.5 } else { 1.0 };
        let mass = nodes.iter().map(|[x, y]| share(*x, HALF[0]) * share(*y, HALF[1])).collect();
        let at = |x: f64, y: f64| nodes.iter().position(|n| *n == [x, y]).ok_or("no corner");
        let [long, high] = HALF;
        let corners = [at(-long, -high)?, at(long, -high)?, at(-long, high)?];
        Ok(Self {
            nodes,
            mass,
            corners,
            initial: None,
            drift: 0.0,
            direction: None,
            angle: 0.0,
            shear: 0.0,
            energies: Vec::new(),
        })
    }

    /// Measures the bar after a step.
    fn see(&mut self, run: &Explicit<'_, 2>) {
        let now = momentum(&self.nodes, &self.mass, run);
        let start = *self.initial.get_or_insert(now);
        self.drift = self.drift.max((now / start - 1.0).abs());
        let place = |n: usize| [0, 1].map(|c| self.nodes[n][c] + run.displacement()[2 * n + c]);
        let [first, along, up] = self.corners.map(place);
        let side = |to: [f64; 2]| (to[1] - first[1]).atan2(to[0] - first[0]);
        let direction = side(along);
        let right = side(up) - direction - 0.25 * TAU;
        self.shear = self.shear.max((right - TAU * (right / TAU).round()).abs());
        let before = self.direction;
        self.direction = Some(direction);
        if let Some(before) = before {
            let turn: f64 = direction - before;
            self.angle += turn - TAU * (turn / TAU).round();
        }
        let (time, stored) = (run.time() - run.dt(), run.nonlinear()[0].strain_energy());
        let budget = run.budget();
        self.energies.push(Energies { time, stored, work: budget.elastic, kinetic: budget.kinetic });
    }
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut problem = problem(SceneText::new(SCENE))?;
    problem.velocity = problem.model.mesh.nodes.iter().flat_map(|[x, y]| [-SPIN * y, SPIN * x]).collect();
    let mut spin = Spin::new(problem.model.mesh.nodes.clone())?;
    let (result, cost) = Cost::measure(|| run(&problem, |run: &mut Explicit<'_, 2>| spin.see(run)));
    let last = result?;
    let cost = cost.count("steps", last.steps() as f64);
    // The strain of a bar that spins is of the size ρ ω² l²/E, l half its length.
    let strain = DENSITY * (HALF[0] * SPIN).powi(2) / YOUNG;
    ledger
        .claim("bar that spins freely: drift of its angular momentum over two turns")
        .norm("largest relative change")
        .value(spin.drift)
        .at_most(1e-14)
        .evidence(
            Evidence::Exact,
            "symmetric stresses exert no moment on the positions at which forces are evaluated",
        )
        .because("each of 1e4 steps rounds by 1e-16, in either direction: the root of their number remains")
        .covers(&COVERS)
        .cost(&cost)
        .record();
    let elapsed = last.time() - last.dt();
    ledger
        .claim("bar that spins freely: angle through which a side turns in 6 s")
        .unit("rad")
        .value(spin.angle)
        .equals(SPIN * elapsed)
        .absolute(4.0 * strain * SPIN * elapsed)
        .evidence(Evidence::Exact, "ω t of a rigid bar")
        .because("centrifugal stretch of the size ρ ω² l²/E, twice that where it starts at once, slows the spin by twice as much")
        .covers(&COVERS)
        .cost(&cost)
        .record();
    ledger
        .claim("bar that spins freely: largest change of its right angles")
        .unit("rad")
        .value(spin.shear)
        .at_most(0.2 * strain)
        .evidence(Evidence::Exact, "centrifugal forces stretch the bar and do not shear it")
        .because("sides bend by the strain times the square of width over length, 1/16, three times that where it starts at once; a stress that did not turn with the bar would shear it by a strain a radian")
        .covers(&COVERS)
        .cost(&cost)
        .record();
    stored(ledger, &spin.energies, strain, &cost);
    Ok(())
}

/// Energies at a time \[J/m\].
#[derive(Clone, Copy)]
struct Energies {
    time: f64,
    /// Of the stresses.
    stored: f64,
    /// Work of the forces.
    work: f64,
    kinetic: f64,
}

/// Claims on energies.
fn stored(ledger: &mut Ledger, energies: &[Energies], strain: f64, cost: &Cost) {
    let spin = energies[0].kinetic;
    let most = energies.iter().map(|e| e.stored).fold(0.0, f64::max);
    let apart = energies.iter().map(|e| (e.stored - e.work).abs()).fold(0.0, f64::max);
    ledger
        .claim("bar that spins freely: largest strain energy over its kinetic energy")
        .value(most / spin)
        .at_most(2.0 * strain)
        .evidence(Evidence::Exact, "a rotation strains nothing: what is left is the centrifugal stretch")
        .because("the stretch of a rod holds 0.4 ρ ω² l²/E, and four times that where it starts at once; half an eighth is for its width")
        .covers(&COVERS)
        .cost(cost)
        .record();
    ledger
        .claim("bar that spins freely: energy of the stresses less the work of the forces, over the largest")
        .value(apart / most)
        .at_most(4e-3)
        .evidence(Evidence::Exact, "energy balance")
        .because("forces are those at the ends of steps: (w dt)²/8 = 1e-3 of the lowest vibration, at 330 rad/s and steps of 0.27 ms, and shorter ones hold less")
        .covers(&COVERS)
        .cost(cost)
        .record();
    let part = |of: fn(&Energies) -> f64| -> Vec<(f64, f64)> {
        energies.iter().map(|e| (e.time, of(e) / spin)).collect()
    };
    ledger.plot(
        Plot::xy("A bar that spins: energy", "time [s]", "energy over the kinetic energy [-]")
            .series(Series::line("of the stresses", &part(|e| e.stored)))
            .series(Series::line("work of the forces", &part(|e| e.work))),
    );
}
