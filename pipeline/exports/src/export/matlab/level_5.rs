//! MATLAB's file format, level 5: as much of it as arrays of numbers, texts and lists of texts need.
//!
//! Own code, since no maintained crate writes the format.
//!
//! # Source
//! The `MathWorks`, MAT-File Format (R2016b and later), chapter 1: header, data elements, array types.

/// Data types of elements.
const INT8: u32 = 1;
const INT32: u32 = 5;
const UINT16: u32 = 4;
const UINT32: u32 = 6;
const DOUBLE: u32 = 9;
const MATRIX: u32 = 14;
const UTF8: u32 = 16;
/// Classes of arrays.
const CELL_CLASS: u32 = 1;
const CHAR_CLASS: u32 = 4;
const DOUBLE_CLASS: u32 = 6;

/// Lengths of an array's dimensions, the first running fastest.
pub(crate) struct Shape(pub(in crate::export) Vec<usize>);

impl Shape {
    /// A column of `rows`.
    pub(crate) fn column(rows: usize) -> Self {
        Self(vec![rows, 1])
    }
}

/// A file being put together.
pub(crate) struct MatFile {
    bytes: Vec<u8>,
    /// Where an element was too large for its 32-bit length.
    too_large: Option<String>,
}

impl MatFile {
    /// A file whose first line of text says where it comes from.
    pub(crate) fn new(description: &str) -> Self {
        let mut text: Vec<u8> = format!("MATLAB 5.0 MAT-file, {description}")
            .chars()
            .map(|character| if character.is_ascii() && !character.is_ascii_control() { character as u8 } else { b'?' })
            .collect();
        text.resize(124, b' ');
        let mut bytes = text;
        bytes.extend(0x0100_u16.to_le_bytes());
        bytes.extend(b"IM");
        Self { bytes, too_large: None }
    }

    /// An array of numbers; as many values as the shape says.
    pub(crate) fn numbers(&mut self, name: &str, shape: &Shape, values: &[f64]) {
        debug_assert_eq!(shape.0.iter().product::<usize>(), values.len(), "{name}");
        let data: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        let body = array(DOUBLE_CLASS, name, shape, &[element(DOUBLE, &data)]);
        self.push(name, &body);
    }

    pub(crate) fn text(&mut self, name: &str, text: &str) {
        let body = text_array(name, text);
        self.push(name, &body);
    }

    /// A cell array of texts, a column.
    pub(crate) fn texts(&mut self, name: &str, texts: &[&str]) {
        let cells: Vec<Vec<u8>> = texts.iter().map(|text| element(MATRIX, &text_array("", text))).collect();
        let body = array(CELL_CLASS, name, &Shape::column(texts.len()), &cells);
        self.push(name, &body);
    }

    /// The whole file.
    pub(crate) fn finish(self) -> Result<Vec<u8>, String> {
        match self.too_large {
            Some(name) => {
                Err(format!("{name} is too large for a MATLAB file of level 5 (4 GiB): read the HDF5 file instead"))
            }
            None => Ok(self.bytes),
        }
    }

    fn push(&mut self, name: &str, body: &[u8]) {
        if u32::try_from(body.len()).is_err() {
            self.too_large = Some(name.to_owned());
            return;
        }
        self.bytes.extend(element(MATRIX, body));
    }
}

fn text_array(name: &str, text: &str) -> Vec<u8> {
    let data = if text.is_ascii() {
        element(UINT16, &text.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<u8>>())
    } else {
        // units of two bytes are no letters to SciPy, and UTF-16 is nothing to Octave; both take this
        element(UTF8, text.as_bytes())
    };
    array(CHAR_CLASS, name, &Shape(vec![1, text.chars().count()]), &[data])
}

/// Flags, dimensions, name and data of an array.
fn array(class: u32, name: &str, shape: &Shape, data: &[Vec<u8>]) -> Vec<u8> {
    let flags: Vec<u8> = [class, 0].iter().flat_map(|word| word.to_le_bytes()).collect();
    let lengths: Vec<u8> =
        shape.0.iter().flat_map(|&length| i32::try_from(length).unwrap_or(i32::MAX).to_le_bytes()).collect();
    let mut body = element(UINT32, &flags);
    body.extend(element(INT32, &lengths));
    body.extend(element(INT8, name.as_bytes()));
    body.extend(data.iter().flatten());
    body
}

/// An element: type, length, data, filled up to eight bytes.
fn element(kind: u32, data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(data.len() + 16);
    bytes.extend(kind.to_le_bytes());
    bytes.extend(u32::try_from(data.len()).unwrap_or(u32::MAX).to_le_bytes());
    bytes.extend(data);
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}
