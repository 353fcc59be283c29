//! From SVG to pixels.

use std::sync::{Arc, OnceLock};

use resvg::{tiny_skia, usvg};

use super::mark::with_resolution;

/// Why a drawing could not become an image.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the figure cannot be turned into an image: {0}")]
pub struct RasterError(String);

/// The PNG of an SVG drawing at `dots_per_inch`, which it says of itself; 96 give a pixel of the drawing one of the
/// image.
///
/// # Errors
/// A drawing that cannot be read, or an image too large; a machine without any font.
pub fn png(svg: &str, dots_per_inch: f32) -> Result<Vec<u8>, RasterError> {
    static FONTS: OnceLock<Arc<usvg::fontdb::Database>> = OnceLock::new();
    let fonts = FONTS.get_or_init(|| {
        let mut fonts = usvg::fontdb::Database::new();
        fonts.load_system_fonts();
        // a family that is not there falls back to the generic one, which must be one that is
        let known = ["Arial", "Helvetica", "Liberation Sans", "DejaVu Sans", "Noto Sans"];
        let families: Vec<String> =
            fonts.faces().flat_map(|face| face.families.iter().map(|(name, _)| name.clone())).collect();
        if let Some(name) = known.iter().find(|name| families.iter().any(|family| family == *name)) {
            fonts.set_sans_serif_family(*name);
        } else if let Some(first) = families.first() {
            fonts.set_sans_serif_family(first);
        }
        Arc::new(fonts)
    });
    if fonts.is_empty() {
        return Err(RasterError(
            "no font is installed here, for instance fonts-dejavu-core; SVG needs none".to_owned(),
        ));
    }
    let options =
        usvg::Options { fontdb: fonts.clone(), font_family: "sans-serif".to_owned(), ..usvg::Options::default() };
    let tree = usvg::Tree::from_str(svg, &options).map_err(|error| RasterError(error.to_string()))?;
    let zoom = dots_per_inch / 96.0;
    let size = tree.size().to_int_size().scale_by(zoom).ok_or_else(|| RasterError("it has no size".to_owned()))?;
    require_memory(size)?;
    let mut pixels =
        tiny_skia::Pixmap::new(size.width(), size.height()).ok_or_else(|| RasterError("it is too large".to_owned()))?;
    resvg::render(&tree, tiny_skia::Transform::from_scale(zoom, zoom), &mut pixels.as_mut());
    let image = pixels.encode_png().map_err(|error| RasterError(error.to_string()))?;
    Ok(with_resolution(&image, dots_per_inch))
}

/// Refuses an image for which the system gives no memory: the library would end the program. It has the pixels, four
/// bytes each, and copies of them while it packs them.
fn require_memory(size: tiny_skia::IntSize) -> Result<(), RasterError> {
    let bytes = u64::from(size.width()) * u64::from(size.height()) * 4 * 4;
    if usize::try_from(bytes).is_ok_and(|bytes| Vec::<u8>::new().try_reserve_exact(bytes).is_ok()) {
        return Ok(());
    }
    Err(RasterError(format!("it needs {} MB of memory: lower --dpi, or write SVG", bytes / 1_000_000)))
}
