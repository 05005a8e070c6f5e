//! Pieces of a stage between the corners of its courses: no step passes over the end of one.

use super::Stage;
use crate::stage::Course;
use asperity_fem::corners::range;

/// Share of the range of a course by which a step moves it at most. A ramp over a whole stage moves as far in a largest step.
const SHARE: f64 = 0.05;
/// Rounding of the number of steps in a piece.
const ROUNDING: f64 = 1e-9;
/// Corners at most this share of the end of the stage apart are one: times such as 0.3 and 0.1 + 0.2, or 300 ms.
const SPACING: f64 = 16.0 * f64::EPSILON;

/// A part of a stage in which all of its courses are nearly straight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// End \[s\].
    pub end: f64,
    /// Largest step \[s\].
    pub longest: f64,
}

/// Pieces of a stage in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pieces(Vec<Piece>);

impl Pieces {
    /// Pieces of a stage. Corners are those of its courses, from which their entries depart by at most `tolerance` of the range.
    #[must_use]
    pub fn from_stage(stage: &Stage, tolerance: f64) -> Self {
        let courses = stage.courses();
        let mut ends: Vec<f64> = courses.iter().flat_map(|course| turns(course, tolerance)).collect();
        ends.retain(|&t| t > stage.start && t < stage.end);
        if ends.is_empty() {
            return Self::default();
        }
        ends.sort_by(f64::total_cmp);
        let apart = SPACING * stage.end.abs().max(stage.start.abs());
        // Of corners that are one the first is kept, and the end of the stage is exact.
        let mut kept: Vec<f64> = Vec::with_capacity(ends.len());
        for end in ends.into_iter().filter(|end| stage.end - end > apart).chain([stage.end]) {
            if end - kept.last().copied().unwrap_or(stage.start) > apart {
                kept.push(end);
            }
        }
        let begins = std::iter::once(stage.start).chain(kept.iter().copied());
        Self(
            begins
                .zip(&kept)
                .map(|(begin, &end)| Piece { end, longest: longest(&courses, begin, end) })
                .collect(),
        )
    }

    /// The piece in which a step begins at `time`; `None` in a stage without corners.
    #[must_use]
    pub fn at(&self, time: f64) -> Option<Piece> {
        self.0.get(self.0.partition_point(|piece| piece.end <= time)).copied()
    }
}

/// Times of the corners of a course \[s\].
fn turns(course: &Course, tolerance: f64) -> impl Iterator<Item = f64> {
    course.corners(tolerance).into_iter().map(|k| course.times[k])
}

/// Longest of equal steps from `begin` to `end` that move no course by more than its share.
fn longest(courses: &[Course], begin: f64, end: f64) -> f64 {
    let steps = |Course { moves, .. }: &Course| {
        let most = SHARE * range(moves.values());
        let change = (moves.value(end) - moves.value(begin)).abs();
        if most > 0.0 { (change / most * (1.0 - ROUNDING)).ceil().max(1.0) } else { 1.0 }
    };
    (end - begin) / courses.iter().map(steps).fold(1.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Motion;

    fn stage(tables: &[&[(f64, f64)]]) -> Stage {
        let motions = tables.iter().map(|t| (vec![0], Motion::Table(t.to_vec()))).collect();
        Stage { start: 1.0, motions, ..Stage::free("stroke", 11.0) }
    }

    #[test]
    fn steps_end_at_corners_and_move_a_course_by_a_twentieth_of_its_range() {
        let pieces = Pieces::from_stage(&stage(&[&[(0.0, 0.0), (4.0, 0.0), (5.0, 2.0), (10.0, 2.0)]]), 1e-4);
        let ends: Vec<f64> = pieces.0.iter().map(|p| p.end).collect();
        assert_eq!(ends, [5.0, 6.0, 11.0]);
        assert_eq!(pieces.at(1.0), Some(Piece { end: 5.0, longest: 4.0 }));
        assert_eq!(pieces.at(5.0), Some(Piece { end: 6.0, longest: 0.05 }));
        assert_eq!(pieces.at(6.0), Some(Piece { end: 11.0, longest: 5.0 }));
    }

    #[test]
    fn a_ramp_over_the_stage_has_no_pieces() {
        assert_eq!(Pieces::from_stage(&stage(&[&[(0.0, 0.0), (10.0, 3.0)]]), 1e-4), Pieces::default());
        assert_eq!(Pieces::from_stage(&stage(&[]), 1e-4).at(3.0), None);
    }

    #[test]
    fn corners_that_differ_by_rounding_are_one() {
        let (a, b) = (0.3, 0.1 + 0.2);
        let pieces = Pieces::from_stage(
            &stage(&[&[(0.0, 0.0), (a, 1.0), (10.0, 0.0)], &[(0.0, 0.0), (b, 2.0), (10.0, 5.0)]]),
            1e-4,
        );
        let ends: Vec<f64> = pieces.0.iter().map(|p| p.end).collect();
        assert_eq!(ends, [1.0 + a, 11.0]);
        let late = Pieces::from_stage(
            &stage(&[&[(0.0, 0.0), (5.0, 1.0), (10.0 * (1.0 - f64::EPSILON), 0.0)]]),
            1e-4,
        );
        let ends: Vec<f64> = late.0.iter().map(|p| p.end).collect();
        assert_eq!(ends, [6.0, 11.0]);
    }
}
