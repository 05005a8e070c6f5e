//! Tables that cases provide.

use super::page::escape;
use crate::ledger::Table;

/// A table with its title.
pub fn free(table: &Table) -> String {
    let row = |cells: &Vec<String>| {
        let cells: String = cells
            .iter()
            .zip(&table.head)
            .map(|(cell, head)| format!("<td data-head=\"{}\">{}</td>", escape(head), escape(cell)))
            .collect();
        format!("<tr>{cells}</tr>\n")
    };
    let rows: String = table.rows.iter().map(row).collect();
    let head: String = table.head.iter().map(|cell| format!("<th>{}</th>", escape(cell))).collect();
    format!(
        "<h3>{}</h3>\n<table class=\"free\">\n<thead><tr>{head}</tr></thead>\n<tbody>{rows}</tbody></table>\n",
        escape(&table.title)
    )
}
