use asperity_driver::difference::*;

fn table(text: &str) -> Table {
    Table::read(text.as_bytes()).unwrap()
}

fn columns(a: &str, b: &str) -> (Vec<Difference>, bool) {
    match compare(&table(a), &table(b)) {
        Compared::Columns(columns, interpolated) => (columns, interpolated),
        Compared::Other(why) => panic!("{why}"),
    }
}

#[test]
fn the_largest_difference_is_that_of_the_column_over_its_largest_value() {
    let (found, _) = columns("t,v\n0,1\n1,4\n", "t,v\n0,1\n1,5\n");
    assert_eq!(found.len(), 1);
    assert_eq!(
        (found[0].name.as_str(), found[0].largest, found[0].relative, found[0].row),
        ("v", 1.0, 0.2, 2)
    );
    assert!(columns("t,v\n0,NaN\n", "t,v\n0,NaN\n").0.is_empty());
    assert!(columns("t,v\n0,NaN\n", "t,v\n0,1\n").0[0].largest.is_infinite());
    assert!(columns("t,v\n0,a\n", "t,v\n0,b\n").0[0].relative.is_infinite());
}

#[test]
fn rows_at_other_times_are_interpolated() {
    let (found, interpolated) = columns("time [s],v\n0,0\n2,4\n", "time [s],v\n0,0\n1,2\n2,4\n");
    assert!(interpolated && found.is_empty(), "{found:?}");
    let (found, _) = columns("time [s],v\n0,0\n2,4\n", "time [s],v\n0,0\n1,3\n");
    assert_eq!(found[0].largest, 1.0);
    let other = compare(&table("x,v\n0,0\n"), &table("x,v\n0,0\n1,0\n"));
    assert_eq!(other, Compared::Other("they have 1 and 2 rows".into()));
    assert!(matches!(compare(&table("x\n0\n"), &table("y\n0\n")), Compared::Other(_)));
}
