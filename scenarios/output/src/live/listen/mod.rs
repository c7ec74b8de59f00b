//! Hears what runs publish: where it connects, which keys it hears, and what it makes of a message.

mod key;
mod listener;
mod reach;
mod readable;

pub use listener::Listener;
