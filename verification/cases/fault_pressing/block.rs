//! The block of `sandwich_state`, pressed by a stage.

use super::ROUNDING;
use crate::cases::run_files::WrittenRun;
use crate::cases::seas;
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity::kinds::faults::Report;
use asperity_cycles::{Balance, Moment, Rupture};
use asperity_ode::Control;
use asperity_plan::faults::Plan;
use asperity_run::Event;
use asperity_vary::SceneText;

const BLOCK: &str = include_str!("block.toml");
/// The same block under given tractions.
const SCENE: &str = include_str!("../../../scenes/sandwich-state.toml");

/// Young's modulus \[Pa\] and Poisson's ratio.
const ELASTIC: [f64; 2] = [44.8e9, 0.12];
/// Displacement that presses, width and height of both blocks \[m\].
const PUSH: f64 = 0.0966e-3;
const WIDTH: f64 = 50e-3;
const HEIGHT: f64 = 50e-3;
/// Place of the sampled point \[m\].
const POINT: [f64; 2] = [10e-3, 30e-3];

/// The block, drawn for so long after it has been pressed.
pub(in crate::cases) fn pressed(duration: &str) -> SceneText {
    SceneText::new(BLOCK).with_or_same("stages[1].duration", duration)
}

/// A run, and its last state: sums of f_n, of tau, and of tau without the lower end of the face \[N/m\].
struct BlockRun {
    plan: Plan,
    report: Report,
    forces: [f64; 3],
    events: Vec<Event<Rupture>>,
    cost: Cost,
}

fn done(scene: SceneText, number: usize) -> Result<BlockRun, CaseError> {
    let mut plan = seas::plan(&scene.text()?)?;
    plan.problem.settings.most_events = Some(number);
    let mut balance = Balance::new(&plan.problem);
    let areas: Vec<f64> = plan.points.iter().map(|p| p.area).collect();
    let mut forces = [0.0; 3];
    let mut watch = |now: &Moment<'_>| {
        balance.step(now);
        let m = now.m();
        let over = |f: &dyn Fn(usize) -> f64| (0..areas.len()).map(|p| areas[p] * f(p)).sum::<f64>();
        // Traction of the bodies, which damping and friction resist.
        let drive = |p: usize| {
            let fault = &plan.problem.fault;
            now.normal(p) * fault.law.scale(p) * m.component(0)[p]
                + fault.damping[p] * now.rate.component(0)[p]
        };
        let above = |p: usize| if plan.points[p].at[1] > 0.0 { drive(p) } else { 0.0 };
        forces = [over(&|p| now.normal(p)), over(&drive), over(&above)];
        Control::Go
    };
    let (run, cost) = Cost::measure(|| plan.problem.run(&plan.problem.settings, &mut watch));
    let run = run?;
    let report = Report::new(&plan, &run, &mut balance);
    let events = run.events().to_vec();
    drop(balance);
    Ok(BlockRun { plan, report, forces, events, cost })
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    at_start(ledger)?;
    takes_over(ledger)?;
    balance(ledger)?;
    through(ledger)?;
    events(ledger)
}

/// Tractions, displacement and force before anything slips.
fn at_start(ledger: &mut Ledger) -> Result<(), CaseError> {
    // The load point moves by 1e-15 m.
    let BlockRun { plan, report, cost, .. } = done(pressed("1e-9 s"), 1)?;
    let [young, poisson] = ELASTIC;
    let normal = young * PUSH / ((1.0 - poisson * poisson) * WIDTH);
    let off = plan.problem.fault.normal.iter().map(|f| (f / normal - 1.0).abs()).fold(0.0, f64::max);
    let shear = super::shear(&plan).iter().fold(0.0_f64, |m, t| m.max(t.abs())) / normal;
    // Uniaxial stress in plane strain: the block widens by nu/(1 - nu) of what it is shortened by.
    let point = &report.points[0].values;
    let wanted = [PUSH * (1.0 - POINT[0] / WIDTH), poisson / (1.0 - poisson) * PUSH / WIDTH * POINT[1]];
    let moved = (0..2).map(|c| (point.displacement[c] - wanted[c]).abs()).fold(0.0, f64::max) / PUSH;
    let stress = (point.stress[0] / -normal - 1.0).abs();
    let force = (report.forces[0].value[0] / (normal * HEIGHT) - 1.0).abs();
    ledger
        .claim("the block at the start: errors of f_n, tau, displacement and stress at a point, and of the force that presses, relative")
        .values(&[off, shear, moved, stress, force])
        .equals_each(&[0.0; 5])
        .absolute(ROUNDING)
        .evidence(Evidence::Exact, "uniaxial stress in plane strain")
        .because("elements contain uniform strain; the load point has moved by 1e-15 m")
        .why_not_tighter(super::PROCESSORS)
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain, Capability::Loads])
        .cost(&cost)
        .record();
    Ok(())
}

