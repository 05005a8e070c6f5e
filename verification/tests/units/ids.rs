use asperity_verification::report::ids::{LONGEST, slug};

#[test]
fn slugs_are_short_and_tell_long_texts_apart() {
    assert_eq!(slug("mean normal stress, h = 1.25 mm"), "mean-normal-stress-h-1-25-mm");
    let long = "x ".repeat(90);
    let (a, b) = (slug(&format!("{long}a")), slug(&format!("{long}b")));
    assert!(a != b && a.len() == LONGEST && b.len() == LONGEST);
    assert_eq!(slug("‖u‖"), "u");
    assert_eq!(slug("—"), "claim");
}
