//! A fault of which a part ruptures: what tables and the report derive from slip and slip rates at its points.
//!
//! An imposed traction fades along the fault. Points of the middle represent a cell, and those at the ends for half of one. The
//! table of slip rates has a row at each step, so that all numbers follow from rows.

use crate::cases::run_files::{Table, Waves};
use crate::{Capability, CaseError, Evidence, Ledger};
use serde_json::Value;

/// Cells along the fault, and their size.
const ALONG: usize = 8;
const SIZE: f64 = 0.5;
/// Cells along a column, and steps.
const CELLS: usize = 20;
const STEPS: usize = 36;
const END: f64 = 0.9;
/// Slip rate at which a point has ruptured.
const RUPTURED: f64 = 0.3;
/// Shear modulus of moments, of rocks of the moduli 1 and 4.
const MODULUS: f64 = 2.0 * 1.0 * 4.0 / (1.0 + 4.0);
/// Stations, in places along the fault.
const STATIONS: [f64; 3] = [0.5, 1.0, 4.0];

fn scene(sense: f64) -> String {
    let body = |name: &str, from: i32, young: f64, density: f64| {
        format!(
            "[materials.{name}]\nyoung = {young:?}\npoisson = 0.25\ndensity = {density:?}\n[bodies.{name}]\nmaterial = \"{name}\"\n\
             mesh.block = {{ min = [{from}, 0], max = [{}, {:?}], divisions = [{CELLS}, {ALONG}], element = \"quad4\" }}\n",
            from + 1,
            SIZE * ALONG as f64
        )
    };
    let stations: Vec<String> = STATIONS.iter().map(|y| format!("[0, {y:?}]")).collect();
    format!(
        "schema = 1\ntitle = \"partial\"\nkinematics = \"antiplane\"\n{}{}\
         [faults.f]\nminus = \"a.right\"\nplus = \"b.left\"\nlaw = {{ kind = \"coulomb\", mu = 0.5 }}\nnormal = 1\n\
         shear = {:?}\npulses = [{{ traction = 0.5, centre = [0, 0.75], radius = 3, duration = 1 }}]\n\
         [[stages]]\nname = \"slip\"\nduration = {END:?}\nsteps = {STEPS}\n\
         conditions = [{{ set = \"a.left\", absorbing = true }}, {{ set = \"b.right\", absorbing = true }}]\n\
         [time]\nstepper = \"explicit\"\nviscosity = 0\n\
         [output]\nrupture_rate = {RUPTURED:?}\nsampling = {:?}\nprofiles = {STEPS}\nstations.f = [{}]\n",
        body("a", -1, 2.5, 1.0),
        body("b", 0, 10.0, 4.0),
        0.5 * sense,
        END / STEPS as f64,
        stations.join(", ")
    )
}

/// Area of each point: that of the cells around it, half of each.
fn area(point: usize) -> f64 {
    if point == 0 || point == ALONG { 0.5 * SIZE } else { SIZE }
}

/// Slip and slip rates of all points through time, and which points have ruptured.
struct Points {
    slip: Vec<Vec<f64>>,
    rate: Vec<Vec<f64>>,
    ruptured: Vec<bool>,
    place: Vec<f64>,
}

impl Points {
    fn read(run: &Waves, times: &Table) -> Result<Self, CaseError> {
        let rows = |name: &str| -> Result<Vec<Vec<f64>>, CaseError> {
            Ok(run.files.table(name)?.numbers().into_iter().map(|row| row[1..].to_vec()).collect())
        };
        let (slip, mut rate) = (rows("slip_profiles.csv")?, rows("rate_profiles.csv")?);
        rate.iter_mut().flatten().for_each(|log| *log = 10_f64.powf(*log));
        let ruptured = times.column("time")?.iter().map(|t| t.is_finite()).collect();
        let points = Self { slip, rate, ruptured, place: times.column("y")? };
        let whole = points.slip.len() == STEPS + 1 && points.rate.len() == STEPS + 1;
        if whole && points.place.len() == ALONG + 1 {
            Ok(points)
        } else {
            Err("rows or points are missing".into())
        }
    }

    /// A sum over points, times their areas.
    fn over(&self, value: impl Fn(usize) -> f64) -> f64 {
        (0..=ALONG).map(|p| value(p) * self.area(p)).sum()
    }

