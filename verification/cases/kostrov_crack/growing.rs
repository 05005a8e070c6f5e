//! Rock around a crack that grows, and its slip.

use super::super::waves::{Cut, Rock, cut, line, mesh, nodes_on, problem, run as steps};
use super::front::Front;
use crate::{CaseError, Cost};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_friction::points::Components;
use asperity_mechanics::dynamics::{Explicit, Fault, Problem, dashpots};

pub(super) const ROCK: Rock = Rock { density: 2670.0, pressure: 6000.0, shear: 3464.0 };

/// Speed of both fronts \[m/s\].
pub(super) const SPEED: f64 = 0.5 * ROCK.shear;

/// Half length of the crack at the end \[m\].
pub(super) const HALF: f64 = 6000.0;

/// Stress drop \[Pa\].
pub(super) const DROP: f64 = 1e6;

/// Normal traction \[Pa\]; it does not act on the crack.
const NORMAL: f64 = 100e6;

/// Time of Kelvin-Voigt viscosity over the step: points that start one by one emit waves as short as the cells.
const VISCOSITY: f64 = 0.3;

/// Share of the duration at which slip is read for the first time.
const EARLIER: f64 = 0.9;

/// Modes III and II.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Mode {
    Antiplane,
    Plane,
}

/// Slip at two times.
pub(super) struct Crack {
    /// Positions along the crack \[m\].
    pub at: Vec<f64>,
    /// Times \[s\] and slips \[m\].
    pub slips: Vec<(f64, Vec<f64>)>,
    pub cost: Cost,
}

/// Rock around the crack, so wide that no wave returns to it from the sides.
fn rock(mode: Mode, spacing: f64) -> Result<Problem<2>, CaseError> {
    let duration = HALF / SPEED;
    let (fastest, space) = match mode {
        Mode::Antiplane => (ROCK.shear, Idealisation::Antiplane),
        Mode::Plane => (ROCK.pressure, Idealisation::PlaneStrain),
    };
    let cells = |extent: f64| (extent / (2.0 * spacing)).ceil() as usize;
    let [nx, ny] = [0.5 * (fastest * duration + HALF), 0.5 * fastest * duration].map(cells);
    let [lx, ly] = [nx, ny].map(|n| 2.0 * spacing * n as f64);
    let x = line(-lx, lx, 2 * nx);
    let parts = [[x.clone(), line(-ly, 0.0, ny)], [x, line(0.0, ly, ny)]];
    let mut problem = problem(mesh(&parts, ElementKind::Quad9)?, ROCK, space, duration)?;
    let sides = ["b0.left", "b0.right", "b0.bottom", "b1.left", "b1.right", "b1.top"];
    let sides = sides.map(|s| problem.model.mesh.side_sets[s].clone()).concat();
    problem.absorbing = dashpots(&problem.model, &problem.density, &sides);
    problem.courant = 0.6;
    problem.viscosity = VISCOSITY;
    Ok(problem)
}

/// The crack between both halves of the rock.
fn fault(problem: &Problem<2>, spacing: f64) -> Result<Fault, CaseError> {
    let Cut { at, points } = cut(&problem.model)?;
    let n = at.len();
    Ok(Fault {
        points,
        law: Box::new(Front { at, speed: SPEED, spacing }),
        normal: vec![NORMAL; n],
        shear: Components::new(vec![DROP; n], n),
        rate: Components::new(vec![0.0; n], n),
        opens: false,
        regularisation: None,
        pulses: Vec::new(),
        forced: Vec::new(),
        onset: None,
        ties: Vec::new(),
    })
}

pub(super) fn grow(mode: Mode, spacing: f64) -> Result<Crack, CaseError> {
    let mut problem = rock(mode, spacing)?;
    problem.fault = Some(fault(&problem, spacing)?);
    let at = nodes_on(&problem.model, "b0.top").iter().map(|n| n.1).collect();
    let mut slips = Vec::new();
    let watch = |run: &mut Explicit<'_, 2>| {
        let (time, wanted) = (run.time() - run.dt(), [EARLIER, 1.0].map(|share| share * HALF / SPEED));
        // The state at a time is known after the next step.
        if slips.len() < 2 && time >= wanted[slips.len()] - 1.5 * run.dt() {
            slips.push((time, run.fault().slip.all().to_vec()));
        }
    };
    let (result, cost) = Cost::measure(|| steps(&problem, watch));
    let last = result?;
    let cost = cost.count("cells", last.product().cells() as f64).count("steps", last.steps() as f64);
    Ok(Crack { at, slips, cost })
}

/// Errors of slip and of the mean slip rate between both times: root mean squares of relative differences over nine and seven tenths of
/// the crack; the front has passed nine tenths at the earlier time.
pub(super) fn errors(crack: &Crack, factor: f64) -> Result<[f64; 2], CaseError> {
    let [(t1, d1), (t2, d2)] = &crack.slips[..] else {
        return Err("slip was read at fewer than two times".into());
    };
    let modulus = ROCK.density * ROCK.shear * ROCK.shear;
    let exact = |t: f64, x: f64| factor * DROP / modulus * ((SPEED * t).powi(2) - x * x).max(0.0).sqrt();
    let square = |share: f64, of: &dyn Fn(usize, f64) -> f64| {
        let near = crack.at.iter().enumerate().filter(|(_, x)| x.abs() < share * SPEED * t2);
        let all: Vec<f64> = near.map(|(k, &x)| of(k, x).powi(2)).collect();
        (all.iter().sum::<f64>() / all.len() as f64).sqrt()
    };
    let slip = square(0.9, &|k, x| d2[k] / exact(*t2, x) - 1.0);
    let rate = square(0.7, &|k, x| (d2[k] - d1[k]) / (exact(*t2, x) - exact(*t1, x)) - 1.0);
    Ok([slip, rate])
}
