//! Scenes of every kind of run that carries state from step to step.

use crate::CaseError;
use crate::cases::stick_slip::exponential;
use asperity_vary::Change::{self, Add, With, Without};
use asperity_vary::SceneText;

/// A scene that is run with interruptions.
pub struct InterruptedScene {
    /// Name on the report page.
    pub name: &'static str,
    /// Text.
    pub text: String,
}

/// Small sliding: points slide by less than a cell.
const SMALL: [Change<'_>; 2] =
    [With("interfaces.contact.sliding", "small"), With("stages[1].conditions[0].x", r#"{ to = "0.002 m" }"#)];
const AGEING: Change<'_> = With(
    "interfaces.contact.law",
    r#"{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.4, a = 0.015, b = 0.01, l = "5 mm", v_ref = "1 mm/s", v_initial = "1 mm/s" }"#,
);
const MORTAR: Change<'_> = With("interfaces.contact.measure", "mortar");
const UZAWA: Change<'_> = With(
    "interfaces.contact.enforcement",
    r#"{ kind = "uzawa", normal = "20 E/h", tangential = "20 E/h", penetration = "1e-9 h" }"#,
);
const FORWARD: [Change<'_>; 3] =
    [With("time.stepper", "static-explicit"), Without("time.tolerance"), Without("time.friction_tolerance")];
const PLASTIC: Change<'_> =
    Add("materials.soft.plasticity", r#"{ hardening = "linear", yield = "20 MPa", modulus = "1 GPa" }"#);
const MAXWELL: Change<'_> = Add("materials.soft.viscosity", "20 GPa s");
const MASS: [Change<'_>; 3] = [
    Add("materials.soft.density", "2000"),
    Add("materials.hard.density", "2000"),
    Add("time.inertia", "{ tolerance = 0.1 }"),
];
const FINITE: [Change<'_>; 2] = [Add("bodies.slab.strain", "finite"), Add("bodies.die.strain", "finite")];

/// The scenes.
///
/// # Errors
/// If a variation changes nothing.
pub fn all() -> Result<Vec<InterruptedScene>, CaseError> {
    let fluid = SceneText::new(include_str!("../../../scenes/fault-opening.toml"))
        .with("bodies.crust.mesh.fault.spacing", "500 m");
    let turning = SceneText::new(include_str!("../fault_turning/scene.toml")).with("events.stop_after", 4);
    let block = SceneText::new(include_str!("../../../scenes/sandwich-state.toml"))
        .with("bodies.A.mesh.block.size", "5 mm")
        .with("bodies.B.mesh.block.size", "5 mm")
        .with("events.stop_after", 3);
    Ok(vec![
        named("Coulomb friction, finite sliding", die(&[]))?,
        named("rate-and-state friction, small sliding", die(&[&SMALL, &[AGEING]]))?,
        named("mortar contact by Uzawa's method", die(&[&[MORTAR, UZAWA]]))?,
        named("a plastic slab at finite strain", die(&[&[PLASTIC], &FINITE]))?,
        named("a viscous slab", die(&[&[MAXWELL]]))?,
        named("a plastic slab with inertia", die(&[&[PLASTIC], &FINITE, &MASS]))?,
        named("static-explicit steps", die(&[&FORWARD]))?,
        named("static-explicit steps, a plastic slab", die(&[&FORWARD, &[PLASTIC]]))?,
        named("an interface through an event", exponential::coarse()?)?,
        named("a fault through events", block)?,
        named("slip that turns", turning)?,
        named("a fault that fluid opens", fluid)?,
    ])
}

fn named(name: &'static str, scene: SceneText) -> Result<InterruptedScene, CaseError> {
    Ok(InterruptedScene { name, text: scene.text()? })
}

fn die(changes: &[&[Change<'_>]]) -> SceneText {
    changes.iter().fold(SceneText::new(include_str!("die.toml")), |scene, changes| scene.changed(changes))
}
