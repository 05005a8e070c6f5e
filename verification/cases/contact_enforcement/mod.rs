//! Penalty, Uzawa's method and Lagrange multipliers as unknowns against the exact solution of the constrained problem, over eight
//! decades of the penalty.

mod condition;
mod tie;

use crate::{Axis, Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity::kinds;
use asperity::kinds::bodies::RunReport;
use asperity_output::bodies::Recorder;
use asperity_plan::bodies;
use asperity_plan::reading::scene as reader;
use asperity_plan::reading::scene::model::{
    BlockMesh, EnforcementKind, Loading, Measure, MeshSource, Scene, here,
};
use asperity_plan::reading::scene::units::{Penalty, Penetration};
use asperity_run::report::Outcome;

/// See the README.
pub const CASE: Case = Case {
    name: "contact_enforcement",
    readme: include_str!("README.md"),
    covers: &[Capability::Multipliers, Capability::Coulomb, Capability::Mortar, Capability::PenaltyContact2d],
    quick: true,
    run,
};

const YOUNG: f64 = 1000.0;
/// G of material without lateral contraction \[Pa\].
const SHEAR: f64 = 500.0;
const MU: f64 = 0.3;
const DOWN: f64 = 0.01;
const ALONG: f64 = 0.02;
/// E/h of the slave \[Pa/m\].
const UNIT: f64 = 4000.0;
/// Penetration tolerance of Uzawa's method over the element size.
const TOLERANCE: f64 = 1e-9;
/// Exponents of the penalties over E/h.
const DECADES: std::ops::RangeInclusive<i32> = -2..=6;

const KINDS: [(EnforcementKind, &str); 3] = [
    (EnforcementKind::Penalty, "penalty"),
    (EnforcementKind::Uzawa, "Uzawa"),
    (EnforcementKind::AugmentedLagrangian, "augmented Lagrangian"),
];

const MEASURES: [(Measure, &str, usize); 2] =
    [(Measure::NodeToPoint, "node-to-point, 4 on 4", 4), (Measure::Mortar, "mortar, 4 on 5", 5)];

/// Pressure, shear traction and slip at the end, for contact with this compliance \[m/Pa\].
#[derive(Clone, Copy)]
struct Exact {
    pressure: f64,
    shear: f64,
    slip: f64,
    /// Tangential displacement at which slip begins \[m\].
    onset: f64,
}

impl Exact {
    fn new(compliance: f64) -> Self {
        let pressure = DOWN / (2.0 / YOUNG + compliance);
        let soft = 2.0 / SHEAR + compliance;
        let strength = MU * pressure;
        let onset = strength * soft;
        let shear = strength.min(ALONG / soft);
        Self { pressure, shear, slip: ALONG - shear * soft, onset }
    }
}

/// Results of a run.
struct EnforcementRun {
    report: RunReport,
    cost: Cost,
    /// Largest relative errors against the constrained problem: pressure, shear traction, slip.
    errors: [f64; 3],
    /// Largest relative deviations from the solution with springs of the penalty stiffness.
    springs: [f64; 3],
    penetration: f64,
    /// Iterations and augmentations of the pressing step, and of all steps.
    press: (usize, usize),
    all: (usize, usize),
    /// Augmentations of the last step, in which the block slides under constant tractions.
    sliding: usize,
}

fn scene(
    kind: EnforcementKind,
    factor: f64,
    measure: Measure,
    lower: usize,
) -> Result<(Scene, Exact), CaseError> {
    let mut scene = reader::read(include_str!("scene.toml")).map_err(|e| format!("scene.toml: {e}"))?;
    let body = scene.bodies.get_mut("lower").ok_or("the scene has no lower body")?;
    let MeshSource::Block(BlockMesh { divisions, .. }) = &mut body.mesh else {
        return Err("the lower body is no block".into());
    };
    *divisions = Some(here(vec![lower, lower]));
    let interface = scene.interfaces.get_mut("contact").ok_or("the scene has no interface")?;
    interface.measure = here(measure);
    let enforcement = &mut interface.enforcement;
    enforcement.kind = here(kind);
    enforcement.normal = here(Penalty::YoungPerSize(factor));
    enforcement.tangential = Some(here(Penalty::YoungPerSize(factor)));
    if kind == EnforcementKind::Uzawa {
        enforcement.penetration = Some(here(Penetration::Sizes(TOLERANCE)));
        enforcement.augmentations = Some(here(2000));
    }
    let penalty = if kind == EnforcementKind::Penalty { (factor * UNIT).recip() } else { 0.0 };
    let exact = Exact::new(penalty);
    let begins = exact.onset / ALONG;
    for condition in &mut scene.stages[1].conditions {
        if condition.get_ref().traction.is_none() {
            continue;
        }
        let right = condition.get_ref().set.as_ref().is_some_and(|s| s.get_ref().ends_with(".right"));
        let t = if right { exact.shear } else { -exact.shear };
        let corner = Some((begins, t)).filter(|_| begins < 1.0);
        let course =
            [Some((0.0, 0.0)), corner, Some((1.0, t))].into_iter().flatten().collect::<Vec<_>>().into();
        condition.get_mut().traction = Some(here(vec![Loading::Fixed(0.0), Loading::Table(course)]));
    }
    Ok((scene, exact))
}

fn run_one(
    kind: EnforcementKind,
    factor: f64,
    measure: Measure,
    lower: usize,
) -> Result<EnforcementRun, CaseError> {
    let (scene, springs) = scene(kind, factor, measure, lower)?;
    let plan = bodies::plan(&scene).map_err(|e| e.to_string())?;
    let mut record = Recorder::new();
    let (report, cost) = Cost::measure(|| kinds::bodies::run(&plan, &mut record));
    let report = report?;
    if let Outcome::Stopped { reason, .. } = &report.outcome {
        return Err(format!("stopped: {reason}").into());
    }
    let cost = cost.counts(&report.counts);
    let end = record.stage_end("shear").ok_or("the stage was not reached")?;
    let fields = &end.interfaces[0];
    let rigid = Exact::new(0.0);
    let worst = |values: &[f64], exact: f64, scale: f64| {
        let off = |v: &f64| (v.abs() - exact).abs() / scale;
        values.iter().map(off).fold(0.0, |a: f64, b| if b > a || b.is_nan() { b } else { a })
    };
    let against = |exact: &Exact| {
        [
            worst(&fields.normal_traction, exact.pressure, exact.pressure),
            worst(&fields.shear_traction, exact.shear, exact.shear),
            worst(&fields.slip, exact.slip, ALONG),
        ]
    };
    let (press, last) = report.steps.first().zip(report.steps.last()).ok_or("no step")?;
    Ok(EnforcementRun {
        errors: against(&rigid),
        springs: against(&springs),
        penetration: report.steps.iter().map(|s| s.penetration).fold(0.0, f64::max),
        press: (press.iterations, press.augmentations),
        all: (report.counts.operations.iterations, report.counts.operations.augmentations),
        sliding: last.augmentations,
        cost,
        report,
    })
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (measure, name, lower) in MEASURES {
        let mut rows = Vec::new();
        let mut curves = Vec::new();
        for (kind, kind_name) in KINDS {
            let mut found = Vec::new();
            for decade in DECADES {
                let factor = 10f64.powi(decade);
                let one = run_one(kind, factor, measure, lower)
                    .map_err(|e| CaseError::from(format!("{kind_name}, {factor} E/h, {name}: {e}")))?;
                rows.push(row(kind_name, factor, kind, &one)?);
                found.push((factor, one));
            }
            claim(ledger, kind, name, &found);
            curves.push(Series::marked(kind_name, &points(&found)));
        }
        ledger.table(
            format!("pressed and sheared blocks, {name}; errors against the constrained problem"),
            &[
                "enforcement",
                "penalty/(E/h)",
                "pressure",
                "shear",
                "slip",
                "penetration (m)",
                "iterations, press/all",
                "augmentations, press/all",
                "condition",
            ],
            rows,
        );
        let mut plot =
            Plot::xy(format!("Error of the pressure, {name}"), "penalty over E/h", "relative error");
        for curve in curves {
            plot = plot.series(curve);
        }
        ledger.plot(plot.axes(Axis::Log, Axis::Log).caption("Errors below 1e-16 are drawn there."));
    }
    tie::claims(ledger)?;
    conditions(ledger)
}

fn points(found: &[(f64, EnforcementRun)]) -> Vec<(f64, f64)> {
    found.iter().map(|(f, one)| (*f, one.errors[0].max(1e-16))).collect()
}

fn row(
    name: &str,
    factor: f64,
    kind: EnforcementKind,
    one: &EnforcementRun,
) -> Result<[String; 9], CaseError> {
    let [p, t, s] = one.errors.map(|e| format!("{e:.1e}"));
    let condition = condition::number(kind, factor)?;
    Ok([
        name.to_string(),
        format!("{factor:e}"),
        p,
        t,
        s,
        format!("{:.1e}", one.penetration),
        format!("{}/{}", one.press.0, one.all.0),
        format!("{}/{}", one.press.1, one.all.1),
        format!("{condition:.1e}"),
    ])
}

fn claim(ledger: &mut Ledger, kind: EnforcementKind, name: &str, found: &[(f64, EnforcementRun)]) {
    match kind {
        EnforcementKind::Penalty => penalty(ledger, name, found),
        EnforcementKind::Uzawa => uzawa(ledger, name, found),
        EnforcementKind::AugmentedLagrangian => unknowns(ledger, name, found),
    }
}

/// Largest value, NaN if any is.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |a: f64, b| if b > a || b.is_nan() { b } else { a })
}

