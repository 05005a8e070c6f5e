//! Stresses and motion at positions in bodies around a vertical fault below a free surface: by slip alone, and through time.

use super::{LAW, ROCK, bump, material, scene};
use crate::cases::dislocation::{self, Stress};
use crate::cases::seas;
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_cycles::Moment;
use asperity_plan::faults::Plan;
use nalgebra::Complex;
use std::f64::consts::{FRAC_PI_3, TAU};
use std::fmt::Write as _;

/// Depth to which the fault slips \[m\].
const DEEP: f64 = 20e3;
/// Half size of the bodies \[m\]: stresses at their sides are those of a double couple, about (DEEP/FAR)² of those near the fault.
const FAR: f64 = 1e6;
/// Length of the dislocations of the reference \[m\].
const PIECE: f64 = 20.0;
/// Effective friction coefficient of the planes on which stress is resolved.
const FRICTION: f64 = 0.4;
/// Poisson's ratio of [`material`].
const POISSON: f64 = 0.25;

/// Claims stresses and motion.
pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    stresses(ledger)?;
    displacements(ledger)?;
    through_time(ledger)
}

/// Positions of receivers \[m\].
const PLACES: [[f64; 2]; 6] =
    [[2.7e3, 0.0], [0.3e3, -9.1e3], [-2.7e3, -7.3e3], [5.1e3, -11.0e3], [-14.2e3, 0.0], [1.3e3, -23.7e3]];

/// Two blocks with a fault between them, whose sides move past each other at this rate \[m/s\], with cells of this size at the
/// fault \[m\].
fn halves(kinematics: &str, size: f64, rate: f64, output: &str) -> Result<Plan, CaseError> {
    let mut parts = material("rock", ROCK);
    let up = format!("[[{}, {}], [{}, {size}], [0, {size}]]", -FAR, FAR / 5.0, -1.5 * DEEP);
    let near = 0.8 * DEEP;
    for (name, [from, to], across) in [
        ("L", [-FAR, 0.0], format!("[[{}, {}], [{}, {size}], [0, {size}]]", -FAR, FAR / 5.0, -near)),
        ("R", [0.0, FAR], format!("[[0, {size}], [{near}, {size}], [{FAR}, {}]]", FAR / 5.0)),
    ] {
        let _ = write!(
            parts,
            "[bodies.{name}]\nmaterial = \"rock\"\nmesh.block = {{ min = [{from}, {}], max = [{to}, 0], spacing = [{across}, {up}], element = \"quad9\" }}\n",
            -FAR
        );
    }
    let _ = write!(
        parts,
        "[faults.main]\nminus = \"L.right\"\nplus = \"R.left\"\n{LAW}\ncreep = {{ outside = {{ y = {{ from = {} }} }}, rate = {rate:e} }}\n[output]\n{output}\n",
        -DEEP
    );
    let moved = |half: f64| match kinematics {
        "antiplane" => format!("z = {{ rate = {half:e} }}"),
        _ => format!("x = 0, y = {{ rate = {half:e} }}"),
    };
    let sides = format!(
        "{{ set = \"L.left\", {} }}, {{ set = \"R.right\", {} }}",
        moved(-0.5 * rate),
        moved(0.5 * rate)
    );
    seas::plan(&scene(kinematics, &parts, &sides))
}

/// Outputs of all receivers.
fn receivers() -> String {
    PLACES.iter().enumerate().map(|(k, at)| format!("receivers.r{k} = {at:?}\n")).collect()
}

/// Slip \[m\] of all points by their depths.
fn slips(plan: &Plan) -> Vec<f64> {
    plan.points.iter().map(|p| bump(-p.at[1])).collect()
}

/// Middles of the dislocations of the reference, as depths \[m\].
fn pieces() -> impl Iterator<Item = f64> {
    (0..(DEEP / PIECE) as usize).map(|k| (k as f64 + 0.5) * PIECE)
}

