//! Coupling of a fault to the plates that load it: locked above, creeping under constant stress below.

use super::receivers::{PLATES_RAKE, RAKE, STABLE, direction, rectangle, scene};
use crate::cases::run_files::WrittenRun;
use crate::{CaseError, Evidence, Ledger, Plot, Series};
use asperity_vary::SceneText;
use std::f64::consts::FRAC_PI_2;

/// Depth down to which the fault is locked, and depth below which the rock creeps with the plates \[m\].
const LOCKED: f64 = 10e3;
const DEEPEST: f64 = 20e3;
/// Rate of the plates \[m/s\], and the shear modulus \[Pa\].
const PLATES: f64 = 1e-9;
const SHEAR_MODULUS: f64 = 32e9;
/// Intervals of Simpson's rule, for sixteen digits of a smooth periodic integrand.
const INTERVALS: usize = 400;

/// See the module.
pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    ends(ledger)?;
    oblique(ledger)?;
    partly(ledger)
}

/// A vertical fault in antiplane motion that slides at this rate for some time, with cells of a size \[m\].
fn fault(rate: f64, size: f64, duration: &str, more: &str) -> String {
    let line = format!(
        "line = {{ trace = [[0.0, 0.0], [0.0, {:?}]], spacing = {size:?} }}\nrate = {rate:e}\n{more}",
        -DEEPEST
    );
    scene("antiplane", "a = 0.02, b = 0.015, l = \"8 mm\"", duration, &line)
}

/// Integral of d phi/xi from 0 to an angle, with xi^2 = W^2 - (W^2 - D^2) cos^2 phi.
fn integral(angle: f64) -> f64 {
    let at = |phi: f64| {
        let squared = DEEPEST.powi(2) - (DEEPEST.powi(2) - LOCKED.powi(2)) * phi.cos().powi(2);
        squared.sqrt().recip()
    };
    let step = angle / INTERVALS as f64;
    let weight = |k: usize| match k {
        0 | INTERVALS => 1.0,
        k if k % 2 == 1 => 4.0,
        _ => 2.0,
    };
    (0..=INTERVALS).map(|k| weight(k) * at(k as f64 * step)).sum::<f64>() * step / 3.0
}

/// Slip rate over that of the plates at a depth \[m\].
fn creeps(depth: f64) -> f64 {
    if depth <= LOCKED {
        return 0.0;
    }
    let share = (DEEPEST.powi(2) - depth.powi(2)) / (DEEPEST.powi(2) - LOCKED.powi(2));
    integral(share.sqrt().acos()) / integral(FRAC_PI_2)
}

/// The last row of a table of numbers.
fn last(done: &WrittenRun, name: &str) -> Result<Vec<f64>, CaseError> {
    Ok(done.files.table(name)?.numbers().pop().ok_or("no row")?)
}

/// Coupling of faults that are locked, and that creep with the plates.
fn ends(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (rate, coupling, bound, what, why) in [
        (1e-20, 1.0, 1e-6, "is locked", "it slides at 1e-11 of the plates, and profiles have seven digits"),
        (
            PLATES,
            0.0,
            1e-6,
            "creeps with the plates",
            "steady creep is kept to the tolerance of 1e-5 of ln V",
        ),
    ] {
        let done = WrittenRun::from_text(&fault(rate, 500.0, "1 yr", ""))?;
        let rows = done.files.table("coupling_profiles.csv")?.numbers();
        let values = rows.iter().flat_map(|row| &row[1..]);
        let profiles = values.map(|c| (c - coupling).abs()).fold(0.0, f64::max);
        let means = done.files.table("locking.csv")?.column("coupling of main")?;
        let worst = means.iter().map(|c| (c - coupling).abs()).fold(profiles, f64::max);
        ledger
            .claim(format!("coupling of a fault that {what}, largest error"))
            .value(worst)
            .at_most(bound)
            .evidence(
                Evidence::Exact,
                "1 - V/Vp, the rate of backslip of Savage 1983 over that of the plates",
            )
            .because(why)
            .why_not_tighter("the digits of the table, and the tolerance of one step")
            .cost(&done.cost)
            .record();
    }
    Ok(())
}

/// Coupling of a fault in space that slides obliquely to its plates, and against them.
fn oblique(ledger: &mut Ledger) -> Result<(), CaseError> {
    let rate = 0.4 * PLATES;
    let text = scene("3d", STABLE, "1 d", &rectangle(rate, [4e3, 4e3, 2e3]));
    for (rake, what) in [(PLATES_RAKE, "obliquely to"), (RAKE + 180.0, "against")] {
        let text = SceneText::new(&text)
            .add("faults.main.slip", "free")
            .add("faults.main.creep.rake", format!("{:?}", direction(rake)))
            .text()?;
        let done = WrittenRun::from_text(&text)?;
        let found = *done.files.table("locking.csv")?.column("coupling of main")?.first().ok_or("no row")?;
        ledger
            .claim(format!("coupling at the start of a fault in space that slides {what} its plates"))
            .value(found)
            .equals(1.0 - rate / PLATES * (rake - RAKE).to_radians().cos())
            .absolute(1e-9)
            .evidence(Evidence::Exact, "1 - V.Vp/Vp^2")
            .because("the column has ten digits")
            .why_not_tighter("the last digit may be off by any part of a half")
            .cost(&done.cost)
            .record();
    }
    Ok(())
}

