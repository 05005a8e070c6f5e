//! Motion of the special nodes: what acts on them besides the forces of cells.

use super::nodes::{SpecialNode, SpecialNodes};
use super::sums::Sums;

/// Loads and constraints of the special nodes in a step.
pub(super) struct SpecialActions<'a> {
    pub nodes: &'a SpecialNodes,
    /// Loads \[N\]; empty where nothing loads a special node.
    pub external: &'a [[f64; 3]],
    /// Displacements that conditions prescribe at the next step, of all degrees of freedom \[m\]; empty without such conditions.
    pub imposed: &'a [f64],
    /// Number of components of displacements.
    pub components: usize,
    /// Δt \[s\].
    pub dt: f64,
    /// Time over which velocities change \[s\]: Δt, but half of it in the first step.
    pub kick: f64,
}

impl SpecialActions<'_> {
    fn external(&self, place: usize) -> [f64; 3] {
        self.external.get(place).copied().unwrap_or_default()
    }

    /// Acceleration of the special node at a place without tractions on faults, with the forces of cells, velocities half a step before
    /// and displacements there \[m/s²\].
    pub fn acceleration(&self, place: usize, [internal, before, u]: [&[f64; 3]; 3]) -> [f64; 3] {
        let s = &self.nodes.all[place];
        let (external, drag) = (self.external(place), s.drag(before));
        let force = std::array::from_fn(|c| external[c] + drag[c] - internal[c]);
        let mut acceleration = s.accelerated(&force);
        for c in (0..self.components).filter(|&c| s.prescribed[c]) {
            let imposed = self.imposed[s.node * self.components + c];
            acceleration[c] = ((imposed - u[c]) / self.dt - before[c]) / self.dt;
        }
        acceleration
    }

    /// Velocity half a step after \[m/s\].
    pub fn after(&self, s: &SpecialNode, before: &[f64; 3], acceleration: &[f64; 3]) -> [f64; 3] {
        let time = |c: usize| if s.prescribed[c] { self.dt } else { self.kick };
        std::array::from_fn(|c| before[c] + time(c) * acceleration[c])
    }

    /// Gives the special node at a place its velocity half a step after, and adds its part to the sums. Nodes of faults have their
    /// acceleration already.
    #[inline]
    pub fn accelerate<const C: usize>(
        &self,
        place: usize,
        known: Option<&[f64; 3]>,
        internal: &[f64; C],
        u: &[f64; C],
        v: &mut [f64; C],
        sums: &mut Sums,
    ) {
        let s = &self.nodes.all[place];
        let (internal, before) = (in_space(internal), in_space(v));
        let computed = || self.acceleration(place, [&internal, &before, &in_space(u)]);
        let acceleration = known.copied().unwrap_or_else(computed);
        let after = self.after(s, &before, &acceleration);
        let drag = s.drag(&std::array::from_fn(|c| 0.5 * (before[c] + after[c])));
        let external = self.external(place);
        let first = self.kick < self.dt;
        for c in 0..C {
            // What a prescribed motion exerts follows from the balance of the node; faults do not act along it.
            let (given, force) = if s.prescribed[c] {
                (&mut sums.motions, s.mass * acceleration[c] + internal[c] - drag[c])
            } else {
                (&mut sums.loads, external[c])
            };
            let sides = [before[c], after[c]];
            for (side, v) in sides.iter().enumerate() {
                given[side] += force * v;
                sums.internal[side] += internal[c] * v;
                sums.absorbed[side] -= drag[c] * v;
            }
            let prior = if first && !s.prescribed[c] { 2.0 * before[c] - after[c] } else { before[c] };
            sums.kinetic += s.mass * prior * after[c];
            sums.moving += s.mass * after[c] * after[c];
            v[c] = after[c];
        }
    }

    /// Puts a special node where conditions prescribe it.
    #[inline]
    pub fn put<const C: usize>(&self, s: &SpecialNode, u: &mut [f64; C]) {
        for c in (0..C).filter(|&c| s.prescribed[c]) {
            u[c] = self.imposed[s.node * C + c];
        }
    }
}

/// Vector of a node of C components.
pub(super) fn in_space<const C: usize>(v: &[f64; C]) -> [f64; 3] {
    std::array::from_fn(|c| v.get(c).copied().unwrap_or(0.0))
}
