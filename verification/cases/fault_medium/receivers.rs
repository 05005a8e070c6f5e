//! Motion of receivers in the rock: between events beside locked faults, beside faults that creep, and over an event.

use crate::cases::okada::Rectangle;
use crate::cases::run_files::{Table, WrittenRun};
use crate::{CaseError, Evidence, Ledger};
use asperity_vary::SceneText;
use std::f64::consts::PI;

/// Rate of the plates \[m/s\].
pub(super) const PLATES: f64 = 1e-9;
/// Width of the faults down dip \[m\], and length of those in space.
const WIDTH: f64 = 10e3;
const LENGTH: f64 = 24e3;
/// G/(λ + G) of rock with a Poisson's ratio of a quarter.
pub(super) const RATIO: f64 = 0.5;
/// Dip \[degrees\], rake from strike and azimuth of the strike.
pub(super) const DIP: f64 = 40.0;
pub(super) const RAKE: f64 = 30.0;
pub(super) const STRIKE: f64 = 25.0;
/// Rake of plates that move obliquely to that of the fault \[degrees\].
pub(super) const PLATES_RAKE: f64 = 100.0;

/// A fault below a free surface; `rest` holds its geometry, rates and receivers.
pub(super) fn scene(kinematics: &str, law: &str, duration: &str, rest: &str) -> String {
    format!(
        r#"
schema = 1
title = "receivers in a medium"
kinematics = "{kinematics}"
[materials.rock]
young = "80 GPa"
poisson = 0.25
density = "2670 kg/m^3"
[medium]
kind = "half-space"
material = "rock"
[[stages]]
name = "still"
duration = "{duration}"
[time]
stepper = "fault-ode"
[faults.main]
law = {{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, v_ref = "1 um/s", v_initial = "1e-9 m/s", {law} }}
normal = "50 MPa"
under_resolved = "allow"
damping = "radiation"
creep = {{ rate = {PLATES:e} }}
{rest}
"#
    )
}

/// A law that strengthens with velocity.
pub(super) const STABLE: &str = "a = 0.02, b = 0.015, l = \"8 mm\"";

/// See the module.
pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    locked(ledger)?;
    creeping(ledger)?;
    in_space(ledger)?;
    event(ledger)?;
    turned_event(ledger)
}

/// A vertical fault in antiplane motion that slides at this rate, with receivers at the surface.
fn antiplane(rate: f64) -> Result<WrittenRun, CaseError> {
    let at = DISTANCES.map(|(name, x)| format!("receivers.{name} = [{x:?}, 0.0]\n")).concat();
    let line = format!(
        "line = {{ trace = [[0.0, 0.0], [0.0, {:?}]], spacing = 500.0 }}\nrate = {rate:e}\n[output]\nsurface = {{ spacing = \"3 km\", x = {{ from = \"-31.5 km\", to = \"31.5 km\" }} }}\n{at}",
        -WIDTH
    );
    WrittenRun::from_text(&scene("antiplane", STABLE, "1 yr", &line))
}

/// Receivers at the surface and their distances from the fault \[m\].
const DISTANCES: [(&str, f64); 4] = [("near", 100.0), ("west", -7e3), ("east", 25e3), ("far", 400e3)];

/// Last or first number of a column.
fn ends(table: &Table, name: &str) -> Result<[f64; 2], CaseError> {
    let values = table.column(name)?;
    Ok([*values.first().ok_or("no row")?, *values.last().ok_or("no row")?])
}

/// Velocity beside a locked fault.
fn locked(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = antiplane(1e-20)?;
    let mut worst = 0.0_f64;
    for (name, x) in DISTANCES {
        let [velocity, _] = ends(&done.files.table(&format!("receivers/{name}.csv"))?, "velocity_z")?;
        worst = worst.max((velocity / PLATES - (x / WIDTH).atan() / PI).abs());
    }
    ledger
        .claim("velocity of the surface beside a locked strike-slip fault over the rate of the plates, largest error")
        .value(worst)
        .at_most(1e-11)
        .evidence(Evidence::Exact, "atan(x/D)/pi: Savage and Burford 1973, fault locked down to D")
        .because("the fault slides at 1e-11 of the plates, and twenty cells are summed")
        .why_not_tighter("the slip rate of the fault at the start is a choice")
        .cost(&done.cost)
        .record();
    profiles(ledger, &done)
}

