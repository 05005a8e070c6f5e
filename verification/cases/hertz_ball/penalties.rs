//! The ball under penalties from 1 to 1e8 E/h: none needs a constant that somebody tuned.

use super::{MU, SCENE, SIZE};
use crate::cases::texts::{attempt, simulate};
use crate::{Capability, CaseError, Evidence, Ledger};
use asperity_vary::SceneText;

/// Penalties over E/h of the smallest cells.
const FACTORS: [f64; 8] = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7];
/// Young's modulus over the size of the smallest cells \[MPa/mm\].
const YOUNG_PER_SIZE: f64 = 1000.0 / SIZE;

pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (mut rows, mut loads) = (Vec::new(), Vec::new());
    for factor in FACTORS {
        let done = simulate(&scene(factor)?)?;
        let [shear, normal, _] = *done.force("top")?.last().ok_or("no step was taken")?;
        let counts = &done.report.counts;
        rows.push([
            format!("{factor:.0e}"),
            format!("{:.6}", -2.0 * normal),
            format!("{:.6}", 2.0 * shear),
            counts.operations.iterations.to_string(),
            counts.rejected.to_string(),
            format!("{:.4}", shear / (MU * -normal)),
        ]);
        loads.push((factor.recip(), -normal));
    }
    let stiff = loads[FACTORS.len() - 1].1;
    let errors: Vec<(f64, f64)> = loads[..4].iter().map(|(soft, n)| (*soft, 1.0 - n / stiff)).collect();
    ledger
        .order("load of the ball over the softness h/(E k) of the penalty, against that of k = 1e7".to_owned())
        .levels(&errors)
        .expected(1.0)
        .within(0.1)
        .because("a penalty is a layer of the softness of h/k of the material, whose give is linear")
        .finest(1.4e-4, "1.5 p0 h/(E k) over the approach: what a layer of h/k gives under the largest pressure, and the load grows as the approach to 1.5")
        .evidence(Evidence::ConvergedSelf, "k = 1e7, which differs from the limit of a stiff penalty by 1e-8 of the load")
        .covers(&[Capability::Mortar, Capability::Coulomb])
        .record();
    let refused = match attempt(&scene(1e8)?) {
        Ok(_) => return Err("a penalty of 1e8 E/h leaves fewer than three digits and was accepted".into()),
        Err(why) => why.to_string(),
    };
    if !refused.contains("normal penalty") {
        return Err(format!("the penalty is not named: {refused}").into());
    }
    rows.push([
        "1e8".into(),
        "refused: tractions would have fewer than three digits".into(),
        String::new(),
        String::new(),
        String::new(),
        String::new(),
    ]);
    ledger.table(
        "iterations against the penalty k E/h, mortar, pressed in one step and sheared in four",
        &["k", "P [N]", "Q [N]", "iterations", "steps cut", "Q/(mu P)"],
        rows,
    );
    Ok(())
}

fn scene(factor: f64) -> Result<String, CaseError> {
    let stiffness = factor * YOUNG_PER_SIZE;
    let enforcement = format!(
        "{{ kind = \"penalty\", normal = \"{stiffness} MPa/mm\", tangential = \"{stiffness} MPa/mm\" }}"
    );
    Ok(SceneText::new(SCENE).with_or_same("interfaces.contact.enforcement", enforcement).text()?)
}
