//! An event of an interface whose slip rate grows and falls exponentially, as shear traction follows ramps.

use super::texts::{self, BodyRun};
use super::{COLUMN, NORMAL, PRESSED, SHEAR, WIDTH};
use crate::cases::run_files::{self, Table};
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity::catalogue::Entry;
use asperity_vary::SceneText;

/// Friction `mu0 + a ln(V/v_ref)`, with `v_ref` in \[m/s\].
const MU0: f64 = 0.6;
const A: f64 = 0.010;
const V_REF: f64 = 1e-6;
/// Slip rates at which the event begins and ends, and the largest one \[m/s\].
const ON: f64 = 1e-3;
const OFF: f64 = 0.5e-3;
const PEAK: f64 = 5e-3;
/// Times in which the slip rate grows and falls by a factor of e \[s\].
const GROWS: f64 = 1.0;
const FALLS: f64 = 0.5;
/// Time from the end of pressing to the beginning of slow growth, and from there to the peak \[s\].
const FAST: f64 = 2.0;
const SLOW: f64 = 4.0;

/// Length of steps \[s\], for few of them, and a tolerance of slip that admits them \[m\].
const STEP: f64 = 0.2;
const LOOSE: f64 = 1e-3;

/// The same column by steps of a fifth of a second, beside another that does not slip.
///
/// # Errors
/// If a key of the scene is not as expected.
pub(in crate::cases) fn coarse() -> Result<SceneText, CaseError> {
    Ok(beside(scene()?)
        .with("stages[0].steps", 5)
        .add("time.tolerance", format!("{LOOSE:?}"))
        .add("time.friction_tolerance", "1e-3")
        .add("time.first_step", format!("{STEP:?}"))
        .add("time.max_step", format!("{STEP:?}")))
}

/// Distance of a second column \[m\], which is pressed alike and not sheared.
const APART: f64 = 1.0;

