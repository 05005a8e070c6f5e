//! Steppers on the sandwich, compared with each other and with a reference converged in time.

use super::sandwich::{self, PRESSED, Run, Scene};
use crate::{Capability, Case, CaseError, Cost, Evidence, Floor, Ledger, Plot, Series};
use asperity_plan::reading::scene::model::{Path, Rule, here};

/// See the README.
pub const CASE: Case = Case {
    name: "sandwich_steppers",
    readme: include_str!("README.md"),
    covers: &[
        Capability::Implicit,
        Capability::StaticExplicit,
        Capability::VelocityFriction,
        Capability::Condensation,
    ],
    quick: true,
    run,
};

/// Element size of this case \[mm\].
const SIZE: f64 = 2.5;
const SOURCE: &str = "verification/independent, Radau at 1e-10, same mesh: converged to 1e-8 um in time";

/// Slip histories of the independent solver at eight nodes and ten load levels.
struct Reference {
    heights: Vec<f64>,
    times: Vec<f64>,
    slips: Vec<Vec<f64>>,
}

impl Reference {
    fn read() -> Result<Self, CaseError> {
        let all: serde_json::Value = serde_json::from_str(include_str!("../../independent/results.json"))?;
        let probes = &all["base"]["2.5"]["probes"];
        let numbers = |v: &serde_json::Value| serde_json::from_value::<Vec<f64>>(v.clone());
        let loads = numbers(&probes["u_y_mm"])?;
        Ok(Self {
            heights: numbers(&probes["y_mm"])?.iter().map(|y| y * 1e-3).collect(),
            times: loads.iter().map(|u| PRESSED + u * 1e3).collect(),
            slips: serde_json::from_value(probes["slip_um_rows_u_y_columns_probes"].clone())?,
        })
    }

    /// Largest difference of slip of a run \[um\].
    fn error(&self, run: &Run) -> Result<f64, CaseError> {
        let mut largest = 0.0_f64;
        for (column, &y) in self.heights.iter().enumerate() {
            let slips = run.slip_at(run.node_at(y)?, &self.times);
            for (row, slip) in slips.iter().enumerate() {
                largest = largest.max((slip - self.slips[row][column]).abs());
            }
        }
        Ok(largest)
    }
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let reference = Reference::read()?;
    let implicit = implicit(ledger, &reference)?;
    let explicit = static_explicit(ledger, &reference)?;
    work_precision(ledger, &reference, &implicit, &explicit)?;
    paths(ledger)
}

fn base() -> Result<Scene, CaseError> {
    Ok(sandwich::size(sandwich::base()?, SIZE))
}

/// Error, wall time and solves of a setting.
#[derive(Clone, Copy)]
struct Setting {
    step: f64,
    error: f64,
    wall: f64,
    solves: f64,
}

fn measure(scene: &Scene, step: f64, reference: &Reference) -> Result<(Setting, Run, Cost), CaseError> {
    let (run, cost) = Cost::measure(|| sandwich::simulate(scene));
    let run = run?;
    let error = reference.error(&run)?;
    let wall = run.report.seconds.steps;
    let setting = Setting { step, error, wall, solves: run.report.counts.operations.solves as f64 };
    let cost = cost.counts(&run.report.counts);
    Ok((setting, run, cost))
}

fn levels(settings: &[Setting]) -> Vec<(f64, f64)> {
    settings.iter().map(|s| (s.step, s.error)).collect()
}

