//! Two sliders on springs of their own, of which one is pressed by a course: names and ends of their events, and their histories; and the
//! steps of a slider that becomes steady.

use super::{NORMAL, law};
use crate::cases::run_files::{self, Folder};
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use serde_json::Value;

/// Names of the sliders and stiffnesses of their springs \[Pa/m\].
const SLIDERS: [(&str, f64); 2] = [("soft", 1.25e9), ("stiff", 1.75e9)];
/// Rate of the load point \[m/s\], and end of the run \[s\].
const LOAD: f64 = 1e-6;
const END: f64 = 1000.0;
/// Times \[s\] and values \[Pa\] of the normal traction of the first slider.
const COURSE: [[f64; 2]; 3] = [[0.0, 5e6], [400.0, 5.2e6], [END, 4.9e6]];
/// Change of ln V between rows.
const CHANGE: f64 = 0.1;

fn scene() -> String {
    let law = law("ageing", "0.015", "l = \"10 um\"");
    let course: Vec<String> = COURSE.iter().map(|[t, value]| format!("[{t:?}, {value:?}]")).collect();
    let normals = [format!("{{ table = [{}] }}", course.join(", ")), format!("{NORMAL:?}")];
    let sliders: String = SLIDERS
        .iter()
        .zip(normals)
        .map(|((name, stiffness), normal)| {
            format!(
                "[sliders.{name}]\nnormal = {normal}\nstiffness = {stiffness:e}\ndamping = \"5 MPa s/m\"\nstart = \"1.5 um/s\"\nlaw = {law}\n"
            )
        })
        .collect();
    format!(
        "schema = 1\ntitle = \"a pair\"\nkinematics = \"spring-slider\"\n[load]\nrate = {LOAD:e}\n{sliders}\
         [time]\nend = {END:?}\ntolerance = 1e-9\n[events]\nabove = \"0.1 mm/s\"\n[output]\nchange = {CHANGE:e}\n"
    )
}

/// The normal traction of the first slider at a time.
fn pressing(time: f64) -> f64 {
    let k = if time <= COURSE[1][0] { 1 } else { 2 };
    let ([t0, n0], [t1, n1]) = (COURSE[k - 1], COURSE[k]);
    n0 + (time - t0) / (t1 - t0) * (n1 - n0)
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (files, cost) = run_files::by_program(&scene())?;
    let events = files.table("out/events.csv")?;
    let column = |name: &str| events.column(name);
    let (onsets, durations, slips) = (column("onset")?, column("duration")?, column("slip")?);
    let (drops, ends) = (column("stress_drop")?, column("end")?);
    let names = events.words("surface")?;
    let (mut worst, mut late) = (0.0_f64, 0.0_f64);
    for (k, name) in names.iter().enumerate() {
        let (_, stiffness) = SLIDERS.iter().find(|slider| slider.0 == *name).ok_or("no such slider")?;
        worst = worst.max((drops[k] / (stiffness * (slips[k] - LOAD * durations[k])) - 1.0).abs());
        late = late.max((ends[k] - onsets[k] - durations[k]).abs());
    }
    if SLIDERS.iter().any(|slider| names.iter().filter(|name| **name == slider.0).count() < 2) {
        return Err("a slider has fewer than two events".into());
    }
    ledger
        .claim("events.csv of two sliders on springs of 1.25 and 1.75 GPa/m: stress drop over what the spring of the slider in the column surface loses")
        .value(1.0 + worst)
        .equals(1.0)
        .absolute(1e-9)
        .evidence(Evidence::Exact, "k (slip - V_load duration), with the stiffness of the slider of that name")
        .because("differences of slips of a millimetre, which carry rounding of 1e-12 of 0.1 mm")
        .why_not_tighter("it is printed and read again; springs differ by forty per cent")
        .cost(&cost)
        .record();
    ledger
        .claim("events.csv of two sliders: end less onset and duration, largest")
        .unit("s")
        .value(late)
        .at_most(1e-11)
        .evidence(Evidence::Exact, "an event lasts from its onset to its end")
        .because("times have fifteen digits: half of 1e-12 s twice")
        .why_not_tighter("the last digit may be off by any part of a half")
        .cost(&cost)
        .record();
    for (number, (name, _)) in SLIDERS.iter().enumerate() {
        history(ledger, (&files, &cost), number, name)?;
    }
    steps(ledger)
}

/// Lengths of steps of a slider that becomes steady, of which each has one row.
fn steps(ledger: &mut Ledger) -> Result<(), CaseError> {
    let law = law("ageing", "0.005", "l = \"10 um\"");
    let text = format!(
        "schema = 1\ntitle = \"steps\"\nkinematics = \"spring-slider\"\n[load]\nrate = {LOAD:e}\n\
         [sliders.block]\nnormal = {NORMAL:?}\nstiffness = 1.25e9\nstart = \"1.5 um/s\"\nlaw = {law}\n\
         [time]\nend = 60.0\n[output]\nchange = 1\n"
    );
    let (files, cost) = run_files::by_program(&text)?;
    let table = files.table("out/history/block.csv")?;
    let times = table.column("time")?;
    let apart: Vec<f64> =
        std::iter::once(0.0).chain(times.windows(2).map(|pair| pair[1] - pair[0])).collect();
    let report: Value = serde_json::from_str(&files.text("out/report.json")?)?;
    let taken = report["counts"]["steps"].as_u64().ok_or("no number of steps")?;
    if taken < 5 || times.len() as u64 != taken + 1 {
        return Err(format!("{} rows of {taken} steps", times.len()).into());
    }
    ledger
        .claim(
            "history of a slider that becomes steady: step in all rows, of which each is the end of a step",
        )
        .unit("s")
        .values(&table.column("step")?)
        .equals_each(&apart)
        .absolute(1e-12)
        .evidence(Evidence::Exact, "the times of the rows, as many as steps in the report")
        .because("rounding of times of a minute")
        .why_not_tighter("all digits are written")
        .cost(&cost)
        .record();
    Ok(())
}

/// Loads and normal tractions in the rows of a history.
fn history(
    ledger: &mut Ledger,
    (files, cost): (&Folder, &Cost),
    number: usize,
    name: &str,
) -> Result<(), CaseError> {
    let table = files.table(&format!("out/history/{name}.csv"))?;
    let times = table.column("time")?;
    let (loads, normals) = (table.column("load")?, table.column("normal_traction")?);
    let mut worst = [0.0_f64; 2];
    for k in 1..times.len() {
        let wanted = if number == 0 { pressing(times[k]) } else { NORMAL };
        let off = [loads[k] / (LOAD * times[k]) - 1.0, normals[k] / wanted - 1.0];
        worst = std::array::from_fn(|c| worst[c].max(off[c].abs()));
    }
    ledger
        .claim(format!(
            "history of the slider {name}: load and normal_traction in all rows, largest relative errors"
        ))
        .values(&worst)
        .equals_each(&[0.0; 2])
        .absolute(1e-12)
        .evidence(Evidence::Exact, "V t, and the course of the scene at the times of the rows")
        .because("all digits are written: rounding")
        .why_not_tighter("rounding")
        .covers(&[Capability::Slider])
        .cost(cost)
        .record();
    Ok(())
}
