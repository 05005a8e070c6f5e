use asperity_verification::report::mathml::html_of;

#[test]
fn formulas_become_mathml_and_what_is_no_formula_stays_as_text() {
    let html = html_of("The pressure is $p = p_0 \\sqrt{1 - x^2/a^2}$.");
    assert!(html.contains("<math") && html.contains("<msqrt>") && !html.contains('$'), "{html}");
    let broken = html_of("$\\nosuchmacro x$");
    assert!(broken.contains("<code>"), "{broken}");
    assert!(!html_of("no formula").contains("<math"));
}

#[test]
fn formulas_of_all_cases_can_be_read() {
    for case in asperity_verification::cases::ALL {
        let html = html_of(case.readme);
        assert!(!html.contains("<code>\\") && !html.contains("<merror"), "{}", case.name);
    }
}
