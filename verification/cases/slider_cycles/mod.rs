//! Stick-slip cycles against converged references and against QDYN.

use super::slider::{self, Independent, Kind, Set};
use crate::{Axis, Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity::kinds::sliders::{Entry, Report};
use asperity_cycles::slider::{self as cycles, SliderState};
use asperity_ode::Method;

/// See the README.
pub const CASE: Case = Case {
    name: "slider_cycles",
    readme: include_str!("README.md"),
    covers: &[Capability::Slider, Capability::AgeingLaw, Capability::SlipLaw, Capability::Events],
    quick: true,
    run,
};

/// Relative error allowed against references accurate to ten digits.
const DIGITS: f64 = 1e-10;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let reference = Independent::read()?;
    against_qdyn(ledger)?;
    for (name, set, kind) in [
        ("mild_ageing", slider::MILD, Kind::Ageing),
        ("mild_slip", slider::MILD, Kind::Slip),
        ("hard_ageing", slider::HARD, Kind::Ageing),
        ("hard_slip", slider::HARD, Kind::Slip),
        ("reference_ageing", slider::REFERENCE, Kind::Ageing),
        ("inertial_ageing", slider::INERTIAL, Kind::Ageing),
        ("inertial_slip", slider::INERTIAL, Kind::Slip),
    ] {
        against_references(ledger, &reference, name, &set, kind)?;
    }
    methods_agree(ledger)?;
    picture(ledger, &reference)
}

/// Events of a run, and its cost.
fn cycle(
    set: &Set,
    kind: Kind,
    method: Method,
    tolerance: f64,
    number: usize,
) -> Result<(Vec<Entry>, Cost), CaseError> {
    let mut plan = set.plan(kind, 1.5, 1e12)?;
    slider::events(&mut plan, number);
    (plan.method, plan.tolerance) = (method, tolerance);
    let (run, cost) = Cost::measure(|| slider::finish(&plan));
    let run = run?;
    let cost = cost.counts(&Report::new(&plan, &run).counts);
    Ok((Entry::all(&run), cost))
}

fn against_references(
    ledger: &mut Ledger,
    reference: &Independent,
    name: &str,
    set: &Set,
    kind: Kind,
) -> Result<(), CaseError> {
    let expected = reference.numbers(name, "crossings_s")?;
    let title = name.replace('_', " cycle, ") + " law";
    let (method, tolerance) = slider::method(set);
    let (events, cost) = cycle(set, kind, method, tolerance, expected.len())?;
    let recurrence = reference.number(name, "last_interval_s")?;
    let error =
        events.iter().zip(&expected).map(|(e, t)| (e.onset - t).abs() / recurrence).fold(0.0, f64::max);
    let complete = if events.len() == expected.len() { error } else { f64::NAN };
    ledger
        .claim(format!("{title}: times of the first {} events, error over the recurrence", expected.len()))
        .value(complete)
        .at_most(DIGITS)
        .evidence(Evidence::OtherCode, slider::SOURCE)
        .because("ten digits: a tolerance of 1e-13 a step, amplified by what an event does to the time of the next")
        .why_not_tighter("rounding of ln V over a few thousand steps is 1e-12 to 1e-11 where V spans thirty decades")
        .cost(&cost)
        .record();
    let last = events.last().ok_or("no event")?;
    let interval = last.interval.ok_or("one event only")?;
    ledger
        .claim(format!("{title}: recurrence"))
        .unit("s")
        .value(interval)
        .equals(recurrence)
        .relative(DIGITS)
        .evidence(Evidence::OtherCode, slider::SOURCE)
        .because("as the times")
        .why_not_tighter("as the times")
        .cost(&cost)
        .record();
    // The reference refers to the cycle between its last two onsets, which has the peak of the last event but one.
    let peak = events[events.len() - 2].peak_rate;
    ledger
        .claim(format!("{title}: largest and smallest slip rate of a cycle, as logarithms"))
        .values(&[peak.ln(), last.least_rate.ln()])
        .equals_each(&[
            reference.number(name, "v_max_between_last_two")?.ln(),
            reference.number(name, "v_min_between_last_two")?.ln(),
        ])
        .absolute(1e-9)
        .evidence(Evidence::OtherCode, slider::SOURCE)
        .because("ln V is as good as the steps; extremes are found as events, where its error is of second order in time")
        .why_not_tighter("the reference stores V to 1e-13 in the mild cycle and 1e-10 in the others")
        .cost(&cost)
        .record();
    Ok(())
}

