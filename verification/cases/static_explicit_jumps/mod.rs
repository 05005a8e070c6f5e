//! Jumps of forces under static-explicit steps.

use super::texts;
use crate::{Capability, Case, CaseError, Evidence, Ledger};
use asperity_vary::Change::{self, Add};
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "static_explicit_jumps",
    readme: include_str!("README.md"),
    covers: &[Capability::StaticExplicit],
    quick: true,
    run,
};

const COLUMN: &str = include_str!("scene.toml");
const BLOCKS: &str = include_str!("blocks.toml");
const PLATE: &str = include_str!("plate.toml");
/// Friction laws of the plate.
const LAWS: [&str; 2] = [
    "{ kind = \"coulomb\", mu = 0.6 }",
    "{ kind = \"rate-and-state\", evolution = \"ageing\", mu0 = 0.6, a = 0.015, b = 0.010, l = \"10 um\", v_ref = \"1 um/s\", v_initial = \"1 um/s\" }",
];
/// Height \[m\].
const HEIGHT: f64 = 10.0;
/// P-wave modulus (uniaxial strain), E (1 - ν)/((1 + ν)(1 - 2 ν)) \[Pa\].
const MODULUS: f64 = 10e9 * 0.75 / (1.25 * 0.5);
/// ρ g \[N/m3\].
const WEIGHT: f64 = 2700.0 * 9.81;
/// Conditions that hold through all stages.
const HELD: &str = "{ set = \"column.left\", symmetry = true }, { set = \"column.right\", symmetry = true }, \
                    { set = \"column.bottom\", symmetry = true }";

/// Tractions on a column, and the displacement of its upper edge \[m\].
struct Jump {
    name: &'static str,
    body: &'static [Change<'static>],
    /// Conditions of the stages.
    stages: &'static [&'static str],
    moved: f64,
}

const GRAVITY: Change<'_> = Add("bodies.column.gravity", "[0, -9.81]");

const JUMPS: [Jump; 5] = [
    Jump {
        name: "weight",
        body: &[GRAVITY],
        stages: &[""],
        moved: -WEIGHT * HEIGHT * HEIGHT / (2.0 * MODULUS),
    },
    Jump {
        name: "initial stress of -5 MPa along the column",
        body: &[Add("bodies.column.initial_stress", "[0, \"-5 MPa\", 0]")],
        stages: &[""],
        moved: 5e6 * HEIGHT / MODULUS,
    },
    Jump {
        name: "pressure of 2 MPa at once, after weight",
        body: &[GRAVITY],
        stages: &["", "{ set = \"column.top\", traction = [0, \"-2 MPa\"] }"],
        moved: -(WEIGHT * HEIGHT * HEIGHT / 2.0 + 2e6 * HEIGHT) / MODULUS,
    },
    Jump {
        name: "displacement of 1 mm at once",
        body: &[],
        stages: &["{ set = \"column.top\", y = \"-1 mm\" }"],
        moved: -1e-3,
    },
    Jump {
        name: "release under weight",
        body: &[GRAVITY],
        stages: &[
            "{ set = \"column.top\", y = { to = \"-1 mm\" } }",
            "{ set = \"column.top\", y = \"free\" }",
        ],
        moved: -WEIGHT * HEIGHT * HEIGHT / (2.0 * MODULUS),
    },
];

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for jump in &JUMPS {
        column(ledger, jump)?;
    }
    blocks(ledger)?;
    plate(ledger)
}

fn column(ledger: &mut Ledger, jump: &Jump) -> Result<(), CaseError> {
    let stage = |(k, conditions): (usize, &&str)| {
        let held = if k == 0 { HELD } else { "" };
        let both = if held.is_empty() || conditions.is_empty() { "" } else { ", " };
        format!("{{ name = \"{k}\", duration = \"1 s\", conditions = [{held}{both}{conditions}] }}")
    };
    let stages: Vec<String> = jump.stages.iter().enumerate().map(stage).collect();
    let scene = SceneText::new(COLUMN).changed(jump.body).add("stages", format!("[{}]", stages.join(", ")));
    let done = texts::simulate(&scene.text()?)?;
    ledger
        .claim(format!("{}: displacement of the upper edge over that of uniaxial strain", jump.name))
        .value(done.displacement("top")?[1] / jump.moved)
        .equals(1.0)
        .absolute(1e-9)
        .evidence(Evidence::Exact, "uniaxial strain under weight, initial stress and pressure")
        .because("nodes of linear elements are exact in one dimension; Newton's method ends at 1e-11 of the largest force, times the number of cells squared")
        .why_not_tighter("a linear column is found in one iteration, to rounding, and the bound is that of Newton's method")
        .cost(&done.cost)
        .record();
    Ok(())
}

