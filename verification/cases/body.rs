//! Common tools of the nonlinear-body cases: meshes, one block with its displacements, implicit and forward steps.

use crate::CaseError;
use asperity_fem::assembly::{Storage, Symmetry, System};
use asperity_fem::dof::Constraints;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::material::hardening::Hardening;
use asperity_fem::material::j2::J2;
use asperity_fem::mesh::generate::{Block as Box, Grading};
use asperity_fem::mesh::{Mesh, nodes_of_sides};
use asperity_fem::nonlinear::{Block, Kinematics, Limits, Material, Model};
use asperity_fem::surface;
use asperity_fem::term::{ForwardTerm, Fraction, Instant, Linearized, Pattern, Refusal, Term};
use serde::Serialize;
use std::f64::consts::FRAC_PI_2;

/// A degree of freedom and its value: a displacement \[m\] or a force.
pub type Entry = (usize, f64);

/// A model with default limits and the standard formulation.
pub fn model(material: Material, idealisation: Idealisation, kinematics: Kinematics) -> Model {
    let formulation = Formulation::Standard;
    Model { material, idealisation, kinematics, formulation, limits: Limits::default() }
}

/// The same model with averaged dilatation.
pub fn averaged(model: Model) -> Model {
    Model { formulation: Formulation::BBar, ..model }
}

/// J2 plasticity.
pub fn j2(young: f64, poisson: f64, hardening: Hardening) -> Result<Material, CaseError> {
    Ok(Material::J2(J2::new(Elastic::new(young, poisson)?, hardening)))
}

/// A box of equal cells.
pub fn grid<const D: usize>(
    kind: ElementKind,
    min: [f64; D],
    max: [f64; D],
    divisions: [usize; D],
) -> Result<Mesh<D>, CaseError> {
    Ok(Box { min, max, divisions, grading: [Grading::Uniform; D], kind }.mesh()?)
}

/// Moves the interior nodes of a box of first-order cells by at most the fraction `share` of a cell, reproducibly.
pub fn distorted<const D: usize>(mut mesh: Mesh<D>, max: [f64; D], size: f64, share: f64) -> Mesh<D> {
    for (k, x) in mesh.nodes.iter_mut().enumerate() {
        // Positions on the boundary are exact: the generator gives 0 and the upper corner without rounding.
        if (0..D).all(|c| x[c] > 0.0 && x[c] < max[c]) {
            x.iter_mut().enumerate().for_each(|(c, x)| *x += share * size * ((5 * k + 7 * c) as f64).sin());
        }
    }
    mesh
}

/// A quarter of a ring: side sets left (inner), right (outer), bottom (y = 0), top (x = 0).
pub fn ring(kind: ElementKind, radii: [f64; 2], divisions: [usize; 2]) -> Result<Mesh<2>, CaseError> {
    let mut mesh = grid(kind, [radii[0], 0.0], [radii[1], FRAC_PI_2], divisions)?;
    for x in &mut mesh.nodes {
        let [r, angle] = *x;
        *x = [r * angle.cos(), r * angle.sin()];
    }
    Ok(mesh)
}

/// Nodes of a side set.
pub fn side<const D: usize>(mesh: &Mesh<D>, name: &str) -> Result<Vec<usize>, CaseError> {
    let sides = mesh.side_sets.get(name).ok_or_else(|| format!("no side set {name}"))?;
    Ok(nodes_of_sides(mesh, sides))
}

/// Nodal forces of a pressure of 1 on a side set.
pub fn unit_pressure(
    mesh: &Mesh<2>,
    name: &str,
    idealisation: Idealisation,
) -> Result<Vec<Entry>, CaseError> {
    let sides = mesh.side_sets.get(name).ok_or_else(|| format!("no side set {name}"))?;
    Ok(surface::integrate(mesh, sides, idealisation, |point, value| {
        value.iter_mut().zip(&point.normal).for_each(|(v, n)| *v = -n);
    }))
}

/// Nodal values of a displacement field.
pub fn field<const D: usize>(mesh: &Mesh<D>, f: impl Fn([f64; D]) -> [f64; D]) -> Vec<f64> {
    mesh.nodes.iter().flat_map(|&x| f(x)).collect()
}

/// Displacement of a rotation in the plane by `angle`.
pub fn turned(angle: f64, [x, y]: [f64; 2]) -> [f64; 2] {
    let (s, c) = angle.sin_cos();
    [c * x - s * y - x, s * x + c * y - y]
}

