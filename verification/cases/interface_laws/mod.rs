//! Friction laws of interfaces on a column whose points are sliders on springs, with known tractions and slip.

mod radiating;
mod reversing;
mod varying;

use super::texts::{self, BodyRun};
use crate::cases::body_plots;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "interface_laws",
    readme: include_str!("README.md"),
    covers: &[Capability::Coulomb, Capability::LawFamily, Capability::Implicit, Capability::StaticExplicit],
    quick: true,
    run,
};

const SCENE: &str = include_str!("scene.toml");
const CORNERS: &str = include_str!("corners.toml");
const SPACE: &str = include_str!("../interface_rate_state/scene-3d.toml");
/// E_n times the penetration \[Pa\].
const NORMAL: f64 = 10e6;
/// Compliance of the column, whose shear modulus is 2 E/5 with ν = 1/4, and of the tangential penalty \[m/Pa\].
const COMPLIANCE: f64 = 0.2 / (10e9 / 2.5) + 1.0 / 1000e9;
/// Width of the column \[m\].
const WIDTH: f64 = 0.1;
/// Time at which the column is pressed and free to slide \[s\].
const PRESSED: f64 = 2.0;
/// Combinations of stepper and contact measure.
const RUNS: [(&str, &str); 4] = [
    ("implicit", "node-to-point"),
    ("implicit", "mortar"),
    ("static-explicit", "node-to-point"),
    ("static-explicit", "mortar"),
];

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    coulomb(ledger)?;
    slip_weakening(ledger)?;
    static_kinetic(ledger)?;
    capped_rate(ledger)?;
    capped_states(ledger)?;
    turning(ledger)?;
    reversing::run(ledger)?;
    radiating::run(ledger)?;
    varying::run(ledger)
}

/// A vertex of a loading path; load, tractions and slip vary linearly in time between vertices.
#[derive(Clone, Copy, Debug)]
struct Vertex {
    /// Displacement of the top \[m\].
    load: f64,
    /// Normal traction \[Pa\].
    normal: f64,
    /// Shear traction \[Pa\].
    traction: f64,
}

impl Vertex {
    /// Pressed, at rest.
    const START: Self = Self { load: 0.0, normal: NORMAL, traction: 0.0 };

    /// Vertex of this slip and traction under the initial normal traction; the load follows from the spring.
    fn new(slip: f64, traction: f64) -> Self {
        Self { load: slip + traction * COMPLIANCE, normal: NORMAL, traction }
    }

    fn slip(&self) -> f64 {
        self.load - self.traction * COMPLIANCE
    }
}

/// Vertices with the end times of their stages; the top moves at 1 um/s, or slower in stages of the minimum duration of 10 s.
fn timed(course: &[Vertex]) -> Vec<(f64, Vertex)> {
    let (mut time, mut last, mut all) = (PRESSED, Vertex::START, vec![(PRESSED, Vertex::START)]);
    for vertex in course {
        time += ((vertex.load - last.load).abs() / 1e-6).max(10.0);
        last = *vertex;
        all.push((time, last));
    }
    all
}

/// The scene with a stage for each vertex.
fn scene(law: &str, course: &[Vertex], (stepper, measure): (&str, &str)) -> Result<String, CaseError> {
    let mut scene = SceneText::new(SCENE)
        .add("interfaces.fault.law", law)
        .add("interfaces.fault.measure", measure)
        .add("time.stepper", stepper);
    let timed = timed(course);
    for (i, pair) in timed.windows(2).enumerate() {
        let duration = pair[1].0 - pair[0].0;
        let vertex = pair[1].1;
        let y = format!("{{ to = {:?} }}", -vertex.normal / 1000e9);
        scene = scene.push(
            "stages",
            format!(
                "{{ name = \"{i}\", duration = {duration:?}, conditions = [{{ set = \"column.top\", x = {{ to = {:?} }}, y = {y} }}, \
                 {{ set = \"column.left\", y = {y} }}, {{ set = \"column.right\", y = {y} }}, {{ set = \"column.bottom\", x = \"free\", y = {y} }}] }}",
                vertex.load
            ),
        );
    }
    Ok(scene.text()?)
}

