//! The commands `completions` and `man`, from the definition of the arguments.

use super::arguments::Arguments;
use super::end::End;
use asperity_output::terminal::printing::out;
use clap::CommandFactory;
use clap_complete::Shell;
use clap_mangen::Man;
use miette::IntoDiagnostic;

/// Prints the script of a shell.
pub(super) fn completions(shell: Shell) -> End {
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "asperity", &mut text);
    out(format_args!("{}", String::from_utf8_lossy(&text)));
    End::Done
}

/// Prints the page of the program, followed by those of its commands.
pub(super) fn man() -> miette::Result<End> {
    let mut program = Arguments::command().disable_help_subcommand(true);
    program.build();
    let mut text = Vec::new();
    Man::new(program.clone()).render(&mut text).into_diagnostic()?;
    for command in program.get_subcommands() {
        let page = Man::new(command.clone());
        page.render_name_section(&mut text).into_diagnostic()?;
        page.render_synopsis_section(&mut text).into_diagnostic()?;
        page.render_options_section(&mut text).into_diagnostic()?;
    }
    out(format_args!("{}", String::from_utf8_lossy(&text)));
    Ok(End::Done)
}