fn penalty(ledger: &mut Ledger, name: &str, found: &[(f64, EnforcementRun)]) {
    for (factor, one) in found {
        ledger
            .claim(format!("pressure, shear traction and slip with the springs of {factor:e} E/h, {name}"))
            .norm("largest relative deviation, that of slip over the motion imposed")
            .value(largest(one.springs.into_iter()))
            .at_most((1e-14 * factor).max(1e-11))
            .evidence(Evidence::Exact, "blocks and springs in series, sliding at mu times the pressure")
            .because(
                "a gap is a difference of displacements, whose rounding the penalty multiplies: 1e-16 times 0.01 m times eps \
                 over a pressure of 5 Pa is 1e-15 of eps over E/h",
            )
            .why_not_tighter("iterations end at 1e-11 of the largest force, and rounding varies with the mesh")
            .covers(&[Capability::Coulomb])
            .cost(&one.cost)
            .record();
    }
    let stiff: Vec<(f64, f64)> = found
        .iter()
        .filter(|(f, _)| (10.0..=1e5).contains(f))
        .map(|(f, one)| ((f * UNIT).recip(), one.errors[0]))
        .collect();
    let (compliance, error) = stiff.get(3).copied().unwrap_or((f64::NAN, f64::NAN));
    let finest = stiff.last().map_or(f64::NAN, |l| l.0);
    ledger
        .order(format!("error of the pressure of the penalty in 1/eps, {name}"))
        .levels(&stiff)
        .expected(1.0)
        .within(0.02)
        .because("the error is x/(1 + x) with x = E/(2 eps) = 1.2 % at 10 E/h, of which the logarithm bends by half")
        .finest(
            1.01 * 0.5 * YOUNG * finest,
            "the spring's compliance over that of the blocks: E/(2 eps) of the pressure to first order, and rounding",
        )
        .evidence(Evidence::Exact, "1/(1 + 2 eps/E)")
        .why_not_tighter("the second order is 1.2 % at 10 E/h")
        .record();
    ledger
        .claim(format!("coefficient of 1/eps in that error at 1e4 E/h, {name}"))
        .unit("Pa/m")
        .value(error / compliance)
        .equals(0.5 * YOUNG)
        .relative(2e-5)
        .evidence(Evidence::Exact, "E/2 over the height of a block")
        .because("the second order is E/(2 eps) = 1.25e-5 of the first, and rounding of 1e-11 of the pressure 1e-6 of it")
        .why_not_tighter("that second order is in the value")
        .record();
}

