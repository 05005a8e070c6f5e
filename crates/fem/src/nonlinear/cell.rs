//! One cell: motion of its quadrature points, stresses, forces and tangent.
//!
//! Forces are `f_ai = Σ_p V_p τ_ij ∂N_a/∂x_j` over the reference volumes V_p, with the Kirchhoff stress and the current
//! gradients (τ dV = J σ dV = σ dv). At small strain τ is the stress and the gradients are those of the reference.
//!
//! Averaged dilatation: with ψ_m polynomials orthonormal over the cell (`Σ_p V_p ψ_m ψ_n = δ_mn`), the trace of the increment
//! becomes `Σ_m ψ_m Σ_q V_q ψ_m(q) tr G_q`. The work-conjugate forces are those of `τ + (Πp - p) 1`, with p = tr τ/3 and Π the
//! same projection, which is symmetric under the weights V_p. This is B-bar at small strain, and otherwise its counterpart with
//! the current gradients.

use super::history::Layout;
use super::motion::{Increment, Point};
use super::tensor::{PLACE, Tensor, determinant, inverse, rotated};
use crate::material::constitutive::{ConstitutiveLaw, Moduli, Voigt, pressure};
use crate::material::plane_stress;

/// Largest number of polynomials of the projected dilatation: 1, x, y, z.
pub const MOST_MODES: usize = 4;

/// Data common to all cells of a block.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Nodes of a cell.
    pub nodes: usize,
    /// ∂N_a/∂ξ of each quadrature point, node by node.
    pub dn: Vec<[f64; 3]>,
    /// N_a of each quadrature point, node by node.
    pub n: Vec<f64>,
    /// Weight of each quadrature point.
    pub weight: Vec<f64>,
    /// Number of polynomials of the projection; 0 for the standard formulation.
    pub modes: usize,
    /// Degrees of freedom of a node.
    pub components: usize,
    /// Tensor row of a node's first degree of freedom: 2 in antiplane shear, otherwise 0.
    pub row: usize,
    /// True for weights 2πr and a hoop strain.
    pub axisymmetric: bool,
    /// True for σ_zz = 0.
    pub plane_stress: bool,
    /// True for the updated Lagrangian.
    pub finite: bool,
    /// Layout of the numbers kept at a point.
    pub layout: Layout,
}

impl Frame {
    /// Quadrature points.
    #[must_use]
    pub fn points(&self) -> usize {
        self.weight.len()
    }

    /// Degrees of freedom of a cell.
    #[must_use]
    pub fn width(&self) -> usize {
        self.nodes * self.components
    }

    /// Logarithmic strain through the thickness of a point of a cell with the kept numbers `state`, if it is kept.
    #[must_use]
    pub fn thickness_of(&self, state: &[f64], point: usize) -> Option<f64> {
        let Layout { thickness, stride, .. } = self.layout;
        (thickness && stride > 0).then(|| state[(point + 1) * stride - 1])
    }

    fn axes(&self, dimension: usize) -> &'static [usize] {
        if dimension == 2 { &[2] } else { &[0, 1, 2] }
    }
}

/// A point of a cell whose Jacobian determinant is not positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InvertedPoint {
    /// Quadrature point.
    pub point: usize,
    /// Determinant \[m^D\].
    pub determinant: f64,
}

/// Cell whose forces are not defined at a trial state.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CellError {
    /// No volume at a point at the middle or at the end of a step.
    #[error(
        "cell {cell}, about ({middle}) m, turns inside out: Jacobian determinant {:e} at its point {}",
        .inverted.determinant,
        .inverted.point
    )]
    Inverted {
        /// The cell.
        cell: usize,
        /// Coordinates of its middle.
        middle: String,
        /// The point.
        inverted: InvertedPoint,
    },
    /// No volume in the motion of a relaxation time.
    #[error("cell {cell} turns inside out")]
    InvertedByViscosity {
        /// The cell.
        cell: usize,
    },
    /// No volume before a forward step.
    #[error("cell {cell} is inside out")]
    InvertedBefore {
        /// The cell.
        cell: usize,
    },
    /// A strain increment beyond the limit.
    #[error("cell {cell}: strain increment {size:.3} at its point {point} (at most {most} in a step)")]
    Increment {
        /// The cell.
        cell: usize,
        /// The point.
        point: usize,
        /// Size of the increment \[-\].
        size: f64,
        /// Limit \[-\].
        most: f64,
    },
    /// Forces that are not numbers.
    #[error("cell {cell}: the forces are not finite")]
    Forces {
        /// The cell.
        cell: usize,
    },
}

