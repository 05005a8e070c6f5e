//! Committed history of an interface as plain numbers.

use crate::interface::Interface;
use asperity_fem::term::Saved;
use asperity_friction::law::Regime;

/// Reads numbers one after another.
struct Reader<'a> {
    from: &'a [f64],
}

impl<'a> Reader<'a> {
    fn take(&mut self, n: usize) -> &'a [f64] {
        let (head, tail) = self.from.split_at(n);
        self.from = tail;
        head
    }

    fn one(&mut self) -> f64 {
        self.take(1)[0]
    }

    fn vectors<const N: usize>(&mut self, out: &mut [[f64; N]]) {
        for o in out {
            o.copy_from_slice(self.take(N));
        }
    }
}

impl<const D: usize> Interface<D> {
    /// Unknowns beside the displacements.
    fn unknown(&self) -> usize {
        self.unknowns.as_ref().map_or(0, |u| u.committed.len())
    }

    fn saved_length(&self) -> usize {
        let n = self.slave.len();
        let shear = self.shear.as_ref().map_or(0, |s| n * (4 + s.states()));
        1 + self.nodes.len() * D + 2 * n + 6 * n + shear + self.unknown() + self.measure.saved()
    }
}

impl<const D: usize> Saved for Interface<D> {
    fn save(&self) -> Vec<f64> {
        let mut out = Vec::with_capacity(self.saved_length());
        out.push(self.previous_dt.unwrap_or(0.0));
        out.extend(self.u.committed.iter().flatten());
        for c in &self.contact.committed {
            out.extend_from_slice(&[f64::from(u8::from(c.closed)), c.traction]);
        }
        let m = &self.motion.committed;
        for v in [&m.relative, &m.slip, &m.step] {
            out.extend(v.iter().flatten());
        }
        if let Some(shear) = &self.shear {
            let c = &shear.committed;
            out.extend(c.traction.iter().flatten());
            out.extend_from_slice(&c.rate);
            out.extend(c.regime.iter().map(|r| f64::from(u8::from(*r == Regime::Slip))));
            out.extend_from_slice(&c.states);
        }
        if let Some(unknowns) = &self.unknowns {
            out.extend_from_slice(&unknowns.committed);
        }
        self.measure.save(&mut out);
        out
    }

    fn restore(&mut self, saved: &[f64]) -> bool {
        if saved.len() != self.saved_length() {
            return false;
        }
        let mut r = Reader { from: saved };
        let dt = r.one();
        self.previous_dt = (dt > 0.0).then_some(dt);
        r.vectors(&mut self.u.committed);
        for c in &mut self.contact.committed {
            c.closed = r.one() > 0.0;
            c.traction = r.one();
            c.stiffness = if c.closed { self.penalty.stiffness } else { 0.0 };
        }
        let m = &mut self.motion.committed;
        for v in [&mut m.relative, &mut m.slip, &mut m.step] {
            r.vectors(v);
        }
        if let Some(shear) = &mut self.shear {
            let c = &mut shear.committed;
            r.vectors(&mut c.traction);
            let n = c.rate.len();
            c.rate.copy_from_slice(r.take(n));
            for regime in &mut c.regime {
                *regime = if r.one() > 0.0 { Regime::Slip } else { Regime::Stick };
            }
            let states = c.states.len();
            c.states.copy_from_slice(r.take(states));
        }
        if let Some(unknowns) = &mut self.unknowns {
            let n = unknowns.committed.len();
            unknowns.committed.copy_from_slice(r.take(n));
        }
        self.measure.restore(r.from);
        asperity_fem::term::Term::reject(self);
        self.refresh();
        true
    }
}