/// R σ Rᵀ of a rotation in the plane, for xx, yy, zz, xy, yz, zx.
pub fn turned_stress(angle: f64, s: &[f64; 6]) -> [f64; 6] {
    let (sin, cos) = angle.sin_cos();
    let (mean, half, shear) = (0.5 * (s[0] + s[1]), 0.5 * (s[0] - s[1]), s[3]);
    let (c2, s2) = (cos * cos - sin * sin, 2.0 * sin * cos);
    let (a, b) = (half * c2 - shear * s2, half * s2 + shear * c2);
    [mean + a, mean - a, s[2], b, cos * s[4] + sin * s[5], cos * s[5] - sin * s[4]]
}

/// Largest difference of components over all points.
pub fn largest_difference(found: &[[f64; 6]], exact: &[f64; 6]) -> f64 {
    let differences = found.iter().flat_map(|s| s.iter().zip(exact).map(|(a, b)| (a - b).abs()));
    // Keep a NaN.
    differences.fold(0.0, |m, d| if d.is_nan() || d > m { d } else { m })
}

/// Computational work.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Work {
    /// Steps.
    pub steps: u64,
    /// Residuals of the block.
    pub residuals: u64,
    /// Tangents of the block.
    pub tangents: u64,
    /// Numeric factorisations.
    pub factorisations: u64,
}

/// End of a forward step.
#[derive(Clone, Debug, PartialEq)]
pub struct Forward {
    /// Fraction of the step taken.
    pub fraction: f64,
    /// The limit that determined the fraction.
    pub limit: Option<Fraction>,
}

/// Maximum of Newton iterations; fewer than ten are needed where it converges.
const MOST_ITERATIONS: usize = 40;
/// Maximum of passes to find the fraction of a forward step, whose constant forces do not scale with it.
const MOST_PASSES: usize = 6;
/// A fraction this close to 1 counts as the whole step.
const WHOLE: f64 = 1e-12;
/// Systems up to this size are factored as dense matrices.
const DENSE: usize = 150;

/// One block, its displacements and its system.
#[derive(Debug)]
pub struct Body<const D: usize> {
    /// Mesh in the reference configuration.
    pub mesh: Mesh<D>,
    /// The block.
    pub block: Block<D>,
    /// Displacements at the end of the last step \[m\].
    pub u: Vec<f64>,
    /// Computational work so far.
    pub work: Work,
    /// Time at the end of the last step \[s\].
    pub time: f64,
    /// True if a forward step corrects the force that the previous step left unbalanced.
    pub carry: bool,
    /// Unbalanced forces after the last forward step: forces of the block less the loads, if carried.
    left: Vec<f64>,
    /// Accumulated loads of all forward steps.
    loaded: Vec<f64>,
    pattern: Pattern,
    system: System,
}

impl<const D: usize> Body<D> {
    /// A body at rest with the degrees of freedom `fixed` prescribed.
    pub fn new(mesh: Mesh<D>, model: Model, fixed: &[usize]) -> Result<Self, CaseError> {
        let dofs = mesh.nodes.len() * model.idealisation.components();
        // Tangents of small-strain materials are symmetric and positive definite below the limit load.
        let symmetry =
            if model.kinematics == Kinematics::Small { Symmetry::Positive } else { Symmetry::General };
        let block = Block::new(&mesh, 0, model)?;
        let mut fixed = fixed.to_vec();
        fixed.sort_unstable();
        fixed.dedup();
        let equations = Constraints { fixed, channels: Vec::new() }.equations(dofs);
        let storage = if equations.free.len() <= DENSE { Storage::Dense } else { Storage::Sparse };
        let system = System::new(equations, storage).with_symmetry(symmetry);
        let pattern = block.pattern().clone();
        let work = Work::default();
        let (carry, left, loaded) = (false, vec![0.0; dofs], vec![0.0; dofs]);
        Ok(Self { mesh, block, u: vec![0.0; dofs], work, time: 0.0, carry, left, loaded, pattern, system })
    }

    /// Forces of the block at displacements `u`.
    pub fn forces(&mut self, u: &[f64], dt: f64) -> Result<Vec<f64>, Refusal> {
        self.work.residuals += 1;
        let mut r = vec![0.0; u.len()];
        self.block.residual(u, Instant { time: self.time + dt, dt }, &mut r)?;
        Ok(r)
    }

    /// A step in which every displacement is prescribed; returns the forces.
    pub fn follow(&mut self, u: Vec<f64>, dt: f64) -> Result<Vec<f64>, CaseError> {
        let r = self.forces(&u, dt).map_err(|refusal| refusal.to_string())?;
        self.accept(u, dt);
        Ok(r)
    }

    fn accept(&mut self, u: Vec<f64>, dt: f64) {
        self.block.accept();
        self.u = u;
        self.time += dt;
        self.work.steps += 1;
    }

