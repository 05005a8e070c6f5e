//! The compressed operator against the dense one.

mod space;

use crate::cases::{body_plots, fault_operator, seas};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_cycles::operator::Form;
use asperity_plan::faults::{Plan, plan_with};
use asperity_plan::reading::scene;
use asperity_vary::bp1::BP1;

/// See the README.
pub const CASE: Case = Case {
    name: "fault_compression",
    readme: include_str!("README.md"),
    covers: &[
        Capability::FaultCycles,
        Capability::Antiplane,
        Capability::PlaneStrain,
        Capability::Medium,
        Capability::Solid3d,
    ],
    quick: true,
    run,
};

/// Tolerance of the compression of scenes.
const TOLERANCE: f64 = 1e-10;

fn plan(text: &str, form: Form) -> Result<Plan, CaseError> {
    let scene = scene::read(text).map_err(|e| e.to_string())?;
    Ok(plan_with(&scene, form).map_err(|e| e.to_string())?)
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let dipping = fault_operator::through(30.0, 250.0);
    let mut rows = Vec::new();
    for (name, text) in [("BP1, 156 m", BP1), ("dip 30, 250 m", dipping.as_str())] {
        let dense = plan(text, Form::Dense)?;
        let (compressed, cost) = Cost::measure(|| plan(text, Form::Fitting));
        let compressed = compressed?;
        products(ledger, name, &dense, &compressed, &cost);
        rows.push([
            name.to_string(),
            dense.points.len().to_string(),
            dense.problem.fault.operator.bytes().to_string(),
            kept(&compressed),
        ]);
        if name == "BP1, 156 m" {
            first_event(ledger, dense, compressed)?;
        }
    }
    all_entries(ledger, "dip 30, 250 m", &dipping)?;
    space::run(ledger)?;
    ledger.table("operators", &["fault", "points", "dense [bytes]", "compressed"], rows);
    Ok(())
}

