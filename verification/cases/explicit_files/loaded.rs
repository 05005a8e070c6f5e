//! A spring on nodes of unequal mass, and the work of a load that ramps.

use super::last;
use crate::cases::output_files::vtu::Fields;
use crate::cases::run_files::Waves;
use crate::cases::waves::run;
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_mechanics::{Pace, Spring};
use asperity_plan::dynamics;
use asperity_plan::dynamics::AnyPlan;
use asperity_plan::reading::scene;

/// Steps of both runs.
const STEPS: usize = 1000;

/// A side so soft that its nodes move as points of mass: a quarter, a half and a quarter of 1/2 kg/m.
const DRAWN: &str = r#"schema = 1
title = "drawn"
kinematics = "plane-strain"
[materials.soft]
young = 1e-9
poisson = 0.25
density = 1
[bodies.block]
material = "soft"
mesh.block = { min = [0, 0], max = [1, 1], divisions = [1, 2], element = "quad4" }
[[stages]]
name = "draw"
duration = 4
steps = 1000
conditions = []
[time]
stepper = "explicit"
viscosity = 0
"#;

/// One cell as an oscillator: stiffness 1 and mass 1/2 of its free side.
const RAMPED: &str = r#"schema = 1
title = "ramped"
kinematics = "plane-strain"
[materials.rod]
young = 1
poisson = 0
density = 1
[bodies.cell]
material = "rod"
mesh.block = { min = [0, 0], max = [1, 1], divisions = [1, 1], element = "quad4" }
[[stages]]
name = "load"
duration = 10
steps = 1000
conditions = [
    { set = "cell.left", x = 0, y = 0 },
    { set = "cell.right", y = 0, pressure = { to = -1 } },
]
[time]
stepper = "explicit"
viscosity = 0
[output]
seismograms.S = { body = "cell", at = [0.25, 0.6] }
"#;

/// Largest error of the phase of an oscillator turned by `angle` in all steps: (ω dt)²/24 of it.
fn lead(angle: f64) -> f64 {
    angle * (angle / STEPS as f64).powi(2) / 24.0
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    drawn(ledger)?;
    ramped(ledger)
}

/// The side drawn by a spring of 1 N/m whose far end moves at 1 m/s. Scenes have such springs in the ruptures of faults alone.
fn drawn(ledger: &mut Ledger) -> Result<(), CaseError> {
    let scene = scene::read(DRAWN).map_err(|e| e.to_string())?;
    let AnyPlan::Two(plan) = dynamics::plan(&scene).map_err(|e| e.to_string())? else {
        return Err("a scene in space".into());
    };
    let mut problem = plan.problem;
    let nodes = problem.model.mesh.nodes.iter().enumerate().filter(|(_, x)| x[0] > 0.5);
    let side: Vec<(usize, f64)> = nodes.map(|(n, x)| (n, x[1])).collect();
    let dofs = side.iter().map(|(n, _)| 2 * n).collect();
    let spring = Spring { set: "block.right".into(), axis: 0, dofs, stiffness: 1.0, rate: Pace::Steady(1.0) };
    problem.stages[0].springs.push(spring);
    let (last, cost) = Cost::measure(|| run(&problem, |_| ()));
    let last = last?;
    let (omega, end) = (2.0_f64.sqrt(), 4.0);
    let found: Vec<f64> = side.iter().map(|(n, _)| last.displacement()[2 * n]).collect();
    ledger
        .claim("displacements of the nodes of a side of soft cells that a spring pulls")
        .unit("m")
        .values(&found)
        .equals_each(&[end - (omega * end).sin() / omega; 3])
        .absolute(lead(omega * end))
        .evidence(Evidence::Exact, "t - sin(ω t)/ω with ω² = 1/M, M the mass of the side: all nodes move as its mean")
        .because("the phase of central differences, (ω dt)²/24 of the angle turned; cells resist with 1e-9 of the spring")
        .covers(&[Capability::Waves, Capability::Stages])
        .cost(&cost.count("steps", STEPS as f64))
        .record();
    Ok(())
}

