//! Rates of motions and of load points: constant, or by a table.

use super::time_series::TimeSeries;

/// A rate over a stage \[m/s\].
#[derive(Clone, Debug, PartialEq)]
pub enum Pace {
    /// Constant.
    Steady(f64),
    /// Linear between its entries and constant beyond them; two entries at one time are a jump.
    Table(TimeSeries),
}

impl Pace {
    /// The rate at the end of a stage, which carries on.
    #[must_use]
    pub fn last(&self) -> f64 {
        match self {
            Self::Steady(rate) => *rate,
            Self::Table(points) => points.last().map_or(0.0, |p| p.1),
        }
    }

    /// Times of the corners of the displacement over a stage of this duration, and the displacements there, from zero on.
    #[must_use]
    pub fn path(&self, duration: f64) -> Vec<(f64, f64)> {
        let points: &[(f64, f64)] = match self {
            Self::Steady(rate) => return vec![(0.0, 0.0), (duration, rate * duration)],
            Self::Table(points) => points,
        };
        let first = points.first().map(|p| (0.0, p.1));
        let last = points.last().filter(|p| p.0 < duration).map(|p| (duration, p.1));
        let all: Vec<(f64, f64)> = first.into_iter().chain(points.iter().copied()).chain(last).collect();
        let mut path: Vec<(f64, f64)> = first.map(|_| (0.0, 0.0)).into_iter().collect();
        let mut sum = 0.0;
        for pair in all.windows(2).filter(|pair| pair[1].0 > pair[0].0) {
            sum += 0.5 * (pair[0].1 + pair[1].1) * (pair[1].0 - pair[0].0);
            path.push((pair[1].0, sum));
        }
        path
    }

    /// The table, if it is one.
    #[must_use]
    pub fn table(&self) -> Option<&TimeSeries> {
        match self {
            Self::Steady(_) => None,
            Self::Table(table) => Some(table),
        }
    }

    /// The table, if it is one, to be filled.
    pub(super) fn table_mut(&mut self) -> Option<&mut TimeSeries> {
        match self {
            Self::Steady(_) => None,
            Self::Table(table) => Some(table),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_path_of_a_rate_is_its_integral() {
        let pace = Pace::Table(vec![(1.0, 2.0), (3.0, 2.0), (3.0, -1.0), (5.0, 3.0)].into());
        assert_eq!(pace.path(6.0), [(0.0, 0.0), (1.0, 2.0), (3.0, 6.0), (5.0, 8.0), (6.0, 11.0)]);
        assert_eq!((pace.last(), Pace::Steady(2.0).path(3.0)), (3.0, vec![(0.0, 0.0), (3.0, 6.0)]));
    }
}