/// Largest errors of normal traction and shear traction over the largest normal traction, and of the traction of the spring that
/// corresponds to the slip.
fn errors(done: &BodyRun, course: &[Vertex]) -> [f64; 3] {
    let timed = timed(course);
    let mut errors = [0.0_f64; 3];
    for (k, &time) in done.record.times().iter().enumerate().filter(|(_, t)| **t > PRESSED) {
        let at = timed.windows(2).find(|w| time <= w[1].0 * (1.0 + 1e-12)).map(|w| {
            let share = (time - w[0].0) / (w[1].0 - w[0].0);
            let mean = |of: &dyn Fn(&Vertex) -> f64| of(&w[0].1) + share * (of(&w[1].1) - of(&w[0].1));
            [mean(&|v| v.normal), mean(&|v| v.traction), mean(&|v| v.slip()) / COMPLIANCE]
        });
        for point in &done.record.histories()[0].points {
            // Components along the motion, opposite to the tangent of the master below.
            let found = [point.normal_traction[k], -point.shear_traction[k], -point.slip[k] / COMPLIANCE];
            for (error, (found, wanted)) in
                errors.iter_mut().zip(found.iter().zip(at.unwrap_or([f64::NAN; 3])))
            {
                *error =
                    error.max(if wanted.is_nan() { f64::INFINITY } else { (found - wanted).abs() / NORMAL });
            }
        }
    }
    errors
}

/// Claims tractions and slip along a loading path with both steppers and measures.
fn follows(
    ledger: &mut Ledger,
    title: &str,
    law: &str,
    course: &[Vertex],
    formula: &str,
) -> Result<Vec<BodyRun>, CaseError> {
    let mut all = Vec::new();
    let mut largest = Vec::new();
    for run in RUNS {
        let done = texts::simulate(&scene(law, course, run)?)?;
        largest.extend(errors(&done, course));
        if law.contains("coulomb") && all.is_empty() {
            ledger.picture(
                title,
                body_plots::recorded(&done.record, "")?,
                "Mises stress after the first stage.",
            );
        }
        all.push(done);
    }
    ledger
        .claim(format!(
            "{title}: normal traction, shear traction and slip of every point at every step, by both steppers and measures, error over f_n"
        ))
        .values(&largest)
        .equals_each(&[0.0; 12])
        .absolute(1e-12)
        .evidence(Evidence::Exact, formula)
        .because("between its kinks, which are ends of stages, everything is linear in time: solving leaves 1e-13 of displacements and tractions")
        .why_not_tighter("how much solving leaves is known by its order only")
        .covers(&[Capability::Implicit, Capability::StaticExplicit, Capability::Stages])
        .cost(&all[0].cost)
        .record();
    Ok(all)
}

/// Coulomb friction under a normal traction that grows while it slides, with a cap.
fn coulomb(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (mu, cap) = (0.6, 4e6);
    let at = |load: f64, normal: f64, traction: f64| Vertex { load, normal, traction };
    let course = [
        // The cap of 4 MPa is below mu f_n of 6 MPa.
        at(cap * COMPLIANCE, NORMAL, cap),
        at(cap * COMPLIANCE + 100e-6, NORMAL, cap),
        // mu f_n falls below the cap, and further to 3 MPa.
        at(cap * COMPLIANCE + 150e-6, cap / mu, cap),
        at(cap * COMPLIANCE + 200e-6, 5e6, 3e6),
        // Stick while it is pressed again, then slide back.
        at(cap * COMPLIANCE + 200e-6, NORMAL, 3e6),
        at(cap * COMPLIANCE + 200e-6 - (3e6 + cap) * COMPLIANCE, NORMAL, -cap),
        at(0.0, NORMAL, -cap),
    ];
    let law = format!("{{ kind = \"coulomb\", mu = {mu}, f_limit = {cap} }}");
    follows(
        ledger,
        "Coulomb friction with a cap",
        &law,
        &course,
        "min(mu f_n, F_limit) where it slides; k = 1/(h/G + 1/E_t)",
    )?;
    Ok(())
}

const MU_S: f64 = 0.6;
const MU_K: f64 = 0.3;
/// d_c \[m\].
const D_C: f64 = 400e-6;

