//! Cook's membrane: tip displacement, order of convergence limited by the corner singularity, locking.

use super::bodies::{self, Body};
use super::bodies_patch::capability;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Dilatation, Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;

/// See the README.
pub const CASE: Case = Case {
    name: "cook_membrane",
    readme: include_str!("README.md"),
    covers: &[Capability::PlaneStrain, Capability::PlaneStress],
    quick: true,
    run,
};

/// A variant with its reference displacements at (48, 60) and (48, 52) and their uncertainties.
struct Variant {
    name: &'static str,
    space: Idealisation,
    young: f64,
    poisson: f64,
    force: f64,
    reference: [f64; 2],
    uncertainty: [f64; 2],
    /// Elements that do not lock.
    elements: &'static [(ElementKind, Formulation)],
}

const STANDARD: &[(ElementKind, Formulation)] = &[
    (ElementKind::Quad4, Formulation::Standard),
    (ElementKind::Tri6, Formulation::Standard),
    (ElementKind::Quad8, Formulation::Standard),
    (ElementKind::Quad9, Formulation::Standard),
];

const EVERYTHING: &[(ElementKind, Formulation)] = &[
    (ElementKind::Quad4, Formulation::Standard),
    (ElementKind::Tri6, Formulation::Standard),
    (ElementKind::Quad8, Formulation::Standard),
    (ElementKind::Quad9, Formulation::Standard),
    (ElementKind::Quad4, Formulation::BBar),
    (ElementKind::Quad9, Formulation::BBar),
];

const PROJECTED: &[(ElementKind, Formulation)] = &[
    (ElementKind::Quad4, Formulation::BBar),
    (ElementKind::Tri6, Formulation::BBar),
    (ElementKind::Quad8, Formulation::BBar),
    (ElementKind::Quad9, Formulation::BBar),
];

const VARIANTS: [Variant; 3] = [
    Variant {
        name: "plane stress",
        space: Idealisation::PlaneStress,
        young: 1.0,
        poisson: 1.0 / 3.0,
        force: 1.0,
        reference: [25.18939, 23.967741],
        uncertainty: [2e-5, 3e-6],
        elements: STANDARD,
    },
    Variant {
        name: "plane strain, nu = 0.3",
        space: Idealisation::PlaneStrain,
        young: 250.0,
        poisson: 0.3,
        force: 100.0,
        reference: [9.22269, 8.778007],
        uncertainty: [1e-5, 3e-6],
        elements: EVERYTHING,
    },
    Variant {
        name: "plane strain, nu = 0.4999",
        space: Idealisation::PlaneStrain,
        young: 250.0,
        poisson: 0.4999,
        force: 100.0,
        reference: [7.7713, 7.40477],
        uncertainty: [1e-4, 8e-5],
        elements: PROJECTED,
    },
];

/// Elements along an edge. Second-order elements with a mean pressure reach the order of the corner late: the regular part of
/// their error is of order 2 and initially as large as the singular part. They also use the finest mesh.
const SIZES: [usize; 5] = [8, 16, 32, 64, 128];

/// Elements along an edge, displacements at the two points, cost.
type Run = (usize, [f64; 2], Cost);

/// Mesh sizes used with an element.
fn sizes(
    variant: &Variant,
    (kind, formulation): (ElementKind, Formulation),
) -> Result<&'static [usize], CaseError> {
    let late = formulation.dilatation(kind, variant.space)? == Some(Dilatation::ConstantPressure);
    Ok(if late { &SIZES } else { &SIZES[..4] })
}

const SOURCE: &str = "high-order hp solution graded towards the corner, converged to the printed digits";

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for variant in &VARIANTS {
        converging(ledger, variant)?;
    }
    locking(ledger, &VARIANTS[2])
}

/// Smallest root λ of 4 κ sin²(λω) = (κ+1)² - 4 λ² sin²ω in (0, 1) \[-\]: displacements r^λ at a corner of angle ω between a clamped
/// and a free edge (Williams 1952). `None` without a root.
fn exponent(variant: &Variant, omega: f64) -> Option<f64> {
    let nu = variant.poisson;
    let kappa =
        if variant.space == Idealisation::PlaneStress { (3.0 - nu) / (1.0 + nu) } else { 3.0 - 4.0 * nu };
    let f = |l: f64| {
        4.0 * kappa * (l * omega).sin().powi(2) - (kappa + 1.0).powi(2) + 4.0 * (l * omega.sin()).powi(2)
    };
    let steps = 1000;
    let first = (1..=steps).map(|k| f64::from(k) / f64::from(steps)).find(|&l| f(l) >= 0.0)?;
    let (mut low, mut high) = (first - 1.0 / f64::from(steps), first);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if f(middle) < 0.0 { low = middle } else { high = middle }
    }
    Some(high)
}

