//! Cracks in a plane: closed under compression with friction, and opened by pressure.

use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity::kinds;
use asperity::kinds::bodies::RunReport;
use asperity_output::bodies::Recorder;
use asperity_output::bodies::view::InterfaceFields;
use asperity_plan::bodies;
use asperity_plan::reading::scene as reader;
use asperity_plan::reading::scene::model::{
    FaultMesh, InitialStress, Interface, Measure, MeshSource, Scene, SpacingSpec, here,
};
use asperity_plan::reading::scene::units::{Length, Penalty};
use asperity_run::report::Outcome;
use std::f64::consts::PI;

/// See the README.
pub const CASE: Case = Case {
    name: "frictional_crack",
    readme: include_str!("README.md"),
    covers: &[Capability::PlaneStrain, Capability::Mortar, Capability::PenaltyContact2d, Capability::Coulomb],
    quick: true,
    run,
};

const YOUNG: f64 = 25e9;
const POISSON: f64 = 0.25;
/// Compression \[Pa\].
const COMPRESSION: f64 = 100e6;
/// Pressure in the open crack \[Pa\].
const PRESSURE: f64 = 2e6;
/// Uniform meshes: cells per half-length b, and growth factor of cells away from the crack, whose logarithm halves with the cell
/// size.
const LEVELS: [(f64, f64); 4] = [(4.0, 1.5), (8.0, 1.225), (16.0, 1.107), (32.0, 1.052)];
/// Factor of the bound over the error predicted from the last two levels.
const ROOM: f64 = 1.5;
/// Range of distances from the tip used to determine K_II \[m\]: many cells from the tip but a small fraction of the half-length.
const NEAR: [f64; 2] = [0.02, 0.2];

/// Exact solution of the closed crack.
struct Exact {
    normal: f64,
    shear: f64,
    /// Slip in the middle \[m\].
    slip: f64,
    k: f64,
}

fn exact() -> Exact {
    let (sin, cos) = (PI / 9.0).sin_cos();
    let normal = COMPRESSION * sin * sin;
    let shear = normal * (PI / 6.0).tan();
    let drop = COMPRESSION * sin * cos - shear;
    Exact { normal, shear, slip: compliance() * drop, k: drop * PI.sqrt() }
}

/// Displacement jump in the middle of a crack of half-length 1 m per stress on its faces \[m/Pa\].
fn compliance() -> f64 {
    4.0 * (1.0 - POISSON * POISSON) / YOUNG
}

fn closed() -> Result<Scene, CaseError> {
    Ok(reader::read(include_str!("scene.toml")).map_err(|e| format!("scene.toml: {e}"))?)
}

fn pressurised() -> Result<Scene, CaseError> {
    Ok(reader::read(include_str!("pressurised.toml")).map_err(|e| format!("pressurised.toml: {e}"))?)
}

fn mesh(scene: &mut Scene) -> Result<&mut FaultMesh, CaseError> {
    match scene.bodies.get_mut("plane").map(|b| &mut b.mesh) {
        Some(MeshSource::Fault(mesh)) => Ok(mesh),
        _ => Err("the scene has no plane with a fault".into()),
    }
}

fn interface(scene: &mut Scene) -> Result<&mut Interface, CaseError> {
    Ok(scene.interfaces.get_mut("crack").ok_or("the scene has no crack")?)
}

/// The scene with `n` equal cells on b, in a box of half-width `half` \[m\].
fn uniform(mut scene: Scene, n: f64, growth: f64, half: f64) -> Result<Scene, CaseError> {
    let mesh = mesh(&mut scene)?;
    mesh.spacing = here(SpacingSpec::Constant(Length(n.recip())));
    mesh.growth = here(growth);
    mesh.min = here([Length(-half); 2]);
    mesh.max = here([Length(half); 2]);
    Ok(scene)
}

fn measured_by(mut scene: Scene, measure: Measure) -> Result<Scene, CaseError> {
    interface(&mut scene)?.measure = here(measure);
    Ok(scene)
}

/// A completed run.
struct CrackRun {
    /// Signed distance of each point from the middle along the crack \[m\].
    along: Vec<f64>,
    areas: Vec<f64>,
    fields: InterfaceFields,
    report: RunReport,
    cost: Cost,
}

