//! A slender beam rolled up by rotation of its end section, and bent by a dead load.

use super::body::{self, Body, Entry, Work};
use crate::cases::body_plots;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::material::elastic::Elastic;
use asperity_fem::nonlinear::{Kinematics, Material};
use asperity_fem::surface;
use std::f64::consts::{FRAC_PI_2, TAU};

/// See the README.
pub const CASE: Case = Case {
    name: "cantilever_rotation",
    readme: include_str!("README.md"),
    covers: &[Capability::FiniteStrain],
    quick: true,
    run,
};

/// With E = L = 1 forces are about t^3/12 and stiffnesses about 1: rounding of displacements of 1 leaves residuals of 1e-15.
const BALANCED: f64 = 2e-14;
const SOURCE: &str = "elastica (Bisshopp and Drucker 1945), elliptic integrals by Gauss's rule to 1e-14";

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    rolled_up(ledger)?;
    forced(ledger)?;
    thickness(ledger)?;
    refinement(ledger)
}

/// A beam of length 1 along x with its middle line at y = 0 and its root clamped; the end section is prescribed if `ends`.
fn beam(thickness: f64, cells: usize, ends: bool) -> Result<Body<2>, CaseError> {
    let half = 0.5 * thickness;
    // Thinning under radial stress varies as a parabola across the section. One cell captures 5/6 of its energy, which leaves an
    // error of (kappa t)^2/30 in the moment; two cells capture 99 %.
    let layers = if ends { 2 } else { 1 };
    let mesh = body::grid::<2>(ElementKind::Quad9, [0.0, -half], [1.0, half], [cells, layers])?;
    let material = Material::Elastic(Elastic::new(1.0, 0.0)?);
    let mut nodes = body::side(&mesh, "left")?;
    if ends {
        nodes.extend(body::side(&mesh, "right")?);
    }
    let fixed: Vec<usize> = nodes.iter().flat_map(|n| [2 * n, 2 * n + 1]).collect();
    let options = body::model(material, Idealisation::PlaneStrain, Kinematics::UpdatedLagrangian);
    Body::new(mesh, options, &fixed)
}

/// Displacement of a point of the beam rolled to the angle `phi` with undeformed sections.
fn rolled(phi: f64, [x, y]: [f64; 2]) -> [f64; 2] {
    let radius = 1.0 / phi;
    let (s, c) = (phi * x).sin_cos();
    [(radius - y) * s - x, radius - (radius - y) * c - y]
}

