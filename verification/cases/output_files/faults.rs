//! All numbers in the files of faults that slide steadily between two blocks: out of the plane, and in space where slip turns
//! towards its load.
//!
//! Slip is uniform, and friction strengthens with velocity. In the plane nothing changes from the start on. In space the fault
//! starts along its rake and is drawn at 60 degrees from it. It forgets its direction by a factor of e while it slips by the strength over
//! the stiffness of the blocks, 0.4 mm, and slips by 10 mm. What it lags behind the load tells of the start.

use super::vtu::Fields;
use super::{ExpectedNumber, FileClaims};
use crate::cases::run_files::{Folder, WrittenRun};
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_vary::SceneText;

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
/// Both b of a law with two states, with the sum of the other.
const STATES: [f64; 2] = [0.0105, 0.0045];
/// Points in space.
const POINTS: usize = 6;
/// Duration of runs of which the start matters \[s\].
const SHORT: f64 = 1e-3;
/// Rate of the plates, and slip rate of the slow point \[m/s\].
const PLATES: f64 = 2e-5;
const SLOW: f64 = 4e-6;
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
            if space { ([", 0", ", 1"], "[1, 2, 1]", "hex8") } else { (["", ""], "[1, 2]", "quad4") };
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
    space(ledger)?;
    heated(ledger)?;
    cooled(ledger)?;
    two_states(ledger)?;
    deficit(ledger)?;
    moved(ledger)?;
    snapshots(ledger)
}

