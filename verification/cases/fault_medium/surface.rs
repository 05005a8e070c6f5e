//! Displacement of the free surface over an event of one cell, and the finite-fault model of the event.

use super::receivers::{DIP, PLATES, RAKE, RATIO, SIZE, STRIKE, hanging, okada, one_cell_event, scene};
use crate::cases::okada::Rectangle;
use crate::cases::run_files::WrittenRun;
use crate::{CaseError, Evidence, Ledger};

/// Shear modulus of the rock of [`scene`] \[Pa\].
const SHEAR: f64 = 32e9;
/// Width of the fault in the plane \[m\], and the length of the rectangle that represents it.
const WIDTH: f64 = 2e3;
const LENGTH: f64 = 2e8;

/// See the module.
pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (done, slip) = one_cell_event()?;
    map(ledger, &done, slip)?;
    model(ledger, &done, SHEAR * SIZE[0] * SIZE[1] * slip)?;
    in_the_plane(ledger)
}

/// Map of the surface over an event with this slip of one cell \[m\].
fn map(ledger: &mut Ledger, done: &WrittenRun, slip: f64) -> Result<(), CaseError> {
    let table = done.files.table("events/surface_000.csv")?;
    let [right, along] = [(STRIKE + 90.0).to_radians(), STRIKE.to_radians()];
    let (xs, zs) = (table.column("x")?, table.column("z")?);
    let found = [table.column("east")?, table.column("north")?, table.column("up")?];
    let mut worst = if xs.len() == 15 * 14 { 0.0_f64 } else { f64::NAN };
    for (k, (&x, &z)) in xs.iter().zip(&zs).enumerate() {
        let [u, v, w] = okada(hanging(done) * slip, RAKE, SIZE, [x, z]);
        // x points to the right of the strike, and -z along it.
        let wanted = [u * right.sin() - w * along.sin(), u * right.cos() - w * along.cos(), v];
        for (found, wanted) in found.iter().zip(wanted) {
            worst = worst.max((found[k] - wanted).abs() / slip);
        }
    }
    ledger
        .claim("displacement of a map of the surface over an event, over its slip, largest error")
        .value(worst)
        .at_most(1e-8)
        .evidence(Evidence::Exact, "Okada 1985 for the slip of the one cell, turned by the strike")
        .because("slip and displacements have ten digits")
        .why_not_tighter("the last digit may be off by any part of a half")
        .cost(&done.cost)
        .record();
    along_axes(ledger, done, slip)
}

/// Positions of the map, and its displacements along the axes of the scene.
fn along_axes(ledger: &mut Ledger, done: &WrittenRun, slip: f64) -> Result<(), CaseError> {
    let file = "events/surface_000.csv";
    // Spans of 14.4 and 12.5 km in equal parts of about a kilometre, along z first.
    let places: Vec<[f64; 3]> = (0..15)
        .flat_map(|i| {
            (0..14).map(move |j| {
                [-6300.0 + 14_400.0 / 14.0 * f64::from(i), 0.0, -7e3 + 12_500.0 / 13.0 * f64::from(j)]
            })
        })
        .collect();
    let table = done.files.table(file)?;
    let mut worst = 0.0_f64;
    for (axis, name) in ["displacement_x", "displacement_y", "displacement_z"].into_iter().enumerate() {
        for (found, &[x, _, z]) in table.column(name)?.into_iter().zip(&places) {
            let wanted = okada(hanging(done) * slip, RAKE, SIZE, [x, z])[axis];
            worst = worst.max((found - wanted).abs() / slip);
        }
    }
    ledger
        .claim("displacement_x, displacement_y and displacement_z of a map of the surface over an event, over its slip, largest error")
        .value(worst)
        .at_most(1e-8)
        .evidence(Evidence::Exact, "Okada 1985 for the slip of the one cell, at equal distances over the spans of the scene")
        .because("slip and displacements have ten digits")
        .why_not_tighter("the last digit may be off by any part of a half")
        .cost(&done.cost)
        .record();
    super::earth::claims(ledger, done, file, &places)
}

/// Number after `NAME =` in the head of a model.
fn entry(text: &str, name: &str) -> Result<f64, CaseError> {
    let after = text.split(&format!("{name} = ")).nth(1).ok_or_else(|| format!("no {name}"))?;
    Ok(after.split_whitespace().next().ok_or("the model is short")?.parse()?)
}

