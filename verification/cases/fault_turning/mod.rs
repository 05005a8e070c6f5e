//! Vector slip on a fault in 3D: along a line, with rotated axes, and with a changing direction.

mod reference;
mod rows;
mod surface;

use crate::cases::cycle_run::CycleRun;
use crate::cases::seas;
use crate::{Capability, Case, CaseError, Evidence, Ledger};
use asperity_plan::faults::Plan;
use asperity_vary::SceneText;
use reference::{Fault, SlipEvent};

/// See the README.
pub const CASE: Case = Case {
    name: "fault_turning",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::Events, Capability::Determinism, Capability::Solid3d],
    quick: true,
    run,
};

const SCENE: &str = include_str!("scene.toml");
/// Rate at which each block is driven \[m/s\].
const HALF: f64 = 0.5e-9;
/// Tolerance of ln V of the scene.
const TOLERANCE: f64 = 1e-7;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    lines(ledger)?;
    turning(ledger)?;
    varied(ledger)?;
    rows::claims(ledger)?;
    surface::gaussian(ledger)
}

/// The scene with the blocks driven in this direction, (y, z), with vector slip or slip along the rake only.
fn scene(drawn: [f64; 2], rake: [f64; 2], free: bool, events: usize) -> Result<String, CaseError> {
    let [y, z] = drawn.map(|c| HALF * c);
    let rate = |value: f64| format!("{value:e}");
    let scene = SceneText::new(SCENE)
        .with("stages[0].conditions[0].y.rate", rate(-y))
        .with("stages[0].conditions[0].z.rate", rate(-z))
        .with("stages[0].conditions[1].y.rate", rate(y))
        .with("stages[0].conditions[1].z.rate", rate(z))
        .with_or_same("faults.main.rake", format!("[0, {:?}, {:?}]", rake[0], rake[1]))
        .with_or_same("events.stop_after", events);
    let scene = if free { scene } else { scene.without("faults.main.slip") };
    Ok(scene.text()?)
}

/// Largest relative difference.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
}

/// Blocks driven along the initial direction of slip.
fn lines(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (sine, cosine) = 30f64.to_radians().sin_cos();
    let (axis, turned) = ([0.0, 1.0], [sine, cosine]);
    let along = scene(axis, axis, false, 2)?;
    let held = CycleRun::new(&seas::plan(&along)?)?;
    for (name, direction) in [("along z", axis), ("at 30 degrees from z", turned)] {
        let turning = scene(direction, direction, true, 2)?;
        let plan = seas::plan(&turning)?;
        let free = CycleRun::new(&plan)?;
        let slip = &free.events()[1].details.slip;
        let [with, across] = [0, 1].map(|c| slip.component(c));
        let across = across.iter().fold(0.0_f64, |l, v| l.max(v.abs())) / with[0].abs();
        ledger
            .claim(format!("onsets of two events drawn {name}, slip free to turn, against slip held along z: largest relative difference"))
            .value(apart(&free.onsets(), &held.onsets()))
            .at_most(10.0 * TOLERANCE)
            .between(&turning, &along)
            .evidence(Evidence::Exact, "nothing drives slip across; rock is isotropic")
            .because("ten tolerances of ln V over a cycle of ln V ~ 10 e-folds; the error norm is a mean over more unknowns, so that steps differ")
            .why_not_tighter("tolerances of steps add up by chance; here most cancel")
            .covers(&[Capability::FaultCycles, Capability::Events])
            .cost(&free.cost)
            .record();
        ledger
            .claim(format!("slip across over slip along the load in an event drawn {name}"))
            .value(across)
            .at_most(1e-10)
            .evidence(Evidence::Exact, "nothing drives slip across")
            .because("rounding of the condensed operator and of the direction of the load, over some thousand steps")
            .why_not_tighter("rounding gathers over steps, whose number depends on the machine")
            .covers(&[Capability::FaultCycles])
            .cost(&free.cost)
            .record();
    }
    Ok(())
}

const INDEPENDENT: &str =
    "slip and state with V from |t| = f_n f + eta V by Newton's method, tolerance 1e-11";

/// Blocks driven at 60 degrees from the initial traction.
fn turning(ledger: &mut Ledger) -> Result<(), CaseError> {
    let plan = seas::plan(SCENE)?;
    let found = CycleRun::new(&plan)?;
    let expected = Fault::slider(&plan, 60f64.to_radians(), 2.0 * HALF).events(found.events().len())?;
    let onsets: Vec<f64> = expected.iter().map(|e| e.onset).collect();
    ledger
        .claim("onsets of five events while slip turns: largest relative difference")
        .value(apart(&found.onsets(), &onsets))
        .at_most(10.0 * TOLERANCE)
        .evidence(Evidence::SemiAnalytic, INDEPENDENT)
        .because("ten tolerances of ln V, of some 10 e-folds a cycle")
        .why_not_tighter("tolerances of steps add up by chance; here most cancel")
        .covers(&[Capability::FaultCycles, Capability::Events])
        .cost(&found.cost)
        .record();
    vectors(ledger, &plan, &found, &expected)?;
    balances(ledger, &plan, &found)
}

