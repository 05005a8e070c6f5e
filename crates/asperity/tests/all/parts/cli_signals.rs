use asperity::cli::signals::*;
use signal_hook::consts::SIGHUP;
use signal_hook::consts::SIGTERM;

#[test]
fn an_ignored_signal_is_read_from_its_bit() {
    let status = |mask: &str| format!("Name:\tasperity\nSigIgn:\t{mask}\nSigCgt:\tffffffffffffffff\n");
    assert!(ignored_in(&status("0000000000000001"), SIGHUP));
    assert!(ignored_in(&status("0000000000001001"), SIGHUP));
    assert!(!ignored_in(&status("0000000000001000"), SIGHUP));
    assert!(ignored_in(&status("0000000000004000"), SIGTERM));
    assert!(!ignored_in("", SIGHUP));
}
