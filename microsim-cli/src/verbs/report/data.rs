//! Reads the files of a run.

use crate::failure::Failure;
use crate::read;
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::Path;

/// Cells of a table as text, and the names of its columns.
#[derive(Debug, Default)]
pub(super) struct TextTable {
    pub names: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl TextTable {
    /// Reads `NAME.csv` or `NAME.jsonl`; empty where there is neither.
    pub(super) fn read(folder: &Path, name: &str) -> Result<Self, Failure> {
        if let Some(text) = text(&folder.join(format!("{name}.csv")))? {
            let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
            return Ok(Self { names: lines.next().unwrap_or_default(), rows: lines.collect() });
        }
        let objects: Vec<BTreeMap<String, Value>> = lines(&folder.join(format!("{name}.jsonl")))?;
        let names: Vec<String> = objects.first().map(|first| first.keys().cloned().collect()).unwrap_or_default();
        let cell = |value: Option<&Value>| match value {
            Some(Value::String(text)) => text.clone(),
            Some(value) => value.to_string(),
            None => String::new(),
        };
        let rows = objects.iter().map(|row| names.iter().map(|name| cell(row.get(name))).collect()).collect();
        Ok(Self { names, rows })
    }

    /// One column's cells.
    pub(super) fn texts(&self, name: &str) -> Vec<&str> {
        let at = self.names.iter().position(|known| known == name);
        self.rows.iter().map(|row| at.and_then(|at| row.get(at)).map_or("", String::as_str)).collect()
    }

    /// One column's numbers; NaN where there is none.
    pub(super) fn numbers(&self, name: &str) -> Vec<f64> {
        self.texts(name).into_iter().map(|text| text.parse().unwrap_or(f64::NAN)).collect()
    }
}

/// The content of a file; `None` where there is none.
pub(super) fn bytes(path: &Path) -> Result<Option<Vec<u8>>, Failure> {
    match read::whole(path) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(Failure::file("read", path, &error)),
    }
}

fn text(path: &Path) -> Result<Option<String>, Failure> {
    Ok(bytes(path)?.map(|bytes| String::from_utf8_lossy(&bytes).into_owned()))
}

/// One JSON value a line; none where there is no file.
pub(super) fn lines<T: DeserializeOwned>(path: &Path) -> Result<Vec<T>, Failure> {
    let text = text(path)?.unwrap_or_default();
    let parse = |(index, line)| {
        let place = format!("{}:{}", path.display(), index + 1);
        serde_json::from_str(line).map_err(|error| Failure::Message(format!("{place}: {error}")))
    };
    text.lines().enumerate().map(parse).collect()
}
