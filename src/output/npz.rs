//! Archives of arrays for NumPy: uncompressed ZIP files with one `.npy` file for each array (NEP 1, format 1.0).

use std::io::{Cursor, Write};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use super::OutputError;

/// First bytes and version of `.npy` files.
const MAGIC: &[u8; 8] = b"\x93NUMPY\x01\x00";
/// Alignment of the data [bytes].
const ALIGNMENT: usize = 64;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct NpzArchive {
    pub arrays: Vec<NpzArray>,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct NpzArray {
    pub name: String,
    pub shape: Vec<usize>,
    pub values: Vec<f64>,
}

impl NpzArchive {
    /// Bytes of the `.npz` file. Equal arrays give equal bytes.
    pub fn to_bytes(&self) -> Result<Vec<u8>, OutputError> {
        let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .last_modified_time(DateTime::default());
        for array in &self.arrays {
            let expected = array.shape.iter().product();
            if array.values.len() != expected {
                return Err(OutputError::RaggedColumns {
                    name: array.name.clone(),
                    length: array.values.len(),
                    first: "its shape".into(),
                    expected,
                });
            }
            let bytes = array.to_npy();
            let is_large = bytes.len() >= u32::MAX as usize;
            archive.start_file(format!("{}.npy", array.name), options.large_file(is_large))?;
            archive.write_all(&bytes).map_err(zip::result::ZipError::from)?;
        }
        Ok(archive.finish()?.into_inner())
    }
}

impl NpzArray {
    pub fn row(name: impl Into<String>, values: Vec<f64>) -> Self {
        Self { name: name.into(), shape: vec![values.len()], values }
    }

    fn to_npy(&self) -> Vec<u8> {
        let lengths: String = self.shape.iter().map(|length| format!("{length}, ")).collect();
        let lengths = lengths.trim_end();
        let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({lengths}), }}");
        let begun = MAGIC.len() + 2 + header.len() + 1;
        let filled = begun.next_multiple_of(ALIGNMENT) - begun;
        let mut bytes = MAGIC.to_vec();
        bytes.extend(((header.len() + filled + 1) as u16).to_le_bytes());
        bytes.extend(header.bytes());
        bytes.extend(std::iter::repeat_n(b' ', filled));
        bytes.push(b'\n');
        bytes.extend(self.values.iter().flat_map(|value| value.to_le_bytes()));
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn npy_header_equals_that_of_numpy() {
        let array = NpzArray { name: "a".into(), shape: vec![2, 3], values: vec![0.5; 6] };
        let bytes = array.to_npy();
        assert_eq!(bytes.len(), 128 + 48);
        // Header that numpy.save writes for np.full((2, 3), 0.5), without the trailing comma of the tuple.
        let header = "\u{93}NUMPY\u{1}\u{0}v\u{0}{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3,), }";
        let header: Vec<u8> = header.chars().map(|letter| letter as u8).collect();
        assert!(bytes.starts_with(&header), "{:?}", String::from_utf8_lossy(&bytes[..80]));
        assert_eq!(bytes[127], b'\n');
        assert_eq!(bytes[128..136], 0.5_f64.to_le_bytes());
        let row = NpzArray::row("t", vec![1.0]).to_npy();
        assert!(String::from_utf8_lossy(&row).contains("'shape': (1,)"));
    }

    #[test]
    fn equal_arrays_give_equal_bytes_and_invalid_arrays_are_rejected() {
        let archive = NpzArchive { arrays: vec![NpzArray::row("t", vec![0.0, 0.1])] };
        assert_eq!(archive.to_bytes().unwrap(), archive.to_bytes().unwrap());
        let wrong = NpzArray { shape: vec![3], ..NpzArray::row("t", vec![0.0]) };
        assert!(NpzArchive { arrays: vec![wrong] }.to_bytes().is_err());
        let twice = vec![NpzArray::row("t", vec![0.0]); 2];
        assert!(NpzArchive { arrays: twice }.to_bytes().is_err());
    }
}
