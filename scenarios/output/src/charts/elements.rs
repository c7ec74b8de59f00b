//! What the elements of a sheet's SVG say: numbers, colours, paths, texts and edges, as a
//! [canvas](super::canvas::Canvas) writes them.

use super::canvas::Anchor;
use super::glyphs::{TextStyle, outline};
use roxmltree::Node;
use tiny_skia::{Color, LineCap, LineJoin, Path, PathBuilder, Stroke, StrokeDash, Transform};

/// The value of an attribute that must be there.
pub(super) fn number(node: &Node<'_, '_>, name: &str) -> Result<f32, String> {
    let found = node.attribute(name).and_then(|value| value.parse().ok());
    found.ok_or_else(|| format!("<{}> needs a number for {name}", node.tag_name().name()))
}

/// The value of an attribute that may be left out.
pub(super) fn number_or(node: &Node<'_, '_>, name: &str, default: f32) -> Result<f32, String> {
    if node.has_attribute(name) { number(node, name) } else { Ok(default) }
}

/// A colour as `#rrggbb` or `#rgb`.
pub(super) fn colour(text: &str, opacity: f32) -> Result<Color, String> {
    let wrong = || format!("{text} is no colour");
    let digits = text.strip_prefix('#').ok_or_else(wrong)?;
    let value = u32::from_str_radix(digits, 16).map_err(|_| wrong())?;
    let [red, green, blue] = match digits.len() {
        6 => [value >> 16, value >> 8, value].map(|v| v as u8),
        3 => [value >> 8, value >> 4, value].map(|v| 17 * (v as u8 & 15)),
        _ => return Err(wrong()),
    };
    Ok(Color::from_rgba8(red, green, blue, (255.0 * opacity.clamp(0.0, 1.0)).round() as u8))
}

/// Straight lines, as `M x y L x y … Z`.
pub(super) fn lines(d: &str) -> Result<Option<Path>, String> {
    let wrong = || format!("a path of other than straight lines: {}", d.chars().take(40).collect::<String>());
    let mut builder = PathBuilder::new();
    let mut rest = d;
    while let Some(letter) = rest.chars().next() {
        let body = &rest[letter.len_utf8()..];
        let end = body.find(['M', 'L', 'Z']).unwrap_or(body.len());
        let (point, after) = body.split_at(end);
        let mut numbers = point.split_ascii_whitespace().map(str::parse::<f32>);
        match (letter, numbers.next(), numbers.next()) {
            ('M', Some(Ok(x)), Some(Ok(y))) => builder.move_to(x, y),
            ('L', Some(Ok(x)), Some(Ok(y))) => builder.line_to(x, y),
            ('Z', None, None) => builder.close(),
            _ => return Err(wrong()),
        }
        rest = after;
    }
    Ok(builder.finish())
}

/// `rotate(angle x y)`.
pub(super) fn rotation(text: &str) -> Result<Transform, String> {
    let inner = text.strip_prefix("rotate(").and_then(|t| t.strip_suffix(')'));
    let numbers: Vec<f32> = inner.into_iter().flat_map(|t| t.split(' ')).filter_map(|v| v.parse().ok()).collect();
    match numbers[..] {
        [angle, x, y] => Ok(Transform::from_rotate_at(angle, x, y)),
        _ => Err(format!("{text} is no rotation")),
    }
}

/// The outline of an element of text.
pub(super) fn written(node: &Node<'_, '_>) -> Result<Option<Path>, String> {
    let anchor = match node.attribute("text-anchor") {
        Some("middle") => Anchor::Middle,
        Some("end") => Anchor::End,
        _ => Anchor::Start,
    };
    let bold = node.attribute("font-weight") == Some("bold");
    let style = TextStyle { size: number(node, "font-size")?, bold, anchor };
    let at = [number(node, "x")?, number(node, "y")?];
    Ok(outline(node.text().unwrap_or_default(), &style, at))
}

/// How the edge of an element is drawn.
pub(super) fn stroke(node: &Node<'_, '_>) -> Result<Stroke, String> {
    let dash = node.attribute("stroke-dasharray").map(|text| {
        let lengths: Vec<f32> = text.split([' ', ',']).filter_map(|v| v.parse().ok()).collect();
        StrokeDash::new(lengths, 0.0).ok_or_else(|| format!("{text} are no dashes"))
    });
    Ok(Stroke {
        width: number_or(node, "stroke-width", 1.0)?,
        line_cap: if node.attribute("stroke-linecap") == Some("round") { LineCap::Round } else { LineCap::Butt },
        line_join: if node.attribute("stroke-linejoin") == Some("round") { LineJoin::Round } else { LineJoin::Miter },
        dash: dash.transpose()?,
        ..Stroke::default()
    })
}
