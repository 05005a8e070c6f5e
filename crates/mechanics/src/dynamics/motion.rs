//! Motion of the free nodes over a step.

use asperity_fem::matrix_free::MatrixFree;
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

/// Nodes moved by one task: fixed, so that sums do not depend on the number of threads.
const CHUNK: usize = 4096;

/// Nodes whose forces are read at once, so that they stay in the first cache.
const GROUP: usize = 128;

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
        Arch::new().dispatch(Task::<C> { motion: self, start, u, v, w })
    }

    /// Reads the forces on nodes from `first` on.
    #[inline(always)]
    fn read<const C: usize>(&self, first: usize, force: &mut [[f64; C]]) {
        self.product.read(first, force);
        if !self.history.is_empty() {
            let forces = force.as_flattened_mut();
            forces.iter_mut().zip(&self.history[first * C..]).for_each(|(force, f)| *force += f);
        }
    }

    /// Reads the masses and inverse masses of nodes from `first` on, as many times as a node has components.
    #[inline(always)]
    fn masses<const C: usize>(&self, first: usize, counted: &mut [[f64; C]], inverse: &mut [[f64; C]]) {
        let masses = self.mass[first..].iter().zip(&self.inverse[first..]);
        for ((counted, own), (mass, inverse)) in counted.iter_mut().zip(inverse).zip(masses) {
            *counted = [if *inverse > 0.0 { *mass } else { 0.0 }; C];
            *own = [*inverse; C];
        }
    }

    /// Moves as many degrees of freedom as a vector has; returns their displacements and velocities.
    #[inline(always)]
    fn vector<S: Simd>(
        &self,
        simd: S,
        (u, before): (S::f64s, S::f64s),
        force: S::f64s,
        (counted, inverse): (S::f64s, S::f64s),
        sums: &mut Vectors<S>,
    ) -> (S::f64s, S::f64s) {
        let zero = simd.splat_f64s(0.0);
        let kick = simd.mul_f64s(simd.splat_f64s(self.kick), inverse);
        let after = simd.sub_f64s(before, simd.mul_f64s(kick, force));
        let free = simd.select_f64s(simd.greater_than_f64s(inverse, zero), force, zero);
        // Half a step before the start the velocity would have been 2 v⁰ - v¹ᐟ².
        let back = simd.splat_f64s(if self.kick < self.dt { 1.0 } else { 0.0 });
        let prior = simd.mul_add_e_f64s(back, simd.sub_f64s(before, after), before);
        let momentum = simd.mul_f64s(counted, after);
        sums.before = simd.mul_add_e_f64s(free, before, sums.before);
        sums.after = simd.mul_add_e_f64s(free, after, sums.after);
        sums.kinetic = simd.mul_add_e_f64s(momentum, prior, sums.kinetic);
        sums.moving = simd.mul_add_e_f64s(momentum, after, sums.moving);
        sums.elastic = simd.mul_add_e_f64s(u, force, sums.elastic);
        (simd.mul_add_e_f64s(simd.splat_f64s(self.dt), after, u), after)
    }
}

/// Nodes of a task, the first of which is `start`.
struct Task<'a, 'p, const C: usize> {
    motion: &'a Motion<'a>,
    start: usize,
    u: &'p mut [f64],
    v: &'p mut [f64],
    w: &'p mut [f64],
}

impl<const C: usize> WithSimd for Task<'_, '_, C> {
    type Output = Sums;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Sums {
        let Self { motion, start, u, v, w } = self;
        let mut sums = Vectors::new(simd);
        let [mut forces, mut counted, mut inverse] = [[[0.0; C]; GROUP]; 3];
        let groups = u.chunks_mut(GROUP * C).zip(v.chunks_mut(GROUP * C));
        for (group, (u, v)) in groups.enumerate() {
            let (first, length) = (start + group * GROUP, u.len() / C);
            motion.read(first, &mut forces[..length]);
            motion.masses(first, &mut counted[..length], &mut inverse[..length]);
            let (f, f_rest) = S::as_simd_f64s(forces[..length].as_flattened());
            let (m, m_rest) = S::as_simd_f64s(counted[..length].as_flattened());
            let (i, i_rest) = S::as_simd_f64s(inverse[..length].as_flattened());
            let ((u, u_rest), (v, v_rest)) = (S::as_mut_simd_f64s(u), S::as_mut_simd_f64s(v));
            for (((u, v), f), (m, i)) in u.iter_mut().zip(v).zip(f).zip(m.iter().zip(i)) {
                (*u, *v) = motion.vector(simd, (*u, *v), *f, (*m, *i), &mut sums);
            }
            if !u_rest.is_empty() {
                let part = |values: &[f64]| simd.partial_load_f64s(values);
                let masses = (part(m_rest), part(i_rest));
                let moved = (part(u_rest), part(v_rest));
                let (u, v) = motion.vector(simd, moved, part(f_rest), masses, &mut sums);
                simd.partial_store_f64s(u_rest, u);
                simd.partial_store_f64s(v_rest, v);
            }
        }
        for ((w, u), v) in w.iter_mut().zip(u).zip(v) {
            *w = *u + motion.damping * *v;
        }
        sums.total(simd)
    }
}

/// [`Sums`] of each place of a vector apart, which do not wait for each other.
struct Vectors<S: Simd> {
    before: S::f64s,
    after: S::f64s,
    kinetic: S::f64s,
    elastic: S::f64s,
    moving: S::f64s,
}

impl<S: Simd> Vectors<S> {
    #[inline(always)]
    fn new(simd: S) -> Self {
        let none = simd.splat_f64s(0.0);
        Self { before: none, after: none, kinetic: none, elastic: none, moving: none }
    }

    #[inline(always)]
    fn total(&self, simd: S) -> Sums {
        let sum = |of| simd.reduce_sum_f64s(of);
        Sums {
            internal: [sum(self.before), sum(self.after)],
            kinetic: sum(self.kinetic),
            elastic: sum(self.elastic),
            moving: sum(self.moving),
        }
    }
}
