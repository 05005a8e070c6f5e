//! Entries of a table at which it must not be passed over: the corners of its course.
//!
//! Between two corners all entries lie within a tolerance of the chord. They are found in one pass. From a corner on, the slopes of
//! lines that pass every entry within the tolerance form an interval. The chord to the next entry is admissible if its slope lies in
//! it; otherwise the entry before is a corner, and the search continues from there.

use crate::table::Table;

/// Indices of the corners of the course through `(times, values)`, ascending, the first and the last entry among them. Times do
/// not decrease; both of two entries at one time, which are a jump, are corners.
#[must_use]
pub fn corners(times: &[f64], values: &[f64], tolerance: f64) -> Vec<usize> {
    let (mut found, mut from) = (vec![0], 0);
    let (mut least, mut most) = (f64::NEG_INFINITY, f64::INFINITY);
    for k in 1..times.len() {
        let jumps = times[k] == times[k - 1];
        let slope = (values[k] - values[from]) / (times[k] - times[from]);
        if jumps || slope < least || slope > most {
            (from, least, most) = (k - 1, f64::NEG_INFINITY, f64::INFINITY);
            found.push(from);
        }
        if jumps {
            from = k;
            found.push(from);
            continue;
        }
        let (run, rise) = (times[k] - times[from], values[k] - values[from]);
        least = least.max((rise - tolerance) / run);
        most = most.min((rise + tolerance) / run);
    }
    found.push(times.len() - 1);
    found.dedup();
    found
}

/// Largest difference between the lowest and the highest of these values.
#[must_use]
pub fn range(values: &[f64]) -> f64 {
    let bounds = |(low, high): (f64, f64), &v: &f64| (low.min(v), high.max(v));
    let (low, high) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), bounds);
    (high - low).max(0.0)
}

/// Times at most this share of a step from its end lie on it: rounding of decimal times.
const ON_END: f64 = 1e-6;

/// Largest departure of the entries of a course from its chords over equal steps of length `dt` from time 0 on, and the time at
/// which it is; `None` if all entries lie on ends of steps.
#[must_use]
pub fn departure(course: &Table, dt: f64) -> Option<(f64, f64)> {
    let between = |(&time, &entry): (&f64, &f64)| {
        let s = time / dt;
        let (from, share) = (s.floor(), s - s.floor());
        if !(ON_END..=1.0 - ON_END).contains(&share) {
            return None;
        }
        let (before, after) = (course.value(from * dt), course.value((from + 1.0) * dt));
        Some(((entry - ((1.0 - share) * before + share * after)).abs(), time))
    };
    course.times().iter().zip(course.values()).filter_map(between).max_by(|a, b| a.0.total_cmp(&b.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest departure of the entries from the chords between some of them.
    fn off(times: &[f64], values: &[f64], kept: &[usize]) -> f64 {
        let chord = |w: &[usize]| {
            let (a, b) = (w[0], w[1]);
            let at = |k: usize| {
                values[a] + (values[b] - values[a]) * (times[k] - times[a]) / (times[b] - times[a])
            };
            (a + 1..b).map(|k| (values[k] - at(k)).abs()).fold(0.0, f64::max)
        };
        kept.windows(2).map(chord).fold(0.0, f64::max)
    }

    #[test]
    fn a_pulse_between_long_rests_has_all_of_its_corners() {
        let (times, values) = ([0.0, 51.0, 51.2, 51.4, 100.0], [0.0, 0.0, 5e-5, 0.0, 0.0]);
        assert_eq!(corners(&times, &values, 5e-9), [0, 1, 2, 3, 4]);
    }

    #[test]
    fn entries_on_a_line_are_no_corners() {
        let times: Vec<f64> = (0..1000).map(|k| 0.1 * f64::from(k)).collect();
        let values: Vec<f64> = times.iter().map(|t| 3e-6 * t).collect();
        assert_eq!(corners(&times, &values, 3e-8), [0, 999]);
        assert_eq!(corners(&[0.0, 1.0], &[2.0, 5.0], 0.0), [0, 1]);
        assert_eq!(corners(&[4.0], &[2.0], 0.0), [0]);
    }

    #[test]
    fn both_entries_of_a_jump_are_corners() {
        let (times, values) = ([0.0, 1.0, 2.0, 2.0, 3.0, 4.0], [1.0, 1.0, 1.0, 3.0, 3.0, 3.0]);
        assert_eq!(corners(&times, &values, 1e-3), [0, 2, 3, 5]);
    }

    #[test]
    fn chords_of_a_noisy_wave_stay_within_the_tolerance_with_few_corners() {
        let times: Vec<f64> = (0..20_000).map(|k| 0.01 * f64::from(k)).collect();
        let noise = |k: usize| ((k * 7919) % 101) as f64 / 101.0 - 0.5;
        let values: Vec<f64> =
            times.iter().enumerate().map(|(k, t)| (0.3 * t).sin() + 1e-3 * noise(k)).collect();
        for (tolerance, most) in [(1e-2, 250), (3e-3, 1000)] {
            let kept = corners(&times, &values, tolerance);
            assert!(off(&times, &values, &kept) <= tolerance * (1.0 + 1e-9));
            assert!(kept.len() < most, "{tolerance}: {}", kept.len());
        }
    }

    #[test]
    fn departures_are_measured_from_the_chords_of_equal_steps() {
        let table = Table::new(vec![0.0, 4.0, 5.0, 6.0, 10.0], vec![0.0, 0.0, 1.0, 0.0, 0.0]);
        assert_eq!(departure(&table, 10.0), Some((1.0, 5.0)));
        assert_eq!(departure(&table, 1.0), None);
        assert_eq!(departure(&table, 10.0 / 3.0), Some((1.0, 5.0)));
        assert_eq!(departure(&table, 2.0), Some((1.0, 5.0)));
        // The chord from 1 at 5 s to 0 at 7.5 s.
        let (off, time) = departure(&table, 2.5).unwrap();
        assert!((off - 0.6).abs() < 1e-14 && time == 6.0, "{off} at {time}");
    }
}