/// Force of the spring at the start, where it takes over from what held its side.
fn takes_over(ledger: &mut Ledger) -> Result<(), CaseError> {
    // The upper side is pushed down while the face is joined, so that it has to be held.
    let text = pressed("1 s")
        .without("stages[0].frictionless")
        .with("stages[0].conditions[3].y", r#"{ to = "-2 um" }"#)
        .text()?;
    let done = WrittenRun::from_text(&text)?;
    let first = |table: &str, name: &str| -> Result<f64, CaseError> {
        Ok(*done.files.table(table)?.column(name)?.first().ok_or("no row")?)
    };
    let face = first("fault_forces.csv", "shear_force of face")?;
    let spring = |name: &str| first("springs/B_top_y.csv", name);
    ledger
        .claim("spring of a block whose side was pushed while its face was joined, at the start: its force over the shear force of the face, and the way of its load point over that of the side")
        .values(&[spring("force")? / face, spring("load_point")? / 2e-6])
        .equals_each(&[1.0, 0.0])
        .absolute(1e-9)
        .evidence(Evidence::Exact, "balance of forces: the face holds block B and what pushed its upper side, from which a spring takes over")
        .because("the column of the face has ten digits, and the face hardly slips yet, far below its friction")
        .why_not_tighter("the last digit may be off by any part of a half")
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain, Capability::Loads])
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Forces on the sides of the blocks after an event against the tractions of the fault.
fn balance(ledger: &mut Ledger) -> Result<(), CaseError> {
    for frictionless in [true, false] {
        let scene = pressed("4000 s");
        let scene = if frictionless { scene } else { scene.without("stages[0].frictionless") };
        let BlockRun { report, forces: [normal, shear, above], cost, .. } = done(scene, 1)?;
        let spring = report.springs[0].values;
        let errors = [
            report.forces[0].value[0] / normal - 1.0,
            // The face drives A along y, and its lower side holds it; what acts on the node that they share counts there.
            report.forces[1].value[1] / above + 1.0,
            // B hangs on the spring and on the face.
            spring.force / shear - 1.0,
            spring.friction * normal / spring.force.abs() - 1.0,
        ];
        let how = if frictionless { "without friction" } else { "with joined sides" };
        ledger
            .claim(format!("the block pressed {how}, after an event: forces on its left and lower side and of the spring against f_n and tau of the face, and macroscopic friction, relative"))
            .values(&errors)
            .equals_each(&[0.0; 4])
            .absolute(1e-6)
            .evidence(Evidence::Exact, "balance of forces on both blocks")
            .because("an error of 1e-5 of ln V in a step, the default, is 1e-5 a or 1.2e-7 of the friction that is left, and those of an event add up")
            .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
            .cost(&cost)
            .record();
    }
    Ok(())
}

