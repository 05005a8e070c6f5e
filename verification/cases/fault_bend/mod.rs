//! A fault with a restraining bend: tractions caused by slip across it, and events that stop there.

use crate::cases::dislocation::{self, Stress};
use crate::cases::seas;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity_cycles::Rupture;
use asperity_plan::faults::Plan;
use asperity_run::Event;
use asperity_vary::SceneText;
use nalgebra::Complex;

/// See the README.
pub const CASE: Case = Case {
    name: "fault_bend",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::PlaneStrain, Capability::Events],
    quick: true,
    run,
};

const SCENE: &str = include_str!("../../../scenes/fault-bend.toml");
/// Distance of the bend along the fault, and length of the fault \[m\].
pub(crate) const BEND: f64 = 15e3;
const LENGTH: f64 = 30e3;
/// Rotation of the lower half \[rad\].
const TURN: f64 = std::f64::consts::FRAC_PI_6;
const SHEAR_MODULUS: f64 = 80.0953008e9 / 2.5;
const POISSON: f64 = 0.25;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    statics(ledger)?;
    events(ledger)
}

/// The scene with cells of this size \[m\].
fn bent(size: f64) -> SceneText {
    SceneText::new(SCENE).with_or_same("bodies.plate.mesh.fault.spacing", format!("{size} m"))
}

/// The same scene without the bend, under the stress of the upper half.
fn straight(size: f64) -> SceneText {
    bent(size)
        .with("bodies.plate.mesh.fault.trace[2]", "[\"0 km\", \"-15 km\"]")
        .with("faults.main.profiles.normal.points[1][1]", "50e6")
        .with("faults.main.profiles.shear.points[1][1]", "26e6")
}

/// The same scene in a box ten times as large, for comparison with the infinite plane; the cells differ only away from the fault.
fn far(size: f64) -> Result<Plan, CaseError> {
    let scene = bent(size)
        .with("bodies.plate.mesh.fault.min", "[\"-1000 km\", \"-1000 km\"]")
        .with("bodies.plate.mesh.fault.max", "[\"1000 km\", \"1000 km\"]");
    seas::plan(&scene.text()?)
}

/// Slip across the bend \[m\] against distance along the fault \[m\].
fn slip(along: f64) -> f64 {
    (1.0 - ((along - BEND) / 10e3).powi(2)).max(0.0).powi(3)
}

/// Unit tangent, pointing up, of the half of the fault at this distance.
fn tangent(along: f64) -> [f64; 2] {
    if along < BEND { [0.0, 1.0] } else { [TURN.sin(), TURN.cos()] }
}

/// Position at this distance, relative to the bend.
fn place(along: f64) -> Complex<f64> {
    let [x, y] = tangent(along);
    Complex::new(x, y) * (BEND - along)
}

/// Length of the pieces of the reference \[m\].
const PIECE: f64 = 25.0;

/// Shear and normal tractions at `at` due to [`slip`], from pieces of constant slip with dislocations at their ends.
fn tractions(at: f64) -> (f64, f64) {
    // The point `at` is the midpoint of a piece, half a piece away from the dislocations at its ends. A piece ends at the bend.
    let mut ends: Vec<f64> = (0..=(LENGTH / PIECE) as usize + 1)
        .map(|k| (k as f64 - 0.5) * PIECE + at % PIECE)
        .filter(|&s| (BEND - s).abs() > 0.01 * PIECE)
        .collect();
    ends.push(BEND);
    ends.sort_by(f64::total_cmp);
    let mut stress = Stress::default();
    let z = place(at);
    for w in ends.windows(2) {
        let middle = 0.5 * (w[0] + w[1]);
        let [x, y] = tangent(middle);
        // A circuit about the upper end leads from plus to minus; one about the lower end leads back.
        let b = Complex::new(x, y) * slip(middle);
        // The ends lie on the same half of the fault as their piece; the bend lies on both halves.
        let on = |s: f64| Complex::new(x, y) * (BEND - s);
        dislocation::add_in_plane(&mut stress, z, on(w[0]), -b, SHEAR_MODULUS, POISSON);
        dislocation::add_in_plane(&mut stress, z, on(w[1]), b, SHEAR_MODULUS, POISSON);
    }
    let t = tangent(at);
    stress.on(t, [t[1], -t[0]])
}

/// Distance from the bend within which tractions are not compared \[m\]: they grow as 1/r.
const NEAR: f64 = 2000.0;

/// Tractions due to [`slip`] along the fault.
pub(crate) struct Tractions {
    /// Distances along the fault \[m\].
    pub along: Vec<f64>,
    /// Shear tractions \[Pa\].
    pub shear: Vec<f64>,
    /// Normal tractions, compression positive \[Pa\].
    pub normal: Vec<f64>,
}

