//! Size of figures.

use super::figure::{Figure, Point};

/// Size that was asked for all figures, in their units; without one, each figure has its own.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Paper {
    whole: Option<Point>,
}

impl Paper {
    /// Paper of this size.
    pub(super) fn new(whole: Option<Point>) -> Self {
        Self { whole }
    }

    /// Size of a frame with room `around` it, for numbers, labels and legends; `usual` where no size was asked for. Texts keep
    /// their size on any paper, so that the room around a frame is the same.
    pub(super) fn frame(self, usual: Point, around: Point) -> Point {
        self.whole.map_or(usual, |whole| (whole.0 - around.0, whole.1 - around.1))
    }

    /// True if a size was asked for.
    pub(super) fn is_asked(self) -> bool {
        self.whole.is_some()
    }

    /// A figure on the whole of the paper; what it does not need stays blank.
    pub(super) fn filled(self, figure: Figure) -> Figure {
        let Some((width, height)) = self.whole else { return figure };
        Figure { width: figure.width.max(width), height: figure.height.max(height), ..figure }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_takes_what_its_surroundings_leave() {
        assert_eq!(Paper::default().frame((560.0, 380.0), (96.0, 100.0)), (560.0, 380.0));
        let paper = Paper::new(Some((600.0, 400.0)));
        assert_eq!(paper.frame((560.0, 380.0), (96.0, 100.0)), (504.0, 300.0));
        let filled = paper.filled(Figure::new(500.0, 300.0));
        assert_eq!((filled.width, filled.height), (600.0, 400.0));
    }
}
