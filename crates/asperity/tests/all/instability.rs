//! Interfaces that become unstable: a run stops there, reports the instability, and keeps the last good state; stable
//! variants run to their end.

use crate::common::{SANDWICH, plain_evolutions, planned};
use asperity::kinds;
use asperity::kinds::bodies::RunReport;
use asperity_output::bodies::Recorder;
use asperity_run::report::{Outcome, Stop};
use asperity_vary::Change::{Add, With};
use asperity_vary::{Change, SceneText};

/// Largest a f_n/eta of the scenes \[m/s\]: a of 0.005, normal tractions at corners below ten times 40 MPa, and eta of
/// granite with 2700 kg/m^3.
const BOUND: f64 = 0.005 * 400e6 / 3.6e6;

/// A variant of the sandwich.
#[derive(Clone, Debug)]
struct Sandwich {
    law: String,
    size: &'static str,
    push: &'static str,
    duration: &'static str,
    explicit: bool,
    mortar: bool,
    enforcement: &'static [Change<'static>],
    /// Changes of the steps.
    time: &'static [Change<'static>],
}

impl Sandwich {
    fn new(law: &str) -> Self {
        Self {
            law: law.into(),
            size: "5 mm",
            push: "0.00966 mm",
            duration: "50 s",
            explicit: false,
            mortar: false,
            enforcement: &[],
            time: &[],
        }
    }

    fn text(&self) -> String {
        // The tests are about the end of equilibrium, not about the propagation of slip fronts, for which some of these
        // cells are too large.
        let mut text = SceneText::new(SANDWICH)
            .add("interfaces.fault.under_resolved", "allow")
            .with_or_same("interfaces.fault.law", &self.law)
            .with_or_same("bodies.A.mesh.block.size", self.size)
            .with_or_same("bodies.B.mesh.block.size", self.size)
            .with_or_same("stages[0].conditions[0].x.to", self.push)
            .with_or_same("stages[1].duration", self.duration)
            .changed(self.enforcement);
        if self.mortar {
            text = text.with("interfaces.fault.measure", "mortar");
        }
        if self.explicit {
            text = text.with("time.stepper", "static-explicit").without("time.tolerance");
        }
        text.changed(self.time).text().unwrap()
    }

    fn run(&self) -> (RunReport, Recorder) {
        let mut record = Recorder::new().at_all_nodes();
        let report = kinds::bodies::run(&planned(&self.text()), &mut record).unwrap();
        (report, record)
    }

    /// Runs into the instability. Returns its time since shearing began.
    fn onset(&self) -> f64 {
        let (report, record) = self.run();
        let Outcome::Stopped { stage, time, reason, kind: Stop::Instability { interface, slip_rate, .. } } =
            &report.outcome
        else {
            panic!("{self:?}: {:?}", report.outcome)
        };
        assert_eq!((stage.as_deref().unwrap(), interface.as_str()), ("shear", "fault"));
        assert!(
            reason.starts_with("instability at (0.025, ") && reason.contains("`inertia = true`"),
            "{reason}"
        );
        assert!(slip_rate.is_finite());
        // The last good state is kept, and no state beyond it.
        assert_eq!(report.steps.last().unwrap().time, *time);
        assert_eq!(report.results.last().unwrap().stage, "shear");
        let fastest = record.histories()[0].points.iter().flat_map(|p| &p.slip_rate);
        let fastest = fastest.fold(0.0, |m: f64, v| m.max(v.abs()));
        assert!(fastest <= BOUND, "{self:?}: {fastest:e} m/s");
        time - 9.66
    }
}

fn state(evolution: &str, a: f64, b: f64, l: &str) -> String {
    format!(
        "{{ kind = \"rate-and-state\", evolution = {evolution}, mu0 = 0.6, a = {a}, b = {b}, l = \"{l}\", v_ref = \"1 um/s\", \
         v_initial = \"1 um/s\" }}"
    )
}

/// Plain evolutions and one with a parameter of its own, as scenes name them.
fn evolutions() -> impl Iterator<Item = String> {
    let plain = plain_evolutions().map(|name| format!("\"{name}\""));
    plain.chain(["\"nagata\", c = 0.05".into()])
}

const WEAKENING: &str = "{ kind = \"slip-weakening\", mu_s = 0.6, mu_k = 0.3, d_c = \"0.5 um\" }";
/// The same over a length that the elements resolve.
const RESOLVED: &str = "{ kind = \"slip-weakening\", mu_s = 0.6, mu_k = 0.3, d_c = \"2 um\" }";
const DROPPING: &str = "{ kind = \"static-kinetic\", mu_s = 0.6, mu_k = 0.5 }";

/// All combinations of stepper and measure.
fn combined(law: &str) -> Vec<Sandwich> {
    let pairs = [(false, false), (false, true), (true, false), (true, true)];
    pairs.map(|(explicit, mortar)| Sandwich { explicit, mortar, ..Sandwich::new(law) }).into()
}

#[test]
fn unstable_states_stop_with_the_instability_by_name_in_every_stepper_and_measure() {
    for evolution in evolutions() {
        for scene in combined(&state(&evolution, 0.005, 0.02, "0.2 um")) {
            scene.onset();
        }
    }
}

#[test]
fn weakening_with_slip_stops_in_every_stepper_and_measure() {
    for scene in combined(WEAKENING).into_iter().chain(combined(RESOLVED)) {
        scene.onset();
    }
}

