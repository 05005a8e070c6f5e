//! A pad that is dragged from one body to the next, in the plane, and over the corner where four bodies meet, in space.

use super::MEASURES;
use crate::cases::texts::{BodyRun, simulate};
use crate::{Capability, CaseError, Evidence, Ledger};
use asperity_vary::SceneText;

/// Scenes, each with the shares of the load that two of the bodies below bear before the pad moves.
const SCENES: [(&str, &str, [f64; 2]); 2] = [
    ("joint of two bodies", include_str!("joint.toml"), [0.7, 0.3]),
    ("corner of four bodies", include_str!("corner.toml"), [0.7 * 0.45, 0.3 * 0.55]),
];
/// Coefficient of friction.
const MU: f64 = 0.3;
/// Steps after which all points slide.
const FIRST: usize = 3;

pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (place, scene, shares) in SCENES {
        for (measure, plane) in MEASURES {
            let scene = SceneText::new(scene).with_or_same("interfaces.contact.measure", measure);
            let done = simulate(&scene.text()?)?;
            let in_space = place.contains("four");
            let capability =
                if in_space && measure != "mortar" { Capability::PenaltyContact3d } else { plane };
            let claim = Claim { place, measure, capability };
            claim.pressure(ledger, &done)?;
            claim.drag(ledger, &done)?;
            if measure == "mortar" {
                claim.shares(ledger, &done, shares)?;
            }
        }
    }
    Ok(())
}

/// Names and capability of the claims about a run.
struct Claim<'a> {
    place: &'a str,
    measure: &'a str,
    capability: Capability,
}

impl Claim<'_> {
    /// Uniform pressure on top is uniform pressure below, whichever body bears it.
    fn pressure(&self, ledger: &mut Ledger, done: &BodyRun) -> Result<(), CaseError> {
        let tractions = &done.contact("press")?.normal_traction;
        ledger
            .claim(format!("normal traction at all points over the {}, {}", self.place, self.measure))
            .unit("Pa")
            .values(tractions)
            .equals_each(&vec![1.0; tractions.len()])
            .absolute(3e-6)
            .evidence(Evidence::Exact, "a pad without lateral strain under uniform pressure")
            .because("the bodies below are a million times as stiff and bend over the depth of the pad by that share")
            .why_not_tighter("they bend unevenly, by some of that share")
            .covers(&[self.capability, Capability::FiniteSliding])
            .cost(&done.cost)
            .record();
        Ok(())
    }

    /// The pad slides: all of its load rubs, whichever bodies bear it.
    fn drag(&self, ledger: &mut Ledger, done: &BodyRun) -> Result<(), CaseError> {
        let from = done.steps_until("press")? + FIRST;
        let ratios: Vec<f64> =
            done.force("top")?[from..].iter().map(|f| f[0].hypot(f[2]) / f[1].abs() / MU).collect();
        ledger
            .claim(format!("dragging force over mu times the load on the way over the {}, {}", self.place, self.measure))
            .values(&ratios)
            .equals_each(&vec![1.0; ratios.len()])
            .absolute(if self.measure == "mortar" { 1e-4 } else { 1e-7 })
            .evidence(Evidence::Exact, "balance of forces on a pad that slides, with Coulomb's law at every point")
            .because(
                "tractions act along normals: those of the hard bodies in node-to-point contact, tilted by 1e-9, and with mortar those of the pad, \
                 which its shear of mu p/E = 3e-4 tilts by a third of that",
            )
            .why_not_tighter("the mean tilt depends on how the pad bends")
            .covers(&[self.capability, Capability::FiniteSliding, Capability::Coulomb])
            .cost(&done.cost)
            .record();
        Ok(())
    }

    /// Each body bears the part of the load that lies over it.
    fn shares(&self, ledger: &mut Ledger, done: &BodyRun, shares: [f64; 2]) -> Result<(), CaseError> {
        let last = done.steps_until("press")? - 1;
        let borne = |name: &str| -> Result<f64, CaseError> { Ok(done.force(name)?[last][1]) };
        ledger
            .claim(format!("loads on two of the bodies below, {}, mortar", self.place))
            .unit("N or N/m")
            .values(&[borne("left")?, borne("right")?])
            .equals_each(&shares)
            .absolute(1e-7)
            .evidence(Evidence::Exact, "areas under the pad, at a pressure of 1 Pa")
            .because("overlaps of facets end at the joints, and pressure varies by less than a millionth, antisymmetrically or nearly so")
            .why_not_tighter("how pressure varies depends on how the bodies below bend")
            .covers(&[self.capability, Capability::FiniteSliding])
            .cost(&done.cost)
            .record();
        Ok(())
    }
}
