//! Aligned rows of a name and a value.

use crate::{console, sanitize};
use std::io;

/// Rows to be printed under each other.
#[derive(Debug, Default)]
pub(crate) struct Table {
    rows: Vec<(String, String)>,
}

impl Table {
    pub(crate) fn row(&mut self, name: &str, value: impl ToString) {
        self.rows.push((sanitize::line(name).into_owned(), sanitize::line(&value.to_string()).into_owned()));
    }

    pub(crate) fn print(&self) -> io::Result<()> {
        console::print(self.text())
    }

    /// The rows with their values in one column.
    fn text(&self) -> String {
        let width = self.rows.iter().map(|(name, _)| name.len()).max().unwrap_or_default();
        self.rows.iter().map(|(name, value)| format!("{name:width$}  {value}\n")).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Table;

    #[test]
    fn values_are_aligned() {
        let mut table = Table::default();
        table.row("a", 1);
        table.row("long", "x");
        assert_eq!(table.text(), "a     1\nlong  x\n");
    }
}
