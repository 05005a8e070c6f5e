//! A name means one thing: columns of the same file and name, and arrays of the same name, have the same unit, sign and
//! number of components in every kind of run.

use crate::common::every_kind::{KINDS, files};
use crate::common::written::ColumnDescription;
use std::collections::{BTreeMap, BTreeSet};

/// Units of one quantity in space, and per metre of thickness in the plane.
const PER_LENGTH: [[&str; 2]; 4] = [["N", "N/m"], ["J", "J/m"], ["N m", "N"], ["N m/s", "N/s"]];

/// Arrays that are vectors with mass, and magnitudes beside `NAME_vector` in other kinds: files of either are of use as they are.
const VECTORS_WITH_MASS: [&str; 3] = ["shear_traction", "slip", "slip_rate"];

fn same(one: &str, other: &str) -> bool {
    one == other || PER_LENGTH.iter().any(|pair| pair.contains(&one) && pair.contains(&other))
}

#[test]
fn columns_and_arrays_of_one_name_are_the_same_in_every_kind_of_run() {
    let mut all: BTreeMap<(String, &str), (&str, &ColumnDescription)> = BTreeMap::new();
    let (mut shared, mut apart) = (0, BTreeSet::new());
    for kind in KINDS {
        for own in files(kind) {
            // Files of fields bear the names of faults and interfaces.
            let places = if own.array.is_some() { vec!["fields".to_owned()] } else { own.files.clone() };
            for place in places {
                let column = own.column.as_str();
                let &mut (of, first) = all.entry((place.clone(), column)).or_insert((kind, own));
                shared += usize::from(of != kind);
                let components = |d: &ColumnDescription| d.array.as_ref().map(|(components, _)| *components);
                if components(own) != components(first) {
                    apart.insert((column, of, kind));
                    continue;
                }
                assert!(
                    same(&own.unit, &first.unit) && own.sign == first.sign,
                    "`{column}` of {place}: {kind} {own:?}, {of} {first:?}"
                );
            }
        }
    }
    assert!(shared > 30, "only {shared} columns and arrays are of several kinds");
    assert_eq!(apart, VECTORS_WITH_MASS.map(|name| (name, "bodies", "dynamics")).into());
}