/// Displacement of the surface through time beside a locked fault.
fn profiles(ledger: &mut Ledger, done: &WrittenRun) -> Result<(), CaseError> {
    let table = done.files.table("surface_profiles_z.csv")?;
    let (times, mut worst) = (table.column("time")?, 0.0_f64);
    let positions: Vec<f64> = table.head().iter().skip(1).map(|x| x.parse()).collect::<Result<_, _>>()?;
    if positions.len() != 22 || times.len() < 5 {
        return Err(format!("{} positions at {} times", positions.len(), times.len()).into());
    }
    let moved = PLATES * times.last().ok_or("no row")?;
    for (x, name) in positions.iter().zip(table.head().iter().skip(1)) {
        for (time, found) in times.iter().zip(table.column(name)?) {
            let wanted = PLATES * time * (x / WIDTH).atan() / PI;
            worst = worst.max((found - wanted).abs() / moved);
        }
    }
    ledger
        .claim("profiles of the surface beside a locked strike-slip fault through a year, over the displacement of the plates, largest error")
        .value(worst)
        .at_most(1e-9)
        .evidence(Evidence::Exact, "t V/pi atan(x/D): Savage and Burford 1973, fault locked down to D")
        .because("the table has ten digits, and the fault slides at 1e-11 of the plates at first")
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Motion beside a fault that creeps with the plates.
fn creeping(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = antiplane(PLATES)?;
    let mut worst = [0.0_f64; 2];
    for (name, x) in DISTANCES {
        let table = done.files.table(&format!("receivers/{name}.csv"))?;
        let [_, time] = ends(&table, "time")?;
        let [[_, velocity], [_, displacement]] =
            [ends(&table, "velocity_z")?, ends(&table, "displacement_z")?];
        let half = 0.5 * PLATES * x.signum();
        let errors = [velocity / half - 1.0, displacement / (half * time) - 1.0];
        worst = std::array::from_fn(|k| worst[k].max(errors[k].abs()));
    }
    for (what, value) in ["velocity", "displacement"].into_iter().zip(worst) {
        ledger
            .claim(format!(
                "{what} of the surface beside a fault that creeps with the plates, largest relative error"
            ))
            .value(value)
            .at_most(1e-6)
            .evidence(Evidence::Exact, "both sides move as rigid bodies at half the rate of the plates")
            .because(
                "steady creep is kept to the tolerance of 1e-5 of ln V, and the fault contributes a part",
            )
            .why_not_tighter(
                "the tolerance is of one step; the fault is in a steady state, which steps hardly leave",
            )
            .cost(&done.cost)
            .record();
    }
    Ok(())
}

/// Unit vector of the scene at a rake from strike \[degrees\].
pub(super) fn direction(rake: f64) -> [f64; 3] {
    let (s, c) = DIP.to_radians().sin_cos();
    let (up, along) = rake.to_radians().sin_cos();
    [-c * up, s * up, -along]
}

/// Receivers in space at the surface \[m\].
const PLACES: [(&str, [f64; 2]); 5] = [
    ("footwall", [-3e3, 2e3]),
    ("above", [4e3, -5e3]),
    ("beyond", [9e3, 14e3]),
    ("ahead", [2.5e3, -31e3]),
    ("far", [90e3, 60e3]),
];

/// Geometry, rate and receivers of a dipping rectangle of these cells \[m\].
pub(super) fn rectangle(rate: f64, [length, width, size]: [f64; 3]) -> String {
    let rake = direction(RAKE);
    let at = PLACES.map(|(name, [x, z])| format!("receivers.{name} = [{x:?}, 0.0, {z:?}]\n")).concat();
    format!(
        "rake = {rake:?}\nrectangle = {{ from = [0.0, 0.0, {:?}], to = [0.0, 0.0, {:?}], dip = \"{DIP} deg\", width = {width:?}, size = {size:?} }}\nrate = {rate:e}\n[output]\n{at}",
        0.5 * length,
        -0.5 * length
    )
}

/// Displacement of the surface in the axes of the scene by slip of the hanging wall of a rectangle at a rake \[degrees\] \[m\].
pub(super) fn okada(slip: f64, rake: f64, [length, width]: [f64; 2], [x, z]: [f64; 2]) -> [f64; 3] {
    let (up, along) = rake.to_radians().sin_cos();
    let (sine, cosine) = DIP.to_radians().sin_cos();
    let source = Rectangle {
        depth: width * sine,
        dip: DIP.to_radians(),
        size: [length, width],
        slip: [slip * along, slip * up, 0.0],
        ratio: RATIO,
    };
    let [u, v, w] = source.surface(0.5 * length - z, width * cosine - x);
    [-v, w, -u]
}

/// 1 if the hanging wall is the plus side, -1 if it is the minus side.
pub(super) fn hanging(done: &WrittenRun) -> f64 {
    done.plan.points[0].normal[1].signum()
}

/// Velocities beside a locked dipping fault in space, whose plates move along its rake, and obliquely to it.
fn in_space(ledger: &mut Ledger) -> Result<(), CaseError> {
    let rest = rectangle(1e-20, [LENGTH, WIDTH, 2e3]);
    let along = scene("3d", STABLE, "1 d", &rest);
    let oblique = SceneText::new(&along)
        .add("faults.main.slip", "free")
        .add("faults.main.creep.rake", format!("{:?}", direction(PLATES_RAKE)))
        .text()?;
    for (text, rake, plates) in [(along, RAKE, ""), (oblique, PLATES_RAKE, ", plates oblique to its rake")] {
        let done = WrittenRun::from_text(&text)?;
        let worst = beside_locked(&done, rake)?;
        ledger
            .claim(format!("velocity of the surface beside a locked dipping fault in space{plates}, over the rate of the plates, largest error"))
            .value(worst)
            .at_most(1e-10)
            .evidence(Evidence::Exact, "Okada 1985 for slip that lags behind plates that move by half their rate on either side")
            .because("the fault slides at 1e-11 of the plates, and sixty cells are summed")
            .why_not_tighter("the slip rate of the fault at the start is a choice")
            .cost(&done.cost)
            .record();
    }
    Ok(())
}

/// Largest error of the velocities of the receivers, whose plates move at a rake \[degrees\], over the rate of the plates.
fn beside_locked(done: &WrittenRun, rake: f64) -> Result<f64, CaseError> {
    let (side, way, mut worst) = (hanging(done), direction(rake), 0.0_f64);
    for (name, [x, z]) in PLACES {
        let table = done.files.table(&format!("receivers/{name}.csv"))?;
        let back = okada(-side * PLATES, rake, [LENGTH, WIDTH], [x, z]);
        // The plane crosses the surface along z: the hanging wall lies at positive x.
        let half = 0.5 * PLATES * side * x.signum();
        for (axis, component) in ["velocity_x", "velocity_y", "velocity_z"].into_iter().enumerate() {
            let [velocity, _] = ends(&table, component)?;
            worst = worst.max((velocity - back[axis] - half * way[axis]).abs() / PLATES);
        }
    }
    Ok(worst)
}

/// Size of a fault of one cell in space \[m\].
pub(super) const SIZE: [f64; 2] = [2e3, 2e3];

/// An event of one cell in space, and its slip \[m\].
pub(super) fn one_cell_event() -> Result<(WrittenRun, f64), CaseError> {
    one_cell_event_with(
        "surface = { spacing = 1e3, x = { from = -6300.0, to = 8100.0 }, z = { from = -7e3, to = 5500.0 } }\n",
    )
}

/// Such an event with further outputs, and its slip \[m\].
pub(super) fn one_cell_event_with(output: &str) -> Result<(WrittenRun, f64), CaseError> {
    let done = WrittenRun::from_text(&one_cell(output))?;
    let slip = done.files.table("events/rupture_times_000.csv")?.only("slip")?;
    Ok((done, slip))
}

/// A fault of one cell in space with further outputs.
pub(super) fn one_cell(output: &str) -> String {
    let size = SIZE;
    let rest = rectangle(1.1e-9, [size[0], size[1], 2e3]);
    let more = format!(
        "{output}[events]\nabove = \"1e-3 m/s\"\nstop_after = 1\n[place]\nepoch = \"2000-01-01T00:00:00Z\"\nlatitude = \"10 deg\"\nlongitude = \"20 deg\"\nstrike = \"{STRIKE} deg\"\nup = [0, 1, 0]\nalong = [0, 0, -1]\n"
    );
    let weakening = "a = 0.010, b = 0.015, l = \"4 mm\"";
    scene("3d", weakening, "1000 yr", &(rest + &more))
}

/// Displacement over an event of one cell whose plates move obliquely to its rake, so that its slip turns.
fn turned_event(ledger: &mut Ledger) -> Result<(), CaseError> {
    let text = SceneText::new(&one_cell(""))
        .add("faults.main.slip", "free")
        .add("faults.main.creep.rake", format!("{:?}", direction(PLATES_RAKE)))
        .text()?;
    let done = WrittenRun::from_text(&text)?;
    let points = done.files.table("events/rupture_times_000.csv")?;
    let (slip, turned) = (points.only("slip")?, points.only("turned")?);
    let table = done.files.table("events/displacements_000.csv")?;
    let columns = ["displacement_x", "displacement_y", "displacement_z"].map(|name| table.column(name));
    let [x, y, z] = columns;
    let (x, y, z, mut worst) = (x?, y?, z?, 0.0_f64);
    for (k, name) in table.words("name")?.into_iter().enumerate() {
        let (_, place) = PLACES.into_iter().find(|p| p.0 == name).ok_or("no such receiver")?;
        let wanted = okada(hanging(&done) * slip, RAKE + turned, SIZE, place);
        for (found, wanted) in [x[k], y[k], z[k]].into_iter().zip(wanted) {
            worst = worst.max((found - wanted).abs() / slip);
        }
    }
    if turned.abs() < 1.0 {
        return Err("the slip did not turn".into());
    }
    ledger
        .claim("displacement of the surface over an event whose slip turns from the rake, over its slip, largest error")
        .value(worst)
        .at_most(1e-6)
        .evidence(Evidence::Exact, "Okada 1985 for the slip of the one cell, at the rake by which the table says it has turned")
        .because("the angle has seven digits: some 1e-7 of the slip")
        .why_not_tighter("an angle of hundred degrees would have four decimals")
        .cost(&done.cost)
        .record();
    super::turning::claims(ledger, &done, turned)
}

/// Displacement over an event of one cell.
fn event(ledger: &mut Ledger) -> Result<(), CaseError> {
    let ((done, slip), size) = (one_cell_event()?, SIZE);
    let table = done.files.table("events/displacements_000.csv")?;
    let [right, along] = [(STRIKE + 90.0).to_radians(), STRIKE.to_radians()];
    let columns = ["east", "north", "up"].map(|name| table.column(name));
    let [east, north, up] = columns;
    let (east, north, up, mut worst) = (east?, north?, up?, 0.0_f64);
    for (k, name) in table.words("name")?.into_iter().enumerate() {
        let (_, place) = PLACES.into_iter().find(|p| p.0 == name).ok_or("no such receiver")?;
        let [x, y, z] = okada(hanging(&done) * slip, RAKE, size, place);
        // x points to the right of the strike, and -z along it.
        let wanted = [x * right.sin() - z * along.sin(), x * right.cos() - z * along.cos(), y];
        for (found, wanted) in [east[k], north[k], up[k]].into_iter().zip(wanted) {
            worst = worst.max((found - wanted).abs() / slip);
        }
    }
    ledger
        .claim("displacement of the surface to the east, north and up over an event, over its slip, largest error")
        .value(worst)
        .at_most(1e-8)
        .evidence(Evidence::Exact, "Okada 1985 for the slip of the one cell, turned by the strike")
        .because("slip and displacements have ten digits")
        .why_not_tighter("the last digit may be off by any part of a half")
        .cost(&done.cost)
        .record();
    let mut places = Vec::new();
    for name in table.words("name")? {
        let (_, [x, z]) = PLACES.into_iter().find(|p| p.0 == name).ok_or("no such receiver")?;
        places.push([x, 0.0, z]);
    }
    super::earth::claims(ledger, &done, "events/displacements_000.csv", &places)
}
