use asperity_fem::element::ElementKind;
use asperity_fem::mesh::generate::Grid;
use asperity_fem::mesh::{Mesh, nodes_of_sides};
use asperity_plan::shared::model::order::{along_curve, along_lines};

/// Positions of nodes, in an order of their own.
type Places = Vec<Vec<u64>>;

fn places(mesh: &Mesh<3>, nodes: impl IntoIterator<Item = usize>) -> Places {
    let mut places: Places =
        nodes.into_iter().map(|n| mesh.nodes[n].iter().map(|x| x.to_bits()).collect()).collect();
    places.sort();
    places
}

fn cell(mesh: &Mesh<3>, cell: usize) -> Places {
    places(mesh, mesh.blocks[0].cell(cell).iter().copied())
}

/// Cells and sides by the positions of their nodes, in an order that does not depend on numbers.
fn cells_and_sides(mesh: &Mesh<3>) -> (Vec<Places>, Vec<(String, Places)>) {
    let mut cells: Vec<_> = (0..mesh.blocks[0].len()).map(|c| cell(mesh, c)).collect();
    cells.sort();
    let side = |(name, set): (&String, &Vec<_>)| (name.clone(), places(mesh, nodes_of_sides(mesh, set)));
    (cells, mesh.side_sets.iter().map(side).collect())
}

fn grid(kind: ElementKind) -> Mesh<3> {
    let lines = [3, 7, 5].map(|n| (0..=n).map(|k| f64::from(k * k)).collect());
    Grid { lines, kind }.mesh().unwrap()
}

#[test]
fn the_same_cells_and_sides_follow_the_curve() {
    let lines = [7, 5, 3].map(|n| (0..=n).map(f64::from).collect());
    let mesh = Grid { lines, kind: ElementKind::Hex8 }.mesh().unwrap();
    let before = cells_and_sides(&mesh);
    let moved = along_curve(mesh);
    assert_eq!(before, cells_and_sides(&moved));
    assert!(!before.1.is_empty());
    // Cells of one octant of the curve come before those of the next.
    let first = cell(&moved, 0);
    assert!(first.iter().flatten().all(|x| f64::from_bits(*x) <= 1.0), "{first:?}");
}

#[test]
fn the_same_cells_and_sides_of_a_grid_follow_its_longest_lines() {
    for kind in [ElementKind::Hex8, ElementKind::Tet4, ElementKind::Hex27] {
        let before = grid(kind);
        let moved = along_lines(before.clone());
        assert_eq!(cells_and_sides(&before), cells_and_sides(&moved), "{kind:?}");
        assert!(moved.nodes.is_sorted_by_key(|[x, y, z]| [*x, *z, *y]), "{kind:?}");
        let lowest = |c: usize| moved.blocks[0].cell(c).iter().min();
        assert!((0..moved.blocks[0].len()).is_sorted_by_key(lowest), "{kind:?}");
    }
}

#[test]
fn a_mesh_that_is_no_grid_stays_as_it_is() {
    let mut bent = grid(ElementKind::Hex8);
    bent.nodes[0][1] -= 0.1;
    for mesh in [grid(ElementKind::Hex20), bent] {
        assert_eq!(along_lines(mesh.clone()), mesh);
    }
}
