//! Contact patch test on matching meshes: a uniform pressure passes through the interface with every element.

use super::sandwich::{self, POISSON, U_X, YOUNG};
use crate::cases::body_plots;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};

/// See the README.
pub const CASE: Case = Case {
    name: "contact_patch",
    readme: include_str!("README.md"),
    covers: &[Capability::PenaltyContact2d],
    quick: true,
    run,
};

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (element, covers) in [
        ("quad4", [Capability::Quadrilaterals, Capability::PenaltyContact2d]),
        ("quad9", [Capability::Quadrilaterals, Capability::PenaltyContact2d]),
        ("tri3", [Capability::Triangles, Capability::PenaltyContact2d]),
        ("tri6", [Capability::Triangles, Capability::PenaltyContact2d]),
        ("hex8", [Capability::Solids, Capability::PenaltyContact3d]),
        ("tet4", [Capability::Solids, Capability::PenaltyContact3d]),
    ] {
        patch(ledger, element, &covers)?;
    }
    Ok(())
}

fn patch(ledger: &mut Ledger, element: &str, covers: &[Capability]) -> Result<(), CaseError> {
    let h = 5.0;
    let mut scene = sandwich::no_overhang(sandwich::size(sandwich::base()?, h));
    scene = if matches!(element, "hex8" | "tet4") {
        sandwich::layer(scene, 2.0 * h, element)
    } else {
        sandwich::element(scene, element)
    };
    let scene = sandwich::press_only(scene);
    if element == "quad9" {
        body_plots::stage(ledger, "Pressed blocks of quad9", &scene, "press")?;
    }
    let (run, cost) = Cost::measure(|| sandwich::simulate(&scene));
    let run = run?;
    let modulus = YOUNG / (1.0 - POISSON * POISSON);
    let exact = U_X / (50e-3 / modulus + h * 1e-3 / (100.0 * YOUNG));
    let tractions: Vec<f64> = run.end("press")?.normal_traction.iter().map(|t| t * 1e-6).collect();
    let reference = vec![exact * 1e-6; tractions.len()];
    ledger
        .claim(format!("normal traction of every slave node, {element}"))
        .unit("MPa")
        .values(&tractions)
        .equals_each(&reference)
        .relative(1e-10)
        .evidence(Evidence::Exact, "bars in series: u_x / (50 mm (1 - nu^2)/E + h/(100 E))")
        .because("the uniform field lies in every space, and tributary areas are the integrals of the shape functions; rounding only")
        .why_not_tighter("the penalty is some hundred times stiffer than the bodies, which multiplies rounding")
        .covers(covers)
        .cost(&cost.counts(&run.report.counts))
        .record();
    let balance = &run.report.balance[0];
    ledger
        .claim(format!("sum of all contact forces and moments, relative, {element}"))
        .value(balance.force_residual.max(balance.moment_residual))
        .at_most(1e-13)
        .evidence(Evidence::Exact, "action and reaction")
        .because("each pair adds opposite numbers; the sum over at most a hundred pairs rounds to 1e-14")
        .why_not_tighter("rounding depends on the mesh; a force that is left out is a part in a hundred")
        .covers(&[Capability::Balance])
        .record();
    Ok(())
}
