//! Vector slip of a column in space without friction: along y by an imposed traction, along z by a wave from its end.
//!
//! All nodes are held along x, so that both parts are plane shear waves. V_y = 2 A G(t), and V_z is twice the velocity of the
//! wave, which the end sends out a travel time earlier.

use super::growth;
use crate::cases::output_files::vtu::Fields;
use crate::cases::run_files::Waves;
use crate::{Capability, CaseError, Evidence, Ledger};
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// Length of a column in travel times of shear waves.
const LENGTH: f64 = 2.0;
/// Position of a receiver in the second part.
const RECEIVER: f64 = 1.0;
/// Cells along a column.
const CELLS: usize = 80;
/// Imposed traction, and largest velocity of the wave.
const TRACTION: f64 = 0.1;
const WAVE: f64 = 0.1;
/// Coefficient of friction, under a normal traction of one.
const FRICTION: f64 = 1e-9;
/// End of the run: waves return from the ends of the column later.
const END: f64 = 3.6;
/// Intervals between rows, and between fields.
const ROWS: usize = 72;
const FIELDS: usize = 12;
/// The fields in which the wave passes the fault, at 2.4 s.
const PASSING: usize = 8;

/// Displacement of the end that sends out the wave, whose velocity is a period of a cosine.
fn motion(t: f64) -> f64 {
    let t = t.min(1.0);
    0.5 * WAVE * (t - (TAU * t).sin() / TAU)
}

/// Its velocity.
fn velocity(t: f64) -> f64 {
    if (0.0..1.0).contains(&t) { 0.5 * WAVE * (1.0 - (TAU * t).cos()) } else { 0.0 }
}

fn scene() -> Result<String, CaseError> {
    let rows: Vec<String> = (0..=200)
        .map(|k| format!("[{:?}, {:?}]", f64::from(k) / 200.0, motion(f64::from(k) / 200.0)))
        .collect();
    let mut conditions = String::new();
    for (body, set) in ["a", "b"].into_iter().flat_map(|b| ["bottom", "top", "back", "front"].map(|s| (b, s)))
    {
        write!(conditions, "{{ set = \"{body}.{set}\", x = 0 }}, ")?;
    }
    Ok(format!(
        "schema = 1\ntitle = \"oblique\"\nkinematics = \"3d\"\n[materials.rock]\nyoung = 2.5\npoisson = 0.25\ndensity = 1\n\
         [bodies.a]\nmaterial = \"rock\"\n\
         mesh.block = {{ min = [-{LENGTH:?}, 0, 0], max = [0, 1, 2], divisions = [{CELLS}, 1, 1], element = \"hex8\" }}\n\
         [bodies.b]\nmaterial = \"rock\"\n\
         mesh.block = {{ min = [0, 0, 0], max = [{LENGTH:?}, 1, 2], divisions = [{CELLS}, 1, 1], element = \"hex8\" }}\n\
         [faults.f]\nminus = \"a.right\"\nplus = \"b.left\"\nslip = \"free\"\nrake = [0, 1, 0]\nlaw = {{ kind = \"coulomb\", mu = {FRICTION:e} }}\n\
         normal = 1\nshear = 0\npulses = [{{ traction = {TRACTION:?}, centre = [0, 0.5, 1], radius = 1e4, duration = 1 }}]\n\
         [[stages]]\nname = \"slip\"\nduration = {END:?}\nconditions = [{conditions}{{ set = \"a.left\", absorbing = true }}, \
         {{ set = \"b.right\", z = {{ table = [{}] }} }}]\n\
         [time]\nstepper = \"explicit\"\nviscosity = 0\n[output]\nsampling = {:?}\nprofiles = {ROWS}\n\
         fields = {FIELDS}\nstations.f = [[0, 0.5, 1]]\nseismograms.S = {{ body = \"b\", at = [{RECEIVER:?}, 0.5, 1] }}\n",
        rows.join(", "),
        END / ROWS as f64
    ))
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let run = Waves::from_text(&scene()?)?;
    let table = run.files.table("moment_rate.csv")?;
    let times = table.column("time")?;
    // The modulus is 1, and the area 2.
    let exact = |t: &f64| 2.0 * (2.0 * TRACTION * growth(*t, 1.0)).hypot(2.0 * velocity(t - LENGTH));
    let rates: Vec<f64> = times.iter().map(exact).collect();
    // k³h²/24 is the shift of phase per length.
    let lag = TAU.powi(3) * (LENGTH / CELLS as f64).powi(2) / 24.0 * LENGTH;
    let largest = rates.iter().copied().fold(0.0, f64::max);
    ledger
        .claim("moment rate of slip that a wave turns out of its direction")
        .unit("N m/s")
        .norm("largest difference")
        .values(&table.column("moment_rate of f")?)
        .equals_each(&rates)
        .absolute(lag * largest)
        .evidence(Evidence::Exact, "G A |V| with V_y = 2 A G(t) and V_z twice the velocity of the wave")
        .because("the shift of phase k³h²/24 of the wave on its way, at steps without length")
        .covers(&[Capability::DynamicRupture, Capability::Outputs])
        .cost(&run.cost)
        .record();
    let n = 4000;
    let middle = |k: i32| END * (f64::from(k) + 0.5) / f64::from(n);
    let along: f64 = (0..n).map(|k| 2.0 * TRACTION * growth(middle(k), 1.0) * END / f64::from(n)).sum();
    let moment = 2.0 * along.hypot(2.0 * motion(END));
    ledger
        .claim("moment of that slip in the report")
        .unit("N m")
        .value(run.report.ruptures.first().map_or(f64::NAN, |r| r.moment))
        .equals(moment)
        .relative(lag)
        .evidence(Evidence::Exact, "G A |slip|, the integrals of both slip rates")
        .because("as for the rate")
        .why_not_tighter("a lag of phase changes an integral over a whole pulse by less")
        .covers(&[Capability::DynamicRupture, Capability::Outputs])
        .cost(&run.cost)
        .record();
    vectors(ledger, &run, lag)?;
    tractions(ledger, &run)?;
    received(ledger, &run, lag)
}

