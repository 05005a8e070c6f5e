//! Thick-walled elastic cylinder and sphere under an inner pressure; a ring that starts with a stress.

mod prestress;

use super::bodies::{self, Body, Field, Level, Orders};
use super::bodies_patch::capability;
use crate::cases::body_plots;
use crate::{Capability, Case, CaseError, Evidence, Ledger, Plot, Series};
use asperity_fem::block::FieldValue;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// See the README.
pub const CASE: Case = Case {
    name: "lame_cylinder",
    readme: include_str!("README.md"),
    covers: &[Capability::PlaneStrain, Capability::Axisymmetric, Capability::Solid3d, Capability::Loads],
    quick: true,
    run,
};

const YOUNG: f64 = 2.5;
const POISSON: f64 = 0.3;
const PRESSURE: f64 = 0.01;
/// Inner and outer radius.
const A: f64 = 1.0;
const B: f64 = 2.0;

/// u = x g with g = a + b ρ^-m, ρ² the sum of squares of the first `along` coordinates; other components are zero.
struct Radial {
    a: f64,
    b: f64,
    m: i32,
    along: usize,
}

impl Radial {
    /// Lamé's cylinder, with its radius in the first `along` coordinates.
    fn cylinder(along: usize) -> Self {
        let c = (1.0 + POISSON) * PRESSURE * A * A / (YOUNG * (B * B - A * A));
        Self { a: c * (1.0 - 2.0 * POISSON), b: c * B * B, m: 2, along }
    }

    /// Lamé's sphere.
    fn sphere(along: usize) -> Self {
        let c = PRESSURE * A.powi(3) / (YOUNG * (B.powi(3) - A.powi(3)));
        let b = 0.5 * (1.0 + POISSON) * c * B.powi(3);
        Self { a: c * (1.0 - 2.0 * POISSON), b, m: 3, along }
    }
}

impl<const D: usize> Field<D> for Radial {
    fn at(&self, x: &[f64; D]) -> FieldValue {
        let radius = x[..self.along].iter().map(|x| x * x).sum::<f64>().sqrt();
        let g = self.a + self.b * radius.powi(-self.m);
        let slope = -f64::from(self.m) * self.b * radius.powi(-self.m - 1);
        let (mut u, mut h) = ([0.0; 3], [[0.0; 3]; 3]);
        for i in 0..self.along {
            u[i] = x[i] * g;
            for j in 0..self.along {
                h[i][j] = x[i] * x[j] * slope / radius + if i == j { g } else { 0.0 };
            }
        }
        (u, h)
    }
}

/// Maps the unit square to a quarter ring. Positions on the axes are exact.
fn polar(x: &[f64; 2]) -> [f64; 2] {
    let r = A + (B - A) * x[0];
    let (sine, cosine) = (FRAC_PI_2 * x[1]).sin_cos();
    [if x[1] == 1.0 { 0.0 } else { r * cosine }, r * sine]
}

/// Maps the unit cube to a sector of a shell, with directions (1, tan α, tan β), 0 < α, β < π/4.
fn shell(x: &[f64; 3]) -> [f64; 3] {
    let direction = [1.0, (FRAC_PI_4 * x[1]).tan(), (FRAC_PI_4 * x[2]).tan()];
    let length = direction.iter().map(|d| d * d).sum::<f64>().sqrt();
    direction.map(|d| (A + (B - A) * x[0]) * d / length)
}

