//! Orders of convergence: from errors on several levels to an observed order.

use schemars::JsonSchema;
use serde::Serialize;

/// One level of a convergence study.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Level {
    /// Refined quantity: mesh size, time step, 1/penalty ...
    pub size: f64,
    /// Error at this size.
    pub error: f64,
}

impl From<(f64, f64)> for Level {
    fn from((size, error): (f64, f64)) -> Level {
        Level { size, error }
    }
}

/// Cause of an error floor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Floor {
    /// Mesh size, while the time step is refined.
    Space,
    /// Time step, while the mesh is refined.
    Time,
    /// Tolerance of an iteration.
    Iteration,
    /// Penalty stiffness.
    Penalty,
    /// Floating-point rounding.
    Rounding,
}

impl Floor {
    /// Name in the report.
    pub fn name(self) -> &'static str {
        match self {
            Floor::Space => "space",
            Floor::Time => "time",
            Floor::Iteration => "iteration",
            Floor::Penalty => "penalty",
            Floor::Rounding => "rounding",
        }
    }
}

/// Plateau that the errors of a study may reach.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Plateau {
    /// Cause of the plateau.
    pub floor: Floor,
    /// Levels with an error at or below this value are on the floor and are ignored in the order.
    pub level: f64,
}

/// Number of the finest levels above the plateau to which the order is fitted: enough that a single lucky level does not decide,
/// few enough to exclude levels far from the asymptotic range.
pub const FITTED_LEVELS: usize = 3;

/// A claim on an order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct OrderTest {
    /// The levels, from coarse to fine.
    pub levels: Vec<Level>,
    /// Theoretical order.
    pub expected: f64,
    /// Largest deviation of the observed order.
    pub tolerance: f64,
    /// True if a higher order than expected is accepted.
    pub or_better: bool,
    /// Plateau allowed.
    pub plateau: Option<Plateau>,
}

impl OrderTest {
    /// True if the level is on the plateau.
    pub fn on_plateau(&self, level: &Level) -> bool {
        self.plateau.as_ref().is_some_and(|p| level.error <= p.level)
    }

    /// The observed order: slope of ln(error) over ln(size), least squares over the finest [`FITTED_LEVELS`] levels above
    /// the plateau.
    ///
    /// # Errors
    /// If the levels are too few, not refined or not positive.
    pub fn observed(&self) -> Result<f64, String> {
        if self.levels.len() < FITTED_LEVELS {
            return Err(format!(
                "an order needs {FITTED_LEVELS} levels, and {} are given",
                self.levels.len()
            ));
        }
        if self
            .levels
            .windows(2)
            .any(|pair| pair[1].size.partial_cmp(&pair[0].size).is_none_or(|o| o.is_ge()))
        {
            return Err("the levels do not run from coarse to fine".into());
        }
        if let Some(bad) =
            self.levels.iter().find(|l| !(l.size > 0.0 && l.size.is_finite() && l.error.is_finite()))
        {
            return Err(format!("the error on level {} is {}", bad.size, bad.error));
        }
        let above = self.above();
        if let Some(bad) = above.iter().find(|l| l.error <= 0.0) {
            return Err(format!(
                "the error {} on level {} has no logarithm and no floor",
                bad.error, bad.size
            ));
        }
        if above.len() < 2 {
            return Err("fewer than two levels are above the plateau".into());
        }
        Ok(slope(&self.fitted()))
    }

    /// Levels above the plateau.
    fn above(&self) -> Vec<&Level> {
        self.levels.iter().filter(|l| !self.on_plateau(l)).collect()
    }

    /// Levels to which the order is fitted.
    pub fn fitted(&self) -> Vec<&Level> {
        let above = self.above();
        above[above.len().saturating_sub(FITTED_LEVELS)..].to_vec()
    }

    /// Deviation of an observed order from the claimed one \[-\].
    pub fn deviation(&self, observed: f64) -> f64 {
        let short = self.expected - observed;
        if self.or_better { short.max(0.0) } else { short.abs() }
    }

    /// The same study with slower decay of errors: the order is reduced to `bounds` tolerances below the smaller of the observed
    /// and expected orders. Errors only grow, increasingly with distance from the coarsest fitted level, so that no further level
    /// falls on the plateau; levels on the plateau do not change.
    pub(crate) fn perturbed(&self, bounds: f64) -> OrderTest {
        let mut moved = self.clone();
        let Ok(observed) = self.observed() else { return moved };
        let lower = observed.min(self.expected);
        let by = observed - (lower - bounds * self.tolerance);
        let Some(coarsest) = self.levels.first().map(|l| l.size) else { return moved };
        for level in &mut moved.levels {
            if !self.on_plateau(level) {
                level.error *= (level.size / coarsest).powf(-by);
            }
        }
        moved
    }

    /// Order between each level and the previous one.
    pub fn pairwise(&self) -> Vec<Option<f64>> {
        let mut orders = vec![None; self.levels.len().min(1)];
        for pair in self.levels.windows(2) {
            let order = (pair[0].error / pair[1].error).ln() / (pair[0].size / pair[1].size).ln();
            orders.push(order.is_finite().then_some(order));
        }
        orders
    }
}

fn slope(levels: &[&Level]) -> f64 {
    let n = levels.len() as f64;
    let x: Vec<f64> = levels.iter().map(|l| l.size.ln()).collect();
    let y: Vec<f64> = levels.iter().map(|l| l.error.ln()).collect();
    let (mx, my) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
    let sxy: f64 = x.iter().zip(&y).map(|(x, y)| (x - mx) * (y - my)).sum();
    let sxx: f64 = x.iter().map(|x| (x - mx) * (x - mx)).sum();
    sxy / sxx
}