/// Slip weakening, without and with a cap.
fn slip_weakening(ledger: &mut Ledger) -> Result<(), CaseError> {
    let strength = |path: f64| NORMAL * (MU_S - (MU_S - MU_K) * (path / D_C).min(1.0));
    let law = |more: &str| {
        format!("{{ kind = \"slip-weakening\", mu_s = {MU_S}, mu_k = {MU_K}, d_c = {D_C:e}{more} }}")
    };
    // Half of d_c forwards and half backwards, further slip at the residual strength, and forwards again.
    let half = 0.5 * D_C;
    let course = [
        Vertex::new(0.0, strength(0.0)),
        Vertex::new(half, strength(half)),
        Vertex::new(half, -strength(half)),
        Vertex::new(0.0, -strength(D_C)),
        Vertex::new(-100e-6, -strength(D_C)),
        Vertex::new(-100e-6, strength(D_C)),
        Vertex::new(0.0, strength(D_C)),
    ];
    let formula =
        "mu_s - (mu_s - mu_k) min(path/d_c, 1) over the path of slip, forwards and backwards; k (u - slip)";
    let runs = follows(ledger, "slip weakening", &law(""), &course, formula)?;
    let energies = runs.iter().map(|done| fracture(done)).collect::<Result<Vec<_>, _>>()?;
    let energy = 0.5 * (MU_S - MU_K) * NORMAL * D_C;
    ledger
        .claim("slip weakening: work of friction beyond the residual strength, over (mu_s - mu_k) f_n d_c/2, by both steppers and measures")
        .values(&energies.iter().map(|e| e / energy).collect::<Vec<_>>())
        .equals_each(&[1.0; 4])
        .relative(1e-12)
        .evidence(Evidence::Exact, "G_c = (tau_p - tau_r) d_c/2 (Ida 1972; Andrews 1976)")
        .because("as the tractions; the trapezoidal rule is exact where both are linear")
        .why_not_tighter("as the tractions")
        .covers(&[Capability::Implicit, Capability::StaticExplicit])
        .cost(&runs[0].cost)
        .record();
    let cap = 5e6;
    // Slip at which the strength has fallen to the cap.
    let leaves = D_C * (MU_S - cap / NORMAL) / (MU_S - MU_K);
    let course = [
        Vertex::new(0.0, cap),
        Vertex::new(leaves, cap),
        Vertex::new(D_C, strength(D_C)),
        Vertex::new(1.5 * D_C, strength(D_C)),
    ];
    follows(ledger, "slip weakening with a cap", &law(&format!(", f_limit = {cap}")), &course, formula)?;
    Ok(())
}

/// Frictional work above the residual strength per area \[J/m²\].
fn fracture(done: &BodyRun) -> Result<f64, CaseError> {
    let work: f64 = done.dissipated().iter().sum();
    let path: f64 = done.record.histories()[0].points[0].slip.windows(2).map(|s| (s[1] - s[0]).abs()).sum();
    Ok(work / WIDTH - MU_K * NORMAL * path)
}

/// E_t of the corners \[Pa/m\].
const CORNER: f64 = 100e9;