/// Working memory for the cells of one task.
#[derive(Clone, Debug)]
pub struct Scratch<const D: usize> {
    /// Reference positions of the nodes.
    pub reference: Vec<[f64; D]>,
    /// Displacements at the start of the step, in tensor rows.
    pub base: Vec<[f64; 3]>,
    /// Displacements at its end.
    pub end: Vec<[f64; 3]>,
    /// Volume of each point at the end of the step (reference volume at small strain).
    pub volume: Vec<f64>,
    /// Strain and rotation of each point.
    pub increments: Vec<Increment>,
    /// Kirchhoff stress of each point.
    pub stress: Vec<Voigt>,
    /// Derivatives at each point.
    pub sensitivity: Vec<Point>,
    /// ∂N/∂x at the end, point by point and node by node, and N/r.
    gradients: Vec<[f64; D]>,
    hoop: Vec<f64>,
    /// G before averaging of its dilatation.
    growth: Vec<Tensor>,
    /// ψ_m at each point.
    psi: Vec<[f64; MOST_MODES]>,
    /// Columns of the tangent one after another, and the coupling of each column by the projection.
    columns: Vec<f64>,
    coupling: Vec<Coupling>,
    /// State of a cell that is not kept.
    unkept: Vec<f64>,
}

/// Integrals of one column against ψ_m: of its averaged trace, of its dilatation in the forces, of its pressure.
#[derive(Clone, Copy, Debug, Default)]
struct Coupling {
    trace: [f64; MOST_MODES],
    dilatation: [f64; MOST_MODES],
    pressure: [f64; MOST_MODES],
}

impl<const D: usize> Scratch<D> {
    /// Memory for cells of one frame.
    #[must_use]
    pub fn new(frame: &Frame) -> Self {
        let (nodes, points, width) = (frame.nodes, frame.points(), frame.width());
        Self {
            reference: vec![[0.0; D]; nodes],
            base: vec![[0.0; 3]; nodes],
            end: vec![[0.0; 3]; nodes],
            volume: vec![0.0; points],
            increments: vec![Increment::small(&[[0.0; 3]; 3]); points],
            stress: vec![[0.0; 6]; points],
            sensitivity: vec![Point::small(&[[0.0; 6]; 6]); points],
            gradients: vec![[0.0; D]; points * nodes],
            hoop: vec![0.0; points * nodes],
            growth: vec![[[0.0; 3]; 3]; points],
            psi: vec![[0.0; MOST_MODES]; points],
            columns: vec![0.0; width * width],
            coupling: vec![Coupling::default(); width],
            unkept: vec![0.0; points * frame.layout.stride],
        }
    }

    /// Computes gradients and increments of all points from `base` to `end`; `volumes` are the reference volumes.
    ///
    /// # Errors
    /// [`InvertedPoint`] if a point has no volume at the middle or at the end of the step.
    pub fn motion(&mut self, frame: &Frame, volumes: &[f64]) -> Result<(), InvertedPoint> {
        for point in 0..frame.points() {
            if frame.finite {
                self.finite_motion(frame, point)?;
            } else {
                self.small_motion(frame, point)?;
            }
        }
        if frame.modes > 0 {
            self.orthonormal(frame, volumes);
        }
        self.average(frame, volumes);
        Ok(())
    }

    /// Σ_a x_a ∂N_a/∂ξ with the positions `x`.
    fn jacobian(&self, frame: &Frame, point: usize, x: impl Fn(usize) -> [f64; D]) -> [[f64; D]; D] {
        let mut j = [[0.0; D]; D];
        for (a, dn) in frame.dn[point * frame.nodes..(point + 1) * frame.nodes].iter().enumerate() {
            let x = x(a);
            for (row, x) in j.iter_mut().zip(x) {
                for (entry, d) in row.iter_mut().zip(dn) {
                    *entry += x * d;
                }
            }
        }
        j
    }

    /// Σ_a N_a x_a at a point.
    fn interpolate(&self, frame: &Frame, point: usize, x: impl Fn(usize) -> f64) -> f64 {
        frame.n[point * frame.nodes..(point + 1) * frame.nodes]
            .iter()
            .enumerate()
            .map(|(a, n)| n * x(a))
            .sum()
    }

