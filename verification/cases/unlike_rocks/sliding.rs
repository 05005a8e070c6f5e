//! Both rocks with their fault, and its slip rates.

use super::super::waves::{Cut, Rock, bump, cut, line, mesh, nodes_on, problem_of, run as steps};
use crate::{CaseError, Cost};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_friction::coulomb::Coulomb;
use asperity_friction::inertial::InertialPoints;
use asperity_friction::points::Components;
use asperity_mechanics::dynamics::{Fault, Problem, Pulse, Regularisation};

/// The stiffer rock lies above. The units of length, time and density are the radius of the imposed traction, the time in which its shear
/// waves pass it, and its density, so that the modulus is 1.
const STIFF: Rock = Rock { density: 1.0, pressure: 1.732_050_807_568_877_2, shear: 1.0 };

/// Contrast of densities and of wave speeds (Andrews & Ben-Zion 1997).
const CONTRAST: f64 = 1.2;

/// Half length and half width of the rock: what its sides reflect does not reach the middle half of the fault before the end.
const EXTENT: [f64; 2] = [6.0, 5.0];

/// End of the runs.
const END: f64 = 4.0;

/// Coefficient of friction, and normal and shear traction: the fault slides steadily.
const MU: f64 = 0.75;
const NORMAL: f64 = 1e-3;
const SHEAR: f64 = MU * NORMAL;

/// Slip rate at the start.
const RATE: f64 = 1e-3;

/// Imposed traction at the centre, its radius and its rise: so little that nothing sticks or opens where growth is slow.
const PULSE: (f64, f64, f64) = (1e-8, 1.0, 1.0);

/// Delay: at the slip rate of the start friction follows within a tenth of the unit of time.
pub(super) const DELAY: Regularisation = Regularisation { length: 2e-4, rate: 1e-3 };

/// Result of a run.
pub(super) struct SlipRun {
    /// Spacing of nodes.
    pub spacing: f64,
    /// Position, and change of the slip rate over the imposed traction over ρ c_s.
    pub changes: Vec<(f64, f64)>,
    pub cost: Cost,
}

/// Both rocks with the fault between them.
fn rocks(spacing: f64, delay: Option<Regularisation>) -> Result<Problem<2>, CaseError> {
    let [nx, ny] = EXTENT.map(|l| (l / spacing).round() as usize);
    let x = line(-EXTENT[0], EXTENT[0], 2 * nx);
    let parts = [[x.clone(), line(-EXTENT[1], 0.0, ny)], [x, line(0.0, EXTENT[1], ny)]];
    let soft = Rock {
        density: STIFF.density / CONTRAST,
        pressure: STIFF.pressure / CONTRAST,
        shear: STIFF.shear / CONTRAST,
    };
    let mesh = mesh(&parts, ElementKind::Quad4)?;
    let mut problem = problem_of(mesh, &[soft, STIFF], Idealisation::PlaneStrain, END)?;
    let below = problem.model.mesh.blocks[0].connectivity.iter().copied().max().unwrap_or(0);
    let v = |n: usize| if n <= below { -0.5 * RATE } else { 0.5 * RATE };
    problem.velocity = (0..problem.model.mesh.nodes.len()).flat_map(|n| [v(n), 0.0]).collect();
    problem.courant = 0.5;
    problem.fault = Some(fault(&problem, delay)?);
    Ok(problem)
}

fn fault(problem: &Problem<2>, delay: Option<Regularisation>) -> Result<Fault, CaseError> {
    let Cut { at, points } = cut(&problem.model)?;
    let n = at.len();
    let (traction, radius, rise) = PULSE;
    Ok(Fault {
        points,
        law: Box::new(InertialPoints(vec![Coulomb::new(MU, None)?; n])),
        normal: vec![NORMAL; n],
        shear: Components::new(vec![SHEAR; n], n),
        rate: Components::new(vec![RATE; n], n),
        opens: true,
        regularisation: delay,
        pulses: vec![Pulse { amplitude: at.iter().map(|x| traction * bump(*x, radius)).collect(), rise }],
        forced: Vec::new(),
        onset: None,
        ties: Vec::new(),
    })
}

/// Runs both rocks to the end.
pub(super) fn slip(spacing: f64, delay: Option<Regularisation>) -> Result<SlipRun, CaseError> {
    let problem = rocks(spacing, delay)?;
    let (result, cost) = Cost::measure(|| steps(&problem, |_| ()));
    let last = result?;
    let cost = cost.count("cells", last.product().cells() as f64).count("steps", last.steps() as f64);
    let at = nodes_on(&problem.model, "b0.top");
    let change = |v: &f64| (v - RATE) * STIFF.density * STIFF.shear / PULSE.0;
    let changes = at.iter().zip(last.fault().rate.all()).map(|((_, x), v)| (*x, change(v))).collect();
    Ok(SlipRun { spacing, changes, cost })
}

impl SlipRun {
    /// Largest change of the slip rate.
    pub fn largest(&self) -> f64 {
        self.changes.iter().map(|(_, v)| v.abs()).fold(0.0, f64::max)
    }
}
