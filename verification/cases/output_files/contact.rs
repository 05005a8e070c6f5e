//! All numbers in the files of two blocks that slide past each other steadily, in the plane and in space.
//!
//! Nothing moves along y, so that an initial stress alone presses the blocks. Slip is uniform, and a spring or a motion draws the
//! upper block, which is the slave: everything has a closed form once the start is forgotten.

use super::{ExpectedNumber, FileClaims};
use crate::cases::run_files::{self, Folder};
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_vary::SceneText;
use serde_json::Value;

/// Width of the blocks along x, and along z in space \[m\].
pub(super) const WIDTHS: [f64; 2] = [0.4, 0.25];
/// Heights of the upper block, the slave, and of the lower one \[m\].
pub(super) const HEIGHTS: [f64; 2] = [0.3, 0.5];
/// Their shear moduli \[Pa\], with a Poisson's ratio of 0.25.
pub(super) const MODULI: [f64; 2] = [8e9, 20e9];
/// Normal traction \[Pa\].
pub(super) const NORMAL: f64 = 5e6;
/// Tangential penalty \[Pa/m\].
pub(super) const PENALTY: f64 = 2e13;
/// μ0, a, and the slip rate V_0 of the law \[m/s\].
pub(super) const LAW: [f64; 3] = [0.6, 0.01, 1e-6];
/// Stiffness of the spring \[N/m per metre of thickness\].
const SPRING: f64 = 4e9;
/// Rates along x, and along z in space \[m/s\].
pub(super) const RATES: [f64; 2] = [2e-6, -1.5e-6];
/// Duration: slip of the spring and the blocks by 8 um forgets the start by a factor of e, and 1.5 mm follow \[s\].
pub(super) const DURATION: f64 = 1000.0;

/// Density of the blocks with inertia \[kg/m³\], and duration of their run \[s\].
const DENSITY: f64 = 2700.0;
const SHORT: f64 = 10.0;

/// Friction under steady slip, `f_n a asinh(V/(2 V_0) exp(μ0/a))` \[Pa\].
fn strength(rate: f64) -> f64 {
    let [mu0, a, v0] = LAW;
    NORMAL * a * (0.5 * rate / v0 * (mu0 / a).exp()).asinh()
}

/// A position as text.
fn position(space: bool, [x, y, z]: [f64; 3]) -> String {
    if space { format!("[{x:?}, {y:?}, {z:?}]") } else { format!("[{x:?}, {y:?}]") }
}

/// A block between two heights.
fn block(space: bool, name: &str, [from, to]: [f64; 2]) -> String {
    let [w, d] = WIDTHS;
    let (min, max) = (position(space, [0.0, from, 0.0]), position(space, [w, to, d]));
    let (divisions, element) = if space { ("[2, 1, 1]", "hex8") } else { ("[2, 1]", "quad4") };
    let stress = if space { "[0, -5e6, 0, 0, 0, 0]" } else { "[0, -5e6, 0]" };
    format!(
        "[bodies.{name}]\nmaterial = \"{name}\"\ninitial_stress = {stress}\n\
         mesh.block = {{ min = {min}, max = {max}, divisions = {divisions}, element = \"{element}\" }}\n\
         [materials.{name}]\npoisson = 0.25\nyoung = {:?}\n",
        2.5 * MODULI[usize::from(name == "lower")]
    )
}