    /// Sets the gradients from the inverse of a Jacobian, and N/r.
    fn set_gradients(&mut self, frame: &Frame, point: usize, inverse: &[[f64; D]; D], radius: f64) {
        let range = point * frame.nodes..(point + 1) * frame.nodes;
        for (g, dn) in self.gradients[range.clone()].iter_mut().zip(&frame.dn[range.clone()]) {
            *g = std::array::from_fn(|i| (0..D).map(|m| dn[m] * inverse[m][i]).sum());
        }
        if frame.axisymmetric {
            for (h, n) in self.hoop[range.clone()].iter_mut().zip(&frame.n[range]) {
                *h = n / radius;
            }
        }
    }

    fn small_motion(&mut self, frame: &Frame, point: usize) -> Result<(), InvertedPoint> {
        let j = self.jacobian(frame, point, |a| self.reference[a]);
        let determinant = positive(determinant(&j), point)?;
        let radius =
            if frame.axisymmetric { self.interpolate(frame, point, |a| self.reference[a][0]) } else { 0.0 };
        self.set_gradients(frame, point, &inverse(&j, determinant), radius);
        self.volume[point] = frame.weight[point] * determinant * circumference(frame, radius);
        let mut h = [[0.0; 3]; 3];
        for a in 0..frame.nodes {
            let g = self.gradients[point * frame.nodes + a];
            for (i, row) in h.iter_mut().enumerate().skip(frame.row).take(frame.components) {
                let du = self.end[a][i] - self.base[a][i];
                for (entry, g) in row.iter_mut().zip(g) {
                    *entry += du * g;
                }
            }
            if frame.axisymmetric {
                h[2][2] += (self.end[a][0] - self.base[a][0]) * self.hoop[point * frame.nodes + a];
            }
        }
        self.growth[point] = h;
        Ok(())
    }

    fn finite_motion(&mut self, frame: &Frame, point: usize) -> Result<(), InvertedPoint> {
        let at = |a: usize| -> [f64; D] { std::array::from_fn(|i| self.reference[a][i] + self.end[a][i]) };
        // Computed from the increments: a difference of positions would lose the digits of small steps.
        let step = |a: usize| -> [f64; D] { std::array::from_fn(|i| self.end[a][i] - self.base[a][i]) };
        let new = self.jacobian(frame, point, at);
        let change = self.jacobian(frame, point, step);
        let mid: [[f64; D]; D] =
            std::array::from_fn(|i| std::array::from_fn(|m| new[i][m] - 0.5 * change[i][m]));
        let determinant_mid = positive(determinant(&mid), point)?;
        let determinant_new = positive(determinant(&new), point)?;
        let by_mid = inverse(&mid, determinant_mid);
        let mut g = [[0.0; 3]; 3];
        for (row, change) in g.iter_mut().zip(&change) {
            for (j, entry) in row.iter_mut().enumerate().take(D) {
                *entry = (0..D).map(|m| change[m] * by_mid[m][j]).sum();
            }
        }
        let mut radius = 0.0;
        if frame.axisymmetric {
            radius = positive(self.interpolate(frame, point, |a| at(a)[0]), point)?;
            let grown = self.interpolate(frame, point, |a| step(a)[0]);
            g[2][2] = grown / positive(radius - 0.5 * grown, point)?;
        }
        self.growth[point] = g;
        self.set_gradients(frame, point, &inverse(&new, determinant_new), radius);
        self.volume[point] = frame.weight[point] * determinant_new * circumference(frame, radius);
        Ok(())
    }

    /// Orthonormal polynomials by Gram-Schmidt on 1, x, y, z of the reference: natural coordinates would lose an order on
    /// general quadrilaterals (Boffi, Gastaldi 2002).
    fn orthonormal(&mut self, frame: &Frame, volumes: &[f64]) {
        for m in 0..frame.modes {
            for point in 0..frame.points() {
                let place = |m: usize| {
                    self.interpolate(frame, point, |a| self.reference[a][m] - self.reference[0][m])
                };
                self.psi[point][m] = if m == 0 { 1.0 } else { place(m - 1) };
            }
            for k in 0..m {
                let overlap: f64 = self.psi.iter().zip(volumes).map(|(p, v)| v * p[m] * p[k]).sum();
                self.psi.iter_mut().for_each(|p| p[m] -= overlap * p[k]);
            }
            let norm: f64 = self.psi.iter().zip(volumes).map(|(p, v)| v * p[m] * p[m]).sum();
            let scale = 1.0 / norm.sqrt();
            self.psi.iter_mut().for_each(|p| p[m] *= scale);
        }
    }

