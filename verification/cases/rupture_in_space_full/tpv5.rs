//! The benchmark TPV5 from its scene.
//!
//! The reference is that of a whole space. It holds where no wave from the surface has arrived and the squares beside have not slipped. There the
//! scene is also compared with itself in a whole space on the same cells, without these squares.

use crate::cases::rupture_in_space::{Reference, Rupture, SOURCE, follow, times_at};
use crate::{CaseError, Evidence, Ledger, Plot, Series};
use asperity_plan::dynamics;
use asperity_plan::dynamics::AnyPlan;
use asperity_plan::reading::scene;
use asperity_vary::SceneText;

const SCENE: &str = include_str!("../../../scenes/tpv5.toml");

/// Speeds of waves \[m/s\].
const PRESSURE: f64 = 6000.0;
const SHEAR: f64 = 3464.0;
/// Depth of the middle of the fault \[m\].
const MIDDLE: f64 = 7.5e3;
/// Half side of the square of nucleation \[m\].
const SQUARE: f64 = 1.5e3;
/// Places from here on are compared, and up to here along the strike \[m\]: the front enters the squares beside at 6 km, and a P wave from there
/// takes a quarter of a second to 4.5 km, which it reaches later than the front.
const ALONG: [f64; 2] = [2e3, 4.5e3];

/// Runs a scene of the family; places are those from the middle of the fault along the strike and upwards.
fn run(text: SceneText) -> Result<Rupture, CaseError> {
    let text = text.text()?;
    let scene = scene::read(&text).map_err(|e| format!("{e}\nin\n{text}"))?;
    match dynamics::plan(&scene).map_err(|e| e.to_string())? {
        AnyPlan::Three(plan) => {
            let at = plan.points.iter().map(|p| [p.at[2], p.at[1] + MIDDLE]).collect();
            follow(&plan.problem, at, &[])
        }
        AnyPlan::Two(_) => Err("the scene is plane".into()),
    }
}

/// The scene in a whole space without the squares beside the middle, until the front has passed the places that are compared.
fn buried() -> SceneText {
    let body =
        |text: SceneText, name: &str| text.with(&format!("bodies.{name}.mesh.block.max[1]"), "\"3 km\"");
    let text = body(body(SceneText::new(SCENE), "west"), "east");
    let text = text.with("stages[0].duration", "\"4.2 s\"").without("faults.main.patches[2]");
    let text = text.without("faults.main.patches[1]").without("output.seismograms");
    let top = |text: SceneText, body: &str| {
        text.push("stages[0].conditions", format!("{{ set = \"{body}.top\", absorbing = true }}"))
    };
    let text = text.with("faults.main.creep.outside.y", "{ from = \"-15 km\", to = \"0 km\" }");
    top(top(text, "west"), "east")
}

/// Earliest arrival of a wave that the surface reflects: a P wave from the upper border of the square \[s\].
fn reflected([along, up]: [f64; 2]) -> f64 {
    let aside = (along.abs() - SQUARE).max(0.0);
    aside.hypot((MIDDLE - SQUARE) + (MIDDLE - up)) / PRESSURE
}

pub(super) fn claims(ledger: &mut Ledger, reference: &Reference) -> Result<(), CaseError> {
    let found = run(SceneText::new(SCENE).with("stages[0].duration", "\"6 s\""))?;
    early(ledger, reference, &found);
    same(ledger, reference, &found, &run(buried())?);
    surface(ledger, &found);
    Ok(())
}

/// Places of the reference that know nothing of surface and squares, on both sides along the strike and up and down.
fn unaware(reference: &Reference) -> Vec<([f64; 2], f64)> {
    let mut all = Vec::new();
    for ([x, z], time) in reference.times(0) {
        for at in [[x, z], [-x, z], [x, -z], [-x, -z]] {
            let within = x.max(z) >= ALONG[0] && x <= ALONG[1];
            if within && time < reflected(at) {
                all.push((at, time));
            }
        }
    }
    all
}