pub(super) fn scene(space: bool, [x, z]: [f64; 2]) -> String {
    let [w, d] = WIDTHS;
    let [upper, lower] = HEIGHTS;
    let [mu0, a, v0] = LAW;
    let held = |set: &str| format!("{{ set = \"{set}\", y = 0 }}, ");
    let ends = ["upper.left", "upper.right", "upper.top", "lower.left", "lower.right"];
    let faces = ["upper.back", "upper.front", "lower.back", "lower.front"];
    let sides: String = ends.iter().chain(faces.iter().filter(|_| space)).map(|set| held(set)).collect();
    let (drawn, below) = if space {
        (format!("x = {{ rate = {x:e} }}, z = {{ rate = {z:e} }}"), "x = 0, y = 0, z = 0")
    } else {
        (format!("x = {{ spring = {SPRING:?}, rate = {x:e} }}"), "x = 0, y = 0")
    };
    format!(
        "schema = 1\ntitle = \"steady sliding\"\nkinematics = \"{}\"\n{}{}\
         [interfaces.joint]\nslave = \"upper.bottom\"\nmaster = \"lower.top\"\nmeasure = \"node-to-point\"\nsliding = \"small\"\ninitial_stress = true\n\
         enforcement = {{ kind = \"penalty\", normal = {PENALTY:e}, tangential = {PENALTY:e} }}\n\
         law = {{ kind = \"rate\", form = \"regularised\", mu0 = {mu0:?}, a = {a:?}, v_ref = {v0:e} }}\n\
         [[stages]]\nname = \"slide\"\nduration = {DURATION:?}\n\
         conditions = [{sides}{{ set = \"upper.top\", {drawn} }}, {{ set = \"lower.bottom\", {below} }}]\n\
         [time]\nstepper = \"implicit\"\n\
         [output]\nprobes.joint = 2\nprofiles = 1\nfields = 1\n\
         points.middle = {{ body = \"upper\", at = {} }}\nforces.top = {{ set = \"upper.top\" }}\n",
        if space { "3d" } else { "plane-strain" },
        block(space, "upper", [lower, lower + upper]),
        block(space, "lower", [0.0, lower]),
        position(space, [0.5 * w, lower + 0.5 * upper, 0.5 * d]),
    )
}

/// Magnitudes at the end.
pub(super) struct Steady {
    /// Friction \[Pa\].
    pub shear: f64,
    /// Displacement of the top over the path of the drawn end, beyond what the blocks bend \[m\].
    top: f64,
    /// Relative displacement of the blocks \[m\].
    relative: f64,
    /// Slip \[m\].
    pub slip: f64,
    /// Displacement of the middle of the upper block \[m\].
    middle: f64,
}

impl Steady {
    /// State after a way of the drawn end \[m\] at this rate \[m/s\]; `soft` is the compliance of a spring per traction \[m/Pa\].
    pub(super) fn new(way: f64, rate: f64, soft: f64) -> Self {
        let shear = strength(rate);
        let bent = [0, 1].map(|k| shear * HEIGHTS[k] / MODULI[k]);
        let top = way - shear * soft;
        let relative = top - bent[0] - bent[1];
        Self { shear, top, relative, slip: relative - shear / PENALTY, middle: top - 0.5 * bent[0] }
    }
}

/// See the module.
pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    plane(ledger)?;
    space(ledger)?;
    inertial(ledger)?;
    free(ledger)
}

/// The blocks with inertia, which slide steadily from the start: their initial stress and velocity are those of steady sliding.
fn inertial(ledger: &mut Ledger) -> Result<(), CaseError> {
    let ([w, _], [height, _], [rate, _]) = (WIDTHS, HEIGHTS, RATES);
    let shear = strength(rate);
    let stress = format!("[0, {:?}, {shear:?}]", -NORMAL);
    let text = SceneText::new(&scene(false, RATES))
        .with("bodies.upper.initial_stress", &stress)
        .with("bodies.lower.initial_stress", &stress)
        .add("bodies.upper.velocity", format!("[{rate:e}, 0]"))
        .add("materials.upper.density", format!("{DENSITY:?}"))
        .add("materials.lower.density", format!("{DENSITY:?}"))
        .with("stages[0].duration", format!("{SHORT:?}"))
        .with("stages[0].conditions[5].x", format!("{{ rate = {rate:e} }}"))
        .add("time.inertia", "true")
        .add("events", "{ above = 1e-3 }")
        .text()?;
    let (files, cost) = run_files::bodies(&text)?;
    let kinetic = 0.5 * DENSITY * w * height * rate * rate;
    let contact = 0.5 * (shear * shear + NORMAL * NORMAL) / PENALTY * w;
    let work = shear * rate * w * SHORT;
    let wanted: [ExpectedNumber<'_>; 8] = [
        ("energy.csv", "time", SHORT),
        ("energy.csv", "kinetic", kinetic),
        ("energy.csv", "contact", contact),
        ("energy.csv", "start", contact + kinetic),
        ("energy.csv", "friction", work),
        ("energy.csv", "motions", work),
        ("largest_rates.csv", "time", SHORT),
        ("largest_rates.csv", "largest slip_rate of joint", rate),
    ];
    all(ledger, (&files, &cost), "with inertia", &wanted)?;
    let idle = [
        "elastic",
        "springs",
        "plastic",
        "viscous",
        "numerical",
        "absorbed",
        "handover",
        "unbalanced",
        "loads",
        "released",
    ];
    let parts = idle
        .map(|part| super::last(&files, "energy.csv", part))
        .into_iter()
        .collect::<Result<Vec<_>, _>>()?;
    let missing = super::last(&files, "energy.csv", "missing")?;
    counted(ledger, (&files, &cost))?;
    let sum = parts.iter().chain([&missing]).map(|part| part.abs()).sum::<f64>();
    ledger
        .claim("two blocks that slide steadily with inertia, at the end: parts of energy.csv that nothing feeds, over the work of friction")
        .value(sum / work)
        .at_most(1e-10)
        .evidence(Evidence::Exact, "stresses stay those of the start, of which elastic energy is the change, and nothing else acts")
        .because("Newton's method leaves 1e-11 of the forces, times the way of the block")
        .why_not_tighter("what the last iteration leaves is chance")
        .covers(&[Capability::Outputs, Capability::Inertia])
        .cost(&cost)
        .record();
    Ok(())
}

