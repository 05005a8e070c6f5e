//! Two blocks whose normal traction follows ramps: time open, and time and slip below the floor.

use super::{A, PRESSED, YOUNG, block};
use crate::cases::output_files::vtu::Fields;
use crate::cases::run_files::WrittenRun;
use crate::{Capability, CaseError, Evidence, Ledger};
use asperity_run::report::Outcome;

/// Height of the blocks \[m\], and duration of the runs \[s\].
const HEIGHT: f64 = 600.0;
const END: f64 = 100.0;
/// Longest step \[s\]: what moves the blocks is given at so many times.
const STEP: f64 = 0.5;

/// Claims the use of openings and of floors.
pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    open(ledger)?;
    in_space(ledger)?;
    below(ledger)
}

/// Two blocks without lateral contraction in the plane, each of this length \[m\]; `fault` holds further keys of the fault, `x` and `y` the
/// motions of the right side.
fn blocks(length: f64, fault: &str, [x, y]: [&str; 2], more: &str) -> String {
    let (left, right) = (block("L", [-length, 0.0], true, "quad4"), block("R", [0.0, length], true, "quad4"));
    format!(
        r#"
schema = 1
title = "two blocks"
kinematics = "plane-strain"
[materials.rock]
young = {YOUNG:?}
poisson = 0.0
density = 2670.0
{left}{right}[faults.main]
minus = "L.right"
plus = "R.left"
{fault}
[[stages]]
name = "pulled"
duration = {END:?}
conditions = [{{ set = "L.left", x = 0, y = 0 }}, {{ set = "R.right", x = {x}, y = {y} }}]
[time]
stepper = "fault-ode"
method = "stabilised"
{more}
"#
    )
}

/// Table through these times and values, with entries in between so that no step is longer than `step` \[s\].
fn table(corners: &[[f64; 2]], step: f64) -> String {
    let mut rows = vec![format!("[{:?}, {:?}]", corners[0][0], corners[0][1])];
    for pair in corners.windows(2) {
        let ([t0, u0], [t1, u1]) = (pair[0], pair[1]);
        let parts = ((t1 - t0) / step).ceil();
        let at = |k: f64| format!("[{:?}, {:?}]", t0 + k / parts * (t1 - t0), u0 + k / parts * (u1 - u0));
        rows.extend((1..=parts as usize).map(|k| at(k as f64)));
    }
    format!("{{ table = [{}] }}", rows.join(", "))
}

/// Time at which a way between two corners is passed \[s\].
fn passed([[t0, u0], [t1, u1]]: [[f64; 2]; 2], way: f64) -> f64 {
    t0 + (way - u0) / (u1 - u0) * (t1 - t0)
}