/// Equal steps: backward Euler is first order, BDF2 second order.
fn implicit(ledger: &mut Ledger, reference: &Reference) -> Result<[Vec<Setting>; 2], CaseError> {
    let mut all = [Vec::new(), Vec::new()];
    for (rule, list) in [Rule::BackwardEuler, Rule::Bdf2].into_iter().zip(&mut all) {
        let mut cost = None;
        for steps in [500, 1000, 2000, 4000, 8000] {
            let mut scene = sandwich::equal_steps(base()?, steps);
            scene.time.rule = Some(here(rule));
            let (setting, _, spent) = measure(&scene, 50.0 / steps as f64, reference)?;
            list.push(setting);
            cost = Some(spent);
        }
        let cost = cost.ok_or("no level was run")?;
        let (name, order, finest) = match rule {
            Rule::BackwardEuler => ("backward Euler", 1.0, 1e-3),
            Rule::Bdf2 => ("BDF2", 2.0, 5e-6),
        };
        ledger
            .order(format!("slip histories in the time step, implicit, {name}"))
            .unit("um")
            .levels(&levels(list))
            .expected(order)
            .within(0.2)
            .floor(Floor::Time, 1e-8)
            .finest(finest, "local error of the rule at the curvature of the slip histories during onset")
            .evidence(Evidence::OtherCode, SOURCE)
            .because("order of the backward difference; onset passes the face, so that the worst probe changes from level to level")
            .cost(&cost)
            .record();
    }
    Ok(all)
}

/// Step ends of the second stage that a static-explicit run chose, with the load levels of the reference added.
fn sequence(reference: &Reference) -> Result<Vec<f64>, CaseError> {
    let mut scene = sandwich::static_explicit(base()?);
    scene.time.rate_change = Some(here(0.25));
    scene.time.drift = None;
    scene.stages[0].steps = Some(here(1));
    let run = sandwich::simulate(&scene)?;
    let mut ends: Vec<f64> = run.record.times().iter().copied().filter(|t| *t > PRESSED).collect();
    ends.extend(&reference.times);
    ends.sort_by(f64::total_cmp);
    ends.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    Ok(ends)
}

/// The sequence with every step cut into `factor` equal ones.
fn refined(ends: &[f64], factor: usize) -> Vec<f64> {
    let mut start = PRESSED;
    let mut result = vec![PRESSED];
    for &end in ends {
        result.extend(
            (1..=factor)
                .map(|k| if k == factor { end } else { start + (end - start) * k as f64 / factor as f64 }),
        );
        start = end;
    }
    result
}

/// Drift at u_y = 0.015 mm, when half of the face slides.
fn drift(run: &Run) -> Result<f64, CaseError> {
    let time = PRESSED + 15.0;
    let record = run.record.records().iter().find(|r| (r.time - time).abs() < 1e-6);
    Ok(record.ok_or("no step ends at u_y = 0.015 mm")?.drift)
}

/// One sequence of steps refined by a common factor. Each step takes up the residual of the one before; there are no
/// corrections.
fn static_explicit(ledger: &mut Ledger, reference: &Reference) -> Result<Vec<Setting>, CaseError> {
    let ends = sequence(reference)?;
    let (mut list, mut drifts) = (Vec::new(), Vec::new());
    let mut cost = None;
    for factor in [1, 2, 4, 8] {
        let mut scene = sandwich::static_explicit(base()?);
        scene.time.rate_change = Some(here(4.0));
        scene.time.imposed = Some(refined(&ends, factor));
        let (setting, run, spent) = measure(&scene, 1.0 / factor as f64, reference)?;
        drifts.push((setting.step, drift(&run)?));
        list.push(setting);
        cost = Some(spent);
    }
    let cost = cost.ok_or("no level was run")?;
    // The slip rate of a point grows from the floor, 1e-12 V_load, in steps of a quarter e-fold, refined to 1/32. The
    // last step leaves an error of half the square of that in ln V, 5e-4, and a/mu0 times that in the traction.
    ledger
        .order("drift at u_y = 0.015 mm in the refinement")
        .levels(&drifts)
        .expected(2.0)
        .within(0.25)
        .floor(Floor::Rounding, 1e-13)
        .finest(8e-6, "a/2 times the square of the step in ln V that the last step leaves, over 0.6")
        .evidence(Evidence::SemiAnalytic, "local error of a forward step")
        .because("a forward step leaves a residual of second order, and the next takes it up: only the last one is there")
        .cost(&cost)
        .covers(&[Capability::StaticExplicit])
        .record();
    ledger
        .order("slip histories in the refinement, static-explicit")
        .unit("um")
        .levels(&levels(&list))
        .expected(1.0)
        .within(0.25)
        .floor(Floor::Time, 1e-8)
        .finest(2e-2, "backward Euler on the same steps")
        .evidence(Evidence::OtherCode, SOURCE)
        .because("V = slip increment over step is backward Euler")
        .why_not_tighter("the bound is that of the implicit steps with which they are compared")
        .cost(&cost)
        .covers(&[Capability::StaticExplicit])
        .record();
    Ok(list)
}

