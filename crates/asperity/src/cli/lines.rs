//! Output of a run for programs: lines of JSON, and warnings alone.

use super::arguments::{Running, Set};
use super::directory::Directory;
use super::end::End;
use super::read::Ready;
use asperity_output::terminal::printing::{self, Form};
use asperity_plan::shared::setup::Setups;
use miette::{IntoDiagnostic, JSONReportHandler, WrapErr};
use serde::Serialize;
use serde_json::{Value, json};

/// Stack of a thread \[bytes\]: that of the main thread on Linux, since runs take place in threads of the pool.
const STACK: usize = 8 << 20;

/// Sets the form of the output and the number of threads.
pub(super) fn prepare(running: &Running) -> miette::Result<()> {
    printing::set_form(match (running.quiet, running.json) {
        (true, _) => Form::Quiet,
        (_, true) => Form::Json,
        _ => Form::Plain,
    });
    // Zero is as many as there are processors.
    let threads = running.threads.map_or(0, usize::from);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK).build_global();
    if running.threads.is_none() {
        // Where a pool exists already, it serves as well.
        return Ok(());
    }
    pool.into_diagnostic().wrap_err_with(|| format!("cannot begin {threads} threads"))
}

/// Prints the values set beside the scene, which the plan contains.
pub(super) fn settings(set: &Set) {
    for setting in &set.values {
        printing::out(format_args!("--set {setting}\n"));
    }
}

/// The line at the beginning.
pub(super) fn begin(directory: &Directory) {
    let begin = directory.begin();
    printing::line(
        "begin",
        &json!({
            "title": begin.title,
            "kind": begin.kind,
            "scene": begin.origin.scene,
            "set": begin.origin.set,
            "scene_sha256": begin.hash,
            "out": directory.path(),
            "threads": rayon::current_num_threads(),
            "started": begin.origin.started,
        }),
    );
}

/// The line after planning, and the warnings of the plan. The plan itself shows them in the plain form.
pub(super) fn planned(ready: &mut Ready) {
    printing::line("planned", &json!({ "seconds": ready.seconds }));
    if printing::form() != Form::Plain {
        for warning in ready.plan.warnings_mut() {
            printing::warning(&warning.to_string());
        }
    }
}

/// The parts of the set-up that were read or written, which the report has from now on, and warnings about their files.
pub(super) fn kept(directory: &mut Directory, setups: Setups) {
    let (kept, warnings) = setups.finish();
    for part in &kept {
        printing::out(format_args!("  set-up    {part}\n"));
        printing::line("setup", part);
    }
    warnings.iter().for_each(|warning| printing::warning(warning));
    directory.keeps(kept);
}

/// The lines of a catalogue.
pub(super) fn events(catalogue: &[impl Serialize]) {
    for event in catalogue {
        printing::line("event", event);
    }
}

/// The line at the end.
pub(super) fn end(ended: &miette::Result<End>) {
    let (status, code, reason, diagnostic) = match ended {
        Ok(End::Done) => ("completed", 0, None, Value::Null),
        Ok(end @ (End::Stopped(why) | End::Unreadable(why))) => {
            ("stopped", end.code(), Some(why.clone()), Value::Null)
        }
        Ok(end @ End::Interrupted(why)) => ("interrupted", end.code(), Some(why.clone()), Value::Null),
        Ok(end @ End::Differs) => ("differs", end.code(), None, Value::Null),
        Ok(end @ End::Doubtful(_)) => ("doubtful", end.code(), None, Value::Null),
        Err(error) => ("failed", 1, Some(error.to_string()), diagnostic(error)),
    };
    printing::line(
        "end",
        &json!({ "status": status, "code": code, "reason": reason, "diagnostic": diagnostic }),
    );
}

/// An error with its positions.
fn diagnostic(error: &miette::Report) -> Value {
    let mut text = String::new();
    let rendered = JSONReportHandler::new().render_report(&mut text, error.as_ref());
    rendered.ok().and_then(|()| serde_json::from_str(&text).ok()).unwrap_or(Value::Null)
}
