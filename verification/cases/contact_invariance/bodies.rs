//! Two bodies as mesh files, transformed by a rotation, a reflection or a change of units.

use std::fmt::Write;

/// Transformation of all positions and displacements: `x -> size Q x`.
#[derive(Clone, Copy, Debug)]
pub struct Change {
    /// Name in claims.
    pub name: &'static str,
    /// Rows of an orthogonal matrix.
    pub q: [[f64; 3]; 3],
    /// New units of length per metre.
    pub size: f64,
    /// New units of stress per pascal.
    pub stress: f64,
}

const SAME: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

impl Change {
    /// The identity and all transformations that must not affect results.
    pub fn all(space: bool) -> [Self; 4] {
        let (s, c) = 37_f64.to_radians().sin_cos();
        let about_z = [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]];
        let about_x = [[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]];
        let turned = if space { product(&about_x, &about_z) } else { about_z };
        let mut mirror = SAME;
        mirror[0][0] = -1.0;
        let same = Self { name: "as it is", q: SAME, size: 1.0, stress: 1.0 };
        [
            same,
            Self { name: "turned", q: turned, ..same },
            Self { name: "mirrored", q: mirror, ..same },
            Self { name: "in mm and MPa", size: 1e3, stress: 1e-6, ..same },
        ]
    }

    /// A position or displacement in the transformed scene.
    pub fn transform(&self, x: [f64; 3]) -> [f64; 3] {
        self.q.map(|row| self.size * row.iter().zip(x).map(|(q, x)| q * x).sum::<f64>())
    }

    /// A vector of the transformed scene in the axes of the original one, without change of units.
    pub fn back(&self, v: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|i| (0..3).map(|k| self.q[k][i] * v[k]).sum())
    }

    fn reflects(&self) -> bool {
        let [a, b, c] = self.q;
        let cross = [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
        a.iter().zip(cross).map(|(a, c)| a * c).sum::<f64>() < 0.0
    }
}

fn product(a: &[[f64; 3]; 3], b: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

/// A grid with a bottom and a top that may be curved.
pub struct Grid {
    /// Corners \[m\].
    pub min: [f64; 3],
    /// See `min`.
    pub max: [f64; 3],
    /// Cells along each axis; none along z in the plane.
    pub cells: [usize; 3],
    /// Shape of the bottom and of the top.
    pub sides: [Side; 2],
}

/// Shape of a side of a grid.
#[derive(Clone, Copy, Debug)]
pub enum Side {
    Flat,
    /// A ball, or a circle in the plane, of this radius about x = z = 0 \[m\].
    Round(f64),
    /// A cosine along x of this amplitude and wavelength \[m\].
    Wavy(f64, f64),
}

impl Side {
    /// Height above the flat side \[m\].
    fn height(self, [x, _, z]: [f64; 3]) -> f64 {
        match self {
            Self::Flat => 0.0,
            Self::Round(radius) => radius - (radius.powi(2) - x * x - z * z).sqrt(),
            Self::Wavy(amplitude, length) => amplitude * (std::f64::consts::TAU * x / length).cos(),
        }
    }
}

impl Grid {
    fn number(&self, [i, j, k]: [usize; 3]) -> usize {
        1 + i + (self.cells[0] + 1) * (j + (self.cells[1] + 1) * k)
    }

    fn place(&self, at: [usize; 3]) -> [f64; 3] {
        let share = |c: usize| at[c] as f64 / self.cells[c].max(1) as f64;
        let mut x: [f64; 3] = std::array::from_fn(|c| self.min[c] + share(c) * (self.max[c] - self.min[c]));
        let [bottom, top] = self.sides.map(|side| side.height(x));
        x[1] += bottom * (1.0 - share(1)) + top * share(1);
        x
    }

    /// The transformed grid as a Gmsh 2.2 file with the sides `bottom` and `top`.
    pub fn file(&self, change: &Change) -> Result<String, std::fmt::Error> {
        let [nx, ny, nz] = self.cells;
        let space = nz > 0;
        let mut text = String::from("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n");
        let (side, body) = if space { (2, 3) } else { (1, 2) };
        writeln!(text, "{side} 1 \"bottom\"\n{side} 2 \"top\"\n{body} 3 \"all\"\n$EndPhysicalNames\n$Nodes")?;
        writeln!(text, "{}", (nx + 1) * (ny + 1) * (nz + 1))?;
        for (k, j, i) in walk([nz + 1, ny + 1, nx + 1]) {
            let [x, y, z] = change.transform(self.place([i, j, k]));
            writeln!(text, "{} {x:?} {y:?} {z:?}", self.number([i, j, k]))?;
        }
        let mut cells: Vec<(usize, usize, Vec<[usize; 3]>)> = Vec::new();
        for (k, i) in walk([1, nz.max(1), nx]).map(|(_, k, i)| (k, i)) {
            for (tag, j) in [(1, 0), (2, ny)] {
                let line = vec![[i, j, k], [i + 1, j, k]];
                let face = vec![[i, j, k], [i + 1, j, k], [i + 1, j, k + 1], [i, j, k + 1]];
                cells.push(if space { (3, tag, face) } else { (1, tag, line) });
            }
            for j in 0..ny {
                let mut corners = vec![[i, j, k], [i + 1, j, k], [i + 1, j + 1, k], [i, j + 1, k]];
                if change.reflects() {
                    corners.reverse();
                }
                if space {
                    let behind: Vec<[usize; 3]> = corners.iter().map(|&[i, j, k]| [i, j, k + 1]).collect();
                    corners.extend(behind);
                }
                cells.push((if space { 5 } else { 3 }, 3, corners));
            }
        }
        writeln!(text, "$EndNodes\n$Elements\n{}", cells.len())?;
        for (n, (kind, tag, corners)) in cells.iter().enumerate() {
            let nodes: Vec<String> = corners.iter().map(|&c| self.number(c).to_string()).collect();
            writeln!(text, "{} {kind} 2 {tag} {tag} {}", n + 1, nodes.join(" "))?;
        }
        text += "$EndElements\n";
        Ok(text)
    }
}

/// All index triples below a bound, the last index fastest.
fn walk([a, b, c]: [usize; 3]) -> impl Iterator<Item = (usize, usize, usize)> {
    (0..a).flat_map(move |i| (0..b).flat_map(move |j| (0..c).map(move |k| (i, j, k))))
}
