//! Share of the elastic energy that lies in changes of strain within cells.
//!
//! Cells of first order follow a strain that changes within them too stiffly. A bar that bends, of length l a cell and height H,
//! takes 1 + (l/H)²/(2(1 + ν)) times its moment in quad4, whatever the number of cells across, and cells of constant strain
//! take more. The energy of these changes, over that of all strain, is of the order of the error of the stiffness: of square
//! cells, n across a bar, it is about 1.4/n² and the error 0.6/n² (ν = 0.3). In a cell of constant strain the change is that
//! from the mean around its nodes (O. C. Zienkiewicz & J. Z. Zhu, Int. J. Numer. Methods Eng. 24 (1987) 337).

use asperity_fem::kinematics::Idealisation;
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::Cells;
use asperity_fem::nonlinear::{Kinematics, Material};
use asperity_fem::quadrature::Point;
use asperity_mechanics::{Body, CellBlock, Model};
use asperity_run::Warning;
use nalgebra::DMatrix;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Share of the energy from which a body is warned of: that of a bar of three square cells of quad4 across.
const LARGEST: f64 = 0.15;

/// Cells of a block above which only some are measured, at equal distances.
const MOST_CELLS: usize = 100_000;

/// Strain over the rotation of the body below which it is rounding.
const ROUNDING: f64 = 1e-8;

/// Strain xx, yy, zz, xy, yz, zx (shear not doubled) \[-\].
type Strain = [f64; 6];

/// Energies of a body \[J; J per metre of thickness\].
#[derive(Clone, Copy, Debug, Default)]
struct Energies {
    /// Energy of all strain.
    all: f64,
    /// Energy of the changes of strain within cells.
    varied: f64,
    /// Energy of strains that are rounding.
    rounding: f64,
}

impl Energies {
    fn sum(self, other: Self) -> Self {
        let (all, varied) = (self.all + other.all, self.varied + other.varied);
        Self { all, varied, rounding: self.rounding + other.rounding }
    }
}

/// Warning about a body that bends within its cells of first order under displacements `u` \[m\].
pub(super) fn warning<const D: usize>(
    model: &Model<D>,
    body: &Body<D>,
    stage: &str,
    u: &[f64],
) -> Option<Warning> {
    if model.idealisation == Idealisation::Antiplane || !body.blocks.clone().all(|b| is_elastic(model, b)) {
        // Nothing bends, or strain is not that of elastic energy.
        return None;
    }
    let moved = u[body.nodes.start * D..body.nodes.end * D].iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let still = ROUNDING * moved / extent(model, body);
    let blocks = body.blocks.clone().zip(&body.elastic);
    let of_block =
        |(block, elastic): (usize, &Elastic)| StrainedBlock { model, block, elastic, u }.energies(still);
    let Energies { all, varied, rounding } = blocks.map(of_block).fold(Energies::default(), Energies::sum);
    (all > rounding && varied > LARGEST * all).then(|| {
        Warning::at(
            0..0,
            format!(
                "body `{}` bends within its cells of {} in stage `{stage}`: {:.0} % of its elastic energy lies in changes of strain within single cells, \
                 which cells of first order resist too stiffly",
                body.name,
                model.mesh.blocks[body.blocks.start].kind.name(),
                100.0 * varied / all
            ),
            "use cells of second order, or at least four cells across what bends",
        )
    })
}

/// True if a block accounts for large deformation.
pub(super) fn is_followed<const D: usize>(model: &Model<D>, block: usize) -> bool {
    matches!(&model.blocks.get(block), Some(CellBlock::Nonlinear(b)) if b.model().kinematics == Kinematics::UpdatedLagrangian)
}

fn is_elastic<const D: usize>(model: &Model<D>, block: usize) -> bool {
    match model.blocks.get(block) {
        Some(CellBlock::Nonlinear(block)) => matches!(block.model().material, Material::Elastic(_)),
        _ => true,
    }
}

/// Largest extent of a body along an axis \[m\].
fn extent<const D: usize>(model: &Model<D>, body: &Body<D>) -> f64 {
    let along = |c: usize| {
        let x = model.mesh.nodes[body.nodes.clone()].iter().map(|x| x[c]);
        let range = x.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
        range[1] - range[0]
    };
    (0..D).map(along).fold(0.0, f64::max)
}

/// A block of cells under displacements.
struct StrainedBlock<'a, const D: usize> {
    model: &'a Model<D>,
    block: usize,
    elastic: &'a Elastic,
    u: &'a [f64],
}

