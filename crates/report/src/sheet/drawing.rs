//! A structure to scale, as SVG: its elevation with its dimensions, at rest and, dashed, as it rocks.
//!
//! Widths, heights and radii are to scale. What a description does not tell is not: the spacing of columns, the depth
//! of a deck, the size of a mass.

use std::fmt::Write;

use uplift_structure::{Anchorage, Geometry, Kind, StructureDescription};

/// Columns that are drawn; of more the first ones, and their number beside them.
const MOST_COLUMNS: u32 = 5;
/// Pixels of the drawing, and of the space for dimensions around the structure.
const WIDE: f64 = 460.0;
const HIGH: f64 = 400.0;
const AROUND: f64 = 64.0;
/// How far a rocking body is shown tilted, as a share of its slenderness.
const TILT: f64 = 0.35;

/// The drawing; empty for a description without a geometry, which is no structure.
pub(crate) fn drawing(description: &StructureDescription) -> String {
    let Ok(geometry) = description.geometry() else { return String::new() };
    let scene = Scene::from_description(description, &geometry);
    let mut svg = Svg { text: String::new(), scene: &scene };
    svg.ground();
    match description.kind {
        Kind::PointMass => svg.point_mass(&geometry),
        Kind::Block | Kind::Body => svg.block(&geometry, description.kind == Kind::Body),
        Kind::Frame | Kind::RestrainedFrame | Kind::CurvedFrame => svg.frame(description, &geometry),
    }
    svg.dimensions(description, &geometry);
    // no more paper than the structure needs
    let top = (scene.y(top_m(description, &geometry) + scene.deck_m) - 24.0).max(0.0).floor();
    let high = HIGH - top;
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 {top} {WIDE} {high}\" width=\"{WIDE}\" \
         height=\"{high}\" \
         role=\"img\" aria-label=\"Elevation of the structure, {}\" font-family=\"sans-serif\" font-size=\"13\" \
         fill=\"none\" stroke=\"#1b1e23\">\n{}</svg>",
        description.kind.name(),
        svg.text
    )
}

/// Where metres lie on the paper: the origin on the ground below the left edge of the structure.
struct Scene {
    columns: u32,
    /// From the left edge of a column to that of the next, m.
    spacing_m: f64,
    /// Depth of the deck, m; 0 without one.
    deck_m: f64,
    /// Width of a column end, m.
    end_m: f64,
    pixels_per_m: f64,
    left: f64,
    ground: f64,
}

impl Scene {
    fn from_description(description: &StructureDescription, geometry: &Geometry) -> Self {
        let is_frame = description.columns.is_some();
        let columns = description.columns.unwrap_or(1).clamp(1, MOST_COLUMNS);
        let (width_m, height_m) = (geometry.width_m(), top_m(description, geometry));
        let end_m = description.extended_width_m.unwrap_or(width_m).max(width_m);
        let spacing_m = end_m + (1.6 * width_m).max(0.28 * height_m);
        let deck_m = if is_frame { (0.5 * width_m).clamp(0.05 * height_m, 0.12 * height_m) } else { 0.0 };
        let wide_m = f64::from(columns - 1) * spacing_m + end_m;
        // a single body needs room to tilt
        let room_m = if is_frame { wide_m } else { wide_m + 0.5 * width_m };
        let pixels_per_m = ((WIDE - 2.0 * AROUND) / room_m).min((HIGH - 1.6 * AROUND) / (height_m + deck_m));
        Self {
            columns,
            spacing_m,
            deck_m,
            end_m,
            pixels_per_m,
            left: 0.5 * (WIDE - wide_m * pixels_per_m),
            ground: HIGH - AROUND,
        }
    }

    fn x(&self, metres: f64) -> f64 {
        self.left + metres * self.pixels_per_m
    }

    fn y(&self, metres: f64) -> f64 {
        self.ground - metres * self.pixels_per_m
    }
}

