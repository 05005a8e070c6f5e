//! Views of values at points, one for each layout.

use serde::{Deserialize, Serialize};

/// Values of one or several components at points, stored component by component: the first component at all points,
/// then the second.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Components<V> {
    values: V,
    points: usize,
}

impl<V: AsRef<[f64]>> Components<V> {
    /// Values in this layout at this many points.
    #[must_use]
    pub fn new(values: V, points: usize) -> Self {
        debug_assert!(values.as_ref().len().is_multiple_of(points.max(1)));
        Self { values, points }
    }

    /// Number of points.
    #[must_use]
    pub fn points(&self) -> usize {
        self.points
    }

    /// Number of components.
    #[must_use]
    pub fn components(&self) -> usize {
        self.all().len() / self.points.max(1)
    }

    /// All values.
    #[must_use]
    pub fn all(&self) -> &[f64] {
        self.values.as_ref()
    }

    /// One component at all points.
    #[must_use]
    pub fn component(&self, component: usize) -> &[f64] {
        &self.all()[component * self.points..(component + 1) * self.points]
    }

    /// All components at a point.
    pub fn at(&self, point: usize) -> impl Iterator<Item = f64> {
        self.all().iter().skip(point).step_by(self.points.max(1)).copied()
    }

    /// Magnitude of the vector at a point; with one component, its absolute value.
    #[must_use]
    pub fn size(&self, point: usize) -> f64 {
        let mut components = self.at(point);
        match (components.next(), components.next()) {
            (Some(x), Some(y)) => components.fold(x * x + y * y, |sum, z| sum + z * z).sqrt(),
            (Some(x), None) => x.abs(),
            _ => 0.0,
        }
    }
}

/// Values of several variables at points, stored point by point: all variables of the first point, then all of the second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerPoint<'a> {
    values: &'a [f64],
    variables: usize,
}

impl<'a> PerPoint<'a> {
    /// Values in this layout of this many variables.
    #[must_use]
    pub fn new(values: &'a [f64], variables: usize) -> Self {
        debug_assert!(values.len().is_multiple_of(variables.max(1)));
        Self { values, variables }
    }

    /// All variables of a point.
    #[must_use]
    pub fn at(&self, point: usize) -> &'a [f64] {
        &self.values[point * self.variables..(point + 1) * self.variables]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const VALUES: [f64; 6] = [3.0, 1.0, -2.0, 4.0, 0.0, 0.5];

    #[test]
    fn the_same_values_are_read_otherwise_in_each_layout() {
        let by_component = Components::new(&VALUES, 3);
        assert_eq!((by_component.points(), by_component.components()), (3, 2));
        assert_eq!(by_component.component(1), [4.0, 0.0, 0.5]);
        assert_eq!(by_component.at(2).collect::<Vec<_>>(), [-2.0, 0.5]);
        assert_eq!(by_component.size(0), 5.0);
        assert_eq!(PerPoint::new(&VALUES, 2).at(2), [0.0, 0.5]);
    }

    #[test]
    fn the_size_of_one_component_is_its_absolute_value() {
        assert_eq!(Components::new(&VALUES, 6).size(2), 2.0);
    }

    #[test]
    fn the_size_in_space_is_that_of_all_components() {
        assert_eq!(Components::new(&[2.0, 3.0, 6.0], 1).size(0), 7.0);
    }

    #[test]
    fn no_points_have_no_values() {
        let none = Components::<Vec<f64>>::default();
        assert_eq!((none.points(), none.components(), none.all().len()), (0, 0, 0));
    }
}
