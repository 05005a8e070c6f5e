//! Meshes, manufactured solutions, solution and error norms.
#![allow(dead_code)]

use asperity_fem::block::LinearBlock;
use asperity_fem::dof::Constraints;
use asperity_fem::element::{ElementKind, Point};
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::generate::{Block, Grading};
use asperity_fem::mesh::{Mesh, nodes_of_sides};
use asperity_fem::quadrature;
use asperity_fem::sparse::{Part, ScatterMap};
use asperity_fem::term::{Instant, Linearized, Term};
use nalgebra::DMatrix;

pub const AT: Instant = Instant { time: 0.0, dt: 1.0 };

pub fn material(poisson: f64) -> Elastic {
    Elastic::new(2.5, poisson).unwrap()
}

pub fn grid<const D: usize>(kind: ElementKind, min: [f64; D], n: usize) -> Mesh<D> {
    let max = min.map(|m| m + 1.0);
    Block { min, max, divisions: [n; D], grading: [Grading::Uniform; D], kind }.mesh().unwrap()
}

/// What is done to a uniform mesh of a unit block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// Corners inside move by a fixed share of the element size, to alternating sides: the shape of elements does not improve
    /// with refinement. Edges stay straight.
    Crooked,
    /// One constant shear: all elements are affine images of the reference element.
    Sheared,
}

/// Shares of the element size.
const MOVE: [f64; 3] = [0.13, -0.09, 0.11];

/// `lower` corner, `n` elements along an axis.
pub fn mesh<const D: usize>(kind: ElementKind, lower: [f64; D], n: usize, shape: Shape) -> Mesh<D> {
    let mut mesh = grid::<D>(kind, lower, n);
    if shape == Shape::Sheared {
        for x in &mut mesh.nodes {
            let start = *x;
            for c in 0..D {
                // About an axis, x = 0 has to stay where it is.
                x[c] += if c == 0 { 0.0 } else { 0.3 * start[0] + 0.15 * start[(c + 1) % D] };
            }
        }
        return mesh;
    }
    let nodes = mesh.nodes.clone();
    let moved = |x: [f64; D]| -> [f64; D] {
        let index: [usize; D] = std::array::from_fn(|c| ((x[c] - lower[c]) * n as f64).round() as usize);
        if index.iter().any(|&i| i == 0 || i == n) {
            return x;
        }
        let sign = |k: usize| if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        // Rows alternate in x, columns in y: trapezoids.
        std::array::from_fn(|c| x[c] + MOVE[c] / n as f64 * sign(index.iter().sum::<usize>() + c * index[0]))
    };
    let linear = kind.linear();
    for cell in 0..mesh.blocks[0].len() {
        let ids = mesh.blocks[0].cell(cell).to_vec();
        for (&id, &xi) in ids.iter().zip(kind.node_coordinates()) {
            let s = linear.shape(xi);
            mesh.nodes[id] = std::array::from_fn(|c| {
                ids[..kind.corners()].iter().zip(&s.n).map(|(&b, n)| n * moved(nodes[b])[c]).sum()
            });
        }
    }
    mesh
}

pub fn boundary<const D: usize>(mesh: &Mesh<D>) -> Vec<usize> {
    let mut nodes: Vec<usize> = mesh.side_sets.values().flat_map(|s| nodes_of_sides(mesh, s)).collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}

/// A displacement field: `value(x, u)` writes its components, `gradient[c][j]` = ∂u_c/∂x_j, the body force that holds it.
pub trait Field<const D: usize> {
    fn value(&self, x: &[f64; D]) -> [f64; 3];
    fn gradient(&self, x: &[f64; D]) -> [[f64; 3]; 3];
    fn force(&self, x: &[f64; D]) -> [f64; 3];
}

/// Solves with the field prescribed on the nodes of the whole boundary and its body force inside.
pub fn solve<const D: usize>(mesh: &Mesh<D>, block: &LinearBlock<D>, exact: &dyn Field<D>) -> Vec<f64> {
    faer::set_global_parallelism(faer::Par::Seq);
    let components = block.idealisation().components();
    let n = mesh.nodes.len() * components;
    let mut u = vec![0.0; n];
    let mut fixed = Vec::new();
    for node in boundary(mesh) {
        for c in 0..components {
            u[node * components + c] = exact.value(&mesh.nodes[node])[c];
            fixed.push(node * components + c);
        }
    }
    let equations = Constraints { fixed, channels: Vec::new() }.equations(n);
    let mut r = vec![0.0; n];
    block.clone().residual(&u, AT, &mut r).unwrap();
    for (dof, f) in block.body_force_field(mesh, |x, f| f.copy_from_slice(&exact.force(x)[..components])) {
        r[dof] -= f;
    }
    let mut matrix = ScatterMap::new(&[block.pattern()], &equations, Part::Lower);
    matrix.add(0, block.stiffness());
    let factor = matrix.cholesky(&matrix.analyse_cholesky().unwrap()).unwrap();
    let mut x = faer::Mat::<f64>::from_fn(equations.free.len(), 1, |k, _| -r[equations.free[k]]);
    factor.solve(x.as_mut());
    for (k, &dof) in equations.free.iter().enumerate() {
        u[dof] = x[(k, 0)];
    }
    u
}

