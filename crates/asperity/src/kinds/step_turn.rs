//! Rotations of deforming cells within single steps.
//!
//! Under large deformation the stress follows a step by its increment at the middle (T. J. R. Hughes & J. Winget, Int. J. Numer.
//! Methods Eng. 15 (1980) 1862). A rigid turn of any size is followed exactly. A strain that comes with a turn by θ errs by about θ²/12 of itself.

use super::cell_gradient::CellGradient;
use super::cell_variation::is_followed;
use asperity_mechanics::{Body, Model};
use asperity_run::Warning;
use nalgebra::DMatrix;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Turn from which a body is warned of \[rad\]: strains then err by about a per cent.
const LARGEST: f64 = 0.3;

/// Change of strain that is none beside the turn: of a rigid motion, rounding and weight.
const STRAINED: f64 = 1e-4;

/// Fewest cells that are judged by one task: a few microseconds of work.
const CELLS: usize = 1024;

/// The largest turn of a body within a step of a stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct StepTurn {
    /// Largest angle \[rad\].
    angle: f64,
    /// End of its step \[s\].
    time: f64,
}

impl StepTurn {
    /// Notes a step that ends at `time` \[s\], from displacements `before` to `u` \[m\].
    pub fn note<const D: usize>(
        &mut self,
        (model, body): (&Model<D>, &Body<D>),
        time: f64,
        before: &[f64],
        u: &[f64],
    ) {
        let blocks = body.blocks.clone().filter(|block| is_followed(model, *block));
        let angle = blocks.map(|block| largest(model, block, before, u)).fold(0.0, f64::max);
        if angle > self.angle {
            *self = Self { angle, time };
        }
    }

    /// Warning about a body in a stage.
    pub fn warning(self, body: &str, stage: &str) -> Option<Warning> {
        (self.angle > LARGEST).then(|| {
            let message = format!(
                "body `{body}` turns or stretches by {:.2} within the step of stage `{stage}` that ends at {:e} s, which leaves an error of about \
                 {:.0} % in its strains",
                self.angle,
                self.time,
                100.0 * self.angle * self.angle / 12.0
            );
            Warning::at(0..0, message, "take shorter steps, by `steps` or `max_step`; a load that acts at once grows along `{ to = .. }`")
        })
    }
}

/// Largest turn of the cells of a block that deform in a step \[rad\].
fn largest<const D: usize>(model: &Model<D>, block: usize, before: &[f64], u: &[f64]) -> f64 {
    let cells = &model.mesh.blocks[block];
    let centre = cells.kind.quadrature().first().map(|point| point.0);
    let Some(at) = centre else { return 0.0 };
    let of_cell = |cell: usize| {
        let [from, to] = [before, u].map(|u| CellGradient::new(model, cells, cell, at, u).gradient);
        let strain = |g: &DMatrix<f64>| 0.5 * (g + g.transpose() + g.tr_mul(g));
        let strained = (strain(&to) - strain(&from)).norm() > STRAINED;
        // Two rotations of a plane by an angle apart differ by twice the square root of two times the sine of half of it.
        let chord = (to - from).norm() / (2.0 * std::f64::consts::SQRT_2);
        if strained { 2.0 * chord.min(1.0).asin() } else { 0.0 }
    };
    (0..cells.len()).into_par_iter().with_min_len(CELLS).map(of_cell).reduce(|| 0.0, f64::max)
}
