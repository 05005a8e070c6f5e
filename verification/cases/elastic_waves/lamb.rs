//! Lamb's problem: a line load on a half-plane.

use super::super::waves::{Rock, line, mesh, problem, run};
use crate::{Capability, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_fem::dof::Channel;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::table::Table;
use asperity_mechanics::dynamics::{dashpots, stable};
use serde_json::Value;
use std::f64::consts::TAU;

const ROCK: Rock = Rock { density: 2000.0, pressure: 3_464.101_615_137_754_5, shear: 2000.0 };

/// Side of the quarter of a plane that is meshed \[m\]. Waves come back from its sides after 2 s.
const EXTENT: f64 = 4000.0;

/// End of the comparison \[s\].
const END: f64 = 1.2;

/// Interval of the reference \[s\].
const INTERVAL: f64 = 0.02;

/// Part of a step by which the longest step exceeds the one that meets the times of the reference, so that rounding adds none.
const SLACK: f64 = 1e-6;

/// Points in the table of the load; a line between two of them is off by 1e-5 of the load.
const POINTS: usize = 400;

struct Reference {
    rise: f64,
    load: f64,
    /// Surface displacements along x and into the body at 500 m and 1000 m \[m\].
    receivers: Vec<(f64, Vec<[f64; 2]>)>,
}

impl Reference {
    fn read() -> Result<Self, CaseError> {
        let all: Value = serde_json::from_str(include_str!("../../independent/waves.json"))?;
        let lamb = &all["lamb"];
        let number =
            |v: &Value| v.as_f64().ok_or_else(|| CaseError::from("a number is missing in waves.json"));
        let list = |v: &Value| v.as_array().cloned().unwrap_or_default();
        let mut receivers = Vec::new();
        for receiver in list(&lamb["receivers"]).iter().take(2) {
            let [x, z] = ["u_x_m", "u_z_m"].map(|key| list(&receiver["smooth"][key]));
            let both = x.iter().zip(&z).map(|(x, z)| Ok([number(x)?, number(z)?]));
            receivers.push((number(&receiver["x_m"])?, both.collect::<Result<_, CaseError>>()?));
        }
        let parameters = &lamb["parameters"];
        Ok(Self { rise: number(&parameters["rise_s"])?, load: number(&parameters["f0_n_m"])?, receivers })
    }

    fn growth(&self, time: f64) -> f64 {
        let s = (time / self.rise).min(1.0);
        s - (TAU * s).sin() / TAU
    }
}

/// Surface displacements at the receivers at the times of the reference.
fn simulate(reference: &Reference, n: usize) -> Result<Vec<Vec<[f64; 2]>>, CaseError> {
    let h = EXTENT / n as f64;
    let quarter = mesh(&[[line(0.0, EXTENT, n), line(-EXTENT, 0.0, n)]], ElementKind::Quad4)?;
    let mut problem = problem(quarter, ROCK, Idealisation::PlaneStrain, END)?;
    let nodes = &problem.model.mesh.nodes;
    let node = |x: f64| nodes.iter().position(|p| p[1] == 0.0 && (p[0] - x).abs() < 0.1 * h);
    let at = |x: f64| node(x).ok_or_else(|| CaseError::from("no node at a receiver"));
    let receivers = reference.receivers.iter().map(|r| at(r.0)).collect::<Result<Vec<_>, _>>()?;
    let source = at(0.0)?;
    let fixed = nodes.iter().enumerate().filter(|(_, p)| p[0] == 0.0).map(|(n, _)| 2 * n).collect();
    let times = line(0.0, END, POINTS);
    let growth = times.iter().map(|t| reference.growth(*t)).collect();
    let channel = Channel {
        prescribed: Vec::new(),
        // Half of the load belongs to the other half of the plane.
        forces: vec![(2 * source + 1, -0.5 * reference.load)],
        amplitude: Table::new(times, growth),
    };
    problem.stages[0].fixed = fixed;
    problem.stages[0].loads.push((None, channel));
    let sides = ["b0.right", "b0.bottom"].map(|s| problem.model.mesh.side_sets[s].clone()).concat();
    problem.absorbing = dashpots(&problem.model, &problem.density, &sides);
    // Steps that meet the times of the reference.
    let limit = stable(&problem.model, &problem.density, 0.0)?.step;
    let each = (INTERVAL / (0.9 * limit)).ceil();
    problem.courant = INTERVAL / (each - SLACK) / limit;
    let mut found = vec![vec![[0.0; 2]]; receivers.len()];
    run(&problem, |run| {
        if run.steps() % each as usize == 0 {
            for (list, node) in found.iter_mut().zip(&receivers) {
                let u = &run.displacement()[2 * node..];
                list.push([u[0], -u[1]]);
            }
        }
    })?;
    Ok(found)
}

/// Largest difference over all receivers and times, over the largest displacement.
fn error(reference: &Reference, found: &[Vec<[f64; 2]>]) -> f64 {
    let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
    for ((_, exact), found) in reference.receivers.iter().zip(found) {
        for (e, f) in exact.iter().zip(found) {
            for c in 0..2 {
                worst = worst.max((e[c] - f[c]).abs());
                largest = largest.max(e[c].abs());
            }
        }
    }
    worst / largest
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let reference = Reference::read()?;
    let (mut levels, mut last) = (Vec::new(), (Vec::new(), Cost::default()));
    for n in [80, 160, 320] {
        let (found, cost) = Cost::measure(|| simulate(&reference, n));
        let found = found?;
        levels.push((EXTENT / n as f64, error(&reference, &found)));
        last = (found, cost.count("cells", (n * n) as f64));
    }
    ledger
        .order("Lamb's line load: surface displacements at 500 m and 1000 m")
        .norm("largest difference over the largest displacement")
        .levels(&levels)
        .expected(2.0)
        .within(0.25)
        .evidence(Evidence::Exact, "Cagniard-de Hoop, convolved with the load (verification/independent/waves.py)")
        .because("second order in cells and steps; the load at one node is singular at the source alone")
        .finest(
            2e-3,
            "waves of 0.4 s run 1000 m in a phase of 2.5 pi; (k h)²/24 of it with k = 2 pi/(0.4 s 1839 m/s), three times for shorter waves",
        )
        .covers(&[Capability::Waves])
        .cost(&last.1)
        .record();
    let curve = |values: &[[f64; 2]], c: usize| {
        values.iter().enumerate().map(|(k, v)| (k as f64 * INTERVAL, v[c])).take(61).collect::<Vec<_>>()
    };
    let mut plot =
        Plot::xy("Surface displacements at 1000 m from a line load", "time [s]", "displacement [m]");
    for (c, name) in ["along x", "into the body"].into_iter().enumerate() {
        plot = plot
            .series(Series::line(format!("{name}, closed form"), &curve(&reference.receivers[1].1, c)))
            .series(Series::points(format!("{name}, cells of 12.5 m"), &curve(&last.0[1], c)));
    }
    ledger.plot(plot);
    Ok(())
}
