//! A hub pressed into a rim, and a ball into a shell (Lamé), on unequal faces of second order with friction.

use super::body_plots;
use super::texts::{BodyRun, simulate_in};
use crate::{Capability, Case, CaseError, Evidence, Ledger, Plot, Series};
use asperity_vary::Change::{self, With, Without};
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "press_fit",
    readme: include_str!("README.md"),
    covers: &[
        Capability::Mortar,
        Capability::Coulomb,
        Capability::QuadraticSolids,
        Capability::Triangles,
        Capability::Axisymmetric,
    ],
    quick: true,
    run,
};

/// Radii of the bore, of hub and rim where they meet, and outside \[m\].
const RADII: [f64; 4] = [0.2, 0.4004, 0.4, 0.8];
const YOUNG: f64 = 200e9;
const POISSON: f64 = 0.3;
const PENALTY: f64 = 1e15;
const LAME: &str = "Lamé's rings and hollow balls, the penalty included";

/// Meshes of a dimension.
struct Meshes {
    name: &'static str,
    file: &'static str,
    /// Sizes of the cells of the hub \[m\].
    sizes: [f64; 3],
    changes: &'static [Change<'static>],
    /// Displacements of hub and rim towards each other under a unit pressure \[m/Pa\].
    yielding: fn() -> [f64; 2],
    /// Bound of the error of the mean pressure on the finest mesh.
    mean: f64,
    /// Bounds of the scatter of pressure and of shear on the finest mesh, in small and in finite sliding.
    local: [[f64; 2]; 2],
}

/// Changes of the scene for a section of hub and rim.
const fn section(kinematics: &'static str) -> [Change<'static>; 5] {
    [
        With("kinematics", kinematics),
        Without("stages[0].conditions[7]"),
        Without("stages[0].conditions[6]"),
        Without("stages[0].conditions[5]"),
        Without("stages[0].conditions[4]"),
    ]
}

const PLANE: Meshes = Meshes {
    name: "tri6",
    file: "plane",
    sizes: [0.08, 0.04, 0.02],
    changes: &section("plane-strain"),
    yielding: rings,
    mean: 2e-4,
    local: [[2e-2, 1e-2], [3e-3, 2e-3]],
};

const AXIS: Meshes = Meshes {
    name: "tri6 about the axis",
    changes: &section("axisymmetric"),
    yielding: balls,
    local: [[2e-2, 1.2e-2], [3e-3, 6e-3]],
    ..PLANE
};

const SPACE: Meshes = Meshes {
    name: "tet10",
    file: "space",
    sizes: [0.08, 0.05, 0.03],
    changes: &[],
    yielding: rings,
    mean: 4e-4,
    local: [[2e-2, 1e-2], [6e-3, 6e-3]],
};

/// Limit of the pressure in one kind of sliding.
struct Sliding {
    name: &'static str,
    order: f64,
    because: &'static str,
}

const SLIDING: [Sliding; 2] = [
    Sliding {
        name: "small",
        order: 1.0,
        because: "pairs found along the normals of facets are off by δ h/(2 R) along the surface once the overlap δ has closed, and \
                  their gaps by δ (h/R)^2/12; with a stiffness E/h that is a share h/(4 R) of the pressure",
    },
    Sliding {
        name: "finite",
        order: 2.0,
        because: "averages over the facets beside a node, of h^2, and gaps h^4/(384 R^3) of faces from the arc, stiffness E/h",
    },
];

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut rows = Vec::new();
    let mut plot = Plot::xy("Error of the pressure", "size of the hub's cells [m]", "relative, L2").log_log();
    for meshes in [&PLANE, &AXIS, &SPACE] {
        let exact = pressure(meshes);
        for (sliding, local) in SLIDING.iter().zip(&meshes.local) {
            let mut fits = Vec::new();
            for (number, &size) in (1..).zip(&meshes.sizes) {
                let fit = Fit::new(meshes, number, sliding.name, exact)?;
                rows.push(fit.row(meshes.name, sliding.name, size));
                fits.push((size, fit));
            }
            let errors: Vec<(f64, f64)> = fits.iter().map(|(size, fit)| (*size, fit.scatter)).collect();
            plot = plot.series(Series::marked(format!("{}, {} sliding", meshes.name, sliding.name), &errors));
            claim(ledger, (meshes, local), sliding, &fits, exact);
            if let Some((_, fit)) = fits.first().filter(|_| rows.len() == fits.len()) {
                let picture = body_plots::recorded(&fit.done.record, "press")?;
                ledger.picture("Hub and rim", picture, "Mises stress, tri6, small sliding, coarsest mesh.");
            }
        }
    }
    ledger.plot(plot);
    let head = ["elements", "sliding", "h [m]", "mean", "L2", "shear", "slipping", "iterations"];
    ledger.table("errors of the pressure, and shear, over the exact pressure", &head, rows);
    let [hub, ball] = [&PLANE, &AXIS].map(|meshes| 1e-6 * pressure(meshes));
    ledger.note(format!("Exact pressure on the hub: {hub:.4} MPa; on the ball: {ball:.4} MPa."));
    Ok(())
}

/// Pressure on the hub \[Pa\]: the displacements of hub and rim and that of the penalty are the overlap.
fn pressure(meshes: &Meshes) -> f64 {
    let [_, hub, rim, _] = RADII;
    let [inward, outward] = (meshes.yielding)();
    (hub - rim) / (inward + outward + PENALTY.recip())
}

