//! Aligned rows of a name and a value.

use std::io::{self, Write};

/// Rows to be printed under each other.
#[derive(Debug, Default)]
pub(crate) struct Table {
    rows: Vec<(String, String)>,
}

impl Table {
    pub(crate) fn row(&mut self, name: &str, value: impl ToString) {
        self.rows.push((name.to_owned(), value.to_string()));
    }

    /// Prints the rows with their values in one column.
    pub(crate) fn print(&self, mut out: impl Write) -> io::Result<()> {
        let longest = self.rows.iter().map(|(name, _)| name.len()).max();
        let width = longest.unwrap_or_default();
        for (name, value) in &self.rows {
            writeln!(out, "{name:width$}  {value}")?;
        }
        out.flush()
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
        let mut text = Vec::new();
        table.print(&mut text).unwrap();
        assert_eq!(text, b"a     1\nlong  x\n");
    }
}
