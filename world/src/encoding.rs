//! Text in the content of a file: UTF-8, with or without the mark with which some editors begin it.

/// The content without that mark.
pub fn unmarked(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(bytes)
}

/// The text of the content, without the mark.
///
/// # Errors
/// If it is not UTF-8: where, or which encoding it is.
pub fn text(bytes: &[u8]) -> Result<String, String> {
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return Err("it is text in UTF-16: save it as UTF-8".into());
    }
    String::from_utf8(unmarked(bytes).to_vec()).map_err(|e| {
        let good = &e.as_bytes()[..e.utf8_error().valid_up_to()];
        let line = 1 + good.iter().filter(|&&b| b == b'\n').count();
        format!("it is not UTF-8 text: line {line}, byte {}", good.len())
    })
}
