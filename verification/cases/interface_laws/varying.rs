//! Laws whose parameters vary along the interface, from files.

use super::{MU0, NORMAL, PRESSED, RUNS, SCENE, SPACE};
use crate::cases::run_files::Folder;
use crate::cases::texts::{self, BodyRun};
use crate::{Capability, CaseError, Evidence, Ledger};
use asperity_vary::SceneText;
use std::fmt::Write as _;

/// Friction coefficient of the left and the right end of the column; a grid by SciPy has the same: `independent/field_files.py`.
const MU: [f64; 2] = [0.3, 0.5];
const GRID: &[u8] = include_bytes!("files/friction.grd");

/// A linear function of the distance from the left end \[m\], with these values at both ends of the column.
fn linear([left, right]: [f64; 2], x: f64) -> f64 {
    left + (right - left) * x / super::WIDTH
}

/// Runs the claims.
pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    coulomb(ledger)?;
    in_space(ledger)?;
    steady(ledger)?;
    initial(ledger)
}

/// Runs a scene beside which these files lie.
fn simulate(scene: &SceneText, files: &[(&str, &[u8])]) -> Result<BodyRun, CaseError> {
    let folder = Folder::new()?;
    for (name, bytes) in files {
        std::fs::write(folder.path().join(name), bytes)?;
    }
    texts::simulate_in(&scene.clone().text()?, &folder.path().to_string_lossy())
}

/// Conditions on the column while its top moves as given.
fn conditions(x: &str) -> String {
    format!(
        "[{{ set = \"column.top\", x = {x}, y = \"hold\" }}, {{ set = \"column.left\", y = \"hold\" }}, \
         {{ set = \"column.right\", y = \"hold\" }}, {{ set = \"column.bottom\", x = \"free\", y = \"hold\" }}]"
    )
}

/// The column with four cells along the interface, a law and files of its parameters.
fn column(law: &str, fields: &str, (stepper, measure): (&str, &str)) -> SceneText {
    SceneText::new(SCENE)
        .with("bodies.column.mesh.block.divisions", "[4, 2]")
        .add("interfaces.fault.law", law)
        .add("interfaces.fault.fields", fields)
        .add("interfaces.fault.measure", measure)
        .add("time.stepper", stepper)
}

/// Shear traction along the motion, normal traction \[Pa\] and position \[m\] of each point at the end of a stage.
fn points(done: &BodyRun, stage: &str) -> Result<Vec<[f64; 3]>, CaseError> {
    let last = done.steps_until(stage)? - 1;
    let points = done.record.histories()[0].points.iter();
    Ok(points.map(|p| [-p.shear_traction[last], p.normal_traction[last], p.position[0]]).collect())
}

/// Coulomb friction with a linear coefficient under the whole column, and under a column whose left end hangs over the base.
fn coulomb(ledger: &mut Ledger) -> Result<(), CaseError> {
    let text = format!("x [mm],mu\n0,{}\n100,{}\n", MU[0], MU[1]);
    let files: [(&str, &[u8]); 2] = [("friction.csv", text.as_bytes()), ("friction.grd", GRID)];
    let (mut wrong, mut forces, mut cost) = (Vec::new(), Vec::new(), None);
    for (file, begins) in [("friction.csv", -0.05), ("friction.grd", -0.05), ("friction.csv", 0.01)] {
        for run in RUNS {
            let fields = format!("{{ mu = {{ file = \"{file}\" }} }}");
            let scene = column("{ kind = \"coulomb\", mu = 9 }", &fields, run)
                .with("bodies.base.mesh.block.min", format!("[{begins}, -0.05]"))
                .add("output.forces", "{ top = { set = \"column.top\" } }")
                .push("stages", stage("there", "500 s", "{ rate = 1e-6 }"))
                .push("stages", stage("back", "1000 s", "{ rate = -1e-6 }"));
            let done = simulate(&scene, &files)?;
            for (name, way) in [("there", 1.0), ("back", -1.0)] {
                let error = |&[t, f, x]: &[f64; 3]| (way * t - linear(MU, x) * f).abs() / NORMAL;
                wrong.push(points(&done, name)?.iter().map(error).fold(0.0, f64::max));
                if begins < 0.0 {
                    forces.push(way * done.force("top")?[done.steps_until(name)? - 1][0]);
                }
            }
            cost.get_or_insert(done.cost);
        }
    }
    let cost = cost.ok_or("nothing was run")?;
    ledger
        .claim("Coulomb friction with a coefficient linear along the interface, from CSV and netCDF: shear traction less mu(x) f_n of every point, over f_n, there and back, by both steppers and measures, also with an open point")
        .values(&wrong)
        .equals_each(&vec![0.0; wrong.len()])
        .absolute(1e-14)
        .evidence(Evidence::Exact, "mu(x) f_n where a point slides; 0 where it is open")
        .because("rounding of a mean of two values of the file and of two products")
        .why_not_tighter("a few roundings of 1e-16 each, and their number is not counted")
        .covers(&[Capability::Coulomb, Capability::Implicit, Capability::StaticExplicit])
        .cost(&cost)
        .record();
    let limit = 0.5 * (MU[0] + MU[1]) * NORMAL * super::WIDTH;
    ledger
        .claim("Coulomb friction with a coefficient linear along the interface: force that drags the column, over the integral of mu(x) f_n")
        .values(&forces.iter().map(|f| f / limit).collect::<Vec<_>>())
        .equals_each(&vec![1.0; forces.len()])
        .relative(1e-12)
        .evidence(Evidence::Exact, "equilibrium of the column: the mean coefficient times f_n times its width")
        .because("the trapezoidal rule is exact for linear functions; solving leaves 1e-13 of the forces")
        .why_not_tighter("how much solving leaves is known by its order only")
        .covers(&[Capability::Coulomb, Capability::Implicit, Capability::StaticExplicit])
        .cost(&cost)
        .record();
    Ok(())
}

