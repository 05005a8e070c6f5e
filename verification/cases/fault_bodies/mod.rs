//! Several faults, several materials, curved faults.

mod backslip;
mod flat;
mod positions;
mod section;
mod unlike;

use crate::cases::fault_operator::matrix;
use crate::cases::{body_plots, dislocation, seas};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_plan::faults::Plan;
use asperity_vary::SceneText;
use dislocation::Stress;
use nalgebra::{Complex, DMatrix, DVector};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};
use std::fmt::Write as _;

/// See the README.
pub const CASE: Case = Case {
    name: "fault_bodies",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::Antiplane, Capability::PlaneStrain],
    quick: true,
    run,
};

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    interface(ledger)?;
    parallel(ledger)?;
    pairs(ledger)?;
    arc(ledger)?;
    arc_in_space(ledger)?;
    flat::run(ledger)?;
    unlike::run(ledger)?;
    backslip::run(ledger)?;
    section::run(ledger)?;
    positions::run(ledger)
}

/// Friction of faults of which only the operator is used.
const LAW: &str = r#"law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.02, b = 0.015, l = "8 mm", v_ref = "1 um/s", v_initial = "1e-9 m/s" }
normal = "50 MPa"
rate = "1e-9 m/s""#;

/// A scene from its materials, bodies, faults and boundary conditions.
fn scene(kinematics: &str, parts: &str, conditions: &str) -> String {
    format!(
        "schema = 1\ntitle = \"faults of bodies\"\nkinematics = \"{kinematics}\"\n{parts}\n[[stages]]\nname = \"still\"\nduration = \"1 yr\"\n\
         conditions = [{conditions}]\n[time]\nstepper = \"fault-ode\"\n"
    )
}

/// A material with this shear modulus \[Pa\] and nu = 0.25.
fn material(name: &str, shear_modulus: f64) -> String {
    format!("[materials.{name}]\nyoung = {}\npoisson = 0.25\ndensity = 2700\n", 2.5 * shear_modulus)
}

/// Half length of the crack \[m\].
const A: f64 = 1000.0;
/// Half size of the box \[m\]: its supports change slip by a fraction of about the square of A over it.
const WIDE: f64 = 100.0 * A;

/// A crack on the interface between a left and a right medium of these shear moduli \[Pa\].
fn joined(left: f64, right: f64) -> Result<Plan, CaseError> {
    let tip = A / 500.0;
    let across = format!("[[{}, {}], [0, {tip}], [{WIDE}, {}]]", -WIDE, WIDE / 4.0, WIDE / 4.0);
    let up = format!(
        "[[{}, {}], [{}, {tip}], [0, {}], [{A}, {tip}], [{WIDE}, {}]]",
        -WIDE,
        WIDE / 4.0,
        -A,
        A / 10.0,
        WIDE / 4.0
    );
    seas::plan(&halves([left, right], (&across, &up), ("antiplane", "z = 0"), ""))
}

/// Scene of slip over twice A between a left and a right medium of these shear moduli \[Pa\], whose far sides are held. Cells have
/// these sizes across and along the interface; `rest` are further keys of the fault.
fn halves(
    moduli: [f64; 2],
    (across, up): (&str, &str),
    (kinematics, held): (&str, &str),
    rest: &str,
) -> String {
    let mut parts = material("soft", moduli[0]) + &material("stiff", moduli[1]);
    for (name, material, from, to) in [("L", "soft", -WIDE, 0.0), ("R", "stiff", 0.0, WIDE)] {
        let _ = write!(
            parts,
            "[bodies.{name}]\nmaterial = \"{material}\"\nmesh.block = {{ min = [{from}, {}], max = [{to}, {WIDE}], spacing = [{across}, {up}], element = \"quad9\" }}\n",
            -WIDE
        );
    }
    let _ = write!(
        parts,
        "[faults.main]\nminus = \"L.right\"\nplus = \"R.left\"\n{LAW}\n{rest}damping = \"radiation\"\ncreep = {{ outside = {{ y = {{ from = {}, to = {A} }} }}, rate = 0.0 }}\n",
        -A
    );
    let sides = format!("{{ set = \"L.left\", {held} }}, {{ set = \"R.right\", {held} }}");
    scene(kinematics, &parts, &sides)
}

