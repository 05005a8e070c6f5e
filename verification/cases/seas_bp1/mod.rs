//! The SEAS benchmark BP1-QD: its first three events.

use crate::cases::seas::{self, CONVERGED, CycleResults};
use crate::{Axis, Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_cycles::Moment;
use asperity_ode::Method;
use asperity_plan::faults::Plan;
use asperity_vary::SceneText;
use asperity_vary::bp1::{SIZE, bp1};

/// See the README.
pub const CASE: Case = Case {
    name: "seas_bp1",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::Antiplane, Capability::AgeingLaw, Capability::Events],
    quick: true,
    run,
};

/// Number of events compared.
const EVENTS: usize = 3;

/// Tolerance on ln V per step, for comparing runs that differ by less than the error of the default tolerance.
const FAR_TOLERANCE: f64 = 1e-6;

fn plan(size: f64) -> Result<Plan, CaseError> {
    let mut plan = seas::plan(&bp1(size).text()?)?;
    plan.problem.settings.most_events = Some(EVENTS);
    Ok(plan)
}

fn found(
    plan: &Plan,
    method: Method,
    tolerance: f64,
    look: impl FnMut(&Moment<'_>),
) -> Result<CycleResults, CaseError> {
    let mut settings = plan.problem.settings;
    (settings.method, settings.tolerance) = (method, tolerance);
    seas::found(plan, &settings, look)
}

/// Observer of the difference between the traction that the bodies exert and the resistance of the fault.
struct Balance {
    first: Vec<f64>,
    load: Vec<f64>,
    worst: f64,
}

impl Balance {
    fn new(plan: &Plan) -> Self {
        let n = plan.points.len();
        let rate = 1e-9;
        let first = (0..n)
            .map(|p| Self::strength(plan, p, plan.problem.start[p]) + plan.problem.fault.damping[p] * rate);
        Self { first: first.collect(), load: plan.problem.loading.rates(1.0, n, false).0, worst: 0.0 }
    }

    fn strength(plan: &Plan, p: usize, m: f64) -> f64 {
        plan.problem.fault.normal[p] * plan.problem.fault.law.scale(p) * m
    }

    fn look(&mut self, plan: &Plan, now: &Moment<'_>) {
        let exerted = plan.problem.fault.operator.shear_of(now.slip().all());
        for (p, exerted) in exerted.iter().enumerate() {
            let driving = self.first[p] + exerted + self.load[p] * now.at.seconds();
            let resisting = Self::strength(plan, p, now.unknowns[p])
                + plan.problem.fault.damping[p] * now.rate.component(0)[p];
            self.worst = self.worst.max((driving - resisting).abs() / plan.problem.fault.normal[p]);
        }
    }
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let coarse = plan(SIZE)?;
    half_space(ledger, &coarse);
    let tolerance = coarse.problem.settings.tolerance;
    let mut balance = Balance::new(&coarse);
    let at_coarse =
        found(&coarse, coarse.problem.settings.method, tolerance, |now| balance.look(&coarse, now))?;
    first_event(
        ledger,
        &at_coarse,
        "156 m",
        0.15,
        "the error of boundary elements with as many unknowns (QDYN, 78 m)",
    );
    let fine = plan(78.125)?;
    let mut rates = Vec::new();
    let at_fine = found(&fine, fine.problem.settings.method, tolerance, |now| {
        rates.push((now.at.seconds() / seas::YEAR, now.largest));
    })?;
    overlay(ledger, &at_fine.onsets, &rates)?;
    first_event(ledger, &at_fine, "78 m", 0.098, "0.05 %, four cells to the process zone of 340 m");
    later_events(ledger, &at_fine);
    ledger
        .claim("imbalance of tractions over f_n, largest of all points and steps")
        .value(balance.worst)
        .at_most(seas::drift(&coarse, at_coarse.steps))
        .evidence(Evidence::Exact, "tractions from slip by the operator against those the integrator carries")
        .because(
            "slip has an error of tolerance times L in each step, which G over the smallest nodal area turns into traction at the \
             shortest wavelength; errors of steps add up like a random walk",
        )
        .why_not_tighter("a random walk is as often shorter as longer than its root mean square, and most steps err by less than the tolerance")
        .covers(&[Capability::FaultCycles])
        .cost(&at_coarse.cost)
        .record();
    methods(ledger, &coarse, &at_coarse)?;
    far_field(ledger)
}

/// Depth extent of the slip that is compared with a half-space \[m\].
const DEEP: f64 = 39e3;
/// Shear modulus of the benchmark \[Pa\]: 2670 kg/m^3 and 3464 m/s.
const ROCK: f64 = 2670.0 * 3464.0 * 3464.0;

/// Slip \[m\] at a depth \[m\]; together with its image it is smooth at the surface.
fn long_slip(depth: f64) -> f64 {
    (1.0 - (depth / DEEP).powi(2)).max(0.0).powi(3)
}

/// Traction of that slip at a depth in a half-space, from screw dislocations and their images above the surface \[Pa\].
fn screws(depth: f64) -> f64 {
    const PIECE: f64 = 20.0;
    // The depth is the middle of a piece, so that no end falls on it; the first piece may start above the surface.
    let first = (depth / PIECE).fract() * PIECE - 1.5 * PIECE;
    let end = |k: usize| (first + k as f64 * PIECE).max(0.0);
    // At the surface an end is its own image.
    let pull = |end: f64| if end > 0.0 { 1.0 / (depth - end) - 1.0 / (depth + end) } else { 0.0 };
    let pieces = 0..=(DEEP / PIECE).ceil() as usize + 1;
    let sum: f64 =
        pieces.map(|k| long_slip(0.5 * (end(k) + end(k + 1))) * (pull(end(k + 1)) - pull(end(k)))).sum();
    ROCK * sum / std::f64::consts::TAU
}

/// Stiffness against slip over the whole fault, which is most sensitive to the borders.
fn half_space(ledger: &mut Ledger, plan: &Plan) {
    let slip: Vec<f64> = plan.points.iter().map(|p| long_slip(-p.at[1])).collect();
    let (found, cost) = Cost::measure(|| plan.problem.fault.operator.shear_of(&slip));
    let expected: Vec<f64> = plan.points.iter().map(|p| screws(-p.at[1])).collect();
    let largest = expected.iter().fold(0.0_f64, |m, t| m.max(t.abs()));
    let worst = expected.iter().zip(&found).fold(0.0_f64, |m, (e, f)| m.max((e - f).abs()));
    ledger
        .claim("tractions of slip that ends at 39 km, against a half-space, largest error over the largest traction")
        .value(worst / largest)
        .at_most(3e-4)
        .evidence(Evidence::SemiAnalytic, "screw dislocations and their images in pieces of 20 m")
        .because("the lumped interface mass errs by h^2/6 times the second derivative of the tractions: at most 2.8e-4, at 33 km, where cells are of 460 m; borders at 8000 km add (40/8000)^2 = 2.5e-5 at most")
        .covers(&[Capability::FaultCycles, Capability::Antiplane])
        .cost(&cost)
        .record();
}

/// Plots largest slip rates with those of the second implementation: over all years, and around the onset of each event.
fn overlay(ledger: &mut Ledger, onsets: &[f64], rates: &[(f64, f64)]) -> Result<(), CaseError> {
    let (reference, starts) = seas::largest_rates()?;
    let all = Plot::xy("Largest slip rate", "time [yr]", "V_max [m/s]").axes(Axis::Linear, Axis::Log);
    ledger.plot(
        all.series(Series::line("the program, cells of 78 m", rates))
            .series(Series::line("boundary elements of 78 m", &reference))
            .caption("Three events; the reference is bp1_largest_rate.py in verification/independent."),
    );
    // From before the rise to 1 mm/s until the fastest slip has passed [s].
    let shown = -60.0..240.0;
    let around = |curve: &[(f64, f64)], onset: f64| -> Vec<(f64, f64)> {
        let since = curve.iter().map(|(t, v)| ((t - onset) * seas::YEAR, *v));
        since.filter(|(t, _)| shown.contains(t)).collect()
    };
    let mut events = Plot::xy("Largest slip rate in the events", "time since the onset [s]", "V_max [m/s]")
        .axes(Axis::Linear, Axis::Log);
    for (k, (own, other)) in onsets.iter().zip(&starts).enumerate() {
        events = events.series(Series::line(format!("event {}", k + 1), &around(rates, *own)));
        events =
            events.series(Series::points(format!("event {}, reference", k + 1), &around(&reference, *other)));
    }
    ledger.plot(events.caption("Each curve from its own onset, V_max = 1 mm/s."));
    Ok(())
}

fn first_event(ledger: &mut Ledger, found: &CycleResults, size: &str, bound: f64, because: &str) {
    ledger
        .claim(format!("onset of the first event, cells of {size}"))
        .unit("yr")
        .value(found.onsets[0])
        .equals(196.365)
        .absolute(bound)
        .uncertainty(0.005)
        .evidence(Evidence::OtherCode, CONVERGED)
        .because(because)
        .why_not_tighter("errors of this size change sign with the size of cells")
        .covers(&[Capability::FaultCycles, Capability::Antiplane])
        .cost(&found.cost)
        .record();
}

fn later_events(ledger: &mut Ledger, found: &CycleResults) {
    let intervals: Vec<f64> = found.onsets.windows(2).map(|w| w[1] - w[0]).collect();
    ledger
        .claim("first two intervals, cells of 78 m")
        .unit("yr")
        .values(&intervals)
        .equals_each(&[75.62, 77.82])
        .absolute(0.15)
        .uncertainty(0.01)
        .evidence(Evidence::OtherCode, CONVERGED)
        .because("what boundary elements of 156 m, as many to the process zone as corners of cells here, leave (QDYN: 75.48 yr)")
        .why_not_tighter("intervals do not converge monotonically")
        .covers(&[Capability::FaultCycles, Capability::Events])
        .cost(&found.cost)
        .record();
    let peaks: Vec<f64> = found.events[1..].iter().map(|e| e.peak).collect();
    ledger
        .claim("peak slip rate of the second and third event, cells of 78 m")
        .unit("m/s")
        .values(&peaks)
        .equals_each(&[4.19, 4.19])
        .relative(0.02)
        .uncertainty(0.01)
        .evidence(Evidence::OtherCode, CONVERGED)
        .because("the peak is a few steps and cells wide; QDYN is 1.3 % low with cells of 78 m")
        .covers(&[Capability::FaultCycles])
        .cost(&found.cost)
        .record();
    let last = &found.events[EVENTS - 1];
    ledger
        .claim("time of the third event above 1 mm/s, cells of 78 m")
        .unit("s")
        .value(last.details.above)
        .equals(131.0)
        .relative(0.03)
        .uncertainty(0.5)
        .evidence(Evidence::OtherCode, CONVERGED)
        .because("the reference is that of later events, whose interval is 0.7 % longer; an event ends in afterslip that decays slowly")
        .covers(&[Capability::Events])
        .cost(&found.cost)
        .record();
}

/// Errors of the default beside other methods at the same tolerance; the case `seas_bp1_methods` has all methods.
fn methods(ledger: &mut Ledger, plan: &Plan, default: &CycleResults) -> Result<(), CaseError> {
    let reference = found(plan, Method::Dop853, 1e-8, |_| {})?;
    let exact = reference.onsets[EVENTS - 1];
    let error = |run: &CycleResults| (run.onsets[EVENTS - 1] - exact).abs();
    ledger
        .claim("onset of the third event by the default method and tolerance, error")
        .unit("yr")
        .value(error(default))
        .at_most(0.01)
        .between(&(plan.problem.settings.method, plan.problem.settings.tolerance), &(Method::Dop853, 1e-8))
        .evidence(Evidence::ConvergedSelf, "dop853 with a tolerance of 1e-8 on the same cells")
        .because("a tenth of what cells of 78 m leave")
        .covers(&[Capability::FaultCycles, Capability::Integrators])
        .cost(&default.cost)
        .record();
    Ok(())
}

/// The scene with its far borders, and the cells next to them, at half the distance.
fn nearer(scene: SceneText) -> SceneText {
    let mesh = |key: &str| format!("bodies.crust.mesh.fault.{key}");
    scene
        .with(&mesh("trace[4][1]"), "-4000 km")
        .with(&mesh("spacing[4]"), "[\"4000 km\", \"800 km\"]")
        .with(&mesh("min"), "[\"-4000 km\", \"-4000 km\"]")
        .with(&mesh("max[0]"), "4000 km")
}

/// Influence of the far borders. At half the distance it changes the first event and the first interval by three times
/// the remaining error, since it falls with the square of the distance.
fn far_field(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut runs = Vec::new();
    for scene in [bp1(SIZE), nearer(bp1(SIZE))] {
        let mut plan = seas::plan(&scene.text()?)?;
        plan.problem.settings.most_events = Some(2);
        runs.push(found(&plan, plan.problem.settings.method, FAR_TOLERANCE, |_| {})?);
    }
    let interval = |run: &CycleResults| run.onsets[1] - run.onsets[0];
    let (far, near) = (&runs[0], &runs[1]);
    for (name, a, b) in [
        ("the onset of the first event", far.onsets[0], near.onsets[0]),
        ("the first interval", interval(far), interval(near)),
    ] {
        ledger
            .claim(format!("share by which {name} changes where the borders lie at 4000 instead of 8000 km"))
            .value(((a - b) / a).abs())
            .at_most(1e-4)
            // The same plan twice would give identical bits.
            .between(&runs[0].onsets, &runs[1].onsets)
            .evidence(
                Evidence::ConvergedSelf,
                "the same cells where the fault slips, borders at both distances",
            )
            .because("the influence of the borders on the recurrence shall be below 0.01 %")
            .why_not_tighter("that is what is asked for; the borders of the scene lie further than it needs")
            .covers(&[Capability::FaultCycles])
            .cost(&far.cost)
            .record();
    }
    Ok(())
}