/// A rule fine enough to measure errors of second-order elements: degree 7 in each variable, collapsed onto simplices.
pub fn fine_rule(kind: ElementKind) -> Vec<Point> {
    let cube = quadrature::gauss(4, kind.dimension());
    let half = |x: f64| 0.5 * (1.0 + x);
    match kind.linear() {
        ElementKind::Tri3 => cube
            .into_iter()
            .map(|(p, w)| {
                let (s, t) = (half(p[0]), half(p[1]));
                ([s, t * (1.0 - s), 0.0], 0.25 * w * (1.0 - s))
            })
            .collect(),
        ElementKind::Wedge6 => cube
            .into_iter()
            .map(|(p, w)| {
                let (s, t) = (half(p[0]), half(p[1]));
                ([s, t * (1.0 - s), p[2]], 0.25 * w * (1.0 - s))
            })
            .collect(),
        ElementKind::Tet4 => cube
            .into_iter()
            .map(|(p, w)| {
                let (r, s, t) = (half(p[0]), half(p[1]), half(p[2]));
                let (y, left) = (s * (1.0 - r), (1.0 - r) * (1.0 - s));
                ([r, y, t * left], 0.125 * w * (1.0 - r) * left)
            })
            .collect(),
        _ => cube,
    }
}

/// Errors in L2 and in the H1 seminorm over the mesh.
pub fn errors<const D: usize>(
    mesh: &Mesh<D>,
    u: &[f64],
    idealisation: Idealisation,
    exact: &dyn Field<D>,
) -> [f64; 2] {
    let components = idealisation.components();
    let cells = &mesh.blocks[0];
    let rule: Vec<_> = fine_rule(cells.kind).into_iter().map(|(xi, w)| (cells.kind.shape(xi), w)).collect();
    let mut sums = [0.0; 2];
    for cell in 0..cells.len() {
        let ids = cells.cell(cell);
        for (s, w) in &rule {
            let x: [f64; D] =
                std::array::from_fn(|c| ids.iter().zip(&s.n).map(|(&i, n)| n * mesh.nodes[i][c]).sum());
            let j = DMatrix::from_fn(D, D, |i, m| {
                ids.iter().zip(&s.dn).map(|(&id, d)| d[m] * mesh.nodes[id][i]).sum::<f64>()
            });
            let volume = w * j.determinant() * idealisation.weight(&x);
            let inverse = j.try_inverse().unwrap();
            let (value, gradient) = (exact.value(&x), exact.gradient(&x));
            for c in 0..components {
                let nodal = || ids.iter().map(|&id| u[id * components + c]);
                let found: f64 = nodal().zip(&s.n).map(|(u, n)| n * u).sum();
                sums[0] += volume * (found - value[c]).powi(2);
                for k in 0..D {
                    let slope = |d: &[f64; 3]| (0..D).map(|m| d[m] * inverse[(m, k)]).sum::<f64>();
                    let found: f64 = nodal().zip(&s.dn).map(|(u, d)| slope(d) * u).sum();
                    sums[1] += volume * (found - gradient[c][k]).powi(2);
                }
            }
        }
    }
    sums.map(f64::sqrt)
}

/// Plane waves u = Σ A sin(k·x + φ). With modified λ in plane stress, -div σ = Σ (G |k|² A + (λ+G) (k·A) k) sin(k·x + φ).
pub struct Waves {
    pub shear: f64,
    pub lame: f64,
    /// A, k, φ.
    pub waves: Vec<([f64; 3], [f64; 3], f64)>,
}

impl Waves {
    fn phase<const D: usize>(k: &[f64; 3], phase: f64, x: &[f64; D]) -> f64 {
        x.iter().zip(k).map(|(x, k)| x * k).sum::<f64>() + phase
    }

    /// General waves of moderate length.
    pub fn general(material: &Elastic, idealisation: Idealisation) -> Self {
        let lame = match idealisation {
            Idealisation::PlaneStress => material.plane_stress_lame(),
            // The force of the only component is that of λ = -G.
            Idealisation::Antiplane => -material.shear(),
            _ => material.lame(),
        };
        let mut waves = vec![
            ([1.0, 0.2, 0.3], [1.0, 2.0, 0.5], 0.0),
            ([0.1, 1.0, -0.2], [2.0, -1.0, 1.0], 1.3),
            ([0.3, -0.1, 1.0], [0.5, 1.0, -2.0], 0.4),
        ];
        if idealisation.dimension() == 2 {
            waves.iter_mut().for_each(|(a, k, _)| (a[2], k[2]) = (0.0, 0.0));
        } else {
            // Longer in space, where meshes are coarser.
            waves.iter_mut().for_each(|(_, k, _)| *k = k.map(|k| 0.5 * k));
        }
        Self { shear: material.shear(), lame, waves }
    }