/// Forces of the fault in its table against those on the side that presses and of the spring, in every row.
fn through(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = WrittenRun::from_text(&pressed("4000 s").with("events.stop_after", "1").text()?)?;
    let column = |table: &str, name: &str| done.files.table(table)?.column(name);
    let fault = |name: &str| column("fault_forces.csv", name);
    let side = "forces/pressing.csv";
    if fault("time")? != column(side, "time")? {
        return Err("the tables have not the same times".into());
    }
    let spring = column("springs/B_top_y.csv", "force")?;
    let pairs =
        [(fault("normal_force of face")?, column(side, "force_x")?), (fault("shear_force of face")?, spring)];
    let off = pairs.map(|(found, wanted)| {
        let largest = wanted.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
        found.iter().zip(&wanted).map(|(f, w)| (f - w).abs() / largest).fold(0.0, f64::max)
    });
    ledger
        .claim("normal and shear force of the face through an event against the forces on the side that presses and of the spring, largest difference over the largest force")
        .values(&off)
        .equals_each(&[0.0; 2])
        .absolute(1e-6)
        .evidence(Evidence::Exact, "balance of forces on both blocks at each time")
        .because("as at the end of the event: errors of the integration of ln V add up to less than 1e-6 of the traction")
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
        .cost(&done.cost)
        .record();
    spring_rows(ledger, &done)?;
    point_rows(ledger, &done)?;
    counted(ledger, &done)
}

/// Stiffness of the spring \[N/m per metre\], and rate of its load point \[m/s\].
const SPRING: [f64; 2] = [2e9, -1e-6];

