//! Values at points, one type for each layout.

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

impl<V: AsMut<[f64]>> Components<V> {
    /// All values, to be changed.
    pub fn all_mut(&mut self) -> &mut [f64] {
        self.values.as_mut()
    }

    /// One component at all points, to be changed.
    pub fn component_mut(&mut self, component: usize) -> &mut [f64] {
        let own = component * self.points..(component + 1) * self.points;
        &mut self.all_mut()[own]
    }

    /// The first and the second component at all points, to be changed.
    pub fn pair_mut(&mut self) -> [&mut [f64]; 2] {
        let points = self.points;
        self.all_mut().split_at_mut(points).into()
    }
}

impl<V> Components<V> {
    /// The same values, to be read.
    pub fn view(&self) -> Components<&[f64]>
    where
        V: AsRef<[f64]>,
    {
        Components { values: self.values.as_ref(), points: self.points }
    }

    /// The same values, to be changed.
    pub fn view_mut(&mut self) -> Components<&mut [f64]>
    where
        V: AsMut<[f64]>,
    {
        Components { values: self.values.as_mut(), points: self.points }
    }
}

/// Values of several variables at points, stored point by point: all variables of the first point, then all of the second.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PerPoint<V> {
    values: V,
    variables: usize,
}

impl<V: AsRef<[f64]>> PerPoint<V> {
    /// Values in this layout of this many variables.
    #[must_use]
    pub fn new(values: V, variables: usize) -> Self {
        debug_assert!(values.as_ref().len().is_multiple_of(variables.max(1)));
        Self { values, variables }
    }

    /// All values.
    #[must_use]
    pub fn all(&self) -> &[f64] {
        self.values.as_ref()
    }
}

impl<'a> PerPoint<&'a [f64]> {
    /// A copy that owns its values.
    #[must_use]
    pub fn to_owned(self) -> PerPoint<Vec<f64>> {
        PerPoint { values: self.values.to_vec(), variables: self.variables }
    }

    /// All variables of a point.
    #[must_use]
    pub fn at(&self, point: usize) -> &'a [f64] {
        &self.values[point * self.variables..(point + 1) * self.variables]
    }
}

impl<V: AsMut<[f64]>> PerPoint<V> {
    /// All values, to be changed.
    pub fn all_mut(&mut self) -> &mut [f64] {
        self.values.as_mut()
    }

    /// All variables of a point, to be changed.
    pub fn at_mut(&mut self, point: usize) -> &mut [f64] {
        let own = point * self.variables..(point + 1) * self.variables;
        &mut self.all_mut()[own]
    }
}

impl<V> PerPoint<V> {
    /// Other values of the same variables.
    pub fn with<'a>(&self, values: &'a [f64]) -> PerPoint<&'a [f64]> {
        PerPoint { values, variables: self.variables }
    }

    /// The same values, to be read.
    pub fn view(&self) -> PerPoint<&[f64]>
    where
        V: AsRef<[f64]>,
    {
        PerPoint { values: self.values.as_ref(), variables: self.variables }
    }

    /// The same values, to be changed.
    pub fn view_mut(&mut self) -> PerPoint<&mut [f64]>
    where
        V: AsMut<[f64]>,
    {
        PerPoint { values: self.values.as_mut(), variables: self.variables }
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
        assert_eq!(PerPoint::new(VALUES.as_slice(), 2).at(2), [0.0, 0.5]);
    }

    #[test]
    fn what_is_changed_in_a_layout_is_read_in_it() {
        let mut values = VALUES;
        let mut by_component = Components::new(values.as_mut_slice(), 3);
        by_component.component_mut(1)[2] = 7.0;
        by_component.pair_mut()[0][0] = 9.0;
        assert_eq!(by_component.view().at(0).collect::<Vec<_>>(), [9.0, 4.0]);
        let mut by_point = PerPoint::new(values.as_mut_slice(), 2);
        by_point.at_mut(1).fill(5.0);
        assert_eq!(values, [9.0, 1.0, 5.0, 5.0, 0.0, 7.0]);
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
