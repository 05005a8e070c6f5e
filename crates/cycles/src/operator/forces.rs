//! Forces on the jumps of points, from which the operator of their fault is made.

use super::dense::Dense;
use super::tractions::Tractions;
use asperity_fem::condense::Remainder;
use rayon::prelude::*;

/// The condensed matrix. It is symmetric: a force on a jump caused by another is that on the other caused by the first.
#[derive(Debug)]
pub(crate) enum Matrix {
    /// As the elimination leaves it.
    Triangle(Remainder),
    /// All entries, row by row, and the number of rows.
    Whole(Vec<f64>, usize),
}

impl Matrix {
    #[inline]
    fn at(&self, row: usize, column: usize) -> f64 {
        match self {
            Self::Triangle(remainder) => remainder.at(row, column),
            Self::Whole(values, order) => values[row * order + column],
        }
    }
}

/// Conversion of the forces on a point to tractions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bearing {
    /// Tributary area \[m²; m per metre of thickness\].
    pub area: f64,
    /// True if its normal traction is constant, either because supports on both sides take its change or because the
    /// scene says so.
    pub keeps: bool,
    /// True if it may open where its normal traction falls to zero.
    pub opens: bool,
}

impl Bearing {
    /// Traction per force, of slip or of the opening. The bodies drive slip with the opposite of the force that holds it.
    pub fn per_force(&self, opening: bool) -> f64 {
        match (opening, self.keeps) {
            (false, _) => -1.0 / self.area,
            (true, true) => 0.0,
            (true, false) => 1.0 / self.area,
        }
    }
}

/// Forces on the jumps of points. It is as large as the condensed matrix; an operator made from it is smaller.
#[derive(Debug)]
pub struct Forces {
    pub(crate) matrix: Matrix,
    /// Slip of the condensed bodies over that of the fault.
    pub(crate) share: f64,
    /// Row of the first component of slip of each point; with more than one component of displacement, the opening follows
    /// slip.
    pub(crate) rows: Vec<usize>,
    pub(crate) bearings: Vec<Bearing>,
    /// Number of components of slip.
    pub(crate) tangents: usize,
    /// True for the components of slip that change normal tractions.
    pub(crate) presses: Vec<bool>,
    /// True if slip in one direction loads the other.
    pub(crate) across: bool,
}

/// A component of a point: of slip along a tangent, or after those of the opening.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PointComponent {
    /// The component.
    pub component: usize,
    /// The point.
    pub point: usize,
}

impl PointComponent {
    /// This component of this point.
    #[must_use]
    pub fn new(component: usize, point: usize) -> Self {
        Self { component, point }
    }
}

impl Forces {
    /// Number of points.
    #[must_use]
    pub fn points(&self) -> usize {
        self.rows.len()
    }

    /// Number of components of slip.
    #[must_use]
    pub fn components(&self) -> usize {
        self.tangents
    }

    /// True if slip along a component changes normal tractions.
    #[must_use]
    pub fn presses(&self, slip: usize) -> bool {
        self.presses[slip]
    }

    /// True if slip in one direction loads the other.
    #[must_use]
    pub fn across(&self) -> bool {
        self.across
    }

    /// Traction at a point along a component, caused by slip of a point along a component \[Pa/m\]. The component after
    /// those of slip is the normal traction, compression positive.
    #[must_use]
    #[inline]
    pub fn traction(&self, at: PointComponent, slip: PointComponent) -> f64 {
        let row = |of: PointComponent| self.rows[of.point] + of.component;
        let force = self.matrix.at(row(at), row(slip));
        self.bearings[at.point].per_force(at.component == self.tangents) * (self.share * force)
    }

