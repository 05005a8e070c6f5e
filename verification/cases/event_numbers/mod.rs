//! Quantities derived from fault events, in output files: moment, area, slip, stress drop, hypocentre, magnitude.

mod history;
mod points;
mod slow;

use crate::cases::run_files::WrittenRun;
use crate::{Capability, Case, CaseError, Evidence, Ledger};
use history::Histories;

/// See the README.
pub const CASE: Case = Case {
    name: "event_numbers",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::Antiplane, Capability::Events, Capability::Outputs],
    quick: true,
    run,
};

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    pairs(ledger)?;
    stable(ledger)?;
    slow::claims(ledger)?;
    rupture(ledger)
}

/// Shear moduli of the soft and the stiff rock \[Pa\], and their densities \[kg/m³\].
const MODULI: [f64; 2] = [10e9, 40e9];
const DENSITIES: [f64; 2] = [2500.0, 3000.0];
/// Slip rates at which events begin and end \[m/s\].
const ON: f64 = 1e-3;
const OFF: f64 = 1e-4;

/// Shear modulus of the uniform medium in which slip loads its plane as it does between the two rocks \[Pa\].
fn modulus() -> f64 {
    2.0 * MODULI[0] * MODULI[1] / (MODULI[0] + MODULI[1])
}

/// Traction per slip rate radiated by shear waves to both sides \[Pa s/m\].
fn damping() -> f64 {
    let [soft, stiff] = [0, 1].map(|k: usize| (MODULI[k] * DENSITIES[k]).sqrt());
    1.0 / (1.0 / soft + 1.0 / stiff)
}

/// Stiffness of two blocks in series, each 1 km wide \[Pa/m\].
fn spring() -> f64 {
    1.0 / (1e3 / MODULI[0] + 1e3 / MODULI[1])
}

/// Source of the modulus of moments.
const SERIES: &str =
    "2 G1 G2/(G1 + G2): the uniform medium in which slip on its plane causes the same tractions";

/// A pair of blocks that slips uniformly, beside a pair that creeps.
fn pairs(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = WrittenRun::from_text(include_str!("pairs.toml"))?;
    let events = done.files.table("events.csv")?;
    let of = |name: &str| events.only(name);
    let [slip, duration, moment] = [of("mean_slip")?, of("duration")?, of("moment")?];
    let area = 1e3;
    ledger
        .claim("area of an event of one pair of blocks beside another that is three times as high and creeps")
        .unit("m")
        .value(of("area")?)
        .equals(area)
        .relative(1e-12)
        .evidence(Evidence::Exact, "height of the blocks that slip: the others slip by 1e-8 m")
        .because("rounding of the sum of two nodal areas")
        .why_not_tighter("rounding depends on the mesh; a node more or less is of the order of one")
        .cost(&done.cost)
        .record();
    ledger
        .claim("moment of a uniform event between rocks of 10 and 40 GPa over area and mean slip")
        .unit("Pa")
        .value(moment / (area * slip))
        .equals(modulus())
        .relative(1e-12)
        .evidence(Evidence::Exact, SERIES)
        .because("rounding: all numbers of the file are written to the last digit")
        .why_not_tighter(
            "rounding depends on the machine; a digit that the file lacked would show at 1e-10 or above",
        )
        .cost(&done.cost)
        .record();
    let lost = spring() * (slip - 1e-9 * duration) - damping() * (ON - OFF);
    ledger
        .claim("stress drop of a uniform event between rocks of 10 and 40 GPa")
        .unit("Pa")
        .value(of("stress_drop")?)
        .equals(lost)
        .relative(1e-9)
        .evidence(
            Evidence::Exact,
            "1/(H/G1 + H/G2) (slip - load), less radiation Z1 Z2/(Z1 + Z2) at the rates that begin and end it",
        )
        .because("tractions and slip are integrated side by side, with a tolerance of 1e-9 of ln V a step")
        .why_not_tighter("the tolerance is of one step; how many of them add up depends on the path")
        .cost(&done.cost)
        .record();
    ledger
        .claim("rupture length of the same event")
        .unit("m")
        .value(of("rupture_length")?)
        .equals(area)
        .relative(1e-12)
        .evidence(Evidence::Exact, "height of the blocks that slip, whose nodes are their ends")
        .because("rounding of a difference of positions")
        .why_not_tighter("rounding depends on the mesh; a node more or less is of the order of one")
        .cost(&done.cost)
        .record();
    // The catalogue of its own fault excludes the creep of the other.
    let own = done.report.faults.iter().find(|f| f.surface == "rupture").and_then(|f| f.events.first());
    let magnitude = own.and_then(|e| e.located.as_ref()?.magnitude).ok_or("no magnitude")?;
    for (found, place) in [(of("magnitude")?, " in the table of events"), (magnitude, " on 60 km of fault")] {
        ledger
            .claim(format!("moment magnitude of the same event{place}"))
            .value(found)
            .equals((modulus() * area * slip * 60e3).log10() / 1.5 - 9.1 / 1.5)
            .absolute(1e-12)
            .evidence(Evidence::Exact, "Mw = (log10 M0 - 9.1)/1.5 with M0 in N m, standard of IASPEI (2013)")
            .because("rounding")
            .why_not_tighter("rounding depends on the machine; the constants that are in use differ by 1e-3")
            .cost(&done.cost)
            .record();
    }
    points::faults(ledger, &done)?;
    nucleates(ledger, &done)
}

