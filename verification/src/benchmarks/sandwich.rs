//! `sandwich/v1`: a block pressed against another and sheared.

use super::entry::Entry;
use super::independent::Results;
use super::limit::{self, Limit};
use super::parts::{
    ComputedBenchmark, MICROMETRE, PER_PASCAL, Words, exact, interpolated, optional, reference,
};
use crate::CaseError;
use crate::cases::sandwich::{self, PRESSED, Run, V_LOAD};
use asperity::kinds::bodies::mean;
use asperity_reference::benchmark::Quantity;

/// Heights of the slip probes \[m\] and the names of their quantities.
const HEIGHTS: [(f64, &str, &str); 3] = [
    (12.5e-3, "slip_y12", "Slip at y = 12.5 mm"),
    (25e-3, "slip_y25", "Slip at y = 25 mm"),
    (37.5e-3, "slip_y37", "Slip at y = 37.5 mm"),
];
/// Tolerance of the friction coefficient: 1 % of the slip rate, a dV/V.
const FRICTION: f64 = 1e-4;
/// Tolerance of slip per step in this program's entry \[m\]: a hundredth of the benchmark tolerances.
const STEP: f64 = 2e-10;
/// Cell size of this program's entry \[mm\].
const SIZE: f64 = 0.3125;

const SLIP_BECAUSE: &str = "cells of 2.5 mm err by up to 0.015 um; no less than three times the uncertainty";
const FOUR: &str = "limit of scikit-fem and scipy on cells of 2.5, 1.25, 0.625 and 0.3125 mm";

pub fn make() -> Result<ComputedBenchmark, CaseError> {
    let histories = Results::read(include_str!("../../independent/sandwich_histories.json"))?;
    let results = Results::read(include_str!("../../independent/results.json"))?;
    let reference = reference(
        "sandwich/v1",
        "a block pressed against another and sheared",
        quantities(&results, &histories)?,
    );
    let entries = vec![here(&moved(&histories)?)?, independent(&results, &histories)?];
    Ok(ComputedBenchmark { reference, entries })
}

/// Displacements of the upper edge at which histories are given \[um\].
fn moved(histories: &Results) -> Result<Vec<f64>, CaseError> {
    Ok(histories.at("u_y [mm]")?.numbers()?.iter().map(|u| (u * 1e4).round() / 10.0).collect())
}

/// Mean normal traction after pressing on the four meshes \[MPa\].
fn pressed(results: &Results, variant: &str) -> Result<Vec<f64>, CaseError> {
    let runs = results.at(variant)?;
    let of = |h: &str| runs.at(h)?.at("mean_normal_stress_mpa")?.number();
    ["2.5", "1.25", "0.625", "0.3125"].into_iter().map(of).collect()
}

/// Slip histories on the four meshes \[um\], indexed by mesh, displacement and height.
fn slips(histories: &Results) -> Result<Vec<Vec<Vec<f64>>>, CaseError> {
    histories.at("meshes")?.list()?.iter().map(|m| m.at("slip [um], rows u_y, columns y")?.rows()).collect()
}

fn shears(histories: &Results) -> Result<Vec<Vec<f64>>, CaseError> {
    histories.at("meshes")?.list()?.iter().map(|m| m.at("mean shear traction [MPa]")?.numbers()).collect()
}

fn quantities(results: &Results, histories: &Results) -> Result<Vec<Quantity>, CaseError> {
    let ways = moved(histories)?;
    let along = |words: Words, values: &dyn Fn(usize) -> Vec<f64>, tolerance: f64| {
        let limits = ways.iter().enumerate().map(|(k, way)| (*way, Limit::from_values(&values(k))));
        let places = limit::places(&limits.collect::<Vec<_>>(), tolerance);
        words.along("Way of the upper edge", "um", places)
    };
    let mut all = vec![
        Words {
            name: "mean_normal_traction",
            meaning: "Mean normal traction after the press",
            unit: "MPa",
            source: FOUR,
            because: "cells of 2.5 mm err by 0.027 MPa",
        }
        .one(Limit::from_values(&pressed(results, "base")?).place(None, 0.03)),
    ];
    let slips = slips(histories)?;
    for (j, (_, name, meaning)) in HEIGHTS.into_iter().enumerate() {
        let words = Words { name, meaning, unit: "um", source: FOUR, because: SLIP_BECAUSE };
        all.push(along(words, &|k| slips.iter().map(|mesh| mesh[k][j]).collect(), 0.02));
    }
    let shears = shears(histories)?;
    let words = Words {
        name: "mean_shear_traction",
        meaning: "Mean shear traction",
        unit: "MPa",
        source: FOUR,
        because: "cells of 2.5 mm err by up to 0.05 MPa, by the singular corners that slip first",
    };
    all.push(along(words, &|k| shears.iter().map(|mesh| mesh[k]).collect(), 0.06));
    all.push(
        Words {
            name: "friction_end",
            meaning: "Friction coefficient at the end, at y = 25 mm",
            unit: "1",
            source: "closed form: mu0 + a ln(V_load/Vref)",
            because: "1 % of the slip rate, a dV/V",
        }
        .one(exact(None, 0.6, FRICTION)),
    );
    all.push(optional(
        Words {
            name: "mean_normal_traction_wide",
            meaning: "Mean normal traction after the press, A 50 mm wide",
            unit: "MPa",
            source: FOUR,
            because: "cells of 2.5 mm err by 0.012 MPa",
        }
        .one(Limit::from_values(&pressed(results, "w_A_50_mm")?).place(None, 0.015)),
    ));
    all.push(optional(no_overhang()));
    Ok(all)
}