/// Comparison with QDYN's printed values, of four or five digits.
fn against_qdyn(ledger: &mut Ledger) -> Result<(), CaseError> {
    let printed = [
        ("ageing law", Kind::Ageing, [343.11, 4.497e-2, 2.226e-9]),
        ("slip law", Kind::Slip, [313.85, 4.854e-2, 4.948e-8]),
    ];
    for (name, kind, [period, fastest, slowest]) in printed {
        let plan = slider::MILD.plan(kind, 1.5, 1.0)?;
        let (events, cost) = cycle(&slider::MILD, kind, plan.method, cycles::DEFAULT_TOLERANCE, 10)?;
        let last = events.last().ok_or("no event")?;
        let interval = last.interval.ok_or("one event only")?;
        ledger
            .claim(format!("QDYN's cycle, {name}: period"))
            .unit("s")
            .value(interval)
            .equals(period)
            .absolute(0.015)
            .evidence(
                Evidence::OtherCode,
                "QDYN, spring-slider of these parameters, period printed to 0.01 s",
            )
            .because("half of the last digit, and its own tolerance of 1e-4 in time steps")
            .why_not_tighter("the reference has five digits")
            .cost(&cost)
            .record();
        ledger
            .claim(format!("QDYN's cycle, {name}: largest and smallest slip rate"))
            .unit("m/s")
            .values(&[last.peak_rate / fastest, last.least_rate / slowest])
            .equals_each(&[1.0, 1.0])
            .absolute(5e-4)
            .evidence(Evidence::OtherCode, "QDYN, printed to four digits; ratios to its figures")
            .because("its last digit is 2e-4 of the value, and it sees extremes at its steps only")
            .why_not_tighter("the reference has four digits")
            .cost(&cost)
            .record();
    }
    Ok(())
}

/// Agreement of two methods that share only the equations: explicit of order 8 and implicit of order 5.
fn methods_agree(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (name, set, kind) in
        [("mild, ageing law", slider::MILD, Kind::Ageing), ("hard, slip law", slider::HARD, Kind::Slip)]
    {
        let (explicit, _) = cycle(&set, kind, Method::Dop853, slider::TIGHT, 4)?;
        let (implicit, cost) = cycle(&set, kind, Method::Radau5, 1e-11, 4)?;
        let (a, b) = (explicit[3].onset, implicit[3].onset);
        ledger
            .claim(format!("{name}: fourth event by radau5 against dop853, over its time"))
            .value((a / b - 1.0).abs())
            .at_most(1e-8)
            .evidence(Evidence::ConvergedSelf, "dop853 at 1e-13")
            .because("radau5 at 1e-11 a step; some thousand steps of one sign")
            .why_not_tighter("the error of radau5, not of the reference, is bounded")
            .cost(&cost)
            .record();
    }
    Ok(())
}

/// Plots slip rates over time with the onsets and the largest rate of the reference.
fn picture(ledger: &mut Ledger, reference: &Independent) -> Result<(), CaseError> {
    /// Rate at which an event begins \[m/s\].
    const ONSET: f64 = 1e-3;
    let mut plot = Plot::xy("Slip rate over the cycles", "time over the recurrence [-]", "V [m/s]")
        .axes(Axis::Linear, Axis::Log);
    for (name, stored, set, kind) in [
        ("mild, ageing", "mild_ageing", slider::MILD, Kind::Ageing),
        ("mild, slip", "mild_slip", slider::MILD, Kind::Slip),
        ("hard, ageing", "hard_ageing", slider::HARD, Kind::Ageing),
    ] {
        let mut plan = set.plan(kind, 1.5, 1e12)?;
        slider::events(&mut plan, 3);
        plan.tolerance = cycles::DEFAULT_TOLERANCE;
        let mut curve = Vec::new();
        let mut look = |now: &SliderState<'_>| curve.push((now.at.seconds(), now.conditions[0].rate));
        let run = cycles::run(&plan, &mut look)?;
        let recurrence = Entry::all(&run).last().and_then(|e| e.interval).ok_or("no recurrence")?;
        let scaled: Vec<(f64, f64)> = curve.iter().map(|(t, v)| (t / recurrence, *v)).collect();
        let crossings = reference.numbers(stored, "crossings_s")?;
        let onsets: Vec<(f64, f64)> = crossings.iter().take(3).map(|t| (t / recurrence, ONSET)).collect();
        plot = plot.series(Series::line(name, &scaled));
        plot = plot.series(Series::points(format!("{name}: onsets by heyoka"), &onsets));
    }
    ledger.plot(plot.caption("Three events of each set, on the onsets of the reference at 1 mm/s."));
    Ok(())
}