    /// A step of length `dt` with Newton's method to `prescribed` displacements under the nodal forces `load`, until no
    /// unbalanced force on a free degree of freedom is larger than `tolerance`; returns the forces. The first iterate is `guess`
    /// or else the linear prediction.
    pub fn implicit(
        &mut self,
        prescribed: &[Entry],
        load: &[Entry],
        dt: f64,
        tolerance: f64,
        guess: Option<Vec<f64>>,
    ) -> Result<Vec<f64>, CaseError> {
        let mut u = match guess {
            Some(u) => u,
            None => self.predicted(prescribed, load, dt)?,
        };
        prescribed.iter().for_each(|&(dof, value)| u[dof] = value);
        for _ in 0..MOST_ITERATIONS {
            let r = self.forces(&u, dt).map_err(|refusal| refusal.to_string())?;
            let rhs = self.unbalanced(&r, load);
            let largest = rhs.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            if largest <= tolerance {
                self.accept(u, dt);
                return Ok(r);
            }
            let values = self.tangent();
            let du = self.solve(&values, rhs)?;
            self.system.equations().free.iter().zip(du).for_each(|(&d, x)| u[d] += x);
        }
        Err(format!("Newton's method did not converge at time {}", self.time + dt).into())
    }

    /// The linear prediction of a step.
    fn predicted(&mut self, prescribed: &[Entry], load: &[Entry], dt: f64) -> Result<Vec<f64>, CaseError> {
        let mut u = self.u.clone();
        let start = u.clone();
        let r = self.forces(&start, dt).map_err(|refusal| refusal.to_string())?;
        let values = self.tangent();
        let mut jump = vec![0.0; u.len()];
        prescribed.iter().for_each(|&(dof, value)| jump[dof] = value - u[dof]);
        let known = product(&self.pattern, &values, &jump);
        let mut rhs = self.unbalanced(&r, load);
        let free = &self.system.equations().free;
        free.iter().zip(&mut rhs).for_each(|(&d, rhs)| *rhs -= known[d]);
        let du = self.solve(&values, rhs)?;
        self.system.equations().free.iter().zip(du).for_each(|(&d, x)| u[d] += x);
        Ok(u)
    }

    /// Load less forces on the free degrees of freedom.
    fn unbalanced(&self, r: &[f64], load: &[Entry]) -> Vec<f64> {
        let equations = self.system.equations();
        let mut rhs: Vec<f64> = equations.free.iter().map(|&d| -r[d]).collect();
        for &(dof, force) in load {
            if let Some(rhs) = rhs.get_mut(equations.number[dof]) {
                *rhs += force;
            }
        }
        rhs
    }

    /// Largest unbalanced force on a free degree of freedom in the current state under `load`.
    pub fn drift(&mut self, load: &[Entry]) -> Result<f64, CaseError> {
        let u = self.u.clone();
        let r = self.forces(&u, 0.0).map_err(|refusal| refusal.to_string())?;
        self.block.reject();
        Ok(self.unbalanced(&r, load).iter().fold(0.0, |m: f64, x| m.max(x.abs())))
    }

    fn tangent(&mut self) -> Vec<f64> {
        self.work.tangents += 1;
        let mut values = vec![0.0; self.pattern.values()];
        self.block.tangent(&mut values);
        values
    }

    fn solve(&mut self, values: &[f64], mut rhs: Vec<f64>) -> Result<Vec<f64>, CaseError> {
        self.factor(values)?;
        self.system.solve(&mut rhs)?;
        Ok(rhs)
    }

    fn factor(&mut self, values: &[f64]) -> Result<(), CaseError> {
        self.work.factorisations += 1;
        self.system.factor_tangent(&mut [&mut Tangent { pattern: &self.pattern, values }])?;
        Ok(())
    }

    /// Rate tangents of the committed state and the constant forces of a step.
    fn rate(&mut self, dt: f64) -> Result<(Vec<f64>, Vec<f64>), CaseError> {
        self.work.tangents += 1;
        let (mut values, mut constant) = (vec![0.0; self.pattern.values()], vec![0.0; self.u.len()]);
        let at = Instant { time: self.time + dt, dt };
        self.block.rate(at, &mut values, &mut constant).map_err(|refusal| refusal.to_string())?;
        Ok((values, constant))
    }

