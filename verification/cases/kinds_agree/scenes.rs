//! Scenes of the same fault.

use std::fmt::Write as _;

/// Shear modulus \[Pa\] and density \[kg/m³\]; Poisson's ratio is 0.25.
pub const MODULUS: f64 = 30e9;
const DENSITY: f64 = 2700.0;
/// Thickness of both layers together, and width \[m\].
pub const HEIGHT: f64 = 1000.0;
pub const AREA: f64 = 2.0;
/// Normal and shear traction at the start \[Pa\].
pub const NORMAL: f64 = 6e6;
pub const SHEAR: f64 = 3.9e6;
/// μ0, a and V_0 of the law \[m/s\].
pub const LAW: [f64; 3] = [0.6, 0.01, 1e-3];
/// G/(2 c_s) \[Pa s/m\]: c_s is 10/3 km/s.
pub const DAMPING: f64 = 4.5e6;
/// Duration \[s\], and steps of bodies with interfaces.
pub const DURATION: f64 = 1.5e-3;
pub const STEPS: usize = 30;
/// Error of ln V in a step.
pub const TOLERANCE: f64 = 1e-8;

fn law() -> String {
    let [mu0, a, v0] = LAW;
    format!("{{ kind = \"rate\", form = \"regularised\", mu0 = {mu0:?}, a = {a:?}, v_ref = {v0:?} }}")
}

/// Two layers with this number of rows of cells each, and what bodies have beside.
fn layers(rows: usize, beside: &str) -> String {
    let mut text = format!(
        "schema = 1\ntitle = \"one fault\"\nkinematics = \"plane-strain\"\n\
         [materials.rock]\nyoung = {:?}\npoisson = 0.25\ndensity = {DENSITY:?}\n",
        2.5 * MODULUS
    );
    for (name, from, to) in [("lower", -0.5 * HEIGHT, 0.0), ("upper", 0.0, 0.5 * HEIGHT)] {
        // Writing into a string does not fail.
        let _ = write!(
            text,
            "[bodies.{name}]\nmaterial = \"rock\"\n{beside}\
             mesh.block = {{ min = [0, {from:?}], max = [{AREA:?}, {to:?}], divisions = [2, {rows}], element = \"quad4\" }}\n"
        );
    }
    text
}

/// The stage: nothing moves along y, and the far sides do not move.
fn stage(steps: &str) -> String {
    let held: String = ["lower.left", "lower.right", "upper.left", "upper.right"]
        .iter()
        .map(|set| format!("{{ set = \"{set}\", y = 0 }}, "))
        .collect();
    format!(
        "[[stages]]\nname = \"slide\"\nduration = {DURATION:?}\n{steps}conditions = [{held}\
         {{ set = \"lower.bottom\", x = 0, y = 0 }}, {{ set = \"upper.top\", x = 0, y = 0 }}]\n"
    )
}

/// The fault, at rest in all but its slip rate.
fn fault(rate: f64, beside: &str) -> String {
    format!(
        "[faults.main]\nminus = \"lower.top\"\nplus = \"upper.bottom\"\nnormal = {NORMAL:?}\nrate = {rate:?}\nlaw = {}\n{beside}\n",
        law()
    )
}

const TIP: &str = "points.tip = { body = \"upper\", at = [1, 250] }\n";

/// The fault through cycles.
pub fn cycles(rate: f64) -> String {
    format!(
        "{}{}{}[time]\nstepper = \"fault-ode\"\nlog_rate_tolerance = {TOLERANCE:e}\n[output]\nstations.main = [1]\n{TIP}",
        layers(1, ""),
        fault(rate, "damping = \"radiation\""),
        stage("")
    )
}

/// The fault between bodies with mass.
pub fn mass(rate: f64) -> String {
    format!(
        "{}{}{}[time]\nstepper = \"explicit\"\n[output]\nstations.main = [1]\nsampling = {:?}\n",
        layers(1000, ""),
        fault(rate, &format!("shear = {SHEAR:?}")),
        stage(""),
        DURATION / 30.0
    )
}

/// The interface, of bodies at rest or with inertia.
pub fn interface(inertia: bool) -> String {
    // A fault slides towards -x under this stress: its tangent is that of the normal from minus to plus.
    let stress = format!("initial_stress = [0, {:?}, {:?}]\n", -NORMAL, -SHEAR);
    let radiates = if inertia { "" } else { "damping = \"radiation\"\n" };
    format!(
        "{}[interfaces.main]\nslave = \"upper.bottom\"\nmaster = \"lower.top\"\nmeasure = \"node-to-point\"\nsliding = \"small\"\n\
         initial_stress = true\nenforcement = {{ kind = \"penalty\", normal = 2e13, tangential = 2e15 }}\n{radiates}law = {}\n\
         {}[time]\nstepper = \"implicit\"\n{}[output]\nprobes.main = 1\n{TIP}",
        layers(1, &stress),
        law(),
        stage(&format!("steps = {STEPS}\n")),
        if inertia { "inertia = true\n" } else { "" }
    )
}

/// The slider.
pub fn block(rate: f64) -> String {
    format!(
        "schema = 1\ntitle = \"one block\"\nkinematics = \"spring-slider\"\n[load]\nrate = \"0 m/s\"\n\
         [sliders.main]\nnormal = {NORMAL:?}\nstiffness = {:?}\ndamping = {DAMPING:?}\nlaw = {}\nstart = {rate:?}\n\
         [time]\nend = {DURATION:?}\ntolerance = {TOLERANCE:e}\n",
        MODULUS / HEIGHT,
        law()
    )
}
