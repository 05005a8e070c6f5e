//! Sources of the benchmarks that others can enter.

/// Benchmarks, and the keys of their own entry and of what they rest on.
const BENCHMARKS: [(&str, &[&str]); 6] = [
    ("sandwich/v1", &["asperity-sandwich-v1", "xing2002b", "rice1996"]),
    ("sandwich-state/v1", &["asperity-sandwich-state-v1", "dieterich1979", "rice1993"]),
    ("fault-bend/v1", &["asperity-fault-bend-v1", "hirth1982"]),
    ("hertz/v1", &["asperity-hertz-v1", "hertz1882", "johnson1985"]),
    ("partial-slip/v1", &["asperity-partial-slip-v1", "cattaneo1938", "mindlin1949", "mindlin1953"]),
    ("seas-bp1-quick/v1", &["asperity-seas-bp1-quick-v1", "erickson2020", "dieterich1979"]),
];

/// Names of the benchmarks.
pub fn names() -> impl Iterator<Item = &'static str> {
    BENCHMARKS.iter().map(|row| row.0)
}

/// Keys of a benchmark; `None` if there is no such benchmark.
#[must_use]
pub fn keys(name: &str) -> Option<&'static [&'static str]> {
    BENCHMARKS.iter().find(|row| row.0 == name).map(|row| row.1)
}
