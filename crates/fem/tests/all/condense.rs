//! Static condensation compared with the equivalent dense formula.

use asperity_fem::block::LinearBlock;
use asperity_fem::condense::{Condensation, CondensedBody, LoadedBody, Reduction, Stiffness};
use asperity_fem::dof::Channel;
use asperity_fem::element::ElementKind;
use asperity_fem::error::FemError;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::generate::{Block, Grading};
use asperity_fem::multifrontal::DirectError;
use asperity_fem::table::Table;
use asperity_fem::term::{Instant, Linearized, Term};
use nalgebra::{DMatrix, DVector};

const DIVISIONS: [usize; 2] = [9, 7];

struct Body {
    stiffness: Stiffness,
    nodes: Vec<[f64; 2]>,
}

fn body() -> Body {
    let grading = [Grading::Geometric { ratio: 3.0 }, Grading::Uniform];
    let block =
        Block { min: [0.0; 2], max: [2.0, 1.0], divisions: DIVISIONS, grading, kind: ElementKind::Quad4 };
    let mesh = block.mesh().unwrap();
    let cells = LinearBlock::new(
        &mesh,
        0,
        &Elastic::new(3.0, 0.3).unwrap(),
        Idealisation::from_dimension(2),
        Formulation::Standard,
    )
    .unwrap();
    let stiffness = Stiffness {
        pattern: cells.pattern().clone(),
        values: cells.stiffness().to_vec(),
        dofs: mesh.nodes.len() * 2,
    };
    Body { stiffness, nodes: mesh.nodes }
}

impl Body {
    fn dense(&self) -> DMatrix<f64> {
        let mut k = DMatrix::zeros(self.stiffness.dofs, self.stiffness.dofs);
        let mut offset = 0;
        for block in self.stiffness.pattern.blocks() {
            for (i, &r) in block.iter().enumerate() {
                for (j, &c) in block.iter().enumerate() {
                    k[(r, c)] += self.stiffness.values[offset + i * block.len() + j];
                }
            }
            offset += block.len() * block.len();
        }
        k
    }

    fn dofs(&self, wanted: impl Fn([f64; 2]) -> bool) -> Vec<usize> {
        (0..self.nodes.len()).filter(|&n| wanted(self.nodes[n])).flat_map(|n| [2 * n, 2 * n + 1]).collect()
    }
}

fn pick(k: &DMatrix<f64>, rows: &[usize], cols: &[usize]) -> DMatrix<f64> {
    DMatrix::from_fn(rows.len(), cols.len(), |i, j| k[(rows[i], cols[j])])
}

struct Split {
    interior: Vec<usize>,
    retained: Vec<usize>,
    fixed: Vec<usize>,
}

/// Right side retained, left side fixed, one node of the bottom retained and its neighbour fixed in x only.
fn split(body: &Body) -> Split {
    let mut retained = body.dofs(|x| x[0] == 2.0);
    retained.extend([8, 9]);
    retained.sort_unstable();
    let mut fixed = body.dofs(|x| x[0] == 0.0);
    fixed.push(10);
    fixed.sort_unstable();
    let interior = (0..body.stiffness.dofs)
        .filter(|d| retained.binary_search(d).is_err() && fixed.binary_search(d).is_err())
        .collect();
    Split { interior, retained, fixed }
}

#[test]
fn the_schur_complement_is_that_of_the_dense_formula() {
    let body = body();
    let s = split(&body);
    let k = body.dense();
    let reduction = Reduction::new(&body.stiffness, &s.retained, &s.fixed).unwrap();
    let inner = pick(&k, &s.interior, &s.interior).cholesky().unwrap();
    let expected = pick(&k, &s.retained, &s.retained)
        - pick(&k, &s.retained, &s.interior) * inner.solve(&pick(&k, &s.interior, &s.retained));
    let m = s.retained.len();
    let found = DMatrix::from_row_slice(m, m, reduction.schur());
    assert!((&found - &expected).amax() < 1e-12 * expected.amax());
    assert_eq!(found, found.transpose());
}

#[test]
fn loads_and_interior_are_those_of_the_whole_system() {
    let body = body();
    let s = split(&body);
    let k = body.dense();
    let reduction = Reduction::new(&body.stiffness, &s.retained, &s.fixed).unwrap();
    let system: Vec<usize> = (3..3 + s.retained.len()).collect();
    let mut term = CondensedBody::new("body".into(), reduction, &system);
    let prescribed: Vec<(usize, f64)> = s.fixed.iter().map(|&d| (d, 0.01 * (d as f64).sin())).collect();
    let forces = vec![(s.interior[3], 0.2), (s.interior[20], -0.1), (s.retained[1], 0.3)];
    let amplitude = |slope| Table::new(vec![0.0, 10.0], vec![0.0, slope * 10.0]);
    term.set_channels(vec![
        Channel { prescribed: prescribed.clone(), forces: Vec::new(), amplitude: amplitude(1.0) },
        Channel { prescribed: Vec::new(), forces: forces.clone(), amplitude: amplitude(-2.0) },
    ]);
    let time = 3.0;
    let mut u = vec![0.0; s.retained.len() + 5];
    for (j, &dof) in system.iter().enumerate() {
        u[dof] = (j as f64 * 1.7).cos();
    }
    // The whole body by a dense matrix.
    let mut whole = DVector::zeros(body.stiffness.dofs);
    let mut f = DVector::zeros(body.stiffness.dofs);
    prescribed.iter().for_each(|&(d, v)| whole[d] = time * v);
    forces.iter().for_each(|&(d, v)| f[d] = -2.0 * time * v);
    s.retained.iter().zip(&system).for_each(|(&d, &k)| whole[d] = u[k]);
    let rest = &f - &k * &whole;
    let load = DVector::from_fn(s.interior.len(), |i, _| rest[s.interior[i]]);
    let inner = pick(&k, &s.interior, &s.interior).cholesky().unwrap().solve(&load);
    s.interior.iter().zip(inner.iter()).for_each(|(&d, &v)| whole[d] = v);
    let recovered = term.recover(&u, time);
    for (found, expected) in recovered.iter().zip(whole.iter()) {
        assert!((found - expected).abs() < 1e-12 * whole.amax());
    }
    let residual = &k * &whole - &f;
    let mut found = vec![0.0; u.len()];
    term.residual(&u, Instant { time, dt: 1.0 }, &mut found).unwrap();
    for (&dof, &at) in s.retained.iter().zip(&system) {
        assert!((found[at] - residual[dof]).abs() < 1e-11 * k.amax());
    }
    assert_eq!(term.reduction().solves(), 2);
}

