//! Laws of the table with the usual parameters of their rows.

use asperity_friction::evolution::{Common, Parameter, TableEvolution};

/// Value of the example of a parameter in SI.
fn example(parameter: &Parameter) -> f64 {
    let mut words = parameter.example.trim_matches('"').split(' ');
    let value: f64 = words.next().unwrap().parse().unwrap();
    match words.next() {
        None | Some("m/s") => value,
        Some("mm/s") => 1e-3 * value,
        Some(unit) => panic!("no unit {unit}"),
    }
}

/// The law with these common parameters, without its optional ones.
pub fn usual<E: TableEvolution>(common: Common) -> E {
    let own = E::DEFINITION.parameters.iter().map(|p| (!p.optional).then(|| example(p)));
    E::build(&common, &own.collect::<Vec<_>>()).unwrap()
}
