//! Methods that factorise the Jacobian, run for a limited time and compared with the default.

use super::{ABOVE, EVENTS};
use crate::cases::seas::YEAR;
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_cycles::Equations;
use asperity_ode::{Clock, Control, Method, Occurrence, Options, Problem, Sink, Step};
use asperity_plan::faults::Plan;
use std::time::Instant;

/// Wall time after which such a method is stopped \[s\]: some thirty times what the default needs to reach the third event.
const LIMIT: f64 = 60.0;
/// Least ratio of their wall time to that of the default.
const SLOWER: f64 = 5.0;

/// The equations with a Jacobian by finite differences.
struct DifferencedEquations<'a>(Equations<'a>);

/// Step of a finite difference: half of the digits of unknowns of the order of a hundred.
const DIFFERENCE: f64 = 1e-6;

impl Problem for DifferencedEquations<'_> {
    fn size(&self) -> usize {
        self.0.size()
    }

    fn rates(&self, at: Clock, y: &[f64], dy: &mut [f64]) {
        self.0.rates(at, y, dy);
    }

    fn jacobian(&self, at: Clock, y: &[f64], jac: &mut [f64]) {
        let n = y.len();
        let (mut y, mut before) = (y.to_vec(), vec![0.0; n]);
        for (j, column) in jac.chunks_exact_mut(n).enumerate() {
            let kept = y[j];
            y[j] = kept - DIFFERENCE;
            self.0.rates(at, &y, &mut before);
            y[j] = kept + DIFFERENCE;
            self.0.rates(at, &y, column);
            y[j] = kept;
            column.iter_mut().zip(&before).for_each(|(c, b)| *c = (*c - b) / (2.0 * DIFFERENCE));
        }
    }
}

/// An observer that stops the run at the onset of the third event, or at the limit of wall time.
struct Follow<'a, 'f> {
    equations: &'a Equations<'f>,
    rate: Vec<f64>,
    /// Onsets so far \[yr\], taken at the end of the step.
    onsets: Vec<f64>,
    /// True while an event is under way.
    within: bool,
    clock: Instant,
    limit: f64,
    /// Simulated time \[yr\] and wall time \[s\] after each step.
    trace: Vec<(f64, f64)>,
}

impl Sink for Follow<'_, '_> {
    fn accepted(&mut self, step: &Step<'_>) -> Control {
        let (now, wall) = (step.end.seconds() / YEAR, self.clock.elapsed().as_secs_f64());
        self.trace.push((now, wall));
        self.equations.slip_rates(step.end, step.state, &mut self.rate);
        let largest = self.rate.iter().fold(0.0_f64, |l, v| l.max(v.abs()));
        if !self.within && largest >= ABOVE {
            self.onsets.push(now);
        }
        self.within = largest >= if self.within { 0.1 * ABOVE } else { ABOVE };
        if self.onsets.len() == EVENTS || wall > self.limit { Control::Stop } else { Control::Go }
    }

    fn occurred(&mut self, _: &Occurrence) -> Control {
        Control::Go
    }
}

/// Errors of a method along the run, with its trace.
struct MethodTrace {
    row: [String; 9],
    trace: Vec<(f64, f64)>,
    rates: u64,
}

fn reach(plan: &Plan, method: Method, limit: f64) -> MethodTrace {
    let (shear, normal) = plan.problem.loading.rates(1.0, plan.points.len(), false);
    let problem = DifferencedEquations(Equations::new(&plan.problem.fault, shear.clone(), normal.clone()));
    let watched = Equations::new(&plan.problem.fault, shear, normal);
    let mut sink = Follow {
        equations: &watched,
        rate: vec![0.0; plan.points.len()],
        onsets: Vec::new(),
        within: false,
        clock: Instant::now(),
        limit,
        trace: Vec::new(),
    };
    let options = Options {
        method,
        // Allows for rounding of the unknowns beside the absolute tolerance.
        rtol: 1e-15,
        atol: watched.tolerances(plan.problem.settings.tolerance),
        first_step: None,
        begin_stiff: false,
        largest_step: None,
        most_steps: 100_000,
    };
    let (start, end) = (Clock::new(0.0, 0.0), plan.problem.settings.end);
    let out = asperity_ode::integrate(&problem, start, &plan.problem.start, end, &options, &mut sink);
    let (at, wall) = sink.trace.last().copied().unwrap_or((0.0, limit));
    let row = [
        method.name().to_string(),
        sink.onsets.iter().map(|t| format!("{t:.3}")).collect::<Vec<_>>().join(", "),
        format!("{at:.3}"),
        out.counts.steps.to_string(),
        out.counts.rates.to_string(),
        out.counts.jacobians.to_string(),
        out.counts.factorisations.to_string(),
        format!("{wall:.2}"),
        String::new(),
    ];
    MethodTrace { row, trace: sink.trace, rates: out.counts.rates }
}

/// Compares the default and the methods that factorise, at the default's tolerance and on the same cells.
pub(super) fn compare(ledger: &mut Ledger, plan: &Plan) -> Result<(), CaseError> {
    let default = reach(plan, plan.problem.settings.method, f64::INFINITY);
    let mut least = f64::INFINITY;
    let mut rows = vec![default.row];
    for method in [Method::Bdf, Method::TrBdf2, Method::Esdirk34, Method::Radau5] {
        let mut found = reach(plan, method, LIMIT);
        let (at, wall) = found.trace.last().copied().unwrap_or((0.0, LIMIT));
        let own = default.trace.iter().find(|(t, _)| *t >= at).or(default.trace.last());
        let own = own.ok_or("the default took no step")?.1;
        found.row[8] = format!("{:.0}", wall / own);
        least = least.min(wall / own);
        rows.push(found.row);
    }
    ledger.table(
        format!(
            "methods that factorise, {} unknowns, tolerance {:.0e}: to the third onset or for {LIMIT} s",
            plan.problem.start.len(),
            plan.problem.settings.tolerance
        ),
        &[
            "method",
            "onsets [yr]",
            "reached [yr]",
            "steps",
            "right-hand sides",
            "Jacobians",
            "factorisations",
            "wall [s]",
            "over the default to there",
        ],
        rows,
    );
    ledger
        .claim("least wall time of a method that factorises over that of the default to the same simulated time")
        .value(least)
        .at_least(SLOWER)
        .evidence(Evidence::ConvergedSelf, "the default on the same cells, in the same run")
        .because("a factorisation of a full matrix of three unknowns a point costs as much as thousands of right-hand sides, and each event takes dozens")
        .why_not_tighter("wall times of a shared machine")
        .covers(&[Capability::Integrators])
        .cost(&Cost::wall(default.trace.last().map_or(0.0, |t| t.1)).count("right-hand sides", default.rates as f64))
        .record();
    Ok(())
}
