use asperity::kinds::dynamics::arrivals::*;
use asperity_friction::points::Components;

#[test]
fn the_time_lies_where_the_rate_crosses_the_threshold() {
    let mut arrivals = Arrivals::new(2);
    for (time, rates) in [(0.0, [0.0, 2.0]), (1.0, [0.5, 0.0]), (2.0, [2.5, 0.0]), (3.0, [0.0, 9.0])] {
        arrivals.see(time, &Components::new(rates.to_vec(), 2), 1.0);
    }
    assert_eq!(arrivals.times, [Some(1.25), Some(0.0)]);
    assert_eq!(arrivals.fastest, [2.5, 9.0]);
}

#[test]
fn the_rate_of_a_vector_is_its_magnitude() {
    let mut arrivals = Arrivals::new(1);
    arrivals.see(1.0, &Components::new(vec![3.0, 4.0], 1), 5.1);
    assert_eq!((arrivals.times[0], arrivals.fastest[0]), (None, 5.0));
}