    /// Integrals against ψ of a value given at each point.
    fn project(&self, frame: &Frame, volumes: &[f64], value: impl Fn(usize) -> f64) -> [f64; MOST_MODES] {
        let mut out = [0.0; MOST_MODES];
        for (point, (psi, v)) in self.psi.iter().zip(volumes).enumerate() {
            let value = v * value(point);
            for (o, p) in out.iter_mut().zip(psi).take(frame.modes) {
                *o += p * value;
            }
        }
        out
    }

    /// Computes the increments from the gradients, with averaged dilatation if requested.
    fn average(&mut self, frame: &Frame, volumes: &[f64]) {
        let trace = |g: &Tensor| g[0][0] + g[1][1] + g[2][2];
        let means = self.project(frame, volumes, |p| trace(&self.growth[p]));
        for point in 0..frame.points() {
            let mut g = self.growth[point];
            if frame.modes > 0 {
                let shift = (value(&means, &self.psi[point]) - trace(&g)) / 3.0;
                (0..3).for_each(|i| g[i][i] += shift);
            }
            self.increments[point] =
                if frame.finite { Increment::midpoint(&g) } else { Increment::small(&g) };
        }
    }

    /// Computes stress and history of all points after the step; `tangent` requests the sensitivities as well.
    pub fn stresses<M: ConstitutiveLaw>(
        &mut self,
        frame: &Frame,
        material: &M,
        dt: f64,
        old: &[f64],
        new: &mut [f64],
        tangent: bool,
    ) {
        let stride = frame.layout.stride;
        let mut moduli = [[0.0; 6]; 6];
        for point in 0..frame.points() {
            let range = point * stride..(point + 1) * stride;
            let mut state = frame.layout.read(&old[range.clone()]);
            let increment = &mut self.increments[point];
            if frame.finite {
                frame.layout.rotate(&mut state, &increment.half);
            }
            let (stress, history) = frame.layout.split(&mut state);
            let asked = tangent.then_some(&mut moduli);
            if frame.plane_stress {
                increment.strain =
                    plane_stress::update(material, dt, &increment.strain, stress, history, asked);
            } else {
                material.update(dt, &increment.strain, stress, history, asked);
            }
            let mid = *stress;
            if frame.finite {
                frame.layout.rotate(&mut state, &increment.half);
            }
            frame.layout.thicken(&mut state, increment.strain[2]);
            let end = *frame.layout.split(&mut state).0;
            self.stress[point] = end;
            new[range].copy_from_slice(&state[..stride]);
            if tangent {
                self.linearise(frame, point, &moduli, &mid, &end);
            }
        }
    }

    /// Computes stresses and sensitivities after the step and keeps only these.
    pub fn linearised<M: ConstitutiveLaw>(&mut self, frame: &Frame, material: &M, dt: f64, old: &[f64]) {
        let mut unkept = std::mem::take(&mut self.unkept);
        self.stresses(frame, material, dt, old, &mut unkept, true);
        self.unkept = unkept;
    }

    /// Computes the forces by which stresses at rest change over `dt`, replacing `f`; there must be no motion.
    pub fn relaxation<M: ConstitutiveLaw>(
        &mut self,
        frame: &Frame,
        volumes: &[f64],
        material: &M,
        dt: f64,
        old: &[f64],
        f: &mut [f64],
    ) {
        let stride = frame.layout.stride;
        for point in 0..frame.points() {
            let mut state = frame.layout.read(&old[point * stride..(point + 1) * stride]);
            let (stress, history) = frame.layout.split(&mut state);
            let before = *stress;
            if frame.plane_stress {
                plane_stress::update(material, dt, &[0.0; 6], stress, history, None);
            } else {
                material.update(dt, &[0.0; 6], stress, history, None);
            }
            self.stress[point] = std::array::from_fn(|i| stress[i] - before[i]);
        }
        self.forces(frame, volumes, f);
    }