fn simulate(scene: &Scene) -> Result<CrackRun, CaseError> {
    let mut record = Recorder::new();
    let (report, cost) = Cost::measure(|| {
        let plan = bodies::plan(scene).map_err(|e| e.to_string())?;
        kinds::bodies::run(&plan, &mut record).map_err(|e| e.to_string())
    });
    let report = report?;
    if let Outcome::Stopped { reason, .. } = &report.outcome {
        return Err(format!("stopped: {reason}").into());
    }
    let crack = record.setup().interfaces.first().ok_or("no interface")?;
    let along = crack.positions.iter().map(|x| x[0].hypot(x[1]).copysign(x[1])).collect();
    let areas = crack.areas.clone();
    let fields = record.stage_ends().last().ok_or("no stage ended")?.interfaces[0].clone();
    let cost = cost.counts(&report.counts).count("unknowns", report.plan.dofs as f64);
    Ok(CrackRun { along, areas, fields, report, cost })
}

impl CrackRun {
    /// Absolute slip \[m\].
    fn slip(&self) -> Vec<f64> {
        self.fields.slip.iter().map(|s| s.abs()).collect()
    }

    /// The point at a distance from the middle.
    fn at(&self, x: f64) -> usize {
        (0..self.along.len())
            .min_by(|&a, &b| (self.along[a] - x).abs().total_cmp(&(self.along[b] - x).abs()))
            .unwrap_or(0)
    }

    fn middle(&self) -> f64 {
        self.slip()[self.at(0.0)]
    }

    /// Relative L2 error of values against an ellipse of this height.
    fn profile(&self, values: &[f64], height: f64) -> f64 {
        let (mut error, mut whole) = (0.0, 0.0);
        for ((x, a), v) in self.along.iter().zip(&self.areas).zip(values) {
            let e = height * (1.0 - x * x).max(0.0).sqrt();
            error += a * (v - e).powi(2);
            whole += a * e * e;
        }
        (error / whole).sqrt()
    }

    /// K_II \[Pa √m\] at the upper tip by the fit described in the README.
    fn k(&self) -> Option<f64> {
        let near: Vec<(f64, f64)> = self
            .along
            .iter()
            .zip(self.slip())
            .map(|(x, s)| (1.0 - x, s * s))
            .filter(|(r, _)| *r > NEAR[0] && *r < NEAR[1])
            .collect();
        let slope = parabola(&near)?[1];
        Some(YOUNG / (8.0 * (1.0 - POISSON * POISSON)) * (2.0 * PI * slope).sqrt())
    }
}

/// Least-squares parabola through points.
fn parabola(points: &[(f64, f64)]) -> Option<[f64; 3]> {
    let mut m = [[0.0; 4]; 3];
    for &(x, y) in points {
        let powers = [1.0, x, x * x];
        for i in 0..3 {
            for j in 0..3 {
                m[i][j] += powers[i] * powers[j];
            }
            m[i][3] += powers[i] * y;
        }
    }
    for i in 0..3 {
        for j in i + 1..3 {
            let f = m[j][i] / m[i][i];
            let pivot = m[i];
            m[j].iter_mut().zip(pivot).for_each(|(a, b)| *a -= f * b);
        }
    }
    let c = m[2][3] / m[2][2];
    let b = (m[1][3] - m[1][2] * c) / m[1][1];
    let a = (m[0][3] - m[0][1] * b - m[0][2] * c) / m[0][0];
    [a, b, c].iter().all(|v| v.is_finite()).then_some([a, b, c])
}

const CLOSED_FORM: &str = "closed form of an infinite plane";

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for measure in [Measure::Mortar, Measure::NodeToPoint] {
        order(ledger, measure)?;
    }
    graded(ledger)?;
    inclined(ledger)?;
    comparison(ledger)?;
    boxes(ledger)?;
    penalties(ledger)?;
    opened(ledger)
}

fn name_of(measure: Measure) -> &'static str {
    match measure {
        Measure::Mortar => "mortar",
        Measure::NodeToPoint => "node-to-point",
    }
}

