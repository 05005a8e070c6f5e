//! All numbers in the files of faults that slide steadily between two blocks: out of the plane, and in space where slip turns
//! towards its load.
//!
//! Slip is uniform, and friction strengthens with velocity. In the plane nothing changes from the start on. In space the fault
//! starts along its rake and is drawn at 60 degrees from it. It forgets its direction by a factor of e while it slips by the strength over
//! the stiffness of the blocks, 0.4 mm, and slips by 10 mm. What it lags behind the load tells of the start.

use super::{OfFiles, Wanted};
use crate::cases::written::{Folder, Written};
use crate::{Capability, CaseError, Cost, Ledger};

/// a, b, μ0, V_0 \[m/s\] and L \[m\].
const LAW: [f64; 5] = [0.02, 0.015, 0.6, 1e-6, 8e-6];
/// Normal traction \[Pa\].
const NORMAL: f64 = 5e6;
/// Shear moduli of both blocks, each a metre wide \[Pa\].
const MODULI: [f64; 2] = [10e9, 40e9];
/// Rate of the load \[m/s\], and how long it lasts \[s\].
const RATE: f64 = 1e-5;
const DURATION: f64 = 1000.0;
/// Angle of the load from the rake in space.
const ANGLE: f64 = std::f64::consts::FRAC_PI_3;
/// Area of the fault \[m; m²\].
const AREA: f64 = 2.0;

/// Shear modulus of moments, that of the uniform medium in which slip loads its plane alike \[Pa\].
const MODULUS: f64 = 2.0 * MODULI[0] * MODULI[1] / (MODULI[0] + MODULI[1]);

/// Friction of the regularised law under steady slip \[Pa\], with θ = L/V.
fn strength() -> f64 {
    let [a, b, mu0, v0, _] = LAW;
    NORMAL * a * (0.5 * RATE / v0 * ((mu0 + b * (v0 / RATE).ln()) / a).exp()).asinh()
}

/// log10 of the state θ \[s\].
fn theta() -> f64 {
    (LAW[4] / RATE).log10()
}

fn scene(space: bool) -> String {
    let [a, b, mu0, v0, l] = LAW;
    let block = |name: &str, from: f64| {
        let (z, divisions, element) =
            if space { ([", 0", ", 1"], "[1, 1, 1]", "hex8") } else { (["", ""], "[1, 1]", "quad4") };
        format!(
            "[bodies.{name}]\nmaterial = \"{name}\"\n\
             mesh.block = {{ min = [{from:?}, 0{}], max = [{:?}, 2{}], divisions = {divisions}, element = \"{element}\" }}\n",
            z[0],
            from + 1.0,
            z[1]
        )
    };
    let rock = |name: &str, modulus: f64| {
        format!("[materials.{name}]\nyoung = {:?}\npoisson = 0.25\ndensity = 2700\n", 2.5 * modulus)
    };
    let half = 0.5 * RATE;
    let (conditions, vector) = if space {
        let (up, along) = (half * ANGLE.sin(), half * ANGLE.cos());
        let drawn = |set: &str, sign: f64| {
            format!(
                "{{ set = \"{set}\", x = 0, y = {{ rate = {:e} }}, z = {{ rate = {:e} }} }}",
                -sign * up,
                sign * along
            )
        };
        let held: String = ["left", "right"]
            .iter()
            .flat_map(|body| {
                ["bottom", "top", "back", "front"]
                    .map(|side| format!(", {{ set = \"{body}.{side}\", x = 0 }}"))
            })
            .collect();
        (
            drawn("left.left", -1.0) + ", " + &drawn("right.right", 1.0) + &held,
            "rake = [0, 0, 1]\nslip = \"free\"\n",
        )
    } else {
        let drawn = |set: &str, rate: f64| format!("{{ set = \"{set}\", z = {{ rate = {rate:e} }} }}");
        (drawn("left.left", -half) + ", " + &drawn("right.right", half), "")
    };
    format!(
        "schema = 1\ntitle = \"steady slip\"\nkinematics = \"{}\"\n{}{}{}{}\
         [faults.main]\nminus = \"left.right\"\nplus = \"right.left\"\n{vector}normal = {NORMAL:?}\nrate = {RATE:e}\n\
         law = {{ kind = \"rate-and-state\", evolution = \"ageing\", mu0 = {mu0:?}, a = {a:?}, b = {b:?}, l = {l:e}, v_ref = {v0:e}, v_initial = {RATE:e} }}\n\
         [[stages]]\nname = \"steady\"\nduration = {DURATION:?}\nconditions = [{conditions}]\n\
         [time]\nstepper = \"fault-ode\"\nlog_rate_tolerance = 1e-9\n\
         [output]\nstations.main = [{}]\n",
        if space { "3d" } else { "antiplane" },
        rock("left", MODULI[0]),
        rock("right", MODULI[1]),
        block("left", -1.0),
        block("right", 0.0),
        if space { "[0, 1, 0.5]" } else { "1" },
    )
}