/// Rings in plane strain. The force of the hub acts on the smaller radius of the rim.
fn rings() -> [f64; 2] {
    let [bore, hub, rim, outside] = RADII;
    let (modulus, poisson) = (YOUNG / (1.0 - POISSON * POISSON), POISSON / (1.0 - POISSON));
    let ratio = |inner: f64, outer: f64| (outer * outer + inner * inner) / (outer * outer - inner * inner);
    [hub / modulus * (ratio(bore, hub) - poisson), hub / modulus * (ratio(rim, outside) + poisson)]
}

/// Hollow balls. The force of the inner one acts on the smaller area of the outer one.
fn balls() -> [f64; 2] {
    let [bore, hub, rim, outside] = RADII;
    let (linear, inverse) = (1.0 - 2.0 * POISSON, 0.5 * (1.0 + POISSON));
    let strain = |loaded: f64, free: f64| {
        let (loaded, free) = (loaded.powi(3), free.powi(3));
        (linear * loaded + inverse * free) / (YOUNG * (free - loaded).abs())
    };
    [hub * strain(hub, bore), hub * hub / rim * strain(rim, outside)]
}

/// Errors over the exact pressure.
struct Fit {
    mean: f64,
    scatter: f64,
    /// Largest mean shear traction.
    shear: f64,
    /// Points that slip.
    slipping: u64,
    done: BodyRun,
}

impl Fit {
    fn new(meshes: &Meshes, number: usize, sliding: &str, exact: f64) -> Result<Self, CaseError> {
        let file = format!("{}_{number}.msh", meshes.file);
        let scene = SceneText::new(include_str!("scene.toml"))
            .changed(meshes.changes)
            .with_or_same("bodies.hub.mesh.gmsh.file", file.as_str())
            .with_or_same("bodies.rim.mesh.gmsh.file", file.as_str())
            .with_or_same("interfaces.fit.sliding", sliding);
        let done = simulate_in(&scene.text()?, "press_fit")?;
        let end = done.record.stage_end("press").ok_or("the stage was not reached")?;
        let fields = &end.interfaces[0];
        let (mut area, mut mean, mut square) = (0.0, 0.0, 0.0);
        for (a, p) in done.record.setup().interfaces[0].areas.iter().zip(&fields.mean_normal_traction) {
            let error = p / exact - 1.0;
            area += a;
            mean += a * error;
            square += a * error * error;
        }
        let largest = |v: &[f64]| v.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        Ok(Self {
            mean: mean / area,
            scatter: (square / area).sqrt(),
            shear: largest(&fields.mean_shear_traction) / exact,
            slipping: fields.status.iter().filter(|status| **status == 2).count() as u64,
            done,
        })
    }

    fn row(&self, elements: &str, sliding: &str, size: f64) -> [String; 8] {
        [
            elements.to_owned(),
            sliding.to_owned(),
            format!("{size}"),
            format!("{:+.1e}", self.mean),
            format!("{:.1e}", self.scatter),
            format!("{:.1e}", self.shear),
            format!("{}", self.slipping),
            format!("{}", self.done.report.counts.operations.iterations),
        ]
    }
}

fn claim(
    ledger: &mut Ledger,
    (meshes, [scatter, shear]): (&Meshes, &[f64; 2]),
    sliding: &Sliding,
    fits: &[(f64, Fit)],
    exact: f64,
) {
    let Some((_, finest)) = fits.last() else { return };
    let covers = [Capability::Mortar, Capability::Coulomb];
    let what = format!("{}, {} sliding", meshes.name, sliding.name);
    let still = "hub and rim approach along their normals";
    ledger
        .claim(format!("mean pressure, {what}, finest mesh"))
        .unit("MPa")
        .value(exact * (1.0 + finest.mean) * 1e-6)
        .equals(exact * 1e-6)
        .relative(meshes.mean)
        .evidence(Evidence::Exact, LAME)
        .because(
            "a few times the mean gap h^4/(720 R^3) of faces of second order from the arc, over the overlap",
        )
        .why_not_tighter("faces are of unequal size")
        .covers(&covers)
        .cost(&finest.done.cost)
        .record();
    let levels: Vec<(f64, f64)> = fits.iter().map(|(size, fit)| (*size, fit.scatter)).collect();
    ledger
        .order(format!("pressure, {what}, relative in L2"))
        .levels(&levels)
        .expected(sliding.order)
        .within(0.2)
        .or_better()
        .finest(*scatter, "that share on the finest mesh, two or three times for unequal faces")
        .because(sliding.because)
        .why_not_tighter("meshes of Gmsh are not refinements of each other")
        .evidence(Evidence::Exact, LAME)
        .covers(&covers)
        .record();
    ledger
        .claim(format!("largest mean shear traction over the pressure, {what}, finest mesh"))
        .value(finest.shear)
        .at_most(*shear)
        .evidence(Evidence::Exact, still)
        .because("the same gaps, which differ from node to node, and normals of faces of second order, good to (h/R)^2/12")
        .covers(&covers)
        .record();
    ledger
        .claim(format!("points that slip, {what}, all meshes"))
        .count(fits.iter().map(|(_, fit)| fit.slipping).sum(), 0)
        .evidence(Evidence::Exact, still)
        .because("friction would allow 30 % of the pressure")
        .covers(&covers)
        .record();
}