/// Stress at a position by dip slip of the reference \[Pa\]: the right side moves up.
fn dip_slip([x, y]: [f64; 2]) -> Stress {
    let (mut sum, at) = (Stress::default(), Complex::new(x, y));
    for depth in pieces() {
        // An anticlockwise circuit of the upper end crosses the cell from left to right.
        let b = Complex::new(0.0, -bump(depth));
        for (end, b) in [(depth - 0.5 * PIECE, b), (depth + 0.5 * PIECE, -b)] {
            if end > 0.0 {
                dislocation::add(&mut sum, at, Complex::new(0.0, -end), b, ROCK, POISSON);
            }
        }
    }
    sum
}

/// Changes of Coulomb stress in the cells beside a fault in plane strain.
fn stresses(ledger: &mut Ledger) -> Result<(), CaseError> {
    let output = format!("coulomb = {{ friction = {FRICTION:?}, dip = \"120 deg\", rake = \"-90 deg\" }}");
    let (sine, cosine) = FRAC_PI_3.sin_cos();
    // Planes that fall to the left by 60 degrees, whose upper side moves down.
    let (normal, down) = ([-sine, cosine], [-cosine, -sine]);
    let (mut levels, mut last) = ([Vec::new(), Vec::new()], None);
    for size in [2000.0, 1000.0, 500.0] {
        let (plan, cost) = Cost::measure(|| halves("plane-strain", size, 0.0, &output));
        let plan = plan?;
        let (view, stresses) = plan.bodies.as_ref().zip(plan.stresses.as_ref()).ok_or("no stresses")?;
        let (mut worst, mut largest) = ([0.0_f64; 2], [0.0_f64; 2]);
        for (at, (_, change)) in view.middles().iter().zip(stresses.at(view, &slips(&plan))) {
            if !(2e3..12e3).contains(&at[0].abs()) || at[1] < -DEEP {
                continue;
            }
            let (shear, pressed) = dip_slip([at[0], at[1]]).on(down, normal);
            let pairs = [(change.normal, pressed), (change.coulomb, shear - FRICTION * pressed)];
            for (k, (found, wanted)) in pairs.into_iter().enumerate() {
                worst[k] = worst[k].max((found - wanted).abs());
                largest[k] = largest[k].max(wanted.abs());
            }
        }
        for (k, list) in levels.iter_mut().enumerate() {
            list.push((size, worst[k] / largest[k]));
        }
        last = Some(cost);
    }
    let cost = last.ok_or("no level")?;
    for (name, levels) in ["normal traction", "Coulomb stress"].into_iter().zip(&levels) {
        ledger
            .order(format!(
                "change of {name} in cells 2 to 12 km beside a fault that slips, largest error over the largest"
            ))
            .levels(levels)
            .expected(2.0)
            .within(0.5)
            .or_better()
            .evidence(Evidence::SemiAnalytic, "edge dislocations below a free surface in pieces of 20 m")
            .because("means over cells instead of values in their middles, and lumped interface mass")
            .finest(1e-2, "(500 m/8 km)^2 = 0.4 % of slip of that scale, for the interface and for the cells")
            .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
            .cost(&cost)
            .record();
    }
    Ok(())
}

/// Displacement at a position by strike slip of the reference \[m\].
fn strike_slip([x, y]: [f64; 2]) -> f64 {
    let down_to = |d: f64| ((y + d) / x).atan() - ((y - d) / x).atan();
    pieces().map(|d| bump(d) / TAU * (down_to(d + 0.5 * PIECE) - down_to(d - 0.5 * PIECE))).sum()
}

