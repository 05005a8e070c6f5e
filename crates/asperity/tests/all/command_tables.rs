//! Tables of options on the page of commands, which are generated from the definition of the arguments.
#![allow(clippy::disallowed_methods)]

use asperity::cli::Arguments;
use clap::{Arg, ArgAction, Command, CommandFactory};
use std::fs;
use std::path::Path;

const BEGIN: &str = "<!-- options ";
const END: &str = "<!-- end -->";

/// An argument as it is typed.
fn typed(argument: &Arg) -> String {
    let name = argument.get_value_names().unwrap_or_default().join(" ");
    let takes = matches!(argument.get_action(), ArgAction::Set | ArgAction::Append);
    match argument.get_long() {
        Some(long) if takes => format!("--{long} {name}"),
        Some(long) => format!("--{long}"),
        None if argument.is_required_set() => name,
        None => format!("[{name}]"),
    }
}

/// Table of the arguments of a command.
fn table(command: &Command) -> String {
    let mut text = String::from("| argument | |\n|---|---|\n");
    for argument in command.get_arguments().filter(|a| a.get_id() != "help" && a.get_id() != "version") {
        let help = argument.get_help().map(ToString::to_string).unwrap_or_default();
        let help = help.trim_end_matches('.').split('|').collect::<Vec<_>>().join("\\|");
        let values = argument.get_possible_values();
        let values: Vec<_> = values.iter().map(|v| format!("`{}`", v.get_name())).collect();
        let values = if values.is_empty() || !argument.get_action().takes_values() {
            String::new()
        } else {
            format!(": {}", values.join(", "))
        };
        let usual: Vec<_> = argument.get_default_values().iter().map(|v| v.to_string_lossy()).collect();
        let usual = match usual[..] {
            [] => String::new(),
            _ if !argument.get_action().takes_values() => String::new(),
            _ => format!("; default \"{}\"", usual.join(" ")),
        };
        let name = typed(argument).split('|').collect::<Vec<_>>().join("\\|");
        text += &format!("| `{name}` | {help}{values}{usual} |\n");
    }
    text
}

#[test]
fn the_page_of_commands_has_the_options_of_the_program() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/commands.md");
    let text = fs::read_to_string(&path).unwrap();
    let program = Arguments::command();
    let mut parts = text.split(BEGIN);
    let mut page = parts.next().unwrap().to_string();
    let mut seen = Vec::new();
    for part in parts {
        let (name, rest) = part.split_once(" -->").unwrap();
        let (_, tail) = rest.split_once(END).unwrap();
        let command = program.find_subcommand(name).unwrap_or_else(|| panic!("there is no command {name}"));
        page += &format!("{BEGIN}{name} -->\n{}{END}{tail}", table(command));
        seen.push(name.to_string());
    }
    let without = |command: &&Command| command.get_arguments().all(|a| a.get_id() == "help");
    for command in program.get_subcommands().filter(|c| !without(c)) {
        assert!(seen.iter().any(|name| name == command.get_name()), "{} has no table", command.get_name());
    }
    if std::env::var_os("UPDATE_TABLES").is_some() {
        fs::write(&path, &page).unwrap();
    }
    let now = fs::read_to_string(&path).unwrap();
    assert!(now == page, "a table of {} is stale: run the test with UPDATE_TABLES=1", path.display());
}
