//! Errors and warnings about a scenario, with file, line, column and the text around the place.

use std::ops::Range;

/// Longest line that is shown, bytes.
const LONG: usize = 400;

/// Whether something stops a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// It is legal, but probably not meant.
    Warning,
    /// It stops a run.
    Error,
}

/// A scenario cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum ScenarioError {
    /// The file itself.
    #[error("{path}: {problem}")]
    File {
        /// The file as it was asked for.
        path: String,
        /// What is wrong.
        problem: String,
        /// What would be right.
        help: Option<String>,
    },
    /// One place in its text.
    #[error(transparent)]
    Text(#[from] Box<Fault>),
    /// Several places in its text.
    #[error("{path}: {} mistakes", faults.len())]
    Many {
        /// The file as it was asked for.
        path: String,
        /// Each of them.
        faults: Vec<Fault>,
    },
}

impl ScenarioError {
    /// One or more mistakes of one text, put in the order of the text.
    pub fn from_faults(path: &str, mut faults: Vec<Fault>) -> Self {
        faults.sort_by_key(|f| (f.line, f.column));
        match faults.len() {
            1 => Box::new(faults.remove(0)).into(),
            _ => Self::Many { path: path.to_string(), faults },
        }
    }

    /// One line for each mistake, `file:line:column: field: what is wrong`, for logs and tables.
    pub fn lines(&self) -> Vec<String> {
        match self {
            ScenarioError::File { .. } => vec![self.to_string()],
            ScenarioError::Text(fault) => vec![fault.line()],
            ScenarioError::Many { faults, .. } => faults.iter().map(Fault::line).collect(),
        }
    }
}

/// One mistake at one place of a scenario's text.
#[derive(Debug, thiserror::Error)]
#[error("{}", headline(path, message))]
pub struct Fault {
    /// Path of the field, such as `robots[1].start`; empty for the whole.
    pub path: String,
    /// What is wrong: the value and the legal range.
    pub message: String,
    /// How to correct it.
    pub help: Option<String>,
    /// Whether it stops a run.
    pub severity: Severity,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// The label of the marked text.
    pub label: &'static str,
    /// The file as it was asked for.
    pub source_name: String,
    /// The file's text, if the lines around the fault are short enough to be shown.
    pub text: Option<String>,
    /// The marked text, in bytes.
    pub span: Range<usize>,
}

impl Fault {
    pub(crate) fn new(name: &str, text: &str, span: Range<usize>, found: UnplacedFault) -> Self {
        let before = &text[..span.start];
        // The mark ends with its line: a longer one would hide what matters.
        let line_end = text[span.start..].find('\n').map_or(text.len(), |i| span.start + i);
        let end = span.end.min(line_end).max(span.start);
        let line = 1 + before.matches('\n').count();
        let column = 1 + before.chars().rev().take_while(|&c| c != '\n').count();
        // A line too long to look at is not shown.
        let shown = text.lines().skip(line.saturating_sub(2)).take(3).all(|l| l.len() <= LONG);
        Self {
            path: found.path,
            message: found.message,
            help: found.help,
            severity: found.severity,
            line,
            column,
            label: found.label,
            source_name: name.to_string(),
            text: shown.then(|| text.to_string()),
            span: span.start..end,
        }
    }

    /// The fault in one line: `file:line:column: field: what is wrong`.
    pub fn line(&self) -> String {
        format!("{}:{}:{}: {self}", self.source_name, self.line, self.column)
    }
}

/// A mistake before its place is known.
#[derive(Clone, Debug, PartialEq)]
pub struct UnplacedFault {
    /// Path of the field, such as `robots[1].start`; empty for the whole.
    pub path: String,
    /// What is wrong: the value and the legal range.
    pub message: String,
    /// How to put it right.
    pub help: Option<String>,
    /// Whether it stops a run.
    pub severity: Severity,
    label: &'static str,
}

impl UnplacedFault {
    /// A mistake that stops a run.
    pub fn error(path: impl Into<String>, message: impl Into<String>) -> Self {
        Self { path: path.into(), message: message.into(), help: None, severity: Severity::Error, label: "here" }
    }

    /// Something legal that is probably not meant.
    pub fn warning(path: impl Into<String>, message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, ..Self::error(path, message) }
    }

    /// Adds how to correct it.
    #[must_use]
    pub fn hint(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Labels the marked text.
    #[must_use]
    pub(super) fn label(mut self, label: &'static str) -> Self {
        self.label = label;
        self
    }
}

impl std::fmt::Display for UnplacedFault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&headline(&self.path, &self.message))
    }
}

fn headline(path: &str, message: &str) -> String {
    if path.is_empty() { message.to_string() } else { format!("{path}: {message}") }
}