/// Pressing without overhang: two bars in series with a rigid contact.
fn no_overhang() -> Quantity {
    let (young, poisson, width, way) = (44.8e3, 0.12, 50.0, 9.66e-3);
    Words {
        name: "mean_normal_traction_no_overhang",
        meaning: "Mean normal traction after the press, B as high as A",
        unit: "MPa",
        source: "closed form: E u_x/((1 - nu^2) 50 mm)",
        because: "the compliance of a penalty of 100 E/h takes 0.05 % with cells of 2.5 mm",
    }
    .one(exact(None, young * way / ((1.0 - poisson * poisson) * width), 0.005))
}

/// Values at displacements of the upper edge, interpolated from the steps of a run.
fn history(run: &Run, ways: &[f64], values: &[f64]) -> Vec<f64> {
    let time = |way: &f64| PRESSED + way * MICROMETRE / V_LOAD;
    ways.iter().map(|way| interpolated(run.record.times(), values, time(way))).collect()
}

fn here(ways: &[f64]) -> Result<Entry, CaseError> {
    let run = sandwich::simulate(&sandwich::tolerance(sandwich::size(sandwich::base()?, SIZE), STEP))?;
    let wide =
        sandwich::simulate(&sandwich::press_only(sandwich::wide(sandwich::size(sandwich::base()?, SIZE))))?;
    let level = sandwich::simulate(&sandwich::press_only(sandwich::no_overhang(sandwich::size(
        sandwich::base()?,
        SIZE,
    ))))?;
    let points = &run.record.histories()[0].points;
    let mut entry = Entry::new(
        "asperity",
        concat!("asperity ", env!("CARGO_PKG_VERSION")),
        "finite elements, node-to-point contact by penalty, backward Euler",
        "quad4, cells of 0.3125 mm, error of slip in a step 0.2 nm",
    )
    .with("mean_normal_traction", [run.mean_normal("press")?])
    .with("mean_normal_traction_wide", [wide.mean_normal("press")?])
    .with("mean_normal_traction_no_overhang", [level.mean_normal("press")?]);
    for (y, name, _) in HEIGHTS {
        let slip: Vec<f64> = points[run.node_at(y)?].slip.iter().map(|s| s.abs() / MICROMETRE).collect();
        entry = entry.with(name, history(&run, ways, &slip));
    }
    let areas = run.record.areas(0);
    let shear: Vec<f64> = (0..run.record.times().len())
        .map(|step| {
            let at: Vec<f64> = points.iter().map(|p| p.shear_traction[step].abs() * PER_PASCAL).collect();
            mean(&at, areas)
        })
        .collect();
    let friction = run.end("shear")?.friction[run.node_at(25e-3)?].abs();
    Ok(entry.with("mean_shear_traction", history(&run, ways, &shear)).with("friction_end", [friction]))
}

fn independent(results: &Results, histories: &Results) -> Result<Entry, CaseError> {
    let last = |values: Vec<f64>| [values[values.len() - 1]];
    let slips = slips(histories)?;
    let mut entry = Entry::new(
        "scikit-fem",
        "scikit-fem 12.0.2 and scipy 1.17.1",
        "finite elements, flexibilities of the faces, penalty, Radau IIA",
        "quad4, cells of 0.3125 mm, relative tolerance 1e-10",
    )
    .with("mean_normal_traction", last(pressed(results, "base")?))
    .with("mean_normal_traction_wide", last(pressed(results, "w_A_50_mm")?))
    .with("mean_normal_traction_no_overhang", last(pressed(results, "no_overhang")?));
    for (j, (_, name, _)) in HEIGHTS.into_iter().enumerate() {
        entry = entry.with(name, slips[3].iter().map(|row| row[j]).collect::<Vec<_>>());
    }
    let friction = results.at("base")?.at("0.3125")?.at("end_mu_min_max")?.numbers()?[0];
    Ok(entry.with("mean_shear_traction", shears(histories)?[3].clone()).with("friction_end", [friction]))
}
