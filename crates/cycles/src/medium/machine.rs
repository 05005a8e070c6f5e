//! Testing machine that loads a laboratory specimen: boundaries that each move as one, loaded by springs of finite
//! stiffness.
//!
//! The first degree of freedom of such a boundary represents the motion q of all: `u_i = q + d_i` with `d_i` held at
//! zero, which is a jump from one degree of freedom to another. The spring adds its stiffness k there, and pulls with k
//! times the displacement of its far end.

use asperity_fem::condense::Stiffness;
use asperity_fem::dof::Channel;
use asperity_fem::jump::{Jump, Jumps, ObliqueConstraint};
use asperity_fem::table::Table;
use asperity_fem::term::Blocks;

/// Degrees of freedom that move as one, loaded by a spring.
#[derive(Clone, Debug, PartialEq)]
pub struct Spring {
    /// The degrees of freedom.
    pub dofs: Vec<usize>,
    /// Stiffness \[N/m; N/m per metre of thickness in the plane\].
    pub stiffness: f64,
    /// Displacement of its far end since time 0, in straight pieces \[m\].
    pub drawn: Table,
}

/// Springs, and the ties that make boundaries move as one.
#[derive(Debug)]
pub(super) struct Machine<'a> {
    springs: &'a [Spring],
    ties: Jumps<1>,
}

impl<'a> Machine<'a> {
    pub fn new(springs: &'a [Spring]) -> Self {
        let ties = springs.iter().flat_map(|spring| {
            let rest = spring.dofs.get(1..).unwrap_or_default();
            rest.iter().map(|&dof| Jump { minus: spring.dofs[0], plus: dof, frame: [[1.0]] })
        });
        Self { springs, ties: Jumps::new(ties.collect()) }
    }

    /// True if a spring moves this degree of freedom.
    pub fn draws(&self, dof: usize) -> bool {
        self.springs.iter().any(|s| s.dofs.contains(&dof))
    }

    /// Stiffness with spring-loaded boundaries moving as one, and with that of the springs.
    pub fn stiffness(&self, body: Stiffness) -> Stiffness {
        let mut all = if self.ties.list().is_empty() { body } else { self.ties.stiffness(&body) };
        let mut cells = Blocks::default();
        cells.append(all.pattern);
        for spring in self.springs {
            if let Some(&first) = spring.dofs.first() {
                cells.push([first]);
                all.values.push(spring.stiffness);
            }
        }
        Stiffness { pattern: cells.into(), ..all }
    }

    /// Ties that make boundaries move as one.
    pub fn ties(&self) -> &Jumps<1> {
        &self.ties
    }

    /// Degrees of freedom tied to the first of their boundary.
    pub fn tied(&self) -> impl Iterator<Item = usize> {
        self.ties.list().iter().map(|tie| tie.plus)
    }

    /// A channel of forces and displacements with spring-loaded boundaries moving as one.
    ///
    /// # Errors
    /// [`ObliqueConstraint`] if a displacement of a spring-loaded boundary is prescribed.
    pub fn channel(&self, channel: &Channel) -> Result<Channel, ObliqueConstraint> {
        self.ties.channel(channel, &[])
    }

    /// Loads by the far ends of the springs.
    pub fn pulls(&self) -> impl Iterator<Item = Channel> {
        self.springs.iter().filter_map(|spring| {
            let amplitude = spring.drawn.clone();
            let forces = vec![(*spring.dofs.first()?, spring.stiffness)];
            Some(Channel { prescribed: Vec::new(), forces, amplitude })
        })
    }
}