fn ramped(ledger: &mut Ledger) -> Result<(), CaseError> {
    let run = Waves::from_text(RAMPED)?;
    station(ledger, &run)?;
    header(ledger, &run)?;
    velocities(ledger, &run)?;
    let (omega, end) = (2.0_f64.sqrt(), 10.0);
    let (sine, cosine) = (omega * end).sin_cos();
    // The force is t/T, and u = (t - sin(ω t)/ω)/T.
    let work = (0.5 * end * end - end * sine / omega - (cosine - 1.0) / (omega * omega)) / (end * end);
    let kinetic = 0.25 * ((1.0 - cosine) / end).powi(2);
    let elastic = 0.5 * ((end - sine / omega) / end).powi(2);
    let table = run.files.table("energy.csv")?;
    // Largest change of each energy with the phase of the oscillation: 1/(ω T), and (1 - cos φ) sin φ/(2 T²) < 0.65/T².
    let by_phase = 1.0 / (omega * end);
    for (column, name, exact, by_phase) in [
        ("loads", "work of a load that ramps on an oscillator", work, by_phase),
        ("kinetic", "kinetic energy of that oscillator", kinetic, 0.65 / (end * end)),
        ("elastic", "elastic energy of that oscillator", elastic, by_phase),
    ] {
        ledger
            .claim(name)
            .unit("J/m")
            .value(last(&table.column(column)?)?)
            .equals(exact)
            .absolute(lead(omega * end) * by_phase)
            .evidence(Evidence::Exact, "∫ F v dt with u = (t - sin(ω t)/ω)/T")
            .because("the phase of central differences, (ω dt)²/24 of the angle turned, times the change of the energy with the phase")
            .covers(&[Capability::Waves, Capability::Loads, Capability::Outputs])
            .cost(&run.cost)
            .record();
    }
    Ok(())
}

/// Words of the header of a SAC file, and its samples, by the table of the format (Goldstein and Snoke 2005), against the table of
/// the same seismogram.
fn header(ledger: &mut Ledger, run: &Waves) -> Result<(), CaseError> {
    let names = run.files.names("seismograms")?;
    let name = names.iter().find(|name| name.ends_with("X.sac")).ok_or("no SAC file along x")?;
    let bytes = std::fs::read(run.files.path().join("seismograms").join(name))?;
    let word = |k: usize| -> Result<[u8; 4], CaseError> {
        Ok(bytes.get(4 * k..4 * k + 4).ok_or("the file ends early")?.try_into()?)
    };
    let float = |k: usize| -> Result<f64, CaseError> { Ok(f64::from(f32::from_le_bytes(word(k)?))) };
    let table = run.files.table("seismograms/S.csv")?;
    let (times, samples) = (table.column("time")?, table.column("velocity_x")?);
    let n = samples.len();
    let sorted = |pick: fn(f64, f64) -> f64| samples.iter().copied().reduce(pick).unwrap_or(f64::NAN);
    let words = [
        float(0)?,
        float(1)?,
        float(2)?,
        float(5)?,
        float(6)?,
        float(56)?,
        f64::from(i32::from_le_bytes(word(79)?)),
    ];
    let exact = [
        times[1] - times[0],
        sorted(f64::min),
        sorted(f64::max),
        times[0],
        times[n - 1],
        samples.iter().sum::<f64>() / n as f64,
        n as f64,
    ];
    ledger
        .claim("interval, least and largest sample, begin, end, mean and number of samples in the header of a SAC file")
        .values(&words)
        .equals_each(&exact)
        .absolute(1e-7 * times[n - 1])
        .evidence(Evidence::Exact, "words 0, 1, 2, 5, 6, 56 and 79 of the header, from the table of the seismogram")
        .because("the format has numbers of seven digits")
        .why_not_tighter("the last digit may be off by any part of a half")
        .covers(&[Capability::Waves, Capability::Outputs])
        .cost(&run.cost)
        .record();
    let found = (0..n).map(|k| float(158 + k)).collect::<Result<Vec<f64>, CaseError>>()?;
    ledger
        .claim("samples of a SAC file")
        .unit("m/s")
        .values(&found)
        .equals_each(&samples)
        .absolute(1e-7 * exact[2])
        .evidence(Evidence::Exact, "the column of the table")
        .because("the format has numbers of seven digits")
        .why_not_tighter("the last digit may be off by any part of a half")
        .covers(&[Capability::Waves, Capability::Outputs])
        .cost(&run.cost)
        .record();
    Ok(())
}

