//! Assembly of cell matrices into a fixed pattern, compared with the time of a triad over the same bytes in the same
//! run. Repetitions of all quantities alternate, and the minimum of each is printed, since other load only adds time.
#![allow(missing_docs, clippy::print_stdout, reason = "a table of ratios: criterion does not fit")]

use asperity_fem::block::LinearBlock;
use asperity_fem::dof::Constraints;
use asperity_fem::element::ElementKind;
use asperity_fem::iterative::matrix::Assembly;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::generate::{Block, Grading};
use asperity_fem::mesh::nodes_of_sides;
use asperity_fem::sparse::{Part, ScatterMap};
use asperity_fem::term::Linearized;
use rayon::prelude::*;
use std::hint::black_box;
use std::time::Instant;

/// Repetitions.
const TURNS: usize = 15;
/// Numbers in each vector of the triad: 192 MB in all, six times the largest cache.
const TRIAD: usize = 8 << 20;
/// Numbers per task of the triad.
const PIECE: usize = 1 << 16;

fn seconds(pool: &rayon::ThreadPool, f: impl FnOnce() + Send) -> f64 {
    let start = Instant::now();
    pool.install(f);
    start.elapsed().as_secs_f64()
}

struct Triad {
    a: Vec<f64>,
    b: Vec<f64>,
    c: Vec<f64>,
}

impl Triad {
    /// `a = b + s c`.
    fn run(&mut self) {
        let pieces = self.b.par_chunks(PIECE).zip(self.c.par_chunks(PIECE));
        self.a.par_chunks_mut(PIECE).zip(pieces).for_each(|(a, (b, c))| {
            for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
                *a = b + 1.5 * c;
            }
        });
        black_box(&self.a);
    }

    /// Bytes moved: two vectors read and one written, whose cache lines are read first.
    const BYTES: f64 = (4 * 8 * TRIAD) as f64;
}

/// Minimum times with one and with two threads.
type Least = [f64; 2];

fn measure<const D: usize>(kind: ElementKind, n: usize, pools: &[rayon::ThreadPool; 2], triad: &mut Triad) {
    let mesh =
        Block { min: [0.0; D], max: [1.0; D], divisions: [n; D], grading: [Grading::Uniform; D], kind }
            .mesh()
            .expect("admissible");
    let material = Elastic::new(44.8e9, 0.25).expect("admissible");
    let space = Idealisation::from_dimension(D);
    let block = LinearBlock::new(&mesh, 0, &material, space, Formulation::Standard).expect("admissible");
    let fixed = nodes_of_sides(&mesh, &mesh.side_sets["left"]).into_iter();
    let fixed = fixed.flat_map(|k| k * D..(k + 1) * D).collect();
    let equations = Constraints { fixed, channels: Vec::new() }.equations(D * mesh.nodes.len());
    let mut maps = [Part::Lower, Part::Whole].map(|p| ScatterMap::new(&[block.pattern()], &equations, p));
    let blocks = Assembly::<D>::new(&[block.pattern()], &equations).expect("whole nodes");
    let mut rows = blocks.assemble(&[block.stiffness()]);
    let mut least = [[f64::INFINITY; 2]; 5];
    for _ in 0..TURNS {
        for (k, pool) in pools.iter().enumerate() {
            let mut keep = |row: usize, time: f64| least[row][k] = least[row][k].min(time);
            keep(0, seconds(pool, || triad.run()));
            for (row, map) in maps.iter_mut().enumerate() {
                keep(
                    1 + row,
                    seconds(pool, || {
                        map.clear();
                        map.add(0, block.stiffness());
                    }),
                );
            }
            keep(3, seconds(pool, || blocks.assemble_into(&[block.stiffness()], &mut rows)));
            keep(
                4,
                seconds(pool, || {
                    black_box(LinearBlock::new(&mesh, 0, &material, space, Formulation::Standard))
                        .expect("admissible");
                }),
            );
        }
    }
    let cells = mesh.blocks[0].len() as f64;
    let values = (8 * block.stiffness().len()) as f64;
    println!("{} {} cells, {} equations", kind.name(), cells, equations.free.len());
    let bandwidth = least[0].map(|t| Triad::BYTES / t);
    println!("  triad {:.1} / {:.1} GB/s", bandwidth[0] / 1e9, bandwidth[1] / 1e9);
    for (map, (name, time)) in maps.iter().zip(["lower triangle", "whole"].into_iter().zip(&least[1..])) {
        // Values and index lists are read once; stored entries are zeroed, read and written.
        let bytes = values + map.bytes() as f64 + (3 * 8 * map.stored()) as f64;
        show(name, *time, cells, bytes, bandwidth);
    }
    let bytes = values + blocks.bytes() as f64 + (2 * 8 * D * D * rows.values.len()) as f64;
    show("node blocks", least[3], cells, bytes, bandwidth);
    let ns = least[4].map(|t| 1e9 * t / cells);
    println!("  cell matrices from the mesh: {:.0} / {:.0} ns ({:.2})", ns[0], ns[1], ns[0] / ns[1]);
}

fn show(name: &str, time: Least, cells: f64, bytes: f64, bandwidth: Least) {
    let ns = time.map(|t| 1e9 * t / cells);
    let bound = bandwidth.map(|b| 1e9 * bytes / b / cells);
    println!(
        "  | {name} | {:.0} | {:.0} / {:.0} | {:.0} / {:.0} | {:.2} |",
        bytes / cells,
        bound[0],
        bound[1],
        ns[0],
        ns[1],
        ns[0] / ns[1]
    );
}

fn main() {
    faer::set_global_parallelism(faer::Par::Seq);
    let pools = [1, 2].map(|n| rayon::ThreadPoolBuilder::new().num_threads(n).build().expect("threads"));
    let mut triad = Triad { a: vec![0.0; TRIAD], b: vec![1.0; TRIAD], c: vec![2.0; TRIAD] };
    // Bodies of about 200 000 unknowns in two dimensions and 100 000 in three.
    measure::<2>(ElementKind::Quad4, 316, &pools, &mut triad);
    measure::<2>(ElementKind::Quad9, 158, &pools, &mut triad);
    measure::<3>(ElementKind::Hex8, 32, &pools, &mut triad);
    measure::<3>(ElementKind::Hex20, 20, &pools, &mut triad);
}
