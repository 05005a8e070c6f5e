//! The least normal traction that friction uses.
//!
//! Where slip and loads change normal tractions they may fall to zero, near a free surface first, and friction has no slip rate there. With a floor,
//! friction uses `max(f_n, floor)` and its rate, which is zero below: what bodies press, f_n, goes on below the floor as an unknown of its own and comes back the way it
//! went. The product `f_n μ` stays continuous, so that no unknown jumps; its rate does, and steps that cross the floor are shortened by the control of errors.
//! Memories of normal traction follow what friction uses.

use crate::scene::model::Fault as Spec;
use crate::warning::Warning;

/// What the scene says of normal tractions on a fault.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalChoice {
    /// Whether slip and loads change them.
    pub changes: bool,
    /// The least that friction uses \[Pa\].
    pub floor: Option<f64>,
    /// Whether the fault opens where nothing presses it.
    pub opens: bool,
}

impl NormalChoice {
    pub(super) fn of(spec: &Spec) -> Self {
        Self {
            changes: spec.normal_changes.as_ref().is_none_or(|c| *c.get_ref()),
            floor: spec.normal_floor.as_ref().map(|f| f.get_ref().0),
            opens: spec.opening.as_ref().is_some_and(|o| *o.get_ref()),
        }
    }

    /// In words, where they may change.
    pub(super) fn words(self, fault: &str) -> String {
        let changes = if self.changes {
            "slip and loads change normal tractions"
        } else {
            "slip and loads leave normal tractions as they are, since `normal_changes = false`"
        };
        let below = match self.floor {
            Some(floor) if self.opens => format!(
                "; the fault opens where they would pull, and friction uses {:?} MPa where they are less",
                floor / 1e6
            ),
            Some(floor) => {
                format!("; friction uses {:?} MPa where they are less, and they go on below", floor / 1e6)
            }
            None if self.changes => "; the run ends where one falls to zero".into(),
            None => String::new(),
        };
        format!("fault `{fault}`: {changes}{below}")
    }
}

/// A warning where a floor lies above what presses a fault at the start: it decides friction there, not what is pressed. Of faults that weight presses, which
/// does not press a free surface, it may do so at up to half of the points: the plan notes how many there are.
pub(super) fn above_start(
    name: &str,
    spec: &Spec,
    weighs: bool,
    normals: impl Iterator<Item = f64>,
) -> Option<Warning> {
    let floor = spec.normal_floor.as_ref()?;
    let (mut below, mut all) = (0, 0);
    for normal in normals {
        all += 1;
        below += usize::from(normal < floor.get_ref().0);
    }
    let allowed = if weighs { all / 2 } else { 0 };
    (below > allowed).then(|| {
        Warning::at(
            floor.span(),
            format!("the floor of fault `{name}` lies above its normal traction at the start at {below} of {all} points"),
            "a floor is for what slip takes away: choose it below the normal tractions at the start",
        )
    })
}

/// The floors of the points \[Pa\]; minus infinity where there is none.
#[derive(Clone, Debug, PartialEq)]
pub struct Floor {
    least: Vec<f64>,
}

impl Floor {
    /// Of these points, where one of them has a floor.
    pub fn new(floors: impl Iterator<Item = Option<f64>>) -> Option<Self> {
        let least: Vec<f64> = floors.map(|f| f.unwrap_or(f64::NEG_INFINITY)).collect();
        least.iter().any(|f| f.is_finite()).then_some(Self { least })
    }

    /// The floor of a point \[Pa\].
    #[must_use]
    pub fn at(&self, point: usize) -> f64 {
        self.least[point]
    }

    /// Puts the floor in the place of normal tractions below it, and zero in that of their rates.
    pub fn hold(&self, normal: &mut [f64], rate: &mut [f64]) {
        for ((normal, rate), &least) in normal.iter_mut().zip(rate).zip(&self.least) {
            if *normal < least {
                (*normal, *rate) = (least, 0.0);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::Floor;

    #[test]
    fn what_lies_below_its_floor_is_held_there_and_all_else_is_left() {
        let floor = Floor::new([None, Some(1e6), Some(1e6)].into_iter()).unwrap();
        let (mut normal, mut rate) = ([-5.0, 2e6, -3e6], [1.0, 2.0, 3.0]);
        floor.hold(&mut normal, &mut rate);
        assert_eq!((normal, rate), ([-5.0, 2e6, 1e6], [1.0, 2.0, 0.0]));
        assert!(Floor::new([None, None].into_iter()).is_none());
    }
}
