//! The `asperity` command.

use asperity::cli;
use asperity_output::terminal::printing;
use clap::Parser;
use std::fmt::Write;
use std::process::ExitCode;

fn main() -> ExitCode {
    faer::set_global_parallelism(faer::Par::Seq);
    match cli::execute(&cli::Arguments::parse()) {
        Ok(end) => {
            match &end {
                cli::End::Done | cli::End::Differs => {}
                cli::End::Doubtful(n) => {
                    let warnings = if *n == 1 { "1 warning".into() } else { format!("{n} warnings") };
                    printing::err(format_args!("{warnings}, and `--strict` accepts none\n"));
                }
                cli::End::Unreadable(why) => printing::err(format_args!("error: {why}\n")),
                cli::End::Stopped(why) => printing::err(format_args!("stopped: {why}\n")),
                cli::End::Interrupted(why) => printing::err(format_args!("{why}\n")),
            }
            ExitCode::from(end.code())
        }
        Err(error) => {
            printing::err(format_args!("{}\n", rendered(&error)));
            ExitCode::FAILURE
        }
    }
}

/// An error as shown to the user; the bare message if rendering fails.
fn rendered(error: &miette::Report) -> String {
    let mut text = String::new();
    if write!(text, "{error:?}").is_ok() { text } else { error.to_string() }
}