/// Velocity and displacement along y of a wave of the pulse that has run this way: half of the slip.
fn released(way: f64, time: f64) -> [f64; 2] {
    let [[slip, _], [rate, _]] = exact((time - way).max(0.0));
    [0.5 * rate, 0.5 * slip]
}

/// The same at the receiver, which the wave passes on its way to the end and back from it.
fn passed(time: f64) -> [f64; 2] {
    let [out, back] = [RECEIVER, 2.0 * LENGTH - RECEIVER].map(|way| released(way, time));
    [out[0] + back[0], out[1] + back[1]]
}

/// Motions of a receiver between the fault and the end, and of the end.
fn received(ledger: &mut Ledger, run: &Waves, lag: f64) -> Result<(), CaseError> {
    let table = run.files.table("seismograms/S.csv")?;
    let times = table.column("time")?;
    // The wave passes on its way to the fault, which reflects it as a free end would.
    let ways = |t: f64| [t - (LENGTH - RECEIVER), t - (LENGTH + RECEIVER)];
    // The longest way, from the fault to the end and back to the receiver.
    let way = 2.0 - RECEIVER / LENGTH;
    for (column, unit, scale, exact) in [
        ("velocity_y", "m/s", 2.0 * TRACTION, (&|t| passed(t)[0]) as &dyn Fn(f64) -> f64),
        ("displacement_y", "m", 2.0 * TRACTION, &|t| passed(t)[1]),
        ("velocity_z", "m/s", WAVE, &|t| ways(t).map(velocity).iter().sum()),
        ("displacement_z", "m", WAVE, &|t| ways(t).map(|t| motion(t.max(0.0))).iter().sum()),
    ] {
        let expected: Vec<f64> = times.iter().map(|t| exact(*t)).collect();
        ledger
            .claim(format!("slip that a wave turns out of its direction: {column} of a receiver"))
            .unit(unit)
            .norm("largest difference")
            .values(&table.column(column)?)
            .equals_each(&expected)
            .absolute(way * lag * scale)
            .evidence(Evidence::Exact, "half of the slip of the pulse a travel time later, and again from the end, which is free along y; the wave on its way to the fault, and back from it as from a free end")
            .because("the shift of phase of the wave on its way; the pulse, which passes twice, grows in half of its duration")
            .covers(&[Capability::Waves, Capability::Solid3d, Capability::Outputs])
            .cost(&run.cost)
            .record();
    }
    let time = END * PASSING as f64 / FIELDS as f64;
    let fields = Fields::read(&run.files.text(&format!("fields/bodies_{PASSING:05}.vtu"))?)?;
    let last = |name: &str| -> Result<f64, CaseError> {
        let values = &fields.array(name)?.values;
        Ok(values[values.len() - 2])
    };
    // The end is free along y, so that it moves twice as far as the wave.
    let end = released(LENGTH, time).map(|value| 2.0 * value);
    ledger
        .claim("slip that a wave turns out of its direction: velocity and displacement of the end along y in the fields")
        .unit("m/s and m")
        .values(&[last("velocity")?, last("displacement")?])
        .equals_each(&end)
        .absolute(lag * TRACTION)
        .evidence(Evidence::Exact, "twice the wave of the pulse, a travel time after it")
        .because("the shift of phase of the wave on its way")
        .why_not_tighter("the pulse has only begun to arrive")
        .covers(&[Capability::Waves, Capability::Solid3d, Capability::Outputs])
        .cost(&run.cost)
        .record();
    Ok(())
}

/// Exact slip and slip rate at the station, along y and z.
fn exact(time: f64) -> [[f64; 2]; 2] {
    let n = 4000;
    let middle = |k: i32| time * (f64::from(k) + 0.5) / f64::from(n);
    let along: f64 = (0..n).map(|k| 2.0 * TRACTION * growth(middle(k), 1.0) * time / f64::from(n)).sum();
    [
        [along, 2.0 * motion(time - LENGTH)],
        [2.0 * TRACTION * growth(time, 1.0), 2.0 * velocity(time - LENGTH)],
    ]
}

