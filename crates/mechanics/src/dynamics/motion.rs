//! Motion of the nodes over a step.

use super::special_actions::SpecialActions;
use super::sums::Sums;
use asperity_fem::matrix_free::MatrixFree;
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;
use std::ops::Range;

/// Nodes moved by one task: fixed, so that sums do not depend on the number of threads.
const CHUNK: usize = 4096;

/// Nodes whose forces are read at once, so that they stay in the first cache.
const GROUP: usize = 128;

/// Forces on the nodes of a group, their displacements and their velocities.
type Group<'a, const C: usize> = (&'a [[f64; C]], &'a [[f64; C]], &'a mut [[f64; C]]);

/// Forces, masses and lengths of time that move the nodes.
pub(super) struct Motion<'a> {
    /// Forces of linear cells.
    pub product: &'a MatrixFree,
    /// Forces of cells with a history; empty without.
    pub history: &'a [f64],
    /// Lumped mass of each node \[kg\].
    pub mass: &'a [f64],
    /// 1/mass; 0 at special nodes \[1/kg\].
    pub inverse: &'a [f64],
    /// Loads and constraints of the special nodes.
    pub actions: SpecialActions<'a>,
    /// Accelerations of the nodes of faults \[m/s²\].
    pub faulted: &'a [[f64; 3]],
}

impl Motion<'_> {
    /// Moves all nodes.
    pub fn all(&self, u: &mut [f64], velocity: &mut [f64]) -> Sums {
        match self.actions.components {
            1 => self.advance::<1>(u, velocity),
            2 => self.advance::<2>(u, velocity),
            _ => self.advance::<3>(u, velocity),
        }
    }

    fn advance<const C: usize>(&self, u: &mut [f64], velocity: &mut [f64]) -> Sums {
        let width = CHUNK * C;
        let chunks = u.par_chunks_mut(width).zip(velocity.par_chunks_mut(width));
        let task = |(k, (u, v))| Arch::new().dispatch(Task::<C> { motion: self, start: k * CHUNK, u, v });
        let parts: Vec<Sums> = chunks.enumerate().map(task).collect();
        parts.into_iter().fold(Sums::default(), Sums::plus)
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

    /// Accelerates the special nodes of a group at these places, whose first node is `first`. They are moved with the others.
    #[inline(always)]
    fn special<const C: usize>(
        &self,
        (first, places): (usize, &[Range<usize>; 2]),
        (force, u, v): Group<'_, C>,
        sums: &mut Sums,
    ) {
        for place in places.iter().cloned().flatten() {
            let own = self.actions.nodes.all[place].node - first;
            let known = self.faulted.get(place);
            self.actions.accelerate(place, known, &force[own], &u[own], &mut v[own], sums);
        }
    }

    /// Moves degrees of freedom with these forces, masses and inverse masses.
    #[inline(always)]
    fn group<S: Simd>(
        &self,
        simd: S,
        (u, v): (&mut [f64], &mut [f64]),
        [forces, counted, inverse]: [&[f64]; 3],
        sums: &mut Vectors<S>,
    ) {
        let (f, f_rest) = S::as_simd_f64s(forces);
        let (m, m_rest) = S::as_simd_f64s(counted);
        let (i, i_rest) = S::as_simd_f64s(inverse);
        let ((u, u_rest), (v, v_rest)) = (S::as_mut_simd_f64s(u), S::as_mut_simd_f64s(v));
        for (((u, v), f), (m, i)) in u.iter_mut().zip(v).zip(f).zip(m.iter().zip(i)) {
            (*u, *v) = self.vector(simd, (*u, *v), *f, (*m, *i), sums);
        }
        if !u_rest.is_empty() {
            let part = |values: &[f64]| simd.partial_load_f64s(values);
            let masses = (part(m_rest), part(i_rest));
            let moved = (part(u_rest), part(v_rest));
            let (u, v) = self.vector(simd, moved, part(f_rest), masses, sums);
            simd.partial_store_f64s(u_rest, u);
            simd.partial_store_f64s(v_rest, v);
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
        let SpecialActions { kick, dt, .. } = self.actions;
        let back = simd.splat_f64s(if kick < dt { 1.0 } else { 0.0 });
        let kick = simd.mul_f64s(simd.splat_f64s(kick), inverse);
        let after = simd.sub_f64s(before, simd.mul_f64s(kick, force));
        let free = simd.select_f64s(simd.greater_than_f64s(inverse, zero), force, zero);
        // Half a step before the start the velocity would have been 2 v⁰ - v¹ᐟ².
        let prior = simd.mul_add_e_f64s(back, simd.sub_f64s(before, after), before);
        let momentum = simd.mul_f64s(counted, after);
        sums.before = simd.mul_add_e_f64s(free, before, sums.before);
        sums.after = simd.mul_add_e_f64s(free, after, sums.after);
        sums.kinetic = simd.mul_add_e_f64s(momentum, prior, sums.kinetic);
        sums.moving = simd.mul_add_e_f64s(momentum, after, sums.moving);
        sums.elastic = simd.mul_add_e_f64s(u, force, sums.elastic);
        (simd.mul_add_e_f64s(simd.splat_f64s(dt), after, u), after)
    }
}

/// Nodes of a task, the first of which is `start`.
struct Task<'a, 'p, const C: usize> {
    motion: &'a Motion<'a>,
    start: usize,
    u: &'p mut [f64],
    v: &'p mut [f64],
}

impl<const C: usize> WithSimd for Task<'_, '_, C> {
    type Output = Sums;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Sums {
        let Self { motion, start, u, v } = self;
        let nodes = motion.actions.nodes;
        let mut next = nodes.from(start);
        let (mut vectors, mut sums) = (Vectors::new(simd), Sums::default());
        let [mut forces, mut counted, mut inverse] = [[[0.0; C]; GROUP]; 3];
        let groups = u.chunks_mut(GROUP * C).zip(v.chunks_mut(GROUP * C));
        for (group, (u, v)) in groups.enumerate() {
            let (first, length) = (start + group * GROUP, u.len() / C);
            let places = nodes.until(first + length, &mut next);
            motion.read(first, &mut forces[..length]);
            motion.masses(first, &mut counted[..length], &mut inverse[..length]);
            let (own_u, own_v) = (u.as_chunks::<C>().0, v.as_chunks_mut::<C>().0);
            motion.special((first, &places), (&forces[..length], own_u, own_v), &mut sums);
            let own = [&forces, &counted, &inverse].map(|values| values[..length].as_flattened());
            motion.group(simd, (u, v), own, &mut vectors);
            for special in places.into_iter().flatten().map(|place| &nodes.all[place]) {
                motion.actions.put(special, &mut u.as_chunks_mut::<C>().0[special.node - first]);
            }
        }
        vectors.total(simd).plus(sums)
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
            ..Sums::default()
        }
    }
}
