use asperity_reference::cite::*;

#[test]
fn a_reference_stands_once_with_all_its_reasons() {
    let mut citations = Citations::default();
    for reason in ["fault `a`", "fault `b`", "fault `a`"] {
        citations.add("dieterich1979", reason);
    }
    assert_eq!(citations.list().len(), 2);
    assert_eq!(citations.list()[1].reasons, ["fault `a`", "fault `b`"]);
    let text = citations.bibtex();
    assert_eq!(text.matches("@article{dieterich1979,").count(), 1);
    assert!(text.contains("% fault `a`\n% fault `b`\n@article{dieterich1979,"), "{text}");
}

#[test]
fn all_keys_in_the_sources_are_in_the_table_and_the_table_has_no_other() {
    let cited: Vec<&str> = cases::names()
        .flat_map(|name| keys(name).unwrap())
        .copied()
        .chain(laws::KEYS.iter().copied())
        .chain(scene::KEYS.iter().copied())
        .chain(titles::keys())
        .chain(benchmarks::names().flat_map(|name| benchmarks::keys(name).unwrap()).copied())
        .chain([PROGRAM])
        .collect();
    for key in &cited {
        assert!(reference(key).is_some(), "no reference `{key}`");
    }
    for reference in references() {
        assert!(cited.contains(&reference.key), "`{}` is never cited", reference.key);
    }
}
