//! Contact patch test on non-matching meshes: mortar passes, node-to-point does not.

mod overhang;
mod sliver;

use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity::kinds;
use asperity::kinds::bodies::RunReport;
use asperity_output::bodies::Recorder;
use asperity_output::fields::vtu::Cell;
use asperity_plan::bodies;
use asperity_plan::reading::scene as reader;
use asperity_plan::reading::scene::model::{
    BlockMesh, Condition, Kinematics, Measure, MeshSource, Motion, Scene, Sliding, here,
};
use asperity_plan::reading::scene::units::{Length, Penalty};
use asperity_run::report::Outcome;

/// See the README.
pub const CASE: Case = Case {
    name: "contact_patch_mortar",
    readme: include_str!("README.md"),
    covers: &[Capability::Mortar, Capability::PenaltyContact2d, Capability::PenaltyContact3d],
    quick: true,
    run,
};

const YOUNG: f64 = 1000.0;
const POISSON: f64 = 0.3;
const DOWN: f64 = 0.01;

/// Divisions of slave and master.
const PAIRS: [(usize, usize); 4] = [(4, 5), (5, 4), (8, 13), (13, 8)];

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut rows = Vec::new();
    for (slave, master) in PAIRS {
        for factor in [1.0, 100.0] {
            rows.push(plane(ledger, slave, master, factor)?);
        }
    }
    ledger.table(
        "largest deviation of s_yy from its mean over all Gauss points",
        &["slave, master divisions", "eps/(E/h)", "node-to-point", "mortar", "mortar, finite sliding"],
        rows,
    );
    second_order(ledger)?;
    axisymmetric(ledger)?;
    solids(ledger)?;
    overhang::claims(ledger)?;
    sliver::claims(ledger)
}

/// A completed run and the exact pressure of its scene.
struct PatchRun {
    report: RunReport,
    record: Recorder,
    exact: f64,
    cost: Cost,
}

fn mesh_of<'a>(scene: &'a mut Scene, body: &str) -> Result<&'a mut BlockMesh, CaseError> {
    match scene.bodies.get_mut(body).map(|b| &mut b.mesh) {
        Some(MeshSource::Block(mesh)) => Ok(mesh),
        _ => Err(format!("the scene has no block {body}").into()),
    }
}

fn base(
    slave: usize,
    master: usize,
    measure: Measure,
    sliding: Sliding,
    eps: f64,
) -> Result<Scene, CaseError> {
    let mut scene = reader::read(include_str!("scene.toml")).map_err(|e| format!("scene.toml: {e}"))?;
    for (body, n) in [("upper", slave), ("lower", master)] {
        mesh_of(&mut scene, body)?.divisions = Some(here(vec![n, n]));
    }
    let interface = scene.interfaces.get_mut("contact").ok_or("the scene has no interface")?;
    interface.measure = here(measure);
    interface.sliding = here(sliding);
    interface.enforcement.normal = here(Penalty::Value(eps));
    Ok(scene)
}

fn simulate(scene: &Scene, exact: f64) -> Result<PatchRun, CaseError> {
    let plan = bodies::plan(scene).map_err(|e| e.to_string())?;
    let mut record = Recorder::new().with_bodies();
    let (report, cost) = Cost::measure(|| kinds::bodies::run(&plan, &mut record));
    let report = report?;
    match &report.outcome {
        Outcome::Completed => {
            let cost = cost.counts(&report.counts);
            Ok(PatchRun { report, record, exact, cost })
        }
        Outcome::Stopped { reason, .. } => Err(format!("stopped: {reason}").into()),
        Outcome::Interrupted { .. } => Err("interrupted".into()),
    }
}

impl PatchRun {
    fn tractions(&self) -> Result<Vec<f64>, CaseError> {
        let end = self.record.stage_end("press").ok_or("the stage was not reached")?;
        Ok(end.interfaces[0].normal_traction.clone())
    }

