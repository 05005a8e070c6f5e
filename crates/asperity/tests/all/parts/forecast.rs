use asperity_fem::assembly::LowerTriangle;
use asperity_fem::dof::Constraints;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::mesh::generate::Grid as Lines;
use asperity_fem::term::{Blocks, Pattern};
use asperity_plan::shared::model::forecast::*;

/// Bytes of the factor's values and of the factorisation, and operations, as found by the analysis.
fn analysed<const D: usize>(cells: [usize; D], kind: ElementKind) -> [f64; 3] {
    let lines = cells.map(|n| (0..=n).map(|k| k as f64).collect());
    let mesh = Lines { lines, kind }.mesh().unwrap();
    let block = &mesh.blocks[0];
    let dofs = |cell: usize| block.cell(cell).iter().flat_map(|n| (0..D).map(move |c| n * D + c));
    let mut cells = Blocks::default();
    (0..block.len()).for_each(|cell| cells.push(dofs(cell)));
    let pattern = Pattern::new(cells);
    let constraints = Constraints { fixed: Vec::new(), channels: Vec::new() };
    let equations = constraints.equations(mesh.nodes.len() * D);
    let analysis = LowerTriangle::new(&[&pattern], &equations).analyse().unwrap();
    let symbolic = analysis.symbolic();
    [WORD * symbolic.stored() as f64, symbolic.bytes() as f64, symbolic.operations()]
}

#[test]
fn factors_of_grids_are_estimated_within_half_as_much_again_and_never_surely_too_large() {
    let none = [false; 6];
    let cases = [
        (analysed([100, 100], ElementKind::Quad4), factor_cost([101, 101, 1], none, 2), FRONTS_IN_PLANE),
        (analysed([400, 30], ElementKind::Quad4), factor_cost([401, 31, 1], none, 2), FRONTS_IN_PLANE),
        (analysed([14, 14, 14], ElementKind::Hex8), factor_cost([15, 15, 15], none, 3), FRONTS_IN_SPACE),
        (analysed([40, 12, 4], ElementKind::Hex8), factor_cost([41, 13, 5], none, 3), FRONTS_IN_SPACE),
    ];
    for ([factor, bytes, operations], cost, fronts) in cases {
        let estimated = WORD * cost.values;
        let ratio = estimated / factor;
        assert!((0.67..1.5).contains(&ratio), "{ratio}");
        assert!(SURE * estimated <= factor, "{ratio}");
        let ratio = fronts * estimated / bytes;
        assert!((0.67..1.5).contains(&ratio), "{ratio}");
        // Operations are cubes where values are squares: the same error of a front's width counts by half as much again.
        let ratio = cost.operations / operations;
        assert!((0.5..2.0).contains(&ratio), "{ratio}");
    }
}

#[test]
fn bodies_in_explicit_steps_are_counted_without_matrices() {
    let text =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/tpv5.toml")).unwrap();
    let scene = asperity_plan::reading::scene::read(&text).unwrap();
    assert_eq!(BuiltParts::from_scene(&scene), BuiltParts::Vectors);
    // Two blocks of 9 x 18 x 36 km in cells of 100 m.
    let block =
        || Counts { kind: ElementKind::Hex8, cells: 90.0 * 180.0 * 360.0, nodes: 91.0 * 181.0 * 361.0 };
    let bytes = |built: BuiltParts| built.bytes(&[block(), block()], Idealisation::ThreeD) as f64;
    // A run with cells of 200 m takes 0.9 kB a cell.
    assert!((bytes(BuiltParts::Vectors) / 10.5e9 - 1.0).abs() < 0.05, "{}", bytes(BuiltParts::Vectors));
    // A cell condensed onto a fault has a matrix of 24 x 24 numbers and a copy.
    assert!(bytes(BuiltParts::Cells) > 2.0 * 8.0 * 24.0 * 24.0 * 11_664_000.0);
    assert!(bytes(BuiltParts::Systems) > bytes(BuiltParts::Cells) / 2.0);
}
