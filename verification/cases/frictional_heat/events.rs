//! First events of a slider with frictional heat against an independent program.

use crate::cases::seas;
use crate::{Capability, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity::kinds::faults::Report;
use asperity_cycles::Balance;
use asperity_cycles::heat::{PRESSURE, TEMPERATURE};
use asperity_ode::{Control, Outcome};
use asperity_vary::SceneText;

const SCENE: &str = include_str!("../../../scenes/thermal-pressurisation.toml");
const FILE: &str = include_str!("../../independent/frictional_heat.json");
/// The independent program.
const SOURCE: &str =
    "verification/independent/frictional_heat.py: finite volumes across the fault, scipy's BDF, extrapolated";
/// The law of the scene without the parameters that make it depend on temperature.
const COLD: &str = r#"{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.010, b = 0.015, l = "10 mm", v_ref = "1 um/s", v_initial = "1e-8 m/s" }"#;
/// The law with contacts that weaken.
const FLASH: &str = r#"{ kind = "rate-and-state", evolution = "flash", mu0 = 0.6, a = 0.010, b = 0.015, l = "10 mm", v_ref = "1 um/s", v_initial = "1e-8 m/s", mu_w = 0.3, v_w = "0.1 m/s" }"#;

/// Relative bound of the onset, and of the other quantities of an event.
const ONSET: f64 = 1e-6;
const EVENT: f64 = 5e-5;

/// Variants: name in the file of the independent program, description, and the scene.
fn variants() -> [(&'static str, &'static str, SceneText); 4] {
    let scene = || SceneText::new(SCENE).add("time.log_rate_tolerance", 1e-7);
    [
        ("pressurised", "friction that depends on temperature, and fluid", scene()),
        (
            "arrhenius",
            "friction that depends on temperature, no fluid",
            scene().without("faults.main.heat.pressurisation"),
        ),
        (
            "fluid",
            "fluid alone",
            scene().with("faults.main.law", COLD).add("faults.main.heat.temperature", "\"400 K\""),
        ),
        (
            "flash",
            "contacts that weaken at 1200 K, and fluid",
            scene()
                .with("faults.main.law", FLASH)
                .add("faults.main.heat.temperature", "\"400 K\"")
                .add("faults.main.heat.weakening_temperature", "\"1200 K\""),
        ),
    ]
}

/// The report of a run; slip, temperature, pressure and time in its event; and its cost.
struct HeatRun {
    report: Report,
    course: Vec<[f64; 4]>,
    cost: Cost,
}

/// Runs a scene to the end of its first event.
fn ran(scene: SceneText) -> Result<HeatRun, CaseError> {
    let plan = seas::plan(&scene.text()?)?;
    let mut balance = Balance::new(&plan.problem);
    let mut course = Vec::new();
    let mut watch = |now: &asperity_cycles::Moment<'_>| {
        balance.step(now);
        if now.under_way().is_some() {
            let time = now.at.seconds();
            course.push([
                now.slip().all()[0],
                now.pressed.values(&TEMPERATURE)[0],
                now.pressed.values(&PRESSURE)[0],
                time,
            ]);
        }
        Control::Go
    };
    let (run, cost) = Cost::measure(|| plan.problem.run(&plan.problem.settings, &mut watch));
    let run = run?;
    if let Outcome::Failed { reason } = &run.outcome {
        return Err(reason.to_string().into());
    }
    let cost = cost.count("steps", run.counts.steps as f64);
    let report = Report::new(&plan, &run, &mut balance);
    Ok(HeatRun { report, course, cost })
}

/// Values of the first event with their names in the file of the independent program, and units.
fn values(report: &Report) -> Result<Vec<(&'static str, &'static str, f64)>, CaseError> {
    let event = report.events.first().ok_or("no event")?;
    let heat = report.heat.first().ok_or("no heat in the report")?;
    let mut all = vec![
        ("onset", "s", event.onset),
        ("slip", "m", event.largest_slip),
        ("peak_rate", "m/s", event.peak_rate),
        ("duration_above", "s", event.duration_above),
        ("stress_drop", "Pa", event.stress_drop),
        ("largest_temperature", "K", heat.largest_temperature),
    ];
    all.extend(heat.largest_pressure.map(|pressure| ("largest_pressure", "Pa", pressure)));
    Ok(all)
}

/// Claims the events of all variants.
pub fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let file: serde_json::Value = serde_json::from_str(FILE)?;
    let mut figure = Plot::xy("Temperature in the event", "slip since the start [m]", "temperature [K]");
    for (name, what, scene) in variants() {
        let found = ran(scene)?;
        for (quantity, unit, value) in values(&found.report)? {
            let of = |kind: &str| file[name][kind][quantity].as_f64();
            let (limit, change) = of("limit").zip(of("change")).ok_or("the file lacks a value")?;
            ledger
                .claim(format!("first event of a slider with {what}: {quantity}"))
                .unit(unit)
                .value(value)
                .equals(limit)
                .relative(if quantity == "onset" { ONSET } else { EVENT })
                .uncertainty(change * limit.abs())
                .evidence(Evidence::OtherCode, SOURCE)
                .because("the uncertainty of the other program, up to 4e-5 for durations and 2e-8 for onsets, and a tolerance of 1e-7 in ln V over hundreds of steps")
                .why_not_tighter("one bound for all quantities and variants")
                .covers(&[Capability::FrictionalHeat])
                .cost(&found.cost)
                .record();
        }
        let hottest =
            found.course.iter().max_by(|a, b| a[1].total_cmp(&b[1])).ok_or("no step in the event")?;
        let when = found.report.heat.first().map_or(f64::NAN, |heat| heat.when);
        let onset = found.report.events.first().map_or(f64::NAN, |event| event.onset);
        ledger
            .claim(format!(
                "time of the largest temperature of a slider with {what}, since the onset of its event"
            ))
            .unit("s")
            .value(when - onset)
            .equals(hottest[3] - onset)
            .absolute(1e-6)
            .evidence(Evidence::Exact, "the step in which the surface is hottest")
            .because("rounding of a time of 1e9 seconds, twice")
            .why_not_tighter("the event lasts a minute or so, and the surface cools slowly after it")
            .covers(&[Capability::FrictionalHeat])
            .cost(&found.cost)
            .record();
        ledger
            .claim(format!("energy budget of a slider with {what}: imbalance over the largest part"))
            .value(found.report.energy.imbalance)
            .at_most(1e-5)
            .evidence(Evidence::Exact, "work of the loads is stored, radiated, or spent on friction")
            .because("a hundred times the tolerance of ln V")
            .why_not_tighter("errors of many steps may add up")
            .covers(&[Capability::FrictionalHeat])
            .cost(&found.cost)
            .record();
        let curve: Vec<(f64, f64)> = found.course.iter().map(|row| (row[0], row[1])).collect();
        figure = figure.series(Series::line(what, &curve));
    }
    ledger.plot(figure);
    Ok(())
}
