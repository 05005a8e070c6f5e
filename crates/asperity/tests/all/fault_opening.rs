//! Faults that open: tractions balance, the energy budget closes, and faults that never open have unchanged results.

use crate::common::{first_resistance, resistance, varied};
use asperity::kinds::faults::Report;
use asperity_cycles::{
    Balance, Fault, FaultRun, Layout, Moment, OPENING, Opening, PorePressure as _, Pressure,
};
use asperity_ode::{Control, Outcome};
use asperity_plan::faults::Plan;
use asperity_plan::reading::scene;
use asperity_plan::{ScenePlan, plan_scene};
use asperity_vary::Change::{Add, With, Without};

/// A fault below a free surface that fluid opens; it closes when the injection ends.
const INJECTED: &str = include_str!("../../../../scenes/fault-opening.toml");
/// A thrust that flattens downwards under little pressure.
const THRUST: &str = include_str!("../../../../verification/cases/fault_opening/thrust.toml");

fn planned(text: &str) -> Plan {
    match plan_scene(&scene::read(text).unwrap()).unwrap() {
        ScenePlan::Faults(plan) => *plan,
        ScenePlan::Bodies(_) | ScenePlan::Dynamic(_) => panic!("the scene has faults"),
    }
}

/// Results of a run.
struct RunResults {
    run: FaultRun,
    report: Report,
    /// Largest imbalance of tractions along and across the fault, relative to the largest initial f_n.
    along: f64,
    across: f64,
    /// Largest number of points that were open at once.
    most: usize,
}

/// Changes of the shear tractions of a fault and its effective normal tractions, from slip, openings, fluid and loads of constant rates.
fn tractions(fault: &Fault, now: &Moment<'_>, by: &[f64], loads: &[Vec<f64>; 2]) -> [Vec<f64>; 2] {
    let opening = fault.processes.find::<Opening>().unwrap();
    let (time, n) = (now.at.seconds(), by.len());
    let mut shear = fault.operator.shear_of(now.slip().all());
    opening.sheared(by, &mut shear);
    let mut press = fault.operator.normal_of(now.slip().all());
    opening.pressing(by, &mut press);
    let fluid = fault.processes.find::<Pressure>().map_or(vec![0.0; n], |f| f.at(time, n));
    for p in 0..n {
        shear[p] += loads[0][p] * time;
        press[p] += fault.normal[p] + loads[1][p] * time - fluid[p];
    }
    [shear, press]
}

/// Follows a run whose loads have constant rates. Tractions follow from slip and openings through the operators. Along
/// the fault they must equal friction; across it, less the pore pressure, they must equal f_n, or vanish where the fault
/// is open.
fn followed(plan: &Plan) -> RunResults {
    let (n, fault) = (plan.points.len(), &plan.problem.fault);
    let floor = plan.faults[0].normal.floor.unwrap();
    let loads: [Vec<f64>; 2] = plan.problem.loading.rates(1.0, n, true).into();
    let first = first_resistance(&plan.problem, 0.0);
    let scale = fault.normal.iter().fold(0.0_f64, |l, f| l.max(*f));
    let (mut along, mut across, mut most) = (0.0_f64, 0.0_f64, 0);
    let mut balance = Balance::new(&plan.problem);
    let mut look = |now: &Moment<'_>| {
        balance.step(now);
        let by: Vec<f64> = (0..n).map(|p| now.at(&OPENING, p).unwrap()).collect();
        let [shear, pressed] = tractions(fault, now, &by, &loads);
        for p in 0..n {
            let slips = [now.unknowns[p], now.rate.component(0)[p]];
            let resists = resistance(fault, p, pressed[p].max(floor), slips);
            along = along.max((first[p] + shear[p] - resists).abs() / scale);
            let kept = if by[p] > 0.0 { pressed[p].abs() } else { (-pressed[p]).max(0.0) };
            across = across.max(kept / scale).max((now.normal(p) - pressed[p].max(floor)).abs() / scale);
            assert!(by[p] >= 0.0);
        }
        most = most.max(by.iter().filter(|o| **o > 0.0).count());
        Control::Go
    };
    let out = plan.problem.run(&plan.problem.settings, &mut look).unwrap();
    let report = Report::new(plan, &out, &mut balance);
    RunResults { run: out, report, along, across, most }
}

impl RunResults {
    /// Asserts that tractions and energies balance. Errors of ln V are within the tolerance in the mean over all
    /// unknowns, four per point, and add up over the steps like a random walk. They change friction by a (`direct` at
    /// most) times as much, and f_n by as much of itself.
    fn balances(&self, plan: &Plan, direct: f64) {
        let most = (4.0 * plan.points.len() as f64).sqrt() * plan.problem.settings.tolerance;
        let drift = direct * most * (self.run.counts.steps as f64).sqrt();
        assert!(self.along < drift && self.across < drift, "{:e} {:e} {drift:e}", self.along, self.across);
        // Ten times the tolerance, relative to the largest term.
        assert!(self.report.energy.imbalance < 1e-4, "{:?}", self.report.energy);
    }
}