    fn area(&self, point: usize) -> f64 {
        area((self.place[point] / SIZE).round() as usize)
    }

    fn largest(&self, point: usize) -> f64 {
        self.rate.iter().map(|row| row[point].abs()).fold(0.0, f64::max)
    }
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let run = Waves::from_text(&scene(1.0))?;
    backwards(ledger, &run)?;
    let times = run.files.table("rupture_times.csv")?;
    let points = Points::read(&run, &times)?;
    moments(ledger, &run, &points)?;
    report(ledger, &run, &points)?;
    stations(ledger, &run, &points)?;
    places(ledger, &run, &points, &times)?;
    let exact: Vec<f64> = (0..=ALONG).map(|p| points.largest(p)).collect();
    ledger
        .claim("a fault that ruptures in part: largest slip rates in the table of rupture times")
        .unit("m/s")
        .values(&times.column("largest slip_rate")?)
        .equals_each(&exact)
        .absolute(1e-9)
        .evidence(
            Evidence::Exact,
            "the largest of the slip rates of all steps, which the rows of profiles hold",
        )
        .because("profiles have ten digits")
        .why_not_tighter("the last digit may be off by a half")
        .covers(&[Capability::DynamicRupture, Capability::Outputs])
        .cost(&run.cost)
        .record();
    Ok(())
}

/// Slip the other way: its profiles keep its sign, and nothing else changes.
fn backwards(ledger: &mut Ledger, forwards: &Waves) -> Result<(), CaseError> {
    let run = Waves::from_text(&scene(-1.0))?;
    for (file, sign) in [
        ("rate_profiles.csv", 1.0),
        ("slip_profiles.csv", -1.0),
        ("moment_rate.csv", 1.0),
        ("energy.csv", 1.0),
    ] {
        let rows = |run: &Waves| -> Result<Vec<f64>, CaseError> {
            let rows = run.files.table(file)?.numbers();
            Ok(rows.into_iter().flat_map(|row| row.into_iter().skip(1)).collect())
        };
        let (found, other) = (rows(&run)?, rows(forwards)?);
        ledger
            .claim(format!("a fault that ruptures in part, and backwards: all numbers of {file}"))
            .values(&found)
            .equals_each(&other.iter().map(|v| sign * v).collect::<Vec<_>>())
            .absolute(1e-13)
            .evidence(Evidence::Exact, "the scene and its mirror image: slip has the other sign, logarithms of slip rates, moments and energies the same")
            .because("rounding of numbers below one")
            .why_not_tighter("the sum of rounding of the missing energy")
            .covers(&[Capability::DynamicRupture, Capability::Outputs])
            .cost(&run.cost)
            .record();
    }
    Ok(())
}

fn moments(ledger: &mut Ledger, run: &Waves, points: &Points) -> Result<(), CaseError> {
    let table = run.files.table("moment_rate.csv")?;
    for (column, rows) in [("moment_rate of f", &points.rate), ("moment of f", &points.slip)] {
        let exact: Vec<f64> = rows.iter().map(|row| MODULUS * points.over(|p| row[p].abs())).collect();
        ledger
            .claim(format!("a fault that ruptures in part: {column}, in all rows"))
            .values(&table.column(column)?)
            .equals_each(&exact)
            .relative(1e-8)
            .evidence(Evidence::Exact, "2 G1 G2/(G1 + G2) times slip at all points times cells of half a metre, half as much at the ends")
            .because("profiles have ten digits")
            .why_not_tighter("the last digit may be off by a half")
            .covers(&[Capability::DynamicRupture, Capability::Outputs])
            .cost(&run.cost)
            .record();
    }
    Ok(())
}

