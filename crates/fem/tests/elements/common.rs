//! Meshes, manufactured solutions, solution and error norms.
#![allow(dead_code)]

use asperity_fem::block::LinearBlock;
use asperity_fem::dof::Constraints;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::generate::{Block, Grading};
use asperity_fem::mesh::{Mesh, face_nodes, nodes_of_sides};
use asperity_fem::sparse::{Part, ScatterMap};
use asperity_fem::surface;
use asperity_fem::term::{Instant, Linearized, Term};
use std::collections::BTreeMap;

pub const AT: Instant = Instant { time: 0.0, dt: 1.0 };

pub fn material(poisson: f64) -> Elastic {
    Elastic::new(2.5, poisson).unwrap()
}

pub fn grid<const D: usize>(kind: ElementKind, min: [f64; D], n: usize) -> Mesh<D> {
    let max = min.map(|m| m + 1.0);
    Block { min, max, divisions: [n; D], grading: [Grading::Uniform; D], kind }.mesh().unwrap()
}

/// Distortion of a uniform mesh of a unit block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// Interior corners move by a fixed fraction of the element size, to alternating sides: the shape of elements does not
    /// improve with refinement. Edges stay straight.
    Crooked,
    /// Interior corners move by a smooth map of the block: cells become parallelograms as the mesh is refined.
    Mapped,
    /// One constant shear: all elements are affine images of the reference element.
    Sheared,
}

/// Fractions of the element size.
const MOVE: [f64; 3] = [0.13, -0.09, 0.11];