/// Stages and steps of the last rows of tables that every step has a row in.
fn counted(ledger: &mut Ledger, (files, cost): (&Folder, &Cost)) -> Result<(), CaseError> {
    let mut found = Vec::new();
    for table in ["energy.csv", "largest_rates.csv"] {
        found.extend([super::last(files, table, "stage")?, super::last(files, table, "step")?]);
    }
    let taken = steps(files)? as f64;
    ledger
        .claim("two blocks that slide steadily with inertia, at the end: stage and step of energy.csv and largest_rates.csv")
        .values(&found)
        .equals_each(&[0.0, taken, 0.0, taken])
        .absolute(1e-9)
        .evidence(Evidence::Exact, "the only stage, number 0, and the steps of report.json")
        .because("whole numbers")
        .why_not_tighter("whole numbers are exact")
        .covers(&[Capability::Outputs])
        .cost(cost)
        .record();
    Ok(())
}

fn plane(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (files, cost) = run_files::bodies(&scene(false, RATES))?;
    let ([w, _], [rate, _]) = (WIDTHS, RATES);
    let way = rate * DURATION;
    let s = Steady::new(way, rate, w / SPRING);
    // The normal of the master points up, and the first tangent along -x.
    let wanted: [ExpectedNumber<'_>; 22] = [
        ("probes/joint.csv", "relative_displacement", -s.relative),
        ("probes/joint.csv", "slip", -s.slip),
        ("probes/joint.csv", "slip_rate", -rate),
        ("probes/joint.csv", "friction", s.shear / NORMAL),
        ("probes/joint.csv", "normal_traction", NORMAL),
        ("probes/joint.csv", "shear_traction", -s.shear),
        ("profiles/joint_*.csv", "x", w),
        ("profiles/joint_*.csv", "y", HEIGHTS[1]),
        ("profiles/joint_*.csv", "area", 0.25 * w),
        ("profiles/joint_*.csv", "normal_traction", NORMAL),
        ("profiles/joint_*.csv", "shear_traction", -s.shear),
        ("profiles/joint_*.csv", "mean_normal_traction", NORMAL),
        ("profiles/joint_*.csv", "mean_shear_traction", -s.shear),
        ("profiles/joint_*.csv", "relative_displacement", -s.relative),
        ("profiles/joint_*.csv", "slip", -s.slip),
        ("profiles/joint_*.csv", "slip_rate", -rate),
        ("profiles/joint_*.csv", "friction", s.shear / NORMAL),
        ("profiles/joint_*.csv", "status", 2.0),
        ("points/middle.csv", "displacement_x", s.middle),
        ("points/middle.csv", "stress_xy", s.shear),
        ("points/middle.csv", "stress_yy", -NORMAL),
        ("forces/top.csv", "force_x", s.shear * w),
    ];
    all(ledger, (&files, &cost), "in the plane", &wanted)?;
    let spring: [ExpectedNumber<'_>; 4] = [
        ("springs/upper_top_x.csv", "load_point", way),
        ("springs/upper_top_x.csv", "displacement", s.top),
        ("springs/upper_top_x.csv", "force", s.shear * w),
        ("springs/upper_top_x.csv", "friction", s.shear / NORMAL),
    ];
    all(ledger, (&files, &cost), "in the plane", &spring)?;
    let fields: [ExpectedNumber<'_>; 10] = [
        ("fields/joint_*.vtu", "mean_normal_traction", NORMAL),
        ("fields/joint_*.vtu", "mean_shear_traction", -s.shear),
        ("fields/joint_*.vtu", "slip", -s.slip),
        ("fields/joint_*.vtu", "relative_displacement", -s.relative),
        ("fields/joint_*.vtu", "slip_rate", -rate),
        ("fields/joint_*.vtu", "normal_traction", NORMAL),
        ("fields/joint_*.vtu", "shear_traction", -s.shear),
        ("fields/joint_*.vtu", "friction", s.shear / NORMAL),
        ("fields/joint_*.vtu", "area", 0.25 * w),
        ("fields/joint_*.vtu", "status", 2.0),
    ];
    all(ledger, (&files, &cost), "in the plane", &fields)?;
    clocks(ledger, (&files, &cost))?;
    report(ledger, (&files, &cost), &s, rate)?;
    head(ledger, (&files, &cost))?;
    backwards(ledger, &files, &s)
}

