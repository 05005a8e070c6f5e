//! Memory of this process, from `/proc`; unknown where that does not exist.

/// Memory in use \[bytes\].
#[must_use]
pub fn now() -> Option<usize> {
    read("VmRSS:")
}

/// Largest memory in use so far \[bytes\].
#[must_use]
pub fn most() -> Option<usize> {
    read("VmHWM:")
}

/// Address space that this process may still take under the limit of its shell (`ulimit -v`) \[bytes\]; `None` without limit.
#[must_use]
pub fn addresses_left() -> Option<usize> {
    let limits = std::fs::read_to_string("/proc/self/limits").ok()?;
    let line = limits.lines().find_map(|line| line.strip_prefix("Max address space"))?;
    let limit = line.split_whitespace().next()?.parse::<usize>().ok()?;
    Some(limit.saturating_sub(read("VmSize:")?))
}

fn read(key: &str) -> Option<usize> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(key))?;
    Some(line.split_whitespace().next()?.parse::<usize>().ok()? * 1024)
}
