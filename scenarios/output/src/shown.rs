//! Draws mistakes of a scenario with the lines around them, by miette.

use miette::{
    Diagnostic, LabeledSpan, MietteDiagnostic, MietteHandler, MietteHandlerOpts, NamedSource,
    ReportHandler, SourceCode,
};
use rheotaxis::scenario::{Fault, ScenarioError, Severity};
use std::fmt::{self, Debug, Display};

/// A fault that miette can draw.
#[derive(Debug, thiserror::Error)]
#[error("{}", headline(fault, text.is_some()))]
pub struct Shown {
    fault: Fault,
    text: Option<NamedSource<String>>,
}

impl From<Fault> for Shown {
    fn from(mut fault: Fault) -> Self {
        let text = fault.text.take();
        let text = text.map(|text| NamedSource::new(&fault.source_name, text));
        Self { fault, text }
    }
}

/// The message; with its place if the text around it is not drawn.
fn headline(fault: &Fault, drawn: bool) -> String {
    if drawn {
        return fault.to_string();
    }
    let (line, column) = (fault.line, fault.column);
    format!(
        "{fault} ({}, line {line}, column {column})",
        fault.source_name
    )
}

/// Width of a text that no terminal shows.
const WIDTH: usize = 100;

/// How mistakes are drawn.
#[must_use]
pub fn look() -> MietteHandlerOpts {
    MietteHandlerOpts::new()
        .force_graphical(true)
        .terminal_links(false)
        .context_lines(1)
        .unicode(true)
}

/// How they are drawn where there is no terminal: each message is one line, so that it can be searched for.
#[must_use]
pub fn plain() -> MietteHandlerOpts {
    look().color(false).width(WIDTH).wrap_lines(false)
}

/// All mistakes of a scenario, as the command prints them into a file.
#[must_use]
pub fn text(error: ScenarioError) -> String {
    match error {
        ScenarioError::Many { faults, .. } => faults.into_iter().map(fault_text).collect(),
        ScenarioError::Text(fault) => fault_text(*fault),
        ScenarioError::File { ref help, .. } => {
            let mut diagnostic = MietteDiagnostic::new(error.to_string());
            diagnostic.help = help.clone();
            drawn(&diagnostic)
        }
    }
}

/// A mistake or a warning, as the command prints it into a file.
#[must_use]
pub fn fault_text(fault: Fault) -> String {
    drawn(&Shown::from(fault))
}

fn drawn(diagnostic: &dyn Diagnostic) -> String {
    /// What is formatted by the handler.
    struct Report<'a>(&'a dyn Diagnostic, MietteHandler);
    impl Debug for Report<'_> {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            self.1.debug(self.0, f)
        }
    }
    format!("{:?}\n", Report(diagnostic, plain().build()))
}

impl Diagnostic for Shown {
    fn severity(&self) -> Option<miette::Severity> {
        Some(match self.fault.severity {
            Severity::Warning => miette::Severity::Warning,
            Severity::Error => miette::Severity::Error,
        })
    }

    fn help<'a>(&'a self) -> Option<Box<dyn Display + 'a>> {
        let help = self.fault.help.as_ref()?;
        Some(Box::new(help))
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.text.as_ref().map(|text| text as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let label = self.fault.label.to_string();
        let label = LabeledSpan::new_with_span(Some(label), self.fault.span.clone());
        Some(Box::new(std::iter::once(label)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rheotaxis::scenario::{ScenarioError, parse, template};

    /// What is drawn of a channel with a field too many, behind a title of that length.
    fn drawn(title: usize) -> String {
        let text = template("uniform_channel").expect("in the catalogue").text;
        let long = format!("title: \"{}\", colour: 3, // ", "x".repeat(title));
        let text = text.replacen("title: ", &long, 1);
        match parse("long.ron", &text) {
            Err(ScenarioError::Text(fault)) => Shown::from(*fault).to_string(),
            other => panic!("one mistake expected, got {other:?}"),
        }
    }

    #[test]
    fn a_fault_on_a_line_too_long_to_show_names_its_place() {
        assert_eq!(drawn(10), "there is no field `colour`");
        let said = drawn(1000);
        assert_eq!(
            said,
            "there is no field `colour` (long.ron, line 4, column 1016)"
        );
    }
}