    /// A forward step: increments of displacements and loads over `dt`, scaled by the fraction that the block admits.
    pub fn forward(&mut self, prescribed: &[Entry], load: &[Entry], dt: f64) -> Result<Forward, CaseError> {
        let (values, mut constant) = self.rate(dt)?;
        self.factor(&values)?;
        let mut whole = vec![0.0; self.u.len()];
        prescribed.iter().for_each(|&(dof, value)| whole[dof] = value);
        let known = product(&self.pattern, &values, &whole);
        let mut forces = vec![0.0; self.u.len()];
        load.iter().for_each(|&(dof, force)| forces[dof] += force);
        let mut end = Forward { fraction: 1.0, limit: None };
        for pass in 0..MOST_PASSES {
            let r = end.fraction;
            let mut du: Vec<f64> = whole.iter().map(|x| r * x).collect();
            let free = self.system.equations().free.clone();
            let mut rhs: Vec<f64> =
                free.iter().map(|&d| r * (forces[d] - known[d]) - constant[d] - self.left[d]).collect();
            self.system.solve(&mut rhs)?;
            free.iter().zip(&rhs).for_each(|(&d, x)| du[d] = *x);
            let at = Instant { time: self.time + r * dt, dt: r * dt };
            match self.block.limit(&du, at).filter(|found| found.value < 1.0 - WHOLE) {
                Some(found) if pass + 1 < MOST_PASSES => {
                    end = Forward { fraction: r * found.value, limit: Some(found) };
                    constant = self.rate(end.fraction * dt)?.1;
                }
                _ => {
                    let u: Vec<f64> = self.u.iter().zip(&du).map(|(u, d)| u + d).collect();
                    let f = self.forces(&u, r * dt).map_err(|refusal| refusal.to_string())?;
                    self.loaded.iter_mut().zip(&forces).for_each(|(sum, force)| *sum += r * force);
                    if self.carry {
                        self.left = f.iter().zip(&self.loaded).map(|(f, load)| f - load).collect();
                    }
                    self.accept(u, r * dt);
                    break;
                }
            }
        }
        Ok(end)
    }
}

/// Product of a tangent and a vector.
fn product(pattern: &Pattern, values: &[f64], v: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; v.len()];
    let mut rest = values;
    for block in pattern.blocks() {
        for &i in block {
            let (row, after) = rest.split_at(block.len());
            rest = after;
            out[i] += row.iter().zip(block).map(|(k, &j)| k * v[j]).sum::<f64>();
        }
    }
    out
}

/// Entries of both components at nodes in the plane, with the displacement `f`.
pub fn moved(mesh: &Mesh<2>, nodes: &[usize], f: impl Fn([f64; 2]) -> [f64; 2]) -> Vec<Entry> {
    let entries = nodes.iter().map(|&n| (n, f(mesh.nodes[n])));
    entries.flat_map(|(n, [x, y])| [(2 * n, x), (2 * n + 1, y)]).collect()
}

/// The degrees of freedom of entries.
pub fn dofs(entries: &[Entry]) -> Vec<usize> {
    entries.iter().map(|e| e.0).collect()
}

/// Root, to machine precision, of a function that changes sign once between `low` and `high` or is zero at an end.
pub fn root(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let rising = f(low) < 0.0;
    loop {
        let mid = 0.5 * (low + high);
        if mid <= low.min(high) || mid >= low.max(high) {
            return mid;
        }
        if (f(mid) > 0.0) == rising {
            high = mid;
        } else {
            low = mid;
        }
    }
}

/// Positions of the quadrature points in the reference configuration, cell by cell.
pub fn points(mesh: &Mesh<2>, idealisation: Idealisation) -> Vec<[f64; 2]> {
    let cells = &mesh.blocks[0];
    let rule = idealisation.quadrature(cells.kind);
    let place = |cell: usize, xi: [f64; 3]| {
        let shape = cells.kind.shape(xi);
        let at = |c: usize| cells.cell(cell).iter().zip(&shape.n).map(|(&n, s)| s * mesh.nodes[n][c]).sum();
        [at(0), at(1)]
    };
    (0..cells.len()).flat_map(|cell| rule.iter().map(move |(xi, _)| place(cell, *xi))).collect()
}

/// A tangent that is given.
struct Tangent<'a> {
    pattern: &'a Pattern,
    values: &'a [f64],
}

impl Term for Tangent<'_> {
    fn name(&self) -> &'static str {
        "tangent"
    }

    fn residual(&mut self, _u: &[f64], _at: Instant, _r: &mut [f64]) -> Result<(), Refusal> {
        Ok(())
    }

    fn accept(&mut self) {}

    fn reject(&mut self) {}
}

impl Linearized for Tangent<'_> {
    fn pattern(&self) -> &Pattern {
        self.pattern
    }

    fn tangent(&mut self, values: &mut [f64]) {
        values.copy_from_slice(self.values);
    }
}