/// Node nearest to a point.
fn node_at(body: &Body<2>, place: [f64; 2]) -> usize {
    let distance = |n: usize| (body.mesh.nodes[n][0] - place[0]).hypot(body.mesh.nodes[n][1] - place[1]);
    (0..body.mesh.nodes.len()).min_by(|&a, &b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
}

/// Root moment over E I phi, height of the beam's midpoint over the diameter, the curve of moment against rotation, and the work.
type BendingResults = (f64, f64, Vec<(f64, f64)>, Work);

fn roll(thickness: f64, cells: usize, steps: usize) -> Result<BendingResults, CaseError> {
    let mut body = beam(thickness, cells, true)?;
    let ends = body::side(&body.mesh, "right")?;
    let root = body::side(&body.mesh, "left")?;
    let (mut ratio, mut curve) = (f64::NAN, vec![(0.0, 0.0)]);
    let bending = thickness.powi(3) / 12.0;
    for k in 1..=steps {
        let phi = TAU * k as f64 / steps as f64;
        let mut held: Vec<Entry> = body::moved(&body.mesh, &ends, |x| rolled(phi, x));
        held.extend(root.iter().flat_map(|n| [(2 * n, 0.0), (2 * n + 1, 0.0)]));
        let guess = body::field(&body.mesh, |x| rolled(phi, x));
        let r = body.implicit(&held, &[], 1.0, BALANCED, Some(guess))?;
        // Forces of the block on its root, about the middle of the section: -y f_x turns the beam upwards.
        let moment: f64 = root.iter().map(|&n| body.mesh.nodes[n][1] * r[2 * n]).sum();
        ratio = moment / (bending * phi);
        curve.push((phi / TAU, moment / (bending * TAU)));
    }
    let middle = node_at(&body, [0.5, 0.0]);
    Ok((ratio, body.u[2 * middle + 1] / (2.0 / TAU), curve, body.work))
}

/// Cells along the beam and steps of the roll.
const CELLS: usize = 60;
const STEPS: usize = 120;

fn rolled_up(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (mut levels, mut last, mut rest) = (Vec::new(), Cost::default(), Vec::new());
    let mut shape = (f64::NAN, f64::NAN);
    for thickness in [0.08, 0.04, 0.02] {
        let (outcome, cost) = Cost::measure(|| roll(thickness, CELLS, STEPS));
        let (ratio, height, curve, work) = outcome?;
        let strain = TAU * thickness;
        levels.push((thickness, (ratio - 1.0).abs()));
        rest.push((thickness, (ratio - 1.0 + 0.3 * strain * strain).abs()));
        last = cost.counts(&work);
        shape = (height, strain);
        if thickness == 0.02 {
            let theory: Vec<(f64, f64)> = vec![(0.0, 0.0), (1.0, 1.0)];
            ledger.plot(
                Plot::xy(
                    "Rolling up",
                    "rotation of the end over 2 pi [-]",
                    "root moment over 2 pi E I/L [-]",
                )
                .series(Series::points("root moment", &curve))
                .series(Series::line("M = E I phi/L", &theory)),
            );
        }
    }
    let strain = shape.1;
    ledger
        .order("root moment of the full circle over 2 pi E I/L, difference to 1, in the thickness")
        .levels(&levels)
        .expected(2.0)
        .within(0.15)
        .finest(
            0.4 * strain * strain,
            "0.3 (kappa t)^2 from the ring to second order, and a third of it for what the ends disturb",
        )
        .evidence(Evidence::Exact, "M = E I phi/L of the inextensible beam")
        .because("the body differs from the beam by the square of its surface strain")
        .cost(&last)
        .record();
    // Each step rotates the end by 2 pi/120; cells have the length h.
    let (turn, h) = (TAU / STEPS as f64, 1.0 / CELLS as f64);
    let locked = TAU * TAU * h.powi(4) / (30.0 * 0.02 * 0.02);
    let bound = turn * turn / 8.0 + 2.0 * h * strain * strain + locked;
    let remainder = rest[rest.len() - 1].1;
    ledger
        .claim("root moment of the full circle over 2 pi E I/L, t = L/50, against 1 - 0.3 (kappa t)^2")
        .value(remainder)
        .at_most(bound)
        .evidence(Evidence::SemiAnalytic, "pure bending of a ring with tau = E ln(l), to second order in the thickness")
        .because("step: turn^2/8; end sections that keep their thickness disturb a cell each, 2h/L of (kappa t)^2; a parabola is no arc: axial strain kappa^2 h^2/2/sqrt(180) makes cells stiffer by kappa^2 h^4/(30 t^2)")
        .why_not_tighter("three parts that need not all have one sign")
        .cost(&last)
        .record();
    ledger
        .claim("height of the middle of the full circle over the diameter L/pi, t = L/50")
        .value(shape.0)
        .equals(1.0)
        .absolute(0.2 * strain * strain)
        .evidence(Evidence::Exact, "a circle of circumference L")
        .because(
            "without axial force the middle line is longer by (kappa t)^2/8; the same again for the sections",
        )
        .why_not_tighter("estimate to second order")
        .cost(&last)
        .record();
    Ok(())
}

/// Composite Gauss rule: 64 intervals of three points, for smooth integrands that vary over lengths of order 1.
fn integral(from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    let n = 256;
    let h = (to - from) / f64::from(n);
    let offset = 0.6_f64.sqrt();
    (0..n)
        .map(|k| {
            let mid = from + (f64::from(k) + 0.5) * h;
            let d = 0.5 * h * offset;
            h * (5.0 * f(mid - d) + 8.0 * f(mid) + 5.0 * f(mid + d)) / 18.0
        })
        .sum()
}

/// Tip deflection and shortening over L of the elastica under P L²/(E I) = alpha.
fn elastica(alpha: f64) -> [f64; 2] {
    // k² = (1 + sin phi_0)/2, phi_0 the slope of the tip; sin theta_1 = 1/(k sqrt 2).
    let lower = |k: f64| (1.0 / (k * 2.0_f64.sqrt())).asin();
    let first = |k: f64| integral(lower(k), FRAC_PI_2, |t| 1.0 / (1.0 - (k * t.sin()).powi(2)).sqrt());
    let slope =
        body::root(1e-3, FRAC_PI_2 - 1e-3, |phi| first((0.5 * (1.0 + phi.sin())).sqrt()) - alpha.sqrt());
    let k = (0.5 * (1.0 + slope.sin())).sqrt();
    let second = integral(lower(k), FRAC_PI_2, |t| (1.0 - (k * t.sin()).powi(2)).sqrt());
    [1.0 - 2.0 * second / alpha.sqrt(), 1.0 - (2.0 * slope.sin() / alpha).sqrt()]
}

/// Tip deflection and shortening at the given alphas, in steps of `step`; shape of the middle line at the end; the bent body.
type Bent = (Vec<[f64; 2]>, Vec<(f64, f64)>, Body<2>);

fn bend(thickness: f64, cells: usize, alphas: &[f64], step: f64) -> Result<Bent, CaseError> {
    let mut body = beam(thickness, cells, false)?;
    let unit = surface::integrate(
        &body.mesh,
        &body.mesh.side_sets["right"],
        Idealisation::PlaneStrain,
        |point, value| {
            value[1] = surface::length(&point.normal) / thickness;
        },
    );
    let tip = node_at(&body, [1.0, 0.0]);
    let (mut found, mut alpha) = (Vec::new(), 0.0);
    for &target in alphas {
        let steps = ((target - alpha) / step).round() as usize;
        let from: f64 = alpha;
        for k in 1..=steps {
            alpha = from + (target - from) * k as f64 / steps as f64;
            let force = alpha * thickness.powi(3) / 12.0;
            let load: Vec<Entry> = unit.iter().map(|&(dof, f)| (dof, force * f)).collect();
            body.implicit(&[], &load, 1.0, BALANCED, None)?;
        }
        found.push([body.u[2 * tip + 1], -body.u[2 * tip]]);
    }
    let middle = (body.mesh.nodes.iter().zip(body.u.chunks_exact(2)))
        .filter(|(x, _)| x[1].abs() < 0.1 * thickness)
        .map(|(x, u)| (x[0] + u[0], x[1] + u[1]));
    let middle = middle.collect();
    Ok((found, middle, body))
}

fn forced(ledger: &mut Ledger) -> Result<(), CaseError> {
    let thickness = 0.0125;
    let alphas = [1.0, 2.0, 5.0, 10.0];
    // The integrals agree with the table of the literature to four digits.
    let table = [0.3017, 0.4935, 0.7138, 0.8106];
    let exact = alphas.map(elastica);
    ledger
        .claim("tip deflection of the elastica as evaluated here, four forces, against the printed table")
        .values(&exact.map(|e| e[0]))
        .equals_each(&table)
        .absolute(1e-4)
        .uncertainty(5e-5)
        .evidence(Evidence::SemiAnalytic, "Bisshopp and Drucker 1945, four digits as they are quoted")
        .because("the digits of the table")
        .record();
    let (outcome, cost) = Cost::measure(|| bend(thickness, 80, &alphas, 0.125));
    let (found, middle, body) = outcome?;
    let cost = cost.counts(&body.work);
    body_plots::displacement(ledger, "Bent by P L^2/(E I) = 10", &body.mesh, &body.u, true)?;
    for ((alpha, exact), found) in alphas.into_iter().zip(exact).zip(&found) {
        for (what, i) in [("deflection", 0), ("shortening", 1)] {
            ledger
                .claim(format!("tip {what} over L at P L^2/(E I) = {alpha}, t = L/80"))
                .value(found[i])
                .equals(exact[i])
                .absolute(0.4 * alpha * thickness * thickness)
                .evidence(Evidence::SemiAnalytic, SOURCE)
                .because("shear 0.2 alpha t^2 and axial strain 0.08 alpha t^2 of a straight beam, and 0.3 (kappa t)^2 of curvature with kappa^2 <= 2 alpha over a part of the length: 0.4 alpha t^2")
                .why_not_tighter("the three parts have different signs")
                .cost(&cost)
                .record();
        }
    }
    ledger.plot(
        Plot::xy("Cantilever at P L^2/(E I) = 10", "x/L [-]", "y/L [-]")
            .series(Series::points("middle line", &middle))
            .series(Series::points("tip of the elastica", &[(1.0 - exact[3][1], exact[3][0])])),
    );
    Ok(())
}

fn thickness(ledger: &mut Ledger) -> Result<(), CaseError> {
    let exact = elastica(10.0);
    let (mut levels, mut last) = (Vec::new(), Cost::default());
    for thickness in [0.1, 0.05, 0.025] {
        let (outcome, cost) = Cost::measure(|| bend(thickness, 64, &[10.0], 0.125));
        let (found, _, body) = outcome?;
        levels.push((thickness, (found[0][0] - exact[0]).hypot(found[0][1] - exact[1])));
        last = cost.counts(&body.work);
    }
    ledger
        .order("tip at P L^2/(E I) = 10 against the elastica, over L, in the thickness")
        .levels(&levels)
        .expected(2.0)
        .within(0.15)
        .finest(4.0 * 0.025 * 0.025, "0.4 alpha t^2, as for the single forces")
        .evidence(Evidence::SemiAnalytic, SOURCE)
        .because("shear, axial strain and the logarithmic law are of the square of the slenderness: the floor of the comparison is the beam's theory")
        .why_not_tighter("the three parts have different signs")
        .cost(&last)
        .record();
    Ok(())
}

fn refinement(ledger: &mut Ledger) -> Result<(), CaseError> {
    let thickness = 0.025;
    let tip = |cells: usize, step: f64| -> Result<([f64; 2], Cost), CaseError> {
        let (outcome, cost) = Cost::measure(|| bend(thickness, cells, &[10.0], step));
        let (found, _, body) = outcome?;
        Ok((found[0], cost.counts(&body.work)))
    };
    let distance = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let (finest, _) = tip(64, 0.5)?;
    let (mut levels, mut work, mut last) = (Vec::new(), Vec::new(), Cost::default());
    for cells in [4, 8, 16] {
        let (found, cost) = tip(cells, 0.5)?;
        let error = distance(found, finest);
        levels.push((1.0 / cells as f64, error));
        work.push((error, cost.wall.unwrap_or(f64::NAN)));
        last = cost;
    }
    ledger
        .order("tip at P L^2/(E I) = 10, over L, in the mesh, quad9, t = L/40")
        .levels(&levels)
        .expected(3.0)
        .within(0.3)
        .or_better()
        .finest(6e-3, "a parabola is no arc: cells are stiffer by kappa^2 h^4/(30 t^2), 6e-3 with the mean kappa^2 of 7")
        .evidence(Evidence::ConvergedSelf, "64 cells along the beam, the same load steps")
        .because("displacements of quad9 converge with order 3, functionals up to 4; thin curved cells are stiff in bending until they are short")
        .why_not_tighter("a power without its constant")
        .cost(&last)
        .record();
    ledger.plot(
        Plot::work_precision("Work and precision", "error of the tip over L [-]", "time [s]")
            .series(Series::marked("4, 8, 16 cells, 20 load steps", &work)),
    );
    let (finest, _) = tip(16, 0.031_25)?;
    let (mut levels, mut last) = (Vec::new(), Cost::default());
    for step in [0.5, 0.25, 0.125] {
        let (found, cost) = tip(16, step)?;
        levels.push((step, distance(found, finest)));
        last = cost;
    }
    ledger
        .order("tip at P L^2/(E I) = 10, over L, in the load step")
        .levels(&levels)
        .expected(2.0)
        .within(0.3)
        .finest(1e-4, "the first steps turn the tip by 0.06 and err by an eighth of the square in the strain that is added while a section turns, a fifth of it on average")
        .evidence(Evidence::ConvergedSelf, "320 load steps on the same mesh")
        .because("strain at the midpoint, rotation halved before and after it: order 2; the reference has a sixteenth of the finest error")
        .why_not_tighter("most sections take their strain before they turn")
        .cost(&last)
        .record();
    Ok(())
}
