//! Edges of triangles between samples.

/// An edge between two samples, the smaller number first.
pub(super) type Edge = [usize; 2];

/// Edges of a triangle.
pub(super) fn edges(corners: &[usize; 3]) -> [Edge; 3] {
    [0, 1, 2].map(|k| {
        let (a, b) = (corners[k], corners[(k + 1) % 3]);
        [a.min(b), a.max(b)]
    })
}