fn plane(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = WrittenRun::from_text(&scene(false))?;
    let (slip, shear) = (RATE * DURATION, strength());
    let wanted: [ExpectedNumber<'_>; 22] = [
        ("fault_forces.csv", "time", DURATION),
        ("slip_profiles.csv", "time", DURATION),
        ("rate_profiles.csv", "time", DURATION),
        ("state_profiles.csv", "time", DURATION),
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
    let text = SceneText::new(&scene(true))
        .add("output.points", r#"{ middle = { body = "right", at = [0.5, 1, 0.5] } }"#)
        .add("output.forces", r#"{ drawn = { set = "right.right" } }"#)
        .text()?;
    let done = WrittenRun::from_text(&text)?;
    let (way, shear) = (RATE * DURATION, strength());
    let (along, across) = (ANGLE.cos(), ANGLE.sin());
    let soft = 1.0 / MODULI[0] + 1.0 / MODULI[1];
    // Direction 2 is the rake, z; direction 3 is n x rake, -y.
    let slip = [way * along - shear * (along - 1.0) * soft, (way - shear * soft) * across];
    let size = slip[0].hypot(slip[1]);
    // Of bodies there are changes since the start; the other block has the softer half.
    let change = [shear * (along - 1.0), -shear * across];
    let middle = [0.5 * way * along, -0.5 * way * across];
    let moved = [0, 1].map(|k| middle[k] - 0.5 * change[k] / MODULI[1]);
    let wanted: [ExpectedNumber<'_>; 28] = [
        ("points/middle.csv", "time", DURATION),
        ("points/middle.csv", "displacement_y", moved[1]),
        ("points/middle.csv", "displacement_z", moved[0]),
        ("points/middle.csv", "stress_xy", change[1]),
        ("points/middle.csv", "stress_zx", change[0]),
        ("points/middle.csv", "mises", 3.0_f64.sqrt() * change[0].hypot(change[1])),
        ("forces/drawn.csv", "time", DURATION),
        ("forces/drawn.csv", "force_y", change[1] * AREA),
        ("forces/drawn.csv", "force_z", change[0] * AREA),
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

/// Thickness of the warm zone \[m\], diffusivities of heat and of fluid \[m²/s\], heat capacity \[J/(m³ K)\], and pressure per temperature
/// \[Pa/K\], so low that it does not change friction.
const HEAT: [f64; 5] = [0.01, 1e-6, 4e-6, 2.7e3, 1e-3];
/// Temperature at the start \[K\].
const COLD: f64 = 300.0;

/// Temperature \[K\] and pressure \[Pa\] of a fault after this time under constant friction and slip rate: heat of a Gaussian zone of standard
/// deviation w that diffuses with α has the density `q ((w² + 2 α t)^½ - w)/((2π)^½ α)` at its centre.
fn warmed(time: f64) -> [f64; 2] {
    let [thickness, heat, fluid, capacity, coefficient] = HEAT;
    let turn = std::f64::consts::TAU.sqrt();
    let (w, flux) = (thickness / turn, strength() * RATE);
    let density = |alpha: f64| flux * ((w * w + 2.0 * alpha * time).sqrt() - w) / (turn * alpha);
    let excess = (fluid * density(fluid) - heat * density(heat)) / (fluid - heat);
    [COLD + density(heat) / capacity, coefficient / capacity * excess]
}

/// The fault that warms its rock and the fluid in it.
fn heated(ledger: &mut Ledger) -> Result<(), CaseError> {
    let [thickness, heat, fluid, capacity, coefficient] = HEAT;
    let zone = format!(
        "{{ thickness = {thickness:?}, temperature = {COLD:?}, diffusivity = {heat:e}, capacity = {capacity:?}, \
         pressurisation = {{ coefficient = {coefficient:e}, diffusivity = {fluid:e} }} }}"
    );
    let done = WrittenRun::from_text(&SceneText::new(&scene(false)).add("faults.main.heat", zone).text()?)?;
    let late = super::last(&done.files, "temperature_profiles.csv", "time")?;
    let ([temperature, pressure], [then, pressed]) = (warmed(DURATION), warmed(late));
    let wanted: [ExpectedNumber<'_>; 5] = [
        ("stations/main_", "temperature", temperature),
        ("stations/main_", "pore_pressure", pressure / 1e6),
        ("pressure_profiles.csv", "time", late),
        ("temperature_profiles.csv", "each point", then),
        ("pressure_profiles.csv", "each point", pressed),
    ];
    let claims = FileClaims {
        title: "a fault that slides steadily and warms its zone",
        bound: 2e-6,
        source: "heat of a Gaussian zone under constant friction and slip rate, and the fluid that it expands (Rice 2006)",
        because: "the rule by which modes are summed has a relative error of 1e-6, and pressure is a difference of two such sums",
        slack: "its error changes sign with time",
        covers: &[Capability::Outputs, Capability::FrictionalHeat],
    };
    claims.claim(ledger, (&done.files, &done.cost), &wanted)
}

/// Time after which the load of a warm fault becomes slow, and factor by which \[s\].
const TURN: f64 = 100.0;
const SLOWER: f64 = 100.0;

/// The fault that warms its rock in an event, which ends after its load has become slow.
fn cooled(ledger: &mut Ledger) -> Result<(), CaseError> {
    let [thickness, heat, _, capacity, _] = HEAT;
    let zone = format!(
        "{{ thickness = {thickness:?}, temperature = {COLD:?}, diffusivity = {heat:e}, capacity = {capacity:?} }}"
    );
    let way = 0.5 * RATE * TURN;
    let drawn = |set: &str, sign: f64| {
        let [turn, end] = [sign * way, sign * way * (1.0 + SLOWER.recip())];
        format!(
            "{{ set = \"{set}\", z = {{ table = [[0, 0], [{TURN:?}, {turn:e}], [{:?}, {end:e}]] }} }}",
            2.0 * TURN
        )
    };
    let text = SceneText::new(&scene(false))
        .add("faults.main.heat", zone)
        .with(
            "stages[0].conditions",
            format!("[{}, {}]", drawn("left.left", -1.0), drawn("right.right", 1.0)),
        )
        .with("stages[0].duration", 2.0 * TURN)
        .add("events", format!("{{ above = {:e} }}", 0.5 * RATE))
        .text()?;
    let done = WrittenRun::from_text(&text)?;
    let [temperature, _] = warmed(TURN);
    let found = done.files.table("events.csv")?.only("largest_temperature")?;
    ledger
        .claim("a fault that slides steadily and warms its zone until its load becomes slow: largest_temperature in events.csv, above that at the start, over its value as the load turns")
        .value((found - COLD) / (temperature - COLD))
        .equals(1.0)
        .absolute(5e-3)
        .evidence(Evidence::Exact, "heat of a Gaussian zone under constant friction and slip rate")
        .because("the fault slides on for a second of a hundred, in which the temperature would grow by half a per cent")
        .covers(&[Capability::Outputs, Capability::FrictionalHeat, Capability::Events])
        .cost(&done.cost)
        .record();
    Ok(())
}

/// A law with two states, of which the slip law makes -b ln(V/V_0) in steady slip.
fn two_states(ledger: &mut Ledger) -> Result<(), CaseError> {
    let [a, _, mu0, v0, l] = LAW;
    let law = format!(
        "{{ kind = \"rate-and-state\", evolution = \"slip\", mu0 = {mu0:?}, a = {a:?}, b = {STATES:?}, l = [{l:e}, {l:e}], v_ref = {v0:e}, v_initial = {RATE:e} }}"
    );
    let done = WrittenRun::from_text(&SceneText::new(&scene(true)).with("faults.main.law", law).text()?)?;
    let names = done.files.names("fields")?;
    let name = names.iter().rfind(|name| name.starts_with("main_")).ok_or("no fields")?;
    let fields = Fields::read(&done.files.text(&format!("fields/{name}"))?)?;
    for (k, b) in STATES.iter().enumerate() {
        let found = &fields.array(&format!("state_{}", k + 1))?.values;
        ledger
            .claim(format!("a fault that slides steadily in space with two states: state {} at all points of its fields, at the end", k + 1))
            .values(found)
            .equals_each(&[-b * (RATE / v0).ln(); POINTS])
            .absolute(1e-8)
            .evidence(Evidence::Exact, "the slip law in steady slip, -b ln(V/V_0) for each state")
            .because("the error of ln V in a step is 1e-9, times b")
            .why_not_tighter("errors of steps decay with slip")
            .covers(&[Capability::Outputs, Capability::FaultCycles, Capability::SeveralStates])
            .cost(&done.cost)
            .record();
    }
    let plane = SceneText::new(&scene(false));
    let law = format!(
        "{{ kind = \"rate-and-state\", evolution = \"slip\", mu0 = {mu0:?}, a = {a:?}, b = {STATES:?}, l = [{l:e}, {l:e}], v_ref = {v0:e}, v_initial = {RATE:e} }}"
    );
    let done = WrittenRun::from_text(&plane.with("faults.main.law", law).text()?)?;
    let row = done.files.table("state_profiles.csv")?.numbers().pop().ok_or("no row")?;
    ledger
        .claim("a fault that slides steadily out of the plane with two states: its first state at all points of the profiles, at the end")
        .values(&row[1..])
        .equals_each(&[-STATES[0] * (RATE / v0).ln(); 3])
        .absolute(1e-7)
        .evidence(Evidence::Exact, "the slip law in steady slip, -b ln(V/V_0)")
        .because("profiles have seven digits")
        .why_not_tighter("the last digit may be off by a half")
        .covers(&[Capability::Outputs, Capability::FaultCycles, Capability::SeveralStates])
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Coupling to plates that move by `PLATES`, of a fault whose last point, of half the area of the others, is slower, and of a second
/// fault in other rock.
fn deficit(ledger: &mut Ledger) -> Result<(), CaseError> {
    let held: String = ["left.left", "right.right", "third.left", "fourth.right"]
        .map(|set| format!("{{ set = \"{set}\", z = 0 }}, "))
        .concat();
    let body = |from: f64, rock: &str| {
        format!(
            "{{ material = \"{rock}\", mesh.block = {{ min = [{from:?}, 10.0], max = [{:?}, 13.0], divisions = [1, 1], element = \"quad4\" }} }}",
            from + 1.0
        )
    };
    let creep = format!("{{ rate = {PLATES:e}, loading = \"backslip\" }}");
    let [a, b, mu0, v0, l] = LAW;
    let other = format!(
        "{{ minus = \"third.right\", plus = \"fourth.left\", normal = {NORMAL:?}, rate = {RATE:e}, creep = {creep}, \
         law = {{ kind = \"rate-and-state\", evolution = \"ageing\", mu0 = {mu0:?}, a = {a:?}, b = {b:?}, l = {l:e}, v_ref = {v0:e}, v_initial = {RATE:e} }} }}"
    );
    let text = SceneText::new(&scene(false))
        .add("bodies.third", body(-1.0, "right"))
        .add("bodies.fourth", body(0.0, "right"))
        .add("faults.other", other)
        .add("faults.main.creep", creep)
        .add(
            "faults.main.patches",
            format!("[{{ box = {{ y = {{ from = 1.5, to = 3 }} }}, rate = {SLOW:e} }}]"),
        )
        .with("stages[0].conditions", format!("[{held}]"))
        .with("stages[0].duration", SHORT)
        .text()?;
    let done = WrittenRun::from_text(&text)?;
    // Areas of the points are a half, one and a half.
    let areas = [0.5, 1.0, 0.5];
    let coupling = [RATE, RATE, SLOW].map(|rate| 1.0 - rate / PLATES);
    let sum: f64 = areas.iter().zip(coupling).map(|(area, c)| area * c).sum();
    let lag = 1.0 - RATE / PLATES;
    let first = |file: &str, name: &str| -> Result<f64, CaseError> {
        Ok(*done.files.table(file)?.column(name)?.first().ok_or("no row")?)
    };
    times(ledger, &done)?;
    for (column, found, exact) in [
        ("coupling", first("locking.csv", "coupling of main")?, sum / AREA),
        ("moment_deficit_rate", first("locking.csv", "moment_deficit_rate of main")?, MODULUS * PLATES * sum),
        (
            "moment_rate",
            first("moment_rate.csv", "moment_rate of main")?,
            MODULUS * (1.5 * RATE + 0.5 * SLOW),
        ),
        ("coupling of the other fault", first("locking.csv", "coupling of other")?, lag),
        (
            "moment_deficit_rate of the other fault",
            first("locking.csv", "moment_deficit_rate of other")?,
            MODULI[1] * 3.0 * PLATES * lag,
        ),
        (
            "moment_rate of the other fault",
            first("moment_rate.csv", "moment_rate of other")?,
            MODULI[1] * 3.0 * RATE,
        ),
        (
            "normal force of the other fault",
            first("fault_forces.csv", "normal_force of other")?,
            3.0 * NORMAL,
        ),
    ] {
        ledger
            .claim(format!("a fault with points of unlike areas and rates that lag behind plates, beside another one, at the start: {column}"))
            .value(found)
            .equals(exact)
            .relative(1e-8)
            .evidence(Evidence::Exact, "1 - V/Vp, weighed by areas of a half, one and a half, and the moduli of the rocks of each fault")
            .because("files have ten digits")
            .why_not_tighter("the last digit may be off by any part of a half")
            .covers(&[Capability::Outputs, Capability::FaultCycles])
            .cost(&done.cost)
            .record();
    }
    Ok(())
}

/// First and last times of the tables of a fault that plates load.
fn times(ledger: &mut Ledger, done: &WrittenRun) -> Result<(), CaseError> {
    let mut found = Vec::new();
    for table in ["locking.csv", "coupling_profiles.csv"] {
        let times = done.files.table(table)?.column("time")?;
        found.extend([*times.first().ok_or("no row")?, *times.last().ok_or("no row")?]);
    }
    ledger
        .claim(
            "a fault that lags behind plates: first and last time in locking.csv and coupling_profiles.csv",
        )
        .unit("s")
        .values(&found)
        .equals_each(&[0.0, SHORT, 0.0, SHORT])
        .absolute(1e-14)
        .evidence(Evidence::Exact, "start and end of the only stage")
        .because("times have fifteen digits")
        .why_not_tighter("the last digit may be off by a half")
        .covers(&[Capability::Outputs, Capability::FaultCycles])
        .cost(&done.cost)
        .record();
    Ok(())
}

/// The list of snapshots has the rate of the fastest point, which is not the first.
fn snapshots(ledger: &mut Ledger) -> Result<(), CaseError> {
    let text = SceneText::new(&scene(true))
        .add(
            "faults.main.patches",
            format!("[{{ box = {{ y = {{ from = -1, to = 0.5 }} }}, rate = {SLOW:e} }}]"),
        )
        .with("stages[0].duration", 1e-3)
        .text()?;
    let done = WrittenRun::from_text(&text)?;
    let first = *done.files.table("snapshots.csv")?.column("log10 slip_rate")?.first().ok_or("no row")?;
    ledger
        .claim(
            "a fault in space with slow points: largest slip rate in the first row of the list of snapshots",
        )
        .value(first)
        .equals(RATE.log10())
        .absolute(1e-6)
        .evidence(Evidence::Exact, "the slip rate of the other points at the start")
        .because("the list has six decimals")
        .why_not_tighter("the last digit may be off by a half")
        .covers(&[Capability::Outputs, Capability::FaultCycles])
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Displacements of the bodies at the end, which move rigidly as tractions do not change.
fn moved(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = WrittenRun::from_text(&SceneText::new(&scene(false)).add("output.bodies", true).text()?)?;
    let fields = Fields::read(&done.files.text("fields/bodies_end.vtu")?)?;
    let along = |name: &str, c: usize| -> Result<Vec<f64>, CaseError> {
        Ok(fields.array(name)?.values.chunks_exact(3).map(|v| v[c]).collect())
    };
    let (places, found) = (along("Points", 0)?, along("displacement", 2)?);
    // On the fault nodes of both sides lie at one place.
    let sides: Vec<f64> =
        places.iter().zip(&found).map(|(x, u)| if *x == 0.0 { u.signum() } else { x.signum() }).collect();
    ledger
        .claim("displacements of the bodies beside a fault that slides steadily, in the field at the end")
        .unit("m")
        .values(&found)
        .equals_each(&sides.iter().map(|side| 0.5 * side * RATE * DURATION).collect::<Vec<_>>())
        .relative(1e-8)
        .evidence(Evidence::Exact, "both blocks move as their drawn sides")
        .because("the error of ln V in a step is 1e-9")
        .why_not_tighter("errors of steps decay with slip")
        .covers(&[Capability::Outputs, Capability::FaultCycles])
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Claims about numbers of a run at its end. Of vectors the last component, along z, is taken.
fn all(
    ledger: &mut Ledger,
    run: (&Folder, &Cost),
    space: &str,
    wanted: &[ExpectedNumber<'_>],
) -> Result<(), CaseError> {
    let claims = FileClaims {
        title: &format!("a fault that slides steadily {space}"),
        bound: 5e-7,
        source: "friction of the law at the rate of the load; the blocks bend under it, and slip lags by what they bend since the start",
        because: "the error of ln V in a step is 1e-9, and the table of the largest rate has seven digits",
        slack: "most files have ten digits",
        covers: &[Capability::Outputs, Capability::FaultCycles],
    };
    claims.claim(ledger, run, wanted)
}
