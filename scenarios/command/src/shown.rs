//! A fault of a scenario with the text round it, as miette draws it.

use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode};
use rheotaxis::scenario::{Fault, Severity};
use std::fmt::Display;

/// A fault to be drawn.
#[derive(Debug, thiserror::Error)]
#[error("{fault}")]
pub(super) struct Shown {
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