/// Times, stages and steps of the last rows, and numbers of profiles and fields that are whole or zero.
fn clocks(ledger: &mut Ledger, (files, cost): (&Folder, &Cost)) -> Result<(), CaseError> {
    let (mut found, mut expected) = (Vec::new(), Vec::new());
    let taken = steps(files)? as f64;
    for table in ["probes/joint.csv", "points/middle.csv", "forces/top.csv", "springs/upper_top_x.csv"] {
        for (column, value) in [("time", DURATION), ("stage", 0.0), ("step", taken)] {
            found.push(super::last(files, table, column)?);
            expected.push(value);
        }
    }
    let profile = [("time", DURATION), ("node", 2.0), ("z", 0.0), ("gap", 0.0), ("paired", 1.0)];
    let fields = [("gap", 0.0), ("paired", 1.0)];
    for (column, value) in profile {
        found.push(super::last(files, "profiles/joint_*.csv", column)?);
        expected.push(value);
    }
    for (column, value) in fields {
        found.push(super::last(files, "fields/joint_*.vtu", column)?);
        expected.push(value);
    }
    ledger
        .claim("two blocks that slide steadily in the plane, at the end: time, stage and step of tables; node, gap and pairing of profiles and fields")
        .values(&found)
        .equals_each(&expected)
        .absolute(1e-9)
        .evidence(Evidence::Exact, "the duration of the only stage, number 0, and the steps of report.json; the last of three paired nodes of a closed joint")
        .because("gaps are rounding of positions, far below a nanometre")
        .why_not_tighter("all others are exact")
        .covers(&[Capability::Outputs])
        .cost(cost)
        .record();
    Ok(())
}

/// The position in the head of a column of a probe.
fn head(ledger: &mut Ledger, (files, cost): (&Folder, &Cost)) -> Result<(), CaseError> {
    let table = files.table("probes/joint.csv")?;
    let place = table.head().last().and_then(|name| name.split_once(" at x = ")).ok_or("no place")?.1;
    let (value, unit) = place.split_once(' ').ok_or("no unit")?;
    ledger
        .claim("position of the last of two probes of the interface of two blocks, by the head of its column")
        .unit("m")
        .value(value.parse::<f64>()? * if unit == "mm" { 1e-3 } else { 1.0 })
        .equals(WIDTHS[0])
        .absolute(1e-9)
        .evidence(Evidence::Exact, "the first and the last of equally spaced probes lie at the ends")
        .because("positions in heads have four digits, and this one has one")
        .why_not_tighter("there is nothing but rounding")
        .covers(&[Capability::Outputs])
        .cost(cost)
        .record();
    Ok(())
}