fn uzawa(ledger: &mut Ledger, name: &str, found: &[(f64, EnforcementRun)]) {
    let tolerance = TOLERANCE / 4.0;
    ledger
        .claim(format!(
            "penetration of Uzawa's method, the largest over eight decades of the penalty, {name}"
        ))
        .unit("m")
        .value(largest(found.iter().map(|(_, one)| one.penetration)))
        .at_most(tolerance)
        .evidence(Evidence::Exact, "the tolerance asked for")
        .because("that is what the rounds end at")
        .why_not_tighter("a tolerance is used up")
        .covers(&[Capability::Multipliers])
        .record();
    ledger
        .claim(format!("tractions and slip of Uzawa's method against the constrained problem, over eight decades, {name}"))
        .norm("largest relative error, that of slip over the motion imposed")
        .value(largest(found.iter().flat_map(|(_, one)| one.errors)))
        .at_most(1e-6)
        .evidence(Evidence::Exact, "blocks in series, sliding at mu times the pressure")
        .because(
            "a gap or tangential rest of the tolerance, 2.5e-10 m, at single nodes meets the stiffness of the blocks over an element, \
             some E/h: 1e-6 Pa, 7e-7 of the shear traction of 1.5 Pa; where all points move as one it is 2.5e-8",
        )
        .why_not_tighter("the gap left is anywhere between the tolerance and the share a round leaves of it")
        .covers(&[Capability::Multipliers, Capability::Coulomb])
        .record();
    for (factor, one) in found.iter().filter(|(f, _)| *f <= 100.0) {
        let penalty = factor * UNIT;
        let left = penalty.recip() / (penalty.recip() + 2.0 / YOUNG);
        let first = 0.5 * YOUNG * DOWN * (1.0 - left) / penalty;
        let rounds = (tolerance / first).ln() / left.ln();
        ledger
            .claim(format!("augmentations of the pressing step at {factor:e} E/h, {name}"))
            .value(one.press.1 as f64)
            .equals(rounds.ceil())
            .absolute(0.5)
            .evidence(
                Evidence::Exact,
                "each round leaves 1/(1 + 2 eps/E) of the gap, from that of the penalty on",
            )
            .because(
                "a count; the gap before the last round differs from the tolerance by far more than rounding",
            )
            .why_not_tighter("the next smaller bound of a count is none")
            .cost(&one.cost)
            .record();
        ledger
            .claim(format!("augmentations of the last step, at {factor:e} E/h, {name}"))
            .count(one.sliding as u64, 0)
            .evidence(
                Evidence::Exact,
                "the block slides under constant tractions, which are those of the step before",
            )
            .because("multipliers that are kept from step to step leave no gap to close")
            .covers(&[Capability::Multipliers])
            .cost(&one.cost)
            .record();
    }
}