/// Slip distributions over the points \[m\] as functions of distance along the fault.
fn slips(plan: &Plan) -> [(&'static str, Vec<f64>); 4] {
    let n = plan.points.len();
    let along = |p: usize| plan.points[p].along;
    let all = |f: &dyn Fn(usize) -> f64| (0..n).map(f).collect::<Vec<f64>>();
    [
        ("smooth", all(&|p| (-(along(p) / 1e4 - 1.0).powi(2)).exp())),
        ("alternating", all(&|p| if p % 2 == 0 { 1.0 } else { -1.0 })),
        ("of one point", all(&|p| if p == n / 3 { 1.0 } else { 0.0 })),
        // Multiples of a prime modulo 1000.
        ("irregular", all(&|p| ((p * 7919) % 1000) as f64 / 1000.0)),
    ]
}

/// Shear tractions of slip, or its normal tractions if `normal`.
fn tractions(plan: &Plan, slip: &[f64], normal: bool) -> Vec<f64> {
    let operator = &plan.problem.fault.operator;
    if normal { operator.normal_of(slip) } else { operator.shear_of(slip) }
}

/// Draws normal tractions by the compressed operator on those by the dense one.
fn overlay(ledger: &mut Ledger, name: &str, plan: &Plan, [dense, compressed]: [&[f64]; 2]) {
    let at = |values: &[f64]| -> Vec<(f64, f64)> {
        plan.points.iter().zip(values).map(|(p, t)| (p.along / 1e3, t / 1e6)).collect()
    };
    ledger.plot(
        Plot::xy(
            format!("{name}: normal tractions of smooth slip"),
            "distance from the surface [km]",
            "traction [MPa]",
        )
        .series(Series::line("dense", &at(dense)))
        .series(Series::points("compressed", &body_plots::apart(&at(compressed)))),
    );
}

fn products(ledger: &mut Ledger, name: &str, dense: &Plan, compressed: &Plan, cost: &Cost) {
    let area = |p: usize| dense.points[p].area;
    // The largest entry of the force matrix is on its diagonal.
    let n = dense.points.len();
    let mut unit = vec![0.0; n];
    let mut largest = 0.0_f64;
    for p in 0..n {
        unit[p] = 1.0;
        largest = largest.max((tractions(dense, &unit, false)[p] * area(p)).abs());
        unit[p] = 0.0;
    }
    let kinds: &[(&str, bool)] = if dense.problem.fault.operator.couples_normal() {
        &[("shear", false), ("normal", true)]
    } else {
        &[("shear", false)]
    };
    for &(kind, normal) in kinds {
        let mut worst = 0.0_f64;
        for (shape, slip) in slips(dense) {
            let (a, b) = (tractions(dense, &slip, normal), tractions(compressed, &slip, normal));
            let norm = |v: &dyn Fn(usize) -> f64| (0..n).map(|p| v(p).powi(2)).sum::<f64>().sqrt();
            worst = worst.max(norm(&|p| (a[p] - b[p]) * area(p)) / (largest * norm(&|p| slip[p])));
            if shape == "smooth" {
                if normal {
                    overlay(ledger, name, dense, [&a, &b]);
                }
                let off = (0..n).map(|p| (a[p] - b[p]).abs()).fold(0.0, f64::max);
                ledger
                    .claim(format!("{name}: {kind} tractions of smooth slip, largest error over the largest traction"))
                    .value(off / a.iter().fold(0.0, |m: f64, v| m.max(v.abs())))
                    .at_most(1e-8)
                    .evidence(Evidence::Exact, "the dense operator from the same condensation")
                    .between(&kept(dense), &kept(compressed))
                    .because(
                        "slip over 10 km loads a point a hundredth to a thousandth as much as slip of that point alone, by which the \
                         tolerance is measured, and errors of entries add up over hundreds of points like their root",
                    )
                    .why_not_tighter("1e-10 is what single entries keep; errors of smooth slip depend on how they cancel")
                    .covers(&[Capability::FaultCycles])
                    .cost(cost)
                    .record();
            }
        }
        ledger
            .claim(format!(
                "{name}: error of {kind} forces over slip and the largest entry, worst of four slips"
            ))
            .value(worst)
            .at_most(TOLERANCE)
            .evidence(Evidence::Exact, "the dense operator from the same condensation")
            .between(&kept(dense), &kept(compressed))
            .because(
                "the tolerance bounds Frobenius' norm of the error, which bounds the error of any product",
            )
            .why_not_tighter("no single slip is the worst for all blocks at once")
            .covers(&[Capability::FaultCycles])
            .cost(cost)
            .record();
    }
}

/// Tolerances of compression.
const TOLERANCES: [f64; 3] = [1e-4, 1e-7, TOLERANCE];

/// Frobenius' norm of the error of all forces.
fn all_entries(ledger: &mut Ledger, name: &str, text: &str) -> Result<(), CaseError> {
    let dense = plan(text, Form::Dense)?;
    let n = dense.points.len();
    let kinds = if dense.problem.fault.operator.couples_normal() { &[false, true][..] } else { &[false] };
    let unit = |p: usize| {
        let mut slip = vec![0.0; n];
        slip[p] = 1.0;
        slip
    };
    let force = |t: &[f64], p: usize| t[p] * dense.points[p].area;
    let largest = (0..n).map(|p| force(&tractions(&dense, &unit(p), false), p).abs()).fold(0.0, f64::max);
    for tolerance in TOLERANCES {
        let (compressed, cost) = Cost::measure(|| plan(text, Form::Compressed { tolerance }));
        let compressed = compressed?;
        for &normal in kinds {
            let mut sum = 0.0;
            for p in 0..n {
                let slip = unit(p);
                let (a, b) = (tractions(&dense, &slip, normal), tractions(&compressed, &slip, normal));
                sum += (0..n).map(|q| (force(&a, q) - force(&b, q)).powi(2)).sum::<f64>();
            }
            let kind = if normal { "normal" } else { "shear" };
            ledger
                .claim(format!("{name}: Frobenius' norm of the error of {kind} forces over the largest entry, tolerance {tolerance:e}"))
                .value(sum.sqrt() / largest)
                .at_most(tolerance)
                .evidence(Evidence::Exact, "the dense operator from the same condensation")
                .between(&kept(&dense), &kept(&compressed))
                .because("the tolerance is a bound of this norm")
                .why_not_tighter("blocks stored in full have no error, and ranks are rounded up to groups of columns")
                .covers(&[Capability::FaultCycles])
                .cost(&cost)
                .record();
        }
    }
    Ok(())
}

/// Storage of the operator of a plan.
fn kept(plan: &Plan) -> String {
    plan.problem.fault.operator.words()
}

fn first_event(ledger: &mut Ledger, dense: Plan, compressed: Plan) -> Result<(), CaseError> {
    let forms = (kept(&dense), kept(&compressed));
    let mut onsets = [0.0; 2];
    let mut total = None;
    for (onset, mut plan) in onsets.iter_mut().zip([dense, compressed]) {
        plan.problem.settings.most_events = Some(1);
        plan.problem.settings.tolerance = 1e-6;
        let found = seas::found(&plan, &plan.problem.settings, |_| {})?;
        *onset = found.onsets[0];
        total = Some(found.cost);
    }
    let claim = ledger
        .claim("BP1, 156 m: onset of the first event with the compressed operator less that with the dense one")
        .unit("yr")
        .value((onsets[1] - onsets[0]).abs())
        .at_most(1e-5)
        .evidence(Evidence::ConvergedSelf, "the dense operator, both with a tolerance of 1e-6 in ln V")
        .between(&forms.0, &forms.1)
        .because("what the integration leaves at this tolerance; errors of 1e-9 in tractions shift no event by as much")
        .why_not_tighter("other roundings make other steps")
        .covers(&[Capability::FaultCycles]);
    match &total {
        Some(cost) => claim.cost(cost).record(),
        None => claim.record(),
    }
    Ok(())
}
