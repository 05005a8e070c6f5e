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

/// The `most` names of `known` nearest to `name`, in their own order.
#[must_use]
pub fn closest<'a>(name: &str, known: &[&'a str], most: usize) -> Vec<&'a str> {
    let mut order: Vec<usize> = (0..known.len()).collect();
    order.sort_by_key(|&k| strsim::osa_distance(name, known[k]));
    order.truncate(most);
    order.sort_unstable();
    order.into_iter().map(|k| known[k]).collect()
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
    fn the_closest_names_keep_their_order() {
        assert_eq!(
            closest("b.csv", &["a.csv", "b.csvs", "mesh.txt", "b2.csv"], 3),
            ["a.csv", "b.csvs", "b2.csv"]
        );
        assert_eq!(closest("b", &["z", "y"], 3), ["z", "y"]);
    }

    #[test]
    fn a_name_far_from_all_is_not_corrected() {
        assert_eq!(nearest("granit", ["granite", "gouge"]), Some("granite"));
        assert_eq!(nearest("slaev", ["master", "slave"]), Some("slave"));
        assert_eq!(nearest("steel", ["granite", "gouge"]), None);
        assert_eq!(nearest("A", ["B", "C"]), None);
    }
}