/// Static-kinetic friction of two corners that begin to slip at different times.
fn static_kinetic(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (mu_s, mu_k) = (0.6, 0.4);
    for (title, cap) in
        [("static-kinetic friction", f64::INFINITY), ("static-kinetic friction with a cap", 5e6)]
    {
        let more = if cap.is_finite() { format!(", f_limit = {cap}") } else { String::new() };
        let law = format!("{{ kind = \"static-kinetic\", mu_s = {mu_s}, mu_k = {mu_k}{more} }}");
        let (rest, slide) = ((mu_s * NORMAL).min(cap), (mu_k * NORMAL).min(cap));
        let (mut wrong, mut peaks) = (Vec::new(), Vec::new());
        let mut cost: Option<Cost> = None;
        for (stepper, measure) in RUNS {
            let scene = SceneText::new(CORNERS)
                .add("interfaces.fault.law", &law)
                .add("interfaces.fault.measure", measure)
                .add("time.stepper", stepper);
            let done = texts::simulate(&scene.text()?)?;
            wrong.push(corners(&done, rest, slide));
            if stepper == "static-explicit" {
                let each = done.record.histories()[0].points.iter();
                peaks.extend(each.map(|p| p.shear_traction.iter().map(|t| t.abs()).fold(0.0, f64::max)));
            }
            cost.get_or_insert(done.cost);
        }
        ledger
            .claim(format!("{title}: shear traction of two points at every step, by both steppers and measures, error over f_n"))
            .values(&wrong)
            .equals_each(&[0.0; 4])
            .absolute(1e-12)
            .evidence(Evidence::Exact, "E_t times the motion up to mu_s f_n, then mu_k f_n; again so after rest, and backwards")
            .because("motions are prescribed: rounding is left")
            .why_not_tighter("positions of 0.1 m and motions of 100 um lose three digits")
            .covers(&[Capability::Implicit, Capability::StaticExplicit])
            .cost(&cost.ok_or("nothing was run")?)
            .record();
        ledger
            .claim(format!("{title}: largest shear traction of two points, static-explicit, both measures"))
            .unit("Pa")
            .values(&peaks)
            .equals_each(&[rest; 4])
            .relative(1e-12)
            .evidence(Evidence::Exact, "the strength at rest, at which a step ends")
            .because("motions are prescribed: rounding is left")
            .why_not_tighter("positions of 0.1 m and motions of 100 um lose three digits")
            .covers(&[Capability::StaticExplicit])
            .record();
    }
    Ok(())
}

/// End times of the stages that move the corners \[s\], and the positions of the left corner at these times \[m\].
const LEGS: [(f64, f64); 5] = [(1.0, 0.0), (101.0, 200e-6), (111.0, 200e-6), (211.0, 300e-6), (311.0, 0.0)];

/// Largest error of a corner's traction over f_n.
fn corners(done: &BodyRun, rest: f64, slide: f64) -> f64 {
    let mut largest = 0.0_f64;
    for point in &done.record.histories()[0].points {
        let reach = if point.position[0] < 0.5 * WIDTH { 1.0 } else { 0.5 };
        for (k, &time) in done.record.times().iter().enumerate().filter(|(_, t)| **t > LEGS[0].0) {
            let found = -point.shear_traction[k];
            let [before, after] = corner(time, reach, rest, slide);
            largest = largest.max((found - before).abs().min((found - after).abs()) / NORMAL);
        }
    }
    largest
}

/// Traction of a corner that moves `reach` times as far as the left one, before and after a possible drop at that instant.
fn corner(time: f64, reach: f64, rest: f64, slide: f64) -> [f64; 2] {
    let mut traction = 0.0;
    for leg in LEGS.windows(2) {
        let [(begin, from), (end, to)] = [leg[0], leg[1]];
        let share = ((time - begin) / (end - begin)).min(1.0);
        let way = f64::signum(to - from);
        // Elastic from its traction at rest up to the static strength; beyond it slides.
        let trial: f64 = traction + CORNER * reach * share * (to - from);
        let (reached, passed) = (way * trial >= rest * (1.0 - EDGE), way * trial > rest * (1.0 + EDGE));
        let [before, after] =
            [if passed { way * slide } else { trial }, if reached { way * slide } else { trial }];
        if time <= end {
            return [before, after];
        }
        traction = after;
    }
    [f64::NAN; 2]
}

/// Relative distance to the strength within which rounding decides whether a point slides.
const EDGE: f64 = 1e-12;

/// Displacement and rate of the top in each stage \[m, m/s\]: from a slack spring, faster, and slower again.
const DRAGGED: [(f64, f64); 3] = [(600e-6, SLOW), (600e-6, FAST), (300e-6, SLOW)];
const SLOW: f64 = 1e-6;
const FAST: f64 = 100e-6;
/// Parameters of rate-dependent laws; Vref is the slow rate. L in \[m\].
const MU0: f64 = 0.6;
const A: f64 = 0.01;
const B: f64 = 0.015;
const LENGTH: f64 = 1e-5;

/// Start times of the dragging stages, and the end time \[s\].
fn begins() -> Vec<f64> {
    let mut begins = vec![PRESSED];
    for (way, rate) in DRAGGED {
        begins.push(begins[begins.len() - 1] + way / rate);
    }
    begins
}

