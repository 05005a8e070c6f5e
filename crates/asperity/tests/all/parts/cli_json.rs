use asperity::cli::json::*;
use serde_json::json;

#[test]
fn json_is_that_of_the_library_but_for_the_sign_of_zero() {
    let value = json!({ "a": [1.5, -2e-30, {}, []], "b": { "c": null, "d": [[0.0], "-0.0"] } });
    assert_eq!(pretty(&value).unwrap(), serde_json::to_string_pretty(&value).unwrap());
    assert_eq!(pretty(&[-0.0]).unwrap(), "[\n  0.0\n]");
    assert_eq!(pretty(&f64::NAN).unwrap(), "null");
}
