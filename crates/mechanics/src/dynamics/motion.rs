//! Motion of the free nodes over a step.

use asperity_fem::matrix_free::MatrixFree;
use rayon::prelude::*;

/// Nodes moved by one task: fixed, so that sums do not depend on the number of threads.
const CHUNK: usize = 4096;

/// Sums over nodes, for the energy.
#[derive(Clone, Copy, Default)]
pub(super) struct Sums {
    /// f·v before and after.
    pub internal: [f64; 2],
    /// v·M v of both half steps.
    pub kinetic: f64,
    /// u·f.
    pub elastic: f64,
    /// v·M v of the half step after.
    pub moving: f64,
}

impl Sums {
    fn plus(self, other: Self) -> Self {
        Self {
            internal: [self.internal[0] + other.internal[0], self.internal[1] + other.internal[1]],
            kinetic: self.kinetic + other.kinetic,
            elastic: self.elastic + other.elastic,
            moving: self.moving + other.moving,
        }
    }
}

/// Forces, masses and lengths of time that move the nodes.
pub(super) struct Motion<'a> {
    /// Forces of linear cells.
    pub product: &'a MatrixFree,
    /// Forces of cells with a history; empty without.
    pub history: &'a [f64],
    /// Lumped mass of each node \[kg\].
    pub mass: &'a [f64],
    /// 1/mass; 0 at special nodes, which move at their old velocity \[1/kg\].
    pub inverse: &'a [f64],
    /// Time over which velocities change \[s\].
    pub kick: f64,
    /// Δt \[s\].
    pub dt: f64,
    /// β Δt \[s\].
    pub damping: f64,
}

/// Displacements, velocities and damped displacements of the nodes of a task; the last are empty without damping.
type Parts<'p> = ((&'p mut [f64], &'p mut [f64]), &'p mut [f64]);

impl Motion<'_> {
    /// Moves all nodes of so many components.
    pub fn all(&self, components: usize, u: &mut [f64], velocity: &mut [f64], damped: &mut [f64]) -> Sums {
        match components {
            1 => self.of::<1>(u, velocity, damped),
            2 => self.of::<2>(u, velocity, damped),
            _ => self.of::<3>(u, velocity, damped),
        }
    }

    fn of<const C: usize>(&self, u: &mut [f64], velocity: &mut [f64], damped: &mut [f64]) -> Sums {
        let width = CHUNK * C;
        let mut own: Vec<&mut [f64]> = damped.chunks_mut(width).collect();
        own.resize_with(u.len().div_ceil(width), Default::default);
        let chunks = u.par_chunks_mut(width).zip(velocity.par_chunks_mut(width)).zip(own);
        let parts: Vec<Sums> =
            chunks.enumerate().map(|(k, parts)| self.chunk::<C>(k * CHUNK, parts)).collect();
        parts.into_iter().fold(Sums::default(), Sums::plus)
    }

    /// Moves the nodes of a task, the first of which is `start`.
    fn chunk<const C: usize>(&self, start: usize, ((u, v), w): Parts<'_>) -> Sums {
        let (u, _) = u.as_chunks_mut::<C>();
        let (v, _) = v.as_chunks_mut::<C>();
        let (w, _) = w.as_chunks_mut::<C>();
        let nodes = start..start + u.len();
        let masses = self.mass[nodes.clone()].iter().zip(&self.inverse[nodes]);
        let mut all = Of::<C>::default();
        for (i, ((u, v), masses)) in u.iter_mut().zip(v).zip(masses).enumerate() {
            self.node(start + i, (u, v), masses, &mut all);
            if let Some(w) = w.get_mut(i) {
                *w = std::array::from_fn(|c| u[c] + self.damping * v[c]);
            }
        }
        all.total()
    }

    /// Moves a node.
    #[inline(always)]
    fn node<const C: usize>(
        &self,
        node: usize,
        (u, v): (&mut [f64; C], &mut [f64; C]),
        (mass, inverse): (&f64, &f64),
        sums: &mut Of<C>,
    ) {
        let mut force = self.product.force_of::<C>(node);
        if !self.history.is_empty() {
            force.iter_mut().zip(&self.history[node * C..]).for_each(|(force, f)| *force += f);
        }
        let (free, counted) = if *inverse > 0.0 { (1.0, *mass) } else { (0.0, 0.0) };
        // Half a step before the start the velocity would have been 2 v⁰ - v¹ᐟ².
        let back = if self.kick < self.dt { 1.0 } else { 0.0 };
        for c in 0..C {
            let before = v[c];
            let after = before - self.kick * force[c] * inverse;
            sums.before[c] += free * force[c] * before;
            sums.after[c] += free * force[c] * after;
            sums.kinetic[c] += counted * (before + back * (before - after)) * after;
            sums.moving[c] += counted * after * after;
            sums.elastic[c] += u[c] * force[c];
            v[c] = after;
            u[c] += self.dt * after;
        }
    }
}

/// [`Sums`] of each component apart, which do not wait for each other.
struct Of<const C: usize> {
    before: [f64; C],
    after: [f64; C],
    kinetic: [f64; C],
    elastic: [f64; C],
    moving: [f64; C],
}

impl<const C: usize> Default for Of<C> {
    fn default() -> Self {
        let none = [0.0; C];
        Self { before: none, after: none, kinetic: none, elastic: none, moving: none }
    }
}

impl<const C: usize> Of<C> {
    fn total(&self) -> Sums {
        let sum = |of: &[f64; C]| of.iter().sum();
        Sums {
            internal: [sum(&self.before), sum(&self.after)],
            kinetic: sum(&self.kinetic),
            elastic: sum(&self.elastic),
            moving: sum(&self.moving),
        }
    }
}
