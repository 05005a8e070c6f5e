//! `hertz/v1` and `partial-slip/v1`: a line contact under normal load and under shear.

use super::entry::Entry;
use super::independent::Results;
use super::parts::{ComputedBenchmark, Words, exact, interpolated, reference};
use crate::CaseError;
use crate::cases::hertz::{self, Hertz, Tractions, compliance};
use asperity_plan::reading::scene::model::{Motion, Scene, here};
use asperity_reference::benchmark::Quantity;

/// Positions of pressures over the half-width.
const PRESSURES: [f64; 11] = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95];
/// Positions of shear tractions over the half-width, away from the edge of the stick zone at 0.71.
const SHEARS: [f64; 9] = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 0.95];
/// The same after unloading, also away from the edge of reversed slip at 0.87.
const UNLOADED: [f64; 8] = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.95];

const MU: f64 = 0.3;
/// Cells per half-width of the entries of this program.
const CELLS: f64 = 40.0;

const HALF_SPACES: &str = "closed form for half-spaces";

/// Hertz pressure over its peak.
fn ellipse(x: f64) -> f64 {
    (1.0 - x * x).max(0.0).sqrt()
}

/// Shear traction over mu p0 with a stick zone of half-width c.
fn cattaneo(x: f64, c: f64) -> f64 {
    ellipse(x) - c * ellipse(x / c)
}

pub fn hertz() -> Result<ComputedBenchmark, CaseError> {
    let quantities = vec![
        Words {
            name: "peak_pressure",
            meaning: "Largest pressure over 2 P/(pi a)",
            unit: "1",
            source: HALF_SPACES,
            because: "blocks of 20 half-widths raise it by 0.1 %; five codes are within 0.5 % with five cells per half-width",
        }
        .one(exact(None, 1.0, 5e-3)),
        Words {
            name: "half_width",
            meaning: "Half-width by the second moment of pressure over a",
            unit: "1",
            source: HALF_SPACES,
            because: "as for the peak, to which it is inverse",
        }
        .one(exact(None, 1.0, 5e-3)),
        pressures(),
    ];
    let reference = reference("hertz/v1", "line contact of a cylinder on a flat", quantities);
    Ok(ComputedBenchmark { reference, entries: vec![pressed()?, boundary_elements_pressed()?] })
}

/// Tolerance of nodal pressures: end cells have an error of the root of twice their length over a.
const PRESSURE: f64 = 0.01;
/// The same at 0.95 a, within a cell or two of the end.
const PRESSURE_AT_END: f64 = 0.05;

fn pressures() -> Quantity {
    let place = |&x: &f64| exact(Some(x), ellipse(x), if x > 0.9 { PRESSURE_AT_END } else { PRESSURE });
    Words {
        name: "pressure",
        meaning: "Pressure over 2 P/(pi a)",
        unit: "1",
        source: HALF_SPACES,
        because: "1 % for ten cells per half-width; at 0.95 a the end cell is near, whose pressure errs by the root of its length",
    }
    .along("Distance from the middle over a", "1", PRESSURES.iter().map(place).collect())
}