fn early(ledger: &mut Ledger, reference: &Reference, found: &Rupture) {
    let expected = unaware(reference);
    let places: Vec<[f64; 2]> = expected.iter().map(|row| row.0).collect();
    let times = times_at(found, 0, &places);
    let square: f64 = times.iter().zip(&expected).map(|(t, (_, e))| (t / e - 1.0).powi(2)).sum();
    ledger
        .claim("TPV5: rupture times before waves from the surface arrive, cells of 200 m")
        .norm("root mean square of relative differences")
        .value((square / expected.len() as f64).sqrt())
        .at_most(0.08)
        .uncertainty(1e-3)
        .evidence(Evidence::OtherCode, SOURCE)
        .because(
            "0.05 on cells of 150 m in the same time (case `rupture_in_space`), times the square of 200/150",
        )
        .cost(&found.cost)
        .record();
}

fn same(ledger: &mut Ledger, reference: &Reference, found: &Rupture, buried: &Rupture) {
    let places: Vec<[f64; 2]> = unaware(reference).into_iter().map(|row| row.0).collect();
    let pairs = times_at(found, 0, &places).into_iter().zip(times_at(buried, 0, &places));
    // On these cells the front is late, at some places later than waves from the surface.
    let before = pairs.zip(&places).filter(|((time, _), at)| *time < reflected(**at));
    let rests = before.map(|((a, b), _)| (a / b - 1.0).abs());
    let rests = rests.map(|d| if d.is_nan() { f64::INFINITY } else { d });
    ledger
        .claim("TPV5: rupture times before waves from the surface arrive, with and without the surface")
        .norm("largest relative difference")
        .value(rests.fold(0.0, f64::max))
        .at_most(1e-3)
        .evidence(Evidence::Exact, "no wave is faster than a P wave")
        .because("waves of the mesh run ahead by a cell per step, with little of the amplitude")
        .why_not_tighter("how little is not known beforehand")
        .cost(&buried.cost)
        .record();
}

/// Speed of the front along the surface and in the middle, from 8 to 14 km on the side of higher traction.
fn surface(ledger: &mut Ledger, found: &Rupture) {
    let rows: Vec<f64> = (4..=28).map(|k| 500.0 * f64::from(k)).collect();
    let along = |up: f64| -> Vec<(f64, f64)> {
        let places: Vec<[f64; 2]> = rows.iter().map(|x| [-x, up]).collect();
        rows.iter().map(|x| 1e-3 * x).zip(times_at(found, 0, &places)).collect()
    };
    let speed = |rows: &[(f64, f64)]| {
        let at = |km: f64| rows.iter().find(|r| (r.0 - km).abs() < 1e-6).map_or(f64::NAN, |r| r.1);
        6e3 / (at(14.0) - at(8.0))
    };
    let (top, middle) = (along(MIDDLE), along(0.0));
    ledger
        .claim("TPV5: speed of the front along the surface, 8 to 14 km from the middle, over that of P waves")
        .value(speed(&top) / PRESSURE)
        .at_most(1.0)
        .evidence(Evidence::Exact, "no front outruns P waves for long")
        .because("the front is driven by waves alone")
        .why_not_tighter("a bound; the speed is not known")
        .record();
    let words = |v: f64| vec![format!("{v:.0}"), format!("{:.2}", v / SHEAR)];
    let table = [("at the surface", speed(&top)), ("at 7.5 km depth", speed(&middle))]
        .map(|(name, v)| [vec![name.to_string()], words(v)].concat());
    ledger.table(
        "TPV5: speed of the front, 8 to 14 km from the middle on the side of higher traction",
        &["", "speed [m/s]", "over that of shear waves"],
        table,
    );
    ledger.plot(
        Plot::xy("TPV5: rupture times along the strike", "distance from the middle [km]", "time [s]")
            .series(Series::line("surface", &top))
            .series(Series::line("depth of 7.5 km", &middle)),
    );
}