/// Shear tractions of the station through time: friction along the slip rate in the same rows, whose signs are those of slip.
fn tractions(ledger: &mut Ledger, run: &Waves) -> Result<(), CaseError> {
    let table = run.files.table("stations/f_000")?;
    let along = |name: &str| [2, 3].map(|c| table.column(&format!("{name}_{c}")));
    let (slips, rates, shears) = (along("slip"), along("slip_rate"), along("shear_stress"));
    let [slips, rates, shears] =
        [slips, rates, shears].map(|both| both.into_iter().collect::<Result<Vec<_>, _>>());
    let (slips, rates, shears) = (slips?, rates?, shears?);
    let (mut worst, mut across) = (0.0_f64, 0.0_f64);
    // Of the direction of the first half step nothing is known.
    for k in 2..slips[0].len() - 1 {
        let way = |c: usize| 10.0_f64.powf(rates[c][k]) * (slips[c][k + 1] - slips[c][k - 1]).signum();
        let size = way(0).hypot(way(1));
        for (c, shears) in shears.iter().enumerate() {
            worst = worst.max((1e6 * shears[k] / FRICTION - way(c) / size).abs());
        }
        across = across.max(way(1) / size);
    }
    if across < 0.5 {
        return Err("slip does not turn".into());
    }
    let turn = 0.5 * run.report.step * TAU * 0.5;
    ledger
        .claim("slip that a wave turns out of its direction: shear_stress_2 and shear_stress_3 of the station in all rows, over friction, largest error")
        .value(worst)
        .at_most(turn)
        .evidence(Evidence::Exact, "friction has the direction of the slip rate, whose components are in the same rows")
        .because("friction is along the slip rate of a half step, the rows have the mean of two: half a step times the pace at which a wave of a period of 1 s and of half the slip rate turns it, 2 pi/2")
        .why_not_tighter("slip turns fastest for a moment only")
        .covers(&[Capability::DynamicRupture, Capability::Solid3d, Capability::Outputs])
        .cost(&run.cost)
        .record();
    Ok(())
}

/// Vectors of slip and slip rate at the station, and in the fields while the wave passes.
fn vectors(ledger: &mut Ledger, run: &Waves, lag: f64) -> Result<(), CaseError> {
    let time = END * PASSING as f64 / FIELDS as f64;
    let [slip, rate] = exact(time);
    let fields = Fields::read(&run.files.text(&format!("fields/f_{PASSING:05}.vtu"))?)?;
    // The last point, along y and z.
    let last = |name: &str| -> Result<[f64; 2], CaseError> {
        let values = &fields.array(name)?.values;
        let n = values.len();
        Ok([*values.get(n - 2).ok_or("no values")?, values[n - 1]])
    };
    let shear = last("shear_traction")?.map(f64::abs);
    let normal = *fields.array("normal_traction")?.values.last().ok_or("no values")?;
    let pvd = run.files.text("fields.pvd")?;
    let file =
        pvd.lines().find(|line| line.contains(&format!("f_{PASSING:05}.vtu"))).ok_or("no such file")?;
    let named = file.split("timestep=\"").nth(1).and_then(|t| t.split('"').next()).ok_or("no time")?;
    let table = run.files.table("stations/f_000")?;
    let row = table.column("t")?.iter().position(|t| (t - time).abs() < 1e-6).ok_or("no such row")?;
    let at = |name: &str| -> Result<f64, CaseError> { Ok(table.column(name)?[row]) };
    let most = 2.0 * WAVE;
    for (what, unit, found, exact, scale) in [
        ("slip in the fields, along y and z", "m", last("slip")?, slip, most),
        ("slip rate in the fields, along y and z", "m/s", last("slip_rate")?, rate, most),
        ("slip of the station, in both directions", "m", [at("slip_2")?, at("slip_3")?], slip, most),
        (
            "slip rate of the station, in both directions",
            "m/s",
            [10.0_f64.powf(at("slip_rate_2")?), 10.0_f64.powf(at("slip_rate_3")?)],
            rate,
            most,
        ),
        (
            "normal traction in the fields, and their time in the collection",
            "Pa and s",
            [normal, named.parse()?],
            [1.0, time],
            1.0,
        ),
        ("shear traction in the fields, beyond a friction of 1e-9", "Pa", shear, [0.0; 2], most),
    ] {
        ledger
            .claim(format!("slip that a wave turns out of its direction, while it passes: {what}"))
            .unit(unit)
            .values(&found)
            .equals_each(&exact)
            .absolute(lag * scale)
            .evidence(
                Evidence::Exact,
                "2 A G(t) along the rake and twice the wave across it, positive along normal x rake",
            )
            .because("the shift of phase of the wave on its way")
            .why_not_tighter(
                "the wave is nearly at its largest velocity, which a shift of phase changes least",
            )
            .covers(&[Capability::DynamicRupture, Capability::Solid3d, Capability::Outputs])
            .cost(&run.cost)
            .record();
    }
    Ok(())
}