#[test]
fn a_fault_that_fluid_opens_balances_and_closes_when_the_injection_ends() {
    let plan = planned(INJECTED);
    let found = followed(&plan);
    assert_eq!(found.run.outcome, Outcome::Completed);
    found.balances(&plan, 0.015);
    let opened = &found.report.openings[0];
    assert!(found.most >= 3 && opened.points >= found.most && opened.open == 0, "{opened:?}");
    assert!(opened.time_share > 0.1 && opened.time_share < 0.9 && opened.volume == 0.0, "{opened:?}");
    assert!(found.report.energy.part("opening") != 0.0);
    assert_eq!(found.report.floors[0].least, 0.0);
}

/// Nothing slips under so high a floor: closing returns the work of opening.
#[test]
fn an_opening_without_slip_gives_back_what_it_takes() {
    let plan = planned(&varied(INJECTED, &[With("faults.main.normal_floor", "20 MPa")]));
    let found = followed(&plan);
    let energy = &found.report.energy;
    assert!(found.most >= 3 && found.report.openings[0].open == 0);
    let exchanged = energy.exchanged.unwrap();
    assert!(exchanged > 1e6 && energy.imbalance < 1e-4, "{energy:?}");
    assert!(energy.part("opening").abs() < 1e-4 * exchanged, "{energy:?}");
}

#[test]
fn a_shallow_thrust_runs_through_events_that_open_it() {
    let plan = planned(THRUST);
    let found = followed(&plan);
    assert_eq!((&found.run.outcome, found.report.events.len()), (&Outcome::Stopped, 3));
    found.balances(&plan, 0.025);
    assert!(found.most > 0, "{:?}", found.report.openings);
    let text = found.report.text();
    assert!(text.contains(", opening ") && text.contains("fault `main` opened at"), "{text}");
}

#[test]
fn a_fault_that_never_opens_is_the_same_to_the_last_bit_as_one_that_may_not() {
    let deep =
        varied(INJECTED, &[With("faults.main.normal", "100 MPa"), With("faults.main.shear", "40 MPa")]);
    let end = |text: &str| {
        let plan = planned(text);
        plan.problem.run(&plan.problem.settings, &mut ()).unwrap()
    };
    let (with, without) = (end(&deep), end(&varied(&deep, &[Without("faults.main.opening")])));
    assert_eq!((with.unknowns, with.counts), (without.unknowns, without.counts));
}

#[test]
fn sides_of_a_fault_lie_as_far_apart_as_it_is_open() {
    let plan = planned(&varied(
        INJECTED,
        &[Add("output.bodies", "true"), With("faults.main.injection.until", "20 d")],
    ));
    let found = followed(&plan);
    let end = plan.problem.fault.pressed(found.run.at, &found.run.unknowns);
    let slip = &found.run.unknowns[Layout::from_fault(&plan.problem.fault).slip()];
    let view = plan.bodies.as_ref().unwrap();
    let moved = view.bodies.vectors(&[slip, end.values(&OPENING)].concat(), found.run.at.seconds());
    let largest = slip.iter().chain(end.values(&OPENING)).fold(0.0_f64, |l, v| l.max(v.abs()));
    assert!(end.values(&OPENING).iter().any(|o| *o > 0.01));
    for (p, (&[minus, plus], point)) in view.sides.iter().zip(&plan.points).enumerate() {
        for (c, (way, normal)) in point.slides.iter().zip(point.normal).enumerate() {
            let jump = moved[plus][c] - moved[minus][c];
            // Rounding of displacements.
            let off = jump - slip[p] * way - end.values(&OPENING)[p] * normal;
            assert!(off.abs() < 1e-12 * largest, "{p} {c} {off:e}");
        }
    }
}

#[test]
fn the_plan_says_what_opens_and_counts_its_memory() {
    let plan = planned(INJECTED);
    let text = plan.summary();
    assert!(
        text.contains("that slide and open") && text.contains("the fault opens where they would pull"),
        "{text}"
    );
    let closed = planned(&varied(INJECTED, &[Without("faults.main.opening")]));
    let opening = plan.problem.fault.processes.find::<Opening>().unwrap();
    let n = plan.points.len();
    assert_eq!((opening.points().len(), opening.bytes()), (n, 2 * n * n * size_of::<f64>()));
    assert!(plan.memory_bytes >= closed.memory_bytes);
    assert!(!closed.summary().contains("opens"));
}

/// Moving sides pull a fault apart, and shear it by rounding only.
#[test]
fn loads_that_only_pull_do_not_drive_a_fault_against_its_rate() {
    let pulled = varied(
        INJECTED,
        &[
            With("bodies.crust.mesh.fault.trace", "[[\"0 km\", \"2 km\"], [\"0 km\", \"-2 km\"]]"),
            With("bodies.crust.mesh.fault.max[1]", "20 km"),
            With("stages[0].conditions[1].x", "{ rate = \"1e-9 m/s\" }"),
        ],
    );
    assert!(planned(&pulled).warnings.is_empty(), "{:?}", planned(&pulled).warnings);
}