pub fn partial_slip() -> Result<ComputedBenchmark, CaseError> {
    let (c, back) = (0.5f64.sqrt(), 0.75f64.sqrt());
    let along = |name, meaning, places: &[f64], value: &dyn Fn(f64) -> f64| {
        Words { name, meaning, unit: "1", source: HALF_SPACES, because: SHEAR_BECAUSE }.along(
            "Distance from the middle over a",
            "1",
            places
                .iter()
                .map(|&x| exact(Some(x), value(x), if x > 0.9 { PRESSURE_AT_END } else { SHEAR }))
                .collect(),
        )
    };
    let moment = |name, meaning, value| {
        let because =
            "an integral, in which errors of end cells nearly cancel; blocks of 20 half-widths leave 0.1 %";
        Words { name, meaning, unit: "1", source: HALF_SPACES, because }.one(exact(None, value, 0.01))
    };
    let loaded = |x: f64| cattaneo(x, c);
    let unloaded = |x: f64| cattaneo(x, c) - 2.0 * cattaneo(x, back);
    let quantities = vec![
        along("shear", "Shear traction over 2 mu P/(pi a), Q = mu P/2", &SHEARS, &loaded),
        moment("moment", "Second moment of shear over mu P a^2/8", 1.0 + 0.5),
        along("shear_unloaded", "Shear traction over 2 mu P/(pi a), unloaded to Q = 0", &UNLOADED, &unloaded),
        moment(
            "moment_unloaded",
            "Second moment of shear over mu P a^2/4, unloaded to Q = 0",
            (1.0 - c.powi(4)) - 2.0 * (1.0 - back.powi(4)),
        ),
    ];
    let reference =
        reference("partial-slip/v1", "partial slip of a line contact, and its reversal", quantities);
    Ok(ComputedBenchmark { reference, entries: vec![sheared()?, boundary_elements_sheared()?] })
}

/// Tolerance of nodal shear tractions.
const SHEAR: f64 = 0.02;
const SHEAR_BECAUSE: &str = "2 % for ten cells per half-width; at 0.95 a the end cell is near, whose traction errs by the root of its length";

/// Pressures or shear tractions over the peak pressure, at positions over a; means of both sides.
fn profile(at: &Tractions, values: &[f64], exact: &Hertz, places: &[f64]) -> Vec<f64> {
    let of = |x: f64| interpolated(&at.x, values, x * exact.a);
    places.iter().map(|&x| 0.5 * (of(x) + of(-x)) / exact.p0).collect()
}

/// Integral of x^2 times a traction.
fn second_moment(at: &Tractions, values: &[f64]) -> f64 {
    at.x.iter().zip(&at.area).zip(values).map(|((x, area), v)| x * x * area * v).sum()
}

fn exact_of(at: &Tractions) -> Hertz {
    Hertz::line(at.load[1], 0.1, compliance([(210e9, 0.3); 2]))
}

fn entry(discretisation: &str) -> Entry {
    Entry::new(
        "asperity",
        concat!("asperity ", env!("CARGO_PKG_VERSION")),
        "finite elements, mortar contact with dual functions, penalty",
        discretisation,
    )
}

const MESH: &str = "blocks of 20 half-widths, quad4, 40 cells per half-width";

fn pressed() -> Result<Entry, CaseError> {
    let at = hertz::simulate(&hertz::refined(hertz::line()?, CELLS / 20.0))?.tractions("press")?;
    let exact = exact_of(&at);
    let load: f64 = at.p.iter().zip(&at.area).map(|(p, area)| p * area).sum();
    Ok(entry(MESH)
        .with("peak_pressure", [at.peak() / exact.p0])
        .with("half_width", [2.0 * (second_moment(&at, &at.p) / load).sqrt() / exact.a])
        .with("pressure", profile(&at, &at.p, &exact, &PRESSURES)))
}

/// The scene with the cylinder displaced by `forth` \[m\] and then to `back` \[m\].
fn drawn(forth: f64, back: Option<f64>) -> Result<Scene, CaseError> {
    let mut scene = hertz::refined(hertz::sheared()?, CELLS / 20.0);
    let mut stages = vec![forth];
    stages.extend(back);
    let shear = scene.stages[1].clone();
    scene.stages.truncate(1);
    for (k, to) in stages.into_iter().enumerate() {
        let mut stage = shear.clone();
        stage.name = ["shear", "back"][k].into();
        for condition in &mut stage.conditions {
            condition.get_mut().x = Some(here(Motion::To(to)));
        }
        scene.stages.push(stage);
    }
    Ok(scene)
}

/// Shear tractions along x, the direction in which the cylinder is displaced: the tangent of the flat below points along -x.
fn along_x(mut at: Tractions) -> Tractions {
    at.q.iter_mut().for_each(|q| *q = -*q);
    at
}

