//! Markdown with formulas between dollar signs, typeset as MathML, which browsers render without a script.

use super::page::escape;
use pulldown_cmark::{CowStr, Event, Options, Parser, html};
use pulldown_latex::config::DisplayMode;
use pulldown_latex::{Parser as Formula, RenderConfig, Storage, push_mathml};

/// HTML of a Markdown text.
pub fn html_of(markdown: &str) -> String {
    let options = Options::ENABLE_TABLES | Options::ENABLE_MATH;
    let mut out = String::new();
    html::push_html(&mut out, Parser::new_ext(markdown, options).map(typeset));
    out
}

fn typeset(event: Event<'_>) -> Event<'_> {
    match event {
        Event::InlineMath(text) => Event::InlineHtml(CowStr::from(formula(&text, DisplayMode::Inline))),
        Event::DisplayMath(text) => Event::InlineHtml(CowStr::from(formula(&text, DisplayMode::Block))),
        other => other,
    }
}

/// MathML of a formula, or its text if it cannot be parsed.
fn formula(text: &str, display_mode: DisplayMode) -> String {
    let storage = Storage::new();
    let events: Vec<_> = Formula::new(text, &storage).collect();
    let mut out = String::new();
    let config = RenderConfig { display_mode, annotation: None, ..RenderConfig::default() };
    let readable = events.iter().all(Result::is_ok);
    if readable && push_mathml(&mut out, events.into_iter(), config).is_ok() {
        out
    } else {
        format!("<code>{}</code>", escape(text))
    }
}
