//! Suggestions for misspelled names: the nearest existing name.

/// Name of `known` nearest to `name` by insertions, deletions, substitutions and transpositions of neighbours. `None` unless it
/// is near enough to have been meant.
#[must_use]
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let lower = name.to_lowercase();
    known
        .into_iter()
        .map(|k| (strsim::osa_distance(&lower, &k.to_lowercase()), k))
        .min_by_key(|(d, _)| *d)
        .filter(|(d, k)| {
            let shorter = k.chars().count().min(name.chars().count());
            *d < shorter && *d <= 1 + shorter / 4
        })
        .map(|(_, k)| k)
}

/// "did you mean `x`? the sets are x, y, z".
#[must_use]
pub fn suggest<'a>(name: &str, what: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    let list = match known[..] {
        [] => format!("there are no {what}"),
        [only] => format!("of the {what} there is only {only}"),
        _ => format!("the {what} are {}", known.join(", ")),
    };
    match nearest(name, known.iter().copied()) {
        Some(meant) => format!("did you mean `{meant}`? {list}"),
        None => list,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_far_from_all_is_not_corrected() {
        assert_eq!(nearest("granit", ["granite", "gouge"]), Some("granite"));
        assert_eq!(nearest("slaev", ["master", "slave"]), Some("slave"));
        assert_eq!(nearest("steel", ["granite", "gouge"]), None);
        assert_eq!(nearest("A", ["B", "C"]), None);
    }
}
