use asperity_plan::shared::field::cells::{Cells, Rule, Simplex};

/// Two lines that turn by 90 degrees in the plane, with values 1, 2 and 4 at their nodes.
fn bent(rule: Rule) -> Cells {
    let positions = [vec![0.0, 0.0], vec![1.0, 0.0], vec![1.0, -2.0]];
    let simplices = [[0, 1], [1, 2]].into_iter().enumerate();
    let simplices = simplices.map(|(cell, nodes)| Simplex { nodes: nodes.into(), cell }).collect();
    let values = if rule == Rule::Whole { vec![7.0, 8.0] } else { vec![1.0, 2.0, 4.0] };
    Cells::new(&positions, simplices, values, rule)
}

#[test]
fn values_on_lines_end_with_them() {
    let linear = bent(Rule::Linear);
    let at = |x: [f64; 2]| linear.at(&x);
    assert_eq!([at([0.5, 0.0]), at([1.0, -1.0]), at([1.0, -2.0])], [Some(1.5), Some(3.0), Some(4.0)]);
    assert_eq!([at([-0.1, 0.0]), at([1.0, -2.1]), at([0.5, 1.5])], [None; 3]);
    assert_eq!(at([0.5, 0.1]), Some(1.5), "beside a line");
    let corner = bent(Rule::Corner);
    assert_eq!([corner.at(&[0.6, 0.0]), corner.at(&[1.0, -1.2])], [Some(2.0), Some(4.0)]);
    let whole = bent(Rule::Whole);
    assert_eq!([whole.at(&[0.9, 0.0]), whole.at(&[1.0, -0.1])], [Some(7.0), Some(8.0)]);
}

#[test]
fn values_on_triangles_are_those_of_a_plane() {
    let n = 12;
    let node = |k: usize| vec![(k % n) as f64, (k / n) as f64, 0.5 * (k % n) as f64];
    let positions: Vec<Vec<f64>> = (0..n * n).map(node).collect();
    let plane = |x: &[f64]| 3.0 + x[0] - 2.0 * x[1];
    let values = positions.iter().map(|x| plane(x)).collect();
    let squares = (0..n * n).filter(|k| k % n + 1 < n && k / n + 1 < n);
    let halves = squares.flat_map(|k| [vec![k, k + 1, k + n], vec![k + 1, k + n + 1, k + n]]);
    let simplices = halves.enumerate().map(|(cell, nodes)| Simplex { nodes, cell }).collect();
    let cells = Cells::new(&positions, simplices, values, Rule::Linear);
    for k in 0..200 {
        let part = |by: f64| (f64::from(k) * by).fract() * 11.0;
        let (x, y) = (part(std::f64::consts::SQRT_2), part(3_f64.sqrt()));
        let at = [x, y, 0.5 * x];
        approx::assert_abs_diff_eq!(cells.at(&at).unwrap(), plane(&at), epsilon = 1e-12);
    }
    assert_eq!(cells.at(&[-0.01, 5.0, -0.005]), None);
}
