//! Waves that meet an absorbing side at an angle.
//!
//! A strip guides a wave of one crest across it. It meets the ends of the strip at the angle whose tangent is k_y/k_x. Two packets
//! run from the middle to both ends, and the energy left afterwards is that of the reflected waves. Both halves are alike, so that
//! one is computed.

use super::super::waves::{Rock, line, mesh, problem, run};
use crate::{Capability, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_mechanics::dynamics::dashpots;
use serde_json::Value;
use std::f64::consts::PI;

/// Speeds in the proportion of λ = G.
const ROCK: Rock = Rock { density: 1.0, pressure: 1.732_050_807_568_877_2, shear: 1.0 };

/// Angles of incidence \[degrees\].
const ANGLES: [f64; 3] = [30.0, 45.0, 60.0];

/// Wavenumber along the strip times the width of the packet \[-\].
const WIDTH: f64 = 16.0;

/// Cells across the strip.
const ACROSS: usize = 12;

#[derive(Clone, Copy, PartialEq)]
enum Wave {
    /// Out of the plane.
    Shear,
    /// In the plane.
    InPlane,
    Pressure,
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let table: Value = serde_json::from_str(include_str!("../../independent/waves.json"))?;
    let rows = &table["dashpots"]["lambda = mu"];
    for (wave, name) in [(Wave::Shear, "SH"), (Wave::InPlane, "SV"), (Wave::Pressure, "P")] {
        let energy = &rows[name]["energy"];
        let mut found = Vec::new();
        for degrees in ANGLES {
            let ((left, reference), cost) = {
                let (result, cost) = Cost::measure(|| reflected(wave, degrees, energy));
                (result?, cost)
            };
            found.push((degrees, left));
            ledger
                .claim(format!("energy that {name} waves leave behind at {degrees} degrees, over theirs"))
                .value(left)
                .equals(reference)
                .absolute(bound(degrees, reference))
                .evidence(Evidence::Exact, "tractions of incoming and reflected plane waves equal those of the dashpots")
                .because(
                    "dashpots at nodes s apart reflect (k_x s)²/16 of an amplitude by themselves, and a packet of 16 radians is not a plane wave by 1/16²",
                )
                .covers(&[Capability::Waves])
                .cost(&cost)
                .record();
        }
        let curve: Vec<(f64, f64)> =
            (0..80_u32).filter_map(|d| Some((f64::from(d), energy[d as usize].as_f64()?))).collect();
        ledger.plot(
            Plot::xy(
                format!("Energy reflected by dashpots, {name} waves"),
                "angle of incidence [degrees]",
                "reflected over incoming energy",
            )
            .series(Series::line("plane waves", &curve))
            .series(Series::points("packets on the mesh", &found)),
        );
    }
    Ok(())
}

/// Bound on the reflected energy. On lumped nodes a distance s apart the condition at a dashpot reads `cos(k s/2) (1 - R) = 1 + R` for waves of
/// normal incidence, so that `R = -tan²(k s/4)` where there should be none; quad9 has two nodes to a cell. Packets add the square of
/// their width in wavenumbers.
fn bound(degrees: f64, energy: f64) -> f64 {
    let k_x = PI / degrees.to_radians().tan();
    let own = (k_x / (2.0 * ACROSS as f64)).powi(2) / 16.0;
    2.0 * energy.sqrt() * own + own * own + energy / (WIDTH * WIDTH)
}

/// Energy left by a packet over its own, and the mean of the reflection over its wavenumbers.
fn reflected(wave: Wave, degrees: f64, energy: &Value) -> Result<(f64, f64), CaseError> {
    let k_y = PI;
    let k_x = k_y / degrees.to_radians().tan();
    let (width, speed) = (WIDTH / k_x, if wave == Wave::Pressure { ROCK.pressure } else { ROCK.shear });
    let half = 4.0 * width;
    let n = (half * ACROSS as f64).round() as usize;
    let strip = mesh(&[[line(0.0, half, n), line(0.0, 1.0, ACROSS)]], ElementKind::Quad9)?;
    let group = speed * degrees.to_radians().cos();
    let space = if wave == Wave::Shear { Idealisation::Antiplane } else { Idealisation::PlaneStrain };
    let mut problem = problem(strip, ROCK, space, 2.0 * half / group)?;
    let envelope = |x: f64| (-0.5 * (x / width).powi(2)).exp();
    // Derivatives of a potential, envelope(x) cos(k_x x) cos(k_y y), without their factors in y.
    let along = |x: f64| envelope(x) * (-k_x * (k_x * x).sin() - x / (width * width) * (k_x * x).cos());
    let across = |x: f64| envelope(x) * (k_x * x).cos() * -k_y;
    let nodes = &problem.model.mesh.nodes;
    problem.velocity = match wave {
        Wave::Shear => nodes.iter().map(|[x, y]| envelope(*x) * (k_x * x).cos() * (k_y * y).cos()).collect(),
        // The gradient of a potential: no shear wave in it.
        Wave::Pressure => nodes
            .iter()
            .flat_map(|[x, y]| [along(*x) * (k_y * y).cos(), across(*x) * (k_y * y).sin()])
            .collect(),
        // The curl of a potential: no pressure wave in it.
        Wave::InPlane => nodes
            .iter()
            .flat_map(|[x, y]| [across(*x) * (k_y * y).sin(), -along(*x) * (k_y * y).cos()])
            .collect(),
    };
    problem.stages[0].fixed = fixed(wave, nodes);
    let end = problem.model.mesh.side_sets["b0.right"].clone();
    problem.absorbing = dashpots(&problem.model, &problem.density, &end);
    let budget = run(&problem, |_| ())?.budget();
    Ok(((budget.kinetic + budget.elastic) / budget.initial, mean(energy, wave, [k_x, k_y], width)))
}

/// Degrees of freedom held at the walls, which no wave leaves through and which reflect it into itself, and in the middle, where
/// one of the two displacements is odd.
///
/// For P waves walls are frictionless and rigid, as the potential has no slope there. For SV waves they are free across and held
/// along, as neither that displacement nor that traction is in the wave.
fn fixed(wave: Wave, nodes: &[[f64; 2]]) -> Vec<usize> {
    let [walls, middle] = match wave {
        Wave::Shear => return Vec::new(),
        Wave::InPlane => [0, 1],
        Wave::Pressure => [1, 0],
    };
    let held = |on: &dyn Fn(&[f64; 2]) -> bool, component: usize| {
        let on = nodes.iter().enumerate().filter(|(_, x)| on(x));
        on.map(|(n, _)| 2 * n + component).collect::<Vec<usize>>()
    };
    [held(&|x| x[1] == 0.0 || x[1] == 1.0, walls), held(&|x| x[0] == 0.0, middle)].concat()
}

/// Mean of the reflected energy over the wavenumbers of a packet; those of its envelope are as wide as 1/width.
fn mean(energy: &Value, wave: Wave, [k_x, k_y]: [f64; 2], width: f64) -> f64 {
    let at = |k: f64| {
        let degrees = k_y.atan2(k).to_degrees();
        let (low, part) = (degrees.floor() as usize, degrees.fract());
        let value = |d: usize| energy[d].as_f64().unwrap_or(f64::NAN);
        value(low) * (1.0 - part) + value(low + 1) * part
    };
    let weights = (-40..=40).map(|i| f64::from(i) * 0.1);
    let (mut sum, mut total) = (0.0, 0.0);
    for z in weights {
        let k = k_x + z / width;
        // Velocities that are derivatives of a potential grow with the wavenumber.
        let gradient = if wave == Wave::Shear { 1.0 } else { k * k + k_y * k_y };
        let weight = gradient * (-z * z).exp();
        sum += weight * at(k);
        total += weight;
    }
    sum / total
}
