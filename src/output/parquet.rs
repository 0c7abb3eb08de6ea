//! Apache Parquet files: typed columns in one row group, with dimensions as metadata.

use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as Stored};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{Type, TypePtr};

use super::{DataColumn, DataTable, DataValues, OutputError};

impl DataTable {
    /// Bytes of an uncompressed `.parquet` file, in which the metadata `dimension.NAME` is the dimension of the column NAME.
    pub fn to_parquet(&self) -> Result<Vec<u8>, OutputError> {
        self.rows()?;
        self.written_to_parquet()
            .map_err(|error| OutputError::Parquet { reason: error.to_string() })
    }

    fn written_to_parquet(&self) -> Result<Vec<u8>, ParquetError> {
        let fields = self.columns.iter().map(field).collect::<Result<Vec<TypePtr>, _>>()?;
        let schema = Arc::new(Type::group_type_builder("table").with_fields(fields).build()?);
        let known = self.columns.iter().filter(|column| !column.dimension.is_empty());
        let dimension = |column: &DataColumn| {
            KeyValue::new(format!("dimension.{}", column.name), column.dimension.clone())
        };
        let properties = WriterProperties::builder()
            .set_key_value_metadata(Some(known.map(dimension).collect()))
            .build();
        let mut bytes = Vec::new();
        let mut file = SerializedFileWriter::new(&mut bytes, schema, Arc::new(properties))?;
        let mut group = file.next_row_group()?;
        for column in &self.columns {
            match &column.values {
                DataValues::Numbers(values) => write::<DoubleType>(&mut group, values.clone())?,
                DataValues::Integers(values) => write::<Int64Type>(&mut group, values.clone())?,
                DataValues::Booleans(values) => write::<BoolType>(&mut group, values.clone())?,
                DataValues::Texts(values) => {
                    let texts = values.iter().map(|text| text.as_deref().map(ByteArray::from));
                    write::<ByteArrayType>(&mut group, texts.collect())?;
                }
            }
        }
        group.close()?;
        file.close()?;
        Ok(bytes)
    }
}

fn field(column: &DataColumn) -> Result<TypePtr, ParquetError> {
    let (stored, meant) = match &column.values {
        DataValues::Numbers(_) => (Stored::DOUBLE, None),
        DataValues::Integers(_) => (Stored::INT64, None),
        DataValues::Booleans(_) => (Stored::BOOLEAN, None),
        DataValues::Texts(_) => (Stored::BYTE_ARRAY, Some(LogicalType::String)),
    };
    let field = Type::primitive_type_builder(&column.name, stored)
        .with_repetition(Repetition::OPTIONAL)
        .with_logical_type(meant);
    Ok(Arc::new(field.build()?))
}

fn write<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, &mut Vec<u8>>,
    values: Vec<Option<T::T>>,
) -> Result<(), ParquetError> {
    let levels: Vec<i16> = values.iter().map(|value| i16::from(value.is_some())).collect();
    let present: Vec<T::T> = values.into_iter().flatten().collect();
    let mut column = group
        .next_column()?
        .ok_or_else(|| ParquetError::General("more columns than fields".into()))?;
    column.typed::<T>().write_batch(&present, Some(&levels), None)?;
    column.close()
}

#[cfg(test)]
mod tests {
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::RowAccessor;

    use super::*;

    #[test]
    fn parquet_file_contains_the_written_values() {
        let column = |name: &str, values| DataColumn {
            name: name.into(),
            dimension: if name == "t" { "time".into() } else { String::new() },
            values,
        };
        let table = DataTable {
            columns: vec![
                column("t", DataValues::Numbers(vec![Some(0.1), None])),
                column("steps", DataValues::Integers(vec![Some(3), Some(-1)])),
                column("good", DataValues::Booleans(vec![None, Some(true)])),
                column("told", DataValues::Texts(vec![Some("a, ö".into()), None])),
            ],
        };
        let bytes = table.to_parquet().unwrap();
        assert_eq!(bytes, table.to_parquet().unwrap(), "equal tables, equal bytes");
        let reader = SerializedFileReader::new(bytes::Bytes::from(bytes)).unwrap();
        let metadata = reader.metadata().file_metadata().key_value_metadata().unwrap().clone();
        assert!(metadata.contains(&KeyValue::new("dimension.t".into(), "time".to_owned())));
        let rows: Vec<_> = reader.get_row_iter(None).unwrap().map(Result::unwrap).collect();
        assert_eq!(rows[0].get_double(0).unwrap(), 0.1);
        assert!(rows[1].get_double(0).is_err(), "it is missing");
        assert_eq!((rows[0].get_long(1).unwrap(), rows[1].get_long(1).unwrap()), (3, -1));
        assert!(rows[1].get_bool(2).unwrap());
        assert_eq!(rows[0].get_string(3).unwrap(), "a, ö");
    }
}
