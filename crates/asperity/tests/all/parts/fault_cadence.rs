use asperity_plan::faults::cadence::*;
use asperity_plan::shared::words::YEAR;

const CADENCE: Cadence = Cadence {
    decades: 0.125,
    slip: 4e-3,
    longest: 1e6,
    shortest: 0.1,
    contours: [1e8, 1.0],
    fast: 1e-3,
    largest_file: 1_000_000,
};

/// Rows that are due over the steps of a history, with their rates.
fn rows(history: &[(f64, f64)], gauge: &mut Gauge, bytes: u64) -> Vec<(f64, f64)> {
    let (mut rows, mut before) = (Vec::new(), (f64::NAN, f64::NAN));
    for &(time, rate) in history {
        let due = gauge.step(&CADENCE, Reading { time, rate });
        for (due, row) in [(due.before, before), (due.now, (time, rate))] {
            if due {
                rows.push(row);
                gauge.spend(bytes, CADENCE.largest_file, time);
            }
        }
        before = (time, rate);
    }
    rows
}

#[test]
fn the_peak_of_a_short_event_has_a_row() {
    // A bump of a tenth of a decade, too small for a row by itself, with a pulse of one step on top.
    let history: Vec<(f64, f64)> = (0..1000)
        .map(|k| (f64::from(k) * 1e-4, 1e-9 * (1.0 + 0.2 * (-(f64::from(k - 500) / 50.0).powi(2)).exp())))
        .collect();
    let found = rows(&history, &mut Gauge::default(), 1);
    let peak = history.iter().map(|r| r.1).fold(0.0, f64::max);
    assert!(found.iter().any(|r| r.1 == peak), "{found:?}");
    assert!(found.len() < 5, "{found:?}");
    assert!(found.windows(2).all(|w| w[0].0 < w[1].0));
}

#[test]
fn the_largest_rate_of_the_rows_of_an_event_is_that_of_its_steps() {
    // Two events whose rates vary by a tenth of a per cent from step to step, with the largest at one step.
    let event = |from: f64, top: f64| {
        (0..4000).map(move |k| {
            let share = f64::from(k) / 2000.0 - 1.0;
            let ripple = 1.0 + 1e-3 * (0.7 * f64::from(k)).sin();
            (from + 1e-4 * f64::from(k), top * (1e-6 + (-20.0 * share * share).exp()) * ripple)
        })
    };
    let history: Vec<(f64, f64)> = event(0.0, 0.5).chain(event(10.0, 0.2)).collect();
    let largest = |all: &[(f64, f64)], from: f64| {
        all.iter().filter(|r| (from..from + 1.0).contains(&r.0)).map(|r| r.1).fold(0.0, f64::max)
    };
    // Then with rows that fill more than half of the file.
    let mut bytes = 1;
    for _ in 0..2 {
        let mut gauge = Gauge::default();
        let found = rows(&history, &mut gauge, bytes);
        for from in [0.0, 10.0] {
            assert_eq!(largest(&found, from), largest(&history, from));
        }
        assert!(found.len() < history.len() / 10, "{}", found.len());
        assert_eq!(gauge.doublings > 0, bytes > 1);
        bytes = 600_000 / found.len() as u64;
    }
}

#[test]
fn rows_follow_change_and_slip_and_not_steps() {
    let steps = |n: u32| -> Vec<(f64, f64)> {
        // 1e8 s at 1e-9 m/s, then 100 s at 0.1 m/s.
        let slow = (0..n).map(|k| (1e8 * f64::from(k) / f64::from(n), 1e-9));
        slow.chain((0..n).map(|k| (1e8 + 100.0 * f64::from(k) / f64::from(n), 0.1))).collect()
    };
    let counts = [20_000, 40_000].map(|n| rows(&steps(n), &mut Gauge::default(), 1).len());
    // One row per million seconds, then one per tenth of a second.
    for count in counts {
        assert!((950..=1150).contains(&count), "{count}");
    }
}

#[test]
fn a_file_becomes_coarser_and_never_passes_its_size() {
    let history: Vec<(f64, f64)> =
        (0..200_000).map(|k| (f64::from(k), if k % 2 == 0 { 1e-9 } else { 1e-3 })).collect();
    let mut gauge = Gauge::default();
    let found = rows(&history, &mut gauge, 100);
    assert!(gauge.bytes <= CADENCE.largest_file && gauge.doublings > 2, "{gauge:?}");
    assert_eq!(gauge.bytes, 100 * found.len() as u64);
    let warning = warning(&[GaugedFile { name: "a".into(), gauge }], CADENCE.largest_file).unwrap();
    assert!(warning.message.contains("`a` first"), "{warning}");
    let empty = GaugedFile { name: "a".into(), gauge: Gauge::default() };
    assert!(asperity_plan::faults::cadence::warning(&[empty], 1).is_none());
}

#[test]
fn slow_slip_makes_profiles_as_far_apart_as_its_slip() {
    let of = |on: f64| Cadence::new(CadenceLimits::default(), 3000.0 * YEAR, on, Some(8e-3));
    assert_eq!(of(1e-3).contours, [5.0 * YEAR, 1.0]);
    assert!((of(1e-8).contours[1] - 1e5).abs() < 1e-3);
    assert_eq!(of(1e-3).contours.map(time), ["5 yr", "1 s"]);
    assert_eq!(
        [1e5, 0.1, 0.1 * YEAR, 2e-6, 90.0].map(time),
        ["1.157 d", "0.1 s", "0.1 yr", "2.000e-6 s", "1.5 min"]
    );
    assert_eq!(of(1e-3).slip, 4e-3);
    assert_eq!((of(1e-3).longest, of(1e-3).shortest), (0.1 * YEAR, 0.1));
}