    /// Transverse waves without dilatation, and a longitudinal one of amplitude G/(λ+2G): as λ grows the field becomes
    /// divergence-free while the pressure stays of the order of G.
    pub fn incompressible(material: &Elastic, dimension: usize) -> Self {
        let (shear, lame) = (material.shear(), material.lame());
        let small = shear / (lame + 2.0 * shear);
        let waves = if dimension == 2 {
            vec![
                ([2.0, -1.0, 0.0], [1.5, 3.0, 0.0], 0.2),
                ([1.0, 2.0, 0.0], [3.0, -1.5, 0.0], 1.0),
                ([2.0 * small, 1.0 * small, 0.0], [2.0, 1.0, 0.0], 0.5),
            ]
        } else {
            vec![
                ([2.0, -1.0, 0.5], [1.0, 2.0, 0.0], 0.2),
                ([0.0, 1.0, 1.0], [1.0, -1.5, 1.5], 1.0),
                ([2.0 * small, small, -small], [2.0, 1.0, -1.0], 0.5),
            ]
        };
        Self { shear, lame, waves }
    }
}

impl<const D: usize> Field<D> for Waves {
    fn value(&self, x: &[f64; D]) -> [f64; 3] {
        std::array::from_fn(|c| self.waves.iter().map(|(a, k, p)| a[c] * Self::phase(k, *p, x).sin()).sum())
    }

    fn gradient(&self, x: &[f64; D]) -> [[f64; 3]; 3] {
        std::array::from_fn(|c| {
            std::array::from_fn(|j| {
                self.waves.iter().map(|(a, k, p)| a[c] * k[j] * Self::phase(k, *p, x).cos()).sum()
            })
        })
    }

    fn force(&self, x: &[f64; D]) -> [f64; 3] {
        std::array::from_fn(|c| {
            let amplitude = |(a, k, p): &([f64; 3], [f64; 3], f64)| {
                let (kk, ka): (f64, f64) =
                    (k.iter().map(|k| k * k).sum(), k.iter().zip(a).map(|(k, a)| k * a).sum());
                let value = self.shear * kk * a[c] + (self.lame + self.shear) * ka * k[c];
                value * Self::phase(k, *p, x).sin()
            };
            self.waves.iter().map(amplitude).sum()
        })
    }
}

/// u_r = r³ sin kz, u_z = r² cos kz about an axis: θ = (4 - k) r² sin kz, zero for k = 4.
pub struct Round {
    pub shear: f64,
    pub lame: f64,
    pub k: f64,
}

impl Field<2> for Round {
    fn value(&self, &[r, z]: &[f64; 2]) -> [f64; 3] {
        [r.powi(3) * (self.k * z).sin(), r * r * (self.k * z).cos(), 0.0]
    }

    fn gradient(&self, &[r, z]: &[f64; 2]) -> [[f64; 3]; 3] {
        let (s, c, k) = ((self.k * z).sin(), (self.k * z).cos(), self.k);
        [[3.0 * r * r * s, k * r.powi(3) * c, 0.0], [2.0 * r * c, -k * r * r * s, 0.0], [0.0; 3]]
    }

    fn force(&self, &[r, z]: &[f64; 2]) -> [f64; 3] {
        // (λ+G) ∇θ + G (Δu_r - u_r/r², Δu_z), with Δ = ∂rr + ∂r/r + ∂zz.
        let (s, c, k) = ((self.k * z).sin(), (self.k * z).cos(), self.k);
        let volumetric = (self.lame + self.shear) * (4.0 - k);
        [
            -(volumetric * 2.0 * r * s + self.shear * (8.0 * r - k * k * r.powi(3)) * s),
            -(volumetric * k * r * r * c + self.shear * (4.0 - k * k * r * r) * c),
            0.0,
        ]
    }
}

/// Every idealisation of an element.
pub fn idealisations(kind: ElementKind) -> impl Iterator<Item = Idealisation> {
    Idealisation::ALL.into_iter().filter(move |i| i.dimension() == kind.dimension())
}

/// Every formulation an element has in an idealisation.
pub fn formulations(kind: ElementKind, space: Idealisation) -> impl Iterator<Item = Formulation> {
    Formulation::ALL.into_iter().filter(move |f| f.dilatation(kind, space).is_ok())
}

/// Observed orders between two levels.
pub fn orders(coarse: [f64; 2], fine: [f64; 2], ratio: f64) -> [f64; 2] {
    std::array::from_fn(|k| (coarse[k] / fine[k]).ln() / ratio.ln())
}

/// Elements whose space holds the complete polynomials of their order on affine images of the reference only.
pub fn is_serendipity(kind: ElementKind) -> bool {
    matches!(kind, ElementKind::Quad8 | ElementKind::Hex20 | ElementKind::Wedge15)
}
