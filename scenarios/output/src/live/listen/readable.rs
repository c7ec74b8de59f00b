//! A message in a form to be read: JSON as it is, packed numbers and pictures summarised beside their header.

use serde_json::{Map, Value, json};
use zenoh::bytes::Encoding;
use zenoh::sample::Sample;

/// Longer texts without a space are arrays in base64.
const LONGEST_WORD: usize = 256;

/// The key of a sample and what it says.
pub(super) fn readable(sample: &Sample) -> Value {
    let header = sample.attachment().map(|a| a.to_bytes());
    let bytes = sample.payload().to_bytes();
    let mut line = message(sample.encoding(), &bytes, header.as_deref());
    line.insert("key".into(), sample.key_expr().as_str().into());
    line.into()
}

fn message(encoding: &Encoding, bytes: &[u8], header: Option<&[u8]>) -> Map<String, Value> {
    let json = |text: &[u8]| serde_json::from_slice::<Value>(text).ok();
    let header = header.and_then(json);
    let size = || json!({"bytes": bytes.len()});
    let summary = if *encoding == Encoding::APPLICATION_OCTET_STREAM {
        Some(("packed", packed(bytes, header.as_ref())))
    } else if *encoding == Encoding::IMAGE_JPEG {
        Some(("jpeg", size()))
    } else {
        None
    };
    let message = match summary {
        Some(_) => header.unwrap_or_default(),
        None => json(bytes).map_or_else(size, shortened),
    };
    let parts = summary.into_iter().chain([("message", message)]);
    parts.map(|(name, value)| (name.to_owned(), value)).collect()
}

/// Count and range of packed numbers, column by column if the header names columns.
fn packed(bytes: &[u8], header: Option<&Value>) -> Value {
    let (numbers, _) = bytes.as_chunks();
    let numbers: Vec<f32> = numbers.iter().map(|c| f32::from_le_bytes(*c)).collect();
    let Some(fields) = header.and_then(|header| header["fields"].as_array()) else {
        return range(numbers.iter());
    };
    let column = |(k, name): (usize, &Value)| {
        let name = name.as_str().unwrap_or_default().to_owned();
        (name, range(numbers.iter().skip(k).step_by(fields.len())))
    };
    fields.iter().enumerate().map(column).collect::<Map<_, _>>().into()
}

/// How many numbers there are; the least, greatest and mean of the finite ones, if any.
fn range<'n>(numbers: impl ExactSizeIterator<Item = &'n f32>) -> Value {
    let count = numbers.len();
    let (mut least, mut most, mut sum, mut n) = (f32::INFINITY, f32::NEG_INFINITY, 0.0, 0_u32);
    for v in numbers.copied().filter(|v| v.is_finite()) {
        (least, most) = (least.min(v), most.max(v));
        (sum, n) = (sum + f64::from(v), n + 1);
    }
    if n == 0 {
        return json!({"count": count});
    }
    let [min, max, mean] = [least, most, (sum / f64::from(n)) as f32].map(short);
    json!({"count": count, "min": min, "max": max, "mean": mean})
}

/// The shortest decimal that is this number in f32: 0.1, not 0.10000000149.
fn short(v: f32) -> Option<f64> {
    v.to_string().parse().ok()
}

/// A message with its arrays in base64 replaced by their size.
fn shortened(value: Value) -> Value {
    match value {
        Value::String(text) if text.len() > LONGEST_WORD && !text.contains(' ') => {
            json!({"base64_bytes": text.trim_end_matches('=').len() * 3 / 4})
        }
        Value::Array(items) => items.into_iter().map(shortened).collect(),
        Value::Object(fields) => {
            let short = |(name, value)| (name, shortened(value));
            fields.into_iter().map(short).collect::<Map<_, _>>().into()
        }
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PACKED: Encoding = Encoding::APPLICATION_OCTET_STREAM;

    fn read(encoding: &Encoding, bytes: &[u8], header: &Value) -> Value {
        message(encoding, bytes, Some(header.to_string().as_bytes())).into()
    }

    fn bytes(numbers: &[f32]) -> Vec<u8> {
        numbers.iter().flat_map(|v| v.to_le_bytes()).collect()
    }

    #[test]
    fn packed_numbers_are_summarised_by_column_or_as_a_whole() {
        let two = bytes(&[1.0, 10.0, 0.1, 30.0]);
        let header = json!({"t_s": 2.5, "fields": ["x", "mass"]});
        let columns = json!({
            "x": {"count": 2, "min": 0.1, "max": 1.0, "mean": 0.55},
            "mass": {"count": 2, "min": 10.0, "max": 30.0, "mean": 20.0},
        });
        let line = json!({"message": header, "packed": columns});
        assert_eq!(read(&PACKED, &two, &header), line);
        let header = json!({"cells": [4, 1, 1]});
        let whole = json!({"count": 4, "min": 0.1, "max": 30.0, "mean": 10.275});
        assert_eq!(read(&PACKED, &two, &header)["packed"], whole);
    }

    #[test]
    fn what_is_no_number_is_counted_and_has_no_range() {
        let header = json!({"fields": ["x"]});
        let none = &read(&PACKED, &[], &header)["packed"];
        assert_eq!(*none, json!({"x": {"count": 0}}));
        let odd = &read(&PACKED, &bytes(&[f32::NAN, 2.0]), &header)["packed"];
        let two = json!({"x": {"count": 2, "min": 2.0, "max": 2.0, "mean": 2.0}});
        assert_eq!(*odd, two);
        let broken = message(&PACKED, &[1, 2, 3], Some(b"{"));
        assert_eq!(Value::from(broken), json!({"message": null, "packed": {"count": 0}}));
    }

    #[test]
    fn arrays_in_base64_and_what_is_no_json_are_their_size_and_texts_stay() {
        let (text, array) = ("a word ".repeat(100), "QUFB".repeat(99) + "QQ==");
        let scene = json!({"ron": text, "bed": {"points_m": array}}).to_string();
        let read = message(&Encoding::APPLICATION_JSON, scene.as_bytes(), None);
        let short = json!({"ron": text, "bed": {"points_m": {"base64_bytes": 298}}});
        assert_eq!(Value::from(read), json!({"message": short}));
        let forged = message(&Encoding::ZENOH_BYTES, b"no JSON", None);
        assert_eq!(Value::from(forged), json!({"message": {"bytes": 7}}));
        let picture = message(&Encoding::IMAGE_JPEG, b"no JPEG", None);
        assert_eq!(Value::from(picture), json!({"message": null, "jpeg": {"bytes": 7}}));
    }
}
