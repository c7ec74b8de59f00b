//! The XML around the coefficients: elements with their lines, the numbers in them, and the doubts about them.
//!
//! *Source:* W3C, "Extensible Markup Language (XML) 1.0", 5th ed. 2008, as roxmltree reads it.
//!
//! *Parameters:* the limits below. Without them, a file could be made that takes hours: roxmltree compares every
//! attribute with all others of its tag, and hands all namespaces down to every element.
//!
//! *Deviations:* a document type is refused, and with it all entities of a file's own.

use crate::error::ensure;
use crate::vehicles::urdf_form::tags;
use nalgebra::Matrix6;
use roxmltree::{Document, Error, ParsingOptions};
use std::collections::BTreeMap;

/// An element.
pub(super) type Node<'a> = roxmltree::Node<'a, 'a>;

/// Most elements and texts of a file.
const MOST_NODES: u32 = 500_000;
/// Most signs `=` of a tag, and so most of its attributes.
const MOST_ATTRIBUTES: usize = 200;
/// Most declarations of namespaces.
const MOST_NAMESPACES: usize = 100;
/// Longest number, characters.
const LONGEST_NUMBER: usize = 64;
/// Greatest coefficient, SI units: far above that of any ship.
const GREATEST: f64 = 1e12;
/// Most doubts that are told one by one.
const MOST_DOUBTS: usize = 50;
/// Longest piece of a file that a message repeats, characters.
const LONGEST_QUOTE: usize = 80;

/// Parses a file.
///
/// # Errors
/// If it is not XML, or beyond a limit; with the line.
pub(super) fn parse(text: &str) -> Result<Document<'_>, String> {
    ensure(text.matches("xmlns").count() <= MOST_NAMESPACES, || {
        format!("\"xmlns\" occurs more than {MOST_NAMESPACES} times")
    })?;
    if let Some((line, _)) = tags(text).find(|(_, tag)| tag.matches('=').count() > MOST_ATTRIBUTES) {
        return Err(format!("line {line}: a tag has more than {MOST_ATTRIBUTES} attributes"));
    }
    let limits = ParsingOptions { nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    Document::parse_with_options(text, limits).map_err(|e| match e {
        Error::DtdDetected => "a document type (<!DOCTYPE ...>) is not read: remove it".to_string(),
        Error::NodesLimitReached => format!("has more than {MOST_NODES} elements and texts"),
        e => format!("line {}: not XML: {}", e.pos().row, quote(&e.to_string())),
    })
}

/// A piece of the file for a message, shortened.
pub(super) fn quote(piece: &str) -> String {
    match piece.char_indices().nth(LONGEST_QUOTE) {
        Some((end, _)) => format!("{}...", &piece[..end]),
        None => piece.to_string(),
    }
}

/// Elements directly in `node`.
pub(super) fn elements<'a>(node: Node<'a>) -> impl Iterator<Item = Node<'a>> {
    node.children().filter(Node::is_element)
}

/// Name of an element.
pub(super) fn name<'a>(node: Node<'a>) -> &'a str {
    node.tag_name().name()
}

/// What a reader does with an element.
pub(super) enum Use {
    /// It takes its content.
    Read,
    /// Nothing, because it says nothing about forces on a body deep in the water.
    Skip,
    /// Nothing, which has to be told, with a reason.
    Doubt(&'static str),
}

/// Where the elements are, and what is doubtful about them.
pub(super) struct Report {
    /// Byte at which each line but the first begins.
    starts: Vec<usize>,
    doubts: Vec<String>,
    untold: usize,
}

impl Report {
    /// An empty report about a text.
    pub(super) fn new(text: &str) -> Self {
        Self { starts: text.match_indices('\n').map(|(i, _)| i + 1).collect(), doubts: Vec::new(), untold: 0 }
    }

    /// Line in which an element begins.
    pub(super) fn line(&self, node: Node<'_>) -> usize {
        let byte = node.range().start;
        1 + self.starts.partition_point(|start| *start <= byte)
    }

    /// An error at an element.
    pub(super) fn fault(&self, node: Node<'_>, problem: &str) -> String {
        let mut tag = name(node).to_string();
        if is_xacro(node) {
            tag.insert_str(0, "xacro:");
        }
        format!("line {}, <{}>: {problem}", self.line(node), quote(&tag))
    }

    /// Adds a doubt about an element.
    pub(super) fn doubt(&mut self, node: Node<'_>, problem: &str) {
        if self.doubts.len() < MOST_DOUBTS {
            self.doubts.push(self.fault(node, problem));
        } else {
            self.untold += 1;
        }
    }