fn report(ledger: &mut Ledger, run: &Waves, points: &Points) -> Result<(), CaseError> {
    let end = points.slip.last().ok_or("no row")?;
    let part = |p: usize| if points.ruptured[p] { 1.0 } else { 0.0 };
    let area = points.over(part);
    let report: Value = serde_json::to_value(&run.report)?;
    let found = &report["ruptures"][0];
    let count = points.ruptured.iter().filter(|r| **r).count();
    if !(3..=ALONG - 2).contains(&count) {
        return Err(format!("{count} points ruptured, and not a part").into());
    }
    for (name, exact) in [
        ("area", area),
        ("mean_slip", points.over(|p| part(p) * end[p].abs()) / area),
        ("largest_slip", end.iter().map(|s| s.abs()).fold(0.0, f64::max)),
        ("peak_rate", (0..=ALONG).map(|p| points.largest(p)).fold(0.0, f64::max)),
        ("moment", MODULUS * points.over(|p| end[p].abs())),
    ] {
        ledger
            .claim(format!("a fault that ruptures in part: {name} in the report"))
            .value(found[name].as_f64().ok_or_else(|| format!("no {name}"))?)
            .equals(exact)
            .relative(1e-8)
            .evidence(Evidence::Exact, "sums over the points in the rows of profiles; for area and mean slip, over those with a rupture time")
            .because("profiles have ten digits")
            .why_not_tighter("the last digit may be off by a half")
            .covers(&[Capability::DynamicRupture, Capability::Outputs])
            .cost(&run.cost)
            .record();
    }
    ledger
        .claim("a fault that ruptures in part: points with a rupture time, less those in the report")
        .count(found["points"][1].as_u64().unwrap_or(u64::MAX).abs_diff(count as u64), 0)
        .evidence(Evidence::Exact, "the same points")
        .because("counts are exact")
        .covers(&[Capability::DynamicRupture, Capability::Outputs])
        .cost(&run.cost)
        .record();
    Ok(())
}

/// The point that ruptured first, and the areas in the heads of stations.
fn places(ledger: &mut Ledger, run: &Waves, points: &Points, times: &Table) -> Result<(), CaseError> {
    let times = times.column("time")?;
    let first = times.iter().enumerate().filter(|(_, t)| t.is_finite()).min_by(|a, b| a.1.total_cmp(b.1));
    let place = points.place[first.ok_or("nothing ruptured")?.0];
    let found = run.report.ruptures.first().and_then(|r| r.first).ok_or("no first point")?;
    let mut values = vec![found[1]];
    let mut exact = vec![place];
    for (k, place) in STATIONS.iter().enumerate() {
        let text = run.files.text(&format!("stations/f_{k:03}"))?;
        let after = text.split("tributary_area=").nth(1).ok_or("no area")?;
        values.push(after.split_whitespace().next().ok_or("no area")?.parse()?);
        exact.push(area((place / SIZE).round() as usize));
    }
    ledger
        .claim("a fault that ruptures in part: place that ruptures first in the report, and areas in the heads of three stations")
        .unit("m")
        .values(&values)
        .equals_each(&exact)
        .absolute(1e-9)
        .evidence(Evidence::Exact, "the least rupture time in the table, and cells of half a metre")
        .because("heads have seven digits, and these numbers have two")
        .why_not_tighter("there is nothing but rounding")
        .covers(&[Capability::DynamicRupture, Capability::Outputs])
        .cost(&run.cost)
        .record();
    Ok(())
}

/// Rows of stations are those of the profiles at their points.
fn stations(ledger: &mut Ledger, run: &Waves, points: &Points) -> Result<(), CaseError> {
    for (k, place) in STATIONS.iter().enumerate() {
        let table = run.files.table(&format!("stations/f_{k:03}"))?;
        let point = points.place.iter().position(|y| (y - place).abs() < 1e-9).ok_or("no such point")?;
        let (slip, rate) = (table.column("slip")?, table.column("slip_rate")?);
        if slip.len() != STEPS + 1 {
            return Err(format!("{} rows of a station", slip.len()).into());
        }
        let found: Vec<f64> = slip.into_iter().chain(rate.into_iter().map(|v| 10.0_f64.powf(v))).collect();
        let column = |rows: &[Vec<f64>]| rows.iter().map(|row| row[point].abs()).collect::<Vec<f64>>();
        let exact = [column(&points.slip), column(&points.rate)].concat();
        ledger
            .claim(format!(
                "a fault that ruptures in part: slip and slip rates of the station at {place} m, in all rows"
            ))
            .values(&found)
            .equals_each(&exact)
            .absolute(1e-8)
            .evidence(Evidence::Exact, "the columns of the profiles at that place")
            .because(
                "both files have ten digits, one of them of logarithms; rest is written as 1e-20 m/s or so",
            )
            .why_not_tighter("the last digit may be off by a half")
            .covers(&[Capability::DynamicRupture, Capability::Outputs])
            .cost(&run.cost)
            .record();
    }
    Ok(())
}
