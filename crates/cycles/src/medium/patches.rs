//! Homogeneous rock without bodies: tractions that uniform slip of patches causes at their centres, from dislocations in closed
//! form.
//!
//! Positions of faults have y up; the free surface of a half-space is y = 0. The axes of [`crate::kernel`] have z up: in the plane
//! (x, z) of a kernel is (x, y) here, in space (x, y, z) of a kernel is (z, x, y) here, which keeps the handedness.

use crate::kernel::{Field, Rectangle, Segment, Space, Triangle};
use crate::operator::{
    Accuracy, Both, CheckedOperator, Dense, Division, Entry, Form, Geometry, Lattice, Operator, Planar,
    Toeplitz, Tractions, dense,
};
use asperity_fem::material::elastic::Elastic;
use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;

/// Patches of uniform slip.
#[derive(Clone, Debug)]
pub enum Patches {
    /// Segments of the plane that slip out of it.
    Antiplane(Vec<Segment>),
    /// Segments of the plane that slip along themselves.
    Plane(Vec<Segment>),
    /// Rectangles and triangles in space.
    Space {
        /// Rectangles and triangles.
        tiles: Vec<Tile>,
        /// Grids of equal rectangles.
        grids: Vec<Lattice>,
    },
}

/// The dislocation of a tile, in the axes of kernels.
#[derive(Clone, Copy, Debug)]
pub enum Shape {
    /// A rectangle.
    Rectangle(Rectangle),
    /// A triangle.
    Triangle(Triangle),
}

impl Shape {
    /// Unit vectors along strike, up dip and along the normal, as columns.
    #[must_use]
    pub fn frame(&self) -> Matrix3<f64> {
        match self {
            Self::Rectangle(rectangle) => rectangle.frame(),
            Self::Triangle(triangle) => triangle.frame(),
        }
    }

    /// Field at a point, caused by slip.
    pub(super) fn field(&self, at: &Vector3<f64>, slip: &Vector3<f64>, poisson: f64) -> Field {
        match self {
            Self::Rectangle(rectangle) => rectangle.field(at, slip, poisson),
            Self::Triangle(triangle) => triangle.field(at, slip, poisson),
        }
    }
}

/// A rectangle or triangle with its directions of slip.
#[derive(Clone, Copy, Debug)]
pub struct Tile {
    /// The dislocation.
    pub shape: Shape,
    /// Unit direction of the first component of slip.
    pub rake: [f64; 3],
    /// Unit direction of the second component.
    pub across: [f64; 3],
    /// Unit normal from minus to plus.
    pub normal: [f64; 3],
    /// Centre \[m\].
    pub at: [f64; 3],
    /// Number of its grid, and its column and row in it; none of a triangle.
    pub cell: Option<(usize, [usize; 2])>,
}

/// Position or vector in the axes of kernels.
#[must_use]
pub fn to_kernel(v: &[f64; 3]) -> Vector3<f64> {
    Vector3::new(v[2], v[0], v[1])
}

/// Position or vector from the axes of kernels.
#[must_use]
pub fn from_kernel(v: &Vector3<f64>) -> [f64; 3] {
    [v[1], v[2], v[0]]
}

/// Ratio of the change of normal traction, or of shear traction across slip, to that along slip, below which it is
/// rounding: that of differences of the terms of corners whose coordinates are a thousand times the size of a patch.
const UNCOUPLED: f64 = 1e-11;

/// Tractions at a point per slip of a patch: along both tangents, and the normal traction, compression positive \[Pa/m\].
type Pull = [f64; PARTS];
/// Number of parts of a [`Pull`].
const PARTS: usize = 3;
/// Number of the normal traction in a [`Pull`].
const NORMAL: usize = 2;

/// Slip and its effects that an operator holds.
#[derive(Clone, Copy, Debug)]
pub struct Slip<'a> {
    /// Number of components of slip.
    pub tangents: usize,
    /// For each patch, whether slip changes its normal traction.
    pub changes: &'a [bool],
}

impl Patches {
    /// Number of patches.
    #[must_use]
    pub fn count(&self) -> usize {
        match self {
            Self::Antiplane(segments) | Self::Plane(segments) => segments.len(),
            Self::Space { tiles, .. } => tiles.len(),
        }
    }

    /// The grid to which all patches belong.
    fn grid(&self) -> Option<(&[Tile], &Lattice)> {
        match self {
            Self::Space { tiles, grids } if grids.len() == 1 && grids[0].points.len() == tiles.len() => {
                Some((tiles, &grids[0]))
            }
            _ => None,
        }
    }