/// Finite-fault model of an event of one cell with this moment \[N m\].
fn model(ledger: &mut Ledger, done: &WrittenRun, moment: f64) -> Result<(), CaseError> {
    let text = done.files.text("events/finite_fault_000.fsp")?;
    let row = text.lines().find(|line| !line.starts_with('%')).ok_or("the model has no row")?;
    let row: Vec<f64> = row.split_whitespace().map(str::parse).collect::<Result<_, _>>()?;
    let moments = [entry(&text, "Mo")?, *row.last().ok_or("the row is empty")?];
    let worst = moments.iter().map(|found| (found / moment - 1.0).abs()).fold(0.0, f64::max);
    ledger
        .claim("moment of a finite-fault model and of its one subfault, largest relative error")
        .value(worst)
        .at_most(1e-8)
        .evidence(Evidence::Exact, "shear modulus times area times slip")
        .because("slip and moments have ten digits")
        .why_not_tighter("the last digit may be off by any part of a half")
        .cost(&done.cost)
        .record();
    // The hanging wall moves along the rake if it is the plus side.
    let rake = if hanging(done) > 0.0 { RAKE } else { RAKE - 180.0 };
    let wanted = [("STRK", STRIKE), ("DIP", DIP), ("RAKE", rake)];
    let mut off = (row[6] - rake).abs();
    for (name, angle) in wanted {
        off = off.max((entry(&text, name)? - angle).abs());
    }
    ledger
        .claim("strike, dip and rake of a finite-fault model, largest error [degrees]")
        .value(off)
        .at_most(1e-3)
        .evidence(Evidence::Exact, "angles of the scene")
        .because("angles have three decimals")
        .why_not_tighter("the last digit may be off by any part of a half")
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Profile of the surface over an event of a dipping line of one cell in plane strain.
fn in_the_plane(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (sine, cosine) = DIP.to_radians().sin_cos();
    let rest = format!(
        "line = {{ trace = [[0.0, 0.0], [{:?}, {:?}]], spacing = {WIDTH:?} }}\nrate = 1.1e-9\n[output]\nsurface = {{ spacing = 500.0, x = {{ from = -6300.0, to = 8200.0 }} }}\n[events]\nabove = \"1e-3 m/s\"\nstop_after = 1\n",
        WIDTH * cosine,
        -WIDTH * sine
    );
    let weakening = "a = 0.010, b = 0.015, l = \"4 mm\"";
    let done = WrittenRun::from_text(&scene("plane-strain", weakening, "1000 yr", &rest))?;
    let slip = done.files.table("events/rupture_times_000.csv")?.only("slip")?;
    let table = done.files.table("events/surface_000.csv")?;
    let source = Rectangle {
        depth: WIDTH * sine,
        dip: DIP.to_radians(),
        size: [LENGTH, WIDTH],
        slip: [0.0, slip, 0.0],
        ratio: RATIO,
    };
    let found = [table.column("displacement_x")?, table.column("displacement_y")?];
    let xs = table.column("x")?;
    let mut worst = if xs.len() == 30 { 0.0_f64 } else { f64::NAN };
    for (k, x) in xs.iter().enumerate() {
        let [_, v, w] = source.surface(0.5 * LENGTH, WIDTH * cosine - x);
        worst = worst.max((found[0][k] + v).abs().max((found[1][k] - w).abs()) / slip);
    }
    ledger
        .claim("displacement of a profile of the surface over an event in plane strain, over its slip, largest error")
        .value(worst)
        .at_most(6.4e-6)
        .evidence(Evidence::Exact, "Okada 1985 for reverse slip of a rectangle a hundred thousand times as long as wide")
        .because("the parts beyond the ends would add up to the width over pi times half the length")
        .why_not_tighter("a longer rectangle loses digits in differences of large terms")
        .cost(&done.cost)
        .record();
    through(ledger, &done)
}

/// Displacement of the surface towards the footwall and up, of reverse slip of one metre of the line.
fn reversed(x: f64) -> [f64; 2] {
    let (sine, cosine) = DIP.to_radians().sin_cos();
    let source = Rectangle {
        depth: WIDTH * sine,
        dip: DIP.to_radians(),
        size: [LENGTH, WIDTH],
        slip: [0.0, 1.0, 0.0],
        ratio: RATIO,
    };
    let [_, v, w] = source.surface(0.5 * LENGTH, WIDTH * cosine - x);
    [v, w]
}

/// Profiles of the surface through the run: slip that lags behind plates, which move by half their rate on either side.
fn through(ledger: &mut Ledger, done: &WrittenRun) -> Result<(), CaseError> {
    let tables = ["surface_profiles_x.csv", "surface_profiles_y.csv"].map(|name| done.files.table(name));
    let [along, up] = tables;
    let (along, up) = (along?, up?);
    let (positions, rows) = (along.head()[1..].to_vec(), [along.numbers(), up.numbers()]);
    let slips = done.files.table("slip_profiles.csv")?.numbers();
    let way = [-DIP.to_radians().cos(), DIP.to_radians().sin()];
    let largest = slips.iter().fold(0.0_f64, |m, row| m.max(row[1].abs()));
    let same = rows.iter().all(|rows| rows.iter().map(|row| row[0]).eq(slips.iter().map(|row| row[0])));
    if !same || slips.len() < 5 || positions.len() != 30 {
        return Err("the profiles of the surface have other times than those of slip, or few".into());
    }
    let mut worst = 0.0_f64;
    for (k, name) in positions.iter().enumerate() {
        let x: f64 = name.parse()?;
        let [v, w] = reversed(x);
        for (row, slip) in slips.iter().enumerate() {
            let plates = PLATES * slip[0];
            let (lags, half) = (slip[1] - plates, 0.5 * plates * x.signum());
            let wanted = [half * way[0] - v * lags, half * way[1] + w * lags];
            for (rows, wanted) in rows.iter().zip(wanted) {
                worst = worst.max((rows[row][k + 1] - wanted).abs() / largest);
            }
        }
    }
    ledger
        .claim("surface_profiles_x.csv and surface_profiles_y.csv beside a dipping fault in plane strain through an event, all rows, over the largest slip, largest error")
        .value(worst)
        .at_most(1e-5)
        .evidence(Evidence::Exact, "Okada 1985 for slip less that of the plates, of a rectangle a hundred thousand times as long as wide, and half of the plates on either side")
        .because("the parts beyond the ends would add up to the width over pi times half the length, 6.4e-6, and slip in profiles has seven digits")
        .why_not_tighter("a longer rectangle loses digits in differences of large terms")
        .cost(&done.cost)
        .record();
    Ok(())
}
