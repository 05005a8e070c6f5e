//! Two rings, one inside the other: orders of convergence of curved contact on meshes that do not match.

mod exact;
mod mesh;

use crate::cases::body_plots;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity::kinds;
use asperity_output::bodies::Recorder;
use asperity_plan::bodies;
use asperity_plan::reading::scene as reader;
use asperity_plan::reading::scene::model::{Measure, here};
use asperity_run::report::Outcome;
use exact::{RADII, Rings};
use std::f64::consts::FRAC_PI_2;

/// See the README.
pub const CASE: Case = Case {
    name: "two_rings",
    readme: include_str!("README.md"),
    covers: &[
        Capability::PlaneStrain,
        Capability::Mortar,
        Capability::PenaltyContact2d,
        Capability::Quadrilaterals,
    ],
    quick: true,
    run,
};

/// Cells of the coarsest mesh around the inner and the outer ring, and across each.
const COARSEST: ([usize; 2], usize) = ([5, 4], 3);
/// Angle from the planes of symmetry within which the first and last nodes of all but the coarsest meshes lie.
const END: f64 = 0.15;
/// Factor of the bound over the error expected on the finest level.
const ROOM: f64 = 1.5;

/// Relative errors in L2.
struct Errors {
    displacement: f64,
    pressure: f64,
    /// Pressure at least [`END`] from the planes of symmetry.
    inside: f64,
    /// Mises stress of the rings.
    picture: String,
    cost: Cost,
}