/// The blocks drawn the other way, as they were in these files.
fn backwards(ledger: &mut Ledger, forwards: &Folder, s: &Steady) -> Result<(), CaseError> {
    let taken = steps(forwards)?;
    let (files, cost) = run_files::bodies(&scene(false, RATES.map(|rate| -rate)))?;
    ledger
        .claim("two blocks that slide steadily in the plane: steps taken one way, less those the other way")
        .count(taken.abs_diff(steps(&files)?), 0)
        .evidence(Evidence::Exact, "the scene and its mirror image")
        .because("estimates of errors do not depend on the direction of slip")
        .covers(&[Capability::Implicit, Capability::VelocityFriction])
        .cost(&cost)
        .record();
    let wanted: [ExpectedNumber<'_>; 4] = [
        ("probes/joint.csv", "slip", s.slip),
        ("probes/joint.csv", "friction", s.shear / NORMAL),
        ("springs/upper_top_x.csv", "force", -s.shear * WIDTHS[0]),
        ("springs/upper_top_x.csv", "friction", s.shear / NORMAL),
    ];
    all(ledger, (&files, &cost), "in the plane the other way", &wanted)
}

/// Steps of a run.
fn steps(files: &Folder) -> Result<u64, CaseError> {
    let report: Value = serde_json::from_str(&files.text("report.json")?)?;
    report["counts"]["steps"].as_u64().ok_or_else(|| "no number of steps".into())
}

fn space(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (files, cost) = run_files::bodies(&scene(true, RATES))?;
    let ([w, d], [x, z]) = (WIDTHS, RATES);
    let rate = x.hypot(z);
    let along = [x / rate, z / rate];
    let s = Steady::new(rate * DURATION, rate, 0.0);
    let mises = NORMAL.hypot(3.0_f64.sqrt() * s.shear);
    let below = s.shear * HEIGHTS[1] / MODULI[1];
    // The last of three components is that along z, and the last node is one of the top.
    let wanted: [ExpectedNumber<'_>; 31] = [
        ("fields/joint_*.vtu", "displacement", (below + s.relative) * along[1]),
        ("fields/master_joint_*.vtu", "displacement", below * along[1]),
        ("profiles/joint_*.csv", "z", d),
        ("profiles/joint_*.csv", "slip_x", s.slip * along[0]),
        ("profiles/joint_*.csv", "slip_z", s.slip * along[1]),
        ("profiles/joint_*.csv", "shear_traction_x", s.shear * along[0]),
        ("profiles/joint_*.csv", "shear_traction_z", s.shear * along[1]),
        ("fields/joint_*.vtu", "slip_vector", s.slip * along[1]),
        ("fields/joint_*.vtu", "shear_traction_vector", s.shear * along[1]),
        ("fields/bodies_*.vtu", "displacement", z * DURATION),
        ("fields/joint_*.vtu", "mean_shear_traction", s.shear),
        ("fields/joint_*.vtu", "mean_normal_traction", NORMAL),
        ("points/middle.csv", "mises", mises),
        ("fields/bodies_*.vtu", "mises", mises),
        ("probes/joint.csv", "relative_displacement", s.relative),
        ("probes/joint.csv", "slip", s.slip),
        ("probes/joint.csv", "slip_x", s.slip * along[0]),
        ("probes/joint.csv", "slip_z", s.slip * along[1]),
        ("probes/joint.csv", "slip_rate", rate),
        ("probes/joint.csv", "friction", s.shear / NORMAL),
        ("probes/joint.csv", "normal_traction", NORMAL),
        ("probes/joint.csv", "shear_traction", s.shear),
        ("probes/joint.csv", "shear_traction_x", s.shear * along[0]),
        ("probes/joint.csv", "shear_traction_z", s.shear * along[1]),
        ("profiles/joint_*.csv", "area", 0.125 * w * d),
        ("points/middle.csv", "displacement_x", s.middle * along[0]),
        ("points/middle.csv", "displacement_z", s.middle * along[1]),
        ("points/middle.csv", "stress_xy", s.shear * along[0]),
        ("points/middle.csv", "stress_yz", s.shear * along[1]),
        ("forces/top.csv", "force_x", s.shear * along[0] * w * d),
        ("forces/top.csv", "force_z", s.shear * along[1] * w * d),
    ];
    all(ledger, (&files, &cost), "in space", &wanted)
}