/// Runs the column dragged under a rate-dependent law.
fn dragged(law: &str, (stepper, measure): (&str, &str)) -> Result<BodyRun, CaseError> {
    let mut scene = SceneText::new(SCENE)
        .add("interfaces.fault.law", law)
        .add("interfaces.fault.measure", measure)
        .add("interfaces.fault.under_resolved", "allow")
        .add("time.stepper", stepper);
    for (i, (way, rate)) in DRAGGED.iter().enumerate() {
        let conditions = format!(
            "{{ set = \"column.top\", x = {{ rate = {rate:e} }}, y = \"hold\" }}, {{ set = \"column.left\", y = \"hold\" }}, \
             {{ set = \"column.right\", y = \"hold\" }}, {{ set = \"column.bottom\", x = \"free\", y = \"hold\" }}"
        );
        scene = scene.push(
            "stages",
            format!("{{ name = \"{i}\", duration = {:?}, conditions = [{conditions}] }}", way / rate),
        );
    }
    texts::simulate(&scene.text()?)
}

/// A record of a point while it is dragged.
struct Row {
    /// Stage, and time since its start \[s\].
    stage: usize,
    since: f64,
    /// Shear traction along the motion \[Pa\].
    traction: f64,
    /// Slip rate along the motion \[m/s\].
    rate: f64,
    /// True in the first step of a stage.
    first: bool,
    /// True at the end of a stage.
    last: bool,
}

fn rows(done: &BodyRun) -> Vec<Row> {
    let (begins, times) = (begins(), done.record.times());
    let mut rows = Vec::new();
    for point in &done.record.histories()[0].points {
        for (k, &time) in times.iter().enumerate() {
            let stage = begins.windows(2).position(|w| time > w[0] && time <= w[1] * (1.0 + EDGE));
            rows.extend(stage.map(|stage| Row {
                stage,
                since: time - begins[stage],
                traction: -point.shear_traction[k],
                rate: -point.slip_rate[k],
                first: k == 0 || times[k - 1] <= begins[stage] * (1.0 + EDGE),
                last: time >= begins[stage + 1] * (1.0 - EDGE),
            }));
        }
    }
    rows
}

/// Results of a law with both steppers and measures.
struct CapResults {
    /// Shear tractions at the ends of the stages over f_n.
    ends: Vec<f64>,
    /// Largest errors while the cap is active: of traction over the cap, and of the slip rate over the load rate.
    errors: [Vec<f64>; 2],
    /// Number of records with an active cap.
    held: usize,
    /// Number of records that exceed the cap.
    wrong: u64,
    cost: Cost,
}

fn capped(law: &str, cap: f64, holds: impl Fn(&Row) -> Option<bool>) -> Result<CapResults, CaseError> {
    let (mut ends, mut errors, mut held, mut wrong) = (Vec::new(), [Vec::new(), Vec::new()], 0, 0);
    let mut cost = None;
    for run in RUNS {
        let done = dragged(law, run)?;
        let mut largest = [0.0_f64; 2];
        for row in rows(&done) {
            if row.last {
                ends.push(row.traction / NORMAL);
            }
            match holds(&row) {
                Some(true) => {
                    held += 1;
                    largest[0] = largest[0].max((row.traction / cap - 1.0).abs());
                    // A difference over two steps smears the jump of the rate over the first step of a stage.
                    if !row.first {
                        largest[1] = largest[1].max((row.rate / DRAGGED[row.stage].1 - 1.0).abs());
                    }
                }
                Some(false) => wrong += u64::from(row.traction >= cap),
                None => {}
            }
        }
        errors.iter_mut().zip(largest).for_each(|(all, error)| all.push(error));
        cost.get_or_insert(done.cost);
    }
    Ok(CapResults { ends, errors, held, wrong, cost: cost.ok_or("nothing was run")? })
}

