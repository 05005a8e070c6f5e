//! Share of the elastic energy that lies in changes of strain within cells.
//!
//! Cells of first order follow a strain that changes within them too stiffly. A bar that bends, of length l a cell and height H,
//! takes 1 + (l/H)²/(2(1 + ν)) times its moment in quad4, whatever the number of cells across, and cells of constant strain
//! take more. The energy of these changes, over that of all strain, is of the order of the error of the stiffness: of square
//! cells, n across a bar, it is about 1.4/n² and the error 0.6/n² (ν = 0.3). In a cell of constant strain the change is that
//! from the mean around its nodes (O. C. Zienkiewicz & J. Z. Zhu, Int. J. Numer. Methods Eng. 24 (1987) 337).

use super::cell_gradient::CellGradient;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::Cells;
use asperity_fem::nonlinear::{Kinematics, Material};
use asperity_fem::quadrature::Point;
use asperity_mechanics::{Body, CellBlock, Model, bounds};
use asperity_run::Warning;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Share of the energy from which a body is warned of: that of a bar of three square cells of quad4 across.
const LARGEST: f64 = 0.15;

/// Cells of a block above which only some are measured, at equal distances.
const MOST_CELLS: usize = 20_000;

/// Strain over the rotation of the body below which it is rounding.
const ROUNDING: f64 = 1e-8;

/// Strain that is rounding whatever moves, as of initial stress in balance with weight: that of stresses far above any strength, a
/// tenth of Young's modulus, is smaller.
const NO_STRAIN: f64 = 0.1 * f64::EPSILON;

/// Strain xx, yy, zz, xy, yz, zx (shear not doubled) \[-\].
type Strain = [f64; 6];

/// Strain at a point of quadrature.
#[derive(Clone, Copy, Debug, Default)]
struct PointStrain {
    strain: Strain,
    /// Volume of the point \[m^D; m³ about an axis\].
    volume: f64,
}

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
    let still = (ROUNDING * moved / extent(model, body)).max(NO_STRAIN);
    let blocks = body.blocks.clone().zip(&body.elastic);
    let of_block = |(block, elastic): (usize, &Elastic)| {
        StrainedBlock { model, body, block, elastic, u }.energies(still)
    };
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
    let (min, max) = bounds(&model.mesh.nodes[body.nodes.clone()]);
    min.iter().zip(max).map(|(min, max)| max - min).fold(0.0, f64::max)
}