/// Applies the pressure on the inner surface.
fn pressed<const D: usize>(body: Body<D>) -> Body<D> {
    // The normal points out of the body, into the hole.
    body.load(&["left"], |point, t| t.iter_mut().zip(&point.normal).for_each(|(t, n)| *t = -PRESSURE * n))
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    use ElementKind::{Hex8, Hex20, Hex27, Quad4, Quad8, Quad9, Tri3, Tri6, Wedge15};
    let mut plot =
        Plot::xy("Thick-walled bodies", "unknowns", "relative error of the displacement, L2").log_log();
    for kind in [Tri3, Quad4, Tri6, Quad8, Quad9] {
        let levels = study(
            &Radial::cylinder(2),
            kind,
            Idealisation::PlaneStrain,
            |kind, n, formulation, material| {
                let mesh = bodies::mapped(bodies::unit_block(kind, [n, n + n / 2])?, polar);
                let body = Body::new(mesh, material, Idealisation::PlaneStrain, formulation)?;
                Ok(pressed(body).fix("bottom", 1, 0.0).fix("top", 0, 0.0))
            },
        )?;
        plot = enter(ledger, plot, ("cylinder, plane strain", Capability::PlaneStrain), kind, &levels);
    }
    for kind in [Quad4, Quad9] {
        let space = Idealisation::Axisymmetric;
        let levels = study(&Radial::cylinder(1), kind, space, |kind, n, formulation, material| {
            let mesh = bodies::mapped(bodies::unit_block(kind, [n, 2])?, |x| [x[0] + A, 0.25 * x[1]]);
            let body = Body::new(mesh, material, space, formulation)?;
            Ok(pressed(body).fix("bottom", 1, 0.0).fix("top", 1, 0.0))
        })?;
        plot = enter(ledger, plot, ("cylinder about its axis", Capability::Axisymmetric), kind, &levels);
    }
    for kind in [Quad4, Tri6, Quad9] {
        let space = Idealisation::Axisymmetric;
        let levels = study(&Radial::sphere(2), kind, space, |kind, n, formulation, material| {
            let mesh = bodies::mapped(bodies::unit_block(kind, [n, n + n / 2])?, polar);
            let body = Body::new(mesh, material, space, formulation)?;
            Ok(pressed(body).fix("bottom", 1, 0.0).fix("top", 0, 0.0))
        })?;
        plot = enter(ledger, plot, ("sphere about its axis", Capability::Axisymmetric), kind, &levels);
    }
    for kind in [Hex8, Hex20, Hex27, Wedge15] {
        let field = Radial::sphere(3);
        let levels = study(&field, kind, Idealisation::ThreeD, |kind, n, formulation, material| {
            let mesh = bodies::mapped(bodies::unit_block(kind, [n; 3])?, shell);
            let body = Body::new(mesh, material, Idealisation::ThreeD, formulation)?;
            Ok(pressed(body).hold(&["top", "front"], &field).fix("bottom", 1, 0.0).fix("back", 2, 0.0))
        })?;
        plot = enter(ledger, plot, ("sphere in space", Capability::Solid3d), kind, &levels);
    }
    ledger.plot(plot);
    let mesh = bodies::mapped(bodies::unit_block(Quad9, [8, 12])?, polar);
    let material = Elastic::new(YOUNG, POISSON)?;
    let body = pressed(Body::new(mesh, &material, Idealisation::PlaneStrain, Formulation::Standard)?);
    let body = body.fix("bottom", 1, 0.0).fix("top", 0, 0.0);
    body_plots::displacement(ledger, "Cylinder in plane strain", &body.mesh, &body.solve()?.u, false)?;
    prestress::claims(ledger)
}

fn study<const D: usize>(
    field: &Radial,
    kind: ElementKind,
    space: Idealisation,
    build: impl Fn(ElementKind, usize, Formulation, &Elastic) -> Result<Body<D>, CaseError>,
) -> Result<Vec<Level>, CaseError> {
    let material = Elastic::new(YOUNG, POISSON)?;
    let sizes = match (D, kind.order()) {
        (2, 1) => [12, 24, 48],
        (2, _) => [16, 32, 64],
        (_, 1) => [4, 8, 16],
        _ => [4, 7, 11],
    };
    let one = |n: usize| {
        bodies::level(1.0 / n as f64, kind, (space, Formulation::Standard), field, |kind, formulation| {
            build(kind, n, formulation, &material)
        })
    };
    sizes.into_iter().map(one).collect()
}

fn enter(
    ledger: &mut Ledger,
    plot: Plot,
    (name, covers): (&str, Capability),
    kind: ElementKind,
    levels: &[Level],
) -> Plot {
    let p = kind.order() as f64;
    let name = format!("{name}, {}", kind.name());
    let orders = Orders {
        expected: [p + 1.0, p],
        within: [0.1, 0.1],
        or_better: false,
        loaded: true,
        because: "polar meshes follow a smooth map, so that isoparametric elements keep their full order \
                  (Ciarlet and Raviart)"
            .into(),
        covers: vec![covers, capability(kind), Capability::Loads],
        evidence: (Evidence::Exact, "Lame: u_r = A r + B/r^m"),
    };
    bodies::claim(ledger, &name, levels, &orders);
    let points: Vec<(f64, f64)> = levels.iter().map(|l| (l.unknowns as f64, l.errors[0])).collect();
    plot.series(Series::marked(name, &points))
}