    /// All doubts, in the order in which they came up.
    pub(super) fn into_doubts(mut self) -> Vec<String> {
        if self.untold > 0 {
            self.doubts.push(format!("and {} more", self.untold));
        }
        self.doubts
    }

    /// The elements in `node` that are read, by name; each may occur once. Doubts those that `sort` doubts.
    pub(super) fn sorted<'a>(
        &mut self,
        node: Node<'a>,
        sort: impl Fn(&str) -> Use,
    ) -> Result<BTreeMap<&'a str, Node<'a>>, String> {
        let mut read = BTreeMap::new();
        for child in elements(node) {
            match sort(name(child)) {
                Use::Read => {
                    if let Some(first) = read.insert(name(child), child) {
                        let first = self.line(first);
                        return Err(self.fault(child, &format!("occurs twice; the first is on line {first}")));
                    }
                }
                Use::Skip => {}
                Use::Doubt(why) => self.doubt(child, why),
            }
        }
        Ok(read)
    }

    /// Text of an element, or of its attribute, without comments.
    pub(super) fn text_of(&self, node: Node<'_>, attribute: Option<&str>) -> Result<String, String> {
        let text = match attribute {
            Some(attribute) => {
                let missing = || self.fault(node, &format!("attribute \"{attribute}\" is missing"));
                node.attribute(attribute).ok_or_else(missing)?.to_string()
            }
            None => {
                let pieces = node.children().filter(Node::is_text);
                pieces.filter_map(|t| t.text()).collect::<String>()
            }
        };
        let text = text.trim();
        if text.contains("${") || text.contains("$(") {
            let problem = format!("\"{}\" is for xacro: run xacro first", quote(text));
            return Err(self.fault(node, &problem));
        }
        if text.is_empty() && attribute.is_some() {
            return Err(self.fault(node, "its name is empty"));
        }
        Ok(text.to_string())
    }

    /// All numbers of an element; finite.
    pub(super) fn numbers(&self, node: Node<'_>) -> Result<Vec<f64>, String> {
        let number = |word: &str| {
            ensure(word.len() <= LONGEST_NUMBER, || {
                format!("\"{}\" is no number of at most {LONGEST_NUMBER} characters", quote(word))
            })?;
            let value: f64 = (word.parse()).map_err(|_| format!("\"{word}\" is not a number"))?;
            ensure(value.abs() <= GREATEST, || format!("must be from -{GREATEST:e} to {GREATEST:e}, got {word}"))?;
            Ok(value)
        };
        let words = self.text_of(node, None)?;
        let numbers: Result<Vec<f64>, String> = words.split_whitespace().map(number).collect();
        numbers.map_err(|problem| self.fault(node, &problem))
    }

    /// The one number of an element.
    pub(super) fn number(&self, node: Node<'_>) -> Result<f64, String> {
        match self.numbers(node)?[..] {
            [value] => Ok(value),
            ref other => {
                let problem = format!("needs 1 number, got {}", other.len());
                Err(self.fault(node, &problem))
            }
        }
    }

    /// The one number of an element, above zero.
    pub(super) fn positive(&self, node: Node<'_>) -> Result<f64, String> {
        let value = self.number(node)?;
        if value > 0.0 {
            return Ok(value);
        }
        Err(self.fault(node, &format!("must be > 0, got {value}")))
    }

    /// A switch.
    pub(super) fn is_true(&self, node: Node<'_>) -> Result<bool, String> {
        match self.text_of(node, None)?.to_ascii_lowercase().as_str() {
            "true" | "1" => Ok(true),
            "false" | "0" => Ok(false),
            other => {
                let problem = format!("must be true or false, got \"{}\"", quote(other));
                Err(self.fault(node, &problem))
            }
        }
    }

    /// A matrix of 36 numbers, row by row, or of the 6 of its diagonal, and whether all 36 are given.
    pub(super) fn matrix(&self, node: Node<'_>) -> Result<(Matrix6<f64>, bool), String> {
        let numbers = self.numbers(node)?;
        match numbers.len() {
            6 => {
                let diagonal = nalgebra::Vector6::from_row_slice(&numbers);
                Ok((Matrix6::from_diagonal(&diagonal), false))
            }
            36 => Ok((Matrix6::from_row_slice(&numbers), true)),
            n => Err(self.fault(node, &format!("needs 6 or 36 numbers, got {n}"))),
        }
    }
}

/// Whether an element is a macro for xacro.
pub(super) fn is_xacro(node: Node<'_>) -> bool {
    let namespace = node.tag_name().namespace();
    namespace.is_some_and(|n| n.trim_end_matches('/').ends_with("xacro"))
}
