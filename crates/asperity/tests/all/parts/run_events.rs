use asperity::kinds::bodies::events::*;
use asperity_cycles::Thresholds;
use asperity_plan::bodies::EventPlan;
use asperity_run::ALL;

/// A point whose rate is exp(t) times 1e-6 m/s for 20 s and falls again likewise, in steps of `dt`.
fn hill(dt: f64) -> Events {
    let thresholds = Thresholds { on: 1e-3, off: 1e-4 };
    let plan = EventPlan {
        thresholds,
        stop_after: None,
        interfaces: vec![0],
        points: std::iter::once(0..1).collect(),
        ground: Vec::new(),
        whole: false,
    };
    let rate = |t: f64| 1e-6 * (if t <= 20.0 { t } else { 40.0 - t }).exp();
    let slip = |t: f64| if t <= 20.0 { rate(t) - 1e-6 } else { 2.0 * rate(20.0) - rate(t) - 1e-6 };
    let at = |t: f64| Moment { time: t, rate: vec![rate(t)], slip: vec![slip(t)], shear: vec![-t] };
    let mut events = Events::new(&plan);
    let steps = (40.0 / dt).round() as usize;
    for k in 0..steps {
        events.step(&at(k as f64 * dt), &at((k + 1) as f64 * dt));
    }
    events
}

#[test]
fn an_event_is_located_within_steps() {
    for dt in [0.01, 0.7, 2.0] {
        let events = hill(40.0 / (40.0_f64 / dt / 2.0).round() / 2.0);
        let [event] = events.catalogue.ended(ALL) else { panic!("one event") };
        let (onset, end) = (1e3_f64.ln(), 40.0 - 1e2_f64.ln());
        assert!((event.onset.seconds() - onset).abs() < 1e-9, "{dt}: {event:?}");
        assert!((event.end.unwrap().seconds() - end).abs() < 1e-9, "{dt}");
        assert!((event.peak / (1e-6 * 20.0_f64.exp()) - 1.0).abs() < 1e-12);
        assert!((event.details.above - (40.0 - 2.0 * onset)).abs() < 1e-9);
        let slip = 2e-6 * 20.0_f64.exp() - 1e-4 - 1e-3;
        assert!((event.details.slip.all()[0] / slip - 1.0).abs() < 1e-9);
        assert!((event.details.drop.all()[0] - (end - onset)).abs() < 1e-9);
    }
}

#[test]
fn a_threshold_outside_a_step_is_passed_at_its_end() {
    for (from, to, expected) in [(2.0, 3.0, 0.0), (0.1, 0.5, 1.0), (0.0, 2.0, 1.0)] {
        let share = Share::new(1.0, from, to);
        assert_eq!((share.time, share.slip), (expected, expected), "{from} {to}");
    }
}

/// A point creeps at 0.05 mm/s while another one accelerates, and is the only one that ever reaches the threshold.
#[test]
fn an_event_begins_at_the_point_that_passes_the_threshold() {
    let plan = EventPlan {
        thresholds: Thresholds { on: 1e-3, off: 1e-4 },
        stop_after: None,
        interfaces: vec![0],
        points: std::iter::once(0..2).collect(),
        ground: Vec::new(),
        whole: false,
    };
    let at = |t: f64| Moment {
        time: t,
        rate: vec![5e-5, 1e-7 * t.exp()],
        slip: vec![0.0; 2],
        shear: vec![0.0; 2],
    };
    let mut events = Events::new(&plan);
    // From 3e-5 m/s to 1.6e-3 m/s: the first point is the fastest when the step begins.
    events.step(&at(5.7), &at(9.7));
    assert_eq!(events.catalogue.under_way(ALL).unwrap().details.hypocentre, 1);
}
