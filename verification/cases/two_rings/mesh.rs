//! Quarters of rings as a Gmsh file.

use super::exact::RADII;
use std::f64::consts::FRAC_PI_2;
use std::fmt::Write;

/// Mesh of both rings with these numbers of cells around (inner, outer) and across, of order 1 (quad4) or 2 (quad9).
pub fn rings(around: [usize; 2], across: usize, order: usize) -> String {
    let (mut nodes, mut cells, mut count) = (String::new(), String::new(), (0, 0));
    for ring in 0..2 {
        let grid = Grid { first: count.0, around: around[ring] * order, across: across * order };
        for j in 0..=grid.across {
            for i in 0..=grid.around {
                let r = RADII[ring] + (RADII[ring + 1] - RADII[ring]) * j as f64 / grid.across as f64;
                let (sin, cos) = (FRAC_PI_2 * i as f64 / grid.around as f64).sin_cos();
                count.0 += 1;
                let _ = writeln!(nodes, "{} {:.17e} {:.17e} 0", count.0, r * cos, r * sin);
            }
        }
        let mut element = |kind: usize, group: usize, nodes: &[usize]| {
            count.1 += 1;
            let list: Vec<String> = nodes.iter().map(usize::to_string).collect();
            let _ = writeln!(cells, "{} {kind} 2 {group} {group} {}", count.1, list.join(" "));
        };
        grid.cells(order, |nodes| element([3, 10][order - 1], 1 + ring, nodes));
        // Line groups: the sides of small and large radius, then those on the axes.
        let sides = [[3, 4], [5, 6]][ring];
        for (side, group) in [(0, sides[0]), (1, sides[1]), (2, 7), (3, 8)] {
            grid.side(side, order, |nodes| element([1, 8][order - 1], group, nodes));
        }
    }
    let names = ["inner", "outer", "bore", "outside", "inside", "rim", "bottom", "left"];
    let mut text = format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n", names.len());
    for (k, name) in names.iter().enumerate() {
        let _ = writeln!(text, "{} {} \"{name}\"", if k < 2 { 2 } else { 1 }, k + 1);
    }
    let _ = write!(text, "$EndPhysicalNames\n$Nodes\n{}\n{nodes}$EndNodes\n", count.0);
    let _ = write!(text, "$Elements\n{}\n{cells}$EndElements\n", count.1);
    text
}

/// Nodes of a ring: `across + 1` circles of `around + 1` nodes.
struct Grid {
    first: usize,
    around: usize,
    across: usize,
}

impl Grid {
    fn at(&self, i: usize, j: usize) -> usize {
        self.first + 1 + j * (self.around + 1) + i
    }

    fn cells(&self, order: usize, mut each: impl FnMut(&[usize])) {
        for j in (0..self.across).step_by(order) {
            for i in (0..self.around).step_by(order) {
                let at = |s: usize, t: usize| self.at(i + t, j + s);
                // Radius first, then angle: this order is anticlockwise.
                let corners = [at(0, 0), at(order, 0), at(order, order), at(0, order)];
                match order {
                    1 => each(&corners),
                    _ => {
                        let [a, b, c, d] = corners;
                        each(&[a, b, c, d, at(1, 0), at(2, 1), at(1, 2), at(0, 1), at(1, 1)]);
                    }
                }
            }
        }
    }

    fn side(&self, side: usize, order: usize, mut each: impl FnMut(&[usize])) {
        let length = if side < 2 { self.around } else { self.across };
        let at = |k: usize| match side {
            0 => self.at(k, 0),
            1 => self.at(k, self.across),
            2 => self.at(0, k),
            _ => self.at(self.around, k),
        };
        for k in (0..length).step_by(order) {
            match order {
                1 => each(&[at(k), at(k + 1)]),
                _ => each(&[at(k), at(k + 2), at(k + 1)]),
            }
        }
    }
}