/// Blocks with free sides, whose tractions vary: their mean in the report carries the force on the top.
fn free(ledger: &mut Ledger) -> Result<(), CaseError> {
    let text = SceneText::new(&scene(false, RATES))
        .with("interfaces.joint.law", "{ kind = \"coulomb\", mu = 0.6 }")
        .with(
            "stages[0].conditions",
            "[{ set = \"upper.top\", x = { to = 2e-6 }, y = 0 }, { set = \"lower.bottom\", x = 0, y = 0 }]",
        )
        .text()?;
    let (files, cost) = run_files::bodies(&text)?;
    let report: Value = serde_json::from_str(&files.text("report.json")?)?;
    let mean = |name: &str| report["results"][0][name].as_f64().ok_or_else(|| format!("no {name}"));
    let [width, _] = WIDTHS;
    let force = |name: &str| super::last(&files, "forces/top.csv", name);
    let shears = files.names("profiles")?.pop().ok_or("no profile")?;
    let shears = files.table(&format!("profiles/{shears}"))?.column("shear_traction")?;
    if shears.windows(2).all(|w| (w[0] - w[1]).abs() < 1e-3 * w[0].abs()) {
        return Err("the tractions do not vary".into());
    }
    ledger
        .claim(
            "two blocks with free sides, sheared: mean tractions in report.json against the force on the top",
        )
        .unit("Pa")
        .values(&[mean("mean_shear_traction")?, mean("mean_normal_traction")?])
        .equals_each(&[-force("force_x")? / width, -force("force_y")? / width])
        .relative(1e-8)
        .evidence(Evidence::Exact, "balance of forces of the upper block")
        .because("Newton's method leaves 1e-11 of the forces, and files have ten digits")
        .why_not_tighter("the last of ten digits may be off by any part of a half")
        .covers(&[Capability::Outputs, Capability::Balance])
        .cost(&cost)
        .record();
    Ok(())
}

/// Claims about the report of the run in the plane.
fn report(
    ledger: &mut Ledger,
    (files, cost): (&Folder, &Cost),
    s: &Steady,
    rate: f64,
) -> Result<(), CaseError> {
    let report: Value = serde_json::from_str(&files.text("report.json")?)?;
    let result = &report["results"][0];
    let counts: Vec<f64> = [0, 1, 2].iter().filter_map(|k| result["status"][k].as_f64()).collect();
    ledger
        .claim("two blocks that slide steadily in the plane, at the end: points that are open, stick and slip in report.json")
        .values(&counts)
        .equals_each(&[0.0, 0.0, 3.0])
        .absolute(0.5)
        .evidence(Evidence::Exact, "all three points slide")
        .because("counts are whole numbers")
        .why_not_tighter("half a point")
        .covers(&[Capability::Outputs])
        .cost(cost)
        .record();
    for (name, value) in [
        ("mean_normal_traction", NORMAL),
        ("mid_normal_traction", NORMAL),
        ("mean_shear_traction", -s.shear),
        ("slip", -s.slip),
        ("slip_rate", -rate),
        ("friction", s.shear / NORMAL),
    ] {
        let entry = &result[name];
        let found = entry.as_f64().or_else(|| entry[1].as_f64()).ok_or_else(|| format!("no {name}"))?;
        ledger
            .claim(format!("two blocks that slide steadily in the plane, at the end: {name} in report.json"))
            .value(found)
            .equals(value)
            .relative(1e-8)
            .evidence(Evidence::Exact, "the same at all points, whatever their areas")
            .because("Newton's method leaves 1e-11 of the forces")
            .why_not_tighter("rounding of sums")
            .covers(&[Capability::Outputs])
            .cost(cost)
            .record();
    }
    Ok(())
}

/// Claims about numbers of a run at its end.
fn all(
    ledger: &mut Ledger,
    run: (&Folder, &Cost),
    space: &str,
    wanted: &[ExpectedNumber<'_>],
) -> Result<(), CaseError> {
    let claims = FileClaims {
        title: &format!("two blocks that slide steadily {space}"),
        bound: 1e-8,
        source: "friction of the law at the rate of the load; blocks, penalty and spring bend under it",
        because: "Newton's method leaves 1e-11 of the forces, and files have ten digits",
        slack: "the last of ten digits may be off by any part of a half",
        covers: &[Capability::Outputs, Capability::VelocityFriction],
    };
    claims.claim(ledger, run, wanted)
}
