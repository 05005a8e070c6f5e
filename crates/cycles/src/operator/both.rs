//! The operator of slip in two directions, composed of operators of one direction.

use super::Operator;
use asperity_friction::points::Components;
use serde::{Deserialize, Serialize};
use std::sync::{Mutex, PoisonError};

/// Tractions caused by two components of slip. One operator holds the effect of a component on itself and on normal
/// tractions. Another holds its effect on the other component, if there is any.
#[derive(Debug, Serialize, Deserialize)]
#[serde(from = "Parts")]
pub struct Both {
    /// Operators of the first and of the second component on themselves.
    along: [Box<dyn Operator>; 2],
    /// Tractions along the first component caused by slip of the second, and the reverse.
    across: Option<[Box<dyn Operator>; 2]>,
    #[serde(skip)]
    stiffness: Vec<f64>,
    /// Working memory for one part of the tractions.
    #[serde(skip)]
    part: Mutex<Vec<f64>>,
}

/// Parts of such an operator as they are written.
#[derive(Deserialize)]
struct Parts {
    along: [Box<dyn Operator>; 2],
    across: Option<[Box<dyn Operator>; 2]>,
}

impl From<Parts> for Both {
    fn from(Parts { along, across }: Parts) -> Self {
        Self::new(along, across)
    }
}

impl Both {
    /// Composed of the operators of each component on itself and, where slip loads the other component, of the second
    /// on the first and the first on the second. All have the same number of points.
    #[must_use]
    pub fn new(along: [Box<dyn Operator>; 2], across: Option<[Box<dyn Operator>; 2]>) -> Self {
        let mut stiffness = [along[0].stiffness().all(), along[1].stiffness().all()].concat();
        let n = along[0].points();
        if let Some([by_second, by_first]) = &across {
            let (first, second) = stiffness.split_at_mut(n);
            add(first, by_first.stiffness().all());
            add(second, by_second.stiffness().all());
        }
        Self { along, across, stiffness, part: Mutex::new(vec![0.0; n]) }
    }

    fn parts(&self) -> impl Iterator<Item = &dyn Operator> {
        self.along.iter().chain(self.across.iter().flatten()).map(AsRef::as_ref)
    }
}

fn add(sum: &mut [f64], part: &[f64]) {
    sum.iter_mut().zip(part).for_each(|(s, p)| *s += p);
}

impl Operator for Both {
    fn points(&self) -> usize {
        self.along[0].points()
    }

    fn components(&self) -> usize {
        2
    }

    fn couples_normal(&self) -> bool {
        self.along.iter().any(|o| o.couples_normal())
    }

    fn shear(&self, slip: Components<&[f64]>, mut shear: Components<&mut [f64]>) {
        let n = self.points();
        let slip = [0, 1].map(|component| Components::new(slip.component(component), n));
        let mut shear = shear.pair_mut();
        for ((operator, slip), shear) in self.along.iter().zip(slip).zip(&mut shear) {
            operator.shear(slip, Components::new(*shear, n));
        }
        let mut part = self.part.lock().unwrap_or_else(PoisonError::into_inner);
        for (to, operator) in self.across.iter().flatten().enumerate() {
            operator.shear(slip[1 - to], Components::new(&mut part, n));
            add(shear[to], &part);
        }
    }

    fn normal(&self, slip: Components<&[f64]>, normal: &mut [f64]) {
        normal.fill(0.0);
        let mut part = self.part.lock().unwrap_or_else(PoisonError::into_inner);
        for (component, operator) in self.along.iter().enumerate().filter(|(_, o)| o.couples_normal()) {
            operator.normal(Components::new(slip.component(component), self.points()), &mut part);
            add(normal, &part);
        }
    }

    fn stiffness(&self) -> Components<&[f64]> {
        Components::new(&self.stiffness, self.points())
    }

    fn bytes(&self) -> usize {
        self.parts().map(Operator::bytes).sum()
    }

    fn moved(&self) -> usize {
        self.parts().map(Operator::moved).sum()
    }

    fn words(&self) -> String {
        let across = if self.across.is_some() { "and across" } else { "not across" };
        format!(
            "slip in two directions, which load along themselves {across}; along the first: {}; {:.1} kB in all",
            self.along[0].words(),
            self.bytes() as f64 / 1e3
        )
    }
}
