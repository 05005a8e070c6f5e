//! Signals that interrupt a run in an orderly way.

use signal_hook::consts::{SIGABRT, SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
use signal_hook::flag;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Flag set by SIGINT, SIGTERM and SIGHUP. A second signal ends the program at once. SIGHUP stays ignored if the parent process set it to be ignored,
/// as `nohup` does.
pub(super) fn watched() -> std::io::Result<Arc<AtomicBool>> {
    let set = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM, SIGHUP] {
        if signal == SIGHUP && is_ignored(signal) {
            continue;
        }
        flag::register_conditional_default(signal, Arc::clone(&set))?;
        flag::register(signal, Arc::clone(&set))?;
    }
    Ok(set)
}

/// Keeps the process alive where it writes beyond the largest size of a file (`ulimit -f`): the write then fails as on a full disk.
pub(super) fn outlive_limits() -> std::io::Result<()> {
    flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false))).map(|_| ())
}

/// Ends the program with this exit code where memory cannot be had. The standard library then prints how much was asked for, and
/// aborts: a shell would report a crash.
pub(super) fn end_without_memory(code: u8) -> std::io::Result<()> {
    let always = Arc::new(AtomicBool::new(true));
    flag::register_conditional_shutdown(SIGABRT, i32::from(code), always).map(|_| ())
}

/// True if this process ignores a signal. Read from `/proc`; false where that does not exist.
fn is_ignored(signal: i32) -> bool {
    std::fs::read_to_string("/proc/self/status").is_ok_and(|status| ignored_in(&status, signal))
}

/// True if the bit of `signal` is set in `SigIgn`, whose bits count signals from 1.
pub fn ignored_in(status: &str, signal: i32) -> bool {
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}