/// A stage of the column.
fn stage(name: &str, duration: &str, x: &str) -> String {
    format!("{{ name = \"{name}\", duration = \"{duration}\", conditions = {} }}", conditions(x))
}

/// Coulomb friction in space with a coefficient linear in both coordinates, at scattered positions.
fn in_space(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mu = |x: f64, z: f64| 0.3 + 1.5 * x + 1.1 * z;
    let mut text = "x [m],z [m],mu\n".to_owned();
    for (x, z) in [(-0.01, -0.01), (0.12, -0.02), (-0.02, 0.13), (0.11, 0.12), (0.034, 0.061), (0.071, 0.018)]
    {
        writeln!(text, "{x:?},{z:?},{:?}", mu(x, z))?;
    }
    let (mut wrong, mut cost) = (Vec::new(), None);
    for (stepper, measure) in RUNS {
        let scene = SceneText::new(SPACE)
            .with("interfaces.fault.law", "{ kind = \"coulomb\", mu = 9 }")
            .add("interfaces.fault.fields", "{ mu = { file = \"friction.csv\" } }")
            .add("interfaces.fault.measure", measure)
            .add("interfaces.fault.sliding", "small")
            .with_or_same("time.stepper", stepper)
            .without("stages[5]")
            .without("stages[4]")
            .without("stages[3]")
            .without("stages[2]");
        let done = simulate(&scene, &[("friction.csv", text.as_bytes())])?;
        let fields = done.contact("load")?;
        let positions = &done.record.setup().interfaces[0].positions;
        let size = |v: &[f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
        let points = positions.iter().zip(&fields.shear_vector).zip(&fields.normal_traction);
        let error =
            |((at, t), f): ((&[f64; 3], &[f64; 3]), &f64)| (size(t) - mu(at[0], at[2]) * f).abs() / NORMAL;
        wrong.push(points.map(error).fold(0.0, f64::max));
        cost.get_or_insert(done.cost);
    }
    ledger
        .claim("Coulomb friction in space with a coefficient linear in x and z, from six scattered positions: size of the shear traction less mu(x, z) f_n of every point, over f_n, by both steppers and measures")
        .values(&wrong)
        .equals_each(&[0.0; 4])
        .absolute(1e-14)
        .evidence(Evidence::Exact, "mu(x, z) f_n where a point slides")
        .because("linear functions are linear on triangles: rounding of areas and of two products")
        .why_not_tighter("a few roundings of 1e-16 each, and their number is not counted")
        .covers(&[Capability::Coulomb, Capability::PenaltyContact3d])
        .cost(&cost.ok_or("nothing was run")?)
        .record();
    Ok(())
}

/// Direct and evolution effect, and L \[m\], at both ends of the column: friction weakens on the left and strengthens on the right.
const A: [f64; 2] = [0.010, 0.018];
const B: [f64; 2] = [0.015, 0.013];
const LENGTH: [f64; 2] = [12e-6, 8e-6];
/// Rates of the load \[m/s\]; Vref is the slow one.
const RATES: [f64; 2] = [1e-6, 1e-4];

/// Columns of a file with the parameters of a law of rate and state.
fn parameters(initial: [f64; 2]) -> String {
    let mut text = "x [m],a,b,l [um],v_initial [um/s]\n".to_owned();
    for end in 0..2 {
        let (x, l, v) = (end as f64 * super::WIDTH, 1e6 * LENGTH[end], 1e6 * initial[end]);
        text.push_str(&format!("{x:?},{:?},{:?},{l:?},{v:?}\n", A[end], B[end]));
    }
    text
}

/// The column with friction of rate and state, whose parameters come from one file.
fn rate_and_state_column(evolution: &str, run: (&str, &str)) -> SceneText {
    let law = format!(
        "{{ kind = \"rate-and-state\", evolution = \"{evolution}\", mu0 = {MU0}, a = 0.5, b = 0.5, l = 1, v_ref = {:e}, v_initial = 1 }}",
        RATES[0]
    );
    let keys = ["a", "b", "l", "v_initial"].map(|key| format!("{key} = {{ file = \"friction.csv\" }}"));
    column(&law, &format!("{{ {} }}", keys.join(", ")), run).add("interfaces.fault.under_resolved", "allow")
}

/// Steady friction of laws of rate and state at two rates.
fn steady(ledger: &mut Ledger) -> Result<(), CaseError> {
    let file = parameters([0.5e-6, 2e-6]);
    for evolution in ["ageing", "slip"] {
        let (mut wrong, mut cost) = (Vec::new(), None);
        for run in RUNS {
            let scene = rate_and_state_column(evolution, run)
                .push("stages", stage("slow", "700 s", &format!("{{ rate = {:e} }}", RATES[0])))
                .push("stages", stage("fast", "6 s", &format!("{{ rate = {:e} }}", RATES[1])));
            let done = simulate(&scene, &[("friction.csv", file.as_bytes())])?;
            for (name, rate) in [("slow", RATES[0]), ("fast", RATES[1])] {
                let error = |&[t, f, x]: &[f64; 3]| {
                    let mu = MU0 + (linear(A, x) - linear(B, x)) * (rate / RATES[0]).ln();
                    (t - mu * f).abs() / NORMAL
                };
                wrong.push(points(&done, name)?.iter().map(error).fold(0.0, f64::max));
            }
            cost.get_or_insert(done.cost);
        }
        ledger
            .claim(format!("{evolution} law with a, b and L linear along the interface: shear traction less [mu0 + (a - b)(x) ln(V/Vref)] f_n of every point, over f_n, at 1 and 100 um/s, by both steppers and measures"))
            .values(&wrong)
            .equals_each(&vec![0.0; wrong.len()])
            .absolute(1e-9)
            .evidence(Evidence::Exact, "steady friction at the rate of the load")
            .because("e^-50 of the way to the steady state is left; explicit steps leave a drift of 1e-9 of the forces there")
            .why_not_tighter("how far drift falls in steady sliding is known by its order only")
            .covers(&[Capability::LawFamily, Capability::Implicit, Capability::StaticExplicit])
            .cost(&cost.ok_or("nothing was run")?)
            .record();
    }
    Ok(())
}

/// Initial states, after the second at rest that follows on them.
fn initial(ledger: &mut Ledger) -> Result<(), CaseError> {
    let rates = [0.2e-6, 5e-6];
    let file = parameters(rates);
    let (mut wrong, mut cost) = (Vec::new(), None);
    for run in RUNS {
        let done = simulate(&rate_and_state_column("ageing", run), &[("friction.csv", file.as_bytes())])?;
        let fields = done.contact("release")?;
        let positions = &done.record.setup().interfaces[0].positions;
        let found = fields.states.first().ok_or("the law has no state")?;
        let error = |(at, state): (&[f64; 3], &f64)| {
            let (l, v) = (linear(LENGTH, at[0]), linear(rates, at[0]));
            (state - (RATES[0] * (l / v + 0.5 * PRESSED) / l).ln()).abs()
        };
        wrong.push(positions.iter().zip(found).map(error).fold(0.0, f64::max));
        cost.get_or_insert(done.cost);
    }
    ledger
        .claim("ageing law with L and v_initial linear along the interface: ln(Vref theta/L) of every point after a second at rest, by both steppers and measures")
        .values(&wrong)
        .equals_each(&[0.0; 4])
        .absolute(1e-14)
        .evidence(Evidence::Exact, "theta = L/v_initial + t at rest")
        .because("rounding; without shear traction nothing slips")
        .why_not_tighter("a few roundings of 1e-16 each, and their number is not counted")
        .covers(&[Capability::LawFamily, Capability::Implicit, Capability::StaticExplicit])
        .cost(&cost.ok_or("nothing was run")?)
        .record();
    Ok(())
}
