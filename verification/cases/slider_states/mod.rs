//! Several states, neutral friction, two coupled sliders.

use super::slider::{self, Independent, Kind, MU0, Set, V_REF};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Series};
use asperity::kinds::sliders::{Entry, Report};
use asperity_cycles::slider::Problem;
use asperity_friction::component::Component;
use asperity_friction::evolution::slip::Slip;
use asperity_friction::rate::RateLaw;
use asperity_friction::slider::{History, Slider, Spring, System};
use asperity_friction::strength::{Parameters, regularised::Regularised};
use std::sync::Arc;

/// See the README.
pub const CASE: Case = Case {
    name: "slider_states",
    readme: include_str!("README.md"),
    covers: &[Capability::Slider, Capability::SeveralStates, Capability::CoupledSliders],
    quick: true,
    run,
};

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let reference = Independent::read()?;
    two_states(ledger, &reference)?;
    neutral(ledger, &reference)?;
    coupled(ledger, &reference)?;
    twins(ledger)
}

/// Claims on times of events against references, over the last interval.
fn times(
    ledger: &mut Ledger,
    title: &str,
    found: &[f64],
    expected: &[f64],
    covers: &[Capability],
    cost: &Cost,
) {
    let recurrence = expected[expected.len() - 1] - expected[expected.len() - 2];
    let error = found.iter().zip(expected).map(|(a, b)| (a - b).abs() / recurrence).fold(0.0, f64::max);
    ledger
        .claim(format!("{title}: times of {} events, error over the recurrence", expected.len()))
        .value(if found.len() >= expected.len() { error } else { f64::NAN })
        .at_most(1e-10)
        .evidence(Evidence::OtherCode, slider::SOURCE)
        .because("a tolerance of 1e-13 a step, amplified by what an event does to the time of the next")
        .why_not_tighter("ten digits are what is asked")
        .covers(covers)
        .cost(cost)
        .record();
}

fn two_states(ledger: &mut Ledger, reference: &Independent) -> Result<(), CaseError> {
    let parts = [(0.012, 1e-5), (0.003, 1e-4)]
        .into_iter()
        .map(|(b, l)| Ok(Component::new(Slip::new(b, l, V_REF)?, 0.0)?))
        .collect::<Result<Vec<_>, CaseError>>()?;
    let form = Regularised(Parameters::new(MU0, 0.01, V_REF)?);
    let law = Arc::new(RateLaw::with_parts(form, parts, 1e-6, 5e6, None)?);
    let set = Set { stiffness: 5e8, ..slider::MILD };
    let mut plan = slider::plan(set.slider(law), History::Constant(set.load), set.load, 1.5, 1e9)?;
    let expected = reference.numbers("two_state_slip", "crossings_s")?;
    slider::events(&mut plan, expected.len());
    let (run, cost) = Cost::measure(|| slider::finish(&plan));
    let run = run?;
    let cost = cost.counts(&Report::new(&plan, &run).counts);
    let onsets: Vec<(f64, f64)> = expected.iter().map(|t| (*t, slider::EVENT)).collect();
    ledger.plot(
        slider::through_time("Two states")
            .series(Series::line("this code", &slider::rates(&plan)?))
            .series(Series::points("onsets of the reference", &onsets)),
    );
    let found: Vec<f64> = Entry::all(&run).iter().map(|e| e.onset).collect();
    times(ledger, "slip law with two states", &found, &expected, &[Capability::SeveralStates], &cost);
    Ok(())
}

