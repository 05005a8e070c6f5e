//! Finite volumes along a line: cells that store fluid, and its flow between neighbours.
//!
//! A cell of length a stores the volume `C p` per cross-sectional area of the fault, `C = S a`, with the storage S: porosity
//! times the compressibility of fluid and pores. Between the points of two neighbours the flux is `T (p_1 - p_2)`. The border
//! divides their distance d in proportion to the lengths of the cells, and resistances in series add up,
//!
//! ```text
//! 1/T = d_1 η/k_1 + d_2 η/k_2,   d_1/d_2 = a_1/a_2,   d_1 + d_2 = d:
//! ```
//!
//! the conductance is a harmonic mean, and flux and pressure are continuous where the permeability k jumps at a border
//! (S. V. Patankar, "Numerical Heat Transfer and Fluid Flow" (1980), section 4.2-3). Pressures obey `C dp/dt = -K p + q`.

use realfft::num_complex::Complex;

/// A complex number.
pub(super) type C = Complex<f64>;

/// Hydraulic properties at the points of a line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    /// Positions, ascending \[m\].
    pub positions: Vec<f64>,
    /// Lengths of the cells around them \[m\].
    pub lengths: Vec<f64>,
    /// Permeability over viscosity, k/η \[m²/(Pa s)\].
    pub mobility: Vec<f64>,
    /// Porosity times compressibility S \[1/Pa\].
    pub storage: Vec<f64>,
    /// True if the pressure is zero at both ends; no fluid flows through them otherwise.
    pub drained: bool,
}

/// Cells in a row.
#[derive(Clone, Debug)]
pub(super) struct Chain {
    /// C of each cell \[m/Pa\].
    capacity: Vec<f64>,
    /// T from each cell to the next \[m/(Pa s)\].
    conductance: Vec<f64>,
    /// T from each cell to a pressure of zero \[m/(Pa s)\].
    drain: Vec<f64>,
}

impl Line {
    /// Resistances on both sides of a place between the points k and k + 1, over the distance `x` of the place from k \[Pa s/m\].
    fn resistances(&self, k: usize, x: f64) -> [f64; 2] {
        let distance = self.positions[k + 1] - self.positions[k];
        let border = distance * self.lengths[k] / (self.lengths[k] + self.lengths[k + 1]);
        let over = |from: f64, to: f64| {
            let near = (to.min(border) - from.min(border)) / self.mobility[k];
            near + (to.max(border) - from.max(border)) / self.mobility[k + 1]
        };
        [over(0.0, x), over(x, distance)]
    }

    /// Shares of its cells in the flux of a well: all of the outermost cell beyond the outermost point. Between two points
    /// they are in the inverse ratio of the resistances to them, which leaves the steady pressures at points as they are.
    #[must_use]
    pub fn inlet(&self, at: f64) -> Vec<f64> {
        let mut shares = vec![0.0; self.positions.len()];
        let after = self.positions.partition_point(|x| *x < at);
        if after == 0 || after == shares.len() {
            shares[after.saturating_sub(1)] = 1.0;
            return shares;
        }
        let [before, behind] = self.resistances(after - 1, at - self.positions[after - 1]);
        shares[after] = before / (before + behind);
        shares[after - 1] = behind / (before + behind);
        shares
    }

    /// Its cells in a row.
    pub(super) fn chain(&self) -> Chain {
        let n = self.positions.len();
        let between = |k: usize| 1.0 / self.resistances(k, 0.0)[1];
        let mut drain = vec![0.0; n];
        if self.drained {
            let outer = |k: usize| 2.0 * self.mobility[k] / self.lengths[k];
            drain[0] += outer(0);
            drain[n - 1] += outer(n - 1);
        }
        Chain {
            capacity: self.lengths.iter().zip(&self.storage).map(|(a, s)| a * s).collect(),
            conductance: (0..n - 1).map(between).collect(),
            drain,
        }
    }
}

impl Chain {
    /// C of each cell \[m/Pa\].
    pub fn capacity(&self) -> &[f64] {
        &self.capacity
    }

    /// Bound of the rates of decay \[1/s\], by Gershgorin's theorem.
    pub fn fastest(&self) -> f64 {
        let flows = |i: usize| {
            let before = i.checked_sub(1).map_or(0.0, |k| self.conductance[k]);
            2.0 * (before + self.conductance.get(i).copied().unwrap_or(0.0)) + self.drain[i]
        };
        (0..self.capacity.len()).map(|i| flows(i) / self.capacity[i]).fold(0.0, f64::max)
    }

    /// `-C⁻¹ K p`, the rates of pressures without a source.
    pub fn relaxation(&self, pressure: &[f64]) -> Vec<f64> {
        let mut flow: Vec<f64> = self.drain.iter().zip(pressure).map(|(drain, p)| -drain * p).collect();
        for (k, conductance) in self.conductance.iter().enumerate() {
            let along = conductance * (pressure[k] - pressure[k + 1]);
            flow[k] -= along;
            flow[k + 1] += along;
        }
        flow.iter().zip(&self.capacity).map(|(flow, c)| flow / c).collect()
    }