/// Claims on a law with a cap.
fn under_cap(ledger: &mut Ledger, name: &str, found: &CapResults, ends: [f64; 3], released: &str) {
    let [tractions, rates] = &found.errors;
    for (what, errors, bound, because) in [
        ("traction over the cap", tractions, 1e-15, "rounding of one product"),
        (
            "slip rate over that of the load",
            rates,
            1e-10,
            "solving leaves 1e-13 of displacements of 0.6 mm, over the slip of a step of 0.6 um and more",
        ),
    ] {
        ledger
            .claim(format!("{name} with a cap: {what}, less one, while the cap holds ({} rows), both steppers and measures", found.held))
            .values(errors)
            .equals_each(&[0.0; 4])
            .absolute(bound)
            .evidence(Evidence::Exact, "F_limit; the spring keeps its length under a constant traction")
            .because(because)
            .why_not_tighter("how much of it solving leaves is known by its order only")
            .covers(&[Capability::LawFamily, Capability::Implicit, Capability::StaticExplicit])
            .cost(&found.cost)
            .record();
    }
    // Three points by four runs.
    let wanted: Vec<f64> = (0..found.ends.len()).map(|i| ends[i % 3]).collect();
    ledger
        .claim(format!("{name} with a cap: friction at 1, 100 and 1 um/s after 30 lengths of slip and more"))
        .values(&found.ends)
        .equals_each(&wanted)
        .absolute(1e-9)
        .evidence(Evidence::Exact, "the lesser of steady strength and cap")
        .because("e^-30 of the way to the steady state is left; explicit steps leave a drift of 1e-9 of the forces there")
        .why_not_tighter("how far drift falls in steady sliding is known by its order only")
        .covers(&[Capability::LawFamily, Capability::Implicit, Capability::StaticExplicit])
        .cost(&found.cost)
        .record();
    if !released.is_empty() {
        ledger
            .claim(format!(
                "{name} with a cap: rows at the cap after the strength has fallen below it, at 100 um/s"
            ))
            .count(found.wrong, 0)
            .evidence(Evidence::Exact, released)
            .because("a tenth of a length of slip beside the instant is left out")
            .covers(&[Capability::LawFamily])
            .cost(&found.cost)
            .record();
    }
}

/// Steady friction of a law without state.
fn steady(rate: f64, effect: f64) -> f64 {
    MU0 + effect * (rate / SLOW).ln()
}

/// A purely rate-dependent law, capped at the high rate.
fn capped_rate(ledger: &mut Ledger) -> Result<(), CaseError> {
    let cap = 6.3e6;
    let law = format!("{{ kind = \"rate\", mu0 = {MU0}, a = {A}, v_ref = {SLOW:e}, f_limit = {cap} }}");
    // V follows a logistic curve up to the rate at which the strength is the cap.
    let reaches = (cap / NORMAL - MU0) / A;
    let after =
        ((FAST / SLOW - 1.0) / (FAST / SLOW / reaches.exp() - 1.0)).ln() * A * NORMAL * COMPLIANCE / FAST;
    let found = capped(&law, cap, |row| (row.stage == 1 && row.since > 2.0 * after).then_some(true))?;
    under_cap(ledger, "law without a state", &found, [steady(SLOW, A), cap / NORMAL, steady(SLOW, A)], "");
    Ok(())
}

/// Laws with a state, capped at the low rate; the cap is released at the high rate once the state has evolved.
fn capped_states(ledger: &mut Ledger) -> Result<(), CaseError> {
    let cap = 5.9e6;
    let jump = (FAST / SLOW).ln();
    // Contribution of the state at which the strength is the cap, from 0 at the low rate.
    let phi = cap / NORMAL - MU0 - A * jump;
    let ratio = SLOW / FAST;
    let slip = -(1.0 + phi / (B * jump)).ln();
    let laws = [
        ("ageing", "", -(((phi / B).exp() - ratio) / (1.0 - ratio)).ln()),
        ("slip", "", slip),
        // V θ/2L falls from the ratio of the rates as a hyperbolic cotangent of V t/2L.
        ("prz", "", 2.0 * ((ratio / (phi / B).exp()).atanh() - ratio.atanh())),
        // Far below V_w.
        ("flash", ", mu_w = 0.2, v_w = \"1 m/s\"", slip),
    ];
    for (name, own, lets_go) in laws {
        let law = format!(
            "{{ kind = \"rate-and-state\", evolution = \"{name}\", mu0 = {MU0}, a = {A}, b = {B}, l = {LENGTH:e}, v_ref = {SLOW:e}, \
             v_initial = {SLOW:e}, f_limit = {cap}{own} }}"
        );
        let found = capped(&law, cap, |row| match row.stage {
            0 => (row.since > 400.0).then_some(true),
            1 => {
                let x = row.since * FAST / LENGTH;
                ((x - lets_go).abs() > 0.1).then_some(x < lets_go)
            }
            _ => row.last.then_some(true),
        })?;
        let ends = [cap / NORMAL, steady(FAST, A - B), cap / NORMAL];
        under_cap(
            ledger,
            &format!("{name} law"),
            &found,
            ends,
            "f_n mu(V, state) = F_limit, the state at a constant V in closed form",
        );
    }
    Ok(())
}