/// See the module.
pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    plane(ledger)?;
    space(ledger)
}

fn plane(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = Written::of(&scene(false))?;
    let (slip, shear) = (RATE * DURATION, strength());
    let wanted: [Wanted<'_>; 18] = [
        ("stations/main_", "t", DURATION),
        ("stations/main_", "slip", slip),
        ("stations/main_", "slip_rate", RATE.log10()),
        ("stations/main_", "shear_stress", shear / 1e6),
        ("stations/main_", "normal_stress", NORMAL / 1e6),
        ("stations/main_", "state", theta()),
        ("largest_rate.csv", "time", DURATION),
        ("largest_rate.csv", "log10 slip_rate", RATE.log10()),
        ("largest_rate.csv", "mean shear_traction", shear),
        ("largest_rate.csv", "mean slip", slip),
        ("moment_rate.csv", "time", DURATION),
        ("moment_rate.csv", "moment_rate of main", MODULUS * RATE * AREA),
        ("moment_rate.csv", "moment of main", MODULUS * slip * AREA),
        ("fault_forces.csv", "shear_force of main", shear * AREA),
        ("fault_forces.csv", "normal_force of main", NORMAL * AREA),
        ("slip_profiles.csv", "each point", slip),
        ("rate_profiles.csv", "each point", RATE.log10()),
        ("state_profiles.csv", "each point", theta()),
    ];
    all(ledger, (&done.files, &done.cost), "out of the plane", &wanted)
}

fn space(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = Written::of(&scene(true))?;
    let (way, shear) = (RATE * DURATION, strength());
    let (along, across) = (ANGLE.cos(), ANGLE.sin());
    let soft = 1.0 / MODULI[0] + 1.0 / MODULI[1];
    // Direction 2 is the rake, z; direction 3 is n x rake, -y.
    let slip = [way * along - shear * (along - 1.0) * soft, (way - shear * soft) * across];
    let size = slip[0].hypot(slip[1]);
    let wanted: [Wanted<'_>; 19] = [
        ("stations/main_", "slip_2", slip[0]),
        ("stations/main_", "slip_3", slip[1]),
        ("stations/main_", "slip_rate_2", (RATE * along).log10()),
        ("stations/main_", "slip_rate_3", (RATE * across).log10()),
        ("stations/main_", "shear_stress_2", shear * along / 1e6),
        ("stations/main_", "shear_stress_3", shear * across / 1e6),
        ("stations/main_", "normal_stress", NORMAL / 1e6),
        ("stations/main_", "state", theta()),
        ("moment_rate.csv", "moment_rate of main", MODULUS * RATE * AREA),
        ("fault_forces.csv", "shear_force of main", shear * along * AREA),
        ("fields/main_*.vtu", "slip", size),
        ("fields/main_*.vtu", "slip_vector", slip[0]),
        ("fields/main_*.vtu", "slip_rate_vector", RATE * along),
        ("fields/main_*.vtu", "shear_traction", shear),
        ("fields/main_*.vtu", "shear_traction_vector", shear * along),
        ("fields/main_*.vtu", "normal_traction", NORMAL),
        ("fields/main_*.vtu", "log10_slip_rate", RATE.log10()),
        ("fields/main_*.vtu", "log10_theta", theta()),
        ("fields/main_*.vtu", "state_1", (LAW[3] / RATE).ln()),
    ];
    all(ledger, (&done.files, &done.cost), "in space", &wanted)
}

/// Claims about numbers of a run at its end. Of vectors the last component, along z, is taken.
fn all(
    ledger: &mut Ledger,
    run: (&Folder, &Cost),
    space: &str,
    wanted: &[Wanted<'_>],
) -> Result<(), CaseError> {
    let of_files = OfFiles {
        title: &format!("a fault that slides steadily {space}"),
        bound: 5e-7,
        source: "friction of the law at the rate of the load; the blocks bend under it, and slip lags by what they bend since the start",
        because: "the error of ln V in a step is 1e-9, and the table of the largest rate has seven digits",
        slack: "most files have ten digits",
        covers: &[Capability::Outputs, Capability::FaultCycles],
    };
    of_files.claim(ledger, run, wanted)
}
