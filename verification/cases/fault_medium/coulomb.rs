//! Changes of Coulomb stress over an event: at positions in space, and on a line and on another fault in the plane.

use super::SHEAR_MODULUS;
use super::receivers::{DIP, hanging, one_cell, one_cell_event_with, scene};
use crate::cases::dislocation::{self, Stress};
use crate::cases::run_files::WrittenRun;
use crate::cases::seas;
use crate::{CaseError, Evidence, Ledger};
use asperity_plan::faults::PointView;
use nalgebra::Complex;
use serde::Deserialize;
use std::f64::consts::FRAC_PI_3;

/// Results of `independent/coulomb.py`, per metre of slip of the hanging wall.
#[derive(Deserialize)]
struct Reference {
    friction: f64,
    /// Strike, dip and rake \[degrees\].
    planes: Vec<[f64; 3]>,
    positions: Vec<Position>,
}

#[derive(Deserialize)]
struct Position {
    at: [f64; 3],
    /// Shear, normal traction and Coulomb stress on each plane \[Pa\].
    changes: Vec<[f64; 3]>,
}

/// See the module.
pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let wanted: Reference = serde_json::from_str(include_str!("../../independent/coulomb.json"))?;
    in_space(ledger, &wanted)?;
    in_the_plane(ledger)
}

/// `coulomb` of a plane with all positions of the reference.
fn asked(wanted: &Reference, [strike, dip, rake]: [f64; 3]) -> String {
    let points: String =
        wanted.positions.iter().enumerate().map(|(k, p)| format!("points.p{k} = {:?}, ", p.at)).collect();
    format!(
        "coulomb = {{ friction = {:?}, strike = \"{strike:?} deg\", dip = \"{dip:?} deg\", rake = \"{rake:?} deg\", {points} }}\n",
        wanted.friction
    )
}

