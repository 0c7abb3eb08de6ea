//! VTK files for ParaView: one grid for each frame, and a collection with the times of the frames.
//! The data are in base64, because programs reject denormal numbers and NaN in the text format.
//! Reference: VTK User's Guide, "VTK File Formats": XML file formats; uncompressed, `header_type="UInt64"`.

use std::fmt::Write;

use super::base64::base64;
use super::{OutputError, Point};

/// VTK cell types of a point and of a line segment. Polylines are not used, because some programs cannot read them.
const VERTEX: u8 = 1;
const LINE: u8 = 3;

#[derive(Clone, Debug, Default, PartialEq)]
pub struct VtkGrid {
    pub cells: Vec<VtkCell>,
    pub fields: Vec<VtkField>,
}

/// Body: a polyline, or a dot if it has only one point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VtkCell {
    pub name: String,
    pub points: Vec<Point>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct VtkField {
    pub name: String,
    pub values: VtkValues,
}

#[derive(Clone, Debug, PartialEq)]
pub enum VtkValues {
    Numbers(Vec<f64>),
    /// Vectors in the plane, which get a third component of zero in the file.
    Vectors(Vec<Point>),
}

struct VtkPiece {
    body: usize,
    points: std::ops::Range<usize>,
}

impl VtkField {
    fn length(&self) -> usize {
        match &self.values {
            VtkValues::Numbers(values) => values.len(),
            VtkValues::Vectors(values) => values.len(),
        }
    }
}

impl VtkGrid {
    pub fn to_vtu(&self) -> Result<String, OutputError> {
        let points: Vec<Point> = self.cells.iter().flat_map(|cell| cell.points.clone()).collect();
        if let Some(field) = self.fields.iter().find(|field| field.length() != points.len()) {
            return Err(OutputError::RaggedColumns {
                name: field.name.clone(),
                length: field.length(),
                first: "points".into(),
                expected: points.len(),
            });
        }
        let (count, pieces) = (points.len(), self.pieces());
        let cells = pieces.len();
        let mut text = heading(&self.names(), "UnstructuredGrid", " header_type=\"UInt64\"");
        text += &format!(
            "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{count}\" NumberOfCells=\"{cells}\">\n"
        );
        text += "<PointData>\n";
        for VtkField { name, values } in &self.fields {
            match values {
                VtkValues::Numbers(values) => push_numbers(&mut text, name, values),
                VtkValues::Vectors(values) => push_vectors(&mut text, name, values),
            }
        }
        text += "</PointData>\n<CellData>\n";
        push_whole(&mut text, "body", pieces.iter().map(|piece| piece.body));
        text += "</CellData>\n<Points>\n";
        push_vectors(&mut text, "Points", &points);
        text += "</Points>\n<Cells>\n";
        let ends = pieces.iter().scan(0, |end, piece| {
            *end += piece.points.len();
            Some(*end)
        });
        push_whole(&mut text, "connectivity", pieces.iter().flat_map(|piece| piece.points.clone()));
        push_whole(&mut text, "offsets", ends);
        let kind = |piece: &VtkPiece| if piece.points.len() == 1 { VERTEX } else { LINE };
        push(&mut text, "UInt8", "types", 1, pieces.iter().map(|piece| [kind(piece)]));
        text += "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
        Ok(text)
    }

    fn pieces(&self) -> Vec<VtkPiece> {
        let mut first = 0;
        let of_body = |(body, cell): (usize, &VtkCell)| {
            let (start, end) = (first, first + cell.points.len());
            first = end;
            let last = if end - start > 1 { end - 1 } else { end };
            let width = if end - start > 1 { 2 } else { 1 };
            (start..last).map(move |at| VtkPiece { body, points: at..at + width })
        };
        self.cells.iter().enumerate().flat_map(of_body).collect()
    }

    fn names(&self) -> String {
        let bodies = self.cells.iter().enumerate();
        let entries: Vec<String> = bodies.map(|(at, cell)| format!("{at} {}", cell.name)).collect();
        format!("body: {}", entries.join(", "))
    }
}

