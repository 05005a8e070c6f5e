//! Division of cells into compact pieces by recursive bisection of their centres.

use crate::mesh::Mesh;

/// Most cells of a piece. Displacements and forces of about as many nodes then fit into the first cache.
const CELLS: usize = 1024;

/// Pieces of the cells of a block that have a node which is not `regular`, each a list of its cells.
pub(super) fn pieces<const D: usize>(mesh: &Mesh<D>, block: usize, regular: &[bool]) -> Vec<Vec<usize>> {
    let cells = &mesh.blocks[block];
    let centre = |cell: usize| -> [f64; D] {
        let nodes = cells.cell(cell);
        std::array::from_fn(|c| nodes.iter().map(|&n| mesh.nodes[n][c]).sum::<f64>() / nodes.len() as f64)
    };
    let centres: Vec<[f64; D]> = (0..cells.len()).map(centre).collect();
    let mut order: Vec<usize> =
        (0..cells.len()).filter(|&cell| !cells.cell(cell).iter().all(|&n| regular[n])).collect();
    let mut result = Vec::new();
    divide(&centres, &mut order, &mut result);
    result
}

/// Divides cells at the median along the longest side of their box until they are few enough.
fn divide<const D: usize>(centres: &[[f64; D]], cells: &mut [usize], result: &mut Vec<Vec<usize>>) {
    if cells.is_empty() {
        return;
    }
    if cells.len() <= CELLS {
        cells.sort_unstable();
        result.push(cells.to_vec());
        return;
    }
    let axis = longest(centres, cells);
    let middle = cells.len() / 2;
    let before = |a: &usize, b: &usize| centres[*a][axis].total_cmp(&centres[*b][axis]).then(a.cmp(b));
    cells.select_nth_unstable_by(middle, before);
    let (left, right) = cells.split_at_mut(middle);
    divide(centres, left, result);
    divide(centres, right, result);
}

fn longest<const D: usize>(centres: &[[f64; D]], cells: &[usize]) -> usize {
    let extent = |axis: usize| {
        let along = || cells.iter().map(|&cell| centres[cell][axis]);
        along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
    };
    (0..D).fold(0, |best, axis| if extent(axis) > extent(best) { axis } else { best })
}