/// Shear moduli of the two media \[Pa\]; their harmonic mean is 16 GPa.
const MODULI: [f64; 2] = [10e9, 40e9];
const MEAN: f64 = 16e9;

/// A crack between two media.
fn interface(ledger: &mut Ledger) -> Result<(), CaseError> {
    let ((mixed, even), cost) = Cost::measure(|| (joined(MODULI[0], MODULI[1]), joined(MEAN, MEAN)));
    let (mixed, even) = (mixed?, even?);
    let (s, mean) = (matrix(&mixed, false), matrix(&even, false));
    ledger
        .claim("crack between media of 10 and 40 GPa: operator against that of a medium of 16 GPa, largest difference over largest entry")
        .value((&s - &mean).amax() / mean.amax())
        .at_most(1e-11)
        .evidence(Evidence::Exact, "on mirrored meshes half-spaces act in series: 1/(1/G1 + 1/G2) of one stiffness")
        .because("rounding of two factorisations of 1e5 unknowns whose cells differ 1e4 times in size")
        .why_not_tighter("rounding depends on the order of elimination; another modulus changes the operator by a part in ten")
        .covers(&[Capability::FaultCycles, Capability::Antiplane])
        .cost(&cost)
        .record();
    let n = mixed.points.len();
    let slip = s.lu().solve(&DVector::repeat(n, -1.0)).ok_or("the operator is singular")?;
    let exact = |y: f64| 2.0 / MEAN * (A * A - y * y).max(0.0).sqrt();
    let middle = (0..n)
        .min_by(|&i, &j| mixed.points[i].at[1].abs().total_cmp(&mixed.points[j].at[1].abs()))
        .ok_or("no points")?;
    let y = mixed.points[middle].at[1];
    ledger
        .claim("crack between media of 10 and 40 GPa: slip in the middle, relative error")
        .value((slip[middle] / exact(y) - 1.0).abs())
        .at_most(0.002)
        .evidence(Evidence::Exact, "2 dtau/G sqrt(a^2 - y^2) with G = 2 G1 G2/(G1 + G2)")
        .because("as in the case fault_operator: cells of a/500 at the tips, and a/10 with their lumped interface mass; the box adds (1/100)^2")
        .covers(&[Capability::FaultCycles, Capability::Antiplane])
        .cost(&cost)
        .record();
    let z = MODULI.map(|g| (g * 2700.0_f64).sqrt());
    let eta = z[0] * z[1] / (z[0] + z[1]);
    let off = mixed.problem.fault.damping.iter().map(|d| (d / eta - 1.0).abs()).fold(0.0, f64::max);
    ledger
        .claim("radiation damping between media of 10 and 40 GPa, relative error")
        .value(off)
        .at_most(1e-14)
        .evidence(
            Evidence::Exact,
            "Z1 Z2/(Z1 + Z2), from the velocities -dtau/Z1 and dtau/Z2 of waves to both sides",
        )
        .because("rounding")
        .why_not_tighter("two roundings of numbers near one are 2e-16, and each term may add one")
        .covers(&[Capability::FaultCycles])
        .cost(&cost)
        .record();
    Ok(())
}

/// Distance between the parallel faults \[m\].
const APART: f64 = 10e3;
/// Depth to which they slip \[m\].
const DEEP: f64 = 20e3;
/// Shear modulus around them \[Pa\].
const ROCK: f64 = 32e9;

/// Slip \[m\] at a depth \[m\].
fn bump(depth: f64) -> f64 {
    (1.0 - ((depth - 10e3) / 8e3).powi(2)).max(0.0).powi(3)
}