/// Blocks that are pulled apart and pushed together again: they are open from where nothing presses any more to where something
/// presses again.
fn open(ledger: &mut Ledger) -> Result<(), CaseError> {
    let law = r#"law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.02, b = 0.015, l = "0.1 m", v_ref = "1 um/s", v_initial = "1e-12 m/s" }"#;
    let fault = format!(
        "{law}\nnormal = {PRESSED:?}\nnormal_floor = \"10 kPa\"\nopening = true\nrate = \"1e-12 m/s\"\ndamping = \"radiation\""
    );
    let way = PRESSED * 2.0 * A / YOUNG;
    let [first, top, last] = [[0.0, 0.0], [40.0, 4.0 * way], [60.0, 0.0]];
    // A second run ends where the blocks are farthest apart.
    for (corners, end, share) in [
        (vec![first, top, last, [END, 0.0]], 0.0, passed([top, last], way) - passed([first, top], way)),
        (
            vec![first, [40.0, 0.0], [END, 4.0 * way]],
            3.0 * way,
            END - passed([[40.0, 0.0], [END, 4.0 * way]], way),
        ),
    ] {
        let peak = if end > 0.0 { END } else { top[0] };
        let station = format!("[output]\nstations.main = [{:?}]\n", 0.5 * HEIGHT);
        let done = WrittenRun::from_text(&blocks(A, &fault, [&table(&corners, STEP), "0"], &station))?;
        if done.report.outcome != Outcome::Completed {
            return Err(format!("{:?}", done.report.outcome).into());
        }
        let found = done.report.openings.first().ok_or("no openings")?;
        let what = if end > 0.0 { "pulled apart" } else { "pulled apart and closed again" };
        through(ledger, &done, what, &corners)?;
        ledger
            .claim(format!("blocks that are {what}: share of the time during which a point is open"))
            .value(found.time_share)
            .equals(share / END)
            .absolute(STEP / END)
            .evidence(Evidence::Exact, "a ramp: from where the way exceeds f_n l/E to where it falls below")
            .because("half of the step in which a point opens or closes counts, which is half a second long at most")
            .why_not_tighter("where steps fall is up to the integrator")
            .covers(&[Capability::FaultCycles, Capability::Outputs])
            .cost(&done.cost)
            .record();
        ledger
            .claim(format!("blocks that are {what}: largest opening and volume of the openings at the end over its area, over the way"))
            .values(&[found.largest / way, found.volume / (HEIGHT * way)])
            .equals_each(&[3.0, end / way])
            .absolute(1e-8)
            .evidence(Evidence::Exact, "way - f_n l/E")
            .because("a patch test: rounding of the elimination, and of f_n, which is integrated under a constant rate")
            .why_not_tighter("the rounding of an elimination differs between processors")
            .covers(&[Capability::FaultCycles, Capability::Outputs])
            .cost(&done.cost)
            .record();
        ledger
            .claim(format!("blocks that are {what}: time of the largest opening"))
            .unit("s")
            .value(found.when)
            .equals(peak)
            .absolute(1e-9)
            .evidence(Evidence::Exact, "the time at which the way is largest")
            .because("steps end where loads turn: rounding of times")
            .why_not_tighter("rounding of times; a step is some million times as long")
            .covers(&[Capability::FaultCycles, Capability::Outputs])
            .cost(&done.cost)
            .record();
        let counts = [found.points, found.open].map(|n| n as u64);
        let wanted = [found.of as u64, if end > 0.0 { found.of as u64 } else { 0 }];
        ledger
            .claim(format!("blocks that are {what}: points that were open, or are open at the end, and should not be, or the reverse"))
            .count(counts.iter().zip(wanted).map(|(a, b)| a.abs_diff(b)).sum(), 0)
            .evidence(Evidence::Exact, "all points of two blocks part together")
            .because("a count")
            .covers(&[Capability::FaultCycles, Capability::Outputs])
            .cost(&done.cost)
            .record();
    }
    Ok(())
}

/// Way of the load at a time \[m\].
fn way_at(corners: &[[f64; 2]], time: f64) -> f64 {
    let k = (1..corners.len() - 1).find(|&k| time <= corners[k][0]).unwrap_or(corners.len() - 1);
    let ([t0, u0], [t1, u1]) = (corners[k - 1], corners[k]);
    u0 + (time - t0) / (t1 - t0) * (u1 - u0)
}

/// Openings in the file of a station and in the profiles, in all rows.
fn through(
    ledger: &mut Ledger,
    done: &WrittenRun,
    what: &str,
    corners: &[[f64; 2]],
) -> Result<(), CaseError> {
    let closed = PRESSED * 2.0 * A / YOUNG;
    let wanted = |time: f64| (way_at(corners, time) - closed).max(0.0) / closed;
    let name = done.files.names("stations")?.pop().ok_or("no station")?;
    let station = done.files.table(&format!("stations/{name}"))?;
    let rows = station.column("t")?.into_iter().zip(station.column("opening")?);
    let off = rows.map(|(time, found)| (found / closed - wanted(time)).abs()).fold(0.0, f64::max);
    let profiles = done.files.table("opening_profiles.csv")?.numbers();
    let each = |row: &Vec<f64>| -> f64 {
        row[1..].iter().map(|found| (found / closed - wanted(row[0])).abs()).fold(0.0, f64::max)
    };
    let open = profiles.iter().filter(|row| wanted(row[0]) > 0.1).count();
    let [first, last] = [profiles.first(), profiles.last()].map(|row| row.map_or(f64::NAN, |row| row[0]));
    if open < 3 || (first, last) != (0.0, END) {
        return Err(format!("{open} profiles of open points from {first} to {last} s").into());
    }
    for (place, off, bound, digits) in [
        ("the file of a station", off, 1e-8, "ten"),
        ("opening_profiles.csv, at all points", profiles.iter().map(each).fold(0.0, f64::max), 1e-6, "seven"),
    ] {
        ledger
            .claim(format!("blocks that are {what}: opening in {place} through time, largest error over the way at which they part"))
            .value(off)
            .at_most(bound)
            .evidence(Evidence::Exact, "way - f_n l/E where that is positive, at the times of the rows")
            .because(format!("the file has {digits} digits"))
            .why_not_tighter("the last digit may be off by any part of a half")
            .covers(&[Capability::FaultCycles, Capability::Outputs])
            .cost(&done.cost)
            .record();
    }
    Ok(())
}