/// A block of cells of a body under displacements.
struct StrainedBlock<'a, const D: usize> {
    model: &'a Model<D>,
    body: &'a Body<D>,
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
        let constant = points.len() == 1;
        // Means around nodes need all cells.
        let stride = if constant { 1 } else { cells.len().div_ceil(MOST_CELLS) };
        let measured: Vec<usize> = (0..cells.len()).step_by(stride.max(1)).collect();
        let strains = measured.par_iter().flat_map_iter(|cell| points.iter().map(|p| self.strain(*cell, p)));
        let mut strains: Vec<PointStrain> = strains.collect();
        if self.averages() {
            strains.chunks_mut(points.len()).for_each(average_dilatation);
        }
        let around = if constant { self.means_at_nodes(&strains) } else { Vec::new() };
        let mut sum = Energies::default();
        for (cell, at) in measured.iter().zip(strains.chunks(points.len())) {
            let volume: f64 = at.iter().map(|p| p.volume).sum();
            sum.all += at.iter().map(|p| p.volume * self.energy(&p.strain)).sum::<f64>();
            sum.rounding += 0.5 * self.elastic.young() * still * still * volume;
            sum.varied += match cells.kind.order() {
                1 if constant => {
                    let nodes = cells.cell(*cell);
                    let off =
                        |n: &usize| self.energy(&less(&around[n - self.body.nodes.start], &at[0].strain));
                    volume * nodes.iter().map(off).sum::<f64>() / nodes.len() as f64
                }
                1 => {
                    let mean = mean(at);
                    at.iter().map(|p| p.volume * self.energy(&less(&p.strain, &mean))).sum()
                }
                // Strain is linear within the others, as that of bending.
                _ => 0.0,
            };
        }
        sum
    }

    /// True if its cells resist only the mean of their dilatation.
    fn averages(&self) -> bool {
        let formulation = match &self.model.blocks.get(self.block) {
            Some(CellBlock::Linear(block)) => block.formulation(),
            Some(CellBlock::Nonlinear(block)) => block.model().formulation,
            None => return false,
        };
        formulation == Formulation::BBar
    }

    /// Mean strain around each node of the body, weighted by volume, of cells with one point. Nodes of other blocks have none.
    fn means_at_nodes(&self, strains: &[PointStrain]) -> Vec<Strain> {
        let mut sums = vec![PointStrain::default(); self.body.nodes.len()];
        for (cell, own) in strains.iter().enumerate() {
            for node in self.cells().cell(cell) {
                let sum = &mut sums[node - self.body.nodes.start];
                sum.volume += own.volume;
                sum.strain.iter_mut().zip(own.strain).for_each(|(sum, e)| *sum += own.volume * e);
            }
        }
        sums.iter().map(|sum| sum.strain.map(|e| e / sum.volume)).collect()
    }

    /// Strain at a point of a cell, and its volume; that of Green and Lagrange where displacements are large.
    fn strain(&self, cell: usize, point: &Point) -> PointStrain {
        let (model, cells) = (self.model, self.cells());
        let CellGradient { gradient, jacobian } = CellGradient::new(model, cells, cell, point.0, self.u);
        let mut strain = 0.5 * (&gradient + gradient.transpose());
        if is_followed(model, self.block) {
            strain += 0.5 * gradient.tr_mul(&gradient);
        }
        let entry = |i: usize, j: usize| if i < D && j < D { strain[(i, j)] } else { 0.0 };
        let mut all = [entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(2, 0)];
        let mut volume = jacobian * point.1;
        if model.idealisation == Idealisation::PlaneStress {
            all[2] = -self.elastic.poisson() / (1.0 - self.elastic.poisson()) * (all[0] + all[1]);
        } else if model.idealisation == Idealisation::Axisymmetric {
            let n = cells.kind.shape(point.0).n;
            let at = |of: &dyn Fn(usize) -> f64| -> f64 {
                cells.cell(cell).iter().zip(&n).map(|(node, n)| n * of(*node)).sum()
            };
            let radius = at(&|node| model.mesh.nodes[node][0]);
            all[2] = at(&|node| self.u[node * D]) / radius;
            volume *= TAU * radius;
        }
        PointStrain { strain: all, volume }
    }

    /// Elastic energy of a strain per volume \[J/m³\].
    fn energy(&self, e: &Strain) -> f64 {
        let trace = e[0] + e[1] + e[2];
        let square =
            e[..3].iter().map(|e| e * e).sum::<f64>() + 2.0 * e[3..].iter().map(|e| e * e).sum::<f64>();
        0.5 * self.elastic.lame() * trace * trace + self.elastic.shear() * square
    }
}

/// Mean of the strains of points, weighted by volume.
fn mean(all: &[PointStrain]) -> Strain {
    let volume: f64 = all.iter().map(|p| p.volume).sum();
    std::array::from_fn(|k| all.iter().map(|p| p.strain[k] * p.volume).sum::<f64>() / volume)
}

/// Gives the points of a cell the mean of their dilatations.
fn average_dilatation(all: &mut [PointStrain]) {
    let mean = mean(all);
    let trace = |e: &Strain| e[0] + e[1] + e[2];
    for point in all {
        let off = (trace(&mean) - trace(&point.strain)) / 3.0;
        point.strain[..3].iter_mut().for_each(|e| *e += off);
    }
}

fn less(a: &Strain, b: &Strain) -> Strain {
    std::array::from_fn(|k| a[k] - b[k])
}