/// Traction at a distance from the slipping fault and a depth \[m\], from screw dislocations and their images above the surface.
fn screws(distance: f64, depth: f64, slip: fn(f64) -> f64) -> f64 {
    const PIECE: f64 = 20.0;
    let shift = depth - PIECE * ((depth / PIECE).floor() + 0.5);
    let end = |at: f64| (depth - at) / ((depth - at).powi(2) + distance * distance);
    let image = |at: f64| -(depth + at) / ((depth + at).powi(2) + distance * distance);
    let mut sum = 0.0;
    for k in 0..(DEEP / PIECE).ceil() as usize {
        let (top, bottom) = (k as f64 * PIECE + shift, (k as f64 + 1.0) * PIECE + shift);
        let s = slip(0.5 * (top + bottom));
        sum += s * (end(bottom) - end(top) + image(bottom) - image(top));
    }
    ROCK / TAU * sum
}

/// Three blocks with two faults between them; cells of this size \[m\] at the faults.
fn slabs(size: f64) -> Result<Plan, CaseError> {
    let far = 1e6;
    let mut parts = material("rock", ROCK);
    let up = format!("[[{}, {}], [{}, {size}], [0, {size}]]", -far, far / 5.0, -1.5 * DEEP);
    let blocks = [("A", -far, 0.0), ("B", 0.0, APART), ("C", APART, far + APART)];
    for (name, from, to) in blocks {
        let across = format!(
            "[[{}, {}], [{}, {size}], [{}, {size}], [{}, {}]]",
            -far,
            far / 5.0,
            -0.5 * APART,
            1.5 * APART,
            far + APART,
            far / 5.0
        );
        let _ = write!(
            parts,
            "[bodies.{name}]\nmaterial = \"rock\"\nmesh.block = {{ min = [{from}, {}], max = [{to}, 0], spacing = [{across}, {up}], element = \"quad9\" }}\n",
            -far
        );
    }
    for (name, minus, plus) in [("first", "A", "B"), ("second", "B", "C")] {
        let _ = write!(
            parts,
            "[faults.{name}]\nminus = \"{minus}.right\"\nplus = \"{plus}.left\"\n{LAW}\ncreep = {{ outside = {{ y = {{ from = {} }} }}, rate = 0.0 }}\n",
            -DEEP
        );
    }
    seas::plan(&scene("antiplane", &parts, r#"{ set = "A.left", z = 0 }, { set = "C.right", z = 0 }"#))
}

/// Largest errors of tractions on the slipping fault and on the other, each over the largest traction there.
fn interaction(plan: &Plan) -> [f64; 2] {
    let n = plan.points.len();
    let (own, other) = (plan.faults[0].points.clone(), plan.faults[1].points.clone());
    let mut slip = vec![0.0; n];
    for p in own.clone() {
        slip[p] = bump(-plan.points[p].at[1]);
    }
    let shear = plan.problem.fault.operator.shear_of(&slip);
    [(own, 0.0), (other, APART)].map(|(points, distance)| {
        let exact: Vec<f64> = points.clone().map(|p| screws(distance, -plan.points[p].at[1], bump)).collect();
        let largest = exact.iter().fold(0.0_f64, |m, t| m.max(t.abs()));
        points.zip(&exact).map(|(p, t)| (shear[p] - t).abs()).fold(0.0, f64::max) / largest
    })
}

/// Two interacting faults below a free surface.
fn parallel(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut levels = [Vec::new(), Vec::new()];
    let mut last = None;
    for size in [2000.0, 1000.0, 500.0] {
        let (plan, cost) = Cost::measure(|| slabs(size));
        for (list, error) in levels.iter_mut().zip(interaction(&plan?)) {
            list.push((size, error));
        }
        last = Some(cost);
    }
    let cost = last.ok_or("no level")?;
    for ((name, bound), levels) in
        [("the fault that slips", 4e-3), ("a parallel fault 10 km away", 4e-3)].into_iter().zip(&levels)
    {
        ledger
            .order(format!(
                "tractions on {name}, two faults below a free surface, largest error over the largest there"
            ))
            .levels(levels)
            .expected(2.0)
            .within(0.3)
            .or_better()
            .evidence(Evidence::SemiAnalytic, "screw dislocations and their images in pieces of 20 m")
            .because("lumped interface mass: tractions are averages over the cells around a node")
            .finest(bound, "(500 m/8 km)^2 = 0.4 % for slip of that scale")
            .covers(&[Capability::FaultCycles, Capability::Antiplane])
            .cost(&cost)
            .record();
    }
    Ok(())
}

/// A pair of blocks: name, characteristic slip \[m\], damping, half width \[m\].
type Pair = (&'static str, f64, &'static str, f64);

/// Both rest on stiffnesses G/2H of half the critical one.
const PAIRS: [Pair; 2] = [("P", 0.008, "\"radiation\"", 1000.0), ("Q", 0.013, "\"20 MPa s/m\"", 1600.0)];

/// Pairs of blocks, driven past each other.
fn blocks(pairs: &[Pair], events: usize) -> Result<Plan, CaseError> {
    let (mut parts, mut sides) = (material("rock", ROCK), String::new());
    for (k, (name, _, damping, half)) in pairs.iter().enumerate() {
        let foot = -1e5 * (1.0 + k as f64);
        for (side, from, to) in [("l", -half, 0.0), ("r", 0.0, *half)] {
            let _ = write!(
                parts,
                "[bodies.{name}{side}]\nmaterial = \"rock\"\nmesh.block = {{ min = [{from}, {foot}], max = [{to}, {}], divisions = [1, 1], element = \"quad4\" }}\n",
                foot + 1000.0
            );
        }
        let _ = write!(
            parts,
            "[faults.{name}]\nminus = \"{name}l.right\"\nplus = \"{name}r.left\"\n{LAW}\ndamping = {damping}\nunder_resolved = \"allow\"\n"
        );
        let _ = write!(
            sides,
            "{{ set = \"{name}l.left\", z = {{ rate = -0.5e-9 }} }}, {{ set = \"{name}r.right\", z = {{ rate = 0.5e-9 }} }},"
        );
    }
    let mut scene = SceneText::new(&scene("antiplane", &parts, &sides))
        .with("stages[0].duration", "3000 yr")
        .add("time.log_rate_tolerance", "1e-7")
        .add("events", format!("{{ above = \"1e-4 m/s\", stop_after = {events} }}"));
    for (name, l, ..) in pairs {
        scene = scene
            .with(&format!("faults.{name}.law.a"), 0.01)
            .with(&format!("faults.{name}.law.l"), l)
            .with(&format!("faults.{name}.rate"), "1.1e-9 m/s");
    }
    seas::plan(&scene.text()?)
}

/// Onset \[yr\], largest slip rate \[m/s\] and slip \[m\] of the first events of a fault.
fn first_event(plan: &Plan, fault: &str) -> Result<([f64; 3], Cost), CaseError> {
    let found = seas::found(plan, &plan.problem.settings, |_| {})?;
    let points = plan.faults.iter().find(|f| f.name == fault).map(|f| f.points.clone()).ok_or("no fault")?;
    let k = found
        .events
        .iter()
        .position(|e| points.contains(&e.details.hypocentre))
        .ok_or("no event on the fault")?;
    let event = &found.events[k];
    Ok(([found.onsets[k], event.peak, event.details.slip.component(0)[points.start]], found.cost))
}

/// Claims that pairs of blocks in one scene behave as they do alone.
fn pairs(ledger: &mut Ledger) -> Result<(), CaseError> {
    let both = blocks(&PAIRS, 4)?;
    for pair in PAIRS {
        let (together, cost) = first_event(&both, pair.0)?;
        let (alone, _) = first_event(&blocks(&[pair], 1)?, pair.0)?;
        let off = |k: usize| (together[k] / alone[k] - 1.0).abs();
        let what = [("onset", 1e-6), ("largest slip rate", 1e-3), ("slip", 1e-6)];
        for (k, (name, bound)) in what.into_iter().enumerate() {
            ledger
                .claim(format!("pair {} beside another one: {name} of the first event against that of the pair alone, relative difference", pair.0))
                .value(off(k))
                .at_most(bound)
                .evidence(Evidence::Exact, "no elastic way leads from one pair to the other")
                .because("steps are shared: onsets have errors of the tolerance 1e-7 of ln V gathered over a cycle, slip rates are seen at the ends of steps")
                .why_not_tighter("the steps of a run belong to both pairs, those of a pair alone do not")
                .covers(&[Capability::FaultCycles, Capability::Events])
                .cost(&cost)
                .record();
        }
    }
    Ok(())
}

/// Radius of the arc \[m\].
const RADIUS: f64 = 20e3;
/// Poisson's ratio around it.
const POISSON: f64 = 0.25;

/// Slip \[m\] at a distance along the arc \[m\].
fn on_arc(along: f64) -> f64 {
    (1.0 - ((along - 8e3) / 6e3).powi(2)).max(0.0).powi(3)
}

/// Distance of the box sides from the arc \[m\].
const FAR: f64 = 1e6;

/// A fault along an arc, vertical at the surface and of dip 45 degrees at its lower end, of `cells` straight cells, in plane
/// strain. Its trace has a vertex at every corner of a cell, or `segments` segments with smooth curves between vertices.
fn curved(cells: usize, segments: Option<usize>) -> Result<Plan, CaseError> {
    let sides = r#"{ set = "crust.left", x = 0, y = 0 }, { set = "crust.right", x = 0, y = 0 }"#;
    let parts = match segments {
        None => arc_parts(cells, "", ""),
        Some(segments) => arc_between(cells, (segments, "spline"), "", ""),
    };
    bent("plane-strain", &parts, sides)
}

/// The scene of the arc.
fn bent(kinematics: &str, parts: &str, conditions: &str) -> Result<Plan, CaseError> {
    seas::plan(&scene(kinematics, parts, conditions))
}

/// Body and fault of the arc, with more keys of each.
fn arc_parts(cells: usize, body: &str, fault: &str) -> String {
    arc_between(cells, (cells, "polyline"), body, fault)
}

/// Body and fault of the arc, with the number of segments of its trace and their interpolation.
fn arc_between(cells: usize, (segments, interpolation): (usize, &str), body: &str, fault: &str) -> String {
    let angle = |k: usize| FRAC_PI_4 * k as f64 / segments as f64;
    let vertex = |k: usize| {
        let (s, c) = angle(k).sin_cos();
        format!("[{}, {}]", RADIUS * (1.0 - c), -RADIUS * s)
    };
    let trace: Vec<String> = (0..=segments).map(vertex).collect();
    // `size` is the largest cell size: a curve that is longer than the arc by its interpolation error must not get an additional
    // cell.
    let size = if segments == cells { 1.0 } else { 1.01 } * RADIUS * FRAC_PI_4 / cells as f64;
    format!(
        "{}[bodies.crust]\nmaterial = \"rock\"\nmesh.fault = {{ trace = [{}], interpolation = \"{interpolation}\", spacing = [[0, {size}]], min = [{}, {}], max = [{FAR}, 0], growth = 1.25, element = \"quad9\" }}\n{body}\n\
         [faults.main]\nminus = \"crust.fault.minus\"\nplus = \"crust.fault.plus\"\n{LAW}\n{fault}\n",
        material("rock", ROCK),
        trace.join(", "),
        -FAR,
        -FAR
    )
}

/// Shear and normal tractions caused by slip on the arc, at an angle along it.
fn arc_tractions(angle: f64) -> (f64, f64) {
    // Pieces 20 m long, one of them centred at the point.
    let piece = 20.0 / RADIUS;
    let place = |psi: f64| Complex::new(RADIUS * (1.0 - psi.cos()), -RADIUS * psi.sin());
    let down = |psi: f64| Complex::new(psi.sin(), -psi.cos());
    let shift = angle - piece * ((angle / piece).floor() + 0.5);
    let mut stress = Stress::default();
    let z = place(angle);
    for k in 0..(FRAC_PI_4 / piece).ceil() as usize {
        let (top, bottom) = (k as f64 * piece + shift, (k as f64 + 1.0) * piece + shift);
        let middle = 0.5 * (top + bottom);
        // The plus side, above the fault, slides up-dip; a circuit about the upper end leads from plus to minus.
        let b = down(middle) * on_arc(middle * RADIUS);
        if top > 0.0 {
            dislocation::add(&mut stress, z, place(top), b, ROCK, POISSON);
            dislocation::add(&mut stress, z, place(bottom), -b, ROCK, POISSON);
        }
    }
    let (s, c) = (FRAC_PI_2 - angle).sin_cos();
    let (n, t) = ([s, c], [-c, s]);
    let on = [stress.xx * n[0] + stress.xy * n[1], stress.xy * n[0] + stress.yy * n[1]];
    (t[0] * on[0] + t[1] * on[1], -(n[0] * on[0] + n[1] * on[1]))
}

/// Largest errors of shear and normal tractions over the largest shear traction.
fn arc_errors(plan: &Plan) -> [f64; 2] {
    let n = plan.points.len();
    let angle = |p: usize| (-plan.points[p].at[1]).atan2(RADIUS - plan.points[p].at[0]);
    let slip: Vec<f64> = (0..n).map(|p| on_arc(angle(p) * RADIUS)).collect();
    let shear = plan.problem.fault.operator.shear_of(&slip);
    let normal = plan.problem.fault.operator.normal_of(&slip);
    let (mut worst, mut scale) = ([0.0_f64; 2], 0.0_f64);
    // At the surface and at the tip tractions are averages over half a length.
    for p in (0..n).filter(|&p| angle(p) * RADIUS > 1e3 && angle(p) * RADIUS < 15e3) {
        let (t, f) = arc_tractions(angle(p));
        scale = scale.max(t.abs());
        worst = [worst[0].max((shear[p] - t).abs()), worst[1].max((normal[p] - f).abs())];
    }
    worst.map(|w| w / scale)
}

/// Draws the tractions on the arc on those of dislocations.
fn overlay(ledger: &mut Ledger, plan: &Plan) {
    let n = plan.points.len();
    let angle = |p: usize| (-plan.points[p].at[1]).atan2(RADIUS - plan.points[p].at[0]);
    let slip: Vec<f64> = (0..n).map(|p| on_arc(angle(p) * RADIUS)).collect();
    let shear = plan.problem.fault.operator.shear_of(&slip);
    let normal = plan.problem.fault.operator.normal_of(&slip);
    let inside = |p: &usize| angle(*p) * RADIUS > 1e3 && angle(*p) * RADIUS < 15e3;
    let at = |value: &dyn Fn(usize) -> f64| -> Vec<(f64, f64)> {
        (0..n).filter(inside).map(|p| (angle(p).to_degrees(), value(p) / 1e6)).collect()
    };
    ledger.plot(
        Plot::xy("Tractions of slip on the arc", "angle from the surface [degrees]", "traction [MPa]")
            .series(Series::line("shear, dislocations", &at(&|p| arc_tractions(angle(p)).0)))
            .series(Series::points("shear, this code", &body_plots::apart(&at(&|p| shear[p]))))
            .series(Series::line("normal, dislocations", &at(&|p| arc_tractions(angle(p)).1)))
            .series(Series::points("normal, this code", &body_plots::apart(&at(&|p| normal[p])))),
    );
}

/// Number of segments of a trace with few vertices; each is 3.9 km long, a fifth of the radius.
const FEW: usize = 4;

/// An arc below a free surface against dislocations, with a trace through all cell corners or through few vertices.
fn arc(ledger: &mut Ledger) -> Result<(), CaseError> {
    arc_of(ledger, None, "")?;
    arc_of(ledger, Some(FEW), " that is known at five places")
}

fn arc_of(ledger: &mut Ledger, segments: Option<usize>, which: &str) -> Result<(), CaseError> {
    let mut levels = [Vec::new(), Vec::new()];
    let mut last = None;
    for cells in [16, 32, 64] {
        let (plan, cost) = Cost::measure(|| curved(cells, segments));
        let (plan, size) = (plan?, RADIUS * FRAC_PI_4 / cells as f64);
        if cells == 64 && segments.is_none() {
            overlay(ledger, &plan);
        }
        for (list, error) in levels.iter_mut().zip(arc_errors(&plan)) {
            list.push((size, error));
        }
        last = Some(cost);
    }
    let cost = last.ok_or("no level")?;
    let of_shear = "lumped interface mass and straight cells";
    let of_normal =
        "straight cells: at their corners slip along the mean direction opens against each of them by s h/2R";
    let kinds = [("shear", 2.0, of_shear), ("normal", 1.0, of_normal)];
    for ((kind, order, because), levels) in kinds.into_iter().zip(&levels) {
        ledger
            .order(format!("{kind} tractions of slip on an arc{which} from dip 90 to dip 45, largest error over the largest shear traction"))
            .levels(levels)
            .expected(order)
            .within(0.3)
            .or_better()
            .evidence(Evidence::SemiAnalytic, "edge dislocations below a free surface by complex potentials, in pieces of 20 m along the arc")
            .because(because)
            .finest(4e-3, "2 (245 m/6 km)^2 = 0.35 % for slip of that scale")
            .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
            .cost(&cost)
            .record();
    }
    Ok(())
}

/// Number of cells of the arc extruded through a slab.
const DRAWN: usize = 8;

/// The arc extruded through a 3D slab, one layer of cells thick and constrained to plane motion, against the plane model.
fn arc_in_space(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (kinematics, rake, faces, held) in [
        ("plane-strain", "[0, 1, 0]", "z = 0", "x = 0, y = 0"),
        ("antiplane", "[0, 0, 1]", "x = 0, y = 0", "z = 0"),
    ] {
        let on = |sides: &[&str], what: &str| {
            sides.iter().map(|s| format!("{{ set = \"crust.{s}\", {what} }}, ")).collect::<String>()
        };
        let far = ["left", "right"];
        let plane = bent(kinematics, &arc_parts(DRAWN, "", ""), &on(&far, held))?;
        let parts = arc_parts(DRAWN, "extrude = [0, 1e3]", &format!("rake = {rake}"));
        let conditions = on(&far, "x = 0, y = 0, z = 0") + &on(&["back", "front"], faces);
        let (solid, cost) = Cost::measure(|| bent("3d", &parts, &conditions));
        drawn(ledger, "on an arc drawn", kinematics, (&plane, &solid?), &cost)?;
    }
    Ok(())
}

/// Claims tractions of uniform slip across the slab against those of the plane model.
fn drawn(
    ledger: &mut Ledger,
    which: &str,
    kinematics: &str,
    (plane, solid): (&Plan, &Plan),
    cost: &Cost,
) -> Result<(), CaseError> {
    let near =
        |p: usize, q: usize| (0..2).all(|c| (plane.points[p].at[c] - solid.points[q].at[c]).abs() < 1e-3);
    let across =
        DMatrix::from_fn(solid.points.len(), plane.points.len(), |q, p| f64::from(u8::from(near(p, q))));
    // Without matching points both sides of the comparison would be zero.
    if across.row_iter().any(|row| row.sum() != 1.0) {
        return Err("a point of the slab has no partner in the plane".into());
    }
    let largest = matrix(plane, false).amax();
    let kinds: &[bool] = if kinematics == "antiplane" { &[false] } else { &[false, true] };
    for &normal in kinds {
        let error = matrix(solid, normal) * &across - &across * matrix(plane, normal);
        ledger
            .claim(format!(
                "{} tractions of slip {which} through a slab that moves in {kinematics}, against the plane, over the largest",
                if normal { "normal" } else { "shear" }
            ))
            .value(error.amax() / largest)
            .at_most(1e-11)
            .evidence(Evidence::Exact, "displacements of the plane, uniform across the slab, lie in its finite-element space")
            .because("rounding")
            .why_not_tighter("two roundings of numbers near one are 2e-16, and each term may add one")
            .covers(&[Capability::FaultCycles])
            .cost(cost)
            .record();
    }
    Ok(())
}