/// Velocities and displacements of the free side in fields.
fn velocities(ledger: &mut Ledger, run: &Waves) -> Result<(), CaseError> {
    let (omega, step) = (2.0_f64.sqrt(), 10.0 / STEPS as f64);
    for number in [3, 7] {
        let t = f64::from(number);
        let fields = Fields::read(&run.files.text(&format!("fields/bodies_{number:05}.vtu"))?)?;
        let of = |name: &str| -> Result<f64, CaseError> {
            let x = fields.array(name)?.values.chunks_exact(3).map(|v| v[0]).collect::<Vec<f64>>();
            Ok(x.into_iter().fold(0.0, f64::max))
        };
        ledger
            .claim(format!("a cell under a ramped load: velocity and displacement of its free side in the fields at {number} s"))
            .values(&[of("velocity")?, of("displacement")?])
            .equals_each(&[0.1 * (1.0 - (omega * t).cos()), 0.1 * (t - (omega * t).sin() / omega)])
            .absolute(0.1 * (omega * step).powi(2) * (omega * t / 24.0 + 1.0 / 8.0))
            .evidence(Evidence::Exact, "the motion of the oscillator, (t - sin(ω t)/ω)/10 with ω² = 2")
            .because("the phase of central differences, (ω dt)²/24 of the angle turned, and the mean of two half steps")
            .why_not_tighter("both errors are largest at other phases")
            .covers(&[Capability::Waves, Capability::Outputs])
            .cost(&run.cost)
            .record();
    }
    Ok(())
}

/// A seismogram at a quarter of the way from the fixed side, which moves by a quarter of the free one.
fn station(ledger: &mut Ledger, run: &Waves) -> Result<(), CaseError> {
    let table = run.files.table("seismograms/S.csv")?;
    let last = |name: &str| -> Result<f64, CaseError> {
        Ok(*table.column(name)?.last().ok_or_else(|| format!("no row of {name}"))?)
    };
    let (t, omega) = (last("time")?, 2.0_f64.sqrt());
    let [velocity, displacement] =
        [0.1 * (1.0 - (omega * t).cos()), 0.1 * (t - (omega * t).sin() / omega)].map(|v| 0.25 * v);
    // The mean of the velocities half a step before and after has an error of its own, ω² dt²/8.
    let step = 10.0 / STEPS as f64;
    let bound = 0.25 * 0.1 * (lead(omega * t) + (omega * step).powi(2) / 8.0);
    for (name, value, unit) in [("velocity_x", velocity, "m/s"), ("displacement_x", displacement, "m")] {
        ledger
            .claim(format!("a cell under a ramped load: {name} of a seismogram within it, in its last row"))
            .unit(unit)
            .value(last(name)?)
            .equals(value)
            .absolute(bound)
            .evidence(Evidence::Exact, "a quarter of the motion of the oscillator, (t - sin(ω t)/ω)/10 with ω² = 2")
            .because("the phase of central differences, (ω dt)²/24 of the angle turned, and the mean of two half steps")
            .why_not_tighter("both errors are largest at other phases")
            .covers(&[Capability::Waves, Capability::Outputs])
            .cost(&run.cost)
            .record();
    }
    Ok(())
}
