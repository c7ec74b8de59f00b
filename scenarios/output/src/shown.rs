//! Draws mistakes of a scenario with the lines around them, and other errors.

use rheotaxis::scenario::{Fault, ScenarioError, Severity};
use std::borrow::Cow;
use std::fmt::Write as _;
use unicode_width::UnicodeWidthStr as _;

/// How messages are drawn.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// With colours of a terminal.
    pub color: bool,
    /// Longest line of a message, columns. Without it each message is one line, so that it can be searched for.
    pub width: Option<usize>,
}

/// How they are drawn where there is no terminal.
pub const PLAIN: Look = Look { color: false, width: None };

/// A text as a terminal may show it. Titles and names are texts of others: characters in them that would command the
/// terminal, or turn the direction of writing, are written as `\u{1b}`. Lines and tabs stay.
pub fn printable(text: &str) -> Cow<'_, str> {
    let acts = |c: char| (c.is_control() && !matches!(c, '\n' | '\t')) || turns(c);
    if !text.contains(acts) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        match acts(c) {
            true => out.extend(c.escape_unicode()),
            false => out.push(c),
        }
    }
    Cow::Owned(out)
}

/// Whether a character marks or turns the direction of writing, or ends a line unseen.
pub fn turns(c: char) -> bool {
    matches!(
        c,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
    )
}

/// A mistake or a warning with the lines around it.
pub fn fault(fault: &Fault, look: Look) -> String {
    let mut message = fault.to_string();
    if fault.text.is_none() {
        // The lines are too long to be drawn.
        let (line, column) = (fault.line, fault.column);
        let _ = write!(message, " ({}, line {line}, column {column})", fault.source_name);
    }
    let mut out = head(fault.severity, &message, look);
    if let Some(text) = &fault.text {
        out += &lines_around(fault, text, look);
    }
    out + &help(fault.help.as_deref(), look)
}

/// Any other error, and how to put it right.
pub fn error(message: &str, hint: Option<&str>, look: Look) -> String {
    head(Severity::Error, message, look) + &help(hint, look)
}

/// All mistakes of a scenario, one after the other.
pub fn all(mistakes: &ScenarioError, look: Look) -> Vec<String> {
    match mistakes {
        ScenarioError::Many { faults, .. } => faults.iter().map(|f| fault(f, look)).collect(),
        ScenarioError::Text(one) => vec![fault(one, look)],
        ScenarioError::File { help, .. } => {
            vec![error(&mistakes.to_string(), help.as_deref(), look)]
        }
    }
}

fn head(severity: Severity, message: &str, look: Look) -> String {
    let (sign, color) = match severity {
        Severity::Error => ("×", RED),
        Severity::Warning => ("⚠", YELLOW),
    };
    let bar = look.paint(color, "│");
    wrapped(message, &format!("  {} ", look.paint(color, sign)), &format!("  {bar} "), 4, look)
}

fn help(hint: Option<&str>, look: Look) -> String {
    let sign = look.paint(CYAN, "help:");
    hint.map_or(String::new(), |hint| wrapped(hint, &format!("  {sign} "), "        ", 8, look))
}

/// The line of a fault with its mark, and those before and after it.
fn lines_around(fault: &Fault, text: &str, look: Look) -> String {
    let marked = fault.line - 1;
    let shown: Vec<(usize, &str)> =
        (text.lines().enumerate()).skip(marked.saturating_sub(1)).take_while(|(n, _)| *n <= marked + 1).collect();
    let last = shown.last().map_or(fault.line, |(n, _)| n + 1);
    let wide = last.to_string().len();
    let gap = " ".repeat(wide + 2);
    let mut out = format!("{gap}╭─[{}:{}:{}]\n", printable(&fault.source_name), fault.line, fault.column);
    for (n, line) in shown {
        let _ = writeln!(out, " {} │ {}", look.paint(DIM, &format!("{:>wide$}", n + 1)), tabs(line));
        if n == marked {
            let begin = fault.span.start - text[..fault.span.start].rfind('\n').map_or(0, |at| at + 1);
            let pad = " ".repeat(tabs(&line[..begin.min(line.len())]).width());
            let (mark, below) = mark(tabs(&text[fault.span.clone()]).width());
            let _ = writeln!(out, "{gap}· {pad}{}", look.paint(PURPLE, &mark));
            let label = format!("{}╰── {}", " ".repeat(below), printable(fault.label));
            let _ = writeln!(out, "{gap}· {pad}{}", look.paint(PURPLE, &label));
        }
    }
    out + &gap + "╰────\n"
}

