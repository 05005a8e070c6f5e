//! Orders, constants and cost of every element; nearly incompressible bodies.

mod fields;
mod locking;

use super::bodies::{self, Body, Field, Level, Orders, Shape};
use super::bodies_patch::{capability, variants};
use crate::cases::body_plots;
use crate::{Capability, Case, CaseError, Evidence, Ledger, Plot, Series};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Dilatation, Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use fields::{Round, Waves};

/// See the README.
pub const CASE: Case = Case {
    name: "bodies_convergence",
    readme: include_str!("README.md"),
    covers: &[Capability::PlaneStrain, Capability::Solid3d],
    quick: true,
    run,
};

const YOUNG: f64 = 2.5;

/// Capability that an idealisation covers.
fn space_capability(space: Idealisation) -> Capability {
    match space {
        Idealisation::PlaneStrain => Capability::PlaneStrain,
        Idealisation::PlaneStress => Capability::PlaneStress,
        Idealisation::Axisymmetric => Capability::Axisymmetric,
        Idealisation::Antiplane => Capability::Antiplane,
        Idealisation::ThreeD => Capability::Solid3d,
    }
}

fn is_serendipity(kind: ElementKind) -> bool {
    matches!(kind, ElementKind::Quad8 | ElementKind::Hex20 | ElementKind::Wedge15)
}

/// Plots of error against unknowns and against wall time, in 2D and 3D.
struct Plots {
    unknowns: [Plot; 2],
    wall: [Plot; 2],
}

impl Plots {
    fn new() -> Self {
        let both = |make: &dyn Fn(&str) -> Plot| [make("in plane strain"), make("in space")];
        let error = "relative error of the displacement gradient, H1";
        Self {
            unknowns: both(&|d| {
                Plot::work_precision(format!("Elements {d}: error and unknowns"), error, "unknowns")
            }),
            wall: both(&|d| {
                Plot::work_precision(
                    format!("Elements {d}: error and time"),
                    error,
                    "wall time of stiffness, factorisation and solution [s]",
                )
            }),
        }
    }

    fn add(&mut self, name: &str, dimension: usize, levels: &[Level]) {
        let wall = |l: &Level| l.cost.wall.unwrap_or(0.0);
        let unknowns: Vec<_> = levels.iter().map(|l| (l.errors[1], l.unknowns as f64)).collect();
        let walls: Vec<_> = levels.iter().map(|l| (l.errors[1], wall(l))).collect();
        for (plots, points) in [(&mut self.unknowns, unknowns), (&mut self.wall, walls)] {
            let plot = &mut plots[dimension - 2];
            plot.series.push(Series::marked(name, &points));
        }
    }
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut plots = Plots::new();
    for kind in ElementKind::ALL {
        for variant in variants(kind) {
            let shape = if is_serendipity(kind) { Shape::Sheared } else { Shape::Crooked };
            one(ledger, &mut plots, kind, variant, shape)?;
        }
        if is_serendipity(kind) {
            let variant = (Idealisation::from_dimension(kind.dimension()), Formulation::Standard);
            one(ledger, &mut plots, kind, variant, Shape::Crooked)?;
        }
    }
    plots.unknowns.into_iter().chain(plots.wall).for_each(|plot| ledger.plot(plot));
    let material = Elastic::new(YOUNG, 0.3)?;
    let field = Waves::general(&material, Idealisation::PlaneStrain);
    let mesh = bodies::distorted(ElementKind::Quad9, 16, Shape::Crooked, [0.0; 2])?;
    let body = Body::new(mesh, &material, Idealisation::PlaneStrain, Formulation::Standard)?;
    let body = body.hold_all(&field).weigh(&field);
    body_plots::displacement(
        ledger,
        "Plane strain, quad9, crooked mesh",
        &body.mesh,
        &body.solve()?.u,
        false,
    )?;
    locking::run(ledger)
}

fn one(
    ledger: &mut Ledger,
    plots: &mut Plots,
    kind: ElementKind,
    variant: (Idealisation, Formulation),
    shape: Shape,
) -> Result<(), CaseError> {
    let material = Elastic::new(YOUNG, 0.3)?;
    let (space, formulation) = variant;
    let levels = if kind.dimension() == 2 {
        let field: Box<dyn Field<2>> = match space {
            Idealisation::Axisymmetric => Box::new(Round::new(&material)),
            _ => Box::new(Waves::general(&material, space)),
        };
        study::<2>(&*field, kind, variant, shape)?
    } else {
        study::<3>(&Waves::general(&material, space), kind, variant, shape)?
    };
    let mesh = if shape == Shape::Crooked { "crooked" } else { "sheared" };
    let name = format!("{}, {}, {}, {mesh} mesh", kind.name(), space.name(), formulation.name());
    bodies::claim(ledger, &name, &levels, &orders(kind, variant, shape)?);
    if matches!(space, Idealisation::PlaneStrain | Idealisation::ThreeD) && shape == Shape::Crooked {
        plots.add(&format!("{}, {}", kind.name(), formulation.name()), kind.dimension(), &levels);
    }
    Ok(())
}

fn study<const D: usize>(
    field: &dyn Field<D>,
    kind: ElementKind,
    variant: (Idealisation, Formulation),
    shape: Shape,
) -> Result<Vec<Level>, CaseError> {
    let material = Elastic::new(YOUNG, 0.3)?;
    let (space, formulation) = variant;
    let mean_pressure = formulation.dilatation(kind, space)? == Some(Dilatation::ConstantPressure);
    let sizes = match (D, kind.order()) {
        (2, 1) => [12, 24, 48],
        (2, _) => [6, 12, 24],
        // With a mean pressure and no nodes inside their faces, these elements reach their order late.
        (_, 2) if mean_pressure => [6, 9, 13],
        (_, 1) => [5, 8, 12],
        _ => [4, 6, 9],
    };
    let at = |n: usize| {
        bodies::level(1.0 / n as f64, kind, variant, field, |kind, formulation| {
            let mesh = bodies::distorted(kind, n, shape, [0.0; D])?;
            Ok(Body::new(mesh, &material, variant.0, formulation)?.hold_all(field).weigh(field))
        })
    };
    sizes.into_iter().map(at).collect()
}

/// Theoretical orders.
fn orders(
    kind: ElementKind,
    (space, formulation): (Idealisation, Formulation),
    shape: Shape,
) -> Result<Orders, CaseError> {
    let p = kind.order() as f64;
    let mean_pressure = formulation.dilatation(kind, space)? == Some(Dilatation::ConstantPressure);
    let lost = is_serendipity(kind) && shape == Shape::Crooked;
    let (expected, or_better, because) = if mean_pressure {
        (
            [2.0, 1.0],
            true,
            "one mean pressure a cell is of first order (Boffi, Brezzi, Fortin 2013); from above, since at nu = 0.3 the \
             deviator, which keeps its order, carries a share of the error",
        )
    } else if lost {
        (
            [2.0, 1.0],
            true,
            "on cells that do not become parallelograms the space holds linear polynomials only (Arnold, Boffi, Falk \
             2002); from above, since what it lacks is a small share of the error of coarse meshes",
        )
    } else {
        ([p + 1.0, p], false, "complete polynomials of the element's order on every cell: p + 1 and p")
    };
    Ok(Orders {
        expected,
        within: [0.1, 0.1],
        or_better,
        loaded: false,
        because: because.into(),
        covers: vec![space_capability(space), capability(kind)],
        evidence: (Evidence::Manufactured, "waves; u_r = r^3 sin 2z, u_z = r^2 cos 2z about an axis"),
    })
}
