//! Processes of faults in pairs: each runs with each other and resumes, unless a table says why both cannot be together.

use crate::common::varied;
use asperity_cycles::{Balance, FaultRun, Faults, Moment, Sums};
use asperity_ode::{Control, Outcome};
use asperity_plan::faults::Plan;
use asperity_plan::reading::scene;
use asperity_plan::{ScenePlan, plan_scene};
use asperity_run::{ObserveError, Observer};
use asperity_scene::check::incompatibility::{APART, PROCESSES};
use asperity_vary::Change::{self, Add, With, Without};

/// A fault below a free surface with a floor that fluid opens.
const SCENE: &str = include_str!("../../../../scenes/fault-opening.toml");

/// Fluid that does not open the fault without a floor; permeability jumps at 1.5 km.
const DIFFUSION: &str = "{ profiles.permeability = { along = \"distance\", points = [[\"1.4 km\", 1e-13], [\"1.6 km\", 1e-15]] }, storage = 1e-9, \
     viscosity = \"1e-3 Pa s\", wells = [{ at = \"1 km\", flux = \"4e-6 m/s\", until = \"5 d\" }] }";

/// The scene with these processes alone.
fn with(keys: &[&str]) -> String {
    let changes = PROCESSES.map(|key| (key, keys.contains(&key))).into_iter().filter_map(|change| match change {
        ("pulses", true) => Some(Add(
            "faults.main.pulses",
            "[{ traction = \"3 MPa\", centre = [\"0.5 km\", \"-0.866 km\"], radius = \"600 m\", duration = \"1 d\" }]",
        )),
        ("heat", true) => Some(Add(
            "faults.main.heat",
            "{ thickness = \"20 mm\", diffusivity = \"1 mm^2/s\", capacity = \"2.7 MJ/(m^3 K)\", temperature = \"400 K\", \
             pressurisation = { coefficient = \"0.1 MPa/K\", diffusivity = \"10 mm^2/s\" } }",
        )),
        ("diffusion", true) => Some(Add("faults.main.diffusion", DIFFUSION)),
        ("injection", false) => Some(Without("faults.main.injection")),
        ("opening", false) => Some(Without("faults.main.opening")),
        ("normal_floor", false) => Some(Without("faults.main.normal_floor")),
        _ => None,
    });
    // Small steps, so that a run pauses on its way. Without a floor the fluid must not open the fault.
    let fine = Add("time.log_rate_tolerance", "1e-10");
    let little = With("faults.main.injection.flux", "4e-6 m/s");
    let gentle = keys.contains(&"injection") && !keys.contains(&"normal_floor");
    varied(SCENE, &changes.chain([fine]).chain(gentle.then_some(little)).collect::<Vec<Change<'_>>>())
}

/// Follows the energy of a run, and keeps its state at the first pause.
struct EnergyWatch<'a> {
    balance: Balance<'a>,
    first: Option<String>,
}

impl Observer<Faults> for EnergyWatch<'_> {
    fn step(&mut self, now: &Moment<'_>) -> Result<Control, ObserveError> {
        self.balance.step(now);
        Ok(Control::Go)
    }

    fn pause(&mut self, copy: &mut dyn FnMut() -> FaultRun) -> Result<Option<&'static str>, ObserveError> {
        let state = || serde_json::to_string(&(copy(), self.balance.sums())).unwrap();
        self.first.get_or_insert_with(state);
        Ok(None)
    }
}

/// Runs a plan to its end from a state, or from its start.
fn run(plan: &Plan, from: Option<(FaultRun, Sums)>) -> (FaultRun, Sums, f64, Option<String>) {
    let problem = &plan.problem;
    let (begin, balance) = match from {
        Some((run, sums)) => (run, Balance::resume(problem, sums)),
        None => (plan.begin(), Balance::new(problem)),
    };
    let mut kept = EnergyWatch { balance, first: None };
    let run = problem.resume(begin, &problem.settings, None, &mut kept).unwrap();
    let slip = &run.unknowns[asperity_cycles::Layout::from_fault(&problem.fault).slip()];
    let pressed = problem.fault.pressed(run.at, &run.unknowns);
    let imbalance = kept.balance.energy(slip, &pressed).imbalance();
    (run, kept.balance.sums(), imbalance, kept.first)
}

#[test]
fn each_pair_of_processes_runs_and_resumes_or_has_a_reason_why_not() {
    for (i, one) in PROCESSES.iter().enumerate() {
        for other in &PROCESSES[i + 1..] {
            // Friction of open points uses the floor.
            let keys =
                [&[*one, *other][..], if *other == "opening" { &["normal_floor"] } else { &[] }].concat();
            let text = with(&keys);
            let apart = APART
                .iter()
                .find(|row| [(row.one, row.other), (row.other, row.one)].contains(&(*one, *other)));
            let scene = match (scene::read(&text), apart) {
                (Ok(scene), None) => scene,
                (Err(error), Some(row)) => {
                    assert!(format!("{error:?}").contains(row.reason), "{keys:?}: {error:?}");
                    continue;
                }
                (found, _) => panic!("{keys:?}: {found:?}"),
            };
            let ScenePlan::Faults(plan) = plan_scene(&scene).unwrap() else { panic!("the scene has faults") };
            assert_eq!(plan.problem.fault.processes.iter().count(), keys.len());
            let (end, sums, imbalance, first) = run(&plan, None);
            assert_eq!(end.outcome, Outcome::Completed, "{keys:?}");
            // Ten times the tolerance, relative to the largest term.
            assert!(imbalance < 1e-9, "{keys:?}: {imbalance}");
            let Some(first) = first else { continue };
            let again = run(&plan, Some(serde_json::from_str(&first).unwrap()));
            assert_eq!((&again.0.unknowns, &again.1), (&end.unknowns, &sums), "{keys:?}");
            assert_eq!(again.0.progress, end.progress, "{keys:?}");
        }
    }
}