    /// Operator of these patches. In [`Form::Fitting`], that of a single grid is a [`Planar`] or a [`Toeplitz`], and that of many
    /// points is compressed from its entries, without the whole matrix.
    #[must_use]
    pub fn operator(
        &self,
        rock: &Elastic,
        slip: Slip<'_>,
        geometry: &Geometry<'_>,
        form: Form,
    ) -> Box<dyn Operator> {
        match (self.storage(), form) {
            (Storage::Plane(tiles, lattice), Form::Fitting) => {
                Box::new(planar_operator(tiles, lattice, rock, slip.tangents))
            }
            (Storage::Grid(tiles, lattice), Form::Fitting) => grid_operator(tiles, lattice, rock, slip),
            (Storage::Compressed, Form::Fitting) => self.compressed(rock, slip, geometry, self.tolerance()),
            (_, Form::Compressed { tolerance }) => self.compressed(rock, slip, geometry, tolerance),
            (_, Form::Dense | Form::Fitting) => dense(self.tractions(rock, slip)),
        }
    }

    /// Storage that fits these patches.
    fn storage(&self) -> Storage<'_> {
        match self.grid() {
            Some((tiles, lattice)) if in_whole_space(tiles) => Storage::Plane(tiles, lattice),
            Some((tiles, lattice)) => Storage::Grid(tiles, lattice),
            None if self.count() < self.compressed_from() => Storage::Dense,
            None => Storage::Compressed,
        }
    }

    /// Tolerance of a compressed operator.
    fn tolerance(&self) -> f64 {
        match self {
            Self::Antiplane(_) | Self::Plane(_) => ON_LINES,
            Self::Space { .. } => ON_SURFACES,
        }
    }

    /// Number of patches from which the operator is compressed. With fewer, a product with the dense one takes as long.
    fn compressed_from(&self) -> usize {
        match self {
            Self::Antiplane(_) | Self::Plane(_) => 128,
            Self::Space { .. } => 512,
        }
    }

    /// Reason for the storage of the operator.
    #[must_use]
    pub fn reason(&self) -> String {
        let (count, from) = (self.count(), self.compressed_from());
        match self.storage() {
            Storage::Plane(_, grid) => format!(
                "the operator is a convolution along strike and down dip, as all {} cells belong to one grid in a whole-space",
                grid.points.len()
            ),
            Storage::Grid(_, grid) => format!(
                "the operator is a convolution along strike, as all {} cells belong to one grid",
                grid.points.len()
            ),
            Storage::Dense => {
                format!("the operator is dense, as {count} cells are fewer than {from}")
            }
            Storage::Compressed => format!(
                "the operator is compressed from its entries, as {count} cells are {from} or more and form no single grid"
            ),
        }
    }

    /// Largest memory that making the operator in [`Form::Fitting`] takes \[bytes\]; of a compressed one it is an estimate.
    #[must_use]
    pub fn bytes(&self, tangents: usize, geometry: &Geometry<'_>) -> usize {
        let matrices = match self {
            Self::Antiplane(_) => 1,
            Self::Plane(_) => 2,
            Self::Space { .. } => tangents * (tangents + 1),
        };
        match self.storage() {
            // Pulls at half of the distances, a table of all, spectra of four times the number of cells, of which half are held, and
            // working memory.
            Storage::Plane(_, grid) => {
                let values = 2 * PARTS + 4 * tangents * (1 + tangents) / 2 + 6 * tangents + 12;
                values * grid.points.len() * size_of::<f64>()
            }
            // A table of pulls, and real and imaginary parts of spectra of twice the number of columns.
            Storage::Grid(_, grid) => {
                grid.distances() * grid.rows.pow(2) * (PARTS + matrices * 2) * size_of::<f64>()
            }
            Storage::Dense => matrices * self.count().pow(2) * size_of::<f64>(),
            Storage::Compressed => Division::new(geometry).bytes(matrices, self.tolerance()),
        }
    }

    /// Tractions in the centres of all patches caused by slip of each.
    fn tractions(&self, rock: &Elastic, slip: Slip<'_>) -> Tractions {
        let n = self.count();
        let changes = slip.changes.contains(&true);
        let of = |component: usize| {
            let across = (slip.tangents > 1).then_some(1 - component);
            let parts = [Some(component), changes.then_some(NORMAL), across];
            let parts: Vec<usize> = parts.into_iter().flatten().collect();
            let pulls = Pulls::new(self, rock, component);
            let mut all = filled(n, &parts, |k, j| pulls.at(k, j)).into_iter();
            let shear = all.next().unwrap_or_default();
            let least = UNCOUPLED * largest(&shear);
            let normal = changes.then(|| all.next()).flatten().map(|mut normal| {
                let rows = normal.chunks_exact_mut(n).zip(slip.changes);
                rows.filter(|(_, changes)| !**changes).for_each(|(row, _)| row.fill(0.0));
                normal
            });
            let coupled = |m: &Vec<f64>| largest(m) > least;
            let across = all.next().map(|m| (coupled(&m), m));
            (Dense::new(n, shear, normal.filter(coupled)), across)
        };
        let (first, by_first) = of(0);
        if slip.tangents == 1 {
            return Tractions::One(first);
        }
        let (second, by_second) = of(1);
        let across = by_second.zip(by_first).filter(|(a, b)| a.0 || b.0);
        let across = across.map(|(a, b)| Box::new([a.1, b.1].map(|m| Dense::new(n, m, None))));
        Tractions::Two { along: Box::new([first, second]), across }
    }

    /// Operator compressed from entries, with its errors.
    fn compressed(
        &self,
        rock: &Elastic,
        slip: Slip<'_>,
        geometry: &Geometry<'_>,
        tolerance: f64,
    ) -> Box<dyn Operator> {
        let n = self.count();
        let division = Division::new(geometry);
        let pulls: Vec<Pulls<'_>> = (0..slip.tangents).map(|c| Pulls::new(self, rock, c)).collect();
        let largest = (0..n).map(|k| pulls[0].at(k, k)[0].abs()).fold(0.0, f64::max);
        let accuracy = Accuracy { tolerance, rounding: ROUNDING * largest };
        let coupled = |c: usize, part: usize| pulls[c].reach(part) > UNCOUPLED * largest;
        let changes = slip.changes.contains(&true);
        let along = |c: usize| -> Box<dyn Operator> {
            let shear = |k: usize, j: usize| pulls[c].at(k, j)[c];
            let normal = |k: usize, j: usize| if slip.changes[k] { pulls[c].at(k, j)[NORMAL] } else { 0.0 };
            let normal: Option<Entry<'_>> = if changes && coupled(c, NORMAL) { Some(&normal) } else { None };
            Box::new(division.operator(&shear, normal, accuracy))
        };
        let across = |c: usize| -> Box<dyn Operator> {
            Box::new(division.operator(&|k, j| pulls[c].at(k, j)[1 - c], None, accuracy))
        };
        let operator = if slip.tangents == 1 {
            along(0)
        } else {
            let across = (coupled(0, 1) || coupled(1, 0)).then(|| [across(1), across(0)]);
            Box::new(Both::new([along(0), along(1)], across))
        };
        let row = |k: usize| {
            let part = |part: usize| {
                let of = |pulls: &Pulls<'_>| (0..n).map(|j| pulls.at(k, j)[part]).collect::<Vec<f64>>();
                if part == NORMAL && !slip.changes[k] {
                    vec![0.0; slip.tangents * n]
                } else {
                    pulls.iter().flat_map(of).collect()
                }
            };
            [part(0), part(1), part(NORMAL)]
        };
        Box::new(CheckedOperator::new(operator, &row))
    }
}

