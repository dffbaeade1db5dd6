//! Tables that grow while a scenario runs, in any format.

use super::folder::Outputs;
use super::pending::PendingFile;
use crate::failure::Failure;
use crate::{json, sanitize};
use microsim_core::scenario::TableFormat;
use serde::{Serialize, Serializer};
use std::io::{self, Write};
use std::path::PathBuf;

/// A value in a table.
#[derive(Clone, Copy, Debug)]
pub(super) enum Cell<'a> {
    Whole(u64),
    /// Single precision is written with the shortest digits that mean it.
    Single(f32),
    Double(f64),
    Text(&'a str),
}

impl Serialize for Cell<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match *self {
            Self::Whole(value) => serializer.serialize_u64(value),
            Self::Single(value) => serializer.serialize_f32(value),
            Self::Double(value) => serializer.serialize_f64(value),
            Self::Text(text) => serializer.serialize_str(text),
        }
    }
}

/// Name of the file that grows. A Parquet file cannot be continued, so its rows are gathered as lines and converted at the
/// end.
pub(super) fn file_name(table: &str, format: TableFormat) -> String {
    let ending = if format == TableFormat::Parquet { "parquet-rows" } else { format.name() };
    format!("{table}.{ending}")
}

/// One table in one or several formats.
#[derive(Debug)]
pub(super) struct DataTable {
    columns: Vec<&'static str>,
    sinks: Vec<Sink>,
}

#[derive(Debug)]
struct Sink {
    format: TableFormat,
    file: PendingFile,
}

impl DataTable {
    /// Begins a table, or continues one whose files had the lengths that `lengths` knows by name.
    pub(super) fn open(
        outputs: &Outputs,
        name: &str,
        formats: &[TableFormat],
        columns: Vec<&'static str>,
        lengths: impl Fn(&str) -> Option<u64>,
    ) -> Result<Self, Failure> {
        let sink = |&format: &TableFormat| {
            let name = file_name(name, format);
            if let Some(length) = lengths(&name) {
                return outputs.resume(&name, length).map(|file| Sink { format, file });
            }
            let mut file = outputs.file(&name)?;
            if format == TableFormat::Csv {
                let header = writeln!(file, "{}", columns.join(","));
                header.map_err(|error| Failure::file("write", &file.path, &error))?;
            }
            Ok(Sink { format, file })
        };
        let sinks = formats.iter().map(sink).collect::<Result<_, _>>()?;
        Ok(Self { columns, sinks })
    }

    /// Adds a row: one cell for each column.
    pub(super) fn add(&mut self, cells: &[Cell<'_>]) -> Result<(), Failure> {
        for Sink { format, file } in &mut self.sinks {
            let written = match format {
                TableFormat::Csv => write_csv(file, cells),
                TableFormat::Jsonl | TableFormat::Parquet => write_line(file, &self.columns, cells),
            };
            written.map_err(|error| Failure::file("write", &file.path, &error))?;
        }
        Ok(())
    }

    /// Names and lengths of its files, with all rows in them.
    pub(super) fn lengths(&mut self) -> Result<Vec<(String, u64)>, Failure> {
        self.sinks.iter_mut().map(|sink| Ok((sink.file.name.clone(), sink.file.keep()?))).collect()
    }

    /// Gives all files their names. Returns those that nobody needs any more.
    pub(super) fn finish(self, outputs: &Outputs) -> Result<Vec<PathBuf>, Failure> {
        let mut needless = Vec::new();
        for Sink { format, file } in self.sinks {
            match format {
                TableFormat::Parquet => needless.push(convert(outputs, &self.columns, file)?),
                _ => outputs.finish(file)?,
            }
        }
        Ok(needless)
    }
}

/// Text is names, none of which needs quotes.
fn write_csv(file: &mut PendingFile, cells: &[Cell<'_>]) -> io::Result<()> {
    for (index, cell) in cells.iter().enumerate() {
        if index > 0 {
            file.write_all(b",")?;
        }
        match cell {
            Cell::Whole(value) => write!(file, "{value}")?,
            Cell::Single(value) => write!(file, "{value}")?,
            Cell::Double(value) => write!(file, "{value}")?,
            Cell::Text(text) => file.write_all(sanitize::cell(text).as_bytes())?,
        }
    }
    file.write_all(b"\n")
}

/// The cells of a row under the names of its columns.
struct Row<'a>(&'a [&'a str], &'a [Cell<'a>]);

impl Serialize for Row<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().zip(self.1))
    }
}

fn write_line(file: &mut PendingFile, columns: &[&str], cells: &[Cell<'_>]) -> io::Result<()> {
    file.write_all(json::line(&Row(columns, cells))?.as_bytes())
}

#[cfg(feature = "parquet")]
fn convert(outputs: &Outputs, columns: &[&str], rows: PendingFile) -> Result<PathBuf, Failure> {
    super::parquet::convert(outputs, columns, rows)
}

#[cfg(not(feature = "parquet"))]
fn convert(_: &Outputs, _: &[&str], rows: PendingFile) -> Result<PathBuf, Failure> {
    // Refused before the run began.
    Ok(rows.temporary.clone())
}