impl<const D: usize> StrainedBlock<'_, D> {
    fn cells(&self) -> &Cells {
        &self.model.mesh.blocks[self.block]
    }

    /// Energies of its cells, where strains of `still` are rounding.
    fn energies(&self, still: f64) -> Energies {
        let (cells, points) = (self.cells(), self.cells().kind.quadrature());
        let means = if points.len() == 1 { self.means_at_nodes(&points[0]) } else { BTreeMap::new() };
        let of_cell = |cell: usize| {
            let at: Vec<_> = points.iter().map(|point| self.strain(cell, point)).collect();
            let volume: f64 = at.iter().map(|(_, v)| v).sum();
            let varied = match cells.kind.order() {
                1 if means.is_empty() => {
                    let mean = mean(&at);
                    at.iter().map(|(e, v)| v * self.energy(&less(e, &mean))).sum()
                }
                1 => {
                    let nodes = cells.cell(cell).iter();
                    let share = volume / cells.kind.nodes() as f64;
                    nodes.map(|n| share * self.energy(&less(&at[0].0, &means[n]))).sum()
                }
                // Strain is linear within the others, as that of bending.
                _ => 0.0,
            };
            let all = at.iter().map(|(e, v)| v * self.energy(e)).sum();
            Energies { all, varied, rounding: 0.5 * self.elastic.young() * still * still * volume }
        };
        let stride = if means.is_empty() { cells.len().div_ceil(MOST_CELLS).max(1) } else { 1 };
        let measured: Vec<usize> = (0..cells.len()).step_by(stride).collect();
        // Summed in the order of the cells, whatever the number of threads.
        let each: Vec<Energies> = measured.par_iter().map(|cell| of_cell(*cell)).collect();
        each.into_iter().fold(Energies::default(), Energies::sum)
    }

    /// Mean strain of the cells around each node, weighted by volume, of cells with one point.
    fn means_at_nodes(&self, point: &Point) -> BTreeMap<usize, Strain> {
        let mut around: BTreeMap<usize, Vec<(Strain, f64)>> = BTreeMap::new();
        for cell in 0..self.cells().len() {
            let own = self.strain(cell, point);
            self.cells().cell(cell).iter().for_each(|n| around.entry(*n).or_default().push(own));
        }
        around.into_iter().map(|(n, all)| (n, mean(&all))).collect()
    }

    /// Strain at a point of a cell, and the volume of the point \[m^D\]; that of Green and Lagrange where displacements are large.
    fn strain(&self, cell: usize, point: &Point) -> (Strain, f64) {
        let (model, nodes, shape) = (self.model, self.cells().cell(cell), self.cells().kind.shape(point.0));
        let (mut jacobian, mut natural) = (DMatrix::<f64>::zeros(D, D), DMatrix::<f64>::zeros(D, D));
        for (node, dn) in nodes.iter().zip(&shape.dn) {
            for (i, m) in (0..D).flat_map(|i| (0..D).map(move |m| (i, m))) {
                jacobian[(i, m)] += model.mesh.nodes[*node][i] * dn[m];
                natural[(i, m)] += self.u[node * D + i] * dn[m];
            }
        }
        // A cell whose Jacobian cannot be inverted is refused when the bodies are built.
        let volume = jacobian.determinant();
        let Some(inverse) = jacobian.try_inverse() else { return ([0.0; 6], 0.0) };
        let gradient = natural * inverse;
        let mut strain = 0.5 * (&gradient + gradient.transpose());
        if is_followed(model, self.block) {
            strain += 0.5 * gradient.tr_mul(&gradient);
        }
        let entry = |i: usize, j: usize| if i < D && j < D { strain[(i, j)] } else { 0.0 };
        let mut all = [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)];
        match model.idealisation {
            Idealisation::PlaneStress => {
                all[2] = -self.elastic.poisson() / (1.0 - self.elastic.poisson()) * (all[0] + all[1]);
            }
            Idealisation::Axisymmetric => {
                let sum = |of: &dyn Fn(usize) -> f64| {
                    nodes.iter().zip(&shape.n).map(|(k, n)| n * of(*k)).sum::<f64>()
                };
                all[2] = sum(&|node| self.u[node * D]) / sum(&|node| model.mesh.nodes[node][0]);
            }
            _ => {}
        }
        (all, volume * point.1)
    }

    /// Elastic energy of a strain per volume \[J/m³\].
    fn energy(&self, e: &Strain) -> f64 {
        let trace = e[0] + e[1] + e[2];
        let square =
            e[..3].iter().map(|e| e * e).sum::<f64>() + 2.0 * e[3..].iter().map(|e| e * e).sum::<f64>();
        0.5 * self.elastic.lame() * trace * trace + self.elastic.shear() * square
    }
}

/// Mean of strains with their volumes.
fn mean(all: &[(Strain, f64)]) -> Strain {
    let volume: f64 = all.iter().map(|(_, v)| v).sum();
    std::array::from_fn(|k| all.iter().map(|(e, v)| e[k] * v).sum::<f64>() / volume)
}

fn less(a: &Strain, b: &Strain) -> Strain {
    std::array::from_fn(|k| a[k] - b[k])
}
