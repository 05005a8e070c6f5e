//! Methods of integration on BP1 through three events: error over cost.

use crate::cases::seas::{self, YEAR};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_driver::fault::{Equations, Moment, Plan, run as integrate};
use asperity_driver::ode::{self, Clock, Control, Method, Occurrence, Options, Outcome, Problem, Sink, Step};
use std::time::Instant;

mod splitting;

/// See the README.
pub const CASE: Case = Case {
    name: "seas_bp1_methods",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::Integrators],
    quick: false,
    run,
};

const EVENTS: usize = 3;
/// Slip rate that begins an event \[m/s\].
const ABOVE: f64 = 1e-3;
const TOLERANCES: [f64; 6] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7];
/// What the default may need at most over the best method at its error.
const FACTOR: f64 = 1.5;

/// What a setting gave.
struct Setting {
    tolerance: f64,
    onsets: Vec<f64>,
    peak: f64,
    wall: f64,
    steps: u64,
    rejected: u64,
    rates: u64,
}

impl Setting {
    /// Errors of the first and of the last onset \[yr\], and of ln of the last peak.
    fn errors(&self, exact: &Setting) -> [f64; 3] {
        let off = |k: usize| (self.onsets[k] - exact.onsets[k]).abs();
        [off(0), off(EVENTS - 1), (self.peak / exact.peak).ln().abs()]
    }
}

/// A method with what its settings gave, or why they failed.
struct Curve {
    name: &'static str,
    settings: Vec<Setting>,
    failed: Vec<(f64, String)>,
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut plan = seas::plan(include_str!("../../../scenes/bp1.toml"))?;
    plan.settings.most_events = Some(EVENTS);
    (plan.settings.thresholds.on, plan.settings.thresholds.off) = (ABOVE, 0.999 * ABOVE);
    let exact = setting(&plan, Method::Dop853, 1e-9)??;
    let near = setting(&plan, Method::Dop853, 1e-8)??;
    ledger
        .claim("third onset of the reference, tolerance 1e-9, against 1e-8")
        .unit("yr")
        .value(near.errors(&exact)[1])
        .at_most(1e-5)
        .evidence(Evidence::ConvergedSelf, "the same method at ten times the tolerance")
        .because("a tenth of the smallest error the study looks at")
        .why_not_tighter("the reference is to be better than what it judges, not exact")
        .record();
    let mut curves = Vec::new();
    for method in Method::EXPLICIT {
        let mut curve = Curve { name: method.name(), settings: Vec::new(), failed: Vec::new() };
        for tolerance in TOLERANCES {
            match setting(&plan, method, tolerance)? {
                Ok(found) => curve.settings.push(found),
                Err(reason) => curve.failed.push((tolerance, reason)),
            }
        }
        curves.push(curve);
    }
    let mut curve = Curve { name: "splitting", settings: Vec::new(), failed: Vec::new() };
    for tolerance in TOLERANCES.into_iter().take(4) {
        match splitting::setting(&plan, tolerance) {
            Ok(found) => curve.settings.push(found),
            Err(reason) => curve.failed.push((tolerance, reason)),
        }
    }
    curves.push(curve);
    draw(ledger, &curves, &exact);
    judge(ledger, &plan, &curves, &exact)?;
    implicit(ledger)
}

/// Runs a setting, or tells why it failed.
fn setting(plan: &Plan, method: Method, tolerance: f64) -> Result<Result<Setting, String>, CaseError> {
    let mut settings = plan.settings;
    (settings.method, settings.tolerance) = (method, tolerance);
    let clock = Instant::now();
    let mut watch = |_: &Moment<'_>| Control::Go;
    let out = integrate(&plan.fault, &plan.loading, plan.start.clone(), &settings, &mut watch);
    let wall = clock.elapsed().as_secs_f64();
    if let Outcome::Failed { reason } = out.outcome {
        return Ok(Err(reason.to_string()));
    }
    let events = out.catalogue.events();
    Ok(match events.get(EVENTS - 1) {
        None => Err(format!("{} events instead of {EVENTS}", events.len())),
        Some(last) => Ok(Setting {
            tolerance,
            onsets: events.iter().map(|e| e.onset.seconds() / YEAR).collect(),
            peak: last.peak,
            wall,
            steps: out.counts.steps,
            rejected: out.counts.rejected,
            rates: out.counts.rates,
        }),
    })
}

/// A cost of a setting.
type Read = fn(&Setting) -> f64;

fn draw(ledger: &mut Ledger, curves: &[Curve], exact: &Setting) {
    let errors = [(1, "the third onset [yr]"), (2, "ln of the third peak slip rate")];
    let costs: [(&str, Read); 3] = [
        ("wall time [s]", |s| s.wall),
        ("steps", |s| s.steps as f64),
        ("right-hand sides", |s| s.rates as f64),
    ];
    for (which, error) in errors {
        for (cost, read) in costs {
            let mut plot =
                Plot::work_precision("BP1, cells of 156 m", format!("error of {error}"), cost.to_string());
            for curve in curves {
                let points: Vec<(f64, f64)> =
                    curve.settings.iter().map(|s| (s.errors(exact)[which], read(s))).collect();
                let mut series = Series::marked(curve.name, &points);
                for (tolerance, reason) in &curve.failed {
                    series =
                        series.failed(*tolerance, format!("{} at {tolerance:.0e}: {reason}", curve.name));
                }
                plot = plot.series(series);
            }
            ledger.plot(plot.caption("Tolerances from 1e-2 to 1e-7, of the splitting to 1e-5."));
        }
    }
    let rows = curves.iter().flat_map(|c| {
        c.settings.iter().map(move |s| {
            let [first, last, peak] = s.errors(exact);
            [
                c.name.to_string(),
                format!("{:.0e}", s.tolerance),
                format!("{first:.1e}"),
                format!("{last:.1e}"),
                format!("{peak:.1e}"),
                s.steps.to_string(),
                s.rejected.to_string(),
                s.rates.to_string(),
                format!("{:.2}", s.wall),
            ]
        })
    });
    ledger.table(
        "to the end of the third event: errors against the same cells in the limit of small steps",
        &[
            "method",
            "tolerance",
            "first onset [yr]",
            "third onset [yr]",
            "ln peak",
            "steps",
            "rejected",
            "right-hand sides",
            "wall [s]",
        ],
        rows.collect::<Vec<_>>(),
    );
}

