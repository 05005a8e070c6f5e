//! Course of a prescribed value in a stage, as far as it is known before anything is built.

use crate::lengths::show;
use crate::model::Motion;

/// Admissible difference of displacements relative to the larger one: rounding, as of a rate times a duration compared with a
/// written target.
const ROUNDING: f64 = 1e-9;

/// Course of a prescribed value in a stage.
#[derive(Clone, Debug)]
pub enum Course {
    /// Piecewise linear through (time since the stage began \[s\], displacement \[m\]), constant beyond.
    Known(Vec<(f64, f64)>),
    /// Depends on the positions of the nodes.
    Relative(Motion),
}

impl Course {
    /// Course of `motion` over `duration`, from the displacement `present` if known.
    pub fn new(motion: &Motion, present: Option<f64>, duration: f64) -> Self {
        match (motion, present) {
            (Motion::Fixed(value), _) => Self::Known(vec![(0.0, *value)]),
            (Motion::Table(points), _) if !points.is_empty() => Self::Known(points.to_vec()),
            (Motion::To(value), Some(from)) => Self::Known(vec![(0.0, from), (duration, *value)]),
            (Motion::Rate(rate), Some(from)) => {
                Self::Known(rate.path(duration).into_iter().map(|(t, moved)| (t, from + moved)).collect())
            }
            (Motion::Hold, Some(from)) => Self::Known(vec![(0.0, from)]),
            _ => Self::Relative(motion.clone()),
        }
    }

    /// Displacement at a time since the stage began, if known.
    pub fn at(&self, time: f64) -> Option<f64> {
        let Self::Known(points) = self else { return None };
        let after = points.iter().position(|p| p.0 > time);
        Some(match after {
            Some(0) => points[0].1,
            Some(k) => {
                let ((t0, u0), (t1, u1)) = (points[k - 1], points[k]);
                u0 + (u1 - u0) * (time - t0) / (t1 - t0)
            }
            None => points.last()?.1,
        })
    }

    /// True if both courses agree during a stage, regardless of how they are written.
    pub fn agrees(&self, other: &Self, duration: f64) -> bool {
        match (self, other) {
            (Self::Known(a), Self::Known(b)) => {
                let largest = a.iter().chain(b).map(|p| p.1.abs()).fold(0.0, f64::max);
                let corners = a.iter().chain(b).map(|p| p.0.clamp(0.0, duration));
                corners.chain([0.0, duration]).all(|time| match (self.at(time), other.at(time)) {
                    (Some(a), Some(b)) => (a - b).abs() <= ROUNDING * largest,
                    _ => false,
                })
            }
            (Self::Relative(a), Self::Relative(b)) => a == b,
            _ => false,
        }
    }

    /// Description as text, with units.
    pub fn words(&self) -> String {
        match self {
            Self::Known(points) => match points[..] {
                [(_, only)] => show(only),
                [(_, from), (_, to)] => format!("{} to {}", show(from), show(to)),
                _ => "a table".into(),
            },
            Self::Relative(Motion::Hold) => "the value it has".into(),
            Self::Relative(Motion::To(value)) => format!("the value it has to {}", show(*value)),
            Self::Relative(Motion::Rotate(_)) => "a rotation".into(),
            Self::Relative(Motion::Spring { .. }) => "a spring".into(),
            Self::Relative(_) => "a rate from the value it has".into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Pace;

    fn known(motion: &Motion) -> Course {
        Course::new(motion, Some(1e-3), 10.0)
    }

    #[test]
    fn a_ramp_a_rate_and_a_table_of_one_course_agree() {
        let ramp = known(&Motion::To(3e-3));
        let rate = known(&Motion::Rate(Pace::Steady(2e-4)));
        let table = known(&Motion::Table(vec![(0.0, 1e-3), (5.0, 2e-3), (10.0, 3e-3)].into()));
        assert!(ramp.agrees(&rate, 10.0) && rate.agrees(&table, 10.0) && table.agrees(&ramp, 10.0));
    }

    #[test]
    fn courses_that_differ_anywhere_in_the_stage_do_not_agree() {
        let ramp = known(&Motion::To(3e-3));
        let detour = known(&Motion::Table(vec![(0.0, 1e-3), (5.0, 2.1e-3), (10.0, 3e-3)].into()));
        assert!(!ramp.agrees(&detour, 10.0) && !detour.agrees(&ramp, 10.0));
        assert!(!ramp.agrees(&known(&Motion::Fixed(3e-3)), 10.0));
        assert!(!ramp.agrees(&known(&Motion::Hold), 10.0));
    }

    #[test]
    fn what_depends_on_the_nodes_agrees_only_with_itself() {
        let relative = |m: &Motion| Course::new(m, None, 10.0);
        assert!(relative(&Motion::Hold).agrees(&relative(&Motion::Hold), 10.0));
        assert!(!relative(&Motion::Hold).agrees(&relative(&Motion::Rate(Pace::Steady(0.0))), 10.0));
        assert!(!relative(&Motion::Hold).agrees(&known(&Motion::Hold), 10.0));
    }

    #[test]
    fn a_table_is_constant_beyond_its_ends() {
        let table = known(&Motion::Table(vec![(2.0, 1.0), (4.0, 3.0)].into()));
        let values: Vec<f64> = [0.0, 2.0, 3.0, 4.0, 9.0].iter().filter_map(|&t| table.at(t)).collect();
        assert_eq!(values, [1.0, 1.0, 2.0, 3.0, 3.0]);
    }
}
