//! Numbers and texts of RON.

/// A number.
pub(super) fn number(word: &str) -> Option<f64> {
    let plain = plain(word);
    match plain.trim_start_matches(['+', '-']) {
        "inf" if plain.starts_with('-') => return Some(f64::NEG_INFINITY),
        "inf" => return Some(f64::INFINITY),
        "NaN" => return Some(f64::NAN),
        digits if digits.starts_with(|c: char| c.is_ascii_digit() || c == '.') => {}
        _ => return None,
    }
    let read = plain.parse().ok();
    read.or_else(|| whole(word).map(|v| v as f64))
}

/// A whole number.
pub(super) fn whole(word: &str) -> Option<i128> {
    let plain = plain(word);
    let (sign, digits) = match plain.strip_prefix('-') {
        Some(digits) => (-1, digits),
        None => (1, plain.strip_prefix('+').unwrap_or(&plain)),
    };
    if !digits.starts_with(|c: char| c.is_ascii_digit()) {
        return None;
    }
    let (base, digits) = match digits.get(..2) {
        Some("0x") => (16, &digits[2..]),
        Some("0b") => (2, &digits[2..]),
        Some("0o") => (8, &digits[2..]),
        _ => (10, digits),
    };
    Some(sign * i128::from_str_radix(digits, base).ok()?)
}

/// Without underscores and the suffix of a type.
fn plain(word: &str) -> String {
    let mut plain = word.replace('_', "");
    for suffix in ["f32", "f64", "u8", "u16", "u32", "u64", "i8", "i16", "i32", "i64"] {
        if !plain.starts_with("0x")
            && let Some(number) = plain.strip_suffix(suffix)
        {
            plain = number.to_string();
            break;
        }
    }
    plain
}

/// A text in quotes; `Err` with an escape that RON does not know.
pub(super) fn text(word: &str) -> Option<Result<String, char>> {
    if let Some(raw) = word.strip_prefix('r') {
        let inner = raw.trim_matches('#');
        return Some(Ok(inner.strip_prefix('"')?.strip_suffix('"')?.to_string()));
    }
    let inner = word.strip_prefix('"')?;
    let inner = inner.strip_suffix('"').unwrap_or(inner);
    let mut text = String::with_capacity(inner.len());
    let mut chars = inner.chars();
    while let Some(c) = chars.next() {
        if c != '\\' {
            text.push(c);
            continue;
        }
        match chars.next()? {
            'n' => text.push('\n'),
            't' => text.push('\t'),
            'r' => text.push('\r'),
            '0' => text.push('\0'),
            same @ ('\\' | '"' | '\'') => text.push(same),
            // A character by its number. Which one does not matter: the text is only checked.
            'u' | 'x' => text.push('?'),
            other => return Some(Err(other)),
        }
    }
    Some(Ok(text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_texts_are_read_as_ron_reads_them() {
        for (word, value) in [("-1.5e3", -1500.0), ("1_000", 1000.0), (".5", 0.5), ("2f64", 2.0)] {
            assert_eq!(number(word), Some(value), "{word}");
        }
        assert!(number("NaN").is_some_and(f64::is_nan));
        assert_eq!(number("-inf"), Some(f64::NEG_INFINITY));
        assert_eq!([number("\u{2212}3"), number("1.2.3"), number("infinity")], [None; 3]);
        assert_eq!([whole("0x1f"), whole("-7"), whole("2.5")], [Some(31), Some(-7), None]);
        assert_eq!(text("\"a\\\"b\\n\""), Some(Ok("a\"b\n".to_string())));
        assert_eq!(text("r#\"a\"b\"#"), Some(Ok("a\"b".to_string())));
        assert_eq!([text("\"\\q\""), text("a")], [Some(Err('q')), None]);
    }
}