/// Runs the scene on a mesh `fine` times as fine as the coarsest.
fn simulate(measure: Measure, order: usize, fine: usize, exact: &Rings) -> Result<Errors, CaseError> {
    let folder = std::env::temp_dir().join(format!("asperity-rings-{}-{order}-{fine}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let (around, across) = (COARSEST.0.map(|n| n * fine), COARSEST.1 * fine);
    std::fs::write(folder.join("rings.msh"), mesh::rings(around, across, order))?;
    let mut scene = reader::read(include_str!("scene.toml")).map_err(|e| format!("scene.toml: {e}"))?;
    scene.folder = folder.clone();
    scene.interfaces.get_mut("contact").ok_or("the scene has no contact")?.measure = here(measure);
    let mut record = Recorder::new().with_bodies();
    let (report, cost) = Cost::measure(|| {
        let plan = bodies::plan(&scene).map_err(|e| e.to_string())?;
        kinds::bodies::run(&plan, &mut record).map_err(|e| e.to_string())
    });
    std::fs::remove_dir_all(&folder)?;
    let report = report?;
    if let Outcome::Stopped { reason, .. } = &report.outcome {
        return Err(format!("stopped: {reason}").into());
    }
    let end = record.stage_end("press").ok_or("the stage was not reached")?;
    let u = &end.bodies.as_ref().ok_or("the bodies were not kept")?.displacement;
    let cost = cost.counts(&report.counts).count("unknowns", report.plan.dofs as f64);
    Ok(Errors {
        displacement: displacement(&record, u, exact),
        pressure: pressure(&record, &end.interfaces[0].normal_traction, exact, 0.0),
        inside: pressure(&record, &end.interfaces[0].normal_traction, exact, END),
        picture: body_plots::recorded(&record, "press")?,
        cost,
    })
}

fn displacement(record: &Recorder, u: &[[f64; 3]], exact: &Rings) -> f64 {
    let mesh = &record.setup().mesh;
    let inner = mesh.bodies.iter().position(|b| b == "inner").unwrap_or(0);
    let mut ring = vec![None; mesh.nodes.len()];
    for (cell, body) in mesh.cells.iter().zip(&mesh.cell_body) {
        cell.points.iter().for_each(|&n| ring[n] = Some(usize::from(*body != inner)));
    }
    let (mut error, mut whole) = (0.0, 0.0);
    for ((x, u), ring) in mesh.nodes.iter().zip(u).zip(&ring) {
        let Some(ring) = ring else { continue };
        let e = exact.displacement(*ring, [x[0], x[1]]);
        error += (u[0] - e[0]).powi(2) + (u[1] - e[1]).powi(2);
        whole += e[0] * e[0] + e[1] * e[1];
    }
    (error / whole).sqrt()
}

/// Relative error of the pressure at points at least `end` from the planes of symmetry.
fn pressure(record: &Recorder, traction: &[f64], exact: &Rings, end: f64) -> f64 {
    let contact = &record.setup().interfaces[0];
    let (mut error, mut whole) = (0.0, 0.0);
    for ((x, a), p) in contact.positions.iter().zip(&contact.areas).zip(traction) {
        let theta = x[1].atan2(x[0]);
        if theta < end || theta > FRAC_PI_2 - end {
            continue;
        }
        let e = exact.pressure(theta);
        error += a * (p - e).powi(2);
        whole += a * e * e;
    }
    (error / whole).sqrt()
}

const SERIES: &str = "Michell series of two terms a ring, the penalty included";

/// An expected order and its reason.
type ExpectedOrder = Option<(f64, &'static str)>;

/// A study: measure, order of the elements, finenesses, expected orders of displacement and pressure with their reasons.
struct Study {
    name: &'static str,
    measure: Measure,
    order: usize,
    fine: &'static [usize],
    displacement: ExpectedOrder,
    /// None if the pressure does not converge.
    pressure: ExpectedOrder,
}

const STUDIES: [Study; 3] = [
    Study {
        name: "mortar, quad4",
        measure: Measure::Mortar,
        order: 1,
        fine: &[1, 2, 4, 8, 16],
        displacement: Some((2.0, "bilinear elements; chords of the circle leave gaps of h^2/r")),
        pressure: Some((
            1.0,
            "chords of unequal length leave gaps of h^2 that change over a few cells even when averaged, which asks for strains of \
             order h",
        )),
    },
    Study {
        name: "mortar, quad9",
        measure: Measure::Mortar,
        order: 2,
        fine: &[1, 2, 4, 8],
        displacement: Some((3.0, "biquadratic elements")),
        pressure: Some((
            2.0,
            "a traction is an average over the facets beside its node, which differs by h^2 from the value there",
        )),
    },
    Study {
        name: "node-to-point, quad4",
        measure: Measure::NodeToPoint,
        order: 1,
        fine: &[1, 2, 4, 8, 16],
        displacement: Some((
            1.0,
            "the patch test fails by a share of the pressure that changes over a few cells and does not fall with h; its effect on \
             displacements has the size of these cells",
        )),
        pressure: None,
    },
];

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let exact = Rings::new();
    let (mut rows, mut finest) = (Vec::new(), Vec::new());
    let mut plot =
        Plot::xy("Error of the pressure", "size of the slave's cells [m]", "relative, L2").log_log();
    for study in &STUDIES {
        let mut errors = Vec::new();
        for &fine in study.fine {
            let h = RADII[1] * FRAC_PI_2 / (COARSEST.0[1] * fine) as f64;
            let found = simulate(study.measure, study.order, fine, &exact)?;
            rows.push([
                study.name.to_string(),
                format!("{h:.4}"),
                format!("{:.2e}", found.displacement),
                format!("{:.2e}", found.pressure),
                format!("{:.2e}", found.inside),
            ]);
            errors.push((h, found));
        }
        let pressures: Vec<(f64, f64)> = errors.iter().map(|(h, e)| (*h, e.pressure)).collect();
        plot = plot.series(Series::marked(study.name, &pressures));
        claim(ledger, study, &errors);
        if let Some((_, coarsest)) = errors.first().filter(|_| finest.is_empty()) {
            let caption = format!("Mises stress, {}, coarsest mesh.", study.name);
            ledger.picture("The rings pressed together", coarsest.picture.clone(), caption);
        }
        finest.extend(errors.pop().map(|(_, e)| e));
    }
    beside(ledger, &finest);
    ledger.plot(plot);
    ledger.table(
        "relative errors in L2",
        &["measure", "h [m]", "displacement", "pressure", "pressure 9 degrees from the ends"],
        rows,
    );
    let (least, most) = (exact.pressure(0.0), exact.pressure(FRAC_PI_2));
    ledger.note(format!(
        "Exact pressure between the rings: {:.6} MPa at theta = 0, {:.6} MPa at 90 degrees.",
        least * 1e-6,
        most * 1e-6
    ));
    Ok(())
}

/// Claim on the error of node-to-point over that of mortar, both with quad4 on the finest mesh.
fn beside(ledger: &mut Ledger, finest: &[Errors]) {
    let [mortar, _, point] = finest else { return };
    ledger
        .claim("error of the pressure by node-to-point over that by mortar, quad4, finest mesh")
        .value(point.pressure / mortar.pressure)
        .at_least(5.0)
        .evidence(Evidence::SemiAnalytic, SERIES)
        .because("node-to-point fails the patch test by per cents on any mesh, mortar's error has fallen below half a per cent")
        .cost(&point.cost)
        .record();
}

fn claim(ledger: &mut Ledger, study: &Study, errors: &[(f64, Errors)]) {
    let cost = errors.last().map(|(_, e)| e.cost.clone()).unwrap_or_default();
    type Pick = fn(&Errors) -> f64;
    let quantities: [(&str, Pick, ExpectedOrder); 2] = [
        ("displacement", |e| e.displacement, study.displacement),
        ("pressure", |e| e.pressure, study.pressure),
    ];
    for (what, pick, claimed) in quantities {
        let Some((expected, because)) = claimed else { continue };
        let levels: Vec<(f64, f64)> = errors.iter().map(|(h, e)| (*h, pick(e))).collect();
        // Error expected on the finest level from the level before and this order.
        let finest = levels[levels.len() - 2].1 * 0.5_f64.powf(expected);
        ledger
            .order(format!("{what}, {}, relative in L2", study.name))
            .levels(&levels)
            .expected(expected)
            .within(0.2)
            .or_better()
            .evidence(Evidence::SemiAnalytic, SERIES)
            .because(because)
            .why_not_tighter("only a lower order counts: values at nodes may converge faster than the fields")
            .finest(ROOM * finest, "1.5 times what the level before and the order let expect")
            .cost(&cost)
            .record();
    }
}