/// a = b: steady friction does not depend on V; after a tenfold step of the load point the slider overshoots and settles.
fn neutral(ledger: &mut Ledger, reference: &Independent) -> Result<(), CaseError> {
    let set = Set { b: 0.01, stiffness: 1e9, ..slider::MILD };
    let law = set.law(Kind::Ageing)?;
    let plan = slider::plan(set.slider(law), History::Constant(1e-5), 1e-6, 1.0, 1.0)?;
    let at = reference.numbers("cut_off_neutral", "t_s")?;
    let (found, cost) = Cost::measure(|| slider::at_times(&plan, &at));
    let found = found?;
    let logs: Vec<f64> = found.iter().map(|f| f.0.ln()).collect();
    let expected: Vec<f64> = reference.numbers("cut_off_neutral", "v")?.iter().map(|v| v.ln()).collect();
    ledger
        .claim("neutral friction a = b after a tenfold step of the load point: ln V at seven times")
        .values(&logs)
        .equals_each(&expected)
        .absolute(1e-9)
        .evidence(Evidence::OtherCode, slider::SOURCE)
        .because("a tolerance of 1e-13 a step; V passes through a peak at which times matter most")
        .why_not_tighter("near the peak an error in time of 1e-11 is one of 1e-10 in ln V")
        .covers(&[Capability::Slider, Capability::AgeingLaw])
        .cost(&cost)
        .record();
    let mu: Vec<f64> = found.iter().map(|f| f.1).collect();
    ledger
        .claim("neutral friction a = b after a tenfold step of the load point: friction at seven times")
        .values(&mu)
        .equals_each(&reference.numbers("cut_off_neutral", "mu")?)
        .absolute(1e-11)
        .evidence(Evidence::OtherCode, slider::SOURCE)
        .because("as ln V, times a = 0.01")
        .why_not_tighter("as ln V")
        .covers(&[Capability::Slider, Capability::AgeingLaw])
        .cost(&cost)
        .record();
    Ok(())
}

/// Two sliders of the mild set with softer springs to the load point and a spring between them.
fn pair(factors: [f64; 2], law: Kind) -> Result<Problem, CaseError> {
    let set = Set { stiffness: 0.8e9, ..slider::MILD };
    let law = set.law(law)?;
    let sliders: Vec<Slider> = (0..2).map(|_| set.slider(law.clone())).collect();
    let mut states = vec![0.0; law.states()];
    law.steady(set.load.ln(), &mut states);
    let spring = Spring { between: [0, 1], stiffness: 0.3e9 };
    let system = System::new(sliders, vec![spring], History::Constant(set.load))?;
    let start = system.start(&factors.map(|f| f * set.load), &[states.clone(), states])?;
    let mut plan = Problem::new(system, start, 1e6);
    plan.tolerance = slider::TIGHT;
    Ok(plan)
}

fn coupled(ledger: &mut Ledger, reference: &Independent) -> Result<(), CaseError> {
    let mut plan = pair([1.5, 0.8], Kind::Ageing)?;
    let expected = [
        reference.numbers("coupled_two", "crossings_1_s")?,
        reference.numbers("coupled_two", "crossings_2_s")?,
    ];
    slider::events(&mut plan, expected[0].len() + 1);
    let (run, cost) = Cost::measure(|| slider::finish(&plan));
    let run = run?;
    let cost = cost.counts(&Report::new(&plan, &run).counts);
    for (i, expected) in expected.iter().enumerate() {
        let found: Vec<f64> = Entry::from_slider(&run, i).into_iter().map(|e| e.onset).collect();
        let title = format!("two coupled sliders, slider {}", i + 1);
        times(ledger, &title, &found, expected, &[Capability::CoupledSliders], &cost);
    }
    Ok(())
}

/// Two equal sliders move as one: the spring between them does nothing.
fn twins(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut plan = pair([1.5, 1.5], Kind::Slip)?;
    slider::events(&mut plan, 4);
    let (run, cost) = Cost::measure(|| slider::finish(&plan));
    let both = run?;
    let mut single = Set { stiffness: 0.8e9, ..slider::MILD }.plan(Kind::Slip, 1.5, 1e6)?;
    slider::events(&mut single, 4);
    let alone = slider::finish(&single)?;
    let pairs = Entry::from_slider(&both, 0)
        .into_iter()
        .zip(Entry::from_slider(&both, 1))
        .zip(Entry::from_slider(&alone, 0));
    let error = pairs
        .map(|((a, b), one)| (a.onset / one.onset - 1.0).abs().max((b.onset / one.onset - 1.0).abs()))
        .fold(0.0, f64::max);
    ledger
        .claim("two equal sliders against one: times of four events")
        .value(if Entry::from_slider(&both, 1).len() == 4 { error } else { f64::NAN })
        .at_most(1e-10)
        .evidence(Evidence::Exact, "the coupling of equal sliders carries no traction")
        .because(
            "differences between the two grow with the instability of each event, from rounding of 1e-15",
        )
        .why_not_tighter("the growth depends on the number of events")
        .covers(&[Capability::CoupledSliders])
        .cost(&cost)
        .record();
    Ok(())
}
