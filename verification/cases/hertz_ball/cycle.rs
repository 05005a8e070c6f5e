//! The ball sheared to and fro: the energy of a cycle.

use super::{CLAIMED, MU, SCENE, SIZE};
use crate::cases::hertz::compliance;
use crate::cases::texts::{simulate, work};
use crate::{Capability, CaseError, Evidence, Ledger};
use asperity_vary::SceneText;

/// Stages after those of the scene.
const STAGES: &str = r#"
[[stages]]
name = "back"
duration = "1 s"
steps = 16
conditions = [{ set = "ball.top", x = { to = "-3.2 um" }, y = "hold" }]

[[stages]]
name = "forth"
duration = "1 s"
steps = 16
conditions = [{ set = "ball.top", x = { to = "3.2 um" }, y = "hold" }]
"#;
/// Amplitude of the motion \[m\].
const AMPLITUDE: f64 = 3.2e-6;

pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (name, measure, capability) in [
        ("mortar", "mortar", Capability::Mortar),
        ("node-to-point", "node-to-point", Capability::PenaltyContact3d),
    ] {
        let done = simulate(&scene(measure)?)?;
        let from = done.steps_until("shear")? - 1;
        let forces = &done.force("top")?[from..];
        let place = |t: &f64| AMPLITUDE * if *t < 3.0 { 5.0 - 2.0 * t } else { 2.0 * t - 7.0 };
        let way: Vec<f64> = done.record.times()[from..].iter().map(place).collect();
        let along: Vec<f64> = forces.iter().map(|f| f[0]).collect();
        // The scene models one half.
        let supplied = 2.0 * work(&along, &way).iter().sum::<f64>();
        let lost = 2.0 * (done.contact("forth")?.dissipated - done.contact("shear")?.dissipated);
        let [shear, load] = [2.0 * forces[0][0], -2.0 * forces[0][1]];
        let covers = [Capability::Hertz, Capability::Solid3d, Capability::Coulomb, capability];
        ledger
            .claim(format!("energy that friction dissipates in a cycle, {name}, cells of a/4.8"))
            .unit("J")
            .value(lost)
            .equals(exact(load, shear))
            .relative(0.083)
            .evidence(
                Evidence::Exact,
                "Johnson 1985, 7.57, at the loads of the run: (9 mu^2 P^2 S/(10 a)) {1 - (1-q)^(5/3) - (5 q/6) [1 + (1-q)^(2/3)]}",
            )
            .because("it is lost between the edges of stick and contact, each known to 0.4 h/a of the area; one of them moves")
            .why_not_tighter("where nodes lie about both edges changes it")
            .covers(&covers)
            .cost(&done.cost)
            .record();
        ledger
            .claim(format!("work of the machine over a cycle against what friction dissipates, {name}"))
            .unit("J")
            .value(supplied)
            .equals(lost)
            .relative(0.01)
            .evidence(Evidence::Exact, "after a cycle everything is where it was")
            .because("the trapezoidal rule over 16 steps each way, whose forces bend by the square of the step where slip sets in")
            .why_not_tighter("nodes begin to slip one by one")
            .covers(&covers)
            .record();
    }
    Ok(())
}

fn scene(measure: &str) -> Result<String, CaseError> {
    let mut scene = SceneText::new(&format!("{SCENE}{STAGES}"))
        .with_or_same("interfaces.contact.measure", measure)
        .with_or_same(
            "interfaces.contact.enforcement",
            format!(
                "{{ kind = \"penalty\", normal = \"{stiffness} MPa/mm\", tangential = \"{stiffness} MPa/mm\" }}",
                stiffness = 8.3e5 * SIZE / CLAIMED
            ),
        );
    for body in ["flat", "ball"] {
        for axis in 0..3 {
            scene = scene
                .with(&format!("bodies.{body}.mesh.block.spacing[{axis}].size"), format!("{CLAIMED} mm"));
        }
    }
    Ok(scene.text()?)
}

/// Energy of a cycle between shear loads of both signs \[J\].
fn exact(load: f64, shear: f64) -> f64 {
    let (young, radius) = (1e9, 8e-3);
    let a = (0.75 * load * radius * compliance([(young, 0.0); 2])).cbrt();
    // S is the sum of (2 - nu)/G of both bodies.
    let s = 2.0 * 2.0 / (young / 2.0);
    let q = shear / (MU * load);
    let rest = 1.0 - q;
    let part = 1.0 - rest.powf(5.0 / 3.0) - 5.0 * q / 6.0 * (1.0 + rest.powf(2.0 / 3.0));
    9.0 * (MU * load).powi(2) * s / (10.0 * a) * part
}
