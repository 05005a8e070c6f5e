//! The SEAS benchmark BP4-QD in a whole space: events after the one in the seed, against a second implementation with the same cells.

use crate::cases::seas::{self, IN_SPACE, YEAR, independent_in_space};
use crate::{Axis, Capability, Case, CaseError, Evidence, Ledger, Plot, Series};
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "seas_bp4",
    readme: include_str!("README.md"),
    covers: &[Capability::Medium, Capability::FaultCycles, Capability::Solid3d],
    quick: false,
    run,
};

/// Events of the run: the one in the seed, and three that nucleate by themselves.
const EVENTS: usize = 4;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let rates = events(ledger, 1000.0, EVENTS)?;
    ledger.plot(rates);
    Ok(())
}

/// Claims the first `count` events of scenes/bp4.toml with cells of `size` \[m\]. Returns a plot of the largest slip rate.
///
/// # Errors
/// Those of the run, or if the second implementation has no run with such cells.
pub fn events(ledger: &mut Ledger, size: f64, count: usize) -> Result<Plot, CaseError> {
    let scene = SceneText::new(include_str!("../../../scenes/bp4.toml"));
    let plan = seas::plan(&scene.with_or_same("faults.main.rectangle.size", format!("{size} m")).text()?)?;
    let mut settings = plan.problem.settings;
    settings.most_events = Some(count);
    let (mut rates, mut largest) = (Vec::new(), vec![0.0_f64; count + 1]);
    let found = seas::found(&plan, &settings, |now| {
        rates.push((now.at.seconds() / YEAR, now.largest));
        let event = now.events().len();
        largest[event] = largest[event].max(now.largest);
    })?;
    let reference = independent_in_space("bp4", size)?;
    let onsets: Vec<f64> = reference.iter().map(|event| event.onset / YEAR).collect();
    let intervals = |t: &[f64]| (1..count).map(|k| t[k] - t[k - 1]).collect::<Vec<_>>();
    ledger
        .claim(format!("intervals from the event in the seed to number {count}"))
        .unit("yr")
        .values(&intervals(&found.onsets))
        .equals_each(&intervals(&onsets))
        .relative(1e-4)
        .uncertainty(0.004)
        .evidence(Evidence::OtherCode, IN_SPACE)
        .because("cells are the same, and so is the limit of short steps; steps err by 1e-5 in ln V, and each event inherits the errors of those before")
        .cost(&found.cost)
        .record();
    let of_reference: Vec<f64> = reference[1..count].iter().map(|event| event.largest).collect();
    ledger
        .claim("largest slip rates of the events after the one in the seed")
        .unit("m/s")
        .values(&largest[1..count])
        .equals_each(&of_reference)
        .relative(5e-3)
        .uncertainty(1e-3)
        .evidence(Evidence::OtherCode, IN_SPACE)
        .because("both are the largest of their steps, which miss a peak by up to a few thousandths on cells that hardly resolve fronts")
        .record();
    Ok(Plot::xy("Largest slip rate", "time [yr]", "V_max [m/s]")
        .axes(Axis::Linear, Axis::Log)
        .series(Series::line(format!("cells of {} km", size / 1000.0), &rates)))
}
