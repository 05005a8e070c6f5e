//! Spring-sliders with frequent restarts: the program's own are too far apart for the small runs of a case.

use super::Parts;
use crate::cases::programs;
use crate::cases::run_files::Folder;
use crate::{CaseError, Cost};
use asperity::checkpoint::{self, Pauses};
use asperity::keep::{Keeper, Place};
use asperity::kinds::sliders::Outputs;
use asperity_cycles::slider::{Problem, SliderRun, resume};
use asperity_plan::sliders::planner;
use asperity_vary::Change::{self, Add, With};
use asperity_vary::SceneText;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// Accepted steps between restarts.
const STEPS: u64 = 50;
/// A second block, coupled to the first by a spring.
const CHAIN: [Change<'_>; 2] = [
    Add(
        "sliders.far",
        r#"{ normal = "4 MPa", stiffness = "0.8 GPa/m", damping = "5 MPa s/m", law = { kind = "rate-and-state", evolution = "slip", mu0 = 0.6, a = 0.010, b = 0.014, l = "20 um", v_ref = "1 um/s", v_initial = "1 um/s" }, start = "0.5 um/s" }"#,
    ),
    Add("springs", r#"[{ between = ["block", "far"], stiffness = "0.3 GPa/m" }]"#),
];
/// Jumps of the rate of the load point.
const JUMPS: Change<'_> = With(
    "load.rate",
    r#"{ table = [["0 s", "1 um/s"], ["600 s", "1 um/s"], ["600 s", "3 um/s"], ["1200 s", "3 um/s"], ["1200 s", "0.5 um/s"]] }"#,
);
const MASS: Change<'_> = Add("sliders.block.mass", "3000 kg/m^2");

/// Runs sliders with and without interruption.
///
/// # Errors
/// If a run fails.
pub fn run() -> Result<Vec<Parts>, CaseError> {
    let scenes = [
        ("a slider through events", vec![]),
        ("two sliders, a load that jumps", vec![CHAIN[0], CHAIN[1], JUMPS]),
        ("a slider with mass", vec![MASS]),
    ];
    let few = With("events.stop_after", "3");
    let of = |(name, changes): (&'static str, Vec<Change<'_>>)| {
        let scene = SceneText::new(include_str!("../../../scenes/spring-slider.toml"));
        let plan =
            planner::read(&scene.changed(&changes).changed(&[few]).text()?).map_err(|e| e.to_string())?;
        in_parts(name, &Problem { restart: STEPS, ..plan.problem })
    };
    scenes.into_iter().map(of).collect()
}

fn in_parts(name: &'static str, problem: &Problem) -> Result<Parts, CaseError> {
    let folder = Folder::new()?;
    let [whole, parts] = ["whole", "parts"].map(|name| folder.path().join(name));
    let (_, cost) = Cost::measure(|| part(problem, &whole, None));
    let mut interruptions = 0;
    while part(problem, &parts, Some(Duration::ZERO))? {
        interruptions += 1;
    }
    let differing = programs::differing(&whole, &parts)?;
    Ok(Parts { name, interruptions, differing, files: programs::files(&whole)?.len(), cost })
}

/// Runs the next part of a run into `out`: up to the next restart, or to its end if there is no limit of wall time.
/// Returns true if it was interrupted.
fn part(problem: &Problem, out: &Path, wall: Option<Duration>) -> Result<bool, CaseError> {
    let pauses =
        Pauses { every: Duration::MAX, wall, stop: Arc::new(AtomicBool::new(false)), begun: Instant::now() };
    let place = Place { out, physics: "", drawn: true, pauses };
    let (mut keeper, from) = match Keeper::<Outputs>::resume(problem, place.clone())? {
        Some(resumed) => resumed,
        None => (Keeper::begin(problem, place)?, SliderRun::new(problem)),
    };
    let run = resume(problem, from, &mut keeper)?;
    let interrupted = keeper.interrupted().is_some();
    keeper.finish(!interrupted).complete()?;
    if !interrupted {
        checkpoint::remove(out)?;
        // All of the run: events, energies and counts, in every digit and whether a checkpoint holds them or not.
        std::fs::write(out.join("run.txt"), format!("{run:#?}"))?;
    }
    Ok(interrupted)
}
