//! Compressed operators in space, against those with all entries.

use crate::cases::fault_medium::triangles::{DISC, FROM_FILE, halved, planned, weakening};
use crate::cases::seas;
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_cycles::operator::Form;
use asperity_plan::faults::Plan;
use asperity_vary::SceneText;

/// Tolerances of the compression relative to each block.
const TOLERANCES: [f64; 2] = [1e-3, 1e-7];

/// Runs all claims.
pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for example in &EXAMPLES {
        entries(ledger, example)?;
    }
    interval(ledger)
}

/// Plan of a bent fault of triangles, whose slip may turn and changes normal tractions.
fn bent(form: Form) -> Result<Plan, CaseError> {
    let (cells, size) = ([16, 7], 800.0);
    let mut triangles = halved(60.0, cells, (size, 0.0));
    // A second part that dips less.
    let depth = cells[1] as f64 * size;
    let (s, c) = 60f64.to_radians().sin_cos();
    let lower = halved(25.0, cells, (size, 0.0));
    let shift = |[x, y, z]: [f64; 3]| [x + depth * c, y - depth * s, z];
    triangles.extend(lower.into_iter().map(|triangle| triangle.map(shift)));
    let geometry = format!("{FROM_FILE}\nslip = \"free\"\nunder_resolved = \"allow\"");
    let disc = "{ centre = [\"3 km\", \"-5 km\", 0], radius = \"4 km\" }";
    planned(&weakening(&geometry, disc), &triangles, form)
}

/// Tractions of slip: shear, component by component, and normal.
fn tractions(plan: &Plan, slip: &[f64]) -> Vec<f64> {
    let operator = &plan.problem.fault.operator;
    [operator.shear_of(slip), operator.normal_of(slip)].concat()
}

/// Tractions of unit slip of each point in each component, and of uniform slip in the first.
fn all(plan: &Plan) -> (Vec<Vec<f64>>, Vec<f64>) {
    let n = plan.points.len();
    let mut slip = vec![0.0; 2 * n];
    let mut unit = |p: usize| {
        slip[p] = 1.0;
        let found = tractions(plan, &slip);
        slip[p] = 0.0;
        found
    };
    let units = (0..2 * n).map(&mut unit).collect();
    let uniform: Vec<f64> = (0..2 * n).map(|p| if p < n { 1.0 } else { 0.0 }).collect();
    (units, tractions(plan, &uniform))
}

/// Norm of the differences over that of the second.
fn off(found: &[f64], wanted: &[f64]) -> f64 {
    let difference: f64 = found.iter().zip(wanted).map(|(a, b)| (a - b).powi(2)).sum();
    (difference / wanted.iter().map(|b| b * b).sum::<f64>()).sqrt()
}

/// Share of the size of a fault from which points count as distant.
const DISTANT: f64 = 0.5;

/// As [`off`] of the tractions caused by unit slip of points, where only tractions of distant points count.
fn off_at_distance(plan: &Plan, found: &[Vec<f64>], wanted: &[Vec<f64>]) -> f64 {
    let n = plan.points.len();
    let apart = |p: usize, q: usize| {
        let (a, b) = (plan.points[p].at, plan.points[q].at);
        (0..3).map(|c| (a[c] - b[c]).powi(2)).sum::<f64>().sqrt()
    };
    let size = (0..n).map(|p| apart(0, p)).fold(0.0, f64::max);
    let distant = |all: &[Vec<f64>]| -> Vec<f64> {
        let of = |(q, tractions): (usize, &Vec<f64>)| {
            let counts = (0..tractions.len()).filter(|k| apart(k % n, q % n) > DISTANT * size);
            counts.map(|k| tractions[k]).collect::<Vec<f64>>()
        };
        all.iter().enumerate().flat_map(of).collect()
    };
    off(&distant(found), &distant(wanted))
}

/// A fault whose operator is compared with all entries.
struct Example {
    /// Name for the claims.
    name: &'static str,
    /// The operator with all entries.
    source: &'static str,
    /// Reason for the bound.
    because: &'static str,
    covers: [Capability; 2],
    plan: fn(Form) -> Result<Plan, CaseError>,
}

/// Operators from single entries, and from the forces of condensed bodies.
const EXAMPLES: [Example; 2] = [
    Example {
        name: "a bent fault of triangles",
        source: "the operator with all entries of the same kernels",
        because: "each block has this error relative to itself, so that the whole has it, too",
        covers: [Capability::Medium, Capability::Solid3d],
        plan: bent,
    },
    Example {
        name: "a fault between unlike bodies",
        source: "the dense operator from the same condensation",
        because: "each block of distant clusters has this error relative to itself, and the others have none",
        covers: [Capability::FaultCycles, Capability::Solid3d],
        plan: between_bodies,
    },
];

