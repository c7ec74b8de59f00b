//! A message in a form to be read: JSON as it is, packed numbers and pictures summarised beside their header.

use super::super::{Payload, Said, Topic};
use super::key::{parts, topic};
use image::{ImageFormat, ImageReader};
use serde_json::{Map, Value, json};
use std::io::Cursor;
use zenoh::bytes::Encoding;
use zenoh::sample::Sample;

/// Longer texts of base64 in a message are arrays.
const LONGEST_TEXT: usize = 256;

/// What a sample says, with these topics known.
pub(super) fn said(sample: &Sample, topics: &[Topic]) -> Said {
    let key = sample.key_expr().as_str();
    let topic = parts(key).and_then(|(_, below)| topic(below, topics));
    let bytes = sample.payload().to_bytes();
    let header = sample.attachment().map(|a| a.to_bytes());
    let payload = topic.map_or_else(|| by_encoding(sample.encoding()), |t| t.payload);
    let (t_s, message) = readable(payload, &bytes, header.as_deref());
    Said {
        key: key.to_owned(),
        topic: topic.map(|t| t.name),
        t_s,
        message,
    }
}

fn by_encoding(encoding: &Encoding) -> Payload {
    match encoding {
        e if *e == Encoding::APPLICATION_OCTET_STREAM => Payload::PackedF32,
        e if *e == Encoding::IMAGE_JPEG => Payload::Jpeg,
        _ => Payload::Json,
    }
}

/// A payload and its header, with the simulated time in them.
fn readable(payload: Payload, bytes: &[u8], header: Option<&[u8]>) -> (Option<f64>, Value) {
    let parsed = |text: &[u8]| serde_json::from_slice::<Value>(text).ok();
    let summary = match payload {
        Payload::Json | Payload::Schema => {
            let message = parsed(bytes).map_or_else(
                || json!({"bytes": bytes.len(), "problem": "no JSON"}),
                shortened,
            );
            return (message["t_s"].as_f64(), message);
        }
        Payload::PackedF32 | Payload::Jpeg => header.and_then(parsed),
    };
    let header = summary.unwrap_or(Value::Null);
    let time = header["t_s"].as_f64();
    let message = match payload {
        Payload::Jpeg => json!({"jpeg": picture(bytes), "header": header}),
        _ => json!({"packed": packed(bytes, &header), "header": header}),
    };
    (time, message)
}

/// Size of a picture, from the picture itself.
fn picture(bytes: &[u8]) -> Value {
    let size = ImageReader::with_format(Cursor::new(bytes), ImageFormat::Jpeg).into_dimensions();
    match size {
        Ok((width, height)) => json!({"width": width, "height": height, "bytes": bytes.len()}),
        Err(e) => json!({"bytes": bytes.len(), "problem": e.to_string()}),
    }
}

/// Shape and range of packed numbers, of each of their parts that the header names.
fn packed(bytes: &[u8], header: &Value) -> Value {
    let numbers: Vec<f32> = (bytes.chunks_exact(4))
        .map(|c| f32::from_le_bytes([c[0], c[1], c[2], c[3]]))
        .collect();
    let count = |name: &str| header[name].as_u64().and_then(|n| usize::try_from(n).ok());
    let mut out = Map::new();
    out.insert("type".into(), header["dtype"].clone());
    let (shape, part) = if let Some(fields) = header["fields"].as_array() {
        let columns = fields.len().max(1);
        let column = |k: usize| range(numbers.iter().skip(k).step_by(columns));
        let parts: Map<String, Value> = (fields.iter().enumerate())
            .map(|(k, name)| (name.as_str().unwrap_or_default().to_owned(), column(k)))
            .collect();
        (
            json!([numbers.len() / columns, columns]),
            Value::from(parts),
        )
    } else if let (Some(port), Some(_)) = (count("port"), count("starboard")) {
        let (left, right) = numbers.split_at(port.min(numbers.len()));
        let parts = json!({"port": range(left.iter()), "starboard": range(right.iter())});
        (json!([numbers.len()]), parts)
    } else {
        // As numpy has it: the axis that runs fastest comes last.
        let cells = header["cells"].as_array();
        let shape = cells.map(|cells| cells.iter().rev().cloned().collect::<Value>());
        (
            shape.unwrap_or_else(|| json!([numbers.len()])),
            range(numbers.iter()),
        )
    };
    out.insert("shape".into(), shape);
    out.insert("length".into(), numbers.len().into());
    out.insert("bytes".into(), bytes.len().into());
    out.insert("range".into(), part);
    Value::Object(out)
}