    /// max |s_yy/mean - 1| over the 2 x 2 Gauss points of all (rectangular, bilinear) elements.
    fn stress_error(&self) -> Result<f64, CaseError> {
        let end = self.record.stage_end("press").ok_or("the stage was not reached")?;
        let u = &end.bodies.as_ref().ok_or("the bodies were not kept")?.displacement;
        let mesh = &self.record.setup().mesh;
        let (stiff, coupling) = (1.0 - POISSON, POISSON);
        let modulus = YOUNG / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON));
        let mut stress = Vec::new();
        for Cell { points: cell, .. } in &mesh.cells {
            let (a, c) = (mesh.nodes[cell[0]], mesh.nodes[cell[2]]);
            let size = [c[0] - a[0], c[1] - a[1]];
            let root = (1.0_f64 / 3.0).sqrt();
            for (s, t) in [(-root, -root), (root, -root), (root, root), (-root, root)] {
                let (s, t) = (0.5 * (1.0 + s), 0.5 * (1.0 + t));
                let dx = [-(1.0 - t), 1.0 - t, t, -t].map(|v| v / size[0]);
                let dy = [-(1.0 - s), -s, s, 1.0 - s].map(|v| v / size[1]);
                let strain =
                    |d: [f64; 4], i: usize| -> f64 { d.iter().zip(cell).map(|(d, &n)| d * u[n][i]).sum() };
                stress.push(modulus * (stiff * strain(dy, 1) + coupling * strain(dx, 0)));
            }
        }
        let mean = stress.iter().sum::<f64>() / stress.len() as f64;
        Ok(stress.iter().map(|s| (s / mean - 1.0).abs()).fold(0.0, f64::max))
    }
}

/// Claims the nodal tractions and the equilibrium of a mortar run.
fn passes(ledger: &mut Ledger, what: &str, done: &PatchRun, covers: &[Capability]) -> Result<(), CaseError> {
    let tractions = done.tractions()?;
    ledger
        .claim(format!("traction of every slave node, mortar, {what}"))
        .unit("Pa")
        .values(&tractions)
        .equals_each(&vec![done.exact; tractions.len()])
        .relative(TRACTION)
        .evidence(Evidence::Exact, "bars in series with the penalty spring")
        .because("weights are exact integrals and sum to one: rounding only")
        .why_not_tighter(
            "a gap is a difference of displacements: eps (up to 100 E/h) multiplies their rounding",
        )
        .covers(covers)
        .cost(&done.cost)
        .record();
    let balance = &done.report.balance[0];
    ledger
        .claim(format!("sum of all contact forces and moments, relative, mortar, {what}"))
        .value(balance.force_residual.max(balance.moment_residual))
        .at_most(1e-13)
        .evidence(Evidence::Exact, "action and reaction")
        .because(
            "rows of both mortar matrices have equal sums; rounding of sums over at most a hundred nodes",
        )
        .why_not_tighter("measured values are a few units of rounding, which vary with the mesh")
        .covers(&[Capability::Balance])
        .record();
    Ok(())
}

/// Bound on tractions: rounding times the ratio of penalty to body stiffness.
const TRACTION: f64 = 1e-10;

fn plane(ledger: &mut Ledger, slave: usize, master: usize, factor: f64) -> Result<[String; 5], CaseError> {
    let eps = factor * YOUNG * slave as f64;
    let exact = DOWN / (2.0 * (1.0 - POISSON * POISSON) / YOUNG + eps.recip());
    let simulate = |measure, sliding| simulate(&base(slave, master, measure, sliding, eps)?, exact);
    let what = format!("({slave},{master}), eps = {factor} E/h");
    let fails = simulate(Measure::NodeToPoint, Sliding::Small)?;
    let error = fails.stress_error()?;
    ledger
        .claim(format!("bulk stress error of node-to-point, {what}"))
        .unit("%")
        .value(100.0 * error)
        .at_least(1.0)
        .evidence(Evidence::Exact, "the stress is uniform; one-pass node-to-segment contact is known not to pass")
        .because(
            "a pressure that acts at slave nodes only does not load the master with the integrals of its shape functions; a \
             per cent is what a reader of stresses would notice",
        )
        .why_not_tighter("the claim is that the failure is far above rounding on every mesh; its size is in the table")
        .covers(&[Capability::PenaltyContact2d])
        .cost(&fails.cost)
        .record();
    let mut row = vec![format!("{slave}, {master}"), format!("{factor}"), format!("{:.1} %", 100.0 * error)];
    for sliding in [Sliding::Small, Sliding::Finite] {
        let done = simulate(Measure::Mortar, sliding)?;
        let error = done.stress_error()?;
        let named = format!("{what}, {sliding:?} sliding").to_lowercase();
        ledger
            .claim(format!("bulk stress error of mortar, {named}"))
            .value(error)
            .at_most(1e-11)
            .evidence(Evidence::Exact, "the uniform field is a solution of the discrete problem")
            .because(
                "rounding of nodal forces of up to 13 elements a side; strains divide it by the element size",
            )
            .why_not_tighter("rounding varies with mesh and penalty")
            .covers(&[Capability::Mortar])
            .cost(&done.cost)
            .record();
        passes(ledger, &named, &done, &[Capability::Mortar])?;
        row.push(format!("{error:.0e}"));
    }
    row.try_into().map_err(|_| "a row of five".into())
}