/// Changes at positions in space over an event of one cell.
fn in_space(ledger: &mut Ledger, wanted: &Reference) -> Result<(), CaseError> {
    let (done, slip) = one_cell_event_with(&asked(wanted, wanted.planes[0]))?;
    let slip = hanging(&done) * slip;
    let table = done.files.table("events/coulomb_points_000.csv")?;
    let names = ["shear_change", "normal_change", "coulomb_change"].map(|name| table.column(name));
    let [shear, normal, coulomb] = names;
    let (shear, normal, coulomb, mut worst) = (shear?, normal?, coulomb?, 0.0_f64);
    if shear.len() != wanted.positions.len() {
        worst = f64::NAN;
    }
    let largest = |changes: &[f64; 3]| changes.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    for (k, position) in wanted.positions.iter().enumerate() {
        let change = position.changes[0];
        for (found, wanted) in [shear[k], normal[k], coulomb[k]].into_iter().zip(change) {
            worst = worst.max((found / slip - wanted).abs() / largest(&change));
        }
    }
    ledger
        .claim("changes of shear, normal traction and Coulomb stress over an event, in the table of its positions: largest error over the largest of a position")
        .value(worst)
        .at_most(1e-8)
        .evidence(Evidence::OtherCode, "dislocs (Okada), which agrees with two triangles of cutde to 3e-14")
        .because("slip and changes have ten digits")
        .why_not_tighter("the last digit may be off by any part of a half")
        .cost(&done.cost)
        .record();
    named(ledger, &done, wanted)?;
    let plane = done.plan.coulomb.as_ref().ok_or("the plan has no planes")?.plane;
    resolved(
        ledger,
        "at positions in space",
        (&done, "events/coulomb_points_000.csv"),
        [plane.normal, plane.slip],
    )?;
    let mut worst = 0.0_f64;
    for (number, plane) in wanted.planes.iter().enumerate() {
        let text = one_cell(&asked(wanted, *plane));
        let plan = seas::plan(&text)?;
        let coulomb = plan.coulomb.as_ref().ok_or("the plan has no planes")?;
        let positions: Vec<[f64; 3]> = wanted.positions.iter().map(|p| p.at).collect();
        let found = coulomb.at(&positions, &[&[hanging(&done)]]);
        for (position, found) in wanted.positions.iter().zip(&found) {
            let (change, found) = (position.changes[number], found[0].1);
            for (found, wanted) in [found.shear, found.normal, found.coulomb].into_iter().zip(change) {
                worst = worst.max((found - wanted).abs() / largest(&change));
            }
        }
    }
    ledger
        .claim("changes on planes of three strikes, dips and rakes by slip of one metre: largest error over the largest of a position")
        .value(worst)
        .at_most(1e-12)
        .evidence(Evidence::OtherCode, "dislocs (Okada), which agrees with two triangles of cutde to 3e-14")
        .because("rounding of both programs, thirty times their difference")
        .why_not_tighter("changes on a plane are smaller than the stress, whose digits they have")
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Names of the positions in space, and where they lie.
fn named(ledger: &mut Ledger, done: &WrittenRun, wanted: &Reference) -> Result<(), CaseError> {
    let file = "events/coulomb_points_000.csv";
    let names = done.files.table(file)?;
    let names = names.words("name")?;
    let wrong = names.iter().enumerate().filter(|(k, name)| **name != format!("p{k}")).count();
    ledger
        .claim("names in the table of changes at positions in space that are not those of the scene, in its order")
        .count((wrong + names.len().abs_diff(wanted.positions.len())) as u64, 0)
        .evidence(Evidence::Exact, "names of the scene")
        .because("a count")
        .cost(&done.cost)
        .record();
    let positions: Vec<[f64; 3]> = wanted.positions.iter().map(|p| p.at).collect();
    super::earth::claims(ledger, done, file, &positions)
}

/// Claims that the stresses in a table cause its changes on planes of this normal and direction of slip.
fn resolved(
    ledger: &mut Ledger,
    place: &str,
    (done, name): (&WrittenRun, &str),
    [normal, slip]: [[f64; 3]; 2],
) -> Result<(), CaseError> {
    let table = done.files.table(name)?;
    let all: Vec<Vec<f64>> = ["xx", "yy", "zz", "xy", "yz", "zx"]
        .map(|axes| table.column(&format!("stress_{axes}")))
        .into_iter()
        .collect::<Result<_, _>>()?;
    let (shear, pressed) = (table.column("shear_change")?, table.column("normal_change")?);
    let (mut worst, mut largest) = (if shear.is_empty() { f64::NAN } else { 0.0_f64 }, 0.0_f64);
    for k in 0..shear.len() {
        let [xx, yy, zz, xy, yz, zx] = [0, 1, 2, 3, 4, 5].map(|c: usize| all[c][k]);
        let rows = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
        let on =
            |way: &[f64; 3]| -> f64 { (0..9).map(|i| way[i / 3] * rows[i / 3][i % 3] * normal[i % 3]).sum() };
        worst = worst.max((shear[k] - on(&slip)).abs()).max((pressed[k] + on(&normal)).abs());
        largest = all.iter().map(|stress| stress[k].abs()).fold(largest, f64::max);
    }
    ledger
        .claim(format!("changes of tractions {place} over an event, against the stress in the same rows: largest error over the largest stress"))
        .value(worst / largest)
        .at_most(2e-9)
        .evidence(Evidence::Exact, "tractions of a stress on a plane: n.S.s, and -n.S.n for compression")
        .because("stresses and tractions have ten digits, of which some add up")
        .why_not_tighter("the last digits may be off by any part of a half")
        .cost(&done.cost)
        .record();
    Ok(())
}

/// A cell of a line: its upper and lower end \[m\].
type Cell = [[f64; 2]; 2];

/// Width down dip of the fault that ruptures \[m\].
const WIDTH: f64 = 2e3;
/// Trace of the other fault, of four cells \[m\].
const OTHER: [[f64; 2]; 2] = [[6e3, 0.0], [4e3, -4e3]];
const CELLS: usize = 4;
/// Depth of the map \[m\].
const DEPTH: f64 = 3e3;
/// Effective friction coefficient.
const FRICTION: f64 = 0.3;

/// Stress at a position by slip of cells of a half-space in plane strain \[Pa\].
fn stress(at: [f64; 2], cells: &[Cell], points: &[PointView], slips: &[f64]) -> Stress {
    let complex = |[x, y]: [f64; 2]| Complex::new(x, y);
    let mut sum = Stress::default();
    for ((&[upper, lower], point), slip) in cells.iter().zip(points).zip(slips) {
        let down = [lower[0] - upper[0], lower[1] - upper[1]];
        // An anticlockwise circuit of the upper end crosses the cell along this direction; from minus to plus, the
        // displacement falls by the slip where it does.
        let across = point.normal[1] * down[0] - point.normal[0] * down[1];
        let b = complex([point.slides[0], point.slides[1]]) * (-slip * across.signum());
        for (end, b) in [(upper, b), (lower, -b)] {
            if end[1] < 0.0 {
                dislocation::add(&mut sum, complex(at), complex(end), b, SHEAR_MODULUS, super::POISSON);
            }
        }
    }
    sum
}

/// Cells of both faults.
fn cells() -> Vec<Cell> {
    let (sine, cosine) = DIP.to_radians().sin_cos();
    let at = |k: usize| -> [f64; 2] {
        let part = k as f64 / CELLS as f64;
        std::array::from_fn(|c| OTHER[0][c] + part * (OTHER[1][c] - OTHER[0][c]))
    };
    let first = [[0.0, 0.0], [WIDTH * cosine, -WIDTH * sine]];
    std::iter::once(first).chain((0..CELLS).map(|k| [at(k), at(k + 1)])).collect()
}

/// A run with an event of one dipping cell beside another fault.
fn beside_another() -> Result<WrittenRun, CaseError> {
    let [_, lower] = cells()[0];
    let spacing = ((OTHER[1][0] - OTHER[0][0]).hypot(OTHER[1][1])) / CELLS as f64;
    let rest = format!(
        "line = {{ trace = [[0.0, 0.0], {lower:?}], spacing = {WIDTH:?} }}\nrate = 1.1e-9\n\
         [faults.other]\nline = {{ trace = {OTHER:?}, spacing = {spacing:?} }}\nnormal = \"50 MPa\"\nunder_resolved = \"allow\"\nrate = 1e-12\ndamping = \"radiation\"\n\
         law = {{ kind = \"rate-and-state\", evolution = \"ageing\", mu0 = 0.6, v_ref = \"1 um/s\", v_initial = \"1e-9 m/s\", a = 0.02, b = 0.015, l = \"8 mm\" }}\n\
         [output]\ncoulomb = {{ friction = {FRICTION:?}, dip = \"120 deg\", rake = \"90 deg\", depth = {DEPTH:?}, map = {{ spacing = 1e3, x = {{ from = -5200.0, to = 8800.0 }} }} }}\n\
         [events]\nabove = \"1e-3 m/s\"\nstop_after = 1\n"
    );
    WrittenRun::from_text(&scene("plane-strain", "a = 0.010, b = 0.015, l = \"4 mm\"", "1000 yr", &rest))
}

/// Largest error of the changes in a table of an event with this number of rows, and the largest change. They are on a plane with this
/// normal and direction of slip, or else on the cells of both faults.
fn errors(
    done: &WrittenRun,
    (name, rows): (&str, usize),
    plane: Option<[[f64; 2]; 2]>,
) -> Result<[f64; 2], CaseError> {
    let slips = done.files.table("events/rupture_times_000.csv")?.column("slip")?;
    let (cells, points) = (cells(), &done.plan.points);
    let table = done.files.table(&format!("events/{name}"))?;
    let (xs, ys) = (table.column("x")?, table.column("y")?);
    let [mut worst, mut largest] = [0.0_f64; 2];
    for (c, column) in ["shear_change", "normal_change", "coulomb_change"].into_iter().enumerate() {
        for (k, found) in table.column(column)?.into_iter().enumerate() {
            let of = |v: [f64; 3]| [v[0], v[1]];
            let [normal, along] = plane.unwrap_or_else(|| [of(points[k].normal), of(points[k].slides)]);
            let [shear, pressing] =
                <[f64; 2]>::from(stress([xs[k], ys[k]], &cells, points, &slips).on(along, normal));
            let wanted = [shear, pressing, shear - FRICTION * pressing][c];
            worst = worst.max((found - wanted).abs());
            largest = largest.max(wanted.abs());
        }
    }
    Ok([if xs.len() == rows { worst } else { f64::NAN }, largest])
}

/// Changes along a line, and on both faults.
fn in_the_plane(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = beside_another()?;
    let (sine, cosine) = FRAC_PI_3.sin_cos();
    // A plane that falls to the left by 60 degrees, whose upper side moves up.
    let (normal, up) = ([-sine, cosine], [cosine, sine]);
    for (name, rows) in [("coulomb_000.csv", 15), ("coulomb_faults_000.csv", 1 + CELLS)] {
        let on_faults = rows == 1 + CELLS;
        let [worst, largest] = errors(&done, (name, rows), (!on_faults).then_some([normal, up]))?;
        let place = if on_faults { "on both faults" } else { "along a line at a depth" };
        ledger
            .claim(format!("changes of shear, normal traction and Coulomb stress {place} over an event in plane strain: largest error over the largest"))
            .value(worst / largest)
            .at_most(1e-8)
            .evidence(Evidence::Exact, "edge dislocations at the ends of cells, with reflected potentials")
            .because("slip and changes have ten digits")
            .why_not_tighter("the last digit may be off by any part of a half")
            .cost(&done.cost)
            .record();
    }
    let faults = done.files.table("events/coulomb_faults_000.csv")?;
    let faults = faults.words("fault")?;
    let wrong =
        faults.iter().enumerate().filter(|(k, name)| **name != if *k == 0 { "main" } else { "other" });
    ledger
        .claim(
            "cells in the table of changes on both faults with the name of the other fault, and missing ones",
        )
        .count((wrong.count() + faults.len().abs_diff(1 + CELLS)) as u64, 0)
        .evidence(Evidence::Exact, "one cell of `main` and four of `other`, in the order of the scene")
        .because("a count")
        .cost(&done.cost)
        .record();
    let in_space = |[x, y]: [f64; 2]| [x, y, 0.0];
    resolved(
        ledger,
        "along a line at a depth",
        (&done, "events/coulomb_000.csv"),
        [in_space(normal), in_space(up)],
    )?;
    across_the_plane(ledger, &done)
}

/// Stress across the plane, which has no strain.
fn across_the_plane(ledger: &mut Ledger, done: &WrittenRun) -> Result<(), CaseError> {
    let table = done.files.table("events/coulomb_000.csv")?;
    let [xx, yy, zz] = ["stress_xx", "stress_yy", "stress_zz"].map(|name| table.column(name));
    let (xx, yy, zz) = (xx?, yy?, zz?);
    let largest = zz.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let wanted = xx.iter().zip(&yy).map(|(xx, yy)| super::POISSON * (xx + yy));
    let worst = zz.iter().zip(wanted).map(|(zz, wanted)| (zz - wanted).abs()).fold(0.0, f64::max);
    ledger
        .claim("stress across the plane along a line at a depth over an event in plane strain: largest error over the largest")
        .value(worst / largest)
        .at_most(1e-8)
        .evidence(Evidence::Exact, "nu (stress_xx + stress_yy): plane strain")
        .because("all three have ten digits, and the terms of the sum are at most some times as large")
        .why_not_tighter("the last digit may be off by any part of a half")
        .cost(&done.cost)
        .record();
    Ok(())
}