/// Storage of an operator.
enum Storage<'a> {
    /// A convolution along strike and down dip.
    Plane(&'a [Tile], &'a Lattice),
    /// A convolution along strike.
    Grid(&'a [Tile], &'a Lattice),
    /// All entries.
    Dense,
    /// Blocks of low rank.
    Compressed,
}

/// Error of a compressed block over the block, on lines. Tractions of uniform slip of a thousand cells cancel to a thousandth, and
/// 1e-4 moves the onset of the first event of BP1 by 2e-4.
const ON_LINES: f64 = 1e-6;
/// The same on surfaces, where it moves intervals between events by less than 1e-6.
const ON_SURFACES: f64 = 1e-4;
/// Size of entries that are rounding, over the largest of a patch on itself: terms of corners lose some units in the last
/// place.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Tractions of slip of one component, entry by entry.
struct Pulls<'a> {
    patches: &'a Patches,
    rock: &'a Elastic,
    component: usize,
    /// Different tractions within each grid.
    tables: Vec<Vec<Pull>>,
}

impl<'a> Pulls<'a> {
    fn new(patches: &'a Patches, rock: &'a Elastic, component: usize) -> Self {
        let tables = match patches {
            Patches::Space { tiles, grids } => {
                grids.iter().map(|grid| table(tiles, grid, rock, component)).collect()
            }
            Patches::Antiplane(_) | Patches::Plane(_) => Vec::new(),
        };
        Self { patches, rock, component, tables }
    }