/// Plots error against wall time and number of solves.
fn work_precision(
    ledger: &mut Ledger,
    reference: &Reference,
    implicit: &[Vec<Setting>; 2],
    explicit: &[Setting],
) -> Result<(), CaseError> {
    let mut adaptive = Vec::new();
    for tolerance in [1e-8, 1e-9, 1e-10, 1e-11] {
        adaptive.push(measure(&sandwich::tolerance(base()?, tolerance), tolerance, reference)?.0);
    }
    let mut limited = Vec::new();
    for change in [2.0, 1.0, 0.5, 0.25, 0.125] {
        let mut scene = sandwich::static_explicit(base()?);
        scene.time.rate_change = Some(here(change));
        scene.time.drift = None;
        limited.push(measure(&scene, change, reference)?.0);
    }
    let series: [(&str, &[Setting]); 5] = [
        ("implicit, backward Euler, equal steps", &implicit[0]),
        ("implicit, BDF2, equal steps", &implicit[1]),
        ("implicit, backward Euler, adaptive", &adaptive),
        ("static-explicit, sequence refined, not corrected", explicit),
        ("static-explicit, corrected, bound on ln V refined", &limited),
    ];
    for (label, work) in [
        ("wall time of the steps [s]", (|s: &Setting| s.wall) as fn(&Setting) -> f64),
        ("solves", |s: &Setting| s.solves),
    ] {
        let mut plot = Plot::work_precision(
            format!("Slip histories: error against {label}"),
            "largest error of slip [um]",
            label,
        );
        for (name, settings) in series {
            let points: Vec<(f64, f64)> = settings.iter().map(|s| (s.error, work(s))).collect();
            plot = plot.series(Series::marked(name, &points));
        }
        ledger.plot(plot);
    }
    let at = |settings: &[Setting]| {
        settings.iter().filter(|s| s.error < 1e-2).map(|s| s.solves).fold(f64::INFINITY, f64::min)
    };
    ledger.table(
        "Fewest solves that reach an error of slip below 0.01 um",
        &["method", "solves"],
        series.map(|(name, settings)| [name.to_string(), format!("{:.0}", at(settings))]),
    );
    Ok(())
}

/// Agreement of the condensed and the full system.
fn paths(ledger: &mut Ledger) -> Result<(), CaseError> {
    let slips = |path: Path| -> Result<_, CaseError> {
        let mut scene = sandwich::equal_steps(base()?, 50);
        scene.time.path = path;
        let (run, cost) = Cost::measure(|| sandwich::simulate(&scene));
        let run = run?;
        let cost = cost.counts(&run.report.counts);
        Ok((run.end("shear")?.slip.clone(), cost, run.report.plan.path.clone()))
    };
    let (condensed, _, one) = slips(Path::Condensed)?;
    let (full, cost, other) = slips(Path::Full)?;
    let largest = full.iter().map(|s| s.abs()).fold(0.0, f64::max);
    let difference = condensed.iter().zip(&full).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / largest;
    ledger
        .claim("difference of slip between the condensed and the full system")
        .between(&one, &other)
        .value(difference)
        .at_most(1e-9)
        .evidence(Evidence::Exact, "block elimination of the interior")
        .because("the tolerance of Newton's method, 1e-11 of the largest force, times the softness of the blocks against the penalty")
        .why_not_tighter("Newton usually ends far below its tolerance")
        .covers(&[Capability::Condensation])
        .cost(&cost)
        .record();
    Ok(())
}
