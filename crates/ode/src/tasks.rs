//! Loops over the unknowns of large systems, in tasks.

use rayon::prelude::*;

/// Unknowns of a task.
const TASK: usize = 4096;
/// Number of unknowns above which tasks are begun: that takes some microseconds.
const WORTH_TASKS: usize = if cfg!(test) { 2 * TASK } else { 5 * TASK };

/// Changes each value, given those of other arrays in the same position. Values are independent of each other, so that results do
/// not depend on the division.
#[inline]
pub(super) fn each<const N: usize>(
    values: &mut [f64],
    others: [&[f64]; N],
    change: impl Fn(&mut f64, [f64; N]) + Sync,
) {
    let of = |from: usize, values: &mut [f64]| {
        let others = others.map(|other| &other[from..from + values.len()]);
        for (i, value) in values.iter_mut().enumerate() {
            change(value, others.map(|other| other[i]));
        }
    };
    if values.len() < WORTH_TASKS {
        of(0, values);
    } else {
        values.par_chunks_mut(TASK).enumerate().for_each(|(task, values)| of(task * TASK, values));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tasks_see_the_values_in_their_position() {
        for n in [1, TASK, 3 * TASK + 17] {
            let [a, b] = [1.0, -2.0].map(|by| (0..n).map(|i| by * i as f64).collect::<Vec<_>>());
            let mut values = a.clone();
            each(&mut values, [&a, &b], |value, [a, b]| *value += a + 3.0 * b);
            assert!((0..n).all(|i| values[i] == -4.0 * i as f64));
        }
    }
}
