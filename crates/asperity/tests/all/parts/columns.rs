use asperity_plan::reading::columns::Columns;
use asperity_plan::reading::scene::units::Dimension;

#[test]
fn numbers_with_units_are_those_of_scenes() {
    let columns = Columns::parse(b"# slip\nx [km], a\n25, 0.01\n 0.1,2e-2\n").unwrap();
    assert_eq!(columns.numbers("x", Some(Dimension::Length)).unwrap(), [25e3, 100.0]);
    assert_eq!(columns.numbers("a", None).unwrap(), [0.01, 0.02]);
    assert_eq!(columns.line(0), 3);
}

#[test]
fn what_is_wrong_names_its_line_and_column() {
    let wrong = |text: &str, name: &str, dimension| match Columns::parse(text.as_bytes()) {
        Ok(columns) => columns.numbers(name, dimension).unwrap_err().message,
        Err(wrong) => wrong.message,
    };
    let length = Some(Dimension::Length);
    assert_eq!(wrong("x [km]\n1\nNaN\n", "x", length), "line 3: `NaN` in column `x` is not a finite number");
    assert_eq!(wrong("x\n1\n", "x", length), "its column `x` has no unit, and is a length");
    assert_eq!(
        wrong("a [MPa]\n1\n", "a", None),
        "its column `a` has the unit MPa, and is a number without a unit"
    );
    assert_eq!(wrong("x [km],a\n1\n", "a", None), "line 2 has 1 cells, and 2 columns have names");
    assert_eq!(wrong("1,2\n3,4\n", "a", None), "its first line has `1` instead of the name of a column");
    assert_eq!(wrong("x [km]\n", "x", length), "it has no rows below the names of its columns");
    assert_eq!(wrong("", "x", length), "it is empty");
    assert_eq!(wrong("x [km];a\n1;2\n", "x", length), "its columns are separated by semicolons");
    assert_eq!(wrong("x [km]\ta\n1\t2\n", "x", length), "its columns are separated by tabs");
    assert!(wrong("x [MPa]\n1\n", "x", length).starts_with("the unit of its column `x`: expected a length"));
}