/// Claims hypocentre and slip of the uniform event.
fn nucleates(ledger: &mut Ledger, done: &WrittenRun) -> Result<(), CaseError> {
    let events = done.files.table("events.csv")?;
    let on_its_fault = events.words("surface")? == ["rupture"] && events.only("y")? >= -3e3 - 1e-6;
    ledger
        .claim("events of the pair that weakens whose hypocentre lies on the other pair")
        .count(u64::from(!on_its_fault), 0)
        .evidence(Evidence::Exact, "the other pair never slips faster than it is drawn")
        .because("a count")
        .cost(&done.cost)
        .record();
    let histories = Histories::read(&done.files, &["rupture_dp000"])?;
    let (from, to) = (events.only("onset")?, events.only("onset")? + events.only("duration")?);
    ledger
        .claim("mean slip of the same event against slip in the file of its station between onset and end")
        .unit("m")
        .value(events.only("mean_slip")?)
        .equals(histories.slipped(0, from, to))
        .relative(3e-8)
        .evidence(Evidence::Exact, "cubic between rows, from their slip and slip rates")
        .because("the catalogue has 15 digits of the onset: half of 1e-5 s at 1 mm/s is 5e-9 m of 0.4 m; the slip of rows has ten digits")
        .why_not_tighter("the last digit of the onset may be off by any part of a half")
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Blocks that slide steadily at 1 m/s, after 1 mm/s.
fn stable(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = WrittenRun::from_text(include_str!("stable.toml"))?;
    let rows = done.files.table("stations/main_dp000")?;
    let (times, slips) = (rows.column("t")?, rows.column("slip")?);
    let (time, slip) = times.iter().zip(&slips).next_back().ok_or("no row")?;
    let (before, after): (f64, f64) = (1e-3, 1.0);
    let friction = 50e6 * 0.005 * (after / before).ln();
    ledger
        .claim(
            "slip of blocks between rocks of 10 and 40 GPa behind their load, steadily at 1 m/s after 1 mm/s",
        )
        .unit("m")
        .value(after * time - slip)
        .equals((friction + damping() * (after - before)) / spring())
        .relative(1e-8)
        .evidence(
            Evidence::Exact,
            "[f_n (a - b) ln(V/V0) + Z1 Z2/(Z1 + Z2) (V - V0)]/k, k that of two blocks in series",
        )
        .because("rows have ten digits of 20 m: 5e-9 m of 0.6 m")
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Spacing of the points of the fault \[m\], and their number.
const APART: f64 = 250.0;
const POINTS: usize = 25;
/// Fraction of the largest slip above which a point counts as slipped, see NOTATION.
const SLIPPED: f64 = 0.01;

/// Length of the fault that belongs to a point \[m\].
fn share(point: usize) -> f64 {
    if point == 0 || point + 1 == POINTS { 0.5 * APART } else { APART }
}

/// Growth of the slip rate in a step at the onset or the end of an event, of itself, at most.
const GROWTH: f64 = 0.12;

/// Error of the trapezoidal rule over the rows of an event, relative.
const ROWS: f64 = 1e-4;

/// Sums over the points of an event, from the files of its stations.
struct Sums {
    area: f64,
    potency: f64,
    /// Slip over the area of all points, also of those that hardly slip.
    all: f64,
    work: f64,
    largest: f64,
    fastest: usize,
    /// Slip rate at the onset over the area of all points.
    rate: f64,
}

impl Sums {
    fn from_histories(histories: &Histories, from: f64, to: f64) -> Self {
        let slips: Vec<f64> = (0..POINTS).map(|k| histories.slipped(k, from, to)).collect();
        let largest = slips.iter().copied().fold(0.0, f64::max);
        let (mut area, mut potency, mut work) = (0.0, 0.0, 0.0);
        let all = slips.iter().enumerate().map(|(k, slip)| share(k) * slip.abs()).sum();
        for (k, &slip) in slips.iter().enumerate().filter(|(_, s)| **s > SLIPPED * largest) {
            let share = share(k);
            area += share;
            potency += share * slip;
            work += share * slip * histories.fell(k, from, to);
        }
        let rates: Vec<f64> = (0..POINTS).map(|k| histories.rate(k, from)).collect();
        let fastest = (0..POINTS).max_by(|&a, &b| rates[a].total_cmp(&rates[b])).unwrap_or(POINTS);
        let rate = rates.iter().enumerate().map(|(k, rate)| share(k) * rate.abs()).sum();
        Self { area, potency, all, work, largest, fastest, rate }
    }
}

/// Claims of an event with non-uniform slip.
fn rupture(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = WrittenRun::from_text(include_str!("rupture.toml"))?;
    let events = done.files.table("events.csv")?;
    let of = |name: &str| events.only(name);
    let (from, to) = (of("onset")?, of("onset")? + of("duration")?);
    let sums = Sums::from_histories(&Histories::read(&done.files, &done.files.names("stations")?)?, from, to);
    let cubics = "files of stations at all points, with cubics between rows; nodal areas of cells of 250 m";
    let digits = "the catalogue has 15 digits of the onset: half of 1e-5 s at 1 mm/s is 5e-9 m of 2 m; the slip of rows has ten digits";
    let between = "polynomials through four and through six rows differ by 3e-7 at the onset, where tractions fall fast";
    for (name, unit, expected, (bound, because)) in [
        ("area", "m", sums.area, (1e-12, "rounding of nodal areas")),
        ("largest_slip", "m", sums.largest, (1e-8, digits)),
        ("mean_slip", "m", sums.potency / sums.area, (1e-8, digits)),
        ("moment", "N", modulus() * sums.potency, (1e-8, digits)),
        ("stress_drop", "Pa", sums.work / sums.potency, (1e-6, between)),
    ] {
        ledger
            .claim(format!("event on a fault between rocks of 10 and 40 GPa: {name} of the catalogue"))
            .unit(unit)
            .value(of(name)?)
            .equals(expected)
            .relative(bound)
            .evidence(Evidence::Exact, cubics)
            .because(because)
            .why_not_tighter("the last digits of onsets and rows may be off by any part of a half")
            .cost(&done.cost)
            .record();
    }
    ledger
        .claim("event on a fault between rocks of 10 and 40 GPa: place of the hypocentre along the fault")
        .unit("m")
        .value(of("hypocentre_along")?)
        .equals(APART * sums.fastest as f64)
        .absolute(1e-6)
        .evidence(Evidence::Exact, "the station that is the fastest at the onset, by its file")
        .because("rounding of a place")
        .why_not_tighter("a neighbouring point is hundreds of metres away")
        .cost(&done.cost)
        .record();
    rates(ledger, &done, (from, to))?;
    centroid(ledger, &done, (from, to))?;
    moment_rates(ledger, &done, &sums, to)?;
    points::claims(ledger, &done, [from, to])?;
    rupture_times(ledger, &done, (from, to))
}

/// Claims that the event lies between its thresholds, and its largest slip rate.
fn rates(ledger: &mut Ledger, done: &WrittenRun, (from, to): (f64, f64)) -> Result<(), CaseError> {
    let events = done.files.table("events.csv")?;
    let histories = Histories::read(&done.files, &done.files.names("stations")?)?;
    let fastest = |time: f64| (0..POINTS).map(|k| histories.rate(k, time)).fold(0.0, f64::max);
    let falls = from + events.only("duration_above")?;
    ledger
        .claim("event on a fault between rocks of 10 and 40 GPa: slip rate of the fastest station at onset, at the end of the time above the upper threshold and at the end, over the thresholds")
        .values(&[fastest(from) / ON, fastest(falls) / ON, fastest(to) / OFF])
        .equals_each(&[1.0; 3])
        .absolute(2e-4)
        .evidence(Evidence::Exact, "what begins and ends an event: derivatives of cubics through rows of stations at all points")
        .because("where slip rates change by x = 0.2 from row to row, 0.2 s apart, as the event ends: x^3/125 of them, and 1e-9 m over 0.2 s at 1e-4 m/s, from the digits of slip")
        .cost(&done.cost)
        .record();
    let largest = (0..POINTS).map(|k| histories.largest(k, from, to)).fold(0.0, f64::max);
    ledger
        .claim("event on a fault between rocks of 10 and 40 GPa: its largest slip rate")
        .unit("m/s")
        .value(events.only("peak_rate")?)
        .equals(largest)
        .relative(2e-9)
        .evidence(Evidence::Exact, "largest slip rate of the rows of all stations")
        .because("a maximum has a row: half of the ninth decimal of log10 V is 1.2e-9 of V")
        .why_not_tighter("the last digit may be off by any part of a half")
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Depth of the upper end of the fault \[m\].
const UPPER: f64 = 1e3;

/// Claims slip of the points, and its centroid in the report and in the file for seismologists.
fn centroid(ledger: &mut Ledger, done: &WrittenRun, (from, to): (f64, f64)) -> Result<(), CaseError> {
    let slips = done.files.table("events/rupture_times_000.csv")?.column("slip")?;
    let histories = Histories::read(&done.files, &done.files.names("stations")?)?;
    let largest = slips.iter().copied().fold(0.0, f64::max);
    let slipped = slips.iter().enumerate().filter(|(_, slip)| **slip > SLIPPED * largest);
    let off = slipped.map(|(k, slip)| (slip - histories.slipped(k, from, to)).abs() / largest);
    ledger
        .claim("slip of the points that slipped in an event, largest error over the largest slip")
        .value(off.fold(if slips.len() == POINTS { 0.0 } else { f64::NAN }, f64::max))
        .at_most(2e-8)
        .evidence(Evidence::Exact, "files of their stations, with cubics between rows")
        .because("a cubic misses x^4/384 of the slip of a step, in which the slip rate grows by x = 0.1 of itself at the onset, of some mm of 2 m, and less of others")
        .why_not_tighter("steps are up to the integrator")
        .cost(&done.cost)
        .record();
    let over = |f: &dyn Fn(usize) -> f64| (0..POINTS).map(|k| share(k) * slips[k] * f(k)).sum::<f64>();
    let middle = over(&|k| APART * k as f64) / over(&|_| 1.0);
    let located = done.report.events.first().and_then(|event| event.located.as_ref()).ok_or("no place")?;
    let text = done.files.text("CMTSOLUTION")?;
    let line = text.lines().find_map(|line| line.strip_prefix("depth:")).ok_or("no depth")?;
    for (place, found, bound, because) in [
        ("the report", located.centroid.depth, 1e-5, "slip has ten digits, over 6 km"),
        (
            "CMTSOLUTION",
            1e3 * line.trim().parse::<f64>()?,
            0.051,
            "four decimals of a kilometre, half of the last",
        ),
    ] {
        ledger
            .claim(format!(
                "event on a fault between rocks of 10 and 40 GPa: depth of its centroid in {place}"
            ))
            .unit("m")
            .value(found)
            .equals(UPPER + middle)
            .absolute(bound)
            .evidence(Evidence::Exact, "mean depth of all points, weighted by area times slip")
            .because(because)
            .why_not_tighter("the last digits may be off by any part of a half")
            .cost(&done.cost)
            .record();
    }
    Ok(())
}

/// Integral by the trapezoidal rule of rows of times and values.
fn integral<'a>(rows: impl Iterator<Item = &'a [f64; 2]>) -> f64 {
    let rows: Vec<&[f64; 2]> = rows.collect();
    rows.windows(2).map(|w| 0.5 * (w[1][0] - w[0][0]) * (w[0][1] + w[1][1])).sum()
}

/// Claims moment rates: of the event, and through the run.
fn moment_rates(ledger: &mut Ledger, done: &WrittenRun, sums: &Sums, end: f64) -> Result<(), CaseError> {
    let rows = done.files.table("events/moment_rate_000.csv")?.numbers();
    let rows: Vec<[f64; 2]> = rows.iter().map(|row| [row[0], row[1]]).collect();
    let (whole, half) = (integral(rows.iter()), integral(rows.iter().step_by(2)));
    ledger
        .claim("moment rate in the first row of its file, at the onset")
        .unit("N/s")
        .value(rows.first().ok_or("no row")?[1])
        .equals(modulus() * sums.rate)
        .relative(0.125 * GROWTH * GROWTH)
        .evidence(Evidence::Exact, "G times area times slip rate at all points: derivatives of cubics through rows of their stations")
        .because("the first row is linear between the ends of its step, which slip rates that grow by x miss by x^2/8; x is a tenth at most")
        .cost(&done.cost)
        .record();
    ledger
        .claim("integral of the moment rate of an event by its file, over G times the area times its slip at all points")
        .value(whole / (modulus() * sums.all))
        .equals(1.0)
        .absolute(ROWS)
        .evidence(Evidence::Exact, "slip in the files of stations at all points between onset and end")
        .because("the trapezoidal rule: that of every second row differs by three times its error")
        .cost(&done.cost)
        .record();
    ledger
        .claim("the same integral by every second row of the file")
        .value(half / (modulus() * sums.all))
        .equals(1.0)
        .absolute(4.0 * ROWS)
        .evidence(Evidence::Exact, "slip in the files of stations at all points between onset and end")
        .because("the trapezoidal rule with steps twice as long, of second order")
        .cost(&done.cost)
        .record();
    let table = done.files.table("moment_rate.csv")?;
    let (times, moments) = (table.column("time")?, table.column("moment of main")?);
    let last = times.partition_point(|t| *t <= end).saturating_sub(1);
    let histories = Histories::read(&done.files, &done.files.names("stations")?)?;
    let slips = (0..POINTS).map(|k| share(k) * histories.slipped(k, times[0], times[last]));
    ledger
        .claim("moment of the fault from the start to the last row in the event")
        .unit("N")
        .value(moments[last] - moments[0])
        .equals(modulus() * slips.sum::<f64>())
        .relative(1e-6)
        .evidence(Evidence::Exact, "G times area times slip in the files of stations at all points")
        .because("cubics between rows a hundredth of a decade apart, while the slip rate falls")
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Slip rate at which a point has ruptured \[m/s\], as the scene gives it.
const RUPTURED: f64 = 0.1;

/// Claims the rupture times and the largest slip rates of the points.
fn rupture_times(ledger: &mut Ledger, done: &WrittenRun, (from, to): (f64, f64)) -> Result<(), CaseError> {
    let table = done.files.table("events/rupture_times_000.csv")?;
    let names = done.files.names("stations")?;
    let histories = Histories::read(&done.files, &names)?;
    let (mut late, mut peak, mut missed) = (0.0_f64, 0.0_f64, 0);
    let mut turned = 0.0_f64;
    for (k, row) in table.numbers().iter().enumerate() {
        let [time, largest] = [row[4], row[5]];
        let expected = histories.first(k, RUPTURED, from, to);
        missed += u64::from(time.is_nan() != expected.is_none());
        if let Some(expected) = expected {
            late = late.max((time - (expected - from)).abs());
            turned = turned.max((largest / histories.largest(k, from, to) - 1.0).abs());
        }
        peak = peak.max((largest / histories.largest(k, from, to) - 1.0).abs());
    }
    let stations =
        "files of stations at all points, with ln V linear between rows a hundredth of a decade apart";
    ledger
        .claim("points of an event that have a rupture time and should have none, or the reverse")
        .count(missed, 0)
        .evidence(Evidence::Exact, stations)
        .because("a count")
        .cost(&done.cost)
        .record();
    ledger
        .claim("rupture times of the points of an event, largest error")
        .unit("s")
        .value(late)
        .equals(0.0)
        .absolute(LATE)
        .evidence(Evidence::Exact, stations)
        .because(
            "the catalogue has 15 digits of the onset, 1e-5 s; rows and steps interpolate the same curve",
        )
        .cost(&done.cost)
        .record();
    ledger
        .claim("largest slip rates of the points that ruptured in an event, largest relative error")
        .value(turned)
        .at_most(2e-9)
        .evidence(Evidence::Exact, "largest slip rate of the rows of their stations")
        .because("a point that ruptures is the fastest within the event, where a maximum has a row: half of the ninth decimal of log10 V is 1.2e-9 of V")
        .why_not_tighter("the last digits may be off by any part of a half")
        .cost(&done.cost)
        .record();
    ledger
        .claim("largest slip rates of the points of an event, largest relative error")
        .value(peak)
        .equals(0.0)
        .absolute(0.0233)
        .evidence(Evidence::Exact, stations)
        .because(
            "rows are a hundredth of a decade apart, where the rate of a point has no extremum in the event",
        )
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Error of rupture times \[s\].
const LATE: f64 = 5e-5;