pub fn vtk_collection(frames: &[(f64, String)]) -> String {
    let mut text = heading("frames and their times", "Collection", "");
    text += "<Collection>\n";
    for (time, file) in frames {
        let file = escaped(file);
        let _ = writeln!(text, "<DataSet timestep=\"{time:?}\" part=\"0\" file=\"{file}\"/>");
    }
    text + "</Collection>\n</VTKFile>\n"
}

fn heading(comment: &str, kind: &str, more: &str) -> String {
    // Hyphens are replaced, because two of them would end the comment, and control characters, because they are invalid in XML.
    let comment = comment.replace('-', "\u{2010}").replace(char::is_control, " ");
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- {comment} -->\n\
         <VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\"{more}>\n"
    )
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

fn push_numbers(text: &mut String, name: &str, values: &[f64]) {
    push(text, "Float64", name, 1, values.iter().map(|value| value.to_le_bytes()));
}

fn push_vectors(text: &mut String, name: &str, values: &[Point]) {
    let components = values.iter().flat_map(|&(x, y)| [x, y, 0.0]);
    push(text, "Float64", name, 3, components.map(f64::to_le_bytes));
}

fn push_whole(text: &mut String, name: &str, values: impl Iterator<Item = usize>) {
    push(text, "Int64", name, 1, values.map(|value| (value as u64).to_le_bytes()));
}

fn push<const N: usize>(
    text: &mut String,
    kind: &str,
    name: &str,
    components: usize,
    values: impl Iterator<Item = [u8; N]>,
) {
    let mut bytes = vec![0; 8];
    values.for_each(|value| bytes.extend(value));
    let length = (bytes.len() - 8) as u64;
    bytes[..8].copy_from_slice(&length.to_le_bytes());
    let (name, letters) = (escaped(name), base64(&bytes));
    // `NumberOfComponents="1"` is omitted, because some programs convert such an array to a table with one column.
    let many = match components {
        1 => String::new(),
        many => format!(" NumberOfComponents=\"{many}\""),
    };
    let _ = writeln!(
        text,
        "<DataArray type=\"{kind}\" Name=\"{name}\"{many} format=\"binary\">{letters}</DataArray>"
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(values: Vec<f64>) -> VtkGrid {
        VtkGrid {
            cells: vec![
                VtkCell { name: "rod".into(), points: vec![(0.0, 0.0), (1.0, 0.5)] },
                VtkCell { name: "a--b".into(), points: vec![(2.0, 0.0)] },
            ],
            fields: vec![VtkField { name: "N".into(), values: VtkValues::Numbers(values) }],
        }
    }

    #[test]
    fn vtk_arrays_are_preceded_by_their_byte_count() {
        let text = grid(vec![1.0, 2.0, f64::NAN]).to_vtu().unwrap();
        let line = |name: &str| {
            let line = text.lines().find(|line| line.contains(&format!("Name=\"{name}\"")));
            line.unwrap().split(['>', '<']).nth(2).unwrap().to_owned()
        };
        let offsets: Vec<u8> = [16_u64, 2, 3].into_iter().flat_map(u64::to_le_bytes).collect();
        assert_eq!(line("offsets"), base64(&offsets));
        let types = [2_u64.to_le_bytes().as_slice(), &[LINE, VERTEX]].concat();
        assert_eq!(line("types"), base64(&types));
        assert!(line("Points").starts_with(&base64(&72_u64.to_le_bytes())[..10]));
        assert!(text.contains("<!-- body: 0 rod, 1 a\u{2010}\u{2010}b -->"));
    }

    #[test]
    fn vtk_field_of_wrong_length_is_rejected() {
        let message = grid(vec![1.0]).to_vtu().unwrap_err().to_string();
        assert!(message.contains("column 'N' has 1 values but column 'points' has 3"), "{message}");
    }

    #[test]
    fn vtk_collection_has_exact_times() {
        let text = vtk_collection(&[(0.1 + 0.2, "a&b/1.vtu".into()), (1e-300, "2.vtu".into())]);
        assert!(
            text.contains("timestep=\"0.30000000000000004\" part=\"0\" file=\"a&amp;b/1.vtu\"")
        );
        assert!(text.contains("timestep=\"1e-300\""));
    }
}
