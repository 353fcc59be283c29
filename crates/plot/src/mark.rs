//! What a figure says of itself, for programs: which made it, and of what.

/// The signature of a PNG and its first chunk, the header, which nothing may go before.
const PNG_HEAD_BYTES: usize = 8 + 25;

/// An SVG document with a description.
pub fn with_description(svg: &str, text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    match svg.split_once('>') {
        Some((head, rest)) => format!("{head}>\n<desc>{text}</desc>{rest}"),
        None => svg.to_owned(),
    }
}

/// A PNG that says which software made it; letters outside Latin-1 become question marks.
pub fn with_software(png: &[u8], text: &str) -> Vec<u8> {
    let latin_1 = text.chars().map(|letter| u8::try_from(letter).unwrap_or(b'?'));
    with_chunk(png, *b"tEXt", &b"Software\0".iter().copied().chain(latin_1).collect::<Vec<u8>>())
}

/// A PNG that says how large it is on paper, so that a text processor or a journal places it so.
pub(super) fn with_resolution(png: &[u8], dots_per_inch: f32) -> Vec<u8> {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some thousands")]
    let per_metre = (dots_per_inch / 0.0254).round() as u32;
    let unit_is_metre = 1;
    let data = [&per_metre.to_be_bytes()[..], &per_metre.to_be_bytes(), &[unit_is_metre]].concat();
    with_chunk(png, *b"pHYs", &data)
}

/// A PNG with one chunk more, after its header.
fn with_chunk(png: &[u8], name: [u8; 4], data: &[u8]) -> Vec<u8> {
    let Some((head, rest)) = png.split_at_checked(PNG_HEAD_BYTES) else { return png.to_owned() };
    let length = u32::try_from(data.len()).unwrap_or_default().to_be_bytes();
    let chunk = [&name[..], data].concat();
    let checksum = crc32fast::hash(&chunk).to_be_bytes();
    [head, &length, &chunk, &checksum, rest].concat()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::png;

    #[test]
    fn marked_figures_are_drawn_as_before() {
        let svg = "<svg width=\"20\" height=\"10\" xmlns=\"http://www.w3.org/2000/svg\">\n\
                   <rect width=\"5\" height=\"5\"/>\n</svg>";
        let marked = with_description(svg, "made by a & b <c>");
        assert!(marked.contains("<desc>made by a &amp; b &lt;c&gt;</desc>"));
        let Ok(image) = png(svg, 96.0) else { return };
        assert_eq!(png(&marked, 96.0).unwrap(), image);
        let said = with_software(&image, "uplift 1; résult – 1.h5");
        assert!(said.windows(20).any(|words| words == b"tEXtSoftware\0uplift "));
        let decode = |png: &[u8]| resvg::tiny_skia::Pixmap::decode_png(png).unwrap();
        assert_eq!(decode(&said).data(), decode(&image).data());
    }
}