/// Order of the error in the middle with uniform cells.
fn order(ledger: &mut Ledger, measure: Measure) -> Result<(), CaseError> {
    let (mut levels, mut cost) = (Vec::new(), Cost::default());
    for (n, growth) in LEVELS {
        let done = simulate(&measured_by(uniform(closed()?, n, growth, 100.0)?, measure)?)?;
        levels.push((n.recip(), 1.0 - done.middle() / exact().slip));
        cost = done.cost;
    }
    ledger
        .order(format!("slip in the middle, uniform cells, {}, error relative", name_of(measure)))
        .levels(&levels)
        .expected(1.0)
        .within(0.1)
        .or_better()
        .evidence(Evidence::Exact, CLOSED_FORM)
        .because(
            "the tips' r^(1/2) leaves uniform cells of any order an energy of O(h), as if each tip lay 0.4 h inside; the part of \
             second order on top raises what coarse levels show",
        )
        .finest(
            ROOM * (levels[2].1 - levels[3].1),
            "1.5 times what the last two levels of a first-order error let expect, without use of the reference",
        )
        .cost(&cost)
        .record();
    Ok(())
}

/// Cells that grow from the tips: the unmodified scene.
fn graded(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut rows = Vec::new();
    let mut plot = Plot::xy("Slip along the crack", "x [m]", "slip [mm]");
    for measure in [Measure::Mortar, Measure::NodeToPoint] {
        let done = simulate(&measured_by(closed()?, measure)?)?;
        let name = name_of(measure);
        let points: Vec<(f64, f64)> =
            done.along.iter().zip(done.slip()).map(|(x, s)| (*x, 1e3 * s)).collect();
        plot = plot.series(Series::points(name, &points));
        slips(ledger, name, &done);
        tractions(ledger, name, &done);
        rows.push(row(&format!("{name}, graded from 1 mm"), &done)?);
        if measure == Measure::Mortar {
            balance(ledger, &done);
        }
    }
    let curve: Vec<(f64, f64)> = (0..=200)
        .map(|k| f64::from(k) / 100.0 - 1.0)
        .map(|x| (x, 1e3 * exact().slip * (1.0 - x * x).sqrt()))
        .collect();
    ledger.plot(plot.series(Series::line("exact", &curve)));
    ledger.table("graded cells", &HEAD, rows);
    Ok(())
}

const HEAD: [&str; 6] = ["cells", "unknowns", "middle", "profile (L2)", "K_II", "wall [s]"];

fn row(what: &str, done: &CrackRun) -> Result<Vec<String>, CaseError> {
    let e = exact();
    let k = done.k().ok_or("too few points near the tip")?;
    Ok(vec![
        what.to_string(),
        done.report.plan.dofs.to_string(),
        format!("{:+.3} %", 100.0 * (done.middle() / e.slip - 1.0)),
        format!("{:.3} %", 100.0 * done.profile(&done.slip(), e.slip)),
        format!("{:+.3} %", 100.0 * (k / e.k - 1.0)),
        format!("{:.2}", done.cost.wall.unwrap_or(f64::NAN)),
    ])
}

fn slips(ledger: &mut Ledger, name: &str, done: &CrackRun) {
    let e = exact();
    ledger
        .claim(format!("slip in the middle, graded, {name}"))
        .unit("m")
        .value(done.middle())
        .equals(e.slip)
        .relative(2e-3)
        .evidence(Evidence::Exact, CLOSED_FORM)
        .because(
            "the aim; tips 0.4 mm short are 0.04 %, cells that grow to a twentieth of b in the middle 0.1 %",
        )
        .why_not_tighter("the share of the cells in the middle depends on how they grow")
        .cost(&done.cost)
        .record();
    ledger
        .claim(format!("slip at half of b on either side, graded, {name}"))
        .unit("m")
        .values(&[done.slip()[done.at(0.5)], done.slip()[done.at(-0.5)]])
        .equals_each(&[e.slip * 0.75_f64.sqrt(); 2])
        .relative(2e-3)
        .evidence(Evidence::Exact, CLOSED_FORM)
        .because("as in the middle")
        .why_not_tighter("as in the middle")
        .cost(&done.cost)
        .record();
    ledger
        .claim(format!("profile of slip, relative error in L2, graded, {name}"))
        .value(done.profile(&done.slip(), e.slip))
        .at_most(3e-3)
        .evidence(Evidence::Exact, "an ellipse")
        .because("the aim for the middle, and as much again for the tips, where slip is averaged over cells on which its slope is infinite")
        .cost(&done.cost)
        .record();
    ledger
        .claim(format!("K_II from slip near the tip, graded, {name}"))
        .unit("Pa m^0.5")
        .value(done.k().unwrap_or(f64::NAN))
        .equals(e.k)
        .relative(2e-3)
        .evidence(Evidence::Exact, CLOSED_FORM)
        .because("as large as the error of slip far from the tip; the tip's own is taken up by the fit")
        .cost(&done.cost)
        .record();
}