/// Claims the slip vectors of the events.
fn vectors(
    ledger: &mut Ledger,
    plan: &Plan,
    found: &CycleRun,
    expected: &[SlipEvent],
) -> Result<(), CaseError> {
    let area: f64 = plan.points.iter().map(|p| p.area).sum();
    let (mut slips, mut angles, mut rows) = (0.0_f64, 0.0_f64, Vec::new());
    for (k, (event, expected)) in found.events().iter().zip(expected).enumerate() {
        let size = expected.slip[0].hypot(expected.slip[1]);
        let angle = |x: f64, y: f64| y.atan2(x).to_degrees();
        let mean = |c: usize| {
            let parts = event.details.slip.component(c).iter().zip(&plan.points).map(|(s, p)| s * p.area);
            parts.sum::<f64>() / area
        };
        let slip = [mean(0), mean(1)];
        slips = slips.max((slip[0] - expected.slip[0]).hypot(slip[1] - expected.slip[1]) / size);
        let entry = &found.report.events[k];
        let turned = entry.turned.ok_or("the catalogue has no direction")?;
        angles = angles.max((turned - angle(expected.slip[0], expected.slip[1])).abs());
        rows.push([
            (k + 1).to_string(),
            format!("{:.4}", event.onset.seconds() / seas::YEAR),
            format!("{:.6}", entry.mean_slip),
            format!("{turned:.4}"),
            format!("{:.4}", angle(expected.slip[0], expected.slip[1])),
        ]);
    }
    ledger.table(
        "slip turns",
        &["event", "onset [yr]", "slip [m]", "turned [degrees]", "by the reference"],
        rows,
    );
    let by = |k: usize| found.report.events[k].turned.unwrap_or(f64::NAN);
    ledger
        .claim("angle by which slip of the fifth event is turned from that of the first")
        .value(by(4) - by(0))
        .unit("degrees")
        .at_least(5.0)
        .evidence(
            Evidence::Exact,
            "the traction gains a component across with each cycle: about 5 of 30 MPa at 60 degrees",
        )
        .because("a case in which slip does not turn would show nothing")
        .covers(&[Capability::FaultCycles])
        .cost(&found.cost)
        .record();
    for (name, value, bound, unit, because) in [
        (
            "mean slip vectors: largest difference over slip",
            slips,
            3e-5,
            "-",
            "three hundred tolerances: an event lies between times found in the dense output of steps, of lower order than the steps. The mean over \
             the points is taken, since what rounding makes differ between points grows with V over nine decades, to some 1e-4 of slip",
        ),
        (
            "direction in the catalogue: largest difference",
            angles,
            3e-4,
            "degrees",
            "a sixth of what the bound of slip vectors allows across slip: errors at the ends of an event lie along it",
        ),
    ] {
        ledger
            .claim(format!("five events while slip turns, {name}"))
            .value(value)
            .unit(unit)
            .at_most(bound)
            .evidence(Evidence::SemiAnalytic, INDEPENDENT)
            .because(because)
            .why_not_tighter(
                "tolerances of steps add up by chance, and the times of events fall anywhere within a step",
            )
            .covers(&[Capability::FaultCycles, Capability::Events])
            .cost(&found.cost)
            .record();
    }
    Ok(())
}

/// Claims energy, moment, and a run resumed from a restart.
fn balances(ledger: &mut Ledger, plan: &Plan, found: &CycleRun) -> Result<(), CaseError> {
    energy(ledger, "five events while slip turns", found);
    let last = found.report.events.last().ok_or("no event")?;
    let area: f64 = plan.points.iter().map(|p| p.area).sum();
    ledger
        .claim("moment of a uniform event over G times area times slip")
        .value(last.moment / (plan.points[0].shear_modulus * area * last.mean_slip))
        .equals(1.0)
        .absolute(1e-6)
        .evidence(Evidence::Exact, "all points slip by the same vector")
        .because("rounding makes points differ by some 1e-4 of slip where V grows by nine decades, which counts squared where vectors are added")
        .why_not_tighter("how far points part grows with the peak of V, by many orders")
        .covers(&[Capability::Events])
        .cost(&found.cost)
        .record();
    found.restarted(ledger, plan, TOLERANCE)
}

