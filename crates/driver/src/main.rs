//! The `asperity` command.
// The command line is where printing belongs.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use asperity_driver::cli;
use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    faer::set_global_parallelism(faer::Par::Seq);
    match cli::execute(&cli::Arguments::parse()) {
        Ok(cli::End::Done) => ExitCode::SUCCESS,
        Ok(cli::End::Stopped(why)) => {
            eprintln!("stopped: {why}");
            ExitCode::from(2)
        }
        Ok(cli::End::Interrupted(why)) => {
            eprintln!("{why}");
            ExitCode::from(3)
        }
        Err(error) => {
            eprintln!("{error:?}");
            ExitCode::FAILURE
        }
    }
}