#[test]
fn drops_that_the_rest_of_the_surface_holds_are_no_instability() {
    // Points of the sandwich begin to slip one after the other, from its ends.
    for (explicit, mortar) in [(false, false), (false, true), (true, false), (true, true)] {
        let (report, record) = Sandwich { explicit, mortar, ..Sandwich::new(DROPPING) }.run();
        assert_eq!(report.outcome, Outcome::Completed);
        let friction = record.stage_end("shear").unwrap().interfaces[0].friction.clone();
        assert!(friction.iter().all(|mu| (mu - 0.5).abs() < 1e-9), "{friction:?}");
    }
}

/// One of two equal points is half of the surface to rounding, and no more than half.
#[test]
fn half_of_a_surface_may_drop_at_once() {
    let corners = include_str!("../../../../verification/cases/interface_laws/corners.toml");
    for measure in ["node-to-point", "mortar"] {
        let scene = SceneText::new(corners)
            .add("interfaces.fault.law", DROPPING)
            .add("interfaces.fault.measure", measure)
            .add("time.stepper", "implicit");
        let mut record = Recorder::new();
        let report = kinds::bodies::run(&planned(&scene.text().unwrap()), &mut record).unwrap();
        assert_eq!(report.outcome, Outcome::Completed);
    }
}

#[test]
fn unstable_scenes_stop_on_finer_cells_and_under_ten_times_the_pressure() {
    let law = state("\"ageing\"", 0.005, 0.02, "1 um");
    for explicit in [false, true] {
        Sandwich { size: "2.5 mm", push: "0.0966 mm", duration: "300 s", explicit, ..Sandwich::new(&law) }
            .onset();
    }
    let law = state("\"ageing\"", 0.005, 0.02, "0.2 um");
    Sandwich { size: "2.5 mm", ..Sandwich::new(&law) }.onset();
}

#[test]
fn the_onset_does_not_depend_on_the_length_of_the_stage_or_the_settings_of_steps() {
    for explicit in [false, true] {
        let law = state("\"ageing\"", 0.005, 0.02, "0.2 um");
        let of = |duration, time: &'static [Change<'static>]| {
            Sandwich { duration, explicit, time, ..Sandwich::new(&law) }.onset()
        };
        let mut onsets = vec![of("50 s", &[Add("time.max_step", "0.02 s")])];
        onsets.extend(["62 s", "100 s", "150 s", "200 s"].map(|duration| of(duration, &[])));
        onsets.push(of("62 s", &[Add("time.first_step", "5 s"), Add("time.max_step", "20 s")]));
        // Within one in a hundred: the slip of a step is up to a tenth of L, which is a hundredth of the travel.
        let worst = onsets.iter().map(|t| (t / onsets[0] - 1.0).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-2, "{onsets:?}");
    }
}

#[test]
fn a_run_whose_newton_iteration_fails_while_slip_runs_away_names_the_instability() {
    Sandwich { duration: "200 s", ..Sandwich::new(&state("\"slip\"", 0.005, 0.02, "0.2 um")) }.onset();
}

#[test]
fn stable_neighbours_run_to_their_end() {
    let strengthening = evolutions().map(|e| state(&e, 0.02, 0.005, "0.2 um"));
    let stiff = [
        state("\"ageing\"", 0.005, 0.02, "50 um"),
        "{ kind = \"slip-weakening\", mu_s = 0.6, mu_k = 0.3, d_c = \"5 mm\" }".into(),
        "{ kind = \"coulomb\", mu = 0.6 }".into(),
    ];
    for law in strengthening.chain(stiff) {
        for explicit in [false, true] {
            let (report, _) = Sandwich { explicit, ..Sandwich::new(&law) }.run();
            assert_eq!(report.outcome, Outcome::Completed, "{law} {explicit}");
        }
    }
}

#[test]
fn a_smallest_step_or_a_limit_of_the_scene_stops_the_run_earlier() {
    let law = state("\"ageing\"", 0.005, 0.02, "0.2 um");
    let of = |time: &'static [Change<'static>]| Sandwich { time, ..Sandwich::new(&law) }.run().0;
    for report in [of(&[Add("time.min_step", "1 ms")]), of(&[Add("time.slip_rate_limit", "10 um/s")])] {
        // Steps may become too short before slip is much faster than the loads, when an instability is not yet evident.
        let Outcome::Stopped { kind: Stop::Instability { .. } | Stop::SmallestStep, reason, .. } =
            &report.outcome
        else {
            panic!("{:?}", report.outcome)
        };
        assert!(reason.contains("at (0.025, ") && reason.contains("V = "), "{reason}");
        let (last, before) = (report.steps.last().unwrap(), &report.steps[..report.steps.len() - 1]);
        assert!(last.dt > 1e-7 && before.iter().all(|s| s.dt > 1e-7));
        assert!(report.results.last().unwrap().slip_rate.iter().all(|v| v.abs() < 1e-3));
    }
}

#[test]
fn every_enforcement_and_cell_size_names_the_instability() {
    let law = state("\"ageing\"", 0.005, 0.02, "0.2 um");
    let slip = state("\"slip\"", 0.005, 0.02, "0.2 um");
    const KIND: &str = "interfaces.fault.enforcement.kind";
    const MIXED: [Change<'_>; 1] = [With(KIND, "augmented-lagrangian")];
    const UZAWA: [Change<'_>; 2] =
        [With(KIND, "uzawa"), Add("interfaces.fault.enforcement.penetration", "1 nm")];
    let enforced: [&[Change<'_>]; 2] = [&MIXED, &UZAWA];
    for law in [&law, &slip] {
        for size in ["5 mm", "2.5 mm", "1.25 mm"] {
            Sandwich { size, ..Sandwich::new(law) }.onset();
        }
        for enforcement in enforced {
            Sandwich { enforcement, ..Sandwich::new(law) }.onset();
        }
    }
}