/// Blocks in space that are pulled apart at a steady rate: opening in all fields, at the times of the list of snapshots.
fn in_space(ledger: &mut Ledger) -> Result<(), CaseError> {
    let body = |name: &str, from: f64| {
        format!(
            "[bodies.{name}]\nmaterial = \"rock\"\nmesh.block = {{ min = [{from:?}, 0, 0], max = [{:?}, 60, 40], divisions = [1, 1, 1], element = \"hex8\" }}\n",
            from + SHORT
        )
    };
    let closed = PRESSED * 2.0 * SHORT / YOUNG;
    let rate = 4.0 * closed / END;
    let text = format!(
        "schema = 1\ntitle = \"two blocks in space\"\nkinematics = \"3d\"\n[materials.rock]\nyoung = {YOUNG:?}\npoisson = 0.0\ndensity = 2670.0\n{}{}\
         [faults.main]\nminus = \"L.right\"\nplus = \"R.left\"\nrake = [0, 0, 1]\nnormal = {PRESSED:?}\nnormal_floor = \"10 kPa\"\nopening = true\n\
         rate = \"1e-12 m/s\"\ndamping = \"radiation\"\n\
         law = {{ kind = \"rate-and-state\", evolution = \"ageing\", mu0 = 0.6, a = 0.02, b = 0.015, l = \"0.1 m\", v_ref = \"1 um/s\", v_initial = \"1e-12 m/s\" }}\n\
         [[stages]]\nname = \"pulled\"\nduration = {END:?}\n\
         conditions = [{{ set = \"L.left\", x = 0, y = 0, z = 0 }}, {{ set = \"R.right\", x = {{ rate = {rate:e} }}, y = 0, z = 0 }}]\n\
         [time]\nstepper = \"fault-ode\"\nmethod = \"stabilised\"\n",
        body("L", -SHORT),
        body("R", 0.0),
    );
    let done = WrittenRun::from_text(&text)?;
    let list = done.files.table("snapshots.csv")?;
    let (mut found, mut wanted) = (Vec::new(), Vec::new());
    let mut times = list.column("time")?;
    let mut names: Vec<String> =
        list.words("snapshot")?.iter().map(|number| format!("main_{number:0>5}")).collect();
    times.push(END);
    names.push("main_end".into());
    for (name, time) in names.iter().zip(&times) {
        let fields = Fields::read(&done.files.text(&format!("fields/{name}.vtu"))?)?;
        found.extend(fields.array("opening")?.values.iter().map(|opening| opening / closed));
        wanted.extend([(rate * time / closed - 1.0).max(0.0); 4]);
    }
    if wanted.iter().filter(|opening| **opening > 0.1).count() < 12 {
        return Err("fewer than three fields of open sides".into());
    }
    ledger
        .claim("blocks in space that are pulled apart: opening in the fields at all points, at the times in snapshots.csv and at the end, over the way at which they part")
        .values(&found)
        .equals_each(&wanted)
        .absolute(1e-8)
        .evidence(Evidence::Exact, "V t - f_n l/E where that is positive")
        .because("a patch test: rounding of the elimination; times have fifteen digits")
        .why_not_tighter("the rounding of an elimination differs between processors")
        .covers(&[Capability::FaultCycles, Capability::Solid3d, Capability::Outputs])
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Floor, and normal traction at the start and at its least \[Pa\].
const FLOOR: f64 = 1e6;
const PRESSES: [f64; 2] = [2e6, 0.25e6];
/// Slip rates of the load \[m/s\], and the times at which the faster one acts \[s\]: below the floor and above.
const RATES: [f64; 2] = [1e-3, 3e-3];
const FAST: [[f64; 2]; 2] = [[30.0, 45.0], [70.0, 80.0]];
/// Length of either block \[m\].
const SHORT: f64 = 100.0;
/// Longest step while normal tractions change \[s\].
const LONG: f64 = 5.0;
/// Friction of the blocks: so little that they hardly lag behind their load.
const FRICTION: f64 = 1e-3;

/// Times \[s\] and ways \[m\] of the load at the corners of its course.
fn course() -> Vec<[f64; 2]> {
    let mut drawn = vec![[0.0, 0.0]];
    for t in FAST.into_iter().flatten().chain([END]) {
        let [before, so_far] = drawn[drawn.len() - 1];
        let rate = RATES[usize::from(drawn.len() % 2 == 0)];
        drawn.push([t, so_far + rate * (t - before)]);
    }
    drawn
}

/// Time \[s\] and slip \[m\] below the floor, which a fault passes at the way `at` of its opening.
fn below_floor(corners: &[[f64; 2]; 4], at: f64) -> [f64; 2] {
    let (from, to) = (passed([corners[0], corners[1]], at), passed([corners[1], corners[2]], at));
    let faster = (FAST[0][1] - FAST[0][0]) * (RATES[1] - RATES[0]);
    [to - from, RATES[0] * (to - from) + faster]
}

/// Blocks that slide past each other, faster at times, while normal traction falls below its floor and rises again.
fn below(ledger: &mut Ledger) -> Result<(), CaseError> {
    let fault = format!(
        "law = {{ kind = \"rate\", mu0 = {FRICTION:?}, a = 2e-4, v_ref = \"1 mm/s\" }}\n\
         normal = {:?}\nnormal_floor = {FLOOR:?}\nrate = {:?}",
        PRESSES[0], RATES[0]
    );
    let compliance = 2.0 * SHORT / YOUNG;
    let way = (PRESSES[0] - PRESSES[1]) * compliance;
    let corners = [[0.0, 0.0], [40.0, way], [60.0, 0.0], [END, 0.0]];
    let drawn = course();
    let events = "[events]\nabove = \"2 mm/s\"\nbelow = \"1.5 mm/s\"";
    let text = blocks(SHORT, &fault, [&table(&corners, LONG), &table(&drawn, LONG)], events);
    let done = WrittenRun::from_text(&text)?;
    if done.report.outcome != Outcome::Completed {
        return Err(format!("{:?}", done.report.outcome).into());
    }
    let found = done.report.floors.first().ok_or("no floor")?;
    let [time, slip] = below_floor(&corners, (PRESSES[0] - FLOOR) * compliance);
    let shares = [time / END, slip / drawn[drawn.len() - 1][1]];
    let ramps = "ramps: f_n = f_0 - E u/(2 l), and slip at the rate of the load, which is three times as fast for a while";
    let mirrored = "both blocks are equal, so that slip changes no normal traction, which is linear within steps: rounding";
    let rounding =
        "rounding depends on the number of steps; steps that cross the floor are a millionth of the run";
    let lag = "slip is behind the load by friction over G/(2 l), which is the same where the floor is crossed down and up, but for a f_n times the relative difference of slip rates, mu0 f_n'/(k V) of up to 6e-4: 1e-9 m of 0.14 m";
    let chance =
        "it is an estimate of the difference, which is smaller where slip rates are nearly those of the load";
    for (what, value, wanted, bound, because, loose) in [
        ("share of the time below it", found.time_share, shares[0], 1e-10, mirrored, rounding),
        ("share of the slip below it", found.slip_share, shares[1], 2e-8, lag, chance),
        (
            "least normal traction over that of the ramp",
            found.least / PRESSES[1],
            1.0,
            1e-9,
            mirrored,
            rounding,
        ),
    ] {
        ledger
            .claim(format!("blocks that slide while normal traction falls below its floor and rises: {what}"))
            .value(value)
            .equals(wanted)
            .absolute(bound)
            .evidence(Evidence::Exact, ramps)
            .because(because)
            .why_not_tighter(loose)
            .covers(&[Capability::FaultCycles, Capability::Outputs])
            .cost(&done.cost)
            .record();
    }
    let off =
        [found.events.abs_diff(1), found.points.abs_diff(found.of), done.report.events.len().abs_diff(2)];
    ledger
        .claim("the same blocks: events below the floor, events in all, and points below it, differences from one, two and all")
        .count(off.iter().sum::<usize>() as u64, 0)
        .evidence(Evidence::Exact, "the load is fast twice, once of them while normal traction is below its floor")
        .because("a count")
        .covers(&[Capability::FaultCycles, Capability::Events, Capability::Outputs])
        .cost(&done.cost)
        .record();
    Ok(())
}