/// Adds a second column on its base.
fn beside(scene: SceneText) -> SceneText {
    let block = |min: [f64; 2], max: [f64; 2], divisions: &str| {
        let [min, max] = [min, max].map(|[x, y]| [APART + x, y]);
        format!(
            r#"{{ mesh.block = {{ min = {min:?}, max = {max:?}, divisions = {divisions}, element = "quad4" }}, material = "column" }}"#
        )
    };
    let scene = scene
        .add("bodies.still", block([0.0, 0.0], [WIDTH, 0.2], "[2, 2]"))
        .add("bodies.stand", block([-0.05, -0.05], [WIDTH + 0.05, 0.0], "[5, 1]"))
        .add(
            "interfaces.calm",
            format!(
                r#"{{ slave = "still.bottom", master = "stand.top", measure = "node-to-point", sliding = "small", enforcement = {{ kind = "penalty", normal = "1000 GPa/m", tangential = "1000 GPa/m" }}, {} }}"#,
                law()
            ),
        )
        .with("stages[0].frictionless", r#"["fault", "calm"]"#);
    let pressed = |x: &str| format!(r#"{x}y = {{ to = "-10 um" }}"#);
    [
        ("stand.top", "x = 0, y = 0".to_string()),
        ("stand.bottom", "x = 0, y = 0".to_string()),
        ("stand.left", "x = 0, y = 0".to_string()),
        ("stand.right", "x = 0, y = 0".to_string()),
        ("still.top", pressed("x = 0, ")),
        ("still.left", pressed("")),
        ("still.right", pressed("")),
        ("still.bottom", pressed("x = 0, ")),
    ]
    .into_iter()
    .fold(scene, |scene, (set, motion)| {
        scene.push("stages[0].conditions", format!(r#"{{ set = "{set}", {motion} }}"#))
    })
}

/// Key of the law.
fn law() -> String {
    format!(r#"law = {{ kind = "rate", mu0 = {MU0:?}, a = {A:?}, v_ref = {V_REF:?} }}"#)
}

/// The column of `interface_rate_state` under a traction whose ramps make the slip rate grow and fall exponentially, without a state.
///
/// # Errors
/// If a key of the scene is not as expected.
fn scene() -> Result<SceneText, CaseError> {
    let peak = MU0 + A * (PEAK / V_REF).ln();
    let rows = [
        (0.0, 0.0),
        (FAST, peak - A * SLOW / GROWS),
        (FAST + SLOW, peak),
        (FAST + 2.0 * SLOW, peak - A * SLOW / FALLS),
    ];
    let rows = rows.map(|(time, friction)| format!("[{time:?}, {:?}]", friction * NORMAL));
    let scene = (2..6).rev().fold(SceneText::new(COLUMN), |scene, k| scene.without(&format!("stages[{k}]")));
    Ok(scene
        .add("interfaces.fault.measure", "node-to-point")
        .add("interfaces.fault.sliding", "small")
        .with("interfaces.fault.law", law().trim_start_matches("law = "))
        .with("stages[1].duration", format!("{:?}", FAST + 2.0 * SLOW))
        .with("stages[1].conditions[0].x", "free")
        .add("stages[1].conditions[0].traction", format!("[{{ table = [{}] }}, 0]", rows.join(", ")))
        .add("events", format!("{{ above = {ON:?}, below = {OFF:?} }}")))
}

/// Slip rate at a time since the end of pressing, in the slow ramps \[m/s\].
fn rate(time: f64) -> f64 {
    let since = time - FAST - SLOW;
    PEAK * (if since < 0.0 { since / GROWS } else { -since / FALLS }).exp()
}

/// Share of the slip of a step that has passed when the slip rate, which is exponential in time, reaches a value.
fn share([from, to]: [f64; 2], value: f64) -> f64 {
    (value - from) / (to - from)
}

/// Claims onset, duration and slip of the event.
pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = texts::simulate(&coarse()?.text()?)?;
    let [event] = super::events(&done)? else { return Err("not one event".into()) };
    let (rise, fall) = ((PEAK / ON).ln() * GROWS, (PEAK / OFF).ln() * FALLS);
    let times = [event.onset - PRESSED, event.onset - PRESSED + event.duration];
    ledger
        .claim("event whose slip rate grows and falls exponentially: onset and end")
        .unit("s")
        .values(&times)
        .equals_each(&[FAST + SLOW - rise, FAST + SLOW + fall])
        .absolute(1e-8)
        .evidence(Evidence::Exact, "a ramp of traction makes ln V grow at its rate over a f_n")
        .because("between ends of steps ln V is linear, as here; balance of forces to 1e-11 of what presses, over a: 1e-9 of ln V")
        .why_not_tighter("where the last iteration of Newton's method ends below its tolerance is chance")
        .covers(&[Capability::InterfaceStates, Capability::Events])
        .cost(&done.cost)
        .record();
    // Slip of the steps themselves has the error of the rule of slip rates; what lies between the thresholds is a share of them.
    let clock = done.record.times();
    let history = done.record.history("fault").ok_or("no interface")?;
    let slips = &history.points[0].slip;
    let at = |time: f64, value: f64| -> Result<f64, CaseError> {
        let k = clock.iter().position(|t| t - PRESSED >= time).filter(|k| *k > 0).ok_or("no step")?;
        let share = share([clock[k - 1], clock[k]].map(|t| rate(t - PRESSED)), value);
        Ok(slips[k - 1] + share * (slips[k] - slips[k - 1]))
    };
    let between = (at(times[1], OFF)? - at(times[0], ON)?).abs();
    ledger
        .claim("the same event: slip between its thresholds, against the slip of its steps")
        .unit("m")
        .value(event.mean_slip)
        .equals(between)
        .relative(1e-7)
        .evidence(
            Evidence::Exact,
            "shares of the steps with onset and end: under exponential growth slip follows the slip rate",
        )
        .because("as for onset and end: 1e-9 of ln V, at some points that slip alike")
        .why_not_tighter("where the last iteration of Newton's method ends below its tolerance is chance")
        .covers(&[Capability::InterfaceStates, Capability::Events])
        .cost(&done.cost)
        .record();
    derived(ledger, &done, event);
    on_its_interface(ledger, &done, event)?;
    catalogue(ledger)?;
    let fine = texts::simulate(&scene()?.text()?)?;
    let [event] = super::events(&fine)? else { return Err("not one event".into()) };
    ledger
        .claim("an event under exponential growth: slip between its thresholds, by short steps")
        .unit("m")
        .value(event.mean_slip)
        .equals(GROWS * (PEAK - ON) + FALLS * (PEAK - OFF))
        .relative(4e-4)
        .evidence(Evidence::Exact, "differences of slip rates over their rates of growth")
        .because("the default bounds the error of slip of a step by 2e-5 of the largest motion that is given, 2e-10 m, over 1e4 steps")
        .why_not_tighter("how many steps a tolerance takes is up to their control")
        .covers(&[Capability::InterfaceStates, Capability::Events])
        .cost(&fine.cost)
        .record();
    Ok(())
}

/// Claims about numbers that follow from rates, tractions and slip of the event.
fn derived(ledger: &mut Ledger, done: &BodyRun, event: &Entry) {
    // The time above the upper threshold, and the drop of friction from one threshold to the other.
    let (above, drop) = ((PEAK / ON).ln() * (GROWS + FALLS), A * NORMAL * (ON / OFF).ln());
    let moment = SHEAR * event.area * event.mean_slip;
    let ratios = [
        event.area / WIDTH,
        event.moment / moment,
        event.peak_rate / PEAK,
        event.duration_above / above,
        event.stress_drop / drop,
    ];
    ledger
        .claim("the same event: area, moment, largest slip rate, time above the upper threshold and stress drop, over what they should be")
        .values(&ratios)
        .equals_each(&[1.0; 5])
        .relative(1e-8)
        .evidence(Evidence::Exact, "G times area times slip of the whole bottom; the slip rate where the load turns; ln V is linear in time, and friction is a ln V")
        .because("as for onset and end")
        .why_not_tighter("where the last iteration of Newton's method ends below its tolerance is chance")
        .covers(&[Capability::InterfaceStates, Capability::Events])
        .cost(&done.cost)
        .record();
}

/// Claims about the same event in its file.
fn catalogue(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (files, cost) = run_files::by_program(&twice()?.text()?)?;
    let table = files.table("out/events.csv")?;
    let of = |name: &str| -> Result<f64, CaseError> { Ok(*table.column(name)?.first().ok_or("no event")?) };
    let (rise, fall) = ((PEAK / ON).ln() * GROWS, (PEAK / OFF).ln() * FALLS);
    let onset = PRESSED + FAST + SLOW - rise;
    let slip = of("mean_slip")?;
    let ratios = [
        of("onset")? / onset,
        of("duration")? / (rise + fall),
        of("end")? / (onset + rise + fall),
        of("duration_above")? / ((PEAK / ON).ln() * (GROWS + FALLS)),
        of("peak_rate")? / PEAK,
        of("stress_drop")? / (A * NORMAL * (ON / OFF).ln()),
        of("area")? / WIDTH,
        of("largest_slip")? / slip,
        of("moment")? / (SHEAR * WIDTH * slip),
    ];
    ledger
        .claim("the same event in events.csv: onset, duration, end, time above the upper threshold, largest slip rate, stress drop, area, largest slip over the mean, and moment, over what they should be")
        .values(&ratios)
        .equals_each(&[1.0; 9])
        .relative(1e-8)
        .evidence(Evidence::Exact, "ramps of traction make ln V linear in time, and the whole bottom slips alike")
        .because("as for onset and end")
        .why_not_tighter("where the last iteration of Newton's method ends below its tolerance is chance")
        .covers(&[Capability::InterfaceStates, Capability::Events, Capability::Outputs])
        .cost(&cost)
        .record();
    let [x, y, z] = [of("x")?, of("y")?, of("z")?];
    let off = [
        usize::from(!(0.0..=WIDTH).contains(&x)),
        usize::from(y != 0.0 || z != 0.0),
        table.column("onset")?.len().abs_diff(2),
    ];
    ledger
        .claim("the same event in events.csv: coordinates of its hypocentre that lie off the bottom, and missing or further events")
        .count(off.iter().sum::<usize>() as u64, 0)
        .evidence(Evidence::Exact, "only the bottom of the column that is sheared slips, twice")
        .because("a count")
        .covers(&[Capability::InterfaceStates, Capability::Events, Capability::Outputs])
        .cost(&cost)
        .record();
    second(ledger, &table, &cost)
}

/// Time from one peak of the slip rate to the next \[s\].
const AGAIN: f64 = SLOW * GROWS / FALLS + SLOW;

/// Scene of the coarse run whose traction grows and falls once more at the same pace.
fn twice() -> Result<SceneText, CaseError> {
    let peak = MU0 + A * (PEAK / V_REF).ln();
    let [low, first] = [peak - A * SLOW / FALLS, peak - A * SLOW / GROWS];
    let turns = FAST + 2.0 * SLOW;
    let rows = [(0.0, 0.0), (FAST, first), (FAST + SLOW, peak), (turns, low)];
    let again = [(FAST + SLOW + AGAIN, peak), (turns + AGAIN, low)];
    let rows: Vec<String> = rows
        .into_iter()
        .chain(again)
        .map(|(time, friction)| format!("[{time:?}, {:?}]", friction * NORMAL))
        .collect();
    Ok(coarse()?
        .with("stages[1].duration", format!("{:?}", turns + AGAIN))
        .with("stages[1].conditions[0].traction", format!("[{{ table = [{}] }}, 0]", rows.join(", "))))
}

/// Claims about the second of two events at a distance in time, in the table of events.
fn second(ledger: &mut Ledger, table: &Table, cost: &Cost) -> Result<(), CaseError> {
    let interval: f64 = table.words("interval")?.last().ok_or("no event")?.parse()?;
    ledger
        .claim("two such events in events.csv: interval between their onsets")
        .unit("s")
        .value(interval)
        .equals(AGAIN)
        .relative(1e-8)
        .evidence(Evidence::Exact, "the ramps of traction repeat after twelve seconds")
        .because("as for onset and end")
        .why_not_tighter("where the last iteration of Newton's method ends below its tolerance is chance")
        .covers(&[Capability::InterfaceStates, Capability::Events, Capability::Outputs])
        .cost(cost)
        .record();
    let named = table.words("surface")?.iter().filter(|name| **name != "fault").count();
    let mut filled = 0;
    for column in ["hypocentre_along", "magnitude", "rupture_length"] {
        filled += table.words(column)?.iter().filter(|word| !word.is_empty()).count();
    }
    ledger
        .claim("two such events in events.csv: names in surface of other interfaces, and numbers in hypocentre_along, magnitude and rupture_length")
        .count((named + filled) as u64, 0)
        .evidence(Evidence::Exact, "the interface that is sheared; those numbers are of faults, and interfaces have none")
        .because("a count")
        .covers(&[Capability::InterfaceStates, Capability::Events, Capability::Outputs])
        .cost(cost)
        .record();
    Ok(())
}

/// Claims where the event is.
fn on_its_interface(ledger: &mut Ledger, done: &BodyRun, event: &Entry) -> Result<(), CaseError> {
    let [x, y, _] = event.hypocentre;
    let apart = &done.report.events.as_ref().ok_or("the scene has no events")?.interfaces;
    let counts = apart.iter().map(|of| {
        let own = of.events.iter().filter(|event| event.surface == of.surface).count();
        own.abs_diff(usize::from(of.surface == "fault")) + of.events.len() - own
    });
    let off = [
        usize::from(event.surface != "fault"),
        usize::from(!(0.0..=WIDTH).contains(&x) || y != 0.0),
        apart.len().abs_diff(2),
        counts.sum(),
    ];
    ledger
        .claim("the same event beside an interface that does not slip: its interface, its hypocentre, and events of each of both that are wrong")
        .count(off.iter().sum::<usize>() as u64, 0)
        .evidence(Evidence::Exact, "only the column that is sheared slips")
        .because("a count")
        .covers(&[Capability::InterfaceStates, Capability::Events])
        .cost(&done.cost)
        .record();
    Ok(())
}
