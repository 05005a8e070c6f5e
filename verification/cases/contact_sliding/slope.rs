//! A block on a plane that is tilted until it slides.

use super::MEASURES;
use crate::cases::texts::{attempt, simulate};
use crate::{Capability, CaseError, Evidence, Ledger};
use asperity_run::report::Outcome;
use asperity_vary::SceneText;

const SCENE: &str = include_str!("../../../scenes/slope.toml");
const MU: f64 = 0.3;

/// Fraction of the critical angle by which the tilt stays below or exceeds it.
const BESIDE: f64 = 1e-3;

pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let critical = MU.atan().to_degrees();
    for (name, capability) in MEASURES {
        let tilted = |angle: f64| {
            SceneText::new(SCENE)
                .with_or_same("interfaces.slope.measure", name)
                .with("stages[1].conditions[0].rotate.by", format!("{angle:?} deg"))
                .text()
        };
        let below = simulate(&tilted(critical * (1.0 - BESIDE))?)?;
        let fields = below.contact("tilt")?;
        let (normal, shear) = (&fields.normal_traction, &fields.shear_traction);
        let ratio = shear.iter().sum::<f64>().abs() / normal.iter().sum::<f64>();
        ledger
            .claim(format!("the block rests at 0.999 of the critical angle: mean |t|/f_n over tan(angle), {name}"))
            .value(ratio / (critical * (1.0 - BESIDE)).to_radians().tan())
            .equals(1.0)
            .absolute(2e-3)
            .evidence(Evidence::Exact, "equilibrium of forces along and across the plane")
            .because("the mean is over equal weights where end nodes have half the area, and tractions differ along the block, \
                      while each lies on or next to its strength: at most by the thousandth that is missing to it")
            .why_not_tighter("so near to sliding all nodes but few are on their strength")
            .covers(&[capability, Capability::Coulomb, Capability::Loads])
            .cost(&below.cost)
            .record();
        let angle = critical * (1.0 + BESIDE);
        let beyond = attempt(&tilted(angle)?)?;
        let Outcome::Stopped { time, .. } = &beyond.report.outcome else {
            return Err("the block rests on a slope steeper than friction allows".into());
        };
        ledger
            .claim(format!("angle at which no equilibrium is found any more, over the critical one, {name}"))
            .value((time - 1.0) * angle / critical)
            .equals(1.0)
            .absolute(1e-4)
            .evidence(Evidence::Exact, "a block slides where tan(angle) reaches mu")
            .because(
                "the run halves its steps to a millionth of the tilt; near the limit the block holds by its last node, and a \
                 system within 1e-4 of singular is where an iteration may fail",
            )
            .why_not_tighter("how near to the limit an iteration converges is not known beforehand")
            .covers(&[capability, Capability::Coulomb, Capability::Implicit])
            .cost(&beyond.cost)
            .record();
    }
    Ok(())
}