/// Coupling of a fault that creeps under constant stress below its locked part.
fn partly(ledger: &mut Ledger) -> Result<(), CaseError> {
    // The upper part is locked: it slides at 1e-11 of the plates, under a normal traction whose a f_n is more than the plates
    // add in 300 years. On the lower part there is so little normal traction that friction keeps the stress.
    let parts = format!(
        "patches = [{{ box = {{ y = {{ from = {0:?}, to = 1.0 }} }}, normal = \"10 GPa\", rate = 1e-20 }},\
         {{ box = {{ y = {{ from = {1:?}, to = {0:?} }} }}, normal = \"1 MPa\" }}]\n",
        -LOCKED,
        -DEEPEST - 1.0
    );
    let wanted = SHEAR_MODULUS * PLATES * FRAC_PI_2 / integral(FRAC_PI_2);
    let mut levels = Vec::new();
    let mut figure = Plot::xy("Coupling below a locked part", "depth [km]", "coupling [-]");
    for cells in [20_u32, 40, 80] {
        let size = DEEPEST / f64::from(cells);
        let done = WrittenRun::from_text(&fault(PLATES, size, "300 yr", &parts))?;
        let deficit = last(&done, "locking.csv")?[2];
        levels.push((size, (deficit / wanted - 1.0).abs()));
        if cells == 40 {
            let depths: Vec<f64> = done.plan.points.iter().map(|p| p.along).collect();
            let row = last(&done, "coupling_profiles.csv")?;
            let found: Vec<_> = depths.iter().zip(&row[1..]).map(|(z, c)| (z / 1e3, *c)).collect();
            let curve: Vec<_> = (0..=400).map(|k| DEEPEST * f64::from(k) / 400.0).collect();
            let curve: Vec<_> = curve.into_iter().map(|z| (z / 1e3, 1.0 - creeps(z))).collect();
            figure =
                figure.series(Series::line("closed form", &curve)).series(Series::points("40 cells", &found));
        }
        if cells == 80 {
            profile(ledger, &done)?;
            balance(ledger, &done)?;
            ledger
                .order("moment deficit rate of a fault that creeps under constant stress below its locked part")
                .levels(&levels)
                .expected(1.0)
                .within(0.1)
                .evidence(Evidence::Exact, "pi/2 G Vp W/K(sqrt(1 - D^2/W^2)): screw dislocations that keep the stress")
                .because("the square roots at both ends of the creeping part, which cells of constant slip miss by O(h)")
                .finest(2.5e-3, "a tenth of a cell over the width of the creeping part: cells of constant slip move its ends by parts of a cell")
                .cost(&done.cost)
                .record();
        }
    }
    ledger.plot(figure);
    Ok(())
}

/// Coupling away from the ends of the creeping part.
fn profile(ledger: &mut Ledger, done: &WrittenRun) -> Result<(), CaseError> {
    let row = last(done, "coupling_profiles.csv")?;
    let away = |z: f64| (z - LOCKED).abs() > 1e3 && z < DEEPEST - 1e3;
    let errors = done.plan.points.iter().zip(&row[1..]).filter(|(p, _)| away(p.along));
    let worst = errors.map(|(p, c)| (c - (1.0 - creeps(p.along))).abs()).fold(0.0, f64::max);
    ledger
        .claim("coupling a kilometre and more from the ends of the creeping part, largest error")
        .value(worst)
        .at_most(0.025)
        .evidence(Evidence::Exact, "1 - F(phi, k)/K(k): screw dislocations below a free surface that keep the stress between both depths")
        .because("cells of 250 m move the ends of the creeping part, which is 10 km wide, by parts of a cell")
        .why_not_tighter("a fortieth is a whole cell over the width, and the ends move by less")
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Rates of moment and of moment deficit against the moment rate of the plates.
fn balance(ledger: &mut Ledger, done: &WrittenRun) -> Result<(), CaseError> {
    let plates = SHEAR_MODULUS * PLATES * DEEPEST;
    let rates = done.files.table("moment_rate.csv")?.column("moment_rate of main")?;
    let deficits = done.files.table("locking.csv")?.column("moment_deficit_rate of main")?;
    if rates.len() != deficits.len() {
        return Err("the tables of moment and of locking have different rows".into());
    }
    let errors = rates.iter().zip(&deficits).map(|(rate, deficit)| ((rate + deficit) / plates - 1.0).abs());
    ledger
        .claim("rates of moment and moment deficit together over the moment rate of the plates, largest error of all rows")
        .value(errors.fold(0.0, f64::max))
        .at_most(1e-8)
        .evidence(Evidence::Exact, "G Vp W, the moment rate of the plates")
        .because("both columns have ten digits")
        .why_not_tighter("the last digit may be off by any part of a half")
        .cost(&done.cost)
        .record();
    Ok(())
}