/// Frobenius' norm of the error of tractions over that of the tractions, of all and of those at distant points.
fn entries(ledger: &mut Ledger, example: &Example) -> Result<(), CaseError> {
    let words = |plan: &Plan| plan.problem.fault.operator.words();
    let Example { name, source, because, covers, plan } = example;
    let dense = plan(Form::Dense)?;
    let (units, uniform) = all(&dense);
    let wanted = units.concat();
    let mut rows = Vec::new();
    for tolerance in TOLERANCES {
        let (compressed, cost) = Cost::measure(|| plan(Form::Compressed { tolerance }));
        let compressed = compressed?;
        let (found, of_uniform) = all(&compressed);
        rows.push([
            format!("{tolerance:e}"),
            compressed.problem.fault.operator.bytes().to_string(),
            format!("{:.1e}", off(&of_uniform, &uniform)),
            words(&compressed),
        ]);
        let distant = "all of these lie in blocks of low rank, whose errors are relative to all of their entries, also to those of points less distant";
        let claims = [
            (
                "all tractions",
                off(&found.concat(), &wanted),
                tolerance,
                *because,
                "blocks stored in full have no error, and they have the largest entries",
            ),
            (
                "tractions at distant points",
                off_at_distance(&dense, &found, &units),
                2.0 * tolerance,
                distant,
                "which blocks hold them depends on the division",
            ),
        ];
        for (which, error, bound, because, why_not_tighter) in claims {
            ledger
                .claim(format!("{name}, {} points, slip may turn: Frobenius' norm of the error of {which} over theirs, tolerance {tolerance:e}", dense.points.len()))
                .value(error)
                .at_most(bound)
                .evidence(Evidence::Exact, *source)
                .between(&words(&dense), &words(&compressed))
                .because(because)
                .why_not_tighter(why_not_tighter)
                .covers(covers)
                .cost(&cost)
                .record();
        }
    }
    ledger.table(*name, &["tolerance", "bytes", "error of uniform slip", "operator"], rows);
    Ok(())
}

/// Sides of the cells of the fault between bodies.
const SIDE: &str = "2.5 km";

/// Plan of a fault between bodies, whose slip may turn and changes normal tractions, as the rock of its sides differs.
fn between_bodies(form: Form) -> Result<Plan, CaseError> {
    let text = SceneText::new(include_str!("../../../scenes/fault-3d.toml"))
        .add("materials.stiff", "{ young = \"120 GPa\", poisson = 0.25, density = \"2670 kg/m^3\" }")
        .with("bodies.east.material", "stiff")
        .with("bodies.west.mesh.block.spacing[1].size", SIDE)
        .with("bodies.west.mesh.block.spacing[2].size", SIDE)
        .with("bodies.east.mesh.block.spacing[1].size", SIDE)
        .with("bodies.east.mesh.block.spacing[2].size", SIDE)
        .add("faults.main.under_resolved", "allow")
        .text()?;
    super::plan(&text, form)
}

/// Cells along strike of the fault of the cycle.
const COLUMNS: usize = 18;

/// The interval of two events with the operator that the plan chooses, and with all entries.
fn interval(ledger: &mut Ledger) -> Result<(), CaseError> {
    let size = 1e3;
    let text = weakening(FROM_FILE, DISC);
    let triangles = halved(90.0, [COLUMNS, 15], (size, 0.0));
    let (mut found, mut words, mut spent) = (Vec::new(), Vec::new(), None);
    for form in [Form::Dense, Form::Fitting] {
        let plan = planned(&text, &triangles, form)?;
        let mut settings = plan.problem.settings;
        settings.most_events = Some(2);
        settings.tolerance = 1e-6;
        let run = seas::found(&plan, &settings, |_| {})?;
        found.push(run.onsets[1] - run.onsets[0]);
        words.push(plan.problem.fault.operator.words());
        spent = Some(run.cost);
    }
    ledger
        .claim("interval of two events on a fault of 540 triangles, compressed as the plan chooses, relative to that with all entries")
        .value((found[1] / found[0] - 1.0).abs())
        .at_most(1e-4)
        .evidence(Evidence::ConvergedSelf, "the operator with all entries, both with a tolerance of 1e-6 in ln V")
        .between(&words[0], &words[1])
        .because("the largest effect that a default may have on recurrence; uniform slip, which sets it, has a larger error than random slip")
        .why_not_tighter("other roundings make other steps")
        .covers(&[Capability::Medium, Capability::Solid3d, Capability::FaultCycles])
        .cost(&spent.ok_or("no run")?)
        .record();
    Ok(())
}