/// Time during which the fastest point is above the rate of onset.
fn above(ledger: &mut Ledger, found: &CycleRun, expected: &[SlipEvent]) {
    let times: Vec<f64> = found.events().iter().map(|e| e.details.above).collect();
    let exact: Vec<f64> = expected.iter().map(SlipEvent::above).collect();
    ledger
        .claim("two events where a varies and slip turns, time above the rate of onset")
        .unit("s")
        .values(&times)
        .equals_each(&exact)
        .relative(3e-6)
        .evidence(Evidence::Exact, "the reference passes the rate at the same times")
        .because("thirty tolerances: the rate is passed at times that lie in the dense output of steps")
        .why_not_tighter("errors of dense outputs are of lower order than those of steps")
        .cost(&found.cost)
        .record();
}

/// Number of events of the blocks with variable friction.
const VARIED: usize = 2;

/// The blocks with a growing along y, so that slip changes direction at different times at different points.
fn varied(ledger: &mut Ledger) -> Result<(), CaseError> {
    let scene = SceneText::new(SCENE)
        .with("bodies.left.mesh.block.divisions", "[1, 4, 1]")
        .with("bodies.right.mesh.block.divisions", "[1, 4, 1]")
        .add("faults.main.profiles", "{ a = { along = \"y\", points = [[0, 0.008], [1e3, 0.012]] } }")
        .with("events.stop_after", VARIED);
    let plan = seas::plan(&scene.text()?)?;
    let found = CycleRun::new(&plan)?;
    let a = |p: usize| 0.008 + 4e-6 * plan.points[p].at[1];
    let expected = Fault::from_plan(&plan, a).events(VARIED)?;
    let onsets: Vec<f64> = expected.iter().map(|e| e.onset).collect();
    let n = plan.points.len();
    let (mut slips, mut least, mut most) = (0.0_f64, f64::INFINITY, 0.0_f64);
    for (event, expected) in found.events().iter().zip(&expected) {
        let size = event.details.slip.all().iter().fold(0.0_f64, |l, v| l.max(v.abs()));
        for p in 0..n {
            let off = |c: usize| event.details.slip.component(c)[p] - expected.slip[c * n + p];
            slips = slips.max(off(0).hypot(off(1)) / size);
            let angle =
                event.details.slip.component(1)[p].atan2(event.details.slip.component(0)[p]).to_degrees();
            (least, most) = (least.min(angle), most.max(angle));
        }
    }
    ledger
        .claim("angles of slip from the rake over the points of two events where a varies: range")
        .value(most - least)
        .unit("degrees")
        .at_least(1.0)
        .evidence(Evidence::Exact, "friction turns slip where it is weaker first")
        .because("a case in which all points slip along one line would show nothing")
        .why_not_tighter("it tells slip that turns from slip that does not")
        .covers(&[Capability::FaultCycles])
        .cost(&found.cost)
        .record();
    above(ledger, &found, &expected);
    for (name, value, bound, because) in [
        (
            "onsets, largest relative difference",
            apart(&found.onsets(), &onsets),
            10.0 * TOLERANCE,
            "ten tolerances of ln V, of some 10 e-folds a cycle",
        ),
        (
            "slip vectors of all points, largest difference over the largest slip",
            slips,
            3e-5,
            "three hundred tolerances: as where friction is uniform",
        ),
    ] {
        ledger
            .claim(format!("two events where a varies and slip turns, {name}"))
            .value(value)
            .at_most(bound)
            .evidence(Evidence::SemiAnalytic, INDEPENDENT)
            .because(because)
            .why_not_tighter(
                "tolerances of steps add up by chance, and the times of events fall anywhere within a step",
            )
            .covers(&[Capability::FaultCycles, Capability::Events])
            .cost(&found.cost)
            .record();
    }
    energy(ledger, "two events where a varies and slip turns", &found);
    Ok(())
}

/// Claims the energy balance.
fn energy(ledger: &mut Ledger, name: &str, found: &CycleRun) {
    ledger
        .claim(format!("imbalance of energy over its largest part, {name}"))
        .value(found.report.energy.imbalance)
        .at_most(TOLERANCE)
        .evidence(Evidence::Exact, "work of loads on slip = elastic energy + work of friction + radiated energy, as products of vectors")
        .because("one tolerance of ln V: it moves friction by a/f of it in a step, and steps add up like a random walk")
        .why_not_tighter("imbalances of steps have both signs")
        .covers(&[Capability::FaultCycles])
        .cost(&found.cost)
        .record();
}