/// Vertical displacement at (48, 60) and (48, 52).
fn tip(
    variant: &Variant,
    (kind, formulation): (ElementKind, Formulation),
    n: usize,
) -> Result<([f64; 2], Cost), CaseError> {
    let material = Elastic::new(variant.young, variant.poisson)?;
    let (result, cost) = Cost::measure(|| {
        let mesh = bodies::straight(bodies::unit_block(kind, [n; 2])?, |x| {
            [48.0 * x[0], 44.0 * x[0] + x[1] * (44.0 - 28.0 * x[0])]
        });
        let body = Body::new(mesh, &material, variant.space, formulation)?
            .fix("left", 0, 0.0)
            .fix("left", 1, 0.0)
            .load(&["right"], |point, t| t[1] = variant.force / 16.0 * point.normal[0]);
        let solved = body.solve()?;
        let at = |y: f64| body.at(&solved.u, [48.0, y])[1];
        Ok::<_, CaseError>(([at(60.0), at(52.0)], solved.work))
    });
    let (tip, work) = result?;
    Ok((tip, Cost { work: work.work, ..cost }))
}

fn converging(ledger: &mut Ledger, variant: &Variant) -> Result<(), CaseError> {
    let upper = (16.0_f64 / 48.0).atan() + std::f64::consts::FRAC_PI_2;
    let lower = std::f64::consts::FRAC_PI_2 - (44.0_f64 / 48.0).atan();
    let lambda = exponent(variant, upper).ok_or("the upper corner is not singular")?;
    let other = exponent(variant, lower);
    if other.is_some_and(|other| other <= lambda) {
        return Err("the lower corner is more singular than the upper one".into());
    }
    let other = other.map_or("none below 1".to_owned(), |other| format!("{other:.4}"));
    ledger.note(format!(
        "{}: lambda = {lambda:.4} at the corner (0, 44), so that the order is 2 lambda = {:.3}; at (0, 0): {other}",
        variant.name,
        2.0 * lambda
    ));
    let mut plot = Plot::xy(
        format!("Cook's membrane, {}: error at (48, 52)", variant.name),
        "1/n",
        "relative error of the vertical displacement",
    )
    .log_log();
    for &element in variant.elements {
        let meshes = sizes(variant, element)?;
        let run = |&n: &usize| tip(variant, element, n).map(|(tip, cost)| (n, tip, cost));
        let runs = meshes.iter().map(run).collect::<Result<Vec<Run>, _>>()?;
        let name = format!("{}, {}, {}", variant.name, element.0.name(), element.1.name());
        let points = if cancels(variant, element) {
            relative(variant, &runs)
        } else {
            order(ledger, variant, &name, element, lambda, &runs)
        };
        plot = plot.series(Series::marked(format!("{}, {}", element.0.name(), element.1.name()), &points));
        finest(ledger, variant, &name, element, lambda, &runs);
    }
    ledger.plot(plot);
    Ok(())
}

fn covers(variant: &Variant, (kind, formulation): (ElementKind, Formulation)) -> Vec<Capability> {
    let mut covers = vec![capability(kind), Capability::Loads];
    covers.push(match variant.space {
        Idealisation::PlaneStress => Capability::PlaneStress,
        _ => Capability::PlaneStrain,
    });
    if formulation == Formulation::BBar {
        covers.push(Capability::NearlyIncompressible);
    }
    covers
}

/// True if the regular and the singular part of the error at (48, 52) have opposite signs and cancel on one of the meshes: then
/// neither an order nor an extrapolation from two meshes is meaningful there.
fn cancels(variant: &Variant, element: (ElementKind, Formulation)) -> bool {
    variant.poisson > 0.49 && element == (ElementKind::Quad8, Formulation::BBar)
}