    /// Solves `(z C + K) x = C v` for a number z with a positive real part \[1/s\].
    ///
    /// Cells are eliminated from the first on, as a ladder of conductances: what is left of those before a cell is one
    /// conductance to a pressure of zero. Nothing is subtracted, so that what is stored is not lost beside flow that is many
    /// orders faster.
    pub fn solve(&self, z: C, v: &[f64]) -> Vec<C> {
        let n = v.len();
        let (mut own, mut flow) = (Vec::with_capacity(n), Vec::with_capacity(n));
        for (i, v) in v.iter().enumerate() {
            let (mut ground, mut source) =
                (z * self.capacity[i] + self.drain[i], C::from(self.capacity[i] * v));
            if let Some(k) = i.checked_sub(1) {
                let (before, conductance): (C, f64) = (own[k], self.conductance[k]);
                let passed = conductance / (before + conductance);
                ground += before * passed;
                source += passed * flow[k];
            }
            own.push(ground);
            flow.push(source);
        }
        let mut x = vec![C::default(); n];
        for i in (0..n).rev() {
            let after = self.conductance.get(i).copied().unwrap_or(0.0);
            let behind = x.get(i + 1).copied().unwrap_or_default();
            x[i] = (flow[i] + after * behind) / (own[i] + after);
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cells of unequal lengths whose points lie in their middle, with permeabilities that jump.
    fn line() -> Line {
        Line {
            positions: vec![1.0, 3.0, 5.5, 8.5],
            lengths: vec![2.0, 2.0, 3.0, 3.0],
            mobility: vec![1e-9, 1e-9, 4e-9, 4e-9],
            storage: vec![1e-9, 2e-9, 2e-9, 1e-9],
            drained: true,
        }
    }

    #[test]
    fn what_solves_the_chain_satisfies_its_equations() {
        let (chain, z, v) = (line().chain(), C::new(0.3, 0.4), [1.0, -2.0, 0.5, 3.0]);
        let x = chain.solve(z, &v);
        let part = |f: fn(&C) -> f64| chain.relaxation(&x.iter().map(f).collect::<Vec<_>>());
        let relaxed = part(|x| x.re).into_iter().zip(part(|x| x.im));
        for ((x, v), (re, im)) in x.iter().zip(v).zip(relaxed) {
            assert!((z * x - C::new(re, im) - v).norm() < 1e-13, "{x}");
        }
    }

    #[test]
    fn steady_pressure_between_drained_ends_is_linear_on_either_side_of_a_well_and_bends_where_permeability_jumps()
     {
        let line = line();
        let (chain, at) = (line.chain(), 3.6);
        let inlet = line.inlet(at);
        assert!((inlet.iter().sum::<f64>() - 1.0).abs() < 1e-15);
        // Solutions at a vanishing z are steady.
        let source: Vec<f64> = inlet.iter().zip(chain.capacity()).map(|(q, c)| q / c).collect();
        let found = chain.solve(C::from(1e-30), &source);
        // Resistances from an end to a place, and of all.
        let to = |x: f64| x.min(4.0) / 1e-9 + (x - 4.0).max(0.0) / 4e-9;
        let whole = to(10.0);
        for (x, p) in line.positions.iter().zip(found) {
            let [near, far] = [x.min(at), x.max(at)];
            let exact = to(near) * (whole - to(far)) / whole;
            assert!((p.re / exact - 1.0).abs() < 1e-13, "{x}: {p} {exact}");
        }
    }

    #[test]
    fn a_well_beyond_the_outermost_points_feeds_the_outermost_cell_and_one_at_a_point_its_cell() {
        let line = line();
        assert_eq!(line.inlet(0.2), [1.0, 0.0, 0.0, 0.0]);
        assert_eq!(line.inlet(9.9), [0.0, 0.0, 0.0, 1.0]);
        assert_eq!(line.inlet(5.5), [0.0, 0.0, 1.0, 0.0]);
    }

    #[test]
    fn fluid_is_not_lost_beside_flow_that_is_twenty_orders_faster() {
        let line = Line { mobility: vec![1e11, 1e11, 1e-9, 1e-9], drained: false, ..line() };
        let (chain, v) = (line.chain(), [1.0, 0.0, 0.0, 0.0]);
        let x = chain.solve(C::from(1e-3), &v);
        let stored: f64 = x.iter().zip(chain.capacity()).map(|(x, c)| 1e-3 * x.re * c).sum();
        assert!((stored / chain.capacity()[0] - 1.0).abs() < 1e-14, "{stored}");
    }
}
