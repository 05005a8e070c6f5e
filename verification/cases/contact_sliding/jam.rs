//! A wedge that is driven between two blocks, and jams or comes out when it is let go.

use super::{MEASURES, SLOPE, ratio};
use crate::cases::texts::{BodyRun, simulate};
use crate::{Capability, CaseError, Evidence, Ledger};
use asperity_vary::SceneText;

const SCENE: &str = include_str!("jam.toml");
/// Coefficients of friction above and below the slope, at which a wedge comes out.
const COEFFICIENTS: [f64; 3] = [0.3, 0.12, 0.09];
/// Steps after which all points slide.
const FIRST: usize = 3;

pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (measure, capability) in MEASURES {
        for mu in COEFFICIENTS {
            let scene = SceneText::new(SCENE)
                .with_or_same("interfaces.cheek.measure", measure)
                .with_or_same("interfaces.cheek.law.mu", mu);
            let done = simulate(&scene.text()?)?;
            let covers = [capability, Capability::Coulomb, Capability::FiniteSliding];
            driven(ledger, &format!("mu = {mu}, {measure}"), mu, &covers, &done)?;
            let go = LetGo::new(&done)?;
            if mu > SLOPE {
                go.jams(ledger, &format!("mu = {mu}, {measure}"), &covers, &done);
            } else {
                go.comes_out(ledger, &format!("mu = {mu}, {measure}"), &covers, &done);
            }
        }
    }
    Ok(())
}

/// Claims the ratio of the force on the wedge to the one that spreads the blocks.
fn driven(
    ledger: &mut Ledger,
    name: &str,
    mu: f64,
    covers: &[Capability],
    done: &BodyRun,
) -> Result<(), CaseError> {
    let last = done.steps_until("drive")?;
    let ratios: Vec<f64> = done.force("left")?[FIRST..last].iter().map(|f| f[1] / f[0]).collect();
    ledger
        .claim(format!("driving force over twice the spreading force of a wedge, {name}"))
        .values(&ratios)
        .equals_each(&vec![ratio(mu); ratios.len()])
        .absolute(1e-6)
        .evidence(Evidence::Exact, "(tan a + mu)/(1 - mu tan a)")
        .because("strains are 1e-6, by which cheeks turn, and the ratio changes by about as much")
        .why_not_tighter("the blocks bend, which turns their cheeks by some strains")
        .covers(covers)
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Forces on the left block before and after the wedge is let go, and on the right one after.
struct LetGo {
    before: [f64; 3],
    left: [f64; 3],
    right: [f64; 3],
}

impl LetGo {
    fn new(done: &BodyRun) -> Result<Self, CaseError> {
        let at = |name: &str, step: usize| -> Result<[f64; 3], CaseError> { Ok(done.force(name)?[step]) };
        let [driven, end] = [done.steps_until("drive")? - 1, done.steps_until("let go")? - 1];
        Ok(Self { before: at("left", driven)?, left: at("left", end)?, right: at("right", end)? })
    }

    /// Claims that the wedge stays, held by friction at less than its limit: the blocks still press it, and it pulls on neither.
    fn jams(&self, ledger: &mut Ledger, name: &str, covers: &[Capability], done: &BodyRun) {
        ledger
            .claim(format!("spreading force that is left over that of the driven wedge, which jams, {name}"))
            .value(self.left[0] / self.before[0])
            .at_least(0.5)
            .evidence(Evidence::Exact, "with mu > tan a a wedge does not come out by itself")
            .because("the blocks spring back only by the elastic part of the motion along the cheeks")
            .why_not_tighter("how much depends on the blocks")
            .covers(covers)
            .cost(&done.cost)
            .record();
        ledger
            .claim(format!("force along the wedge after it is let go, over the spreading force, {name}"))
            .value(self.left[1].abs().max(self.right[1].abs()) / self.left[0])
            .at_most(1e-9)
            .evidence(
                Evidence::Exact,
                "nothing pulls the wedge: friction on both cheeks holds what presses them",
            )
            .because("residuals end at 1e-11 of the largest force")
            .why_not_tighter("how far below it the last iteration ends is luck")
            .covers(covers)
            .record();
    }

    /// Claims that nothing is left of the forces.
    fn comes_out(&self, ledger: &mut Ledger, name: &str, covers: &[Capability], done: &BodyRun) {
        let left = [self.left, self.right].iter().flatten().fold(0.0_f64, |most, f| most.max(f.abs()));
        ledger
            .claim(format!("largest force on the blocks after the wedge is let go and comes out, over that before, {name}"))
            .value(left / self.before[0])
            .at_most(1e-12)
            .evidence(Evidence::Exact, "with mu < tan a a wedge that is let go comes out until nothing presses it")
            .because("open points carry nothing, and what Newton leaves is of the small forces of the last step")
            .why_not_tighter("what Newton leaves depends on the last step before contact is lost")
            .covers(covers)
            .cost(&done.cost)
            .record();
    }
}
