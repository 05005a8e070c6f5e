//! Time of first slip in forward steps, with a normal traction that grows or falls.

use super::texts;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity_vary::Change::{self, With};
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "first_slip",
    readme: include_str!("README.md"),
    covers: &[Capability::StaticExplicit, Capability::FiniteSliding, Capability::Mortar, Capability::Coulomb],
    quick: true,
    run,
};

/// Depth of the upper block in the lower one \[m\].
const DEPTH: f64 = 0.01;
/// Travel along the fault within one second \[m\].
const TRAVEL: f64 = 0.02;
/// Direction of the travel in space, from the x axis \[deg\].
const OBLIQUE: f64 = 30.0;
/// Growth of the depth over the same time \[m\].
const GROWTHS: [f64; 3] = [0.0, 0.015, -0.005];
const MORTAR: Change<'_> = With("interfaces.fault.measure", "mortar");
const FINITE: Change<'_> = With("interfaces.fault.sliding", "finite");
const CONTACTS: [(&str, &[Change<'_>]); 4] = [
    ("node-to-point", &[]),
    ("node-to-point, finite sliding", &[FINITE]),
    ("mortar", &[MORTAR]),
    ("mortar, finite sliding", &[MORTAR, FINITE]),
];

/// A friction law whose coefficient falls from `peak` to `least`.
struct Law {
    name: &'static str,
    text: &'static str,
    peak: f64,
    least: f64,
    /// Slip over which the coefficient falls \[m\].
    distance: f64,
}

const LAWS: [Law; 3] = [
    Law { name: "Coulomb", text: r#"{ kind = "coulomb", mu = 0.3 }"#, peak: 0.3, least: 0.3, distance: 0.0 },
    Law {
        name: "static-kinetic",
        text: r#"{ kind = "static-kinetic", mu_s = 0.4, mu_k = 0.3 }"#,
        peak: 0.4,
        least: 0.3,
        distance: 0.0,
    },
    Law {
        name: "slip weakening",
        text: r#"{ kind = "slip-weakening", mu_s = 0.4, mu_k = 0.3, d_c = "40 mm" }"#,
        peak: 0.4,
        least: 0.3,
        distance: 0.04,
    },
];

impl Law {
    /// Time at which the elastic slip reaches the peak: v t = μ_s (d + w t).
    fn first_slip(&self, growth: f64) -> f64 {
        self.peak * DEPTH / (TRAVEL - self.peak * growth)
    }

    /// Slip s at a depth: v - s = μ(s) depth.
    fn slip(&self, depth: f64) -> f64 {
        if self.distance > 0.0 {
            let rate = (self.peak - self.least) / self.distance;
            (TRAVEL - self.peak * depth) / (1.0 - rate * depth)
        } else {
            TRAVEL - self.least * depth
        }
    }
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for space in [false, true] {
        for (contact, changes) in CONTACTS {
            let mut found = ClosedFormRatios::default();
            for law in &LAWS {
                for growth in GROWTHS {
                    let scene =
                        blocks(space, growth).changed(changes).with_or_same("interfaces.fault.law", law.text);
                    let measured = measure(&mut found, scene, law, growth);
                    measured.map_err(|e| format!("{contact}, {}, growth {growth}: {e}", law.name))?;
                }
            }
            let in_ = if space { "in space" } else { "in the plane" };
            claims(ledger, &format!("{contact}, {in_}"), &found);
        }
    }
    Ok(())
}

/// The blocks; the upper one moves along the fault, and its depth grows.
fn blocks(space: bool, growth: f64) -> SceneText {
    let angle = if space { OBLIQUE.to_radians() } else { 0.0 };
    let (x, z) = (TRAVEL * angle.cos(), TRAVEL * angle.sin());
    let motion = |along: Option<f64>| {
        let z = along.map_or(String::new(), |z| format!(", z = {{ to = {z:?} }}"));
        ["upper.bottom", "upper.top"]
            .map(|set| {
                let y = -DEPTH - growth;
                format!("{{ set = \"{set}\", x = {{ to = {x:?} }}, y = {{ to = {y:?} }}{z} }}")
            })
            .join(", ")
    };
    let scene = SceneText::new(include_str!("scene.toml"));
    if space {
        let solid = [
            With("kinematics", "3d"),
            With(
                "bodies.lower.mesh.block",
                r#"{ min = [0, 0, 0], max = [1, 1, 1], divisions = [5, 2, 5], element = "hex8" }"#,
            ),
            With(
                "bodies.upper.mesh.block",
                r#"{ min = [0.1, 1, 0.1], max = [0.8, 2, 0.8], divisions = [3, 1, 3], element = "hex8" }"#,
            ),
        ];
        let held =
            [("lower.bottom", 0.0), ("lower.top", 0.0), ("upper.bottom", -DEPTH), ("upper.top", -DEPTH)]
                .map(|(set, y)| format!("{{ set = \"{set}\", x = 0, y = {{ to = {y:?} }}, z = 0 }}"));
        scene
            .changed(&solid)
            .with("stages[0].conditions", format!("[{}]", held.join(", ")))
            .with("stages[1].conditions", format!("[{}]", motion(Some(z))))
    } else {
        scene.with_or_same("stages[1].conditions", format!("[{}]", motion(None)))
    }
}

/// Values over their closed forms, of all laws and growths.
#[derive(Default)]
struct ClosedFormRatios {
    times: Vec<f64>,
    slips: Vec<f64>,
    cost: Cost,
}

fn measure(found: &mut ClosedFormRatios, scene: SceneText, law: &Law, growth: f64) -> Result<(), CaseError> {
    let done = texts::simulate(&scene.text()?)?;
    let mut sheared = done.report.steps.iter().filter(|s| s.stage == 1).peekable();
    let start = sheared.peek().map(|s| s.time - s.dt).ok_or("no step was taken")?;
    let first = sheared.find(|s| s.limited_by.starts_with("r6"));
    found.times.push(first.map_or(f64::NAN, |s| (s.time - start) / law.first_slip(growth)));
    let exact = law.slip(DEPTH + growth);
    found.slips.extend(done.contact("shear")?.slip.iter().map(|s| s.abs() / exact));
    found.cost = done.cost;
    Ok(())
}

fn claims(ledger: &mut Ledger, name: &str, found: &ClosedFormRatios) {
    let whole = |values: &[f64]| vec![1.0; values.len()];
    ledger
        .claim(format!("times at which the points begin to slip over their closed form, {name}"))
        .norm("three laws, with constant, growing and falling normal traction")
        .values(&found.times)
        .equals_each(&whole(&found.times))
        .absolute(1e-9)
        .evidence(Evidence::Exact, "v t = mu_s (d + w t), with equal penalties along and across")
        .because("tractions are linear in time until then, and limit r6 ends the step at the strength, which a traction reaches to 1e-9")
        .why_not_tighter("a traction within 1e-9 of its strength counts as being there, so that rounding does not add a step")
        .cost(&found.cost)
        .record();
    ledger
        .claim(format!("slip of each point at the end over its closed form, {name}"))
        .norm("three laws, with constant, growing and falling normal traction")
        .values(&found.slips)
        .equals_each(&whole(&found.slips))
        .absolute(1e-12)
        .evidence(Evidence::Exact, "travel less the elastic slip mu(s) (d + w)")
        .because("nothing deforms: positions of 1 m round to 2e-16, in slips of 10 mm")
        .why_not_tighter("rounding")
        .record();
}
