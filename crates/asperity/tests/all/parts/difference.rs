use asperity_reference::difference::*;

fn table(text: &str) -> Table {
    Table::read(text.as_bytes()).unwrap()
}

fn columns(a: &str, b: &str) -> (Vec<Difference>, Overlap) {
    match compare(&table(a), &table(b)) {
        TableComparison::Columns(columns, overlap) => (columns, overlap),
        TableComparison::Other(why) => panic!("{why}"),
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
fn a_component_is_measured_by_its_whole_vector() {
    let (found, _) =
        columns("t,force_x,force_z,v_z\n0,4,1e-9,1e-9\n", "t,force_x,force_z,v_z\n0,4,-1e-9,-1e-9\n");
    let relative: Vec<(&str, f64)> = found.iter().map(|d| (d.name.as_str(), d.relative)).collect();
    assert_eq!(relative, [("force_z", 5e-10), ("v_z", 2.0)]);
}

#[test]
fn rows_at_other_times_are_interpolated() {
    let (found, overlap) = columns("time [s],v\n0,0\n2,4\n", "time [s],v\n0,0\n1,2\n2,4\n");
    assert!(overlap.interpolated && found.is_empty(), "{found:?}");
    let (found, _) = columns("time [s],v\n0,0\n2,4\n", "time [s],v\n0,0\n1,3\n");
    assert_eq!(found[0].largest, 1.0);
    let other = compare(&table("x,v\n0,0\n"), &table("x,v\n0,0\n1,0\n"));
    assert_eq!(other, TableComparison::Other("they have 1 and 2 rows".into()));
    assert!(matches!(compare(&table("x\n0\n"), &table("y\n0\n")), TableComparison::Other(_)));
}

#[test]
fn what_two_tables_share_is_counted_and_judged() {
    let rows = |times: std::ops::Range<u32>, shift: f64| {
        let row = |k: u32| format!("{:e},{k}\n", f64::from(k) + shift);
        format!("time [s],v\n{}", times.map(row).collect::<String>())
    };
    let overlap = |a: &str, b: &str| columns(a, b).1;
    let all = rows(0..247, 0.0);
    let few = overlap(&all, &rows(0..10, 0.0));
    assert_eq!((few.rows, few.of, few.suffices(1e-6)), (10, 247, false));
    assert!((few.share - 9.0 / 246.0).abs() < 1e-15);
    let apart = overlap(&all, &rows(0..247, 1e12));
    assert_eq!((apart.rows, apart.share, apart.suffices(0.5)), (0, 0.0, false));
    assert!(!overlap(&all, "time [s],v\n").suffices(1e-6));
    assert!(!overlap("time [s],v\n", &all).suffices(1e-6));
    assert!(overlap("time [s],v\n", "time [s],v\n").suffices(1e-6));
    // Few rows over all of the time leave most of the other table without anything beside it.
    let thin = overlap(&all, "time [s],v\n0,0\n123,123\n246,246\n");
    assert_eq!((thin.share, thin.suffices(1e-6)), (1.0, false));
    // A row that was asked for at a time and is missing is missing.
    assert!(!overlap(&all, &rows(0..246, 0.0)).suffices(1e-6));
    // Adaptive steps end anywhere within the interval of their rows.
    let near = overlap(&all, &rows(0..246, 0.4));
    assert!(near.rows == 246 && near.share < 1.0 && near.suffices(1e-6), "{near:?}");
    assert!(!overlap(&all, &rows(0..244, 0.4)).suffices(1e-6));
}

#[test]
fn stages_and_steps_are_compared_exactly_and_never_interpolated() {
    let a = "time [s],stage,step,v\n0,0,0,0\n1,0,1,1\n2,1,2,2\n";
    assert!(columns(a, "time [s],stage,step,v\n0,0,0,0\n0.5,0,1,0.5\n1.5,1,2,1.5\n2,1,3,2\n").0.is_empty());
    let (found, _) = columns(a, "time [s],stage,step,v\n0,0,0,0\n0.5,1,1,0.5\n2,1,2,2\n");
    assert_eq!((found.len(), found[0].name.as_str(), found[0].row), (1, "stage", 2));
    let (found, _) = columns(a, "time [s],stage,step,v\n0,0,0,0\n1,0,3,1\n2,1,2,2\n");
    assert_eq!((found.len(), found[0].name.as_str(), found[0].within(1e3)), (1, "step", false));
    // The length of a step is measured.
    assert!(columns("time [s],step [s]\n0,1\n2,3\n", "time [s],step [s]\n0,1\n1,2\n2,3\n").0.is_empty());
}

#[test]
fn rows_at_one_time_are_those_before_and_after_a_jump() {
    let jump = "time [s],v\n0,0\n1,0\n1,5\n2,5\n";
    assert!(columns(jump, "time [s],v\n0,0\n0.5,0\n1,0\n1,5\n2,5\n").0.is_empty());
    assert_eq!(columns(jump, "time [s],v\n0,0\n0.5,0\n1,0\n1,4\n2,5\n").0[0].largest, 1.0);
}

#[test]
fn stations_and_models_of_finite_faults_are_tables() {
    let station = table("# problem=p\n# Column #1 = Time (s)\nt slip_rate\n0.0e0 -9.5\n1.0e0 -8.5\n");
    assert_eq!((station.names, station.rows), (vec!["t".to_string(), "slip_rate".to_string()], 2));
    let model = table("% LAT LON\n  1.0   2.0\n\n% SEGMENT\n  3.0   4.0\n");
    assert_eq!(model.columns, [Column::Numbers(vec![1.0, 3.0]), Column::Numbers(vec![2.0, 4.0])]);
    assert!(Table::read(b"t slip\n0 1\n2\n").unwrap_err().to_string().contains("line 3 has 1 entries"));
}