#[test]
fn a_body_that_nothing_holds_names_the_degree_of_freedom() {
    let body = body();
    let Err(FemError::Direct(error)) = Reduction::new(&body.stiffness, &[], &[]) else {
        panic!("a free body was condensed")
    };
    let pivot = error.pivot().unwrap();
    assert!(matches!(error, DirectError::Singular(_)), "{error}");
    assert!(pivot.pivot.abs() < 1e-12 * pivot.diagonal);
    // With a hinge at one node the body can still rotate.
    let error = Reduction::new(&body.stiffness, &[], &[0, 1]).unwrap_err();
    assert!(matches!(error, FemError::Direct(DirectError::Singular(_))), "{error}");
}

#[test]
fn too_much_memory_is_refused_with_both_numbers() {
    let body = body();
    let s = split(&body);
    let plan = Condensation::analyse(&body.stiffness, &s.retained, &s.fixed).unwrap();
    let needed = plan.bytes();
    assert!(needed > s.retained.len().pow(2) * 8);
    let error = plan.factor(needed - 1).unwrap_err();
    let FemError::Direct(DirectError::Memory { needed: told, allowed, .. }) = error else {
        panic!("{error}")
    };
    assert_eq!((told, allowed), (needed, needed - 1));
    let plan = Condensation::analyse(&body.stiffness, &s.retained, &s.fixed).unwrap();
    assert!(plan.factor(needed).is_ok());
}

#[test]
fn any_number_of_threads_condenses_to_the_same_bits() {
    let body = body();
    let s = split(&body);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| Reduction::new(&body.stiffness, &s.retained, &s.fixed).unwrap().schur().to_vec())
    };
    assert_eq!(with(1), with(2));
}

#[test]
fn everything_retained_leaves_the_stiffness_itself() {
    let body = body();
    let all: Vec<usize> = (0..body.stiffness.dofs).collect();
    let reduction = Reduction::new(&body.stiffness, &all, &[]).unwrap();
    let k = body.dense();
    let found = DMatrix::from_row_slice(all.len(), all.len(), reduction.schur());
    assert!((&found - &k).amax() < 1e-15 * k.amax());
}

#[test]
fn condensed_with_its_loads_a_body_is_what_its_factor_makes_of_it() {
    let body = body();
    let s = split(&body);
    // One of the retained degrees of freedom is also prescribed, which has no effect on the reduction.
    let mut fixed = s.fixed.clone();
    fixed.push(s.retained[2]);
    fixed.sort_unstable();
    let table = |slope: f64| Table::new(vec![0.0, 1.0], vec![0.0, slope]);
    let channels = vec![
        Channel {
            prescribed: fixed.iter().map(|&d| (d, (d as f64).sin())).collect(),
            forces: Vec::new(),
            amplitude: table(1.0),
        },
        Channel {
            prescribed: Vec::new(),
            forces: vec![(s.interior[3], 0.2), (s.interior[20], -0.1), (s.retained[1], 0.3)],
            amplitude: table(-2.0),
        },
    ];
    let reduction = Reduction::new(&body.stiffness, &s.retained, &fixed).unwrap();
    let mut factored = CondensedBody::new("body".into(), reduction, &s.retained);
    factored.set_channels(channels.clone());
    let loaded = LoadedBody::analyse(body.stiffness.clone(), &s.retained, &fixed, channels).unwrap();
    let left = loaded.eliminate(usize::MAX).unwrap();
    let m = s.retained.len();
    let close = |a: &[f64], b: &[f64]| {
        let scale = b.iter().fold(0.0_f64, |l, v| l.max(v.abs()));
        assert_eq!(a.len(), b.len());
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-13 * scale), "{a:?}\n{b:?}");
    };
    for k in 0..m {
        let row: Vec<f64> = (0..m).map(|c| left.at(k, c)).collect();
        close(&row, &factored.reduction().schur()[k * m..(k + 1) * m]);
    }
    assert_eq!(left.channels().count(), 2);
    for ((a, h), (b, expected)) in left.channels().zip(factored.channels()) {
        assert_eq!(a, b);
        close(&h, expected);
    }
}

#[test]
fn condensed_with_its_loads_a_body_that_nothing_holds_names_the_degree_of_freedom() {
    let body = body();
    let loaded = LoadedBody::analyse(body.stiffness.clone(), &[], &[0, 1], Vec::new()).unwrap();
    let error = loaded.eliminate(usize::MAX).unwrap_err();
    assert!(matches!(error, FemError::Direct(DirectError::Singular(_))), "{error}");
    assert!(error.pivot().unwrap().equation < body.stiffness.dofs);
}