fn blocks(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = texts::simulate(BLOCKS)?;
    let forces = done.force("pushed")?;
    let (before, after) = (forces[done.steps_until("shear")? - 1][0], forces[forces.len() - 1][0]);
    let weight = WEIGHT * 4.0;
    ledger
        .claim("block pushed within its strength: force over weight times friction, between 0 and 1")
        .value((before / (0.6 * weight) - 0.5).abs())
        .at_most(0.5)
        .evidence(Evidence::Exact, "Coulomb's law")
        .because("the claim that follows is about a force that was there")
        .why_not_tighter("how much of the strength is used does not matter")
        .cost(&done.cost)
        .record();
    ledger
        .claim("friction taken off: force that is left on the pushed side over the weight")
        .value(after / weight)
        .equals(0.0)
        .absolute(1e-9)
        .evidence(Evidence::Exact, "nothing opposes the block")
        .because("Newton's method ends at 1e-11 of the largest force, that of a node")
        .why_not_tighter("where the last iteration of Newton's method ends below its tolerance is chance")
        .cost(&done.cost)
        .record();
    Ok(())
}

/// A plate pressed by its own weight: both measures, small and finite sliding, an initial gap and an overlap of a tenth
/// of a millimetre.
fn plate(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (law, friction) in LAWS.iter().zip(["Coulomb's law", "rate and state"]) {
        let (mut normal, mut against, mut cost) = (Vec::new(), Vec::new(), None);
        for measure in ["node-to-point", "mortar"] {
            for sliding in ["small", "finite"] {
                for start in [-0.1, 0.1] {
                    let of = |stepper: &str| -> Result<_, CaseError> {
                        let scene = SceneText::new(PLATE)
                            .with("bodies.plate.mesh.block.min[1]", format!("{start} mm"))
                            .add("interfaces.fault.measure", measure)
                            .add("interfaces.fault.sliding", sliding)
                            .add("interfaces.fault.law", law)
                            .add("time.stepper", stepper);
                        let done = texts::simulate(&scene.text()?)?;
                        let last = |name| done.force(name).map(|all| all[all.len() - 1]);
                        let forces = (last("pushed")?[0], last("below")?[1]);
                        Ok((forces, done.cost))
                    };
                    let (implicit, _) = of("implicit")?;
                    let (own, own_cost) = of("static-explicit")?;
                    cost.get_or_insert(own_cost);
                    normal.push(own.1 / (WEIGHT * 4.0 * (1.0 - 1e-3 * start)));
                    against.push(own.0 / implicit.0);
                }
            }
        }
        let cost = cost.ok_or("nothing was run")?;
        ledger
            .claim(format!(
                "plate under its weight, {friction}: force below the base over the weight, of two measures, small and finite sliding, overlap and start gap"
            ))
            .values(&normal)
            .equals_each(&vec![1.0; normal.len()])
            .absolute(1e-4)
            .evidence(Evidence::Exact, "balance of forces")
            .because("steps may leave 1e-4 of the largest force at a node out of balance, and a node bears less than all")
            .why_not_tighter("the bound is what the stepper promises")
            .cost(&cost)
            .record();
        ledger
            .claim(format!("the same, {friction}: force that pushes the plate over that of implicit steps"))
            .values(&against)
            .equals_each(&vec![1.0; against.len()])
            .absolute(1e-4)
            .evidence(Evidence::ConvergedSelf, "implicit steps at their default")
            .because("what steps may leave out of balance; both follow the same law, to 1e-4 in friction")
            .why_not_tighter("the bound is what both steppers promise")
            .cost(&cost)
            .record();
    }
    Ok(())
}
