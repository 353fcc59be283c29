//! Text with raised and lowered parts, as formulae have them: `u_{max}`, `10^{−3}`.
//!
//! Nothing else is marked: an underscore without a brace stands for itself, as in the name of a record.

/// How far a part is raised or lowered, and its size, as shares of the size of the text.
const RAISED: f64 = 0.36;
const LOWERED: f64 = -0.2;
const SMALLER: f64 = 0.72;

/// Where a part of a text stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    Line,
    Raised,
    Lowered,
}

/// The parts of `text`, in their order, without their marks.
fn parts(text: &str) -> Vec<(Place, &str)> {
    let mut parts = Vec::new();
    let mut rest = text;
    while let Some(at) = [rest.find("_{"), rest.find("^{")].into_iter().flatten().min() {
        let place = if rest[at..].starts_with('_') { Place::Lowered } else { Place::Raised };
        let Some((inside, after)) = rest[at + 2..].split_once('}') else { break };
        parts.extend([(Place::Line, &rest[..at]), (place, inside)]);
        rest = after;
    }
    parts.push((Place::Line, rest));
    parts.retain(|(_, part)| !part.is_empty());
    parts
}

/// The text for a place where nothing is raised or lowered: `u_max`, `10^−3`.
pub fn plain(text: &str) -> String {
    let words = parts(text).into_iter().map(|(place, part)| match place {
        Place::Line => part.to_owned(),
        Place::Raised => format!("^{part}"),
        Place::Lowered => format!("_{part}"),
    });
    words.collect()
}

/// The text as HTML, with what HTML means by a character spelt out.
pub fn html(text: &str) -> String {
    let words = parts(text).into_iter().map(|(place, part)| {
        let part = escaped(part);
        match place {
            Place::Line => part,
            Place::Raised => format!("<sup>{part}</sup>"),
            Place::Lowered => format!("<sub>{part}</sub>"),
        }
    });
    words.collect()
}

/// The text as it stands in HTML and SVG: what they mean by a character spelt out.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// The drawing with the parts of its texts raised and lowered, which the library cannot do.
pub(super) fn typeset(svg: &str) -> String {
    let mut set = String::with_capacity(svg.len());
    let mut rest = svg;
    while let Some((before, text)) = rest.split_once("<text ") {
        let Some((attributes, (content, after))) =
            text.split_once('>').and_then(|(head, tail)| Some((head, tail.split_once("</text>")?)))
        else {
            break;
        };
        let found = parts(content.trim());
        let size = attributes.split_once("font-size=\"").and_then(|(_, from)| from.split('"').next()?.parse().ok());
        set.extend([before, "<text ", attributes, ">"]);
        match size {
            Some(size) if found.iter().any(|(place, _)| *place != Place::Line) => set.push_str(&spans(&found, size)),
            _ => set.push_str(content),
        }
        set.push_str("</text>");
        rest = after;
    }
    set.push_str(rest);
    set
}

/// The parts one after the other; a shift holds until it is taken back.
fn spans(parts: &[(Place, &str)], size: f64) -> String {
    let mut height = 0.0;
    let span = |&(place, part): &(Place, &str)| {
        let (wanted, size) = match place {
            Place::Line => (0.0, size),
            Place::Raised => (RAISED * size, SMALLER * size),
            Place::Lowered => (LOWERED * size, SMALLER * size),
        };
        let shift = height - wanted;
        height = wanted;
        // a shift of the first part would take the place of that of the whole text
        let shift = if shift == 0.0 { String::new() } else { format!("dy=\"{shift:.1}\" ") };
        format!("<tspan {shift}font-size=\"{size:.1}\">{part}</tspan>")
    };
    parts.iter().map(span).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_raised_and_lowered() {
        assert_eq!(plain("u_{max} ω_{p}²/a_{p}"), "u_max ω_p²/a_p");
        assert_eq!(html("10^{−3} < f_{up}"), "10<sup>−3</sup> &lt; f<sub>up</sub>");
        let svg = "<svg><text x=\"1\" font-size=\"100\">\n10^{−3} g\n</text><text x=\"2\">a</text></svg>";
        let expected = [
            "<svg><text x=\"1\" font-size=\"100\">",
            "<tspan font-size=\"100.0\">10</tspan>",
            "<tspan dy=\"-36.0\" font-size=\"72.0\">−3</tspan>",
            "<tspan dy=\"36.0\" font-size=\"100.0\"> g</tspan>",
            "</text><text x=\"2\">a</text></svg>",
        ]
        .concat();
        assert_eq!(typeset(svg), expected);
    }

    #[test]
    fn names_of_others_stay_as_they_are() {
        for name in ["RSN_753_UP", "a^b", "open _{", "{x}", ""] {
            assert_eq!((plain(name), parts(name).len()), (name.to_owned(), usize::from(!name.is_empty())), "{name}");
        }
    }
}
