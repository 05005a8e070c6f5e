//! Rates of motions and load points, constant or by a table.

use asperity_fem::table::Table;

/// A rate over a stage \[m/s\].
#[derive(Clone, Debug, PartialEq)]
pub enum Pace {
    /// Constant.
    Steady(f64),
    /// Through (time since the start of the stage \[s\], rate), linear in between and constant beyond; two entries at one time are a
    /// jump.
    Table(Vec<(f64, f64)>),
}

impl Pace {
    /// Largest rate in magnitude.
    #[must_use]
    pub fn largest(&self) -> f64 {
        match self {
            Self::Steady(rate) => rate.abs(),
            Self::Table(points) => points.iter().fold(0.0, |largest, point| largest.max(point.1.abs())),
        }
    }

    /// Times of the run, over a whole stage, and rates by a table at them; `None` for a constant one.
    pub(crate) fn points(&self, start: f64, end: f64) -> Option<(Vec<f64>, Vec<f64>)> {
        let Self::Table(points) = self else { return None };
        let (mut times, mut rates): (Vec<f64>, Vec<f64>) = points.iter().map(|p| (start + p.0, p.1)).unzip();
        if times.first().is_some_and(|&first| first > start) {
            times.insert(0, start);
            rates.insert(0, rates[0]);
        }
        if times.last().is_some_and(|&last| last < end) {
            times.push(end);
            rates.extend(rates.last().copied());
        }
        Some((times, rates))
    }

    /// Displacement of what moves at this rate during a stage.
    #[must_use]
    pub fn drawn(&self, start: f64, end: f64) -> Travel {
        match (self, self.points(start, end)) {
            (Self::Table(_), Some((times, rates))) => Travel::Table(Table::from_rates(&times, &rates)),
            (Self::Steady(rate), _) => Travel::Steady { rate: *rate, start },
            (Self::Table(_), None) => Travel::Steady { rate: 0.0, start },
        }
    }
}

/// Displacement since the start of a stage of what moves at a rate.
#[derive(Clone, Debug, PartialEq)]
pub enum Travel {
    /// At a constant rate \[m/s\] from a time on \[s\].
    Steady {
        /// Rate \[m/s\].
        rate: f64,
        /// Start \[s\].
        start: f64,
    },
    /// As a table has it \[m\].
    Table(Table),
}

impl Travel {
    /// Displacement at a time of the run \[m\].
    #[must_use]
    pub fn at(&self, time: f64) -> f64 {
        match self {
            Self::Steady { rate, start } => rate * (time - start),
            Self::Table(table) => table.value(time),
        }
    }

    /// Change of the force of a spring of this stiffness over a step of length `dt` that ends at `time` \[N\].
    #[must_use]
    pub fn pull(&self, stiffness: f64, time: f64, dt: f64) -> f64 {
        match self {
            Self::Steady { rate, .. } => stiffness * rate * dt,
            Self::Table(table) => stiffness * (table.value(time) - table.value(time - dt)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rate_by_a_table_holds_before_and_after_it() {
        let pace = Pace::Table(vec![(1.0, 2.0), (3.0, 2.0), (3.0, -1.0)]);
        let drawn = pace.drawn(10.0, 20.0);
        assert_eq!([10.0, 11.0, 13.0, 20.0].map(|t| drawn.at(t)), [0.0, 2.0, 6.0, -1.0]);
        assert_eq!(drawn.pull(7.0, 14.0, 2.0), 7.0 * (2.0 - 1.0));
        assert_eq!(pace.largest(), 2.0);
        let steady = Pace::Steady(-0.5).drawn(10.0, 20.0);
        assert_eq!((steady.at(14.0), steady.pull(7.0, 14.0, 2.0)), (-2.0, -7.0));
    }
}
