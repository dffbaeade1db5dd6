//! Rows, one JSON object a line, as a Parquet file.

use super::folder::Outputs;
use super::pending::PendingFile;
use crate::failure::Failure;
use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::Result;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{Type, TypePtr};
use serde_json::Value;
use std::fs::File;
use std::io::{BufRead, BufReader, Write};
use std::path::PathBuf;
use std::sync::Arc;

/// Rows that are kept in memory at once.
const GROUP: usize = 1 << 16;

type Row = serde_json::Map<String, Value>;

/// Writes `NAME.parquet` for the rows of `NAME.parquet-rows`. Returns where these lie: nobody but a checkpoint needs them.
pub(super) fn convert(
    outputs: &Outputs,
    columns: &[&str],
    mut rows: PendingFile,
) -> std::result::Result<PathBuf, Failure> {
    rows.flush().map_err(|error| Failure::file("write", &rows.path, &error))?;
    let name = rows.name.trim_end_matches("-rows").to_owned();
    let mut file = outputs.file(&name)?;
    let path = file.path.clone();
    let from = File::open(&rows.temporary).map_err(|error| Failure::file("read", &rows.temporary, &error))?;
    write(&mut file, columns, BufReader::new(from))
        .map_err(|error| Failure::Message(format!("cannot write {}: {error}", path.display())))?;
    outputs.finish(file)?;
    Ok(rows.temporary.clone())
}

fn write(file: impl Write + Send, columns: &[&str], from: impl BufRead) -> Result<()> {
    let read = |line: std::io::Result<String>| -> Result<Row> { Ok(serde_json::from_str(&line?).unwrap_or_default()) };
    let mut rows = from.lines().map(read).peekable();
    let first = rows.peek().and_then(|row| row.as_ref().ok()).cloned().unwrap_or_default();
    let fields = columns.iter().map(|name| field(name, first.get(*name))).collect::<Result<_>>()?;
    let schema = Arc::new(Type::group_type_builder("schema").with_fields(fields).build()?);
    let mut writer = SerializedFileWriter::new(file, schema.clone(), Arc::new(WriterProperties::builder().build()))?;
    while rows.peek().is_some() {
        let group = rows.by_ref().take(GROUP).collect::<Result<Vec<Row>>>()?;
        let mut writer = writer.next_row_group()?;
        schema.get_fields().iter().try_for_each(|field| write_column(&mut writer, field, &group))?;
        writer.close()?;
    }
    writer.close()?;
    Ok(())
}

/// A column of the type of its first value.
fn field(name: &str, value: Option<&Value>) -> Result<TypePtr> {
    let (physical, logical) = match value {
        Some(Value::String(_)) => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        Some(Value::Number(number)) if number.is_u64() => (Physical::INT64, None),
        _ => (Physical::DOUBLE, None),
    };
    let field = Type::primitive_type_builder(name, physical);
    field.with_repetition(Repetition::REQUIRED).with_logical_type(logical).build().map(Arc::new)
}

fn write_column<W: Write + Send>(
    group: &mut SerializedRowGroupWriter<'_, W>,
    field: &TypePtr,
    rows: &[Row],
) -> Result<()> {
    let Some(mut column) = group.next_column()? else {
        return Ok(());
    };
    let cells = rows.iter().map(|row| row.get(field.name()));
    match field.get_physical_type() {
        Physical::BYTE_ARRAY => {
            let texts: Vec<ByteArray> =
                cells.map(|cell| cell.and_then(Value::as_str).unwrap_or_default().into()).collect();
            column.typed::<ByteArrayType>().write_batch(&texts, None, None)?;
        }
        Physical::INT64 => {
            let numbers: Vec<i64> = cells.map(|cell| cell.and_then(Value::as_i64).unwrap_or_default()).collect();
            column.typed::<Int64Type>().write_batch(&numbers, None, None)?;
        }
        _ => {
            let numbers: Vec<f64> = cells.map(|cell| cell.and_then(Value::as_f64).unwrap_or(f64::NAN)).collect();
            column.typed::<DoubleType>().write_batch(&numbers, None, None)?;
        }
    }
    column.close()
}