/// Least, greatest and mean of the finite ones among some numbers; an empty object where there are none.
fn range<'n>(numbers: impl Iterator<Item = &'n f32>) -> Value {
    let (mut least, mut most, mut sum, mut n) = (f32::INFINITY, f32::NEG_INFINITY, 0.0, 0_u32);
    for v in numbers.copied().filter(|v| v.is_finite()) {
        (least, most) = (least.min(v), most.max(v));
        (sum, n) = (sum + f64::from(v), n + 1);
    }
    if n == 0 {
        return json!({});
    }
    let mean = (sum / f64::from(n)) as f32;
    json!({"min": short(least), "max": short(most), "mean": short(mean)})
}

/// The shortest decimal that is this number in f32: 0.1, not 0.10000000149.
fn short(v: f32) -> Value {
    v.to_string()
        .parse::<f64>()
        .map_or(Value::Null, Value::from)
}

/// A message with its arrays in base64 replaced by their size.
fn shortened(value: Value) -> Value {
    match value {
        Value::String(text) if text.len() > LONGEST_TEXT && is_base64(&text) => {
            let padding = text.bytes().rev().take_while(|b| *b == b'=').count();
            json!({"base64": true, "bytes": text.len() / 4 * 3 - padding})
        }
        Value::Array(items) => items.into_iter().map(shortened).collect(),
        Value::Object(fields) => (fields.into_iter())
            .map(|(name, value)| (name, shortened(value)))
            .collect(),
        other => other,
    }
}

fn is_base64(text: &str) -> bool {
    text.len() % 4 == 0
        && text
            .bytes()
            .all(|b| b.is_ascii_alphanumeric() || matches!(b, b'+' | b'/' | b'='))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(numbers: &[f32]) -> Vec<u8> {
        numbers.iter().flat_map(|v| v.to_le_bytes()).collect()
    }

    #[test]
    fn columns_sides_and_grids_are_summarised_each_in_its_own_way() {
        let two = bytes(&[1.0, 10.0, 0.1, 30.0]);
        let header = json!({"t_s": 2.5, "shown": 2, "fields": ["x", "mass"], "dtype": "<f4"});
        let (t_s, said) = readable(
            Payload::PackedF32,
            &two,
            Some(header.to_string().as_bytes()),
        );
        assert_eq!((t_s, &said["header"]), (Some(2.5), &header));
        assert_eq!(
            said["packed"],
            json!({"type": "<f4", "shape": [2, 2], "length": 4, "bytes": 16, "range": {
                "x": {"min": 0.1, "max": 1.0, "mean": 0.55}, "mass": {"min": 10.0, "max": 30.0, "mean": 20.0},
            }})
        );
        let sides = packed(&two, &json!({"port": 3, "starboard": 1, "dtype": "<f4"}));
        assert_eq!(sides["shape"], json!([4]));
        assert_eq!(sides["range"]["port"]["max"], 10.0);
        assert_eq!(sides["range"]["starboard"]["mean"], 30.0);
        let grid = packed(&two, &json!({"cells": [4, 1, 1], "dtype": "<f4"}));
        assert_eq!(grid["shape"], json!([1, 1, 4]));
        assert_eq!(grid["range"]["max"], 30.0);
    }

    #[test]
    fn nothing_and_what_is_no_number_have_no_range() {
        let header = json!({"fields": ["x"], "dtype": "<f4"});
        assert_eq!(packed(&[], &header)["range"], json!({"x": {}}));
        let odd = packed(&bytes(&[f32::NAN, 2.0]), &header);
        assert_eq!(
            odd["range"]["x"],
            json!({"min": 2.0, "max": 2.0, "mean": 2.0})
        );
    }

    #[test]
    fn forged_messages_are_counted_in_bytes() {
        let (_, said) = readable(Payload::Json, b"no JSON", None);
        assert_eq!(said["bytes"], 7);
        let (_, said) = readable(Payload::Jpeg, b"no JPEG", Some(b"{"));
        assert_eq!(
            (&said["jpeg"]["bytes"], &said["header"]),
            (&json!(7), &Value::Null)
        );
        let (_, said) = readable(Payload::PackedF32, &[1, 2, 3], None);
        assert_eq!(said["packed"]["length"], 0);
    }

    #[test]
    fn arrays_in_base64_are_shortened_and_texts_are_not() {
        let (text, array) = ("a word ".repeat(100), "QUFB".repeat(100));
        let short = shortened(json!({"ron": text, "bed": {"points_m": array}}));
        assert_eq!(short["ron"], text);
        assert_eq!(
            short["bed"]["points_m"],
            json!({"base64": true, "bytes": 300})
        );
    }
}