fn unknowns(ledger: &mut Ledger, name: &str, found: &[(f64, EnforcementRun)]) {
    ledger
        .claim(format!("penetration with multipliers as unknowns, the largest over eight decades, {name}"))
        .unit("m")
        .value(largest(found.iter().map(|(_, one)| one.penetration)))
        .at_most(1e-15)
        .evidence(Evidence::Exact, "there is none")
        .because("rounding of displacements of 0.02 m is 3.5e-18 m, of which a gap is a sum over some ten nodes and their solution")
        .why_not_tighter("rounding varies with mesh and pivots")
        .covers(&[Capability::Multipliers])
        .record();
    ledger
        .claim(format!(
            "tractions and slip with multipliers as unknowns, over eight decades of the penalty, {name}"
        ))
        .norm("largest relative error, that of slip over the motion imposed")
        .value(largest(found.iter().flat_map(|(_, one)| one.errors)))
        .at_most(1e-11)
        .evidence(Evidence::Exact, "blocks in series, sliding at mu times the pressure")
        .because("iterations end when the residual is 1e-11 of the largest force")
        .why_not_tighter("that end is not changed by the case")
        .covers(&[Capability::Multipliers, Capability::Coulomb])
        .record();
    let worst = found
        .iter()
        .map(|(_, one)| one.report.steps.iter().map(|s| s.iterations).max().unwrap_or(usize::MAX));
    let worst = worst.max().unwrap_or(usize::MAX);
    ledger
        .claim(format!("iterations of the longest step with multipliers as unknowns, over eight decades, {name}"))
        .value(worst as f64)
        .at_most(6.0)
        .evidence(Evidence::Exact, "a semi-smooth Newton method ends in finitely many iterations on a piecewise linear problem")
        .because(
            "two for the linear problem (the diagonal that keeps the tangent regular leaves 1e-8 of the violation), and two for each \
             change of status: all points together, from stick to slip",
        )
        .why_not_tighter("the count of changes is known, that of the iterations each takes is not")
        .covers(&[Capability::Multipliers])
        .record();
}

/// Condition number of the system in stick against the penalty.
fn conditions(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut curves = Vec::new();
    let mut of_unknowns = Vec::new();
    for (kind, name) in [KINDS[0], KINDS[2]] {
        let mut points = Vec::new();
        for decade in DECADES {
            let factor = 10f64.powi(decade);
            points.push((factor, condition::number(kind, factor)?));
        }
        if kind == EnforcementKind::Penalty {
            let stiff: Vec<(f64, f64)> = points.iter().filter(|p| p.0 >= 1e3).copied().collect();
            let growth = (stiff[stiff.len() - 1].1 / stiff[0].1).log10()
                / (stiff[stiff.len() - 1].0 / stiff[0].0).log10();
            ledger
                .claim("power of the penalty with which the condition of the penalty's system grows, 1e3 to 1e6 E/h")
                .value(growth)
                .equals(1.0)
                .absolute(0.01)
                .evidence(Evidence::Exact, "the largest eigenvalue is that of the springs, the smallest that of the bodies")
                .because("at 1e3 E/h the bodies add a thousandth to the largest eigenvalue")
                .why_not_tighter("that share, over three decades")
                .record();
        } else {
            of_unknowns = points.iter().map(|p| p.1).collect();
        }
        curves.push(Series::marked(name, &points));
    }
    let (low, high) = of_unknowns.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), &c| (l.min(c), h.max(c)));
    ledger
        .claim("condition of the system with multipliers as unknowns: largest over smallest in eight decades, less one")
        .value(high / low - 1.0)
        .at_most(1e-9)
        .evidence(Evidence::Exact, "the penalty does not enter the tangent of closed points that stick")
        .because("rounding of singular values: 1e-16 times the condition")
        .why_not_tighter("a condition of 1e4 leaves 1e-12 and may vary with the machine")
        .covers(&[Capability::Multipliers])
        .record();
    let mut plot =
        Plot::xy("Condition of the system in stick", "penalty over E/h", "condition in the 2-norm");
    for curve in curves {
        plot = plot.series(curve);
    }
    ledger.plot(plot.axes(Axis::Log, Axis::Log));
    Ok(())
}