    /// Computes the stress of the present state and the sensitivities of a forward step from it. There must be no motion.
    pub fn forward<M: ConstitutiveLaw>(&mut self, frame: &Frame, material: &M, dt: f64, old: &[f64]) {
        let stride = frame.layout.stride;
        for point in 0..frame.points() {
            let mut state = frame.layout.read(&old[point * stride..(point + 1) * stride]);
            let (stress, history) = frame.layout.split(&mut state);
            let mut c = material.forward(dt, stress, history);
            if frame.plane_stress {
                c = plane_stress::condensed(&c);
            }
            let stress = *stress;
            self.stress[point] = stress;
            self.linearise(frame, point, &c, &stress, &stress);
        }
    }

    fn linearise(&mut self, frame: &Frame, point: usize, c: &Moduli, mid: &Voigt, end: &Voigt) {
        self.sensitivity[point] = if frame.finite {
            self.increments[point].sensitivity(&self.growth[point], c, mid, end, frame.axes(D))
        } else {
            Point::small(c)
        };
    }

    /// Replaces the pressure of each point by its projection.
    fn smooth_pressure(&mut self, frame: &Frame, volumes: &[f64]) {
        if frame.modes == 0 {
            return;
        }
        let means = self.project(frame, volumes, |p| pressure(&self.stress[p]));
        for (stress, psi) in self.stress.iter_mut().zip(&self.psi) {
            let shift = value(&means, psi) - pressure(stress);
            stress.iter_mut().take(3).for_each(|s| *s += shift);
        }
    }

    /// Computes the internal forces of the current stresses, replacing `f`. The pressures become their projections.
    pub fn forces(&mut self, frame: &Frame, volumes: &[f64], f: &mut [f64]) {
        self.smooth_pressure(frame, volumes);
        f.fill(0.0);
        for (point, (stress, v)) in self.stress.iter().zip(volumes).enumerate() {
            let range = point * frame.nodes..(point + 1) * frame.nodes;
            let scaled = stress.map(|s| s * v);
            for (f, g) in f.chunks_exact_mut(frame.components).zip(&self.gradients[range.clone()]) {
                for (i, f) in f.iter_mut().enumerate() {
                    *f += (0..D).map(|j| scaled[PLACE[i + frame.row][j]] * g[j]).sum::<f64>();
                }
            }
            if frame.axisymmetric {
                for (f, h) in f.chunks_exact_mut(frame.components).zip(&self.hoop[range]) {
                    f[0] += scaled[2] * h;
                }
            }
        }
    }

