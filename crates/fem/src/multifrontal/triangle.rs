//! Lower triangle of a symmetric matrix, as the elimination leaves it.

/// A symmetric matrix of which only the lower triangle is written. It lies in a square, column by column: operating systems
/// provide pages when they are first written, so that the other half occupies next to no memory.
#[derive(Clone, Debug, Default)]
pub struct Triangle {
    order: usize,
    values: Vec<f64>,
}

impl Triangle {
    /// A matrix of this order from a square whose lower triangle is given.
    pub(super) fn new(values: Vec<f64>, order: usize) -> Self {
        debug_assert_eq!(values.len(), order * order);
        Self { order, values }
    }

    /// Number of rows.
    #[must_use]
    pub fn order(&self) -> usize {
        self.order
    }

    /// The entry of a row and a column.
    #[must_use]
    #[inline]
    pub fn at(&self, row: usize, column: usize) -> f64 {
        self.values[row.min(column) * self.order + row.max(column)]
    }

    /// Memory of the triangle of a matrix of this order \[bytes\].
    #[must_use]
    pub fn bytes(order: usize) -> usize {
        order * (order + 1) / 2 * size_of::<f64>()
    }

    /// The whole matrix.
    #[must_use]
    pub fn whole(self) -> Vec<f64> {
        let Self { order, mut values } = self;
        for col in 0..order {
            for row in 0..col {
                values[col * order + row] = values[row * order + col];
            }
        }
        values
    }
}
