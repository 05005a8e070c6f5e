//! Faults in a half-space of any number of points: BP5 on a grid of squares, and on a bent surface of triangles.

use asperity_vary::SceneText;
use std::fmt::Write;

const BP5: &str = include_str!("../../scenes/bp5.toml");
/// Length along strike and width down dip of the fault \[m\].
const SIZE: [f64; 2] = [100e3, 40e3];
/// Deflection of the bent surface in its middle \[m\].
const BENT: f64 = 5e3;
/// Name of the file of triangles.
pub const FILE: &str = "fault.stl";

/// BP5 with slip along strike, squares in `columns` along strike, and no outputs.
fn on_squares(columns: usize) -> SceneText {
    SceneText::new(BP5)
        .with("title", "growth of cost")
        .with("faults.main.rectangle.size", SIZE[0] / columns as f64)
        .without("faults.main.slip")
        .add("faults.main.under_resolved", "allow")
        .without("output")
}

/// Text of the scene on a grid of squares.
///
/// # Errors
/// A message if the scene has changed.
pub fn squares(columns: usize) -> Result<String, String> {
    on_squares(columns).text().map_err(|e| e.to_string())
}

/// Text of the scene on the triangles of [`bent`].
///
/// # Errors
/// A message if the scene has changed.
pub fn triangles() -> Result<String, String> {
    let scene = on_squares(2).without("faults.main.rectangle");
    scene
        .add("faults.main.triangles", format!("{{ stl = {{ file = \"{FILE}\" }} }}"))
        .text()
        .map_err(|e| e.to_string())
}

/// STL file of a vertical surface that bends along strike, of two triangles for each of `columns` by `rows` rectangles.
#[must_use]
pub fn bent([columns, rows]: [usize; 2]) -> String {
    let vertex = |column: usize, row: usize| {
        let along = SIZE[0] * (column as f64 / columns as f64 - 0.5);
        let off = BENT * (1.0 - (2.0 * along / SIZE[0]).powi(2));
        format!("vertex {off} {} {along}\n", -SIZE[1] * row as f64 / rows as f64)
    };
    let mut text = String::from("solid fault\n");
    for column in 0..columns {
        for row in 0..rows {
            let [a, b] = [vertex(column, row), vertex(column + 1, row)];
            let [c, d] = [vertex(column + 1, row + 1), vertex(column, row + 1)];
            for corners in [[&a, &b, &c], [&a, &c, &d]] {
                let [p, q, r] = corners;
                let _ = write!(text, "facet normal 1 0 0\nouter loop\n{p}{q}{r}endloop\nendfacet\n");
            }
        }
    }
    text + "endsolid fault\n"
}

/// Power and factor of `y = factor x^power` through points, by least squares of logarithms.
#[must_use]
pub fn power(points: &[[f64; 2]]) -> [f64; 2] {
    let logs: Vec<[f64; 2]> = points.iter().map(|p| p.map(f64::ln)).collect();
    let count = logs.len() as f64;
    let [x, y] = [0, 1].map(|k| logs.iter().map(|p| p[k]).sum::<f64>() / count);
    let slope = logs.iter().map(|p| (p[0] - x) * (p[1] - y)).sum::<f64>()
        / logs.iter().map(|p| (p[0] - x).powi(2)).sum::<f64>();
    [slope, (y - slope * x).exp()]
}

#[cfg(test)]
mod tests {
    use super::power;

    #[test]
    fn a_power_is_found_with_its_factor() {
        let points = [1e3, 3e3, 1e5].map(|x: f64| [x, 2.5 * x.powf(1.2)]);
        let [slope, factor] = power(&points);
        assert!((slope - 1.2).abs() < 1e-12 && (factor - 2.5).abs() < 1e-9, "{slope} {factor}");
    }
}