    /// Tractions at a point per slip of a patch.
    fn at(&self, k: usize, j: usize) -> Pull {
        match self.patches {
            Patches::Antiplane(all) => out_of_plane(&all[k], &all[j], self.rock),
            Patches::Plane(all) => in_plane(&all[k], &all[j], self.rock),
            Patches::Space { tiles, grids } => {
                let (point, patch) = (&tiles[k], &tiles[j]);
                match (point.cell, patch.cell) {
                    (Some((grid, at)), Some((other, from))) if grid == other => {
                        self.tables[grid][grids[grid].entry(at, from)]
                    }
                    _ => on_tile(point, patch, self.rock, self.component),
                }
            }
        }
    }

    /// Largest part of the tractions at some points, spread over the faults. Slip of every patch counts.
    fn reach(&self, part: usize) -> f64 {
        let n = self.patches.count();
        let of = |k: usize| (0..n).map(|j| self.at(k, j)[part].abs()).fold(0.0, f64::max);
        let step = n.div_ceil(REACHED);
        (0..n).into_par_iter().step_by(step).map(of).reduce(|| 0.0, f64::max)
    }
}

/// Number of points at which it is examined whether slip changes a part of the tractions.
const REACHED: usize = 16;

/// Square matrices of these parts of the entries, row by row.
fn filled(n: usize, parts: &[usize], pull: impl Fn(usize, usize) -> Pull + Sync) -> Vec<Vec<f64>> {
    let mut matrices = vec![vec![0.0; n * n]; parts.len()];
    let mut rows: Vec<Vec<&mut [f64]>> = (0..n).map(|_| Vec::with_capacity(parts.len())).collect();
    for matrix in &mut matrices {
        rows.iter_mut().zip(matrix.chunks_exact_mut(n)).for_each(|(rows, row)| rows.push(row));
    }
    rows.par_iter_mut().enumerate().for_each(|(k, rows)| {
        for j in 0..n {
            let pull = pull(k, j);
            rows.iter_mut().zip(parts).for_each(|(row, &part)| row[j] = pull[part]);
        }
    });
    drop(rows);
    matrices
}

/// Tractions in the middle of a segment per slip of another out of the plane.
fn out_of_plane(point: &Segment, patch: &Segment, rock: &Elastic) -> Pull {
    let n = point.normal();
    let s = patch.screw(point.middle(), 1.0).stress(rock.shear());
    [n[0] * s[0] + n[1] * s[1], 0.0, 0.0]
}

/// Tractions in the middle of a segment per slip of another along itself.
fn in_plane(point: &Segment, patch: &Segment, rock: &Elastic) -> Pull {
    let (n, t) = (point.normal(), point.tangent());
    let [xx, zz, xz] = patch.edge(point.middle(), [1.0, 0.0], rock).stress;
    let on = [xx * n[0] + xz * n[1], xz * n[0] + zz * n[1]];
    [t[0] * on[0] + t[1] * on[1], 0.0, -(n[0] * on[0] + n[1] * on[1])]
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m: f64, v| m.max(v.abs()))
}

/// Tractions in the middle of a tile per slip of another in a component.
fn on_tile(point: &Tile, patch: &Tile, rock: &Elastic, component: usize) -> Pull {
    let slip = to_kernel([&patch.rake, &patch.across][component]);
    let field = patch.shape.field(&to_kernel(&point.at), &slip, rock.poisson());
    let normal = to_kernel(&point.normal);
    let traction = field.traction(rock, &normal);
    let along = |v: &[f64; 3]| traction.dot(&to_kernel(v));
    [along(&point.rake), along(&point.across), -traction.dot(&normal)]
}

