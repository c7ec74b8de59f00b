//! Refuses what cannot be a URDF before it is parsed: other formats, and texts on which a parser would choke.
//!
//! *Source:* W3C, "Extensible Markup Language (XML) 1.0", 5th ed. 2008, sections 2.4 to 2.8 and 3.1; ROS xacro; SDFormat.
//!
//! *Parameters:* the limits below. The parser of URDF steps into itself for each level, and ends the program at some
//! thousands of them.
//!
//! *Deviations:* nothing else is checked: what is no XML, its parser says.

/// Most elements one within the other. Robots with plugins have some ten.
const DEEPEST: usize = 100;
/// Most elements.
const MOST_ELEMENTS: usize = 200_000;
/// Longest piece of a file that a message repeats, characters.
const LONGEST_QUOTE: usize = 60;

/// Why a text cannot be read as URDF, with the line, and what to do.
pub(super) fn refuse(text: &str) -> Result<(), String> {
    let (mut depth, mut elements) = (0_usize, 0_usize);
    for (line, tag) in tags(text) {
        if tag.starts_with("</") {
            depth = depth.saturating_sub(1);
            continue;
        }
        let here = |problem: String| Err(format!("line {line}: {problem}"));
        if let Some(problem) = foreign(tag, elements == 0) {
            return here(problem);
        }
        elements += 1;
        depth += usize::from(!tag.ends_with("/>"));
        if depth > DEEPEST {
            return here(format!("more than {DEEPEST} elements stand one within the other"));
        }
        if elements > MOST_ELEMENTS {
            return here(format!("it has more than {MOST_ELEMENTS} elements"));
        }
    }
    Ok(())
}

/// The tags of a text, each with its line, up to where it is no XML: its reader says where.
pub(super) fn tags(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let (mut at, mut line) = (0, 1);
    let pieces = std::iter::from_fn(move || {
        let begin = at + text[at..].find('<')?;
        line += text[at..begin].matches('\n').count();
        let rest = &text[begin..];
        let piece = &rest[..aside(rest).or_else(|| start_tag(rest))?];
        at = begin + piece.len();
        let here = line;
        line += piece.matches('\n').count();
        Some((here, piece))
    });
    pieces.filter(|(_, piece)| !piece.starts_with("<!") && !piece.starts_with("<?"))
}

/// Length of what is no start tag; all of it if its end is missing.
fn aside(rest: &str) -> Option<usize> {
    let kinds = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>"), ("<!", ">"), ("</", ">")];
    let (begin, end) = kinds.iter().find(|(begin, _)| rest.starts_with(begin))?;
    let at = rest[begin.len()..].find(end);
    Some(at.map_or(rest.len(), |at| begin.len() + at + end.len()))
}

/// Length of the start tag with which a text begins; a `>` between quotes does not end it.
fn start_tag(rest: &str) -> Option<usize> {
    let mut quote = None;
    let end = rest.bytes().position(|b| match (quote, b) {
        (Some(q), _) => {
            if b == q {
                quote = None;
            }
            false
        }
        (None, b'"' | b'\'') => {
            quote = Some(b);
            false
        }
        (None, b) => b == b'>',
    });
    end.map(|end| end + 1)
}

/// What a tag belongs to if not to URDF, and what to do.
fn foreign(tag: &str, is_root: bool) -> Option<String> {
    let name = tag[1..].split(|c: char| c.is_whitespace() || c == '/' || c == '>');
    let name = name.into_iter().next().unwrap_or_default();
    if is_root {
        let format = match name {
            "sdf" => "SDF, the format of Gazebo",
            "mujoco" => "MJCF, the format of MuJoCo",
            "COLLADA" => "COLLADA, a mesh",
            _ => "",
        };
        if !format.is_empty() {
            return Some(format!(
                "<{name}>: it is {format}. Describe the vehicle as URDF: a <robot> with a <link> for the hull, with mass \
                 and collision shapes, and one for each drive and instrument, and joints between them; coefficients \
                 stand in vehicle.ron"
            ));
        }
    }
    if name.starts_with("xacro:") || tag.contains("${") || tag.contains("$(") {
        return Some(format!(
            "{} is for xacro, which makes a URDF of such a file: run `xacro FILE > NEW.urdf`, and name the new file",
            quote(tag)
        ));
    }
    None
}

/// A tag for a message, on one line and shortened.
fn quote(tag: &str) -> String {
    let words: Vec<&str> = tag.split_whitespace().collect();
    let whole = words.join(" ");
    match whole.char_indices().nth(LONGEST_QUOTE) {
        Some((end, _)) => format!("{}...", &whole[..end]),
        None => whole,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(text: &str) -> String {
        refuse(text).expect_err("no URDF")
    }

    #[test]
    fn other_formats_are_named_with_what_to_do() {
        let sdf = said("<?xml version=\"1.0\"?>\n<!-- a > b -->\n<sdf version=\"1.9\"><model name=\"b\"/></sdf>");
        assert!(sdf.starts_with("line 3: <sdf>: it is SDF"), "{sdf}");
        assert!(sdf.contains("<robot>"), "{sdf}");
        assert!(said("<mujoco/>").contains("MuJoCo"));
        for xacro in [
            "<robot>\n<xacro:property name=\"m\" value=\"30\"/></robot>",
            "<robot>\n<mass value=\"${m}\"/></robot>",
            "<robot>\n<mesh filename='$(find box)/hull.stl'/></robot>",
        ] {
            let said = said(xacro);
            assert!(said.starts_with("line 2: <"), "{said}");
            assert!(said.contains("run `xacro"), "{said}");
        }
    }

    /// What xacro writes still names it, and comments may say anything.
    #[test]
    fn a_urdf_is_left_alone() {
        for good in [
            "<robot name=\"a\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\"><link name=\"b\"/></robot>",
            "<!-- <sdf> ${m} <xacro:if> --><robot name=\"a > b\"/>",
            "<!DOCTYPE robot><robot><![CDATA[<sdf>]]></robot>",
            "hello",
            "<robot name=\"cut",
            "<!-- cut",
        ] {
            assert_eq!(refuse(good), Ok(()), "{good}");
        }
        let wide = format!("<robot>{}</robot>", "<a><b/></a>".repeat(1000));
        assert_eq!(refuse(&wide), Ok(()));
    }

    #[test]
    fn what_a_parser_chokes_on_is_refused_at_once() {
        let nested = |n: usize| format!("<robot>\n{}{}</robot>", "<a>".repeat(n), "</a>".repeat(n));
        assert_eq!(refuse(&nested(DEEPEST - 1)), Ok(()));
        let deep = said(&nested(1_000_000));
        assert_eq!(deep, "line 2: more than 100 elements stand one within the other");
        let many = said(&"<a/>".repeat(MOST_ELEMENTS + 1));
        assert!(many.contains("more than 200000 elements"), "{many}");
    }
}