/// Displacements of receivers in antiplane motion.
fn displacements(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (mut levels, mut last) = (Vec::new(), None);
    for size in [2000.0, 1000.0, 500.0] {
        let (plan, cost) = Cost::measure(|| halves("antiplane", size, 0.0, &receivers()));
        let plan = plan?;
        let slips = slips(&plan);
        let errors = plan.receivers.all.iter().zip(PLACES).map(|(receiver, at)| {
            let [_, _, found] = receiver.caused(slips.iter().copied());
            (found - strike_slip(at)).abs()
        });
        let worst = errors.fold(0.0, f64::max);
        levels.push((size, if plan.receivers.all.len() == PLACES.len() { worst } else { f64::NAN }));
        last = Some(cost);
    }
    ledger
        .order("displacement of receivers in two bodies by slip of one metre at most, largest error")
        .unit("m")
        .levels(&levels)
        .expected(2.0)
        .within(0.5)
        .or_better()
        .evidence(Evidence::SemiAnalytic, "screw dislocations and their images in pieces of 20 m")
        .because("displacements of quadratic cells, with slip that is linear between the points")
        .finest(4e-3, "(500 m/8 km)^2 = 0.4 % of the slip")
        .why_not_tighter("cells are quadratic, and the estimate is that of linear ones")
        .covers(&[Capability::FaultCycles, Capability::Antiplane])
        .cost(&last.ok_or("no level")?)
        .record();
    Ok(())
}

/// Largest differences of displacement and velocity of receivers from those of the whole bodies at a moment, each over the
/// largest of a receiver.
fn apart(plan: &Plan, nodes: &[usize], now: &Moment<'_>) -> Result<[f64; 2], CaseError> {
    let view = plan.bodies.as_ref().ok_or("the bodies are not kept")?;
    let time = now.at.seconds();
    // All loads grow in proportion to time, so that the displacement that a second adds is the velocity.
    let whole = [view.bodies.vectors(now.slip().all(), time), view.bodies.vectors(now.rate.all(), 1.0)];
    let (mut worst, mut largest) = ([0.0_f64; 2], [0.0_f64; 2]);
    for (receiver, &node) in plan.receivers.all.iter().zip(nodes) {
        for (k, found) in receiver.moves(&plan.receivers.rates, now).into_iter().enumerate() {
            for (found, wanted) in found.into_iter().zip(whole[k][node]) {
                worst[k] = worst[k].max((found - wanted).abs());
                largest[k] = largest[k].max(wanted.abs());
            }
        }
    }
    Ok([0, 1].map(|k| if largest[k] > 0.0 { worst[k] / largest[k] } else { worst[k] }))
}

/// Motion of receivers while the sides move, against that of all nodes.
fn through_time(ledger: &mut Ledger) -> Result<(), CaseError> {
    for kinematics in ["antiplane", "plane-strain"] {
        let corners = [[2e3, 0.0], [-4e3, -8e3], [-FAR, 0.0], [6e3, -20e3]];
        let places: String =
            corners.iter().enumerate().map(|(k, at)| format!("receivers.r{k} = {at:?}\n")).collect();
        let plan = halves(kinematics, 2000.0, 1e-9, &format!("bodies = true\n{places}"))?;
        let view = plan.bodies.as_ref().ok_or("the bodies are not kept")?;
        let far = |n: &usize, at: &[f64; 2]| (view.nodes[*n][0] - at[0]).hypot(view.nodes[*n][1] - at[1]);
        let node = |at: &[f64; 2]| (0..view.nodes.len()).min_by(|a, b| far(a, at).total_cmp(&far(b, at)));
        let nodes: Vec<usize> = corners.iter().filter_map(node).collect();
        let (mut worst, mut failed) = ([0.0_f64; 2], nodes.len() != corners.len());
        let found = seas::found(&plan, &plan.problem.settings, |now| match apart(&plan, &nodes, now) {
            Ok(differences) => worst = [0, 1].map(|k| worst[k].max(differences[k])),
            Err(_) => failed = true,
        })?;
        for (name, value) in ["displacement", "velocity"].into_iter().zip(worst) {
            ledger
                .claim(format!(
                    "{name} of receivers at nodes while sides move, {kinematics}: difference from the recovered bodies over the largest"
                ))
                .value(if failed { f64::NAN } else { value })
                .at_most(1e-9)
                .evidence(Evidence::Exact, "reciprocity: weights of slip are the forces by which a unit load holds it")
                .because("rounding of two solves, in bodies whose cells differ a hundred times in size")
                .why_not_tighter("rounding depends on the order of elimination")
                .covers(&[Capability::FaultCycles])
                .cost(&found.cost)
                .record();
        }
    }
    Ok(())
}