/// Tractions due to [`slip`] on cells of this size \[m\], in a box large enough for its boundary to have little effect.
pub(crate) fn statics_of(size: f64) -> Result<Tractions, CaseError> {
    far(size).map(|plan| found(&plan))
}

fn found(plan: &Plan) -> Tractions {
    let along: Vec<f64> = plan.points.iter().map(|p| p.along).collect();
    let values: Vec<f64> = along.iter().map(|&s| slip(s)).collect();
    let shear = plan.problem.fault.operator.shear_of(&values);
    let normal = plan.problem.fault.operator.normal_of(&values);
    Tractions { along, shear, normal }
}

/// Largest errors of shear and normal tractions over the largest shear traction, away from the bend.
fn errors(t: &Tractions) -> [f64; 2] {
    let (mut worst, mut scale) = ([0.0_f64; 2], 0.0_f64);
    for (k, &s) in t.along.iter().enumerate().filter(|(_, s)| (*s - BEND).abs() > NEAR) {
        let (shear, normal) = tractions(s);
        scale = scale.max(shear.abs());
        worst = [worst[0].max((t.shear[k] - shear).abs()), worst[1].max((t.normal[k] - normal).abs())];
    }
    worst.map(|w| w / scale)
}

const REFERENCE: &str =
    "edge dislocations in the plane by complex potentials, pieces of 25 m along both halves";

fn statics(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut levels = [Vec::new(), Vec::new()];
    let mut last = None;
    for size in [1000.0, 500.0, 250.0] {
        let (result, cost) = Cost::measure(|| statics_of(size));
        let tractions = result?;
        for (levels, error) in levels.iter_mut().zip(errors(&tractions)) {
            levels.push((size, error));
        }
        last = Some((tractions, cost));
    }
    let (tractions, cost) = last.ok_or("no level")?;
    for (kind, levels) in ["shear", "normal"].into_iter().zip(&levels) {
        ledger
            .order(format!("{kind} tractions of slip across the bend, farther than 2 km from it"))
            .norm("largest error over the largest shear traction")
            .levels(levels)
            .expected(1.0)
            .within(0.25)
            .or_better()
            .evidence(Evidence::SemiAnalytic, REFERENCE)
            .because("the point of the bend slides along the mean of both directions, which turns slip within a cell on either side: a dipole of the length of a cell. All else is of second order")
            .finest(5e-3, "turn times cell over 2 pi times the distance, 0.52 250 m/(2 pi 2 km) = 1 %, of which the dipole has a part, its stress falling off as 1/r^2")
            .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
            .cost(&cost)
            .record();
    }
    signs(ledger, &tractions, &cost)
}

/// Claims the signs of normal traction on both sides of the bend, where the dislocation at the bend dominates.
fn signs(ledger: &mut Ledger, t: &Tractions, cost: &Cost) -> Result<(), CaseError> {
    let at = |s: f64| {
        let k = (0..t.along.len()).min_by(|&i, &j| (t.along[i] - s).abs().total_cmp(&(t.along[j] - s).abs()));
        k.map(|k| (t.normal[k], tractions(t.along[k]).1)).ok_or("no points")
    };
    let (above, below) = (at(BEND - NEAR)?, at(BEND + NEAR)?);
    ledger
        .claim("normal tractions of 1 m of slip 2 km above and below the bend")
        .unit("MPa")
        .values(&[above.0 / 1e6, below.0 / 1e6])
        .equals_each(&[above.1 / 1e6, below.1 / 1e6])
        .relative(0.01)
        .evidence(Evidence::SemiAnalytic, REFERENCE)
        .because("(250 m/2 km)^2 = 1.6 %, of which the smeared dislocation leaves a part")
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
        .cost(cost)
        .record();
    ledger.table(
        "normal tractions of 1 m of slip across the bend",
        &["distance from the bend [m]", "here [MPa]", "dislocations [MPa]"],
        t.along.iter().zip(&t.normal).filter(|(s, _)| (*s - BEND).abs() < 6e3).step_by(4).map(|(s, f)| {
            [format!("{:.0}", s - BEND), format!("{:.4}", f / 1e6), format!("{:.4}", tractions(*s).1 / 1e6)]
        }),
    );
    Ok(())
}

/// Mean slip of an event on the part of the fault from `from` to `to` \[m\].
fn mean(plan: &Plan, event: &Event<Rupture>, from: f64, to: f64) -> f64 {
    let part = plan
        .points
        .iter()
        .zip(event.details.slip.component(0))
        .filter(|(p, _)| p.along >= from && p.along <= to);
    let (slip, area) = part.fold((0.0, 0.0), |(s, a), (p, slip)| (s + p.area * slip, a + p.area));
    slip / area
}