    /// Computes the tangent of the forces with respect to the displacements at the end of the step, row by row, replacing `k`.
    /// Stresses and sensitivities must belong to the same state.
    pub fn tangent(&mut self, frame: &Frame, volumes: &[f64], k: &mut [f64]) {
        self.smooth_pressure(frame, volumes);
        self.columns.fill(0.0);
        if frame.modes > 0 {
            self.couple(frame, volumes);
        }
        for (point, v) in volumes.iter().enumerate() {
            self.add_point(frame, point, *v);
        }
        let width = frame.width();
        for (i, row) in k.chunks_exact_mut(width).enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry = self.columns[j * width + i];
                for m in 0..frame.modes {
                    *entry += self.coupling[i].dilatation[m] * self.coupling[j].pressure[m];
                }
            }
        }
    }

    /// Computes the projections of the dilatation of each column, in the increments and in the forces.
    fn couple(&mut self, frame: &Frame, volumes: &[f64]) {
        self.coupling.fill(Coupling::default());
        for (point, v) in volumes.iter().enumerate() {
            let d = &self.sensitivity[point].dilatation;
            for b in 0..frame.nodes {
                let at = point * frame.nodes + b;
                let (g, hoop) = (&self.gradients[at], self.hoop[at]);
                for k in 0..frame.components {
                    let first = if k == 0 { hoop } else { 0.0 };
                    let trace = trace_of(d, k, g, first);
                    let column = &mut self.coupling[b * frame.components + k];
                    for (m, psi) in self.psi[point].iter().enumerate().take(frame.modes) {
                        column.trace[m] += v * psi * trace;
                        column.dilatation[m] += v * psi * (g[k] + first);
                    }
                }
            }
        }
    }

    fn add_point(&mut self, frame: &Frame, point: usize, v: f64) {
        let (nodes, components) = (frame.nodes, frame.components);
        let (s, psi) = (&self.sensitivity[point], &self.psi[point]);
        let gradients = &self.gradients[point * nodes..(point + 1) * nodes];
        let hoops = &self.hoop[point * nodes..(point + 1) * nodes];
        let stress = self.stress[point].map(|s| s * v);
        for (b, (g, &hoop)) in gradients.iter().zip(hoops).enumerate() {
            // The gradients of the forces move with the cell: -∂N_a/∂x_k τ∇N_b is added as a column of dτ.
            let moving: [f64; 3] = if frame.finite {
                std::array::from_fn(|i| (0..D).map(|j| stress[PLACE[i][j]] * g[j]).sum())
            } else {
                [0.0; 3]
            };
            for k in 0..components {
                let column = b * components + k;
                let first = if k == 0 { hoop } else { 0.0 };
                let row = k + frame.row;
                let mut d: Voigt = std::array::from_fn(|c| {
                    (0..D).map(|r| s.stress[c][row][r] * g[r]).sum::<f64>() + s.stress[c][2][2] * first
                });
                if frame.modes > 0 {
                    let coupling = &mut self.coupling[column];
                    let shift = value(&coupling.trace, psi) - trace_of(&s.dilatation, k, g, first);
                    d.iter_mut().zip(&s.by_dilatation).for_each(|(d, t)| *d += shift * t);
                    let p = pressure(&d);
                    d.iter_mut().take(3).for_each(|d| *d -= p);
                    coupling.pressure.iter_mut().zip(psi).for_each(|(c, psi)| *c += v * psi * p);
                }
                let d = d.map(|d| v * d);
                let out = &mut self.columns[column * frame.width()..][..frame.width()];
                match components {
                    1 => add_column::<D, 1>(out, frame.row, k, gradients, &d, &moving),
                    2 => add_column::<D, 2>(out, frame.row, k, gradients, &d, &moving),
                    _ => add_column::<D, 3>(out, frame.row, k, gradients, &d, &moving),
                }
                if frame.axisymmetric {
                    let geometric = if frame.finite { stress[2] * first } else { 0.0 };
                    for (out, h) in out.iter_mut().step_by(components).zip(hoops) {
                        *out += (d[2] - geometric) * h;
                    }
                }
            }
        }
    }

    /// A stress at the start of the step, in the frame of its strain increment.
    #[must_use]
    pub fn turned(&self, point: usize, stress: &Voigt) -> Voigt {
        rotated(&self.increments[point].half, stress)
    }
}

/// Σ_m c_m ψ_m.
fn value(c: &[f64; MOST_MODES], psi: &[f64; MOST_MODES]) -> f64 {
    c[0] * psi[0] + c[1] * psi[1] + c[2] * psi[2] + c[3] * psi[3]
}

/// Trace of the increment due to a unit displacement in direction `k`.
fn trace_of<const D: usize>(d: &Tensor, k: usize, g: &[f64; D], hoop: f64) -> f64 {
    (0..D).map(|r| d[k][r] * g[r]).sum::<f64>() + d[2][2] * hoop
}

/// Adds `(d - moving ⊗ e_k) ∇N_a` to the entries of every node, for `C` of them from tensor row `row` on.
fn add_column<const D: usize, const C: usize>(
    out: &mut [f64],
    row: usize,
    k: usize,
    gradients: &[[f64; D]],
    d: &Voigt,
    moving: &[f64; 3],
) {
    let mut m: [[f64; D]; C] = std::array::from_fn(|i| std::array::from_fn(|j| d[PLACE[i + row][j]]));
    for (m, t) in m.iter_mut().zip(moving) {
        m[k] -= t;
    }
    for (out, g) in out.as_chunks_mut::<C>().0.iter_mut().zip(gradients) {
        for (out, m) in out.iter_mut().zip(&m) {
            *out += m.iter().zip(g).map(|(m, g)| m * g).sum::<f64>();
        }
    }
}

fn circumference(frame: &Frame, radius: f64) -> f64 {
    if frame.axisymmetric { std::f64::consts::TAU * radius } else { 1.0 }
}

fn positive(determinant: f64, point: usize) -> Result<f64, InvertedPoint> {
    if determinant > 0.0 { Ok(determinant) } else { Err(InvertedPoint { point, determinant }) }
}
