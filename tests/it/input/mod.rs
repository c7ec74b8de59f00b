//! What users type and write, what it is answered with, and what stands on their disks and terminals.

mod arguments;
mod bad_input;
mod cost;
mod explained;
mod interrupt;
mod outputs;
mod streams;