fn tractions(ledger: &mut Ledger, name: &str, done: &CrackRun) {
    let e = exact();
    let ratio = done.fields.shear_traction.iter().zip(&done.fields.normal_traction);
    let ratio: Vec<f64> = ratio.map(|(t, n)| t.abs() / n / (PI / 6.0).tan()).collect();
    ledger
        .claim(format!("shear traction over its limit at every point, graded, {name}"))
        .values(&ratio)
        .equals_each(&vec![1.0; ratio.len()])
        .absolute(1e-12)
        .evidence(Evidence::Exact, "Coulomb's law: all points slide")
        .because("the law returns the traction to the cone in closed form: rounding")
        .why_not_tighter("rounding of a handful of operations")
        .cost(&done.cost)
        .record();
    let middle = done.at(0.0);
    // A uniform closing by f_n/E_n requires less stress than an elliptic one of the same height.
    let mean = done.areas.iter().sum::<f64>() / done.areas.len() as f64;
    let bound = mean / (100.0 * YOUNG * compliance());
    ledger
        .claim(format!("normal and shear traction in the middle over the exact ones, graded, {name}"))
        .values(&[
            done.fields.normal_traction[middle] / e.normal,
            done.fields.shear_traction[middle].abs() / e.shear,
        ])
        .equals_each(&[1.0; 2])
        .absolute(bound)
        .evidence(Evidence::Exact, CLOSED_FORM)
        .because("the penalty: sides that close by f_n/E_n relieve f_n by at most h/(100 E) over the compliance of the crack")
        .cost(&done.cost)
        .record();
}

/// Claims that action equals reaction.
fn balance(ledger: &mut Ledger, done: &CrackRun) {
    let balance = &done.report.balance[0];
    ledger
        .claim("sum of all contact forces and moments, relative, graded, mortar")
        .value(balance.force_residual.max(balance.moment_residual))
        .at_most(1e-13)
        .evidence(Evidence::Exact, "action and reaction")
        .because("rounding of sums over 157 points")
        .why_not_tighter("nodes of the two sides lie on each other and their forces cancel one by one; on other meshes they do not")
        .covers(&[Capability::Balance])
        .record();
}