/// Element size and relative error at (48, 52).
fn relative(variant: &Variant, runs: &[Run]) -> Vec<(f64, f64)> {
    let error = |tip: &[f64; 2]| (tip[1] / variant.reference[1] - 1.0).abs();
    runs.iter().map(|(n, tip, _)| (1.0 / *n as f64, error(tip))).collect()
}

/// Claims the order at (48, 52), where the reference is more accurate. Returns the points of the plot.
fn order(
    ledger: &mut Ledger,
    variant: &Variant,
    name: &str,
    element: (ElementKind, Formulation),
    lambda: f64,
    runs: &[Run],
) -> Vec<(f64, f64)> {
    let points = relative(variant, runs);
    let Some((n, _, cost)) = runs.last() else { return points };
    let n = *n as f64;
    let first_order = element.0.order() == 1;
    let mut draft = ledger
        .order(format!("displacement at (48, 52), {name}"))
        .norm("relative")
        .levels(&points)
        .expected(2.0 * lambda)
        .within(0.1);
    if first_order || element.1 == Formulation::BBar {
        draft = draft.or_better();
    }
    draft
        .evidence(Evidence::OtherCode, SOURCE)
        .because(
            "twice the exponent of the corner; from above, towards 2, where the regular part of the error, of order 2 with \
             a larger constant, still dominates (elements of first order, and a mean pressure)",
        )
        .finest(
            // Regular part of the error, of order h²: a beam in bending with n elements over its height.
            if first_order { 16.0 / (n * n) } else { n.powf(-2.0 * lambda) },
            "(h/L)^(2 lambda) with constant one for second order; for first order 16 (h/L)^2, the square of the aspect of \
             the panel in elements of its mean height, and the corner's part beside it",
        )
        .why_not_tighter("the constant of the corner's part is not known beforehand; one is the natural unit")
        .covers(&covers(variant, element))
        .cost(cost)
        .record();
    points
}

/// Claims both displacements, extrapolated with the theoretical order from the two finest meshes.
fn finest(
    ledger: &mut Ledger,
    variant: &Variant,
    name: &str,
    element: (ElementKind, Formulation),
    lambda: f64,
    runs: &[Run],
) {
    let [.., (_, coarse, _), (n, fine, cost)] = runs else { return };
    let ratio = 2.0_f64.powf(2.0 * lambda) - 1.0;
    let places = if cancels(variant, element) { 1 } else { 2 };
    for (k, place) in ["(48, 60)", "(48, 52)"].into_iter().enumerate().take(places) {
        let estimate = (fine[k] - coarse[k]).abs() / ratio;
        ledger
            .claim(format!("vertical displacement at {place}, {name}, {n} x {n}"))
            .value(fine[k])
            .equals(variant.reference[k])
            .absolute(1.5 * estimate + variant.uncertainty[k])
            .uncertainty(variant.uncertainty[k])
            .evidence(Evidence::OtherCode, SOURCE)
            .because(
                "1.5 times the error estimated from the two finest meshes with the order of the corner, and the \
                 uncertainty of the reference: no look at the reference",
            )
            .covers(&covers(variant, element))
            .cost(cost)
            .record();
    }
}

/// The membrane as a test of locking.
fn locking(ledger: &mut Ledger, variant: &Variant) -> Result<(), CaseError> {
    let (b_bar, cost) = tip(variant, (ElementKind::Quad4, Formulation::BBar), 16)?;
    ledger
        .claim("vertical displacement at (48, 60), nu = 0.4999, quad4 with B-bar, 16 x 16")
        .value(b_bar[0])
        .at_least(7.3)
        .evidence(Evidence::OtherCode, SOURCE)
        .because("the converged 7.77 less 6 %: what elements without locking reach on this mesh")
        .covers(&[Capability::NearlyIncompressible, Capability::Quadrilaterals])
        .cost(&cost)
        .record();
    let (standard, cost) = tip(variant, (ElementKind::Quad4, Formulation::Standard), 16)?;
    ledger
        .claim("vertical displacement at (48, 60), nu = 0.4999, standard quad4, 16 x 16")
        .value(standard[0])
        .equals(2.31)
        .absolute(0.005)
        .evidence(Evidence::OtherCode, "the same discretisation in another program, three digits")
        .because("control: the standard element locks; half a unit of the last printed digit")
        .covers(&[Capability::NearlyIncompressible, Capability::Quadrilaterals])
        .cost(&cost)
        .record();
    Ok(())
}