/// A line below so many columns, and where its label hangs.
fn mark(columns: usize) -> (String, usize) {
    if columns == 0 {
        return ("▲".to_string(), 0);
    }
    let below = columns / 2;
    (format!("{}┬{}", "─".repeat(below), "─".repeat(columns - below - 1)), below)
}

fn tabs(text: &str) -> String {
    let text = text.trim_end_matches('\r').replace('\t', "    ");
    printable(&text).into_owned()
}

/// Words in lines of the look's width, behind a first and further margins of so many columns.
fn wrapped(text: &str, first: &str, further: &str, margin: usize, look: Look) -> String {
    let most = look.width.map_or(usize::MAX, |w| w.saturating_sub(margin).max(20));
    let mut out = first.to_string();
    for (n, paragraph) in text.lines().enumerate() {
        if n > 0 {
            out = out + "\n" + further;
        }
        let mut used = 0;
        for word in printable(paragraph).split(' ') {
            let wide = word.width();
            if used > 0 && used + 1 + wide > most {
                out = out + "\n" + further;
                used = 0;
            } else if used > 0 {
                out.push(' ');
                used += 1;
            }
            out += word;
            used += wide;
        }
    }
    out + "\n"
}

const RED: &str = "31";
const YELLOW: &str = "33";
const CYAN: &str = "36";
const PURPLE: &str = "35";
const DIM: &str = "2";

impl Look {
    fn paint(self, color: &str, text: &str) -> String {
        if self.color { format!("\x1b[{color}m{text}\x1b[0m") } else { text.to_string() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rheotaxis::scenario::{parse, template};

    /// What is drawn of a channel with a field too many, behind a title of that length.
    fn drawn(title: usize, look: Look) -> String {
        let text = template("uniform_channel").expect("in the catalogue").text;
        let long = format!("title: \"{}\", colour: 3, // ", "x".repeat(title));
        let text = text.replacen("title: ", &long, 1);
        match parse("long.ron", &text) {
            Err(ScenarioError::Text(one)) => fault(&one, look),
            other => panic!("one mistake expected, got {other:?}"),
        }
    }

    #[test]
    fn a_fault_on_a_line_too_long_to_show_names_its_place() {
        let drawn_short = drawn(10, PLAIN);
        assert!(drawn_short.starts_with("  × there is no field `colour`\n   ╭─[long.ron:4:"), "{drawn_short}");
        let said = drawn(1000, PLAIN);
        assert!(said.starts_with("  × there is no field `colour` (long.ron, line 4, column 1016)\n  help: "), "{said}");
    }

    #[test]
    fn a_narrow_terminal_gets_lines_of_its_width() {
        let said = error(
            "one two three four five six",
            Some("seven eight nine ten eleven"),
            Look { color: false, width: Some(24) },
        );
        assert_eq!(said, "  × one two three four\n  │ five six\n  help: seven eight nine ten\n        eleven\n");
        let colored = drawn(10, Look { color: true, width: Some(80) });
        assert!(colored.contains("\x1b[31m×\x1b[0m"), "{colored}");
    }

    #[test]
    fn what_would_command_a_terminal_is_written_out() {
        assert_eq!(printable("a — b\t\u{e9}\n"), "a — b\t\u{e9}\n");
        assert_eq!(printable("\x1b[31m\x07\u{9b}\u{202e}\u{2066}\r"), r"\u{1b}[31m\u{7}\u{9b}\u{202e}\u{2066}\u{d}");
        let text = template("uniform_channel").expect("in the catalogue").text;
        let text = text.replacen("title: \"", "\u{202e}: 3, title: \"\x1b]0;x\x07", 1);
        let Err(odd) = parse("\x1b.ron", &text) else {
            panic!("it is no scenario");
        };
        let drawn = all(&odd, PLAIN).concat();
        assert!(drawn.contains(r"\u{1b}.ron"), "{drawn}");
        assert!(!drawn.contains(|c: char| c != '\n' && (c.is_control() || turns(c))), "{drawn}");
    }
}
