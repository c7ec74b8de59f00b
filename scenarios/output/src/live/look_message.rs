//! Pictures and pings as messages: a camera's picture as JPEG, a sidescan's ping as packed numbers, each with a header.

use super::Payload;
use super::message::{Message, bytes};
use super::slots::CountedValue;
use image::RgbImage;
use image::codecs::jpeg::JpegEncoder;
use image::imageops::thumbnail;
use rheotaxis::auv::topics::{PictureMessage, SidescanMessage};
use rheotaxis::frame::{PictureFrame, PingFrame};
use rheotaxis::topic::chunk;
use rheotaxis::topic::run::DTYPE;

/// JPEG quality of a picture; the files and the recording are lossless.
const QUALITY: u8 = 85;

/// No picture message has more bytes, so that it stays below 1 MB.
const MOST_BYTES: usize = 900_000;

/// The newest picture of a vehicle; `None` if it cannot be a JPEG, which is limited to 65 535 pixels a side.
pub(super) fn picture(newest: &CountedValue<PictureFrame>) -> Option<Message> {
    let CountedValue { taken, value } = newest;
    let (p, e) = (&value.picture, &value.estimate);
    let (width, height, file) = fitting(&p.image)?;
    let R_WB = e.attitude.R_WB();
    let header = PictureMessage {
        t_s: value.t_s,
        taken: *taken,
        width,
        height,
        view_rad: p.view_rad,
        position_m: (e.p_WB() + R_WB * p.p_BC).into(),
        quaternion_xyzw: (R_WB * p.R_BC).coords.into(),
    };
    Some(Message {
        key: format!("auv/{}/picture", chunk(&value.robot)),
        payload: file,
        packed: Payload::Jpeg,
        attachment: Some(bytes(&header)),
    })
}

/// The picture as JPEG, with its width and height, halved until it fits into a message.
fn fitting(image: &RgbImage) -> Option<(u32, u32, Vec<u8>)> {
    let mut file = jpeg(image)?;
    let (mut width, mut height) = image.dimensions();
    while file.len() > MOST_BYTES {
        (width, height) = (width.div_ceil(2), height.div_ceil(2));
        file = jpeg(&thumbnail(image, width, height))?;
    }
    Some((width, height, file))
}

fn jpeg(image: &RgbImage) -> Option<Vec<u8>> {
    let mut file = Vec::new();
    let mut encoder = JpegEncoder::new_with_quality(&mut file, QUALITY);
    encoder.encode_image(image).ok()?;
    Some(file)
}

/// The newest ping of a vehicle.
pub(super) fn ping(newest: &CountedValue<PingFrame>) -> Message {
    let CountedValue { taken, value } = newest;
    let (p, e) = (&value.ping, &value.estimate);
    let header = SidescanMessage {
        t_s: value.t_s,
        taken: *taken,
        port: p.port_db.len(),
        starboard: p.starboard_db.len(),
        max_m: p.max_m,
        position_m: (e.p_WB() + e.attitude.R_WB() * p.p_BS).into(),
        heading_rad: e.attitude.heading.rad(),
        altitude_m: e.altitude_m,
        dtype: DTYPE,
    };
    let samples = p.port_db.iter().chain(&*p.starboard_db).copied();
    let key = format!("auv/{}/sidescan", chunk(&value.robot));
    Message::numbers(key, samples, &header)
}

#[cfg(test)]
mod tests {
    use super::super::message::tests::frame;
    use super::*;
    use crate::sample;
    use image::Rgb;
    use serde_json::{Value, json};

    fn header(message: &Message) -> Value {
        serde_json::from_slice(message.attachment.as_ref().unwrap()).unwrap()
    }

    #[test]
    fn a_picture_too_large_for_a_message_is_halved() {
        // JPEG cannot compress noise: the high bits of a linear congruential generator.
        let mut state = 1u32;
        let mut noise = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 24) as u8
        };
        let image = RgbImage::from_fn(1600, 1001, |_, _| Rgb([noise(), noise(), noise()]));
        assert!(jpeg(&image).unwrap().len() > MOST_BYTES);
        let (width, height, file) = fitting(&image).unwrap();
        assert_eq!((width, height), (800, 501));
        assert!(file.len() <= MOST_BYTES);
        let back = image::load_from_memory(&file).unwrap();
        assert_eq!((back.width(), back.height()), (width, height));
    }

    #[test]
    fn the_camera_is_where_the_vehicle_believes_it() {
        let newest = CountedValue { taken: 3, value: sample::picture(&frame(0).robots[0], 1.0) };
        let header = header(&picture(&newest).unwrap());
        let at: Vec<f64> = serde_json::from_value(header["position_m"].clone()).unwrap();
        // It heads east at (1, 2), 3 m down.
        for (is, should) in at.iter().zip([1.5, 2.0, -3.1]) {
            assert!((is - should).abs() < 1e-12, "{at:?}");
        }
        assert_eq!(header["taken"], 3);
    }

    #[test]
    fn a_ping_has_port_before_starboard() {
        let value = sample::ping(&frame(0).robots[0], 1.0, [1.0, 2.0].into(), [3.0].into());
        let ping = ping(&CountedValue { taken: 1, value });
        let numbers: Vec<u8> = [1f32, 2.0, 3.0].into_iter().flat_map(f32::to_le_bytes).collect();
        assert_eq!(ping.payload, numbers);
        let header = header(&ping);
        assert_eq!((&header["port"], &header["starboard"]), (&json!(2), &json!(1)));
        // The altimeter has heard nothing.
        assert_eq!(header.get("altitude_m"), None);
    }
}