    /// Tractions of all points along a component, caused by slip of a point along a component.
    pub(crate) fn caused(
        &self,
        component: usize,
        slip: PointComponent,
    ) -> impl Iterator<Item = f64> + use<'_> {
        (0..self.points()).map(move |p| self.traction(PointComponent::new(component, p), slip))
    }

    /// Largest magnitude of tractions along a component caused by slip along a component.
    pub(crate) fn largest(&self, component: usize, slip: usize) -> f64 {
        let caused = |q: usize| self.caused(component, PointComponent::new(slip, q));
        let of = |q: usize| caused(q).fold(0.0_f64, |l, v| l.max(v.abs()));
        (0..self.points()).into_par_iter().map(of).reduce(|| 0.0, f64::max)
    }

    /// Largest force along slip caused by slip along the first component of a point \[N/m; N/m²\].
    #[must_use]
    pub fn largest_force(&self) -> f64 {
        let area = |p: usize| self.bearings[p].area;
        let of = |q: usize| {
            let forces =
                self.caused(0, PointComponent::new(0, q)).enumerate().map(|(p, v)| (v * area(p)).abs());
            forces.fold(0.0, f64::max)
        };
        (0..self.points()).into_par_iter().map(of).reduce(|| 0.0, f64::max)
    }

    /// Shear tractions along the first component caused by slip along it.
    #[must_use]
    pub fn shear_along(&self, slip: &[f64]) -> Vec<f64> {
        let first = |point: usize| PointComponent::new(0, point);
        let of = |p: usize| (0..slip.len()).map(|q| self.traction(first(p), first(q)) * slip[q]).sum();
        (0..self.points()).into_par_iter().map(of).collect()
    }

    /// For slip of each point, component by component: sum of the magnitudes of the tractions it causes \[Pa/m\].
    #[must_use]
    pub fn stiffness(&self) -> Vec<f64> {
        let n = self.points();
        let of = |k: usize| {
            let slip = PointComponent::new(k / n, k % n);
            let sum =
                |sum: f64, component: usize| self.caused(component, slip).fold(sum, |sum, v| sum + v.abs());
            let along = sum(0.0, slip.component);
            let pressed = if self.presses[slip.component] { sum(along, self.tangents) } else { along };
            if self.across { pressed + sum(0.0, 1 - slip.component) } else { pressed }
        };
        (0..self.tangents * n).into_par_iter().map(of).collect()
    }

    /// Tractions at a point, component by component, and then its normal traction, caused by slip of each component of each
    /// point.
    #[must_use]
    pub fn row(&self, p: usize) -> [Vec<f64>; 3] {
        let (n, tangents) = (self.points(), self.tangents);
        let loads = |component: usize, slip: usize| match (component == tangents, component == slip) {
            (true, _) => self.presses[slip],
            (false, same) => same || self.across,
        };
        let of = |component: usize| {
            let entry = |k: usize| match (component, k / n) {
                (component, slip) if loads(component, slip) => {
                    self.traction(PointComponent::new(component, p), PointComponent::new(slip, k % n))
                }
                _ => 0.0,
            };
            (0..tangents * n).map(entry).collect::<Vec<f64>>()
        };
        let second = if tangents > 1 { of(1) } else { Vec::new() };
        [of(0), second, of(tangents)]
    }

    /// The matrices of tractions with all entries.
    #[must_use]
    pub fn dense(&self) -> Tractions {
        let n = self.points();
        let part = |component: usize, slip: usize| -> Vec<f64> {
            let at = PointComponent::new;
            let row = |p: usize| (0..n).map(move |q| self.traction(at(component, p), at(slip, q)));
            (0..n).flat_map(row).collect()
        };
        let normal = |slip: usize| self.presses[slip].then(|| part(self.tangents, slip));
        let along = |slip: usize| Dense::new(n, part(slip, slip), normal(slip));
        if self.tangents == 1 {
            return Tractions::One(along(0));
        }
        let across = || Box::new([part(0, 1), part(1, 0)].map(|shear| Dense::new(n, shear, None)));
        Tractions::Two { along: Box::new([along(0), along(1)]), across: self.across.then(across) }
    }

    /// Memory of the operator, at most \[bytes\]: tractions of a pair of components along slip are stored once, and normal
    /// ones for each component. `components` are those of displacement.
    #[must_use]
    pub(crate) fn operator_bytes(components: usize, tangents: usize, points: usize) -> usize {
        let normal = if components > 1 { tangents } else { 0 };
        (tangents * (tangents + 1) / 2 + normal) * points.pow(2) * size_of::<f64>()
    }

    /// Forces of these tractions of slip in one direction, row by row.
    #[cfg(test)]
    pub(crate) fn from_tractions(shear: &[f64], normal: &[f64], areas: &[f64]) -> Self {
        let n = areas.len();
        let mut values = vec![0.0; 4 * n * n];
        for (p, area) in areas.iter().enumerate() {
            for q in 0..n {
                values[2 * p * 2 * n + 2 * q] = -area * shear[p * n + q];
                values[(2 * p + 1) * 2 * n + 2 * q] = area * normal[p * n + q];
            }
        }
        let bearing = |&area: &f64| Bearing { area, keeps: false, opens: false };
        Self {
            matrix: Matrix::Whole(values, 2 * n),
            share: 1.0,
            rows: (0..n).map(|p| 2 * p).collect(),
            bearings: areas.iter().map(bearing).collect(),
            tangents: 1,
            presses: vec![true],
            across: false,
        }
    }
}