/// Height of the body or column, m: of a mass on a mast, that of the mass.
fn top_m(description: &StructureDescription, geometry: &Geometry) -> f64 {
    if description.kind == Kind::PointMass { geometry.half_height_m() } else { geometry.height_m() }
}

struct Svg<'a> {
    text: String,
    scene: &'a Scene,
}

impl Svg<'_> {
    fn add(&mut self, element: std::fmt::Arguments<'_>) {
        // writing to a string cannot fail
        let _ = writeln!(self.text, "{element}");
    }

    fn line(&mut self, (x1, y1): (f64, f64), (x2, y2): (f64, f64), style: &str) {
        self.add(format_args!("<path d=\"M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}\" {style}/>"));
    }

    /// A rectangle by its left edge, lower edge, width and height, m.
    fn rectangle(&mut self, [left_m, lower_m, width_m, height_m]: [f64; 4], style: &str) {
        let (x, y) = (self.scene.x(left_m), self.scene.y(lower_m + height_m));
        let (wide, high) = (width_m * self.scene.pixels_per_m, height_m * self.scene.pixels_per_m);
        self.add(format_args!("<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{wide:.1}\" height=\"{high:.1}\" {style}/>"));
    }

    fn ground(&mut self) {
        let y = self.scene.ground;
        self.line((24.0, y), (WIDE - 24.0, y), "stroke-width=\"1.6\"");
        for step in 0..32 {
            let x = 30.0 + 13.0 * f64::from(step);
            self.line((x, y), (x - 6.0, y + 7.0), "stroke=\"#9aa3b0\" stroke-width=\"0.8\"");
        }
    }

    /// The outline of a body tilted about its right corner, as a transformation.
    fn tilted(&self, geometry: &Geometry) -> String {
        let degrees = TILT * geometry.slenderness_rad().to_degrees();
        format!("transform=\"rotate({degrees:.2} {:.1} {:.1})\"", self.scene.x(geometry.width_m()), self.scene.ground)
    }

    fn block(&mut self, geometry: &Geometry, any_shape: bool) {
        let (width_m, height_m) = (geometry.width_m(), geometry.height_m());
        let tilted = self.tilted(geometry);
        self.rectangle([0.0, 0.0, width_m, height_m], &format!("{DASHED} {tilted}"));
        // of a body of another shape the rectangle has the corners and the centre, and nothing else
        let fill = if any_shape { "fill=\"#f4f5f7\" stroke-dasharray=\"2 2\"" } else { BODY };
        self.rectangle([0.0, 0.0, width_m, height_m], fill);
        let (x, y) = (self.scene.x(geometry.half_width_m()), self.scene.y(geometry.half_height_m()));
        self.add(format_args!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"#1b1e23\"/>"));
        self.line((self.scene.x(width_m), self.scene.ground), (x, y), THIN);
    }

    fn point_mass(&mut self, geometry: &Geometry) {
        let (width_m, centre_m) = (geometry.width_m(), geometry.half_height_m());
        let (left, middle, right) = (self.scene.x(0.0), self.scene.x(geometry.half_width_m()), self.scene.x(width_m));
        let (ground, mass) = (self.scene.ground, self.scene.y(centre_m));
        let mast = |style: &str| {
            format!(
                "<path d=\"M{left:.1} {ground:.1}H{right:.1}M{middle:.1} {ground:.1}V{mass:.1}\" \
                 stroke-width=\"3\" {style}/>\n\
                 <circle cx=\"{middle:.1}\" cy=\"{mass:.1}\" r=\"11\" {style}/>"
            )
        };
        let tilted = self.tilted(geometry);
        self.add(format_args!("<g {tilted}>{}</g>", mast(DASHED)));
        self.add(format_args!("{}", mast("fill=\"#dde1e7\"")));
    }

    fn frame(&mut self, description: &StructureDescription, geometry: &Geometry) {
        let scene = self.scene;
        let (width_m, height_m) = (geometry.width_m(), geometry.height_m());
        let inset_m = 0.5 * (scene.end_m - width_m);
        for column in 0..scene.columns {
            let left_m = f64::from(column) * scene.spacing_m + inset_m;
            self.rectangle([left_m, 0.0, width_m, height_m], BODY);
            if let Some(radius_m) = description.curvature_radius_m {
                self.ends(left_m, geometry, radius_m);
            }
            if description.kind == Kind::RestrainedFrame {
                let below = if description.tendon_anchorage == Some(Anchorage::Foundation) { 16.0 } else { -8.0 };
                let x = scene.x(left_m + 0.5 * width_m);
                let (anchor, head) = (scene.ground + below, scene.y(height_m) + 6.0);
                self.line((x, head), (x, anchor), TENDON);
                for y in [head, anchor] {
                    self.line((x - 5.0, y), (x + 5.0, y), "stroke=\"#00618f\" stroke-width=\"2.5\"");
                }
            }
        }
        let over_m = 0.35 * scene.end_m;
        let wide_m = f64::from(scene.columns - 1) * scene.spacing_m + scene.end_m + 2.0 * over_m;
        self.rectangle([-over_m, height_m, wide_m, scene.deck_m], "fill=\"#c8ced7\" stroke-width=\"1.3\"");
        let columns = description.columns.unwrap_or(1);
        if columns > scene.columns {
            let (x, y) = (WIDE - AROUND + 18.0, scene.y(0.5 * height_m));
            self.add(format_args!("<text x=\"{x:.1}\" y=\"{y:.1}\" {LETTERS}>of {columns}</text>"));
        }
    }

    /// The rounded extensions at both ends of the column whose left edge is at `left_m`, of a radius in m.
    fn ends(&mut self, left_m: f64, geometry: &Geometry, radius_m: f64) {
        let scene = self.scene;
        let radius = radius_m * scene.pixels_per_m;
        let (inner, outer) = (scene.x(left_m), scene.x(left_m - 0.5 * (scene.end_m - geometry.width_m())));
        let across = (inner - outer).abs();
        // an arc that begins flat at the edge of the column, as far as the extension reaches
        let rise = radius - (radius * radius - across.min(radius).powi(2)).max(0.0).sqrt();
        let mirrored = 2.0 * scene.x(left_m + geometry.half_width_m());
        for (y, up) in [(scene.ground, -1.0), (scene.y(geometry.height_m()), 1.0)] {
            let height = rise.max(4.0) + 0.25 * across;
            for (inner, outer, sweep) in [(inner, outer, up > 0.0), (mirrored - inner, mirrored - outer, up < 0.0)] {
                let sweep = 1 - u8::from(sweep);
                let (tip, root) = (y + up * rise, y + up * height);
                self.add(format_args!(
                    "<path d=\"M{inner:.1} {y:.1}A{radius:.1} {radius:.1} 0 0 {sweep} {outer:.1} {tip:.1}\
                     V{root:.1}H{inner:.1}Z\" {BODY}/>"
                ));
            }
        }
    }

    fn dimensions(&mut self, description: &StructureDescription, geometry: &Geometry) {
        let scene = self.scene;
        let width_m = geometry.width_m();
        let inset_m = 0.5 * (scene.end_m - width_m);
        let (left, right) = (scene.x(inset_m), scene.x(inset_m + width_m));
        let y = scene.ground + 26.0;
        for x in [left, right] {
            self.line((x, y - 5.0), (x, y + 5.0), THIN);
        }
        self.line((left, y), (right, y), THIN);
        let width = format!("{} m", rounded(width_m));
        self.add(format_args!(
            "<text x=\"{:.1}\" y=\"{:.1}\" {LETTERS}>{width}</text>",
            0.5 * (left + right),
            y + 20.0
        ));
        let height_m = top_m(description, geometry);
        let (x, top) = (scene.x(0.0).min(left) - 34.0, scene.y(height_m));
        for y in [scene.ground, top] {
            self.line((x - 5.0, y), (x + 5.0, y), THIN);
        }
        self.line((x, scene.ground), (x, top), THIN);
        let (x, y) = (x - 8.0, 0.5 * (scene.ground + top));
        self.add(format_args!(
            "<text x=\"{x:.1}\" y=\"{y:.1}\" transform=\"rotate(-90 {x:.1} {y:.1})\" {LETTERS}>{} m</text>",
            rounded(height_m)
        ));
    }
}