/// Fewest right-hand sides of a method for an error of the third onset of at most `error` \[yr\], over settings that all keep it.
fn needed(curve: &Curve, exact: &Setting, error: f64) -> Option<u64> {
    // An error may be small by chance: from the loosest setting on from which all errors are small.
    let kept = curve.settings.iter().rposition(|s| s.errors(exact)[1] > error).map_or(0, |k| k + 1);
    curve.settings[kept..].iter().map(|s| s.rates).min()
}

fn judge(ledger: &mut Ledger, plan: &Plan, curves: &[Curve], exact: &Setting) -> Result<(), CaseError> {
    let default = plan.settings;
    let own = setting(plan, default.method, default.tolerance)??;
    let error = own.errors(exact)[1];
    let found = curves.iter().map(|c| (c.name, needed(c, exact, error)));
    let rows: Vec<(&str, Option<u64>)> = found.collect();
    let least = rows.iter().filter_map(|r| r.1).min().ok_or("no method keeps the error of the default")?;
    ledger.table(
        format!("fewest right-hand sides for an error of the third onset of at most {error:.1e} yr"),
        &["method", "right-hand sides"],
        rows.iter().map(|(name, n)| [name.to_string(), n.map_or("not reached".into(), |n| n.to_string())]),
    );
    ledger
        .claim("right-hand sides of the default over the fewest of any method at its error")
        .value(own.rates as f64 / least as f64)
        .at_most(FACTOR)
        .evidence(Evidence::ConvergedSelf, "dop853 at 1e-9 on the same cells")
        .because("no setting of any method does much better: what is lost by not knowing the best tolerance beforehand")
        .why_not_tighter("settings are a factor of ten apart in tolerance")
        .covers(&[Capability::Integrators])
        .cost(&Cost::wall(own.wall).count("right-hand sides", own.rates as f64))
        .record();
    Ok(())
}

/// The equations with a Jacobian by differences, for methods that factorise.
struct Differenced<'a>(Equations<'a>);

/// Step of a difference: half of the digits of unknowns of the order of a hundred.
const DIFFERENCE: f64 = 1e-6;

impl Problem for Differenced<'_> {
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

/// Ends where an event begins.
struct Onset<'a> {
    equations: &'a Equations<'a>,
    rate: Vec<f64>,
    at: Option<f64>,
}

impl Sink for Onset<'_> {
    fn accepted(&mut self, step: &Step<'_>) -> Control {
        self.equations.slip_rates(step.state, &mut self.rate);
        if self.rate.iter().all(|v| v.abs() < ABOVE) {
            return Control::Go;
        }
        self.at = Some(step.end.seconds() / YEAR);
        Control::Stop
    }

    fn occurred(&mut self, _: &Occurrence) -> Control {
        Control::Go
    }
}

/// Methods that factorise, on coarse cells to the first event.
fn implicit(ledger: &mut Ledger) -> Result<(), CaseError> {
    let text = include_str!("../../../scenes/bp1.toml")
        .replace("156.25 m", "1250 m")
        .replace("\"600 m\"", "\"2500 m\"");
    let plan = seas::plan(&text)?;
    let (shear, normal) = plan.loading.rates(1.0, plan.points.len(), false);
    let mut rows = Vec::new();
    for method in [Method::Tsit5, Method::Bdf, Method::TrBdf2, Method::Esdirk34, Method::Radau5] {
        let problem = Differenced(Equations::new(&plan.fault, shear.clone(), normal.clone()));
        let watched = Equations::new(&plan.fault, shear.clone(), normal.clone());
        let mut sink = Onset { equations: &watched, rate: vec![0.0; plan.points.len()], at: None };
        let options = Options {
            method,
            // Rounding of the unknowns beside the tolerance.
            rtol: 1e-15,
            atol: watched.tolerances(plan.settings.tolerance),
            first_step: None,
            largest_step: None,
            most_steps: 100_000,
        };
        let clock = Instant::now();
        let out = ode::integrate(
            &problem,
            Clock::new(0.0, 0.0),
            &plan.start,
            plan.settings.end,
            &options,
            &mut sink,
        );
        rows.push([
            method.name().to_string(),
            sink.at.map_or(format!("{:?}", out.outcome), |t| format!("{t:.4}")),
            out.counts.steps.to_string(),
            out.counts.rates.to_string(),
            out.counts.jacobians.to_string(),
            out.counts.factorisations.to_string(),
            format!("{:.2}", clock.elapsed().as_secs_f64()),
        ]);
    }
    ledger.table(
        format!("to the first event, cells of 1250 m ({} unknowns), tolerance 1e-4", plan.start.len()),
        &["method", "onset [yr]", "steps", "right-hand sides", "Jacobians", "factorisations", "wall [s]"],
        rows,
    );
    Ok(())
}
