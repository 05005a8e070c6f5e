//! Forces that jump under static-explicit steps.

use super::texts::{self, vary};
use crate::{Capability, Case, CaseError, Evidence, Ledger};

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
/// Height \[m\].
const HEIGHT: f64 = 10.0;
/// Modulus of uniaxial strain, E (1 - ν)/((1 + ν)(1 - 2 ν)) \[Pa\].
const MODULUS: f64 = 10e9 * 0.75 / (1.25 * 0.5);
/// ρ g \[N/m3\].
const WEIGHT: f64 = 2700.0 * 9.81;
/// Conditions that hold through all stages.
const HELD: &str = "{ set = \"column.left\", symmetry = true }, { set = \"column.right\", symmetry = true }, \
                    { set = \"column.bottom\", symmetry = true }";

/// What acts on a column, and the displacement of its upper edge \[m\].
struct Jump {
    name: &'static str,
    body: &'static str,
    /// Conditions of the stages.
    stages: &'static [&'static str],
    moved: f64,
}

const JUMPS: [Jump; 5] = [
    Jump {
        name: "weight",
        body: "gravity = [0, -9.81]",
        stages: &[""],
        moved: -WEIGHT * HEIGHT * HEIGHT / (2.0 * MODULUS),
    },
    Jump {
        name: "initial stress of -5 MPa along the column",
        body: "initial_stress = [0, \"-5 MPa\", 0]",
        stages: &[""],
        moved: 5e6 * HEIGHT / MODULUS,
    },
    Jump {
        name: "pressure of 2 MPa at once, after weight",
        body: "gravity = [0, -9.81]",
        stages: &["", "{ set = \"column.top\", traction = [0, \"-2 MPa\"] }"],
        moved: -(WEIGHT * HEIGHT * HEIGHT / 2.0 + 2e6 * HEIGHT) / MODULUS,
    },
    Jump {
        name: "displacement of 1 mm at once",
        body: "",
        stages: &["{ set = \"column.top\", y = \"-1 mm\" }"],
        moved: -1e-3,
    },
    Jump {
        name: "release under weight",
        body: "gravity = [0, -9.81]",
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
    blocks(ledger)
}

fn column(ledger: &mut Ledger, jump: &Jump) -> Result<(), CaseError> {
    let stage = |(k, conditions): (usize, &&str)| {
        let held = if k == 0 { HELD } else { "" };
        let both = if held.is_empty() || conditions.is_empty() { "" } else { ", " };
        format!("[[stages]]\nname = \"{k}\"\nduration = \"1 s\"\nconditions = [{held}{both}{conditions}]\n")
    };
    let stages: String = jump.stages.iter().enumerate().map(stage).collect();
    let done =
        texts::simulate(&vary(COLUMN, &[("\nBODY", &format!("\n{}", jump.body)), ("\nSTAGES", &stages)])?)?;
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
        .cost(&done.cost)
        .record();
    Ok(())
}
