//! BP1 with inertia in its ruptures, next to BP1 with radiation damping.

use crate::cases::seas::{self, CycleResults};
use crate::{Axis, Capability, Case, CaseError, Evidence, Ledger, Plot, Series};
use asperity_cycles::{Balance, Episode, Moment};
use asperity_plan::faults::Plan;
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "seas_bp1_fd",
    readme: include_str!("README.md"),
    covers: &[
        Capability::FaultCycles,
        Capability::DynamicRupture,
        Capability::Antiplane,
        Capability::AgeingLaw,
        Capability::Events,
    ],
    quick: false,
    run,
};

const SCENE: &str = include_str!("../../../scenes/bp1-fd.toml");
/// Shear wave speed \[m/s\].
const SHEAR_WAVE: f64 = 3464.0;
/// Slip rate that marks the front of a rupture \[m/s\].
const FRONT: f64 = 0.1;
/// Depths between which the mean speed of the front is taken \[m\].
const BETWEEN: [f64; 2] = [4e3, 10e3];
/// Rate of the plates \[m/s\].
const PLATES: f64 = 1e-9;
/// Depth above which slip is averaged \[m\].
const LOCKED: f64 = 15e3;

/// A run of two events.
struct Cycles {
    found: CycleResults,
    episodes: Vec<Episode>,
    /// Time of the front after the onset of the first event, by depth \[s, m\].
    front: Vec<(f64, f64)>,
    /// Largest slip rate after the onset of the first event \[s, m/s\].
    history: Vec<(f64, f64)>,
    /// Mean slip of each event in the locked part \[m\].
    slip: Vec<f64>,
    imbalance: f64,
}

impl Cycles {
    /// Mean speed of the front of the first event \[m/s\].
    fn speed(&self) -> f64 {
        let at = |depth: f64| {
            let near = |x: &&(f64, f64)| (x.1 - depth).abs() < 1.0;
            self.front.iter().find(near).map_or(f64::NAN, |x| x.0)
        };
        (BETWEEN[1] - BETWEEN[0]) / (at(BETWEEN[0]) - at(BETWEEN[1]))
    }

    /// Interval between both events \[s\].
    fn interval(&self) -> f64 {
        self.found.events[1].interval.unwrap_or(f64::NAN)
    }
}

/// Sees the first event.
struct Watch<'a> {
    balance: Balance<'a>,
    imbalance: f64,
    arrivals: Vec<f64>,
    history: Vec<(f64, f64)>,
}

impl Watch<'_> {
    fn see(&mut self, now: &Moment<'_>) {
        self.balance.step(now);
        if now.events().len() == 2 {
            self.imbalance = self.balance.energy(now.slip().all(), now.pressed).imbalance();
        }
        let Some(event) = now.under_way().filter(|_| now.events().is_empty()) else { return };
        let since = now.at.since(&event.onset);
        self.history.push((since, now.largest));
        for (point, arrival) in self.arrivals.iter_mut().enumerate() {
            if arrival.is_nan() && now.speed(point) >= FRONT {
                *arrival = since;
            }
        }
    }
}

fn cycles(scene: &str) -> Result<Cycles, CaseError> {
    let mut plan = seas::plan(scene)?;
    // The balance needs the problem while the plan gives its bodies away.
    let problem = seas::plan(scene)?.problem;
    let mut watch = Watch {
        balance: Balance::new(&problem),
        imbalance: f64::NAN,
        arrivals: vec![f64::NAN; plan.points.len()],
        history: Vec::new(),
    };
    let (found, episodes) = match plan.ruptures {
        Some(_) => seas::found_with_mass(&mut plan, |now| watch.see(now))?,
        None => (seas::found(&plan, &plan.problem.settings, |now| watch.see(now))?, Vec::new()),
    };
    let depth = |p: usize| plan.points[p].along;
    let front = watch.arrivals.iter().enumerate().map(|(p, t)| (*t, depth(p)));
    Ok(Cycles {
        front: front.filter(|(t, _)| t.is_finite()).collect(),
        history: watch.history,
        slip: found.events.iter().map(|e| mean(&plan, e.details.slip.all())).collect(),
        imbalance: watch.imbalance,
        found,
        episodes,
    })
}

/// Mean of values over the locked part.
fn mean(plan: &Plan, values: &[f64]) -> f64 {
    let points = || plan.points.iter().zip(values).filter(|(p, _)| p.along <= LOCKED);
    let area: f64 = points().map(|(p, _)| p.area).sum();
    points().map(|(p, v)| p.area * v).sum::<f64>() / area
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let damped = SceneText::new(SCENE)
        .with("time.stepper", "fault-ode")
        .without("time.handover")
        .without("stages[0].conditions[2]")
        .without("stages[0].conditions[1].absorbing")
        .without("stages[0].conditions[0].absorbing");
    let (inertia, damped) = (cycles(SCENE)?, cycles(&damped.text()?)?);
    nucleation(ledger, &inertia, &damped);
    rupture(ledger, &inertia, &damped);
    passages(ledger, &inertia);
    table(ledger, [&inertia, &damped]);
    let by_depth = |c: &Cycles| c.front.iter().filter(|(_, d)| *d <= LOCKED).copied().collect::<Vec<_>>();
    ledger.plot(
        Plot::xy("Front of the first rupture", "time since the onset [s]", "depth [m]")
            .series(Series::line("with inertia", &by_depth(&inertia)))
            .series(Series::line("with damping", &by_depth(&damped)))
            .caption("Times at which points pass 0.1 m/s."),
    );
    let within = |c: &Cycles| c.history.iter().filter(|(t, _)| *t < 200.0).copied().collect::<Vec<_>>();
    ledger.plot(
        Plot::xy("Largest slip rate of the first event", "time since the onset [s]", "V [m/s]")
            .axes(Axis::Linear, Axis::Log)
            .series(Series::line("with inertia", &within(&inertia)))
            .series(Series::line("with damping", &within(&damped)))
            .caption("Both nucleate alike; with inertia the rupture is faster and over sooner."),
    );
    Ok(())
}

