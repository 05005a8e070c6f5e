use asperity_fem::element::ElementKind;
use asperity_fem::mesh::generate::Grid;
use asperity_fem::mesh::{Mesh, nodes_of_sides};
use asperity_plan::shared::model::order::along_curve;

/// Positions of nodes, in an order of their own.
fn places<const D: usize>(mesh: &Mesh<D>, nodes: impl IntoIterator<Item = usize>) -> Vec<Vec<u64>> {
    let mut places: Vec<Vec<u64>> =
        nodes.into_iter().map(|n| mesh.nodes[n].iter().map(|x| x.to_bits()).collect()).collect();
    places.sort();
    places
}

#[test]
fn the_same_cells_and_sides_follow_the_curve() {
    let lines = [7, 5, 3].map(|n| (0..=n).map(f64::from).collect());
    let mesh = Grid { lines, kind: ElementKind::Hex8 }.mesh().unwrap();
    let cell = |mesh: &Mesh<3>, c: usize| places(mesh, mesh.blocks[0].cell(c).iter().copied());
    let cells = |mesh: &Mesh<3>| {
        let mut all: Vec<_> = (0..mesh.blocks[0].len()).map(|c| cell(mesh, c)).collect();
        all.sort();
        all
    };
    let sides = |mesh: &Mesh<3>| -> Vec<_> {
        mesh.side_sets
            .iter()
            .map(|(name, set)| (name.clone(), places(mesh, nodes_of_sides(mesh, set))))
            .collect()
    };
    let before = (cells(&mesh), sides(&mesh));
    let moved = along_curve(mesh);
    assert_eq!(before, (cells(&moved), sides(&moved)));
    assert!(!before.1.is_empty());
    // Cells of one octant of the curve come before those of the next.
    let first = cell(&moved, 0);
    assert!(first.iter().flatten().all(|x| f64::from_bits(*x) <= 1.0), "{first:?}");
}
