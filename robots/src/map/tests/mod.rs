//! Beliefs, doubts and the kernel, held for all mappers at once.

mod belief;
mod doubt;
mod kernel;
mod outlook;
mod search;