const BODY: &str = "fill=\"#e8ebef\" stroke-width=\"1.3\"";
const THIN: &str = "stroke=\"#5a6270\" stroke-width=\"0.8\"";
const DASHED: &str = "stroke=\"#9aa3b0\" stroke-dasharray=\"5 4\"";
const TENDON: &str = "stroke=\"#00618f\" stroke-width=\"1.4\"";
const LETTERS: &str = "fill=\"#1b1e23\" stroke=\"none\" text-anchor=\"middle\"";

/// A length as a drawing has it: to the millimetre.
fn rounded(metres: f64) -> String {
    let text = format!("{metres:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn described(kind: &str, more: &str) -> StructureDescription {
        toml::from_str(&format!("kind = \"{kind}\"\n{more}")).unwrap()
    }

    const FRAME: &str = "width_m = 1.6\nheight_m = 9.6\ncolumns = 4\ncolumn_mass_kg = 48e3\ndeck_mass_kg = 900e3\n";

    fn all() -> Vec<(&'static str, String)> {
        let solitary = "mass_kg = 8e3\nwidth_m = 1.2\n";
        let curved = format!("{FRAME}curvature_radius_m = 2.4\nextended_width_m = 3.6");
        let tied = format!("{FRAME}tendon_stiffness_n_m = 1e6\ntendon_anchorage = \"foundation\"");
        [
            ("point-mass", format!("{solitary}centre_height_m = 6")),
            ("block", format!("{solitary}height_m = 6")),
            ("body", format!("{solitary}centre_height_m = 3\nmoment_of_inertia_kg_m2 = 2e5")),
            ("frame", FRAME.to_owned()),
            ("restrained-frame", tied),
            ("curved-frame", curved),
        ]
        .map(|(kind, more)| (kind, drawing(&described(kind, &more))))
        .into()
    }

    #[test]
    fn every_kind_is_drawn_to_scale_within_its_paper() {
        for (kind, svg) in all() {
            assert!(svg.starts_with("<svg") && svg.ends_with("</svg>") && !svg.contains("NaN"), "{kind}");
            let view = svg.split("viewBox=\"").nth(1).unwrap().split('"').next().unwrap();
            let view: Vec<f64> = view.split(' ').map(|number| number.parse().unwrap()).collect();
            assert!(view[1] >= 0.0 && (view[1] + view[3] - HIGH).abs() < 1e-9, "{kind}: {view:?}");
            if let Some((_, rectangle)) = svg.split_once("<rect") {
                let side = |name: &str| -> f64 {
                    let value = rectangle.split_once(&format!(" {name}=\"")).unwrap().1;
                    value[..value.find('"').unwrap()].parse().unwrap()
                };
                let expected = if kind.contains("frame") { 6.0 } else { 5.0 };
                assert!((side("height") / side("width") - expected).abs() < 0.02, "{kind}");
                assert!(side("x") > 0.0 && side("y") > view[1] && side("height") < view[3], "{kind}");
            }
        }
    }

    #[test]
    fn every_kind_is_drawn_differently() {
        let drawn: Vec<(&str, String)> = all();
        let count = |kind: &str, what: &str| drawn.iter().find(|of| of.0 == kind).unwrap().1.matches(what).count();
        assert_eq!(count("frame", "<rect"), 5, "four columns and a deck");
        assert_eq!(count("restrained-frame", TENDON), 4, "a tendon in each column");
        assert_eq!(count("curved-frame", "A"), 16, "four arcs a column");
        assert_eq!(count("point-mass", "<circle"), 2, "the mass at rest, and as it rocks");
        let many = drawing(&described("frame", &FRAME.replace("columns = 4", "columns = 12")));
        assert!(many.contains("of 12</text>"), "{many}");
    }
}
