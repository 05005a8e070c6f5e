//! Steadily sliding blocks under a law with two states, beside a pair of blocks at rest: states of all points in all files, and the
//! friction of a spring, whose force is carried by the normal forces of all interfaces.

use super::contact::{HEIGHTS, NORMAL, RATES, WIDTHS, scene};
use super::{Capability, CaseError, Cost, Evidence, Folder, Ledger, last};
use crate::cases::output_files::vtu::Fields;
use crate::cases::run_files;
use asperity_vary::SceneText;

/// μ0, a, V_0 \[m/s\] and both b.
const LAW: [f64; 3] = [0.6, 0.03, 1e-6];
const STATES: [f64; 2] = [0.012, 0.004];
/// Width of the pair at rest \[m\].
const REST: f64 = 0.1;

fn text() -> Result<String, CaseError> {
    let [mu0, a, v0] = LAW;
    let law = format!(
        "{{ kind = \"rate-and-state\", evolution = \"slip\", mu0 = {mu0:?}, a = {a:?}, b = {STATES:?}, l = [\"20 um\", \"60 um\"], \
         v_ref = {v0:e}, v_initial = {v0:e} }}"
    );
    let [_, below] = HEIGHTS;
    let body = |from: f64, to: f64, material: &str| {
        format!(
            "{{ material = \"{material}\", initial_stress = [0, -5e6, 0], \
             mesh.block = {{ min = [1.0, {from:?}], max = [{:?}, {to:?}], divisions = [1, 1], element = \"quad4\" }} }}",
            1.0 + REST
        )
    };
    let mut scene = SceneText::new(&scene(false, RATES))
        .with("interfaces.joint.law", law)
        .add("bodies.above", body(below, below + 0.1, "upper"))
        .add("bodies.below", body(below - 0.1, below, "lower"))
        .add(
            "interfaces.rest",
            "{ slave = \"above.bottom\", master = \"below.top\", measure = \"node-to-point\", sliding = \"small\", initial_stress = true, \
             enforcement = { kind = \"penalty\", normal = 2e13, tangential = 2e13 }, law = { kind = \"coulomb\", mu = 0.5 } }",
        );
    for set in ["above.top", "above.left", "above.right", "below.bottom", "below.left", "below.right"] {
        scene = scene.push("stages[0].conditions", format!("{{ set = \"{set}\", x = 0, y = 0 }}"));
    }
    Ok(scene.text()?)
}

/// See the module.
pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (files, cost) = run_files::bodies(&text()?)?;
    let [mu0, a, v0] = LAW;
    let rate = RATES[0];
    let steady = STATES.map(|b| -b * (rate / v0).ln());
    let strength = NORMAL * a * (0.5 * rate / v0 * ((mu0 + steady[0] + steady[1]) / a).exp()).asinh();
    for (k, exact) in steady.into_iter().enumerate() {
        states(ledger, (&files, &cost), k, exact)?;
    }
    let [width, _] = WIDTHS;
    for (column, exact) in
        [("force", strength * width), ("friction", strength * width / (NORMAL * (width + REST)))]
    {
        ledger
            .claim(format!("blocks under a law with two states beside blocks at rest: {column} of the spring, at the end"))
            .value(last(&files, "springs/upper_top_x.csv", column)?)
            .equals(exact)
            .relative(1e-6)
            .evidence(Evidence::Exact, "steady friction, mu0 - (b1 + b2) ln(V/V_0) in the regularised form; the normal forces of both interfaces")
            .because("errors of friction coefficients of 1e-6 in a step decay with slip, by ten orders over a hundred lengths")
            .why_not_tighter("how far the last steps forget them depends on their lengths")
            .covers(&[Capability::Outputs, Capability::SeveralStates, Capability::InterfaceStates])
            .cost(&cost)
            .record();
    }
    Ok(())
}

/// Values of a state at all points in the last rows of the files.
fn states(
    ledger: &mut Ledger,
    (files, cost): (&Folder, &Cost),
    k: usize,
    exact: f64,
) -> Result<(), CaseError> {
    let name = format!("state_{}", k + 1);
    let newest = |folder: &str| -> Result<String, CaseError> {
        let names = files.names(folder)?;
        let name = names.into_iter().rfind(|name| name.starts_with("joint")).ok_or("no file of the joint")?;
        Ok(format!("{folder}/{name}"))
    };
    let mut found = files.table(&newest("profiles")?)?.column(&name)?;
    found.extend(&Fields::read(&files.text(&newest("fields")?)?)?.array(&name)?.values);
    let probes = files.table("probes/joint.csv")?;
    let of_probes =
        probes.head().iter().enumerate().filter(|(_, head)| head.starts_with(&name)).map(|(c, _)| c);
    let row = probes.numbers().pop().ok_or("no row")?;
    found.extend(of_probes.map(|c| row[c]));
    if found.len() != 3 + 3 + 2 {
        return Err(format!("{} values of {name}", found.len()).into());
    }
    ledger
        .claim(format!("blocks under a law with two states: {name} at all points of profiles, fields and probes, at the end"))
        .values(&found)
        .equals_each(&[exact; 8])
        .absolute(1e-6 * LAW[1])
        .evidence(Evidence::Exact, "the slip law in steady slip, -b ln(V/V_0) for each state")
        .because("errors of friction coefficients of 1e-6 in a step decay with slip, by ten orders over a hundred lengths")
        .why_not_tighter("how far the last steps forget them depends on their lengths")
        .covers(&[Capability::Outputs, Capability::SeveralStates, Capability::InterfaceStates])
        .cost(cost)
        .record();
    Ok(())
}