/// A 3D column dragged along x until it slides and then along z: its traction rotates from x to z.
fn turning(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (mu, drag) = (0.6, 600e-6_f64);
    let length = mu * NORMAL * COMPLIANCE;
    // A block on a spring of constant length follows a tractrix.
    let angle = 2.0 * (-drag / length).exp().atan();
    for stepper in ["implicit", "static-explicit"] {
        let (mut levels, mut iterations, mut cost) = (Vec::new(), Vec::new(), None);
        for steps in [10_u16, 20, 40, 80] {
            let scene = SceneText::new(SPACE)
                .with("interfaces.fault.law", format!("{{ kind = \"coulomb\", mu = {mu} }}"))
                .add("interfaces.fault.measure", "node-to-point")
                .add("interfaces.fault.sliding", "small")
                .with_or_same("time.stepper", stepper)
                .with("stages[1].duration", "400 s")
                .with("stages[1].conditions[0].x.rate", "1 um/s")
                .with("stages[1].conditions[0].z", "hold")
                .with("stages[2].duration", format!("{drag:e} s"))
                .with("stages[2].conditions[0].x", "hold")
                .with("stages[2].conditions[0].z.rate", "1 m/s")
                .add("stages[2].steps", steps)
                .without("stages[5]")
                .without("stages[4]")
                .without("stages[3]");
            let done = texts::simulate(&scene.text()?)?;
            let vectors = &done.contact("up")?.shear_vector;
            let off = |v: &[f64; 3]| (v[0].abs().atan2(v[2].abs()) - angle).abs();
            levels.push((1.0 / f64::from(steps), vectors.iter().map(off).fold(0.0, f64::max)));
            let turns = done.record.records().iter().filter(|r| r.stage == 2);
            iterations.push(turns.map(|r| r.iterations).max().unwrap_or_default() as f64);
            cost.get_or_insert(done.cost);
        }
        let cost = cost.ok_or("nothing was run")?;
        ledger
            .order(format!("Coulomb friction in space, {stepper}: direction of traction after a right angle in the path, all points [rad]"))
            .levels(&levels)
            .expected(1.0)
            .within(0.1)
            .finest(5e-3, "to first order it lags by h/2 sin(angle) ln cosh(s), s the drag over mu f_n/k and h that of a step: 4.4e-3")
            .evidence(Evidence::Exact, "the tractrix: tan(angle/2) falls as e^(-k s/(mu f_n))")
            .because("slip of a step is along the traction at its end")
            .covers(&[Capability::Coulomb, Capability::PenaltyContact3d, Capability::Stages])
            .cost(&cost)
            .record();
        ledger
            .claim(format!("Coulomb friction in space, {stepper}: most Newton iterations of a step that turns, in 10, 20, 40 and 80 steps"))
            .value(iterations.iter().fold(0.0, |a: f64, b| a.max(*b)))
            .at_most(6.0)
            .evidence(Evidence::Exact, "convergence of second order")
            .because("steps turn by up to 0.2, and Newton's method squares what is left: 4e-2, 2e-3, 3e-6, 1e-11, rounding, and one to spare")
            .why_not_tighter("a whole number")
            .covers(&[Capability::Tangents, Capability::PenaltyContact3d])
            .cost(&cost)
            .record();
    }
    Ok(())
}
