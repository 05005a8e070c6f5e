//! Numbers along axes that the other scenes do not have: interfaces across z, faults across y, and cells of single bodies.

use super::contact::{DURATION, HEIGHTS, LAW, MODULI, NORMAL, PENALTY, Steady, WIDTHS};
use super::vtu::Fields;
use super::{ExpectedNumber, FileClaims};
use crate::cases::run_files::{self, WrittenRun};
use crate::{Capability, CaseError, Evidence, Ledger};

/// Rates of the drawn side along x and y \[m/s\].
const RATES: [f64; 2] = [-1.5e-6, 2e-6];

/// See the module.
pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    interface(ledger)?;
    fault(ledger)?;
    cells(ledger)
}

/// Blocks of the other scenes on top of each other along z.
fn across_z() -> String {
    let ([w, d], [upper, lower], [mu0, a, v0]) = (WIDTHS, HEIGHTS, LAW);
    let block = |name: &str, [from, to]: [f64; 2], modulus: f64| {
        format!(
            "[bodies.{name}]\nmaterial = \"{name}\"\ninitial_stress = [0, 0, {:?}, 0, 0, 0]\n\
             mesh.block = {{ min = [0, 0, {from:?}], max = [{w:?}, {d:?}, {to:?}], divisions = [2, 1, 1], element = \"hex8\" }}\n\
             [materials.{name}]\npoisson = 0.25\nyoung = {:?}\n",
            -NORMAL,
            2.5 * modulus
        )
    };
    let held: String = ["upper", "lower"]
        .iter()
        .flat_map(|body| {
            ["left", "right", "bottom", "top"].map(|side| format!("{{ set = \"{body}.{side}\", z = 0 }}, "))
        })
        .collect();
    format!(
        "schema = 1\ntitle = \"steady sliding\"\nkinematics = \"3d\"\n{}{}\
         [interfaces.joint]\nslave = \"upper.back\"\nmaster = \"lower.front\"\nmeasure = \"node-to-point\"\nsliding = \"small\"\n\
         initial_stress = true\nenforcement = {{ kind = \"penalty\", normal = {PENALTY:e}, tangential = {PENALTY:e} }}\n\
         law = {{ kind = \"rate\", form = \"regularised\", mu0 = {mu0:?}, a = {a:?}, v_ref = {v0:e} }}\n\
         [[stages]]\nname = \"slide\"\nduration = {DURATION:?}\n\
         conditions = [{held}{{ set = \"upper.front\", x = {{ rate = {:e} }}, y = {{ rate = {:e} }}, z = 0 }}, \
         {{ set = \"lower.back\", x = 0, y = 0, z = 0 }}]\n\
         [time]\nstepper = \"implicit\"\n[output]\nprobes.joint = 2\nprofiles = 1\n",
        block("upper", [lower, lower + upper], MODULI[0]),
        block("lower", [0.0, lower], MODULI[1]),
        RATES[0],
        RATES[1],
    )
}

/// Blocks that slide past each other across z, so that slip has parts along x and y.
fn interface(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (files, cost) = run_files::bodies(&across_z())?;
    let rate = RATES[0].hypot(RATES[1]);
    let s = Steady::new(rate * DURATION, rate, 0.0);
    let [x, y] = RATES.map(|part| part / rate);
    let wanted: [ExpectedNumber<'_>; 12] = [
        ("probes/joint.csv", "slip_x", s.slip * x),
        ("probes/joint.csv", "slip_y", s.slip * y),
        ("probes/joint.csv", "shear_traction_x", s.shear * x),
        ("probes/joint.csv", "shear_traction_y", s.shear * y),
        ("probes/joint.csv", "normal_traction", NORMAL),
        ("profiles/joint_*.csv", "slip_x", s.slip * x),
        ("profiles/joint_*.csv", "slip_y", s.slip * y),
        ("profiles/joint_*.csv", "shear_traction_x", s.shear * x),
        ("profiles/joint_*.csv", "shear_traction_y", s.shear * y),
        ("profiles/joint_*.csv", "normal_traction", NORMAL),
        ("profiles/joint_*.csv", "y", WIDTHS[1]),
        ("profiles/joint_*.csv", "z", HEIGHTS[1]),
    ];
    let claims = FileClaims {
        title: "two blocks that slide steadily across z",
        bound: 1e-8,
        source: "friction of the law at the rate of the load; blocks and penalty bend under it",
        because: "Newton's method leaves 1e-11 of the forces, and files have ten digits",
        slack: "the last of ten digits may be off by any part of a half",
        covers: &[Capability::Outputs, Capability::VelocityFriction],
    };
    claims.claim(ledger, (&files, &cost), &wanted)
}

/// Law of the fault: a, b, mu0, V_0 \[m/s\] and L \[m\].
const FAULT: [f64; 5] = [0.02, 0.015, 0.6, 1e-6, 8e-6];
/// Slip rate at the start and that of the load \[m/s\].
const SPEEDS: [f64; 2] = [1e-5, 2e-5];
/// Length of the fault \[m\].
const LENGTH: f64 = 2.0;

/// Steady friction of the regularised law \[Pa\].
fn strength(rate: f64) -> f64 {
    let [a, b, mu0, v0, _] = FAULT;
    NORMAL * a * (0.5 * rate / v0 * ((mu0 + b * (v0 / rate).ln()) / a).exp()).asinh()
}