/// Columns of the table of the spring in every row.
fn spring_rows(ledger: &mut Ledger, done: &WrittenRun) -> Result<(), CaseError> {
    let table = done.files.table("springs/B_top_y.csv")?;
    let [times, drawn, moved] = ["time", "load_point", "displacement"].map(|name| table.column(name));
    let (times, drawn, moved, forces) = (times?, drawn?, moved?, table.column("force")?);
    let pressed = done.files.table("fault_forces.csv")?.column("normal_force of face")?;
    let [stiffness, rate] = SPRING;
    let largest = drawn.iter().fold(0.0_f64, |m, u| m.max(u.abs()));
    let mut worst = [0.0_f64; 3];
    for (k, friction) in table.column("friction")?.into_iter().enumerate() {
        let off = [
            (drawn[k] - rate * times[k]) / largest,
            (moved[k] - (drawn[k] - forces[k] / stiffness)) / largest,
            friction - forces[k].abs() / pressed[k],
        ];
        worst = std::array::from_fn(|c| worst[c].max(off[c].abs()));
    }
    ledger
        .claim("spring of the block through an event, all rows: load_point, displacement over the largest way, and friction, largest errors")
        .values(&worst)
        .equals_each(&[0.0; 3])
        .absolute(1e-9)
        .evidence(Evidence::Exact, "V t; the load point less force over stiffness; the size of the force over the normal force of the face in its table")
        .because("the normal force has ten digits, and the face hardly any shear force at the start")
        .why_not_tighter("the last digit may be off by any part of a half")
        .covers(&[Capability::FaultCycles, Capability::Outputs])
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Stresses of the sampled point: those of pressing in the first row, and those across the plane in every row.
fn point_rows(ledger: &mut Ledger, done: &WrittenRun) -> Result<(), CaseError> {
    let table = done.files.table("points/inside.csv")?;
    let [xx, yy, zz] = ["stress_xx", "stress_yy", "stress_zz"].map(|name| table.column(name));
    let (xx, yy, zz) = (xx?, yy?, zz?);
    let [young, poisson] = ELASTIC;
    let normal = young * PUSH / ((1.0 - poisson * poisson) * WIDTH);
    let at = |column: &[f64]| column.first().map_or(f64::NAN, |stress| stress / normal);
    ledger
        .claim("the block before it slips: stress_xx, stress_yy and stress_zz of a point in the first row, over the pressure")
        .values(&[at(&xx), at(&yy), at(&zz)])
        .equals_each(&[-1.0, 0.0, -poisson])
        .absolute(ROUNDING)
        .evidence(Evidence::Exact, "uniaxial stress in plane strain, E/(1 - nu^2) times the shortening")
        .because("elements contain uniform strain")
        .why_not_tighter(super::PROCESSORS)
        .covers(&[Capability::FaultCycles, Capability::Outputs])
        .cost(&done.cost)
        .record();
    let sums = xx.iter().zip(&yy).map(|(xx, yy)| poisson * (xx + yy));
    let off = sums.zip(&zz).map(|(sum, zz)| (sum - zz).abs()).fold(0.0, f64::max);
    let share = yy.iter().fold(0.0_f64, |m, yy| m.max(yy.abs())) / normal;
    if share < 0.01 {
        return Err("stress_yy does not change".into());
    }
    ledger
        .claim("the block through an event: stress_zz of a point against stress_xx and stress_yy in the same rows, largest error over the pressure")
        .value(off / normal)
        .at_most(ROUNDING)
        .evidence(Evidence::Exact, "nu (stress_xx + stress_yy): no strain across the plane")
        .because("all digits are written: rounding")
        .why_not_tighter(super::PROCESSORS)
        .covers(&[Capability::FaultCycles, Capability::Outputs])
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Stages, steps and times of the tables that every step has a row in.
fn counted(ledger: &mut Ledger, done: &WrittenRun) -> Result<(), CaseError> {
    let times = done.files.table("fault_forces.csv")?.column("time")?;
    let report = serde_json::to_value(&done.report)?;
    let taken = report["counts"]["steps"].as_f64().ok_or("no number of steps")?;
    let mut wrong = 0;
    for name in ["points/inside.csv", "forces/pressing.csv", "forces/under.csv", "springs/B_top_y.csv"] {
        let table = done.files.table(name)?;
        let steps = table.column("step")?;
        let apart = table.column("time")?.iter().zip(&times).filter(|(found, time)| found != time).count();
        wrong += table.column("stage")?.iter().filter(|stage| **stage != 1.0).count();
        wrong += apart + steps.len().abs_diff(times.len());
        wrong += steps.windows(2).filter(|pair| pair[1] <= pair[0]).count();
        wrong += usize::from(steps.first() != Some(&0.0)) + usize::from(steps.last() != Some(&taken));
    }
    ledger
        .claim("the block through an event: wrong stages, steps and times in the tables of points, forces and springs")
        .count(wrong as u64, 0)
        .evidence(Evidence::Exact, "the second stage, number 1; steps from 0 to that of the report, which grow; the times of fault_forces.csv")
        .because("a count")
        .covers(&[Capability::FaultCycles, Capability::Outputs])
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Three events against those under given tractions.
fn events(ledger: &mut Ledger) -> Result<(), CaseError> {
    let BlockRun { events, cost, .. } = done(pressed("4000 s"), 3)?;
    let given = SceneText::new(SCENE)
        .with("faults.face.law.l", "10 um")
        .with("stages[0].conditions[3].y.spring", "2e9")
        .with("stages[0].duration", "4000 s")
        .add("faults.face.shear", "-10 Pa");
    let mut plan = seas::plan(&given.text()?)?;
    plan.problem.settings.most_events = Some(3);
    let wanted = seas::found(&plan, &plan.problem.settings, |_| {})?.events;
    let numbers = |e: &[Event<Rupture>]| {
        let slip =
            |e: &Event<Rupture>| e.details.slip.component(0).iter().fold(0.0_f64, |m, s| m.max(s.abs()));
        [e[2].onset.since(&e[1].onset), slip(&e[2])]
    };
    ledger
        .claim("interval before the third event and its slip, over those under given tractions")
        .values(&numbers(&events).iter().zip(numbers(&wanted)).map(|(a, b)| a / b).collect::<Vec<f64>>())
        .equals_each(&[1.0; 2])
        .relative(1e-4)
        .evidence(Evidence::ConvergedSelf, "the same block with `normal` given, and a shear traction of -10 Pa, which V needs for its damping (case sandwich_state)")
        .because("a limit cycle of the same equations, begun in another state")
        .why_not_tighter("the default tolerance gives errors of about 1e-5 of an interval")
        .covers(&[Capability::FaultCycles, Capability::Events])
        .cost(&cost)
        .record();
    Ok(())
}