/// A block with the lower corner `lower` and `n` elements along each axis.
pub fn mesh<const D: usize>(kind: ElementKind, lower: [f64; D], n: usize, shape: Shape) -> Mesh<D> {
    let mut mesh = grid::<D>(kind, lower, n);
    if shape == Shape::Sheared {
        for x in &mut mesh.nodes {
            let start = *x;
            for c in 0..D {
                // About an axis, x = 0 must stay fixed.
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
        if shape == Shape::Mapped {
            let wave: f64 = (0..D).map(|c| (std::f64::consts::PI * (x[c] - lower[c])).sin()).product();
            return std::array::from_fn(|c| x[c] + MOVE[c] * wave);
        }
        let sign = |k: usize| if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        // Rows alternate in x and columns in y, which gives trapezoids.
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

/// A displacement field: its value, its gradient `[c][j]` = ∂u_c/∂x_j, and the body force that balances it.
pub trait Field<const D: usize> {
    fn value(&self, x: &[f64; D]) -> [f64; 3];
    fn gradient(&self, x: &[f64; D]) -> [[f64; 3]; 3];
    fn force(&self, x: &[f64; D]) -> [f64; 3];
}

/// Solves with the field prescribed on the nodes of the whole boundary and its body force inside.
pub fn solve<const D: usize>(mesh: &Mesh<D>, block: &LinearBlock<D>, exact: &dyn Field<D>) -> Vec<f64> {
    solve_held(mesh, block, exact, &boundary(mesh), &[])
}

/// Solves with the field prescribed on some nodes, and with given nodal forces in addition to its body force.
pub fn solve_held<const D: usize>(
    mesh: &Mesh<D>,
    block: &LinearBlock<D>,
    exact: &dyn Field<D>,
    held: &[usize],
    forces: &[(usize, f64)],
) -> Vec<f64> {
    let components = block.idealisation().components();
    let fixed: Vec<(usize, f64)> = held
        .iter()
        .flat_map(|&n| (0..components).map(move |c| (n * components + c, exact.value(&mesh.nodes[n])[c])))
        .collect();
    let mut all = block.body_force_field(mesh, |x, f| f.copy_from_slice(&exact.force(x)[..components]));
    all.extend_from_slice(forces);
    solve_dofs(mesh, block, &fixed, &all)
}

/// Solves with prescribed degrees of freedom (ascending) and nodal forces.
pub fn solve_dofs<const D: usize>(
    mesh: &Mesh<D>,
    block: &LinearBlock<D>,
    prescribed: &[(usize, f64)],
    forces: &[(usize, f64)],
) -> Vec<f64> {
    let n = mesh.nodes.len() * block.idealisation().components();
    let mut u = vec![0.0; n];
    prescribed.iter().for_each(|&(dof, value)| u[dof] = value);
    let fixed = prescribed.iter().map(|p| p.0).collect();
    let equations = Constraints { fixed, channels: Vec::new() }.equations(n);
    let mut r = vec![0.0; n];
    block.clone().residual(&u, AT, &mut r).unwrap();
    forces.iter().for_each(|&(dof, f)| r[dof] -= f);
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

/// Errors in L2 and in the H1 seminorm over the mesh.
pub fn errors<const D: usize>(
    mesh: &Mesh<D>,
    u: &[f64],
    block: &LinearBlock<D>,
    exact: &dyn Field<D>,
) -> [f64; 2] {
    block.error_norms(mesh, u, |x| (exact.value(x), exact.gradient(x)))
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
            // The force of the single component is that of λ = -G.
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
            // Longer waves in 3D, where meshes are coarser.
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

/// All idealisations of an element.
pub fn idealisations(kind: ElementKind) -> impl Iterator<Item = Idealisation> {
    Idealisation::ALL.into_iter().filter(move |i| i.dimension() == kind.dimension())
}

/// All formulations of an element in an idealisation.
pub fn formulations(kind: ElementKind, space: Idealisation) -> impl Iterator<Item = Formulation> {
    Formulation::ALL.into_iter().filter(move |f| f.dilatation(kind, space).is_ok())
}

/// Observed orders between two levels.
pub fn orders(coarse: [f64; 2], fine: [f64; 2], ratio: f64) -> [f64; 2] {
    std::array::from_fn(|k| (coarse[k] / fine[k]).ln() / ratio.ln())
}

/// True for elements whose space contains the complete polynomials of their order only on affine images of the reference.
pub fn is_serendipity(kind: ElementKind) -> bool {
    matches!(kind, ElementKind::Quad8 | ElementKind::Hex20 | ElementKind::Wedge15)
}

/// Checks that a mesh of a block from the origin to (1, 2, 3) m conforms, fills it, names its sides, and has no unused nodes.
pub fn conforms<const D: usize>(mesh: &Mesh<D>) {
    let cells = &mesh.blocks[0];
    let kind = cells.kind;
    let mut used = cells.connectivity.clone();
    used.sort_unstable();
    used.dedup();
    assert_eq!(used, (0..mesh.nodes.len()).collect::<Vec<_>>(), "{}: unused nodes", kind.name());
    let mut faces: BTreeMap<Vec<usize>, usize> = BTreeMap::new();
    for cell in 0..cells.len() {
        for face in kind.faces() {
            let mut nodes: Vec<usize> = face.nodes.iter().map(|&a| cells.cell(cell)[a]).collect();
            nodes.sort_unstable();
            *faces.entry(nodes).or_default() += 1;
        }
    }
    let outer: Vec<Vec<usize>> = mesh
        .side_sets
        .values()
        .flatten()
        .map(|s| {
            let mut nodes = face_nodes(mesh, s);
            nodes.sort_unstable();
            nodes
        })
        .collect();
    for (face, count) in faces {
        let expected = if outer.contains(&face) { 1 } else { 2 };
        assert_eq!(count, expected, "{} {face:?}", kind.name());
    }
    // All cells have the right orientation, and together they fill the block.
    let space = Idealisation::from_dimension(D);
    let material = material(0.3);
    let elastic = LinearBlock::new(mesh, 0, &material, space, Formulation::Standard).unwrap();
    let force = elastic.body_force(mesh, &vec![1.0; D]).unwrap();
    let volume: f64 = force.iter().filter(|(dof, _)| dof % D == 0).map(|(_, f)| f).sum();
    let exact: f64 = (1..=D).map(|c| c as f64).product();
    assert!((volume - exact).abs() < 1e-13 * exact, "{} {volume}", kind.name());
    for (name, sides) in &mesh.side_sets {
        let area: f64 = surface::areas(mesh, sides, space).values().sum();
        let axis = ["left", "right", "bottom", "top", "back", "front"].iter().position(|n| n == name);
        assert!((area - exact / (1 + axis.unwrap() / 2) as f64).abs() < 1e-13 * exact, "{name}");
    }
}