/// A fault across y that slides out of the plane, twice as fast as at the start.
fn fault(ledger: &mut Ledger) -> Result<(), CaseError> {
    let [a, b, mu0, v0, l] = FAULT;
    let [first, drawn] = SPEEDS;
    let block = |name: &str, from: f64| {
        format!(
            "[bodies.{name}]\nmaterial = \"rock\"\n\
             mesh.block = {{ min = [0, {from:?}], max = [{LENGTH:?}, {:?}], divisions = [2, 1], element = \"quad4\" }}\n",
            from + 1.0
        )
    };
    let text = format!(
        "schema = 1\ntitle = \"steady slip\"\nkinematics = \"antiplane\"\n[materials.rock]\nyoung = 50e9\npoisson = 0.25\ndensity = 2700\n{}{}\
         [faults.main]\nminus = \"lower.top\"\nplus = \"upper.bottom\"\nnormal = {NORMAL:?}\nrate = {first:e}\n\
         law = {{ kind = \"rate-and-state\", evolution = \"ageing\", mu0 = {mu0:?}, a = {a:?}, b = {b:?}, l = {l:e}, v_ref = {v0:e}, v_initial = {first:e} }}\n\
         [[stages]]\nname = \"steady\"\nduration = {DURATION:?}\n\
         conditions = [{{ set = \"lower.bottom\", z = {{ rate = {:e} }} }}, {{ set = \"upper.top\", z = {{ rate = {:e} }} }}]\n\
         [time]\nstepper = \"fault-ode\"\nlog_rate_tolerance = 1e-9\n\
         [output]\npoints.middle = {{ body = \"upper\", at = [1, 0.5] }}\nforces.drawn = {{ set = \"upper.top\" }}\n",
        block("lower", -1.0),
        block("upper", 0.0),
        -0.5 * drawn,
        0.5 * drawn,
    );
    let done = WrittenRun::from_text(&text)?;
    // Of bodies there are changes since the start.
    let change = strength(drawn) - strength(first);
    let wanted: [ExpectedNumber<'_>; 2] =
        [("points/middle.csv", "stress_yz", change), ("forces/drawn.csv", "force_z", change * LENGTH)];
    let claims = FileClaims {
        title: "a fault across y that slides twice as fast as at the start",
        bound: 1e-7,
        source: "friction of the law at the rate of the load, less that at the start",
        because: "the error of ln V in a step is 1e-9, and of the change, ln 2 (a - b) f_n, that is some 1e-8",
        slack: "errors of steps decay with slip",
        covers: &[Capability::Outputs, Capability::FaultCycles, Capability::Antiplane],
    };
    claims.claim(ledger, (&done.files, &done.cost), &wanted)
}

/// Young's modulus, yield stress and modulus of hardening \[Pa\].
const METAL: [f64; 3] = [200e9, 200e6, 10e9];
/// Strains of two bars, of which the second does not yield.
const STRAINS: [f64; 2] = [4e-3, 1e-4];

/// Two bars of one cell each: numbers of bodies and plastic strain of cells.
fn cells(ledger: &mut Ledger) -> Result<(), CaseError> {
    let [young, yields, hardens] = METAL;
    let bar = |name: &str, from: f64| {
        format!(
            "[bodies.{name}]\nmaterial = \"metal\"\n\
             mesh.block = {{ min = [{from:?}, 0, 0], max = [{:?}, 1, 1], divisions = [1, 1, 1], element = \"hex8\" }}\n",
            from + 1.0
        )
    };
    let pulled = |name: &str, strain: f64| {
        format!(
            "{{ set = \"{name}.left\", x = 0 }}, {{ set = \"{name}.bottom\", y = 0 }}, {{ set = \"{name}.back\", z = 0 }}, \
             {{ set = \"{name}.top\", y = {{ to = {strain:e} }} }}, "
        )
    };
    let text = format!(
        "schema = 1\ntitle = \"bars\"\nkinematics = \"3d\"\n[materials.metal]\nyoung = {young:e}\npoisson = 0.3\n\
         plasticity = {{ hardening = \"linear\", yield = {yields:e}, modulus = {hardens:e} }}\n{}{}\
         [[stages]]\nname = \"pull\"\nduration = 1\nconditions = [{}{}]\n[time]\nstepper = \"implicit\"\n",
        bar("first", 0.0),
        bar("second", 2.0),
        pulled("first", STRAINS[0]),
        pulled("second", STRAINS[1]),
    );
    let (files, cost) = run_files::bodies(&text)?;
    let name = files.names("fields")?.pop().ok_or("no fields")?;
    let fields = Fields::read(&files.text(&format!("fields/{name}"))?)?;
    let plastic = (young * STRAINS[0] - yields) / (young + hardens);
    for (array, wanted, source) in [
        ("plastic_strain", [plastic, 0.0], "(E strain - yield stress)/(E + H) under uniaxial stress"),
        ("body", [0.0, 1.0], "bodies in the order of the scene, from 0"),
    ] {
        ledger
            .claim(format!("two bars of which one yields: {array} of their cells in the fields"))
            .values(&fields.array(array)?.values)
            .equals_each(&wanted)
            .absolute(1e-10)
            .evidence(Evidence::Exact, source)
            .because("uniform strain: Newton's method leaves 1e-11 of the forces, some 1e-14 of strain")
            .why_not_tighter("what the last iteration leaves is chance")
            .covers(&[Capability::Outputs, Capability::Solid3d])
            .cost(&cost)
            .record();
    }
    Ok(())
}
