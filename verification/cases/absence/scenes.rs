//! Small scenes, each with the terms it declares and the bytes of friction state these need.

use super::terms::Term::{self, *};
use crate::CaseError;
use asperity_vary::SceneText;

/// A scene that declares certain terms.
pub struct TermScene {
    /// Name on the page.
    pub name: &'static str,
    /// Text of the scene.
    pub text: String,
    /// Terms it declares.
    pub terms: &'static [Term],
    /// Bytes of friction state between steps; none where the scene has no stages with interfaces.
    pub state: Option<u64>,
}

/// Bytes of a state variable: the accepted value and the trial value.
const STATE: u64 = 16;

/// All scenes of the case.
pub fn all() -> Result<Vec<TermScene>, CaseError> {
    let contact: &[Term] = &[Bodies, Contact, Mortar];
    let friction: &[Term] = &[Bodies, Contact, Mortar, Friction];
    let rate: &[Term] = &[Bodies, Contact, Friction];
    let states: &[Term] = &[Bodies, Contact, Friction, Evolution];
    let points: &[Term] = &[Bodies, Contact, FinitePoints, Friction];
    let fault: &[Term] = &[Bodies, Friction, Evolution, Faults];
    let fluid: &[Term] = &[Bodies, Friction, Evolution, Faults, Fluid];
    Ok(vec![
        declared("plastic body", plastic(), &[Bodies, History, Plasticity], Some(0))?,
        declared("viscous body", viscous(), &[Bodies, History, Viscosity], Some(0))?,
        declared("body with an iterative solver", iterative(), &[Bodies, IterativeSolver], Some(0))?,
        declared("frictionless contact", frictionless(), contact, Some(0))?,
        declared("Coulomb friction", coulomb(), friction, Some(0))?,
        declared("finite sliding of points", sliding(), points, Some(0))?,
        declared("rate-dependent friction", sandwich(), rate, Some(0))?,
        declared("rate-and-state friction", states_of_sandwich(), states, Some(STATE * 11))?,
        declared("fault", fault_of_blocks(), fault, None)?,
        declared("fault with fluid", injected(), fluid, None)?,
        declared("spring-slider", slider(), &[Friction, Evolution, Sliders], None)?,
    ])
}

fn declared(
    name: &'static str,
    scene: SceneText,
    terms: &'static [Term],
    state: Option<u64>,
) -> Result<TermScene, CaseError> {
    Ok(TermScene { name, text: scene.text()?, terms, state })
}

fn elastic() -> SceneText {
    SceneText::new(include_str!("../../../scenes/cook.toml"))
        .with("bodies.panel.mesh.quadrilateral.divisions", "[4, 4]")
}

fn plastic() -> SceneText {
    SceneText::new(include_str!("../../../scenes/cylinder.toml"))
        .with("bodies.wall.mesh.block.divisions", "[4, 1]")
        .with("stages[0].steps", 3)
}

fn viscous() -> SceneText {
    elastic().with("kinematics", "plane-strain").add("materials.panel.viscosity", "1 Pa s")
}

/// A block in space, of more nodes than one task of the solver takes.
fn iterative() -> SceneText {
    SceneText::new(
        r#"
schema = 1
title = "iterative solver"
kinematics = "3d"
[materials.rock]
young = "50 GPa"
poisson = 0.25
[bodies.block]
mesh.block = { min = [0, 0, 0], max = [1, 1, 1], divisions = [10, 10, 8], element = "hex8" }
material = "rock"
[[stages]]
name = "press"
duration = "1 s"
steps = 1
conditions = [
    { set = "block.bottom", x = 0, y = 0, z = 0 },
    { set = "block.top", y = "-1 mm" },
]
[time]
stepper = "implicit"
[solver]
method = "iterative"
"#,
    )
}

fn coulomb() -> SceneText {
    let mut scene = SceneText::new(include_str!("../../../scenes/hertz.toml")).with("stages[1].steps", 2);
    for body in ["flat", "cylinder"] {
        for axis in 0..2 {
            scene = scene.with(&format!("bodies.{body}.mesh.block.spacing[{axis}].size"), "0.8 mm");
        }
    }
    scene
}

fn frictionless() -> SceneText {
    coulomb()
        .without("interfaces.contact.enforcement.tangential")
        .without("interfaces.contact.law")
        .without("stages[0].frictionless")
}

fn sliding() -> SceneText {
    SceneText::new(include_str!("../../../scenes/ironing.toml"))
        .with("bodies.slab.mesh.block.divisions", "[18, 3]")
        .with("bodies.die.mesh.block.divisions", "[4, 2]")
        .with("interfaces.contact.measure", "node-to-point")
        .with("stages[0].steps", 2)
        .with("stages[1].steps", 3)
        .with("stages[1].conditions[0].x.to", "0.2 m")
}

/// Blocks of cells of 5 mm, with 11 points of contact, sheared for 5 s.
fn sandwich() -> SceneText {
    SceneText::new(include_str!("../../../scenes/sandwich.toml"))
        .with("bodies.A.mesh.block.size", "5 mm")
        .with("bodies.B.mesh.block.size", "5 mm")
        .with("stages[1].duration", "5 s")
}

fn states_of_sandwich() -> SceneText {
    let law = r#"{ kind = "rate-and-state", form = "regularised", evolution = "ageing", mu0 = 0.6, a = 0.01, b = 0.005, l = "10 um", v_ref = "1 um/s", v_initial = "1 um/s" }"#;
    sandwich().with("interfaces.fault.law", law)
}

fn fault_of_blocks() -> SceneText {
    SceneText::new(include_str!("../../../scenes/sandwich-state.toml"))
        .with("bodies.A.mesh.block.size", "12.5 mm")
        .with("bodies.B.mesh.block.size", "12.5 mm")
        .with("faults.face.law.l", "5 um")
        .with("events.stop_after", 1)
}

fn injected() -> SceneText {
    SceneText::new(include_str!("../../../scenes/fault-opening.toml"))
        .with("bodies.crust.mesh.fault.spacing", "500 m")
        .with("stages[0].duration", "1 d")
}

fn slider() -> SceneText {
    SceneText::new(include_str!("../../../scenes/spring-slider.toml")).with("events.stop_after", 1)
}
