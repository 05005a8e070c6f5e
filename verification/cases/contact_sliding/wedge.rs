//! A loaded wedge pushed up a slope.

use super::{COEFFICIENTS, MEASURES, ratio, with_friction};
use crate::cases::texts::simulate;
use crate::{Capability, CaseError, Evidence, Ledger};

const SCENE: &str = include_str!("wedge.toml");

pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut rows = Vec::new();
    for (name, capability) in MEASURES {
        for mu in COEFFICIENTS {
            let scene = with_friction(SCENE, "slope", mu).with_or_same("interfaces.slope.measure", name);
            let done = simulate(&scene.text()?)?;
            // The first step reverses the shear tractions of the loaded wedge.
            let first = done.steps_until("load")? + 1;
            let ratios: Vec<f64> = done.force("base")?[first..].iter().map(|f| -f[0] / f[1]).collect();
            let exact = ratio(mu);
            ledger
                .claim(format!("F/G while the wedge slides over three segments, mu = {mu}, {name}"))
                .values(&ratios)
                .equals_each(&vec![exact; ratios.len()])
                .absolute(1e-6)
                .evidence(Evidence::Exact, "(tan a + mu)/(1 - mu tan a), tan a = 0.1: the wedge of NAFEMS CGS-4")
                .because("the slope bends by the strain, 1 kPa over 10 GPa and a few times that at the corner of the wedge")
                .why_not_tighter("where the largest bend lies relative to the nodes changes along the way")
                .covers(&[capability, Capability::FiniteSliding, Capability::Coulomb])
                .cost(&done.cost)
                .record();
            let error = ratios.iter().map(|r| (r - exact).abs()).fold(0.0, f64::max);
            let last = ratios.last().copied().unwrap_or(f64::NAN);
            rows.push([
                name.to_owned(),
                format!("{mu}"),
                format!("{exact:.6}"),
                format!("{last:.6}"),
                format!("{error:.1e}"),
                done.report.counts.operations.iterations.to_string(),
            ]);
        }
    }
    ledger.table(
        "wedge: force that pushes over load; FrontISTR reaches 0.412168 to 0.412171 at mu = 0.3",
        &["measure", "mu", "exact", "at the end", "largest error on the way", "iterations"],
        rows,
    );
    Ok(())
}