/// Different tractions within a grid, in the order of [`Lattice::entry`]. Tiles of a grid are equal along strike, so that
/// tractions depend on the distance along it: c columns and r rows have (2 c - 1) r² different ones instead of c² r². Where
/// slip is along strike or down dip, those on both sides of a patch are the same, or opposite.
fn table(tiles: &[Tile], grid: &Lattice, rock: &Elastic, component: usize) -> Vec<Pull> {
    let (columns, rows) = (grid.columns, grid.rows);
    let tile = |row: usize, column: usize| &tiles[grid.points[row * columns + column]];
    let mut table = vec![Pull::default(); grid.distances() * rows * rows];
    let signs = grid.points.first().and_then(|&first| mirrored(&tiles[first], component));
    let size = rows * rows;
    // Distances from zero, to patches that lie behind the point; and those to patches ahead of it.
    let ahead = if signs.is_some() { columns - 1 } else { 0 };
    table.par_chunks_exact_mut(size).enumerate().skip(ahead).for_each(|(distance, block)| {
        // The pair of columns at this distance that lies at an end of the grid.
        let (point, patch) =
            if distance < columns { (0, columns - 1 - distance) } else { (distance + 1 - columns, 0) };
        for (k, pull) in block.iter_mut().enumerate() {
            *pull = on_tile(tile(k / rows, point), tile(k % rows, patch), rock, component);
        }
    });
    let Some(signs) = signs else { return table };
    let (mirror, rest) = table.split_at_mut(ahead * size);
    for (block, same) in mirror.chunks_exact_mut(size).rev().zip(rest.chunks_exact(size).skip(1)) {
        for (pull, same) in block.iter_mut().zip(same) {
            *pull = std::array::from_fn(|part| signs[part] * same[part]);
        }
    }
    table
}

/// Ratios of the tractions on both sides of a patch along strike, where it slips along strike or down dip. The plane normal to
/// strike through its middle mirrors it into itself: slip down dip is kept, and slip along strike turns round.
fn mirrored(tile: &Tile, component: usize) -> Option<Pull> {
    let strike: Vector3<f64> = tile.shape.frame().column(0).into();
    let along = [&tile.rake, &tile.across].map(|slip| to_kernel(slip).dot(&strike).abs());
    let turned = |k: usize| if along[k] > 0.5 { -1.0 } else { 1.0 };
    let level = along.iter().all(|share| *share <= LEVEL || 1.0 - share <= LEVEL);
    level.then(|| [turned(0), turned(1), 1.0].map(|sign| sign * turned(component)))
}

/// Share of slip along strike that is rounding.
const LEVEL: f64 = 8.0 * f64::EPSILON;

/// True if the rock around all tiles has no surface.
fn in_whole_space(tiles: &[Tile]) -> bool {
    tiles.iter().all(|tile| matches!(&tile.shape, Shape::Rectangle(r) if r.space() == Space::Whole))
}

/// Operator of a single grid in a whole-space.
fn planar_operator(tiles: &[Tile], lattice: &Lattice, rock: &Elastic, tangents: usize) -> Planar {
    let tile = |column: usize, row: usize| &tiles[lattice.points[row * lattice.columns + column]];
    Planar::new(lattice.clone(), tangents, |distance| {
        // The pair of cells at this distance that lies at ends of the grid.
        let [point, patch] = [1, -1].map(|sign| distance.map(|d| (sign * d).max(0).unsigned_abs()));
        let of =
            |component: usize| on_tile(tile(point[0], point[1]), tile(patch[0], patch[1]), rock, component);
        let [along, across, _] = of(0);
        [along, across, if tangents > 1 { of(1)[1] } else { 0.0 }]
    })
}

/// Operator of a single grid.
fn grid_operator(tiles: &[Tile], lattice: &Lattice, rock: &Elastic, slip: Slip<'_>) -> Box<dyn Operator> {
    let part = |table: &[Pull], part: usize| -> Vec<f64> { table.iter().map(|pull| pull[part]).collect() };
    let coupled = |values: &Vec<f64>, shear: &[f64]| largest(values) > UNCOUPLED * largest(shear);
    let of = |component: usize| {
        let table = table(tiles, lattice, rock, component);
        let shear = part(&table, component);
        // All points of a fault have one choice.
        let normal = slip.changes.contains(&true).then(|| part(&table, NORMAL));
        let normal = normal.filter(|m| coupled(m, &shear));
        let across = (slip.tangents > 1).then(|| part(&table, 1 - component));
        let across = across.filter(|m| coupled(m, &shear));
        (Toeplitz::new(lattice.clone(), &shear, normal.as_deref()), across)
    };
    let (first, by_first) = of(0);
    if slip.tangents == 1 {
        return Box::new(first);
    }
    let (second, by_second) = of(1);
    let boxed =
        |table: Vec<f64>| -> Box<dyn Operator> { Box::new(Toeplitz::new(lattice.clone(), &table, None)) };
    let across = by_second.zip(by_first).map(|(a, b)| [boxed(a), boxed(b)]);
    Box::new(Both::new([Box::new(first), Box::new(second)], across))
}
