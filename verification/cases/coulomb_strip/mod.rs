//! Two blocks sheared back and forth under Coulomb friction: force, hysteresis loop, dissipated energy.

use super::texts::{BodyRun, simulate, work};
use crate::{Capability, Case, CaseError, Evidence, Ledger, Plot, Series};
use asperity_vary::Change::{self, Add, With};
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "coulomb_strip",
    readme: include_str!("README.md"),
    covers: &[Capability::Coulomb, Capability::Stages],
    quick: true,
    run,
};

const SCENE: &str = include_str!("scene.toml");
/// E \[Pa\].
const YOUNG: f64 = 1e3;
/// G of E = 1 kPa, nu = 0 \[Pa\].
const SHEAR: f64 = 500.0;
/// E_n and E_t \[Pa/m\].
const PENALTY: f64 = 1e4;
/// mu p \[Pa\].
const STRENGTH: f64 = 1.0;
/// Largest displacement \[m\].
const REACH: f64 = 8.2e-3;

/// Force per displacement while everything sticks, for blocks of 1 m: 1/(2H/G + 1/E_t) \[Pa/m\].
fn slope() -> f64 {
    1.0 / (2.0 / SHEAR + 1.0 / PENALTY)
}

const SOLID: [Change<'_>; 12] = [
    With("kinematics", "3d"),
    With("bodies.lower.mesh.block.element", "hex8"),
    With("bodies.lower.mesh.block.min", "[0, 0, 0]"),
    With("bodies.lower.mesh.block.max", r#"["1 m", "1 m", "1 m"]"#),
    With("bodies.lower.mesh.block.divisions", "[2, 2, 2]"),
    With("bodies.upper.mesh.block.element", "hex8"),
    With("bodies.upper.mesh.block.min", r#"[0, "1 m", 0]"#),
    With("bodies.upper.mesh.block.max", r#"["1 m", "2 m", "1 m"]"#),
    With("bodies.upper.mesh.block.divisions", "[2, 2, 2]"),
    Add("stages[0].conditions[0].z", "0"),
    Add("stages[0].conditions[1].z", "0"),
    With("output.probes.contact", "3"),
];

/// A variant: its name, its changes to the scene, and the capabilities it covers.
type Variant<'a> = (&'a str, Vec<Change<'a>>, &'a [Capability]);

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let forward = With("time.stepper", "static-explicit");
    let mortar = With("interfaces.contact.measure", "mortar");
    let apart = With("bodies.upper.mesh.block.divisions", "[3, 4]");
    let variants: [Variant<'_>; 5] = [
        ("node-to-point, implicit", vec![], &[Capability::PenaltyContact2d, Capability::Implicit]),
        (
            "node-to-point, static-explicit",
            vec![forward],
            &[Capability::PenaltyContact2d, Capability::StaticExplicit],
        ),
        ("mortar, 3 on 4 facets, implicit", vec![mortar, apart], &[Capability::Mortar, Capability::Implicit]),
        (
            "mortar, 3 on 4 facets, static-explicit",
            vec![mortar, apart, forward],
            &[Capability::Mortar, Capability::StaticExplicit],
        ),
        (
            "node-to-point, in space, implicit",
            SOLID.to_vec(),
            &[Capability::PenaltyContact3d, Capability::Implicit],
        ),
    ];
    let mut rows = Vec::new();
    for (name, changes, covers) in variants {
        let done = simulate(&SceneText::new(SCENE).changed(&changes).text()?)?;
        let run = Loop::from_run(&done)?;
        run.force(ledger, name, covers, &done);
        budget(ledger, name, covers, &done);
        // In 3D the records hold magnitudes only.
        if !covers.contains(&Capability::PenaltyContact3d) {
            run.energy(ledger, name, covers, &done)?;
        }
        rows.push([
            name.to_owned(),
            done.report.counts.steps.to_string(),
            done.report.counts.operations.iterations.to_string(),
            done.report.counts.rejected.to_string(),
            done.cost.wall.map_or_else(String::new, |w| format!("{w:.3}")),
        ]);
        if name == "node-to-point, implicit" {
            let points: Vec<(f64, f64)> =
                run.way.iter().map(|u| u * 1e3).zip(run.force.iter().copied()).collect();
            let plot = Plot::xy("loop of force over displacement", "displacement [mm]", "shear force [N/m]");
            ledger.plot(plot.series(Series::marked("two cycles", &points)));
        }
    }
    ledger.table("two and a half reversals", &["run", "steps", "iterations", "rejected", "seconds"], rows);
    Ok(())
}

/// Claims the parts of the energy budget after all stages, the last of which ends as it slips forward.
fn budget(ledger: &mut Ledger, name: &str, covers: &[Capability], done: &BodyRun) {
    let pressure = STRENGTH / 0.25;
    // Slip of the first stage, and of two cycles.
    let friction = 9.0 * STRENGTH * (REACH - STRENGTH / slope());
    let elastic = pressure * pressure / YOUNG + STRENGTH * STRENGTH / SHEAR;
    let contact = 0.5 * (pressure * pressure + STRENGTH * STRENGTH) / PENALTY;
    let energy = &done.report.energy;
    ledger
        .claim(format!("friction, elastic energy, energy of the penalties and work of the motions after two cycles, {name}"))
        .unit("J")
        .values(&["friction", "elastic", "contact", "motions"].map(|part| energy.part(part)))
        .equals_each(&[friction, elastic, contact, friction + elastic + contact])
        .relative(1e-10)
        .evidence(Evidence::Exact, "mu p A s with s = 9 (U - mu p/k); H (p²/E + tau²/G); (p² + tau²)/(2 E_n)")
        .because("forces are linear within every step, since slip begins at the end of one: rounding")
        .why_not_tighter("rounding of dense factors varies with the variant")
        .covers(covers)
        .cost(&done.cost)
        .record();
    ledger
        .claim(format!("energy that the budget misses, over the largest part, {name}"))
        .value(energy.imbalance)
        .at_most(1e-10)
        .evidence(Evidence::Exact, "energy is put in, stored or dissipated")
        .because("as for its parts")
        .why_not_tighter("rounding of dense factors varies with the variant")
        .covers(covers)
        .cost(&done.cost)
        .record();
}

/// Force against displacement after the pressing stage.
struct Loop {
    way: Vec<f64>,
    force: Vec<f64>,
    dissipated: Vec<f64>,
    times: Vec<f64>,
}

impl Loop {
    fn from_run(done: &BodyRun) -> Result<Loop, CaseError> {
        let from = done.steps_until("press")? - 1;
        let times = done.record.times()[from..].to_vec();
        let way = |t: &f64| match t - 1.0 {
            s if s <= 1.0 => s * REACH,
            s => REACH * (2.0 * ((s - 1.0).rem_euclid(2.0) - 1.0).abs() - 1.0),
        };
        Ok(Loop {
            way: times.iter().map(way).collect(),
            force: done.force("top")?[from..].iter().map(|f| f[0]).collect(),
            dissipated: done.dissipated()[from..].to_vec(),
            times,
        })
    }

    /// The exact force: that of an elastic, perfectly plastic spring.
    fn exact(&self) -> Vec<f64> {
        let (mut f, mut u) = (0.0, 0.0);
        self.way
            .iter()
            .map(|&w| {
                f = f64::clamp(f + slope() * (w - u), -STRENGTH, STRENGTH);
                u = w;
                f
            })
            .collect()
    }

    fn force(&self, ledger: &mut Ledger, name: &str, covers: &[Capability], done: &BodyRun) {
        ledger
            .claim(format!("shear force through two cycles, {name}"))
            .unit("N")
            .values(&self.force)
            .equals_each(&self.exact())
            .absolute(1e-10)
            .evidence(Evidence::Exact, "tau = min(k u, mu p) with k = 1/(2H/G + 1/E_t), and the same from every reversal")
            .because("uniform fields are solutions of the discrete problem: rounding, times E_t over k and 40 steps")
            .why_not_tighter("rounding of dense factors varies with the variant")
            .covers(covers)
            .cost(&done.cost)
            .record();
    }

    /// Claims the external work of each part of the path against stored and dissipated energy.
    fn energy(
        &self,
        ledger: &mut Ledger,
        name: &str,
        covers: &[Capability],
        done: &BodyRun,
    ) -> Result<(), CaseError> {
        let put = work(&self.force, &self.way);
        let until = |stage: f64| self.times.iter().take_while(|&&t| t <= stage + 1e-9).count();
        let sum = |v: &[f64], from: usize, to: usize| v[from..to].iter().sum::<f64>();
        let yielding = STRENGTH / slope();
        let cycle = 4.0 * STRENGTH * (REACH - yielding);
        // Entry k of `put` belongs to the step that ends at sample k + 1.
        let (first, second, third) = (until(2.0), until(4.0), until(6.0));
        let losses = [sum(&self.dissipated, first, second), sum(&self.dissipated, second, third)];
        ledger
            .claim(format!("work dissipated in each of two cycles, {name}"))
            .unit("J")
            .values(&losses)
            .equals_each(&[cycle; 2])
            .relative(1e-10)
            .evidence(Evidence::Exact, "4 mu p (U - mu p/k)")
            .because("tractions are constant while a node slips, and every turning point of the path ends a step: rounding")
            .why_not_tighter("rounding of dense factors varies with the variant")
            .covers(covers)
            .cost(&done.cost)
            .record();
        let (work, lost) = (sum(&put, 0, third - 1), sum(&self.dissipated, 1, third));
        let stored = 0.5 * STRENGTH * STRENGTH / slope();
        ledger
            .claim(format!("work put in less work dissipated and energy stored, over the first, {name}"))
            .value(((work - lost - stored) / work).abs())
            .at_most(1e-10)
            .evidence(Evidence::Exact, "energy is put in, stored as tau^2/(2k), or dissipated")
            .because("the force is linear within every step: the trapezoidal rule is exact; rounding")
            .why_not_tighter("rounding of dense factors varies with the variant")
            .covers(covers)
            .cost(&done.cost)
            .record();
        Ok(())
    }
}
