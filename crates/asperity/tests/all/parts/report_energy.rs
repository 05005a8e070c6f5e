use asperity_cycles::Energy;
use asperity_mechanics::dynamics::Budget;
use asperity_run::EnergyTable;

fn doubted(table: &EnergyTable) -> Option<String> {
    table.doubt("steps are long", "take shorter ones").map(|warning| warning.message)
}

#[test]
fn budgets_that_miss_a_tenth_are_warned_of_and_those_that_close_are_not() {
    let faults = |friction: f64| {
        EnergyTable::new("J", &Energy { loads: 10.0, elastic: 4.0, friction, ..Energy::default() }.energies())
    };
    assert_eq!(doubted(&faults(5.99)), None);
    let expected = "the energy budget misses 0.10 of its largest part: steps are long";
    assert_eq!(doubted(&faults(5.0)).as_deref(), Some(expected));
    let waves = |absorbed: f64| {
        EnergyTable::new("J", &Budget { loads: 10.0, kinetic: 4.0, absorbed, ..Budget::default() }.energies())
    };
    assert_eq!(doubted(&waves(6.0)), None);
    assert_eq!(doubted(&waves(5.0)).as_deref(), Some(expected));
}

#[test]
fn parts_are_found_by_their_names_and_shown_without_those_that_are_zero_or_rounding() {
    let energy = Energy { loads: 10.0, elastic: 4.0, friction: 6.0, ..Energy::default() };
    let table = EnergyTable::new("J/m", &energy.energies());
    assert_eq!([table.part("loads"), table.part("friction"), table.part("kinetic")], [10.0, 6.0, 0.0]);
    let text = "energy [J/m]: given loads 1.000000e1; kept elastic 4.000000e0; lost friction 6.000000e0; \
                closes to 0.0e0 of the largest";
    assert_eq!(table.text(), text);
    let rounded = Energy { radiated: 1e-13, kinetic: 1e-9, ..energy };
    let text = EnergyTable::new("J/m", &rounded.energies()).text();
    assert!(text.contains("kinetic 1.000000e-9") && !text.contains("radiated"), "{text}");
    let none = EnergyTable::new("J", &Energy::default().energies()).text();
    assert_eq!(none, "energy [J]: none was given, kept or lost");
}