fn events(ledger: &mut Ledger) -> Result<(), CaseError> {
    let plan = seas::plan(&bent(250.0).text()?)?;
    let mut normal = Vec::new();
    let run = seas::found(&plan, &plan.problem.settings, |now| {
        normal = (0..plan.points.len()).map(|p| now.normal(p)).collect();
    })?;
    let straight = seas::plan(&straight(250.0).text()?)?;
    let beside = seas::found(&straight, &straight.problem.settings, |_| {})?;
    // The central part of each half, without the tips and the cells at the bend.
    let (upper, lower) = ([4e3, 13e3], [17e3, 26e3]);
    let ratio = |plan: &Plan, e: &Event<Rupture>| {
        mean(plan, e, lower[0], lower[1]) / mean(plan, e, upper[0], upper[1])
    };
    let largest = run.events.iter().map(|e| ratio(&plan, e)).fold(0.0, f64::max);
    let least = beside.events.iter().map(|e| ratio(&straight, e)).fold(f64::INFINITY, f64::min);
    ledger.table(
        "events",
        &[
            "fault",
            "onset [yr]",
            "mean slip of the upper half [m]",
            "of the lower half [m]",
            "hypocentre [km]",
        ],
        [("bent", &plan, &run), ("straight", &straight, &beside)].into_iter().flat_map(
            |(name, plan, found)| {
                found.events.iter().zip(&found.onsets).map(move |(e, t)| {
                    [
                        name.to_string(),
                        format!("{t:.2}"),
                        format!("{:.3}", mean(plan, e, upper[0], upper[1])),
                        format!("{:.3}", mean(plan, e, lower[0], lower[1])),
                        format!("{:.1}", plan.points[e.details.hypocentre].along / 1e3),
                    ]
                })
            },
        ),
    );
    ledger
        .claim("slip of the lower half over that of the upper half, largest of the events of the bent fault")
        .norm("means over 9 km of each half, 2 km from the bend")
        .value(largest)
        .at_most(0.05)
        .evidence(Evidence::Exact, "motion of the sides shears the lower half by cos(60) = 0.5 and presses it by sin(60) = 0.87 of the shear stress, of which 0.6 is strength: it is never loaded")
        .because("what enters beyond 2 km is the end of a crack, which friction there does not drive")
        .why_not_tighter("that the lower half does not slip at all is a matter of how far the crack enters")
        .covers(&[Capability::FaultCycles, Capability::Events])
        .cost(&run.cost)
        .record();
    ledger
        .claim("the same on the straight fault, least of the events")
        .value(least)
        .at_least(0.5)
        .evidence(Evidence::Exact, "both halves of a straight fault are alike")
        .because("an event that stopped half way would leave less")
        .covers(&[Capability::FaultCycles, Capability::Events])
        .cost(&beside.cost)
        .record();
    clamped(ledger, &plan, &normal, &run.cost);
    Ok(())
}

/// Mean over the points from `from` to `to` \[m\].
fn average(plan: &Plan, values: &[f64], from: f64, to: f64) -> f64 {
    let part = plan.points.iter().zip(values).filter(|(p, _)| p.along >= from && p.along <= to);
    let (sum, area) = part.fold((0.0, 0.0), |(s, a), (p, v)| (s + p.area * v, a + p.area));
    sum / area
}

/// Claims that the motion of the sides compresses the lower half and that it remains compressed at the end of the run.
fn clamped(ledger: &mut Ledger, plan: &Plan, normal: &[f64], cost: &Cost) {
    let (shear, pressing) = plan.problem.loading.rates(1.0, plan.points.len(), true);
    ledger
        .claim("rate of normal traction of the lower half over that of shear traction of the upper one, by the motion of the sides")
        .value(average(plan, &pressing, 16e3, 29e3) / average(plan, &shear, 1e3, 14e3))
        .equals((2.0 * TURN).sin())
        .relative(0.05)
        .evidence(Evidence::Exact, "a plate in uniform shear: sin 2 beta")
        .because("the sides are 200 km apart; stress varies over that length, to second order, by (30/200)^2 = 2 %")
        .why_not_tighter("it is an estimate of the next order, whose factor is not known")
        .covers(&[Capability::PlaneStrain])
        .cost(cost)
        .record();
    let start = average(plan, &plan.problem.fault.normal, 17e3, 26e3);
    ledger
        .claim("normal traction of the lower half at the end over that at the start")
        .value(average(plan, normal, 17e3, 26e3) / start)
        .at_least(1.01)
        .evidence(Evidence::Exact, "the sign: a restraining bend is pressed together")
        .because("sin(60) of the stress that the motion of the sides has built up, some MPa of 73 MPa")
        .covers(&[Capability::PlaneStrain])
        .cost(cost)
        .record();
}