fn nucleation(ledger: &mut Ledger, inertia: &Cycles, damped: &Cycles) {
    ledger
        .claim("onset of the first event with inertia")
        .unit("yr")
        .value(inertia.found.onsets[0])
        .equals(damped.found.onsets[0])
        .relative(1e-9)
        .evidence(Evidence::Exact, "the same equations up to the hand-over")
        .because("the onset lies within the last step before the first hand-over")
        .why_not_tighter("the two runs do the same up to there, so that there is no difference at all")
        .between(&inertia.episodes.len(), &damped.episodes.len())
        .cost(&inertia.found.cost)
        .record();
    let closes = |c: &Cycles| c.found.events[1].details.slip.all()[0] / (PLATES * c.interval());
    ledger
        .claim("slip of the second event at the surface over the motion of the plates since the first, with inertia and with damping")
        .values(&[closes(inertia), closes(damped)])
        .equals_each(&[1.0, 1.0])
        .absolute(0.1)
        .evidence(Evidence::Exact, "a locked fault slips in an event what the plates moved since the one before")
        .because("the first two events differ, as the start is not part of a cycle; a tenth of the slip is carried over")
        .cost(&inertia.found.cost)
        .record();
}

fn rupture(ledger: &mut Ledger, inertia: &Cycles, damped: &Cycles) {
    ledger
        .claim("mean speed of the front from 10 to 4 km of depth with inertia, over that of shear waves")
        .value(inertia.speed() / SHEAR_WAVE)
        .at_most(1.0)
        .evidence(Evidence::Exact, "no antiplane rupture outruns shear waves")
        .because("the front is nowhere faster")
        .cost(&inertia.found.cost)
        .record();
    ledger
        .claim("mean speed of the front with inertia over that with damping")
        .value(inertia.speed() / damped.speed())
        .at_least(SPEEDS)
        .evidence(Evidence::ConvergedSelf, "the same scene with radiation damping")
        .because("waves carry stress ahead of the front, which damping takes away (Lapusta et al. 2000)")
        .cost(&damped.found.cost)
        .record();
    ledger
        .claim("mean slip of the first event above 15 km with inertia over that with damping")
        .value(inertia.slip[0] / damped.slip[0])
        .at_least(SLIPS)
        .evidence(Evidence::ConvergedSelf, "the same scene with radiation damping")
        .because("a rupture with inertia overshoots the traction at which it slides; damping does not")
        .cost(&damped.found.cost)
        .record();
    ledger
        .claim("peak slip rate of the first event with inertia over that with damping")
        .value(inertia.found.events[0].peak / damped.found.events[0].peak)
        .at_least(PEAKS)
        .evidence(Evidence::ConvergedSelf, "the same scene with radiation damping")
        .because("slip rates at the front grow with its speed")
        .cost(&damped.found.cost)
        .record();
}

/// Least ratio of the speeds of the fronts.
const SPEEDS: f64 = 1.2;
/// Least ratio of the slips.
const SLIPS: f64 = 1.1;
/// Least ratio of the peak slip rates.
const PEAKS: f64 = 1.5;

fn passages(ledger: &mut Ledger, inertia: &Cycles) {
    let most = |of: fn(&Episode) -> f64| inertia.episodes.iter().map(of).fold(0.0, f64::max);
    ledger
        .claim("largest difference of tractions with mass and in equilibrium at the end of a rupture, over its stress drop")
        .value(most(|e| e.unbalanced_drop))
        .at_most(0.02)
        .evidence(Evidence::Exact, "waves that have left leave equilibrium behind")
        .because("waves that the coarse cells return, and sides 2000 km away that waves do not reach in the rupture")
        .cost(&inertia.found.cost)
        .record();
    ledger
        .claim("imbalance of energy at the end over its largest part, with inertia")
        .value(inertia.imbalance)
        .at_most(5e-5)
        .evidence(
            Evidence::Exact,
            "work of the loads = stored energy + work of friction + energy of damping and waves",
        )
        .because(
            "points pass the cohesive zone in some tens of steps, within which tractions are taken as linear",
        )
        .cost(&inertia.found.cost)
        .record();
}

fn table(ledger: &mut Ledger, runs: [&Cycles; 2]) {
    let row = |name: &str, of: &dyn Fn(&Cycles) -> String| {
        let mut cells = vec![name.to_string()];
        cells.extend(runs.iter().map(|c| of(c)));
        cells
    };
    let number = |x: f64| format!("{x:.4}");
    let rows = [
        row("onset of the first event [yr]", &|c| number(c.found.onsets[0])),
        row("interval [yr]", &|c| number(c.interval() / seas::YEAR)),
        row("speed of the front, 10 to 4 km [m/s]", &|c| number(c.speed())),
        row("peak slip rate, first event [m/s]", &|c| number(c.found.events[0].peak)),
        row("peak slip rate, second event [m/s]", &|c| number(c.found.events[1].peak)),
        row("mean slip above 15 km, first event [m]", &|c| number(c.slip[0])),
        row("mean slip above 15 km, second event [m]", &|c| number(c.slip[1])),
        row("time above 1 mm/s, first event [s]", &|c| number(c.found.events[0].details.above)),
    ];
    ledger.table("Both runs", &["", "with inertia", "with damping"], rows);
}