/// Initial displacements in the search for Q = mu P/2 \[m\]: that of the scene and one near it.
const FORTH: [f64; 2] = [4e-6, 4.2e-6];
/// The same for Q = 0, where slip leaves a residual displacement.
const BACK: [f64; 2] = [0.0, 0.5e-6];
/// Tolerance of the load in the search, over mu P.
const MET: f64 = 1e-6;

/// Displacement at which the load of the last stage is `share` of mu P, by the secant method from two initial displacements, and
/// the tractions there.
fn loaded(
    share: f64,
    mut ways: [f64; 2],
    stage: &str,
    scene: impl Fn(f64) -> Result<Scene, CaseError>,
) -> Result<(f64, Tractions), CaseError> {
    let run = |way: f64| -> Result<(f64, Tractions), CaseError> {
        let at = along_x(hertz::simulate(&scene(way)?)?.tractions(stage)?);
        Ok((at.load[0] / (MU * at.load[1]) - share, at))
    };
    let mut before = run(ways[0])?.0;
    for _ in 0..20 {
        let (now, at) = run(ways[1])?;
        if now.abs() < MET {
            return Ok((ways[1], at));
        }
        ways = [ways[1], ways[1] - now * (ways[1] - ways[0]) / (now - before)];
        before = now;
    }
    Err("the shear load is not met in 20 runs".into())
}

fn sheared() -> Result<Entry, CaseError> {
    let (forth, at) = loaded(0.5, FORTH, "shear", |way| drawn(way, None))?;
    let (_, back) = loaded(0.0, BACK, "back", |way| drawn(forth, Some(way)))?;
    let shares = |at: &Tractions, places: &[f64]| -> Vec<f64> {
        profile(at, &at.q, &exact_of(at), places).iter().map(|q| q / MU).collect()
    };
    let moment = |at: &Tractions, part: f64| {
        second_moment(at, &at.q) / (MU * at.load[1] * exact_of(at).a.powi(2) / part)
    };
    Ok(entry(MESH)
        .with("shear", shares(&at, &SHEARS))
        .with("moment", [moment(&at, 8.0)])
        .with("shear_unloaded", shares(&back, &UNLOADED))
        .with("moment_unloaded", [moment(&back, 4.0)]))
}

/// The finest boundary-element run and its positions.
fn boundary_elements() -> Result<(Results, Vec<f64>), CaseError> {
    let all = Results::read(include_str!("../../independent/line_contact.json"))?;
    let last = all.at("runs")?.list()?.pop().ok_or("no runs")?;
    Ok((last, all.at("places")?.numbers()?))
}

fn picked(run: &Results, key: &str, known: &[f64], places: &[f64]) -> Result<Vec<f64>, CaseError> {
    let values = run.at(key)?.numbers()?;
    let at = |x: &f64| known.iter().position(|k| k == x).map(|k| values[k]);
    places.iter().map(|x| at(x).ok_or_else(|| format!("no {key} at {x}").into())).collect()
}

fn boundary_entry() -> Entry {
    Entry::new(
        "boundary-elements",
        "line_contact.py (numpy)",
        "boundary elements of constant traction on half-planes, sets by trial",
        "364 elements per half-width",
    )
}

fn boundary_elements_pressed() -> Result<Entry, CaseError> {
    let (run, known) = boundary_elements()?;
    Ok(boundary_entry()
        .with("peak_pressure", [run.at("largest pressure")?.number()?])
        .with("half_width", [run.at("half-width by the second moment")?.number()?])
        .with("pressure", picked(&run, "pressure", &known, &PRESSURES)?))
}

fn boundary_elements_sheared() -> Result<Entry, CaseError> {
    let (run, known) = boundary_elements()?;
    Ok(boundary_entry()
        .with("shear", picked(&run, "shear", &known, &SHEARS)?)
        .with("moment", [run.at("second moment of shear")?.number()?])
        .with("shear_unloaded", picked(&run, "shear after unloading", &known, &UNLOADED)?)
        .with("moment_unloaded", [run.at("second moment after unloading")?.number()?]))
}
