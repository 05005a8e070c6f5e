//! Scenes of the same fault, in the plane and in space.

use std::fmt::Write as _;

/// Shear modulus \[Pa\] and density \[kg/m³\]; Poisson's ratio is 0.25.
pub const MODULUS: f64 = 30e9;
const DENSITY: f64 = 2700.0;
/// Thickness of both layers together, and area of the fault, which is 1 m wide across the plane \[m, m²\].
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

/// Idealisation of the layers.
#[derive(Clone, Copy)]
pub enum Idealisation {
    /// Plane strain.
    Plane,
    /// Three dimensions, one cell wide.
    Space,
}

impl Idealisation {
    /// Chooses between what is meant in the plane and in space.
    pub fn choose<T>(self, plane: T, space: T) -> T {
        match self {
            Self::Plane => plane,
            Self::Space => space,
        }
    }

    /// Coordinates in the plane as a list, in space with this one across it.
    fn list(self, plane: &str, across: &str) -> String {
        self.choose(format!("[{plane}]"), format!("[{plane}, {across}]"))
    }

    /// Station in the middle of the fault, and a point in the middle of the upper layer.
    fn outputs(self) -> [String; 2] {
        let station = format!("stations.main = [{}]\n", self.choose("1", "[1, 0, 0]"));
        let point = format!("points.tip = {{ body = \"upper\", at = {} }}\n", self.list("1, 250", "0.5"));
        [station, point]
    }
}

fn law() -> String {
    let [mu0, a, v0] = LAW;
    format!("{{ kind = \"rate\", form = \"regularised\", mu0 = {mu0:?}, a = {a:?}, v_ref = {v0:?} }}")
}

/// Two layers with this number of rows of cells each, and what bodies have beside.
fn layers(idealised: Idealisation, rows: usize, beside: &str) -> String {
    let mut text = format!(
        "schema = 1\ntitle = \"one fault\"\nkinematics = \"{}\"\n\
         [materials.rock]\nyoung = {:?}\npoisson = 0.25\ndensity = {DENSITY:?}\n",
        idealised.choose("plane-strain", "3d"),
        2.5 * MODULUS
    );
    for (name, from, to) in [("lower", -0.5 * HEIGHT, 0.0), ("upper", 0.0, 0.5 * HEIGHT)] {
        let min = idealised.list(&format!("0, {from:?}"), "0");
        let max = idealised.list(&format!("{AREA:?}, {to:?}"), "1");
        let (divisions, element) =
            (idealised.list(&format!("2, {rows}"), "1"), idealised.choose("quad4", "hex8"));
        // Writing into a string does not fail.
        let _ = write!(
            text,
            "[bodies.{name}]\nmaterial = \"rock\"\n{beside}\
             mesh.block = {{ min = {min}, max = {max}, divisions = {divisions}, element = \"{element}\" }}\n"
        );
    }
    text
}

/// The stage: the ends do not move along y, and the far sides do not move.
fn stage(idealised: Idealisation, steps: &str) -> String {
    let held: String = ["lower.left", "lower.right", "upper.left", "upper.right"]
        .iter()
        .map(|set| format!("{{ set = \"{set}\", y = 0 }}, "))
        .collect();
    let far = idealised.choose("x = 0, y = 0", "x = 0, y = 0, z = 0");
    format!(
        "[[stages]]\nname = \"slide\"\nduration = {DURATION:?}\n{steps}conditions = [{held}\
         {{ set = \"lower.bottom\", {far} }}, {{ set = \"upper.top\", {far} }}]\n"
    )
}

/// The fault, at rest in all but its slip rate.
fn fault(idealised: Idealisation, rate: f64, beside: &str) -> String {
    // Along the tangent in the plane. Slip of bodies with mass follows the traction in any direction.
    let rake = idealised.choose("", "rake = [-1, 0, 0]\nslip = \"free\"\n");
    format!(
        "[faults.main]\nminus = \"lower.top\"\nplus = \"upper.bottom\"\n{rake}normal = {NORMAL:?}\nrate = {rate:?}\nlaw = {}\n{beside}\n",
        law()
    )
}

/// The fault through cycles.
pub fn cycles(idealised: Idealisation, rate: f64) -> String {
    let [station, point] = idealised.outputs();
    format!(
        "{}{}{}[time]\nstepper = \"fault-ode\"\nlog_rate_tolerance = {TOLERANCE:e}\n[output]\n{station}{point}",
        layers(idealised, 1, ""),
        fault(idealised, rate, "damping = \"radiation\""),
        stage(idealised, "")
    )
}

/// The fault between bodies with mass.
pub fn mass(idealised: Idealisation, rate: f64) -> String {
    let [station, _] = idealised.outputs();
    format!(
        "{}{}{}[time]\nstepper = \"explicit\"\n[output]\n{station}sampling = {:?}\n",
        layers(idealised, 1000, ""),
        fault(idealised, rate, &format!("shear = {SHEAR:?}")),
        stage(idealised, ""),
        DURATION / 30.0
    )
}

/// The interface, of bodies at rest or with inertia.
pub fn interface(idealised: Idealisation, inertia: bool) -> String {
    // A fault slides towards -x under this stress: its tangent is that of the normal from minus to plus.
    let between = idealised.choose("", "0, ");
    let stress = idealised.list(&format!("0, {:?}, {between}{:?}", -NORMAL, -SHEAR), "0, 0");
    let stress = format!("initial_stress = {stress}\n");
    let [_, point] = idealised.outputs();
    let radiates = if inertia { "" } else { "damping = \"radiation\"\n" };
    format!(
        "{}[interfaces.main]\nslave = \"upper.bottom\"\nmaster = \"lower.top\"\nmeasure = \"node-to-point\"\nsliding = \"small\"\n\
         initial_stress = true\nenforcement = {{ kind = \"penalty\", normal = 2e13, tangential = 2e15 }}\n{radiates}law = {}\n\
         {}[time]\nstepper = \"implicit\"\n{}[output]\nprobes.main = 1\n{point}",
        layers(idealised, 1, &stress),
        law(),
        stage(idealised, &format!("steps = {STEPS}\n")),
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
