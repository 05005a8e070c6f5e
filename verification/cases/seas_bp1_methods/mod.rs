//! Time integrators on BP1 through three events: error against cost.

use crate::cases::seas::{self, YEAR};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_ode::{Method, Outcome};
use asperity_plan::faults::Plan;
use asperity_vary::bp1::BP1;
use std::time::Instant;

mod factorising;
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
/// Slip rate at which an event begins \[m/s\].
const ABOVE: f64 = 1e-3;
/// Tolerances, two to a decade.
const TOLERANCES: [f64; 10] = [1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 3e-7];
/// Number of tolerances for the splitting: of second order, it takes too many steps at smaller ones.
const OF_SPLITTING: usize = 7;
/// Errors of the third onset \[yr\] at which costs are compared: half the error of cells of 78 m, the error of the
/// default's tolerance, and a fifth of that.
const MARKS: [f64; 3] = [0.05, 0.012, 0.0024];
/// Largest cost of the default method over that of the best one at a mark.
const FACTOR: f64 = 1.25;

/// Result of a run at one tolerance.
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

/// A method with the results of its settings, and the reasons of those that failed.
struct Curve {
    name: &'static str,
    settings: Vec<Setting>,
    failed: Vec<(f64, String)>,
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut plan = seas::plan(BP1)?;
    plan.problem.settings.most_events = Some(EVENTS);
    (plan.problem.settings.thresholds.on, plan.problem.settings.thresholds.off) = (ABOVE, 0.999 * ABOVE);
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
    for tolerance in TOLERANCES.into_iter().take(OF_SPLITTING) {
        match splitting::setting(&plan, tolerance) {
            Ok(found) => curve.settings.push(found),
            Err(reason) => curve.failed.push((tolerance, reason)),
        }
    }
    curves.push(curve);
    draw(ledger, &curves, &exact);
    judge(ledger, &plan, &curves, &exact)?;
    factorising::compare(ledger, &plan)
}

/// Runs a setting. The inner error is the reason for which it failed.
fn setting(plan: &Plan, method: Method, tolerance: f64) -> Result<Result<Setting, String>, CaseError> {
    let mut settings = plan.problem.settings;
    (settings.method, settings.tolerance) = (method, tolerance);
    let clock = Instant::now();
    let out = plan.problem.run(&settings, &mut ())?;
    let wall = clock.elapsed().as_secs_f64();
    if let Outcome::Failed { reason } = out.outcome {
        return Ok(Err(reason.to_string()));
    }
    let events = out.events();
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

/// A function that reads a cost of a setting.
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
            ledger.plot(plot.caption("Tolerances from 1e-2 to 3e-7, of the splitting to 1e-5."));
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

/// The cheapest setting of a method with an error of the third onset of at most `error` \[yr\] that all tighter
/// settings keep as well.
fn needed<'a>(curve: &'a Curve, exact: &Setting, error: f64) -> Option<&'a Setting> {
    // An error may be small by chance: only settings count from which on all errors are small.
    let kept = curve.settings.iter().rposition(|s| s.errors(exact)[1] > error).map_or(0, |k| k + 1);
    curve.settings[kept..].iter().min_by_key(|s| s.rates)
}

fn judge(ledger: &mut Ledger, plan: &Plan, curves: &[Curve], exact: &Setting) -> Result<(), CaseError> {
    let default = plan.problem.settings.method.name();
    let mut rows = Vec::new();
    for mark in MARKS {
        let found: Vec<(&str, Option<&Setting>)> =
            curves.iter().map(|c| (c.name, needed(c, exact, mark))).collect();
        let least = found.iter().filter_map(|(_, s)| s.map(|s| s.rates)).min();
        let least = least.ok_or("no method keeps a mark")?;
        rows.extend(found.iter().map(|(name, setting)| mark_row(mark, name, *setting, least)));
        let own = found.iter().find(|(name, _)| *name == default).and_then(|(_, s)| *s);
        let own = own.ok_or("the default does not keep a mark")?;
        ledger
            .claim(format!(
                "right-hand sides of the default method over the fewest of any, errors of the third onset of at most {mark} yr"
            ))
            .value(own.rates as f64 / least as f64)
            .at_most(FACTOR)
            .evidence(Evidence::ConvergedSelf, "dop853 at 1e-9 on the same cells")
            .because("no method does much better at any mark: neighbouring tolerances, a factor of three apart, differ by up to a fifth in cost")
            .covers(&[Capability::Integrators])
            .cost(&Cost::wall(own.wall).count("right-hand sides", own.rates as f64))
            .record();
    }
    ledger.table(
        "least cost for an error of the third onset of at most a mark; each right-hand side applies the operator once",
        &["mark [yr]", "method", "tolerance", "error [yr]", "steps", "right-hand sides", "over the least", "wall [s]"],
        rows.into_iter().map(|(error, mut row)| {
            row[3] = error.map_or(String::new(), |s| format!("{:.1e}", s.errors(exact)[1]));
            row
        }),
    );
    Ok(())
}

/// A row of the table of marks, and its setting.
fn mark_row<'a>(
    mark: f64,
    name: &str,
    setting: Option<&'a Setting>,
    least: u64,
) -> (Option<&'a Setting>, [String; 8]) {
    let told = |value: &dyn Fn(&Setting) -> String| setting.map_or("-".into(), value);
    let row = [
        mark.to_string(),
        name.to_string(),
        setting.map_or("not reached".into(), |s| format!("{:.0e}", s.tolerance)),
        String::new(),
        told(&|s| s.steps.to_string()),
        told(&|s| s.rates.to_string()),
        told(&|s| format!("{:.2}", s.rates as f64 / least as f64)),
        told(&|s| format!("{:.2}", s.wall)),
    ];
    (setting, row)
}