/// The mesh inclined by 20 degrees and compression along y, instead of inclined compression.
fn inclined(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (sin, cos) = (PI / 9.0).sin_cos();
    let mut scene = closed()?;
    let trace = [-1.0, -0.5, 0.0, 0.5, 1.0].map(|t| [Length(t * sin), Length(t * cos)]).to_vec();
    mesh(&mut scene)?.trace.get_mut().fill(trace);
    let stress = scene.bodies.get_mut("plane").and_then(|b| b.initial_stress.as_mut());
    let InitialStress::Uniform(values) = stress.ok_or("the scene has no initial stress")?.get_mut() else {
        return Err("the initial stress varies".into());
    };
    values.iter_mut().zip([0.0, -COMPRESSION, 0.0]).for_each(|(v, s)| v.0 = s);
    let done = simulate(&scene)?;
    ledger
        .claim("slip in the middle, graded, inclined mesh, mortar")
        .unit("m")
        .value(done.middle())
        .equals(exact().slip)
        .relative(3e-3)
        .evidence(Evidence::Exact, CLOSED_FORM)
        .because("half as much again as with upright cells: beyond the tips cells lean by up to 20 degrees")
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Uniform cells in the box used by other authors.
fn comparison(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut rows = Vec::new();
    for (n, theirs) in [(10.0, "-3.9"), (20.0, "-2.1"), (40.0, "-1.2"), (80.0, "-0.7")] {
        for measure in [Measure::Mortar, Measure::NodeToPoint] {
            let done = simulate(&measured_by(uniform(closed()?, n, 1.1, 20.0)?, measure)?)?;
            let what = format!("{}, {n} on b (independent node-to-node: {theirs} %)", name_of(measure));
            rows.push(row(&what, &done)?);
        }
    }
    ledger.table("uniform cells in a box of 40 m", &HEAD, rows);
    Ok(())
}

/// Effect of a box of finite width.
fn boxes(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut slips = Vec::new();
    for half in [5.0, 10.0, 20.0, 40.0] {
        let done = simulate(&uniform(closed()?, 10.0, 1.1, half)?)?;
        slips.push((half.recip(), done.middle() / exact().slip));
    }
    let levels: Vec<(f64, f64)> = slips.windows(2).map(|p| (p[0].0, p[1].1 - p[0].1)).collect();
    ledger
        .order("slip in the middle, box against one twice as wide (held sides, half-width over b), difference relative")
        .levels(&levels)
        .expected(2.0)
        .within(0.1)
        .evidence(Evidence::Exact, "far from it a crack is a dipole, whose image in the sides acts back by (b/W)^2")
        .because("theory of the dipole")
        .finest(
            2.5e-3,
            "(b/W)^2 at W = 20 b, the change by a factor of four included; from it 0.004 % remain at the 100 b of the other runs",
        )
        .record();
    Ok(())
}

/// Effect of the penalty.
fn penalties(ledger: &mut Ledger) -> Result<(), CaseError> {
    let h = 0.1;
    let mut levels = Vec::new();
    for factor in [1.0, 10.0, 100.0] {
        let mut scene = uniform(closed()?, 10.0, 1.1, 20.0)?;
        let enforcement = &mut interface(&mut scene)?.enforcement;
        let penalty = Penalty::Value(factor * YOUNG / h);
        enforcement.normal = here(penalty);
        enforcement.tangential = Some(here(penalty));
        let done = simulate(&scene)?;
        let middle = done.fields.normal_traction[done.at(0.0)];
        levels.push((1.0 / factor, 1.0 - middle / exact().normal));
    }
    ledger
        .order("normal traction in the middle over 1/penalty (E/h), error relative")
        .levels(&levels)
        .expected(1.0)
        .within(0.05)
        .evidence(Evidence::Exact, CLOSED_FORM)
        .because("the sides close by f_n/E_n")
        .finest(
            h / (100.0 * YOUNG * compliance()),
            "h/(100 E) over the compliance of the crack: an upper bound, because a uniform closing asks for less stress than \
             an elliptic one",
        )
        .record();
    Ok(())
}

/// The crack under pressure.
fn opened(ledger: &mut Ledger) -> Result<(), CaseError> {
    let height = compliance() * PRESSURE;
    let gap = |done: &CrackRun| done.fields.gap[done.at(0.0)];
    let (mut levels, mut cost) = (Vec::new(), Cost::default());
    for (n, growth) in LEVELS {
        let done = simulate(&uniform(pressurised()?, n, growth, 100.0)?)?;
        levels.push((n.recip(), 1.0 - gap(&done) / height));
        cost = done.cost;
    }
    ledger
        .order("opening in the middle under pressure, uniform cells, mortar, error relative")
        .levels(&levels)
        .expected(1.0)
        .within(0.1)
        .or_better()
        .evidence(Evidence::Exact, "closed form (Sneddon)")
        .because("as for slip")
        .finest(ROOM * (levels[2].1 - levels[3].1), "1.5 times what the last two levels let expect")
        .cost(&cost)
        .record();
    let done = simulate(&pressurised()?)?;
    ledger
        .claim("opening in the middle under pressure, graded, mortar")
        .unit("m")
        .value(gap(&done))
        .equals(height)
        .relative(2e-3)
        .evidence(Evidence::Exact, "closed form (Sneddon)")
        .because("as for slip")
        .cost(&done.cost)
        .record();
    ledger
        .claim("profile of the opening, relative error in L2, graded, mortar")
        .value(done.profile(&done.fields.gap, height))
        .at_most(3e-3)
        .evidence(Evidence::Exact, "an ellipse")
        .because("as for slip")
        .cost(&done.cost)
        .record();
    ledger
        .claim("points of the crack under pressure that are closed")
        .count(done.fields.normal_traction.iter().filter(|t| **t > 0.0).count() as u64, 0)
        .evidence(Evidence::Exact, "the opening is positive everywhere")
        .because("a count")
        .record();
    Ok(())
}
