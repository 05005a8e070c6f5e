//! The operator of slip in two directions, of operators of one.

use super::Operator;
use std::sync::{Mutex, PoisonError};

/// Tractions that two components of slip cause. What a component does along itself, and to normal tractions, is an operator; so
/// is what it does across, where it does anything.
#[derive(Debug)]
pub struct Both {
    /// Of the first and of the second component.
    along: [Box<dyn Operator>; 2],
    /// Tractions along the first component by slip of the second, and the other way round.
    across: Option<[Box<dyn Operator>; 2]>,
    stiffness: Vec<f64>,
    /// A part of tractions.
    part: Mutex<Vec<f64>>,
}

impl Both {
    /// From the operators of each component along itself and, where slip loads across, of the second on the first and of the first
    /// on the second; all of as many points.
    #[must_use]
    pub fn new(along: [Box<dyn Operator>; 2], across: Option<[Box<dyn Operator>; 2]>) -> Self {
        let mut stiffness = [along[0].stiffness(), along[1].stiffness()].concat();
        let n = along[0].points();
        if let Some([by_second, by_first]) = &across {
            let (first, second) = stiffness.split_at_mut(n);
            first.iter_mut().zip(by_first.stiffness()).for_each(|(sum, s)| *sum += s);
            second.iter_mut().zip(by_second.stiffness()).for_each(|(sum, s)| *sum += s);
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

    fn shear(&self, slip: &[f64], shear: &mut [f64]) {
        let n = self.points();
        let ((first, second), (to_first, to_second)) = (slip.split_at(n), shear.split_at_mut(n));
        self.along[0].shear(first, to_first);
        self.along[1].shear(second, to_second);
        if let Some([by_second, by_first]) = &self.across {
            let mut part = self.part.lock().unwrap_or_else(PoisonError::into_inner);
            by_second.shear(second, &mut part);
            add(to_first, &part);
            by_first.shear(first, &mut part);
            add(to_second, &part);
        }
    }

    fn normal(&self, slip: &[f64], normal: &mut [f64]) {
        let (first, second) = slip.split_at(self.points());
        normal.fill(0.0);
        let mut part = self.part.lock().unwrap_or_else(PoisonError::into_inner);
        for (operator, slip) in self.along.iter().zip([first, second]).filter(|(o, _)| o.couples_normal()) {
            operator.normal(slip, &mut part);
            add(normal, &part);
        }
    }

    fn stiffness(&self) -> &[f64] {
        &self.stiffness
    }

    fn bytes(&self) -> usize {
        self.parts().map(Operator::bytes).sum()
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