fn second_order(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (upper, lower) in [("quad9", "tri6"), ("tri6", "quad4"), ("quad8", "quad9"), ("tri3", "quad8")] {
        for sliding in [Sliding::Small, Sliding::Finite] {
            let eps = 4.0 * YOUNG;
            let mut scene = base(4, 5, Measure::Mortar, sliding, eps)?;
            mesh_of(&mut scene, "upper")?.element = here(upper.to_string());
            mesh_of(&mut scene, "lower")?.element = here(lower.to_string());
            let exact = DOWN / (2.0 * (1.0 - POISSON * POISSON) / YOUNG + eps.recip());
            let what = format!("{upper} on {lower}, {sliding:?} sliding").to_lowercase();
            passes(ledger, &what, &simulate(&scene, exact)?, &[Capability::Mortar])?;
        }
    }
    Ok(())
}

fn axisymmetric(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (element, sliding) in [
        ("quad4", Sliding::Small),
        ("quad4", Sliding::Finite),
        ("quad8", Sliding::Small),
        ("quad8", Sliding::Finite),
    ] {
        let eps = 4.0 * YOUNG;
        let mut scene = base(4, 5, Measure::Mortar, sliding, eps)?;
        scene.kinematics = here(Kinematics::Axisymmetric);
        for body in ["upper", "lower"] {
            mesh_of(&mut scene, body)?.element = here(element.to_string());
        }
        let exact = DOWN / (2.0 / YOUNG + eps.recip());
        let what = format!("{element} about an axis, {sliding:?} sliding").to_lowercase();
        passes(ledger, &what, &simulate(&scene, exact)?, &[Capability::Mortar])?;
    }
    Ok(())
}

/// Cubes with free sides: u_x = 0 on the left, u_z = 0 behind.
fn solids(ledger: &mut Ledger) -> Result<(), CaseError> {
    let pairs = [
        ("hex8", "hex8"),
        ("tet4", "hex8"),
        ("hex8", "tet4"),
        ("hex27", "hex8"),
        ("tet10", "hex27"),
        ("hex20", "tet10"),
    ];
    for (upper, lower) in pairs {
        for sliding in [Sliding::Small, Sliding::Finite] {
            let eps = 3.0 * YOUNG;
            let mut scene = base(3, 4, Measure::Mortar, sliding, eps)?;
            scene.kinematics = here(Kinematics::ThreeD);
            for (body, element, n) in [("upper", upper, 3), ("lower", lower, 4)] {
                let mesh = mesh_of(&mut scene, body)?;
                mesh.min.get_mut().push(Length(0.0));
                mesh.max.get_mut().push(Length(1.0));
                mesh.divisions = Some(here(vec![n, n, n]));
                mesh.element = here(element.to_string());
                scene.stages[0].conditions.push(here(Condition {
                    set: Some(here(format!("{body}.back"))),
                    z: Some(here(Motion::Fixed(0.0))),
                    ..Condition::default()
                }));
            }
            let exact = DOWN / (2.0 / YOUNG + eps.recip());
            let what = format!("{upper} 3 x 3 on {lower} 4 x 4, {sliding:?} sliding").to_lowercase();
            let covers = [Capability::Mortar, Capability::PenaltyContact3d];
            passes(ledger, &what, &simulate(&scene, exact)?, &covers)?;
        }
    }
    Ok(())
}
