//! The least normal traction that friction uses.
//!
//! Normal tractions that slip and loads change may fall to zero, near a free surface first, and friction has no slip rate there. With a floor,
//! friction uses `max(f_n, floor)` and its rate, which is zero below: what bodies press, f_n, goes on below the floor as an unknown of its own and comes back the way it
//! went. The product `f_n μ` stays continuous, so that no unknown jumps; its rate does, and steps that cross the floor are shortened by the control of errors.
//! Memories of normal traction follow what friction uses.

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
